"""study_json.py PROGRAM FOLDER WORD...: runs `PROGRAM verify WORD... --json FILE` and checks the file: its shape, its
numbers, and that verdict, gates and exit code agree. Then spoils a copy in every way it knows and must refuse each."""
import json
import math
import os
import subprocess
import sys

TOP = {"scene", "oracle", "scheme", "stencil", "levels", "rates", "convergence", "gates", "pass"}
LEVEL = {"n", "h", "particles", "steps", "seconds", "ns_per_particle_step", "errors", "snapshots", "figures", "indicators"}
SNAPSHOT = {"t", "errors"}
INDICATORS = {"clumping", "checkerboard", "linear momentum", "angular momentum", "energy gain"}
FIGURE = {"measured", "exact", "error"}
EXTRAPOLATED = {"extrapolated", "uncertainty", "index", "order", "ratio", "state"}
STATES = {"unmeasured", "equal", "oscillating", "diverging", "unsettled", "one order", "asymptotic"}
GATE = {"name", "value", "bound", "op", "pass"}
STATE = {f + e for f in ("p", "P", "P_all", "u", "F", "H", "J", "sigma", "sigma_all", "v", "pressure") for e in ("", "_abs", "_max", "_abs_max", "_l1")}
NORMS = ("", "_abs", "_max", "_abs_max", "_l1")
ONE_D = {"H" + e for e in ("", "_abs", "_max", "_abs_max", "_l1")}  # the cofactor is 1: nothing to compare
PROBES, PROBES_Y = {"probes" + e for e in NORMS}, {"probes_y" + e for e in NORMS}  # the latter not in 1D
ERRORS = STATE | PROBES


def demand(condition, what):
    if not condition:
        raise ValueError(what)


def is_number(value):
    return type(value) in (int, float) and math.isfinite(value)


def check_snapshots(level):
    times = [snapshot["t"] for snapshot in level["snapshots"]]
    demand(times == sorted(set(times)), f"snapshots at {times}")
    state = set(level["errors"]) & STATE
    for snapshot in level["snapshots"]:
        demand(set(snapshot) == SNAPSHOT, f"keys of a snapshot: {sorted(snapshot)}")
        demand(set(snapshot["errors"]) == state, f"errors of a snapshot: {sorted(snapshot['errors'])}")
    for name in state if times else ():
        worst = max(snapshot["errors"][name] for snapshot in level["snapshots"])
        demand(level["errors"]["snapshots_" + name] == worst, f"snapshots_{name} is not {worst}")


def check_figures(level):
    for name, figure in level["figures"].items():
        demand(set(figure) == FIGURE, f"keys of figure {name}: {sorted(figure)}")
        demand(all(is_number(value) for value in figure.values()), f"figure {name} = {figure}")
        error = abs(figure["measured"] / figure["exact"] - 1) if figure["exact"] != 0 else abs(figure["measured"])
        demand(math.isclose(error, figure["error"], abs_tol=1e-12), f"error of figure {name} is not {error}")


def check_level(level):
    demand(set(level) == LEVEL, f"keys of a level: {sorted(level)}")
    for key in ("n", "particles", "steps"):
        demand(type(level[key]) is int and level[key] > 0, f"level {key} = {level[key]}")
    for key in ("h", "seconds", "ns_per_particle_step"):
        demand(is_number(level[key]) and level[key] >= 0, f"level {key} = {level[key]}")
    names = ERRORS | {"snapshots_" + name for name in STATE if level["snapshots"]}
    one_d = {name for name in names if name.replace("snapshots_", "") not in ONE_D}
    demand(set(level["errors"]) in (one_d, names, names | PROBES_Y), f"names of errors: {sorted(level['errors'])}")
    check_snapshots(level)
    check_figures(level)
    demand(set(level["indicators"]) == INDICATORS, f"indicators: {sorted(level['indicators'])}")
    for name in ("clumping", "checkerboard"):  # where momentum or energy is not known the others are null
        demand(is_number(level["indicators"][name]), f"indicator {name} = {level['indicators'][name]}")
    demand(all(value is None or is_number(value) for value in level["indicators"].values()), "indicators")
    for name, value in level["errors"].items():
        demand(is_number(value) and value > 0, f"error {name} = {value}")
    per_step = 1e9 * level["seconds"] / (level["particles"] * level["steps"])
    demand(math.isclose(per_step, level["ns_per_particle_step"], rel_tol=1e-9), "time per particle-step")


