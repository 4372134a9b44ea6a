"""stopped.py TEST ASSAY FOLDER: measurements that are stopped by a signal keep what they have, say that it is not all, and
leave by the signal."""
import json
import os
import signal
import sys
import time

sys.dont_write_bytecode = True
from restart import Place, wait_for, watches  # noqa: E402


def demand(condition, what):
    if not condition:
        sys.exit(f"FAIL: {what}")


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def lines_until(process, found):
    """What the program prints up to the first line that is found."""
    lines = []
    for line in process.stdout:
        lines.append(line)
        if found(line):
            return lines
    sys.exit(f"FAIL: ended too early: {''.join(lines)}{process.stderr.read()}")


def stop(place, process, number, text):
    process.send_signal(number)
    out, err = process.communicate()
    demand(process.returncode == -number and text in err, f"exit code {process.returncode}, expected \"{text}\": {out}{err}")
    return out, err


def extremes(place):
    """Rows that were told before stand in the table and in the file, and no others: of one that was being driven there is
    nothing. The extremes are told in the same order again."""
    process = place.start("extremes", ["extremes", "--json", "map.json"])
    before = lines_until(process, lambda line: line.startswith("ok"))
    out, _ = stop(place, process, signal.SIGINT, "extremes: stopped by SIGINT during cfl; the ")
    rows = [line for line in before + out.splitlines() if line.startswith(("ok", "FAIL"))]
    told = read(place.at("extremes") / "map.json")
    demand(told["stopped_by"] == "SIGINT" and told["unfinished"] == "cfl" and told["pass"] is None, f"{told}")
    demand(0 < len(told["rows"]) == len(rows) < 128, f"{len(told['rows'])} rows in the file, {len(rows)} printed")
    for row, line in zip(told["rows"], rows):
        demand(row["what"] in line and row["pass"] is True, f"{row} and {line}")
    demand("not all were measured" in out, out)


def cost(place):
    """The item at hand is the last: the scene as it is, or one more where the signal is late; there are five."""
    process = place.start("cost", ["cost", "swinging-cube", "--set", "n=8", "--set", "balance=true", "--json", "cost.json"])
    wait_for(lambda: watches(process), process)
    out, err = stop(place, process, signal.SIGTERM, "cost: stopped by SIGTERM; what is printed and written was measured before")
    demand("stopping after this step, or when the run is set up or its record written" in err, err)  # what it waits for may be either
    part = read(place.at("cost") / "cost.json")
    demand(part["stopped_by"] == "SIGTERM" and len(part["without"]) < 3, f"{part['stopped_by']}, {part['without']}")
    demand(part["ns_per_particle_step"] > 0 and part["bytes_per_particle"] > 0 and part["history"]["ns_per_row"] is None,
           f"{part}")
    demand("Stopped by SIGTERM: other items" in out, out)


BAR = ["trade", "plastic-wave", "--vary", "stencil=sbp2,sbp4", "--vary", "evolved=pF,pFHJ", "--set", "scheme=upwind",
       "--set", "precision=double", "--vary", "integrator=tvd-rk2", "--vary", "cfl=0.4", "--budget", "100", "--out", "out"]
PICK = ["run", "plastic-wave", "--set", "scheme=upwind", "--set", "precision=double", "--out", "out", "--error"]


def trade(place):
    """What was measured can be chosen from, if it is named; a study that was not stopped keeps its place."""
    place.run("trade", [*BAR, "--levels", "20"])
    folder = place.at("trade") / "out"
    before = (folder / "trade.tsv").read_bytes()
    process = place.start("trade", [*BAR, "--levels", "25,20000,40000"])
    words = lines_until(process, lambda line: line.split()[:1] == ["25"])[-1].split() # n, runs, measured, ...
    time.sleep(0.5) # into a run of a minute
    out, _ = stop(place, process, signal.SIGINT, f"plastic-wave: stopped by SIGINT: {words[2]} of ")
    demand("not begun: n = 40000" in out and "the study was stopped before it was done" in out, out)
    found = read(folder / "trade-stopped.json")
    demand(found["stopped_by"] == "SIGINT" and [run["n"] for run in found["runs"]] == int(words[2]) * [25],
           f"{found['runs']}")
    demand(found["left_out"] and all(run["why"] for run in found["left_out"]), f"{found['left_out']}")
    demand("The study was stopped by SIGINT: " in (folder / "trade-stopped.html").read_text(encoding="utf-8"), "html")
    demand((folder / "trade.tsv").read_bytes() == before, "the study before it was overwritten")
    stopped = ["--study", "out/trade-stopped.tsv"]
    place.run("trade", [*PICK, "0.5", *stopped], 0, "The study was stopped by SIGINT: of what it did not measure")
    place.run("trade", [*PICK, "1e-7", *stopped], 2, "a study with larger --levels, or one that is not stopped, may reach it")


def trade_at_once(place):
    """Before anything was measured there is nothing to keep."""
    process = place.start("early", [*BAR, "--levels", "40000"])
    wait_for(lambda: watches(process), process)
    stop(place, process, signal.SIGHUP, "stopped by SIGHUP before the scene's own configuration was measured; nothing is kept")
    demand(os.listdir(place.at("early") / "out") == [], f"{os.listdir(place.at('early') / 'out')}")


TESTS = {test.__name__: test for test in (extremes, cost, trade, trade_at_once)}

if __name__ == "__main__":
    signal.alarm(60) # a program that is not stopped must not keep us
    TESTS[sys.argv[1]](Place(sys.argv[2], sys.argv[3]))
