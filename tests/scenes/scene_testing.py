# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests of this folder share. Each test file runs as  yade -n -x tests/scenes/test_NAME.py  and ends with the
line "N passed, M failed" and exit code 0 or 1. What messages a test has met it leaves in the folder SOFTGRAIN_MESSAGES, for
tests/doc/test_messages.py."""
import os
import shutil
import subprocess
import sys
import tempfile
import traceback

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(os.path.dirname(os.path.dirname(HERE)), "examples")
MET = []    # messages


class Checks:
    """Counts what holds and what does not, and says what does not."""

    def __init__(self):
        self.passed = self.failed = 0

    def that(self, what, holds, detail=""):
        MET.append(str(detail))
        if holds:
            self.passed += 1
        else:
            self.failed += 1
            print(f"FAILED: {what}  {detail}")
        return holds

    def close_to(self, what, found, expected, tolerance):
        return self.that(what, abs(found - expected) <= tolerance, f"found {found!r}, expected {expected!r}")

    def raises(self, what, kind, words, work):
        """`work` has to raise an exception of this kind with one sentence that holds all the words."""
        try:
            work()
        except kind as error:
            text = str(error)
            MET.append(text)
            missing = [word for word in words if word not in text]
            return self.that(what, not missing and is_sentence(text), f"said: {text!r}, lacks {missing}")
        except Exception as error:
            return self.that(what, False, f"raised {type(error).__name__}: {error}")
        return self.that(what, False, "raised nothing")


def is_sentence(text):
    """One sentence: a line with a full stop at its end."""
    return text.endswith(".") and "\n" not in text.strip()


def run_tests(*tests):
    """Calls the test functions with a Checks; an exception counts as one failure. Ends the process."""
    checks = Checks()
    for test in tests:
        try:
            test(checks)
        except Exception:
            traceback.print_exc(file=sys.stdout)
            checks.that(test.__name__, False, "stopped by an exception")
    print(f"{checks.passed} passed, {checks.failed} failed")
    folder = os.environ.get("SOFTGRAIN_MESSAGES")
    if folder:
        os.makedirs(folder, exist_ok=True)
        with open(os.path.join(folder, os.path.basename(sys.argv[0]) + ".txt"), "w", encoding="utf-8") as file:
            file.write("\n".join(MET))
    sys.stdout.flush()
    sys.exit(1 if checks.failed else 0)


class Folder:
    """A temporary folder: with Folder() as path."""

    def __enter__(self):
        self.path = tempfile.mkdtemp(prefix="softgrain-test-")
        return self.path

    def __exit__(self, *_):
        shutil.rmtree(self.path, ignore_errors=True)


def command(example, *options, threads=None):
    """The command line that runs an example in yade."""
    jobs = [f"-j{threads}"] if threads else []
    return ["yade", *jobs, "-n", "-x", os.path.join(EXAMPLES, example), *(str(option) for option in options)]


def run_example(folder, example, *options, threads=None):
    """Runs an example with the folder as the current one: the finished process with its output as text."""
    return subprocess.run(command(example, *options, threads=threads), cwd=folder, capture_output=True, text=True,
                          check=False)


def run_signalled(folder, moments, example, *options):
    """The same, with signals of its own at moments, (function, call, signal) each: signalling.py."""
    told = ",".join(f"{function}:{call}:{signal.name}" for function, call, signal in moments)
    script, *rest = command(example, *options)[3:]
    return subprocess.run(["yade", "-n", "-x", os.path.join(HERE, "signalling.py"), told, script, *rest], cwd=folder,
                          capture_output=True, text=True, check=False)


def said(process):
    """What a finished process left on stderr and, shortened, on stdout, for a failure's detail."""
    return f"exit code {process.returncode}, stderr: {process.stderr[-600:]} stdout: {process.stdout[-600:]}"
