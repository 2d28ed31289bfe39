# SPDX-License-Identifier: GPL-2.0-or-later
"""Contact problems of a scene as arrays and in files: what softgrain.fclib writes is read by libfclib, and the other way
round. The program fclib_copy reads a file with libfclib and writes all of it to another with libfclib."""
import os
import subprocess
import sys

import h5py
import numpy
from yade import O, FrictMat

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402
from softgrain import InputError, NeoHookeanMat, fclib, measures, softBox, softDisc, softEngines  # noqa: E402


def pressed_discs():
    """Two discs side by side, pressed on the bottom of a box."""
    O.reset()
    O.materials.append(NeoHookeanMat(density=1000, frictionAngle=0.3))
    wall = O.materials.append(FrictMat(frictionAngle=0.1))
    O.bodies.append([softDisc((x, 1e-3), 1e-3, 0, points=60) for x in (1e-3, 3e-3)])
    top = O.bodies.append(softBox(4e-3, 2e-3, wall))[3]
    O.bodies[top].state.vel = (0, -1, 0)
    O.engines = softEngines()
    O.run(300, wait=True)
    return fclib.lastProblem()


def copied(path, target, what="solution"):
    """The file as libfclib reads and writes it."""
    subprocess.run([os.environ["SOFTGRAIN_FCLIB_COPY"], path, target, what], check=True)
    return target


def require_equal(checks, what, found, expected):
    for name, one, other in zip(fclib.Problem._fields, found, expected):
        checks.that(f"{what}: {name}", one.dtype == other.dtype and numpy.array_equal(one, other))


def the_last_problem(checks):
    problem = pressed_discs()
    count = measures.softIntegrator().contactCount
    checks.that("one entry of mu a contact", problem.mu.shape == (count,) and count > 4, count)
    checks.that("two of all others", all(len(vector) == 2 * count for vector in (problem.q, problem.r, problem.u)))
    checks.that("a row of W for each", problem.rows.shape == (2 * count + 1,) and problem.rows[-1] == len(problem.values))
    checks.that("friction of the pairs", numpy.allclose(numpy.unique(problem.mu), numpy.tan([0.1, 0.3])), problem.mu)
    carried = problem.r[::2].sum()
    forces = sum(contact[4].norm() for contact in measures.softIntegrator().contacts()) * O.dt
    checks.that("impulses of the step", 0 < forces <= 1.1 * carried < 1.5 * forces, (forces, carried))


def both_ways_through_libfclib(checks):
    problem = pressed_discs()
    with Folder() as folder:
        for solved, kind in ((True, "solution"), (False, "guesses")):
            path = os.path.join(folder, kind)
            fclib.write(path, problem, "a title", "a description", solved)
            copy = copied(path, path + "-copy", kind)
            require_equal(checks, f"read back, {kind}", fclib.read(path), problem)
            require_equal(checks, f"read and written by libfclib, {kind}", fclib.read(copy), problem)
            with h5py.File(path) as ours, h5py.File(copy) as theirs:
                content = [dict(leaves(file)) for file in (ours, theirs)]
                checks.that(f"the same content, {kind}", content[0] == content[1], content)
                checks.that("texts", ours["fclib_local/info/title"][()] == b"a title")


def leaves(group):
    """Names of all data sets with their kind, size and content."""
    found = []

    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            found.append((name, (item.dtype, item.shape, numpy.asarray(item[()]).tobytes())))
    group.visititems(visit)
    return found


def other_forms_of_the_matrix(checks):
    # (1 0 2 0) in compressed rows, compressed columns, and as separate entries
    # (0 3 0 0)
    # (4 0 5 6)
    # (0 0 0 7)
    rows = {"p": [0, 2, 3, 6, 7], "i": [0, 2, 1, 0, 2, 3, 3], "x": [1, 2, 3, 4, 5, 6, 7], "nz": [-2]}
    columns = {"p": [0, 2, 3, 5, 7], "i": [0, 2, 1, 0, 2, 2, 3], "x": [1, 4, 3, 2, 5, 6, 7], "nz": [-1]}
    entries = {"p": [3, 0, 2, 1, 2, 0, 2], "i": [3, 2, 0, 1, 3, 0, 2], "x": [7, 2, 4, 3, 6, 1, 5], "nz": [7]}
    problem = fclib.Problem(numpy.array(rows["p"], "<i4"), numpy.array(rows["i"], "<i4"), numpy.array(rows["x"], "<f8"),
                            *(numpy.arange(n, dtype="<f8") for n in (4, 2, 4, 4)))
    with Folder() as folder:
        for name, form in ("rows", rows), ("columns", columns), ("entries", entries):
            path = os.path.join(folder, name)
            fclib.write(path, problem)
            with h5py.File(path, "r+") as file:
                matrix = file["fclib_local/W"]
                for key, values in form.items():
                    del matrix[key]
                    matrix[key] = numpy.array(values, "<f8" if key == "x" else "<i4")
            require_equal(checks, name, fclib.read(copied(path, path + "-copy")), problem)


def an_answer_may_be_missing(checks):
    problem = pressed_discs()
    with Folder() as folder:
        path = os.path.join(folder, "problem")
        fclib.write(path, problem)
        with h5py.File(path, "r+") as file:
            del file["solution"]
        found = fclib.read(path)
        checks.that("no impulses", not found.r.any() and (found.u == problem.q).all())


def mistakes(checks):
    problem = pressed_discs()
    with Folder() as folder:
        path, text, space = (os.path.join(folder, name) for name in ("problem", "text", "space"))
        fclib.write(path, problem)
        checks.raises("a file that is there", InputError, [path, "new file"], lambda: fclib.write(path, problem))
        checks.raises("a folder that is not", InputError, ["nowhere"], lambda: fclib.write("/nowhere/problem", problem))
        checks.raises("no file", InputError, [text, "give"], lambda: fclib.read(text))
        with open(text, "w", encoding="utf-8") as file:
            file.write("no problem")
        checks.raises("another file", InputError, [text, "give"], lambda: fclib.read(text))
        fclib.write(space, problem)
        with h5py.File(space, "r+") as file:
            file["fclib_local/spacedim"][0] = 3
        checks.raises("three dimensions", InputError, [space, "two dimensions"], lambda: fclib.read(space))
    O.reset()
    O.engines = softEngines()
    checks.raises("nothing in touch", InputError, ["no contact", "run"], fclib.lastProblem)


run_tests(the_last_problem, both_ways_through_libfclib, other_forms_of_the_matrix, an_answer_may_be_missing, mistakes)
