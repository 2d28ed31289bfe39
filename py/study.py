# SPDX-License-Identifier: GPL-2.0-or-later
"""Many runs of other examples, some at a time, each in a process of its own; a row of one csv for each. A study that was
stopped goes on with the rows that are missing."""
import dataclasses
import glob
import math
import os
import shutil
import subprocess
import tempfile
import time
import typing

from . import options as opt, summary
from .records import read_rows, shown
from .runs import Run

POLL_SECONDS = 0.05


def read_options(parser, group, quick, what):
    """The options of a study on the command line: those that the parser and its group hold already, --quick (`quick`,
    `what`: as of options.add_quick), --at-once and those of every run."""
    opt.add_quick(group, what, quick)
    parser.add_management()
    parser.add_argument("--at-once", type=opt.count, default=min(2, os.cpu_count()), metavar="N",
                        help="runs at a time, each a process of one thread")
    options = parser.read()
    options.set_quick(quick)
    return options


@dataclasses.dataclass
class Job:
    """One run of an example and its row.

    key        dict: the columns that tell this row from all others
    example    path of the script
    arguments  its options, without --out
    read       function from the folder of the finished run to the other columns, a dict
    cost       expected CPU time [s], which orders the jobs and tells the time to go
    """
    key: dict
    example: str
    arguments: list
    read: typing.Callable
    cost: float


class Study(Run):
    """A run whose rows are runs. `columns` begins with those of the jobs' keys, and ends with `status`: done, or why a
    run has no result. Raises InputError as Run does."""

    def __init__(self, name, options, columns):
        super().__init__(name, options, columns)
        if not self.resumed:
            self.begin()
            self.checkpoint()
        for left in glob.glob(self.path("run-*")):
            shutil.rmtree(left)

    def compute(self, jobs, at_once):
        """Runs the jobs that have no row yet, the dearest first. Raises Interrupted when the study is asked to stop: the
        runs under way are given up."""
        done = {self._name(row, jobs[0].key) for row in self.rows()}
        waiting = sorted((job for job in jobs if self._name(job.key, job.key) not in done), key=lambda job: job.cost)
        left, running = sum(job.cost for job in waiting), []
        self._show(left, jobs)
        try:
            while waiting or running:
                while waiting and len(running) < at_once:
                    running.append(self._start(waiting.pop()))
                for job, process, folder in list(running):
                    if process.poll() is not None:
                        running.remove((job, process, folder))
                        self._record(job, process, folder)
                        left -= job.cost
                        self._show(left, jobs)
                if self.interrupted():
                    self.stop()
                time.sleep(POLL_SECONDS)
        finally:
            for _, process, folder in running:
                process.terminate()
                process.wait()
                shutil.rmtree(folder)

    def _show(self, left, jobs):
        share = 1 - left / sum(job.cost for job in jobs)
        self.progress.show(max(share, 0.0), f"{self.table.rows} of {len(jobs)} runs")

    def rows(self):
        """All rows that are there: dicts, numbers as numbers."""
        return read_rows(self.path(f"{self.name}.csv"))

    def done(self):
        """The rows of the runs that have a result."""
        return [row for row in self.rows() if row["status"] == "done"]

    def head(self):
        """How the summary of every study begins: as that of every run, and how many runs it is made of, what they cost,
        the rows of those without a result."""
        rows, done = self.rows(), self.done()
        return {**summary.head(self), "runs": len(rows), "cpu_s_of_runs": math.fsum(row["cpu_s"] for row in done),
                "wall_s": self.wall_seconds(), "not_done": [row for row in rows if row["status"] != "done"]}

    def enough_done(self, what, most_failed=0.0):
        """The check (sentence, holds) that no more than this share of the runs failed; `what` says so in a word."""
        runs, done = len(self.rows()), len(self.done())
        return f"{what} runs came to an end ({done} of {runs})", runs - done <= most_failed * runs

    def _start(self, job):
        folder = tempfile.mkdtemp(prefix="run-", dir=self.folder)
        command = [*opt.command_line()[:2], "-n", "-x", "-j1", "--", job.example, *map(str, job.arguments), "--out", folder]
        with open(os.path.join(folder, "said.txt"), "w", encoding="utf-8") as said:
            own = {name: value for name, value in os.environ.items() if name != "YADE_BATCH"}   # this process has read its line
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=said, env=own)
        return job, process, folder

    def _record(self, job, process, folder):
        """Exit code 1 may be a check that an example makes of its own result: the row judges it by the numbers."""
        result = {"status": "done"}
        if os.path.exists(os.path.join(folder, "summary.json")):
            result.update(job.read(folder))
        else:
            with open(os.path.join(folder, "said.txt"), encoding="utf-8") as said:
                lines = [line for line in said.read().splitlines() if line.startswith(os.path.basename(job.example))]
            result["status"] = lines[-1] if lines else f"exit code {process.returncode}"
        self.table.append({**job.key, **result})
        self.checkpoint()
        shutil.rmtree(folder)

    def _save_scene(self):
        return None

    def _load_scene(self, stored):
        pass

    @staticmethod
    def _name(row, key):
        return tuple(shown(row[column]) for column in key)
