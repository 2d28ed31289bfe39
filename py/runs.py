# SPDX-License-Identifier: GPL-2.0-or-later
"""A run and its folder: what is written when, what is overwritten, how an interrupted run goes on.

The folder of a run NAME holds NAME.csv, complete after every row; checkpoint.json, the last checkpoint, which names
the saved scene checkpoint-*.yade and the number of rows at that moment; and, once finished, summary.json."""
import contextlib
import glob
import os
import signal
import sys
import time

from yade import O

from . import shots
from .checks import InputError
from .options import MANAGEMENT
from .progress import Progress
from .data import command_of
from .records import Table, digest, read_json, sealed, write_json
from .restart import named, versions

MOST_CHECKPOINT_SHARE = 0.02    # of the wall time may go into checkpoints
CHECKPOINT = {"run", "scene", "rows", "digests", "versions", "command", "parameters", "until", "memory", "cpu_s", "wall_s", "digest"}
OWN_FILES = ("*.csv", "checkpoint*", "summary.json", "figure?.png", "snapshot_*.npz", "*.part", "*.part.*", "frames/*.npz",
             "movie.*")


class Interrupted(Exception):
    """The run was asked to stop (Ctrl-C, SIGTERM) and has written a checkpoint."""


class Run:
    """One run of the example `name`. Raises InputError for a folder that cannot be used as the options ask.

    options     of the command line; when resumed, the stored ones replace them
    memory      what the example wants to find again after --resume: a dict that json can hold
    resumed     whether the scene was loaded from a checkpoint
    table       the csv file; of a new run after begin(). Its columns are given as a list, or as a function of the options
                as they are then
    """

    def __init__(self, name, options, columns):
        self.name, self.options = name, options
        self.folder = os.path.abspath(options.out)
        self.memory, self.resumed, self.progress = {}, False, Progress(steps=lambda: O.iter)
        self._signal, self._cpu_before, self._wall_before, stored = None, 0.0, 0.0, None
        self._wanted = False
        self.command = command_of([sys.argv[0], *options.words])
        self.table, self._columns = None, columns
        self._make_folder()
        if options.resume:
            stored = self._stored()
        elif not options.force:
            self._refuse_to_overwrite()
        if stored:
            self._adopt(stored)
        self._cpu_begin, self._wall_begin = time.process_time(), time.monotonic()
        self._checkpoint_at, self._checkpoint_cost = self._wall_begin, 0.0
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._on_signal)
        signal.signal(signal.SIGUSR1, self._on_wish)

    def first_step(self):
        """The first step of a new run: what the engines then find wrong with the scene is bad input."""
        try:
            O.step()
        except RuntimeError as error:
            raise InputError(str(error)) from None

    def begin(self):
        """Takes the folder for a new run whose input has proved sound: removes what an earlier run left (its own kinds
        of file only) and opens the csv."""
        for pattern in OWN_FILES:
            for file in glob.glob(self.path(pattern)):
                os.remove(file)
        self._open_table()

    def _open_table(self, rows=0):
        columns = self._columns(self.options) if callable(self._columns) else self._columns
        self.table = Table(self.path(f"{self.name}.csv"), columns, rows)

    def path(self, file):
        """Of a file in the folder of the run."""
        return os.path.join(self.folder, file)

    def cpu_seconds(self):
        """CPU time of all threads since the run began, interruptions left out [s]."""
        return self._cpu_before + time.process_time() - self._cpu_begin

    def wall_seconds(self):
        """Wall time since the run began, interruptions left out [s]."""
        return self._wall_before + time.monotonic() - self._wall_begin

    def interrupted(self):
        """Whether Ctrl-C or SIGTERM has asked the run to stop."""
        return self._signal is not None

    def parameters(self):
        """The options that decide what is computed."""
        return {key: value for key, value in vars(self.options).items() if key not in MANAGEMENT | {"given", "words"}}

    def checkpoint(self):
        """Saves scene, memory and number of rows, in an order that leaves a whole checkpoint at every moment."""
        began, self._wanted = time.monotonic(), False
        scene = self._save_scene()
        write_json(self.path("checkpoint.json"), sealed({
            "run": self.name, "scene": scene, "rows": self.table.rows, "digests": self._digests(scene, self.table.rows),
            "versions": versions(), "command": self.command, "parameters": self.parameters(),
            "until": getattr(self.options, "until", None), "memory": self.memory, "cpu_s": self.cpu_seconds(),
            "wall_s": self.wall_seconds()}), nan=True)
        for old in glob.glob(self.path("checkpoint-*.yade")):
            if os.path.basename(old) != scene:
                os.remove(old)
        self._checkpoint_at = time.monotonic()
        self._checkpoint_cost = self._checkpoint_at - began

    def _digests(self, scene, rows):
        """Of what a checkpoint belongs to: its scene and the rows up to it."""
        table = Table.begin_of(self.path(f"{self.name}.csv"), rows + 1)
        if scene is None:
            return [digest(table)]
        with open(self.path(scene), "rb") as file:
            return [digest(table), digest(file.read())]

    def _save_scene(self):
        """Saves what the computation is at; the name of the file, for the checkpoint."""
        scene = f"checkpoint-{O.iter:09d}.yade"
        O.save(self.path(scene), quiet=True)
        return scene

    def _load_scene(self, stored):
        """Loads what _save_scene saved; `stored` is the content of checkpoint.json. Raises InputError."""
        try:
            O.load(self.path(stored["scene"]), quiet=True)
        except RuntimeError as error:
            raise InputError(f"the checkpoint {self.path(stored['scene'])} cannot be loaded ({error}): start anew with "
                             "--force.") from None

    def checkpoint_if_due(self):
        """After --checkpoint-seconds of wall time, later where checkpoints would take more than MOST_CHECKPOINT_SHARE; and when SIGUSR1 has
        asked for one."""
        interval = max(self.options.checkpoint_seconds, self._checkpoint_cost / MOST_CHECKPOINT_SHARE)
        if self._wanted or time.monotonic() - self._checkpoint_at > interval:
            self.checkpoint()

    @contextlib.contextmanager
    def computing(self):
        """Around the steps: when an engine stops them, says what is kept."""
        try:
            yield
        except RuntimeError:
            self.progress.end(f"stopped after {self.table.rows} rows, which are in {self.path(self.name)}.csv")
            raise

    def frame(self):
        """With --movie, a shot of the movie after every so many rows."""
        every = getattr(self.options, "movie", 0)
        if every and self.table.rows % every == 0:
            os.makedirs(self.path("frames"), exist_ok=True)
            shots.save(self.path(f"frames/{self.table.rows:06d}.npz"), shots.take())

    def stop(self):
        """Ends an interrupted run: checkpoint, then Interrupted with the sentence that says how to go on."""
        self.checkpoint()
        raise Interrupted(f"interrupted; continue with: yade -n -x {sys.argv[0]} --resume --out {self.options.out}")

    def finish(self, summary):
        """Ends a complete run: last checkpoint (from which a higher --until may go on) and summary.json."""
        self.checkpoint()
        write_json(self.path("summary.json"), summary)
        self.table.close()

    def _make_folder(self):
        """InputError when nothing can be written there."""
        if not self.options.out.strip():
            raise InputError("--out is empty: name a folder.")
        try:
            os.makedirs(self.folder, exist_ok=True)
            probe = self.path(f".writable-{os.getpid()}")
            with open(probe, "w", encoding="ascii"):
                pass
            os.remove(probe)
        except OSError as error:
            raise InputError(f"the output folder {self.options.out} cannot be written ({error.strerror}): give another "
                             "one with --out.") from None

    def _refuse_to_overwrite(self):
        """InputError when the folder holds a run."""
        if os.path.exists(self.path("summary.json")):
            raise InputError(f"the folder {self.options.out} holds a finished run: give another one with --out, or "
                             "overwrite it with --force.")
        if os.path.exists(self.path("checkpoint.json")):
            raise InputError(f"the folder {self.options.out} holds an unfinished run: continue it with --resume, start "
                             "anew with --force, or give another folder with --out.")

    def _stored(self):
        """The content of checkpoint.json, or None when there is no checkpoint yet."""
        try:
            stored = read_json(self.path("checkpoint.json"))
        except FileNotFoundError:
            if os.path.exists(self.path("summary.json")) and not self.options.force:
                raise InputError(f"the folder {self.options.out} holds a finished run without its checkpoint: give "
                                 "another one with --out, or overwrite it with --force.") from None
            return None
        except ValueError:
            stored = None
        if not isinstance(stored, dict) or not CHECKPOINT <= set(stored) or stored != sealed(stored):
            raise InputError(f"{self.path('checkpoint.json')} cannot be read, or another version of softgrain wrote it: "
                             "resume with that version, or start anew with --force.")
        if stored["run"] != self.name:
            raise InputError(f"the folder {self.options.out} holds a run of {stored['run']}.py, not of "
                             f"{self.name}.py: give another one with --out.")
        if stored["versions"] != versions():
            raise InputError(f"the run in {self.options.out} was saved by {named(stored['versions'])}, but this is "
                             f"{named(versions())}: resume with the versions that saved it, or start anew with "
                             "--force.")
        self._require_whole(stored)
        return stored

    def _require_whole(self, stored):
        """InputError when the scene or the table of a checkpoint are not what was saved. A damaged scene has to be found here:
        boost, which reads it, may crash on one."""
        try:
            whole = stored["digests"] == self._digests(stored["scene"], stored["rows"])
        except OSError as error:
            raise InputError(f"the checkpoint {error.filename} cannot be read ({error.strerror}): start anew with "
                             "--force.") from None
        if not whole:
            files = " or ".join(filter(None, (stored["scene"], f"the first {stored['rows']} rows of {self.name}.csv")))
            raise InputError(f"{files} in {self.options.out} changed since the checkpoint: start anew with --force.")

    def _adopt(self, stored):
        """Takes parameters, memory and scene of a checkpoint."""
        now = self.parameters()
        for key in sorted(self.options.given - MANAGEMENT):
            if key in stored["parameters"] and now[key] != stored["parameters"][key]:
                raise InputError(f"--{key.strip('_').replace('_', '-')} is {now[key]}, but the run in "
                                 f"{self.options.out} was begun with {stored['parameters'][key]}: leave the option "
                                 "away, or give another folder with --out.")
        for key, value in stored["parameters"].items():
            setattr(self.options, key, value)
        if "until" not in self.options.given and stored["until"] is not None:
            self.options.until = stored["until"]
        self._load_scene(stored)
        self._open_table(stored["rows"])
        self.memory, self.resumed, self.command = stored["memory"], True, stored["command"]
        self._cpu_before, self._wall_before = stored["cpu_s"], stored["wall_s"]
        if os.path.exists(self.path("summary.json")):
            os.remove(self.path("summary.json"))

    def _on_signal(self, number, _frame):
        self._signal = number

    def _on_wish(self, *_):
        self._wanted = True


