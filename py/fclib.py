# SPDX-License-Identifier: GPL-2.0-or-later
"""Contact problems of a running scene as numpy arrays, and in files of the form of FCLIB, the collection of frictional
contact problems (Acary et al. 2014), so that other solvers can be tried on them. Files need python3-h5py.

    from softgrain import fclib
    fclib.write("problem.hdf5", fclib.lastProblem())
"""
from typing import NamedTuple

import numpy

from . import measures
from .checks import InputError

COMPRESSED_ROWS, COMPRESSED_COLUMNS = -2, -1    # FCLIB's nz of a matrix; from 0 on: number of separate entries


class Problem(NamedTuple):
    """Find r with u = W r + q, 0 <= r_n perp u_n >= 0, and Coulomb's friction; doc/theory.md, section 5.

    Vectors hold two entries a contact point, along its normal (towards the body of the point) and along the tangent
    to the left of that. Impulses are per metre of thickness. Those of adhesion are in q, and r is without them.
    """
    rows: numpy.ndarray     # W in compressed rows: where each row begins, and the end; shape (2 contacts + 1,)
    columns: numpy.ndarray  # of the entries of W
    values: numpy.ndarray   # of the entries of W [m/kg]
    q: numpy.ndarray        # relative velocities without impulses, with gap / O.dt along the normal [m/s]
    mu: numpy.ndarray       # coefficients of friction [-], shape (contacts,)
    r: numpy.ndarray        # solution or guess: impulses on the body of the point [N s/m]
    u: numpy.ndarray        # solution or guess: as q, with the impulses [m/s]


def lastProblem():
    """The Problem that the SoftIntegrator solved in the last step, with its answer; the penetrations that it takes back
    in part (`recovery`) and the speeds of driven walls are in q. Raises InputError when there was no contact point."""
    arrays = measures.softIntegrator().contactProblem()
    types = ("<i4", "<i4", *5 * ["<f8"])
    problem = Problem(*(numpy.frombuffer(content, dtype).copy() for content, dtype in zip(arrays, types)))
    if not len(problem.mu):
        raise InputError("the last step had no contact points, and so no contact problem: run steps until grains are in "
                         "touch.")
    return problem


def write(path, problem, title="softgrain", description="contact problem of one step", solved=True):
    """Writes a Problem to a new file in FCLIB's form; r and u as its solution, or as a guess if not `solved`.
    Raises InputError when the file is there already or cannot be made."""
    h5py = _h5py()
    size = len(problem.q)
    matrix = {"nzmax": len(problem.values), "m": size, "n": size, "nz": COMPRESSED_ROWS,
              "p": problem.rows, "i": problem.columns, "x": problem.values}
    answer = {"r": problem.r, "u": problem.u}
    content = {"fclib_local": {"spacedim": 2, "W": matrix, "vectors": {"q": problem.q, "mu": problem.mu},
                               "info": {"title": title, "description": description, "math_info": ""}}}
    content.update({"solution": answer} if solved else {"guesses": {"number_of_guesses": 1, "1": answer}})
    try:
        with h5py.File(path, "x") as file:
            _put(file, content)
    except OSError as error:
        raise InputError(f"fclib.write: {path!r} could not be made ({error}): give the path of a new file.") from None


def read(path):
    """The Problem in a file of FCLIB's form, in two dimensions and without bilateral constraints; r and u are its
    solution, else its first guess, else zero and q. Raises InputError when there is no such problem in it."""
    h5py = _h5py()
    try:
        file = h5py.File(path, "r")
    except OSError as error:
        raise InputError(f"fclib.read: {path!r} could not be read ({error}): give a file of FCLIB.") from None
    with file:
        problem = file.get("fclib_local")
        if problem is None or problem["spacedim"][0] != 2 or "V" in problem:
            raise InputError(f"fclib.read: {path!r} holds no local problem in two dimensions without bilateral "
                             "constraints: give one that does.")
        q, mu = (problem["vectors"][name][:] for name in ("q", "mu"))
        answer = file.get("solution", file.get("guesses/1", {"r": numpy.zeros_like(q), "u": q}))
        return Problem(*_compressed_rows(problem["W"]), q, mu, answer["r"][:], answer["u"][:])


def _compressed_rows(matrix):
    """Rows, columns and values of a matrix in any of FCLIB's forms."""
    form, size = matrix["nz"][0], matrix["m"][0]
    major, minor, values = (matrix[name][:] for name in "pix")
    if form == COMPRESSED_ROWS:
        return major, minor, values
    if form == COMPRESSED_COLUMNS:
        rows, columns = minor, numpy.repeat(numpy.arange(len(major) - 1, dtype="<i4"), numpy.diff(major))
    else:
        rows, columns, values = major[:form], minor[:form], values[:form]
    order = numpy.lexsort((columns, rows))
    begins = numpy.searchsorted(rows[order], numpy.arange(size + 1)).astype("<i4")
    return begins, columns[order], values[order]


def _put(group, content):
    """A dict of dicts, numbers, texts and arrays as libfclib stores them: numbers as arrays of one, texts of fixed
    length that end with a zero."""
    for name, value in content.items():
        if isinstance(value, dict):
            _put(group.create_group(name), value)
        elif isinstance(value, str):
            group[name] = numpy.bytes_(value.encode() + b"\0")
        else:
            group[name] = numpy.array([value], "<i4") if isinstance(value, int) else value


def _h5py():
    try:
        import h5py
    except ImportError:
        raise InputError("fclib reads and writes files by h5py, which is not installed: "
                         "apt-get install python3-h5py.") from None
    return h5py
