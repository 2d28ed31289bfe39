# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run has left in its folder, as numpy arrays: load_run(), which works without YADE too; and save_run(), by which scenes of one's
own leave the same. A run is NAME.csv, whose columns end in their units, and a json of what it takes to repeat it."""
import glob
import os
import shlex
import sys

from .checks import InputError
from .records import read_columns, read_json, write_json, write_table

RECORDS = ("summary.json", "checkpoint.json")   # of a run that is done, and of one that is not
# Endings of columns and what they say, the first that fits; columns with none of them are pure numbers.
UNITS = {"_kg_m_s": "kg m/s", "_N_m": "N/m", "_m_s": "m/s", "min_J": "-", "_Pa": "Pa", "_J": "J/m", "_N": "N", "_s": "s", "_m": "m",
         "_rad": "rad", "_deg": "degrees"}


class RunData:
    """A run: run["strain"] is a column as an array, run.table all of them.

    name        of the example or scene, as of the csv
    folder      where it lies
    parameters  dict: what was given, and the rest as it was chosen
    seed        of what is random; None where nothing is
    versions    dict: of softgrain, YADE, Python, numpy, and the machine
    command     the line that runs it again, into the folder that was named first; None where it is not known
    finished    whether it has come to its end
    record      everything in its json, a dict
    units       dict from column to unit; "-": a pure number
    shots       paths of its shots, for movie()
    """

    def __init__(self, folder, name, table, record, finished):
        self.folder, self.name, self.table, self.record, self.finished = folder, name, dict(table), record, finished
        self.parameters, self.versions = record.get("parameters", {}), record.get("versions", {})
        self.seed, self.command = record.get("seed", self.parameters.get("seed")), record.get("command")
        self.units = {**{column: unit_of(column) for column in table}, **record.get("units", {})}
        self.shots = sorted(glob.glob(os.path.join(glob.escape(folder), "*.npz")))

    def __getitem__(self, column):
        if column not in self.table:
            raise InputError(f"the run in {self.folder} has no column '{column}': give {', '.join(map(repr, self.table))}.")
        return self.table[column]

    def __len__(self):
        return len(next(iter(self.table.values()), ()))

    def __repr__(self):
        return f"<run {self.name} in {self.folder}: {len(self)} rows, {'finished' if self.finished else 'not finished'}>"


def load_run(folder):
    """The run in a folder, finished or not: a RunData. Raises InputError for a folder that holds none, or a damaged one."""
    folder = os.fspath(folder)
    record, finished = _record(folder)
    name = record.get("example") or record.get("run")
    path = os.path.join(folder, f"{name}.csv")
    try:
        return RunData(folder, name, read_columns(path), record, finished)
    except (OSError, ValueError) as error:
        reason = f"{error.strerror}: {path}" if isinstance(error, OSError) else str(error).rstrip(".")
        raise InputError(f"the run in {folder} cannot be read ({reason}): give the folder of a run.") from None


def save_run(folder, columns, name=None, units=None, seed=None, **parameters):
    """Writes the data of a scene of one's own as the examples do, for load_run(): NAME.csv and summary.json, each in one stroke.

    folder      is made; a run in it is overwritten
    columns     dict from name to numbers, all of one length, such as plot.data of YADE
    name        None: that of the script
    units       dict from column to unit; without, endings of names tell: time_s, stress_Pa, force_N_m
    seed        of what is random
    parameters  by name; what json can hold
    Raises InputError.
    """
    from . import summary

    folder, name = os.fspath(folder), name or os.path.splitext(os.path.basename(sys.argv[0] or "scene"))[0]
    lengths = {len(values) for values in columns.values()}
    if len(lengths) != 1:
        raise InputError(f"save_run: columns have {', '.join(map(str, sorted(lengths))) or 'no'} rows: give a dict of columns of one length.")
    unknown = sorted(set(units or {}) - set(columns))
    if unknown:
        raise InputError(f"save_run: units names {', '.join(unknown)}, which {'is no column' if len(unknown) == 1 else 'are no columns'}.")
    try:
        os.makedirs(folder, exist_ok=True)
        write_table(os.path.join(folder, f"{name}.csv"), list(columns), zip(*columns.values()))
        write_json(os.path.join(folder, "summary.json"),
                   {"example": name, "command": command_of(sys.argv), "parameters": parameters, "seed": seed,
                    "versions": summary.versions(), "units": units or {}})
    except OSError as error:
        raise InputError(f"save_run: the folder {folder} cannot be written ({error.strerror}): give another one.") from None
    except TypeError as error:
        raise InputError(f"save_run: {error}: give numbers as columns, and as parameters what json can hold.") from None


def command_of(words):
    """The line that runs a script of YADE with these words, itself the first."""
    return "yade -n -x " + shlex.join(words)


def unit_of(column):
    """By the ending of its name."""
    return next((unit for ending, unit in UNITS.items() if column.endswith(ending)), "-")


def _record(folder):
    """The json of a run, and whether it is that of a finished one."""
    for file in RECORDS:
        path = os.path.join(folder, file)
        try:
            record = read_json(path)
        except FileNotFoundError:
            continue
        except (OSError, ValueError):
            record = None
        if not isinstance(record, dict) or not isinstance(record.get("example") or record.get("run"), str):
            raise InputError(f"{path} cannot be read, or is not of a run: give the folder of a run.")
        return record, file == RECORDS[0]
    raise InputError(f"{folder} holds no run: give the folder that an example or save_run() has written, where {RECORDS[0]} or "
                     f"{RECORDS[1]} lies.")
