"""mutate.py ROOT MUTANT OUT: writes to OUT the source that MUTANT names, broken as it says. A mutant is a text file:

    why, in words
    source: FILE
    through: FILE, of a header: the source that includes it and is compiled with it
    --- was
    text that stands exactly once in FILE
    +++ is
    what stands there instead

The last newline of either text does not count, so that a part of a line can be replaced. Text that is not there, or
is there twice, is an error: mutants must not rot."""
import os
import re
import sys

FORM = re.compile(r".+?\nsource: ([^\n]+)\n(?:through: [^\n]+\n)?--- was\n(.+?)\n\+\+\+ is\n(.*)\n", re.DOTALL)


def main():
    root, mutant, out = sys.argv[1:]
    with open(mutant, encoding="utf-8") as file:
        form = FORM.fullmatch(file.read())
    if not form:
        sys.exit(f"{mutant}: expected: why, 'source: FILE', for a header 'through: FILE', '--- was', text, '+++ is', text; see tests/mutants/mutate.py")
    source, was, broken = form.groups()
    if was == broken:
        sys.exit(f"{mutant}: both texts are the same; nothing would be broken")
    path = os.path.join(root, source)
    with open(path, encoding="utf-8") as file:
        text = file.read()
    if text.count(was) != 1:
        sys.exit(f"{mutant}: {source} holds this text {text.count(was)} times, expected once; renew the mutant:\n{was}")
    with open(out, "w", encoding="utf-8") as file:
        file.write(f'#line 1 "{path}"\n' + text.replace(was, broken))


main()
