"""judge_every_oracle.py PROGRAM FOLDER: asks every oracle of the program for its fields at places within its body, and has
the answers judged by the same oracle: no error at all."""
import os
import re
import subprocess
import sys

PROGRAM, FOLDER = sys.argv[1:]
SIZES = (0.01, 0.1, 1, 10)  # metres: one of them has places within any body
TIMES = ("1e-3", "1e-5", "1e-7")  # seconds: some oracles do not reach far


def run(*words):
    return subprocess.run([PROGRAM, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def ask(name, dim, path):
    for size in SIZES:
        for time in TIMES:
            grid = ",".join([f"0:{size}:3"] * dim)
            answer = run("oracle", name, "--typical", "--inside", "--time", time, "-o", path, "--grid", grid)
            if answer.returncode == 0:
                return
            if "does not reach" not in answer.stdout:
                break
    sys.exit(f"FAIL: {name} answers at no place:\n{answer.stdout[-800:]}")


def main():
    os.makedirs(FOLDER, exist_ok=True)
    oracles = re.findall(r"^  (\S+) +([123])D: ", run("list", "oracles").stdout, re.M)
    for name, dim in oracles:
        path = os.path.join(FOLDER, name + ".h5")
        ask(name, int(dim), path)
        gates = [word for field in ("u", "v", "p", "F", "P_all", "sigma_all", "pressure")
                 for word in ("--gate", field + "_abs_max=0")]
        same = run("judge", path, "--oracle", name, "--typical", *gates)
        if same.returncode != 0 or same.stdout.count("PASS") != 8:
            sys.exit(f"FAIL: {name} does not agree with itself:\n{same.stdout[-800:]}")
        print(f"{name}: agrees with itself")
    if len(oracles) < 7:
        sys.exit(f"FAIL: only {len(oracles)} oracles")


main()
