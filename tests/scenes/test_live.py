# SPDX-License-Identifier: GPL-2.0-or-later
"""Long runs of scenes of one's own: Ctrl-C stops after the step, checkpoints keep what there is, progress() and yade.plot show it."""
import glob
import json
import os
import pty
import random
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

from yade import O, plot
from yade.wrapper import FrictMat, PyRunner

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, is_sentence, run_tests, said  # noqa: E402
from softgrain import InputError, NeoHookeanMat, checkpoints, live, progress, resume, softBox, softCloud, softEngines  # noqa: E402

SEED = int(sys.argv[sys.argv.index("--seed") + 1]) if "--seed" in sys.argv else random.randrange(10**6)
STEPS = 40000
# A packing whose top wall comes down; LINES are its engines and the run; `digits` is all that steps change, to the last digit.
SCENE = """
import sys, zlib
from softgrain import *
LOADING
    O.materials.append(NeoHookeanMat(frictionAngle=0.2))
    O.materials.append(FrictMat(frictionAngle=0.1))
    grains, height = softCloud(6e-3, 10, (1.4e-3, 2.4e-3), 0.65, 0, points=60, seed=2)
    for grain in grains:
        grain.state.angVel = (0, 0, 1)      # or they would fly as rigid bodies at first, which takes no time
    O.bodies.append(grains)
    top = O.bodies.append(softBox(6e-3, height, 1))[-1]
    O.bodies[top].state.vel = (0, -0.05, 0)
    ENGINES
print("begins", O.iter, flush=True)
RUN
soft = measures.softIntegrator()
digits = [O.time, O.dt, soft.externalWork, soft.frictionDissipation, soft.contactDissipation, soft.totalIterations]
for body in measures.softBodies():
    digits += [zlib.crc32(arrays.points(body).tobytes()), zlib.crc32(arrays.pointVelocities(body).tobytes())]
print("digits", repr(digits), flush=True)
"""
CHECKED = "O.engines = [checkpoints('packing', seconds=0.05), *softEngines()]"
TO_THE_END = f"O.run({STEPS} - O.iter, True)"


def write_scene(folder, engines=CHECKED, run=TO_THE_END, loading="if not resume('packing'):"):
    with open(os.path.join(folder, "scene.py"), "w", encoding="ascii") as file:
        file.write(SCENE.replace("LOADING", loading).replace("ENGINES", engines).replace("RUN", run))


def start(folder, threads=1, **streams):
    return subprocess.Popen(["yade", f"-j{threads}", "-n", "-x", "scene.py"], cwd=folder, text=True,
                            **(streams or {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}))


def begun(process):
    """Waits until the scene runs; the step it begins with."""
    for line in process.stdout:
        if line.startswith("begins"):
            return int(line.split()[1])
    return None


def digits_of(process):
    out, err = process.communicate(timeout=300)
    found = re.search("^digits (.*)$", out, re.MULTILINE)
    return found.group(1) if found else f"exit code {process.returncode}: {err[-500:]}"


def ctrl_c_stops_after_the_step(checks):
    for run in ("O.run(10**8, True)", "while True: O.step()"):
        with Folder() as folder:
            write_scene(folder, "O.engines = softEngines()", run, "if True:")
            process = start(folder)
            begun(process)
            time.sleep(0.5)
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=60)
            checks.that(f"{run}: KeyboardInterrupt", process.returncode not in (0, -9) and "KeyboardInterrupt" in err, err[-300:])
            write_scene(folder, CHECKED.replace("0.05", "1000"), run)
            for number in (signal.SIGINT, signal.SIGTERM):
                process = start(folder)
                before = begun(process)
                time.sleep(0.5)
                process.send_signal(number)
                _, err = process.communicate(timeout=60)
                told = err.strip().splitlines()[-1]
                checks.that(f"{run}, {number.name}: exit code and sentence",
                            process.returncode == 128 + number and is_sentence(told) and "resume('packing')" in told, told)
                stored = step_of(folder)
                checks.that(f"{run}, {number.name}: the last step is kept", f"step {stored};" in told and stored > before, (told, before))


def step_of(folder):
    with open(os.path.join(folder, "packing.json"), encoding="utf-8") as file:
        return json.load(file)["iter"]


