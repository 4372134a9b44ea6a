"""judge_every_oracle.py PROGRAM FOLDER: asks every oracle of the program for its fields at places within its body, and has
the answers judged by the same oracle, in both formats: no error at all in any field."""
import os
import re
import subprocess
import sys

PROGRAM, FOLDER = sys.argv[1:]
SIZES = (0.01, 0.1, 1, 10)  # metres: one of them has places within any body
TIMES = ("1e-3", "1e-5", "1e-7")  # seconds: some oracles do not reach far
STATE = ("u", "v", "p", "F", "H", "J", "P", "P_all", "sigma", "sigma_all", "pressure")


def run(*words):
    return subprocess.run([PROGRAM, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def ask(name, dim, path):
    """The words that give an answer, which is written."""
    for size in SIZES:
        for time in TIMES:
            words = ["oracle", name, "--typical", "--inside", "--time", time, "--grid", ",".join([f"0:{size}:3"] * dim)]
            answer = run(*words, "-o", path)
            if answer.returncode == 0:
                return words
            if "does not reach" not in answer.stdout:
                break
    sys.exit(f"FAIL: {name} answers at no place:\n{answer.stdout[-800:]}")


def extras(path):
    """Columns of a table that are none of a state's fields."""
    with open(path, encoding="utf-8") as file:
        header = next(line for line in file if not line.startswith("#"))
    names = [column.split("[")[0] for column in header.strip().split(",")]
    return [name for name in names if name not in ("X", "Y", "Z", "weight")
            and name not in STATE and re.sub("_[xyz]{1,2}$", "", name) not in STATE]


def main():
    os.makedirs(FOLDER, exist_ok=True)
    oracles = re.findall(r"^  (\S+) +([123])D: ", run("list", "oracles").stdout, re.M)
    motions = re.findall(r"^  (manufactured-\S+) +[12]D to 3D: ", run("list", "oracles").stdout, re.M)
    oracles += [(f"{motion}-neo-hookean-{dim}d", dim) for motion in motions for dim in "23"]
    told = 0
    for name, dim in oracles:
        paths = [os.path.join(FOLDER, name + ending) for ending in (".h5", ".csv")]
        words = ask(name, int(dim), paths[0])
        if run(*words, "-o", paths[1]).returncode != 0:
            sys.exit(f"FAIL: {name} writes no table")
        more = extras(paths[1])
        gates = [word for field in (*STATE, *more) for word in ("--gate", field + "_abs_max=0")]
        for path in paths:
            same = run("judge", path, "--oracle", name, "--typical", *gates)
            if same.returncode != 0 or same.stdout.count("PASS") != len(STATE) + len(more) + 1:
                sys.exit(f"FAIL: {name} does not agree with itself in {path}:\n{same.stdout[-800:]}")
        told += len(more)
        print(f"{name}: agrees with itself in {len(STATE)} fields and {len(more)} extra scalars")
    if len(motions) < 3 or len(oracles) < 20 or told < 15:
        sys.exit(f"FAIL: only {len(oracles)} oracles, {len(motions)} motions, {told} extra scalars")


main()
