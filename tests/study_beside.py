"""study_beside.py PROGRAM FOLDER: studies a scene without an oracle beside another configuration, and the other
configuration itself; checks what JSON, terminal and page say of both."""
import json
import math
import os
import subprocess
import sys

INDICATORS = ("clumping", "checkerboard", "linear momentum", "angular momentum", "energy gain")
SAYS = "no oracle: nothing here is compared with an exact solution"


def study(program, folder, *words):
    run = subprocess.run([program, "verify", "rotating-plate", "--set", "t_end=0.03", "--out", folder, *words],
                         stdout=subprocess.PIPE, text=True)
    print(run.stdout)
    assert run.returncode in (0, 1), f"exit code {run.returncode}"
    with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
        found = json.load(file)
    with open(os.path.join(folder, "report.html"), encoding="utf-8") as file:
        page = file.read().split("<h2>Scene</h2>")[0]
    assert SAYS in run.stdout and SAYS in page, "it is not said that there is no oracle"
    assert found["oracle"] == "" and found["rates"] == {}, "an oracle or an order of errors without one"
    assert found["pass"] is all(gate["pass"] for gate in found["gates"]) and found["gates"], "verdict"
    assert run.returncode == (0 if found["pass"] else 1), "verdict and exit code differ"
    for level in found["levels"]:
        assert all(math.isfinite(level["indicators"][name]) for name in INDICATORS), level["indicators"]
    assert os.path.exists(os.path.join(folder, "rotating-plate.vtkhdf")), "no record"
    assert page.count("data:image/png") == 1, "one picture: there is no exact one"
    assert ">nan" not in page and ">inf" not in page, "a number that is none is shown"
    return found, run.stdout, page


def main():
    program, folder = sys.argv[1:]
    other, text, page = study(program, os.path.join(folder, "other"), "--levels", "12,50", "--set", "scheme=upwind")
    assert "run once" not in text and "another configuration" not in page, "the configuration was run beside itself"
    assert all(value is None for level in other["levels"] for value in level["errors"].values()), "compared with itself"

    found, text, page = study(program, os.path.join(folder, "beside"), "--levels", "12,20", "--set", "scheme=ulsph",
                              "--set", "integrator=ssp-rk3")
    assert "n = 50, scheme = upwind: run once" in text, "what is beside is not said"
    for label in ("n = 20, scheme = ulsph", "n = 50, scheme = upwind"):
        assert label in page, f"the legend lacks {label}"
    assert page.count('aria-label="displacement over time"') == 2, "a panel for each component"
    coarse, fine = (level["errors"] for level in found["levels"])
    for name in ("beside", "beside_abs"):
        assert 0 < fine[name] < coarse[name], f"{name}: {coarse[name]}, then {fine[name]}"
    gates = {gate["name"]: gate for gate in found["gates"]}
    assert gates["beside"]["value"] == fine["beside"], "the gate is of the finest level"
    print("the study without an oracle says what it compares")


main()