def main(body):
    """Runs an example's function (it returns the exit code) and ends the process; what goes wrong is one sentence on
    stderr. Exit code: 0 all well, 1 a check failed or the computation stopped, 2 bad input, 130 interrupted."""
    name = os.path.basename(sys.argv[0])
    try:
        code = body()
    except ValueError as error:     # InputError, or bad input that the plugin found
        code = _say(name, error, 2)
    except Interrupted as stop:
        code = _say(name, stop, 130)
    except (RuntimeError, OSError) as error:
        code = _say(name, error, 1)
    except KeyboardInterrupt:
        code = _say(name, "interrupted.", 130)
    sys.stdout.flush()
    sys.exit(code)


def _say(name, sentence, code):
    sys.stdout.flush()
    print(f"{name}: {' '.join(str(sentence).split())}", file=sys.stderr)
    return code


def conclude(run, result, checks):
    """Writes figures and summary, prints the checks, a list of (what, holds); the exit code."""
    failed = [what for what, holds in checks if not holds]
    result["checks"] = [{"check": what, "holds": bool(holds)} for what, holds in checks]
    run.finish(result)
    if getattr(run.options, "movie", 0) and os.path.isdir(run.path("frames")):
        from . import pictures
        pictures.movie(run.path("frames"), run.path(pictures.movie_name()))
    if "strain" in run.table.columns and run.options.figures:
        from . import figures
        figures.draw([run.folder], run.folder)
    run.progress.end(f"{run.name}: {run.table.rows} rows in {run.options.out}")
    for what, holds in checks:
        print(f"  {'ok    ' if holds else 'FAILED'}  {what}")
    return 1 if failed else 0