def killed_and_resumed_to_the_last_digit(checks):
    generator = random.Random(SEED)
    with Folder() as folder:
        write_scene(folder, "O.engines = softEngines()", loading="if True:")
        whole = digits_of(start(folder))
        checks.that("whole run", whole.startswith("["), whole)
        write_scene(folder)
        begins = []
        for threads in (2, 1, 2):
            process = start(folder, threads)
            begins.append(begun(process))
            wait_for(folder, begins[-1], process)
            time.sleep(generator.uniform(0, 0.15))
            process.kill()
            process.communicate()
        checks.that("each goes on from a later checkpoint", None not in begins and sorted(set(begins)) == begins, begins)
        checks.that(f"seed {SEED}: killed thrice, with two threads and one", digits_of(start(folder)) == whole, (begins, whole))
        checks.that("one scene is left", len(glob.glob(os.path.join(folder, "*.yade"))) <= 2)


def wait_for(folder, step, process):
    """Until there is a checkpoint after this step."""
    until = time.monotonic() + 60
    while time.monotonic() < until and process.poll() is None:
        try:
            if step_of(folder) > step:
                return True
        except (OSError, ValueError):
            pass
        time.sleep(0.005)
    return False


def a_signal_asks_for_a_checkpoint(checks):
    with Folder() as folder:
        write_scene(folder, CHECKED.replace("0.05", "1000"), "O.run(10**8, True)")
        process = start(folder)
        begun(process)
        for _ in range(2):
            time.sleep(0.3)
            before = step_of(folder) if os.path.exists(os.path.join(folder, "packing.json")) else 0
            process.send_signal(signal.SIGUSR1)
            checks.that("SIGUSR1 writes a checkpoint", wait_for(folder, before, process))
        checks.that("and the run goes on", process.poll() is None)
        process.kill()
        process.communicate()


