"""restart.py TEST ASSAY FOLDER: runs of the program that are stopped, killed, or out of disk, and gone on with. What
comes out in the end must be, byte for byte, what a run gives that was never stopped."""
import os
import pathlib
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import time

SCENE = """title = "tiny"
dim = 2
domain = {{ lower = {{0, 0}}, upper = {{1, 1}} }}
n = 4
material = {{ model = "neo-hookean", E = 3, nu = 0.3, rho = 2 }}
t_end = {t_end} -- s
stencil, integrator, cfl, evolved = "sbp2", "tvd-rk2", 0.3, "pF"
history = 200
snapshots = {{ {t_end} / 3 }}
probes = {{ {{ name = "corner", X = {{1, 1}} }} }}
initial = {{ velocity = function(X, Y) return 0.01 * X, -0.02 * Y * X end }}
"""
RECORD, CHECKPOINT = "out/tiny.vtkhdf", "out/tiny.checkpoint"
SHORT, ENDLESS = 300, 1e7  # s: a second; far more than any test takes
RUN = ["run", "../tiny.lua", "--out", "out"]


class Place:
    """A scene, and folders beside it in which the program runs."""

    def __init__(self, assay, folder):
        self.assay = os.path.abspath(assay)
        self.folder = pathlib.Path(folder).absolute()
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def scene(self, t_end):
        (self.folder / "tiny.lua").write_text(SCENE.format(t_end=t_end), encoding="utf-8")

    def at(self, name):
        (self.folder / name).mkdir(exist_ok=True)
        return self.folder / name

    def start(self, name, words, limit=None, isa=None):
        def prepare():
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                signal.signal(number, signal.SIG_DFL)
            if limit is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

        return subprocess.Popen([self.assay, *words], cwd=self.at(name), stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, preexec_fn=prepare,
                                env=os.environ | ({"ASSAY_ISA": isa} if isa else {}))

    def run(self, name, words, code=0, text="", limit=None, isa=None):
        return self.end(self.start(name, words, limit, isa), code, text)

    def end(self, process, code, text=""):
        out, err = process.communicate()
        if process.returncode != code or text not in out + err:
            sys.exit(f"FAIL: {process.args[1:]}: exit code {process.returncode}, expected {code} and \"{text}\"\n{out}{err}")
        return err

    def same(self, one, other, what=RECORD):
        if (self.at(one) / what).read_bytes() != (self.at(other) / what).read_bytes():
            sys.exit(f"FAIL: {what}: other bytes in {other} than in {one}")


def wait_for(what, process):
    while not what():
        if process.poll() is not None:
            sys.exit(f"FAIL: ended too early: {process.communicate()}")
        time.sleep(0.002)


def watches(process):
    """Whether the program has come to where it notes signals."""
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="utf-8")
    caught = int(next(line for line in status.splitlines() if line.startswith("SigCgt")).split()[1], 16)
    return caught >> (signal.SIGTERM - 1) & 1


def checksum(data):
    total = 0xcbf29ce484222325
    for (word,) in struct.iter_unpack("<Q", data):
        total = (total ^ word) * 0x100000001b3 & 0xffffffffffffffff
        total ^= total >> 32
    return total


def check_whole(path):
    data = path.read_bytes()
    if data[-16:-8] != b"assaySUM" or struct.unpack("<Q", data[-8:])[0] != checksum(data[:-16]):
        sys.exit(f"FAIL: {path} is not whole")


def step_of(path):
    """The step that a checkpoint stands at."""
    data = path.read_bytes()
    return struct.unpack_from("<Q", data, data.index(b"step".ljust(48, b"\0")) + 64)[0]


def killed(place):
    """kill -9 at fifty moments, each time going on from what is there."""
    moments = random.Random(7)
    place.scene(SHORT)
    place.run("straight", RUN)
    checkpoint = place.at("killed") / CHECKPOINT
    process = place.start("killed", [*RUN, "--checkpoint", "1"])
    wait_for(checkpoint.exists, process)
    cut = set() # what was being written when it was killed
    for _ in range(50):
        time.sleep(moments.uniform(0, 0.01))
        process.kill()
        place.end(process, -signal.SIGKILL)
        check_whole(checkpoint)
        cut.update(checkpoint.parent.glob("*.partial-*"))
        before = checkpoint.stat().st_mtime_ns
        process = place.start("killed", ["run", "--restart", CHECKPOINT])
        wait_for(lambda old=before: checkpoint.stat().st_mtime_ns != old, process)
    process.kill()
    process.communicate()
    print(f"the last at step {step_of(checkpoint)}; {len(cut)} while it wrote")
    left, living = (pathlib.Path(f"{checkpoint}.partial-{number}") for number in (process.pid, os.getpid()))
    left.touch()
    living.touch()
    place.run("killed", ["run", "--restart", CHECKPOINT, "--checkpoint", "1h"])
    if list(checkpoint.parent.glob("*.partial-*")) != [living]:
        sys.exit("FAIL: what the dead have left is to be swept away, and nothing else")
    place.same("straight", "killed")


