"""same_errors.py DIGITS A.json B.json: the finest levels of both reports must be of one n and their errors of p and P
equal to DIGITS digits, that is, differ by at most half a unit in the last of them."""
import json
import math
import sys


def finest(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)["levels"][-1]


def main():
    digits, a, b = int(sys.argv[1]), finest(sys.argv[2]), finest(sys.argv[3])
    if a["n"] != b["n"]:
        sys.exit(f"FAIL: {sys.argv[2]} ends at n = {a['n']}, {sys.argv[3]} at n = {b['n']}")
    differ = False
    for name in ("p", "P"):
        x, y = a["errors"][name], b["errors"][name]
        room = 0.5 * 10.0 ** (math.floor(math.log10(x)) + 1 - digits)
        differ = differ or not abs(x - y) <= room
        print(f"{name} at n = {a['n']}: {x:.4e} and {y:.4e}, difference {abs(x - y):.1e}, allowed {room:.1e}")
    if differ:
        sys.exit(f"FAIL: not equal to {digits} digits")


main()