def damaged_and_foreign_checkpoints(checks):
    with Folder() as folder:
        here = os.getcwd()
        os.chdir(folder)
        try:
            write_scene(folder, run="O.run(30000, True)")
            process = start(folder)
            digits_of(process)
            checks.that("nothing to resume", resume("none") is False)
            scene = glob.glob("packing-*.yade")[0]
            for what, file, change, words in (
                    ("a damaged scene", scene, lambda data: data[:1000] + b"x" + data[1001:], [scene, "damaged"]),
                    ("half a scene", scene, lambda data: data[:len(data) // 2], [scene, "damaged"]),
                    ("a damaged json", "packing.json", lambda data: data.replace(b'"iter": ', b'"iter": 1'), ["packing.json", "damaged"]),
                    ("no json", "packing.json", lambda data: b"{}", ["packing.json", "damaged"]),
                    ("a list", "packing.json", lambda data: b"[1]", ["packing.json"])):
                shutil.copy(file, "kept")
                with open("kept", "rb") as kept, open(file, "wb") as damaged:
                    damaged.write(change(kept.read()))
                checks.raises(what, InputError, words, lambda: resume("packing"))
                shutil.copy("kept", file)
            os.rename(scene, "kept")
            checks.raises("no scene", InputError, [scene, "missing"], lambda: resume("packing"))
            os.rename("kept", scene)
            from softgrain.records import read_json, sealed, write_json
            write_json("packing.json", sealed({**read_json("packing.json"), "versions": {"softgrain": "0.0.1", "yade": "2020"}}))
            checks.raises("another version", InputError, ["softgrain 0.0.1", "yade 2020"], lambda: resume("packing"))
            checks.raises("a folder that is not there", InputError, ["/none"], lambda: checkpoints("/none/packing"))
            checks.raises("no time", InputError, ["seconds", "0"], lambda: checkpoints("packing", 0))
        finally:
            os.chdir(here)
            O.reset()


def an_engine_in_the_middle_of_a_step_is_refused(checks):
    with Folder() as folder:
        write_scene(folder, "O.engines = softEngines(more=[checkpoints('packing', seconds=0.05)])")
        told = digits_of(start(folder))
        checks.that("checkpoints() behind others", "behind ForceResetter" in told and "[checkpoints('packing'), *softEngines()]" in told, told)


def progress_on_a_terminal(checks):
    engines = "O.engines = softEngines(more=[progress(show=SHOW, seconds=0.1)])\n    O.stopAtIter = 45000"
    with Folder() as folder:
        write_scene(folder, engines.replace("SHOW", "None"), "O.run(wait=True)", "if True:")
        shown = on_a_terminal(folder)
        for what, pattern in (("a bar", r"\[#+-+\] +\d+ %"), ("time", r"\d+ s to go"), ("steps a second", r"\d+ steps/s"),
                              ("strain", r"strain 0\.\d+"), ("solid fraction", r"phi 0\.\d+"), ("stress", r"[\d.]+ kPa")):
            checks.that(f"progress shows {what}", re.search(pattern, shown), shown[-600:])
        lines = [line.rstrip() for line in re.split("\r\x1b\\[K|\n", shown) if " %  " in line]
        checks.that("a line is no longer than the terminal", max(map(len, lines)) < 80, max(lines, key=len))
        shares = [int(re.search(r"(\d+) %", line).group(1)) for line in lines]
        checks.that("the share grows", shares == sorted(shares) and shares[-1] > shares[0], shares)
        process = start(folder)
        out, _ = process.communicate(timeout=300)
        checks.that("quiet without a terminal", process.returncode == 0 and "%" not in out, out)
        write_scene(folder, engines.replace("SHOW", "'f\"height {O.bodies[top].state.pos[1] * 1e3:.2f} mm\"'"), "O.run(wait=True)", "if True:")
        checks.that("words of one's own", re.search(r"height \d\.\d\d mm", on_a_terminal(folder)))
    for name in ("share", "show"):
        checks.raises(f"{name} is no expression", InputError, [name, "'O.time /'"], lambda: progress(**{name: "O.time /"}))
    checks.raises("nor a function", InputError, ["share"], lambda: progress(share=len))


def on_a_terminal(folder):
    """What a scene writes to a terminal of 80 columns."""
    ours, theirs = pty.openpty()
    process = start(folder, stdout=theirs, stderr=theirs, stdin=theirs)
    os.close(theirs)
    said_so_far = b""
    while True:
        try:
            more = os.read(ours, 4096)
        except OSError:     # its end is closed
            break
        if not more:
            break
        said_so_far += more
    process.wait(timeout=60)
    os.close(ours)
    return said_so_far.decode(errors="replace")


def plots_live(checks):
    """YADE's own thread that keeps a plot up to date, on matplotlib's backend without a display."""
    O.reset()
    plot.reset()
    O.materials.append([NeoHookeanMat(), FrictMat()])
    grains, height = softCloud(6e-3, 10, (1.4e-3, 2.4e-3), 0.65, 0, points=60, seed=2)
    O.bodies.append(grains)
    global top
    top = O.bodies.append(softBox(6e-3, height, 1))[-1]
    O.bodies[top].state.vel = (0, -1, 0)
    O.engines = softEngines(more=[PyRunner(command="plot.addData(t=O.time, force=O.forces.f(top)[1])", iterPeriod=20)])
    vars(sys.modules["__main__"]).update(plot=plot, top=top)
    plot.plots, plot.live, plot.liveInterval = {"t": ("force",)}, True, 0.05
    O.run(100, True)
    figure = plot.plot(noShow=True)
    thread = threading.Thread(target=plot.liveUpdate, args=(time.time(),), daemon=True)
    thread.start()
    lengths, until = [0], time.monotonic() + 60
    for _ in range(3):
        O.run(1000, True)
        while lengths[-1] != len(plot.data["t"]) and time.monotonic() < until:
            time.sleep(0.05)
            lengths.append(len(figure.axes[0].lines[0].get_xdata()))
        checks.that("what is computed is drawn", lengths[-1] == len(plot.data["t"]), (lengths, len(plot.data["t"])))
    checks.that("lines grow while it runs", lengths[-1] > 100, lengths)
    plot.live = False
    thread.join(timeout=10)
    checks.that("it ends when told", not thread.is_alive())
    plot.reset()
    O.reset()


def nothing_is_taken_from_another_owner(checks):
    import socket

    ours, theirs = socket.socketpair()
    theirs.setblocking(False)
    before = signal.set_wakeup_fd(theirs.fileno())
    count = threading.active_count()
    live.watch_for_interrupts()
    checks.that("the pipe of signals stays its owner's", signal.set_wakeup_fd(before) == theirs.fileno() and threading.active_count() == count)
    ours.close()
    theirs.close()


print(f"seed {SEED}")
run_tests(ctrl_c_stops_after_the_step, killed_and_resumed_to_the_last_digit, a_signal_asks_for_a_checkpoint, damaged_and_foreign_checkpoints,
          an_engine_in_the_middle_of_a_step_is_refused, progress_on_a_terminal, plots_live, nothing_is_taken_from_another_owner)