def stopped(place):
    """Each signal stops a run, which then goes on with another number of threads."""
    place.scene(SHORT)
    place.run("straight", [*RUN, "--set", "threads=1"])
    for number, threads in ((signal.SIGINT, 2), (signal.SIGTERM, 1), (signal.SIGHUP, 2)):
        name = signal.Signals(number).name
        checkpoint = place.at(name) / CHECKPOINT
        process = place.start(name, [*RUN, "--set", "threads=1", "--checkpoint", "1"]) # so slow that it is caught
        wait_for(checkpoint.exists, process)
        process.send_signal(number)
        said = place.end(process, -number, f"stopped by {name} at step ")
        if "assay run --restart out/tiny.checkpoint goes on from step " not in said:
            sys.exit(f"FAIL: no command to go on: {said}")
        place.run(name, ["run", "--restart", CHECKPOINT, "--set", f"threads={threads}", "--checkpoint", "1h"])
        place.same("straight", name)
        place.same("straight", name, "out/tiny.xdmf")
        place.same("straight", name, "out/tiny.png")


def twice(place):
    """A second signal ends the program at once: nothing is said, and what was there stays."""
    place.scene(ENDLESS)
    checkpoint = place.at("twice") / CHECKPOINT
    process = place.start("twice", [*RUN, "--checkpoint", "0.05s"])
    wait_for(checkpoint.exists, process)
    process.send_signal(signal.SIGSTOP)
    process.send_signal(signal.SIGINT)
    process.send_signal(signal.SIGTERM)
    process.send_signal(signal.SIGCONT)
    out, err = process.communicate()
    if process.returncode not in (-signal.SIGINT, -signal.SIGTERM) or "stopped by" in out + err:
        sys.exit(f"FAIL: exit code {process.returncode}: {out}{err}")
    check_whole(checkpoint)


def burst(place):
    """One signal that comes twice, as from timeout(1), is one wish: the run is kept."""
    place.scene(ENDLESS)
    for name in ("a", "b", "c"):
        process = place.start(name, [*RUN, "--checkpoint", "1h"])
        wait_for(lambda started=process: watches(started), process)
        process.send_signal(signal.SIGTERM)
        time.sleep(2e-4)
        process.send_signal(signal.SIGTERM)
        out, err = process.communicate()
        if process.returncode != -signal.SIGTERM or not (place.at(name) / CHECKPOINT).exists():
            sys.exit(f"FAIL: exit code {process.returncode}, nothing is kept: {out}{err}")
        check_whole(place.at(name) / CHECKPOINT)


def over(place):
    """A signal that comes while the record of a run that is over is written: the record is there, and no less of it."""
    place.scene(SHORT)
    words = ["run", "swinging-cube", "--set", "n=30", "--set", "t_end=1e-6", "--set", "snapshots={}", "--out", "out"]
    place.run("straight", words)
    size = (place.at("straight") / "out/swinging-cube.vtkhdf").stat().st_size
    folder = place.at("over") / "out"
    process = place.start("over", words)
    wait_for(lambda: list(folder.glob("swinging-cube.vtkhdf.partial-*")), process)
    process.send_signal(signal.SIGTERM)
    place.end(process, -signal.SIGTERM)
    if sorted(os.listdir(folder))[:1] != ["swinging-cube.vtkhdf"] or list(folder.glob("*.vtkhdf.partial-*")):
        sys.exit(f"FAIL: the record is not there: {sorted(os.listdir(folder))}")
    if (folder / "swinging-cube.vtkhdf").stat().st_size != size:
        sys.exit("FAIL: the record is not whole")


def unasked(place):
    """Without --checkpoint a run is kept when it has gone on for five seconds, and not before."""
    place.scene(ENDLESS)
    for name, seconds, text in (("young", 0, "nothing is kept of a run of less than 5 s"),
                                ("old", 5, "assay run --restart out/tiny.checkpoint goes on from step ")):
        process = place.start(name, RUN)
        wait_for(lambda started=process: watches(started), process)
        process.send_signal(signal.SIGSTOP)
        time.sleep(seconds)
        process.send_signal(signal.SIGTERM)
        process.send_signal(signal.SIGCONT)
        place.end(process, -signal.SIGTERM, text)
        if (place.at(name) / CHECKPOINT).exists() != (name == "old"):
            sys.exit(f"FAIL: {name}: checkpoint is there or not")
    check_whole(place.at("old") / CHECKPOINT)


