#!/usr/bin/env bash
# What must not stand in the tree: unsafe flags, work left open, large files, printing outside verify/, and room
# includes that run the wrong way.
# Usage: forbidden.sh SOURCE
set -euo pipefail
cd -- "$1"
found=0
# Reads "FILE:LINE:TEXT" and says what is wrong with it.
refuse() {
  local line
  while IFS= read -r line; do
    printf '%s  <- %s\n' "$line" "$1"
    found=1
  done
}
rooms=(solver oracles render golden verify)
sources() { find "$@" -name '*.[ch]' -print0 | xargs -0r grep -nHE "$pattern" || true; }

# Written so that this file does not find itself.
pattern='-f''fast-math|-O''fast|-f''unsafe-math|-f''associative-math'
refuse "gives up reproducible arithmetic" < <(grep -rInE -e "$pattern" "${rooms[@]}" tests examples cmake CMakeLists.txt CMakePresets.json go || true)
pattern='TO''DO|FIX''ME|XX''X|HA''CK'
refuse "is left open" < <(grep -rInwE -e "$pattern" "${rooms[@]}" tests examples cmake CMakeLists.txt go .ci || true)

# Scratch files go where the environment's TMPDIR says (tests/unit/scratch.h).
pattern='/t''mp\>'
refuse "is not where everybody has room: take scratch.h, or mktemp" < <(grep -rInE -e "$pattern" tests examples || true)

# Only verify/ prints and exits; snprintf and writing to a file of one's own are fine.
pattern='\<(v?printf|puts|putchar|perror|exit|_exit|_Exit|quick_exit|abort|assert)[[:space:]]*\(|\<(stdout|stderr)\>'
refuse "only verify/ may print or exit" < <(sources solver oracles render golden)

# Includes: each room and the headers of other rooms that it may see.
includes() {
  local room=$1 allowed=$2
  pattern='#[[:space:]]*include[[:space:]]*"[^"]*"'
  refuse "$room/ may not include this" < <(sources "$room" | grep -vE "\"($allowed)\"" || true)
}
includes solver 'solver/[^"/]+'
includes oracles 'oracles/[^"/]+'
includes render 'render/[^"/]+'
includes golden 'golden/[^"/]+|solver/(record|run|scene|cloud|error)\.h'
includes verify '(verify|golden|render|oracles|solver)/[^"/]+'

# In a checkout only what is tracked counts: people may keep records of their own beside it.
tracked() { git ls-files -z 2>/dev/null || find . -path ./build -prune -o -type f -print0; }
refuse "is larger than 1 MiB" < <(tracked | xargs -0r stat -c '%s %n' -- 2>/dev/null | awk '$1 > 1048576 { sub(/^[0-9]+ /, ""); print }')
refuse "has more than 500 lines" < <(find "${rooms[@]}" tests examples -name '*.[ch]' -print0 | xargs -0r awk 'FNR == 501 { print FILENAME }')
exit $found
