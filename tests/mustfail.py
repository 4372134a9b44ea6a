"""mustfail.py FOLDER GATES PROGRAM WORD... -- BROKEN WORD...: two studies, `PROGRAM verify WORD...` and the same of
BROKEN. The first must pass, exit code 0; the second must fail by its gates, exit code 1, those named in GATES
("p,rate p") among them. Any other end of either, such as a crash or a run that broke down, is no catch."""
import json
import os
import subprocess
import sys


def study(program, words, folder, name, expected):
    """Runs the study; returns its gates as {name: gate}."""
    report = os.path.join(folder, name + ".json")
    if os.path.exists(report):
        os.remove(report)
    command = [program, "verify", *words, "--out", os.path.join(folder, name), "--json", report]
    # What is broken may compute anything: it runs without floating-point traps.
    environment = os.environ if expected == 0 else {**os.environ, "ASSAY_TRAP": ""}
    run = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if run.returncode != expected:
        sys.exit(f"{run.stdout}\nFAIL: exit code {run.returncode}, expected {expected}: {' '.join(command)}")
    with open(report, encoding="utf-8") as file:
        return {gate["name"]: gate for gate in json.load(file)["gates"]}


def main():
    folder, names, *words = sys.argv[1:]
    split = words.index("--")
    os.makedirs(folder, exist_ok=True)
    right = study(words[0], words[1:split], folder, "right", 0)
    broken = study(words[split + 1], words[split + 2:], folder, "broken", 1)
    for name, gate in broken.items():
        print(f"{name:8} {right[name]['value']:10.3e} broken {gate['value']:10.3e} {gate['op']} {gate['bound']:10.3e} "
              f"{'passes' if gate['pass'] else 'FAILS, as it should' if name in names.split(',') else 'fails'}")
    for name in names.split(","):
        if name not in broken or broken[name]["pass"]:
            sys.exit(f"FAIL: the gate \"{name}\" did not notice")


main()