def full(place):
    """A disk that takes no more is said once, and leaves what was there; nothing half-written lies about."""
    place.scene(SHORT)
    place.run("full", [*RUN, "--checkpoint", "3000"])
    folder = place.at("full") / "out"
    before = (folder / "tiny.checkpoint").read_bytes()
    files = sorted(os.listdir(folder))
    said = place.run("full", [*RUN, "--checkpoint", "100"], 2, "the run goes on", 2000)
    if said.count("cannot write out/tiny.checkpoint: File too large") != 1:
        sys.exit(f"FAIL: expected to be told once: {said}")
    if (folder / "tiny.checkpoint").read_bytes() != before or sorted(os.listdir(folder)) != files:
        sys.exit(f"FAIL: not as it was: {sorted(os.listdir(folder))}")
    place.scene(ENDLESS)
    process = place.start("none", [*RUN, "--checkpoint", "1h"], 1000)
    wait_for(lambda: watches(process), process)
    process.send_signal(signal.SIGTERM)
    said = place.end(process, -signal.SIGTERM, "stopped by SIGTERM at step ")
    if "cannot write out/tiny.checkpoint" not in said or "--restart" in said:
        sys.exit(f"FAIL: nothing can be gone on from: {said}")


def refused(place):
    """Scenes that have changed, other versions, damaged files, other keys."""
    place.scene(SHORT)
    place.run("straight", [*RUN, "--checkpoint", "3000"])
    checkpoint = place.at("straight") / CHECKPOINT
    data = checkpoint.read_bytes()
    again = ["run", "--restart", "../straight/out/tiny.checkpoint", "--out", "out"]
    place.scene(SHORT + 1)
    place.run("again", again, 2, "tiny.lua: has changed since the run began")
    place.run("again", [*again, "--as-stored"])
    place.same("straight", "again")
    (place.folder / "tiny.lua").unlink()
    place.run("gone", again)
    place.same("straight", "gone")
    place.run("again", [*again, "--set", "n=8"], 2, "only threads may be set anew")
    place.run("again", [*again, "swinging-cube"], 2, "the checkpoint holds the scene")
    place.run("again", ["run", "swinging-cube", "--as-stored"], 2, "belongs to --restart")
    place.run("again", ["run", "swinging-cube", "--checkpoint", "5 parsecs"], 2, "a number of steps, or a time")
    at = data.index(b"version\0") + 64
    other = data[:at] + b"0.0.9\0\0\0"[:8] + data[at + 8:-16]
    checkpoint.write_bytes(other + b"assaySUM" + struct.pack("<Q", checksum(other)))
    place.run("again", again, 2, "assay 0.0.9 wrote it, and this is assay")
    at = data.index(b"build\0") + 64
    other = data[:at] + b"YYY" + data[at + 3:-16]
    checkpoint.write_bytes(other + b"assaySUM" + struct.pack("<Q", checksum(other)))
    place.run("again", again, 2, "a build by YYY")
    # Terminals obey what stands in a file only if it reaches them as it is.
    other = data[:-16].replace(b"tiny.lua\0", b"ti\033[2J.a\0") # in the path, and in the command
    checkpoint.write_bytes(other + b"assaySUM" + struct.pack("<Q", checksum(other)))
    place.run("again", [*again, "--as-stored"], 2, "ti?[2J.a: the path holds control characters")
    checkpoint.write_bytes(data)
    if "baseline" not in subprocess.check_output([place.assay, "--version"], text=True): # there are other loops
        place.run("again", again, 2, "those for baseline have separate ones", isa="baseline")
    checkpoint.write_bytes(data[:-1000])
    place.run("again", again, 2, "cut short, damaged, or changed")
    checkpoint.write_bytes(data[:1000] + b"x" + data[1001:])
    place.run("again", again, 2, "cut short, damaged, or changed")
    place.run("again", ["run", "--restart", "../straight/out/tiny.vtkhdf"], 2, "no checkpoint that assay wrote")
    place.run("again", ["run", "--restart", "nothing"], 2, "cannot read nothing: No such file")


def study(place):
    """A study that is stopped writes nothing."""
    process = place.start("study", ["verify", "swinging-cube", "--levels", "8,12", "--set", "cfl=1e-4", "--out", "out"])
    wait_for(lambda: watches(process), process)
    process.send_signal(signal.SIGINT)
    place.end(process, -signal.SIGINT, "swinging-cube, n = 8: stopped by SIGINT at step ")
    if os.listdir(place.at("study") / "out"):
        sys.exit(f"FAIL: there is {os.listdir(place.at('study') / 'out')}")


TESTS = {test.__name__: test for test in (killed, stopped, twice, burst, over, unasked, full, refused, study)}

if __name__ == "__main__":
    TESTS[sys.argv[1]](Place(sys.argv[2], sys.argv[3]))
