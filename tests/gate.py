"""gate.py FOLDER BOUND... -- PROGRAM WORD...: runs `PROGRAM verify WORD...` and holds its finest level to each BOUND,
such as "p <= 6.5e-4" or "rate P >= 1.8". All gates of the scene must hold too, exit code 0. "gate p <= 6.5e-4" demands
that the scene itself has this gate, so that it cannot be widened or lost unnoticed."""
import json
import os
import re
import subprocess
import sys

BOUND = re.compile(r"(gate )?(rate )?((?:figure |indicator )?\w[\w ]*) (<=|>=) (\S+)")


def main():
    split = sys.argv.index("--")
    folder, bounds, command = sys.argv[1], sys.argv[2:split], sys.argv[split + 1:]
    os.makedirs(folder, exist_ok=True)
    report = os.path.join(folder, "study.json")
    if os.path.exists(report):
        os.remove(report)
    program, *words = command
    run = subprocess.run([program, "verify", *words, "--out", folder, "--json", report], stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True)
    print(run.stdout[run.stdout.find("errors at t"):])
    if run.returncode != 0:
        sys.exit(f"FAIL: exit code {run.returncode}, expected 0: {program} verify {' '.join(words)}")
    with open(report, encoding="utf-8") as file:
        study = json.load(file)
    if not bounds:
        sys.exit("FAIL: no bound, nothing to check")
    for text in bounds:
        form = BOUND.fullmatch(text)
        if not form:
            sys.exit(f"FAIL: \"{text}\": expected as \"p <= 6.5e-4\" or \"gate rate P >= 1.8\"")
        gate, rate, name, op, bound = form[1], form[2], form[3], form[4], float(form[5])
        finest = study["levels"][-1]
        value = (study["rates"][name] if rate else finest["figures"][name[7:]]["error"] if name.startswith("figure ")
                 else finest["indicators"][name[10:]] if name.startswith("indicator ") else finest["errors"][name])
        if value is None:
            sys.exit(f"FAIL: {text}: nothing was measured")
        if not (value <= bound if op == "<=" else value >= bound):
            sys.exit(f"FAIL: {text}: measured {value:.4g}")
        own = {"name": (rate or "") + name, "value": value, "bound": bound, "op": op, "pass": True}
        if gate and own not in study["gates"]:
            sys.exit(f"FAIL: the scene has no {text}; it has {study['gates']}")
        print(f"{text}: measured {value:.4g}")


main()