def errors_of(level):
    return {**level["errors"], **{"figure " + name: figure["error"] for name, figure in level["figures"].items()},
            **{"indicator " + name: value for name, value in level["indicators"].items()}}


def check_gate(gate, study):
    demand(set(gate) == GATE, f"keys of a gate: {sorted(gate)}")
    demand(gate["op"] in ("<=", ">=") and is_number(gate["bound"]), f"gate {gate}")
    rate = gate["name"].startswith("rate ")
    source = study["rates"] if rate else errors_of(study["levels"][-1])
    demand(gate["value"] == source[gate["name"][5 if rate else 0:]], f"value of gate {gate['name']}")
    holds = gate["value"] <= gate["bound"] if gate["op"] == "<=" else gate["value"] >= gate["bound"]
    demand(gate["pass"] is holds, f"gate {gate['name']} says {gate['pass']}")


def check_extrapolated(name, figure, levels):
    """What Richardson's formulas say of the three finest levels, by other arithmetic than the program's."""
    demand(set(figure) == EXTRAPOLATED and figure["state"] in STATES, f"figure {name} extrapolated: {figure}")
    (h3, f3), (h2, f2), (h1, f1) = [(level["h"], level["figures"][name]["measured"]) for level in levels[-3:]]
    numbers = [figure[key] for key in sorted(EXTRAPOLATED - {"state"})]
    if figure["state"] in ("unmeasured", "equal", "oscillating", "diverging"):
        demand(all(value is None for value in numbers), f"figure {name}: {figure}")
        demand(f1 == f2 or (f3 - f2) / (f2 - f1) < math.log(h3 / h2) / math.log(h2 / h1), f"figure {name} closes in")
        return
    demand(all(is_number(value) for value in numbers), f"figure {name}: {figure}")
    fine, coarse = (h2 / h1) ** figure["order"], (h3 / h2) ** figure["order"]
    demand(math.isclose((f3 - f2) / (f2 - f1), fine * (coarse - 1) / (fine - 1), rel_tol=1e-9), f"order of figure {name}")
    change = (f1 - f2) / (fine - 1)
    demand(math.isclose(figure["extrapolated"], f1 + change, rel_tol=1e-9), f"limit of figure {name}")
    demand(math.isclose(figure["uncertainty"], 1.25 * abs(change), rel_tol=1e-9), f"uncertainty of figure {name}")
    demand(math.isclose(figure["index"], 1.25 * abs(change / f1), rel_tol=1e-9), f"index of figure {name}")
    errors = [level["figures"][name]["error"] for level in levels[-3:]]
    orders = [math.log(errors[0] / errors[1]) / math.log(h3 / h2), math.log(errors[1] / errors[2]) / math.log(h2 / h1)]
    if len(levels) == 3:
        settled = min(orders) > 0 and abs(orders[0] - orders[1]) <= 0.1 * orders[1] and abs(figure["ratio"] - 1) <= 0.1
        demand(figure["state"] == ("one order" if settled else "unsettled"), f"figure {name} is {figure['state']}: {orders}")
    demand(math.isclose(figure["ratio"], abs(f1 / f2), rel_tol=1e-6), f"ratio of figure {name}")


