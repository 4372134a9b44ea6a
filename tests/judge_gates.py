"""judge_gates.py PROGRAM FOLDER: results that stand for another solver's (judge_sample.c), judged in all four formats. The
right ones must pass, the others fail by the gates that tell; all formats must give the same numbers, which are computed
here once more from the tables."""
import csv
import json
import math
import os
import re
import subprocess
import sys

PROGRAM, FOLDER = sys.argv[1:]
ORACLE = ["--oracle", "swinging-cube", "--typical"]
GATES = ["--gate", "u=8e-3", "--gate", "P=8e-3", "--gate", "rate P=1.8", "--order", "p=1.8", "--gate", "P_all_max=2e-2"]


def demand(condition, what):
    if not condition:
        sys.exit(f"FAIL: {what}")


def judge(files, code, *more):
    report = os.path.join(FOLDER, "study.json")
    if os.path.exists(report):
        os.remove(report)
    run = subprocess.run([PROGRAM, "judge", *files, *ORACLE, "--json", report, *more], stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True)
    demand(run.returncode == code, f"{files}: exit code {run.returncode}, expected {code}:\n{run.stdout}")
    with open(report, encoding="utf-8") as file:
        return json.load(file), run.stdout


def rows_of(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def norm_by_hand(path, exact, names):
    """The relative L2 norm as verify/norms.h defines it, from a table of results and one of the oracle's."""
    error = size = 0
    for row, true in zip(rows_of(path), rows_of(exact)):
        for name in names:
            error += float(row["weight"]) * (float(row[name]) - float(true[name])) ** 2
            size += float(row["weight"]) * float(true[name]) ** 2
    return math.sqrt(error / size)


def check_shape(study, passed):
    demand({"scene", "oracle", "scheme", "stencil", "levels", "rates", "gates", "pass"} == set(study), f"keys {set(study)}")
    demand([level["h"] for level in study["levels"]] == [0.5, 0.25, 0.125], "levels from coarse to fine")
    demand(all(level["n"] is None and level["particles"] > 0 and level["weighted"] for level in study["levels"]), "levels")
    demand(study["pass"] is passed and len(study["gates"]) == 5, f"pass = {study['pass']}")
    coarse, fine = study["levels"][-2:]
    for name, rate in study["rates"].items():
        order = math.log(coarse["errors"][name] / fine["errors"][name]) / math.log(2)
        demand(math.isclose(rate, order, abs_tol=1e-9), f"rate {name} = {rate}, not {order}")
    for gate in study["gates"]:
        holds = gate["value"] <= gate["bound"] if gate["op"] == "<=" else gate["value"] >= gate["bound"]
        demand(gate["pass"] is holds, f"gate {gate}")


def main():
    failing = {"right": set(), "offset": {"P", "rate P"}, "lost": {"rate P", "rate p"}}
    diagonal = ["P_xx[Pa]", "P_yy[Pa]", "P_zz[Pa]"]
    for kind, names in failing.items():
        seen = []
        for ending in ("h5", "vtkhdf", "vtu", "csv"):
            # the order of files is not that of levels
            files = [os.path.join(FOLDER, f"{kind}-{n}.{ending}") for n in (8, 2, 4)]
            study, _ = judge(files, 1 if names else 0, *GATES)
            check_shape(study, not names)
            demand({gate["name"] for gate in study["gates"] if not gate["pass"]} == names, f"{kind}: {study['gates']}")
            seen.append([level["errors"] for level in study["levels"]])
        study, _ = judge([os.path.join(FOLDER, f"{kind}.h5")], 1 if names else 0, *GATES)
        seen.append([level["errors"] for level in study["levels"]])
        demand(all(errors == seen[0] for errors in seen), f"{kind}: formats differ")
        exact, table = os.path.join(FOLDER, "exact.csv"), os.path.join(FOLDER, f"{kind}-8.csv")
        subprocess.run([PROGRAM, "oracle", "swinging-cube", "--typical", "--points", table, "-o", exact], check=True,
                       stdout=subprocess.DEVNULL)
        by_hand = norm_by_hand(table, exact, diagonal)
        demand(math.isclose(by_hand, seen[0][-1]["P"], rel_tol=1e-12), f"P = {seen[0][-1]['P']}, by hand {by_hand}")
        again, _ = judge([exact], 0, "--gate", "P=0", "--gate", "F=0", "--gate", "pressure=0", "--gate", "v_max=0")
        demand(all(value == 0 for value in again["levels"][0]["errors"].values()), "the oracle agrees with itself")
        rate = {gate["name"]: gate["value"] for gate in study["gates"]}
        print(f"{kind}: P {seen[0][-1]['P']:.4g}, order {rate['rate P']:.3f}; p order {rate['rate p']:.3f}")
    study, text = judge([os.path.join(FOLDER, "right-8.csv")], 0)
    demand(study["pass"] is None and "NOT JUDGED: no gate was given" in text, "without a gate nothing is judged")
    study, text = judge([os.path.join(FOLDER, "right-8.csv")], 1, "--gate", "rate P=1.8")
    demand("nothing was measured" in text, "one level has no order")
    out = os.path.join(FOLDER, "report")
    judge([os.path.join(FOLDER, "right.h5")], 0, *GATES, "--out", out)
    with open(os.path.join(out, "report.html"), encoding="utf-8") as file:
        page = file.read()
    demand(page.count("<svg") >= 3 and "PASS: all gates hold" in page and "</html>" in page, "the page")
    demand(not re.search(r"\bnan\b|\(null\)", page), "a number that is none stands on the page")


main()