def check_convergence(study):
    convergence, levels = study["convergence"], study["levels"]
    demand(set(convergence) == {"errors", "figures"}, f"convergence: {sorted(convergence)}")
    if len(levels) < 3:
        demand(convergence == {"errors": {}, "figures": {}}, "convergence of two levels")
        return
    demand(set(convergence["errors"]) == set(levels[-1]["errors"]), "names of errors that converge")
    demand(set(convergence["figures"]) == set(levels[-1]["figures"]), "names of figures that converge")
    for name, error in convergence["errors"].items():
        demand(set(error) == {"orders", "state"} and error["state"] in STATES, f"convergence of {name}: {error}")
        orders = [math.log(a["errors"][name] / b["errors"][name]) / math.log(a["h"] / b["h"])
                  for a, b in zip(levels[-3:], levels[-2:])]
        demand(all(math.isclose(*pair, abs_tol=1e-9) for pair in zip(error["orders"], orders)), f"orders of {name}")
        settled = min(orders) > 0 and abs(orders[0] - orders[1]) <= 0.1 * orders[1]
        demand((error["state"] == "asymptotic") is settled, f"state of {name}: {error}")
    for name, figure in convergence["figures"].items():
        check_extrapolated(name, figure, levels)


def check(study, code):
    demand(set(study) == TOP, f"keys: {sorted(study)}")
    for key in ("scene", "oracle", "scheme", "stencil"):
        demand(type(study[key]) is str and study[key] != "", f"{key} = {study[key]}")
    demand(len(study["levels"]) >= 2, "at least two levels")
    for level in study["levels"]:
        check_level(level)
    demand(all(set(level["errors"]) == set(study["levels"][0]["errors"]) for level in study["levels"]), "names differ")
    silent = [{name for name, value in level["indicators"].items() if value is None} for level in study["levels"]]
    demand(all(names == silent[0] for names in silent), f"indicators that say nothing: {silent}")
    coarse, fine = study["levels"][-2:]
    errors_before, errors = errors_of(coarse), errors_of(fine)
    demand(set(study["rates"]) == {name for name in errors if not name.startswith("indicator ")}, "names of rates")
    for name, rate in study["rates"].items():
        order = math.log(errors_before[name] / errors[name]) / math.log(coarse["h"] / fine["h"])
        demand(is_number(rate) and math.isclose(rate, order, abs_tol=1e-9), f"rate {name} = {rate}, not {order}")
    check_convergence(study)
    demand(len(study["gates"]) > 0, "at least one gate")
    for gate in study["gates"]:
        check_gate(gate, study)
    demand(study["pass"] is all(gate["pass"] for gate in study["gates"]), f"pass = {study['pass']}")
    demand(code == (0 if study["pass"] else 1), f"exit code {code} with pass = {study['pass']}")


def places(value, path=()):
    """Every place in the document, as a path of keys."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield path + (key,)
        yield from places(inner, path + (key,))


def spoiled(study):
    """The study with one thing wrong at a time: a key gone, a value of the wrong kind, an unknown key. It is put right
    again when the next is asked for: to copy it all for each would take most of the time."""
    for path in list(places(study)):
        if path[-1] != 0 and isinstance(path[-1], int):
            continue  # a level or gate left out at the end can be a right study of its own
        inner = study
        for key in path[:-1]:
            inner = inner[key]
        right = inner[path[-1]]
        for wrong in ("gone", None, "?"):
            if right is wrong:
                continue  # null already
            if wrong == "gone" and isinstance(inner, dict):
                del inner[path[-1]]
            elif wrong == "gone" or (wrong == "?" and type(right) is str and path[-1] != "op"):
                continue
            else:
                inner[path[-1]] = wrong
            yield path, wrong, study
            inner[path[-1]] = right
    yield ("unknown",), "added", {**study, "unknown": 1}


def main():
    program, folder, *words = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, "study.json")
    run = subprocess.run([program, "verify", *words, "--out", folder, "--json", path], stdout=subprocess.PIPE, text=True)
    print(run.stdout)
    with open(path, encoding="utf-8") as file:
        study = json.load(file, parse_constant=lambda word: demand(False, f"{word} is no JSON"))
    check(study, run.returncode)
    with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
        demand(json.load(file) == study, "report.json is the same")
    count = 0
    for place, wrong, copied in spoiled(study):
        count += 1
        try:
            check(copied, run.returncode)
        except (ValueError, KeyError, TypeError, IndexError, AttributeError):
            continue
        raise SystemExit(f"FAIL: {'.'.join(map(str, place))} spoiled ({wrong}) was not noticed")
    check(study, run.returncode)  # all is put right
    print(f"the shape holds; {count} spoiled copies were refused")


main()
