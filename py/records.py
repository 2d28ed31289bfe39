# SPDX-License-Identifier: GPL-2.0-or-later
"""The csv file of a run, written row by row so that nothing computed is lost, and files replaced in one stroke."""
import contextlib
import hashlib
import json
import math
import os


class Table:
    """A csv file with fixed columns. Every row is on disk when `append` returns."""

    def __init__(self, path, columns, rows=0):
        """Opens the file and keeps its first `rows` rows; later ones (after a checkpoint) are cut. ValueError when it has
        fewer."""
        self.columns = columns
        self.rows = rows
        replace_text(path, self.begin_of(path, rows + 1).decode("ascii") if rows else ",".join(columns) + "\n")
        self._file = open(path, "a", encoding="ascii")

    def append(self, row):
        """Writes a dict of columns; absent ones become nan. KeyError for one that the table does not have."""
        unknown = set(row) - set(self.columns)
        if unknown:
            raise KeyError(f"not columns of the table: {', '.join(sorted(unknown))}")
        self._file.write(",".join(shown(row.get(column, math.nan)) for column in self.columns) + "\n")
        self._file.flush()
        self.rows += 1

    def close(self):
        """After the last row."""
        self._file.close()

    @staticmethod
    def begin_of(path, count):
        """The first lines of a csv file, as bytes. Raises ValueError, one sentence, when there are fewer."""
        try:
            with open(path, "rb") as file:
                lines = [line for _, line in zip(range(count), file) if line.endswith(b"\n")]
        except OSError:
            lines = []
        if len(lines) < count:
            raise ValueError(f"{path} holds {max(len(lines) - 1, 0)} rows, its checkpoint counts {count - 1}: start "
                             "anew with --force.")
        return b"".join(lines)


class Columns(dict):
    """Those of a csv file; ValueError, one sentence, for one that is not there."""

    def __init__(self, path, columns):
        super().__init__(columns)
        self.path = path

    def __missing__(self, column):
        raise ValueError(f"{self.path} has no column {column}: give the csv file of a run.")


def read_table(path):
    """A csv file of numbers as a dict from column to array of float. Raises ValueError, one sentence."""
    import numpy

    columns, rows = _read(path)
    try:
        values = numpy.array([[float(word) for word in row] for row in rows])
    except ValueError as error:
        raise ValueError(f"{path} is no table of numbers ({error}): give the csv file of a run.") from None
    return Columns(path, {column: values[:, i] if len(values) else numpy.empty(0) for i, column in enumerate(columns)})


def read_columns(path):
    """A csv file as a dict from column to array, of float where all are numbers. Raises OSError, or ValueError, one sentence."""
    import numpy

    columns, rows = _read(path)
    result = {}
    for number, column in enumerate(columns):
        words = numpy.array([row[number] for row in rows])
        try:
            result[column] = words.astype(float)
        except ValueError:
            result[column] = words
    return result


def read_rows(path):
    """The rows of a csv file as dicts; what is a number is a float."""
    def value(word):
        try:
            return float(word)
        except ValueError:
            return word

    columns, rows = _read(path)
    return [dict(zip(columns, map(value, row))) for row in rows]


def _read(path):
    """The columns of a csv file and its rows, as lists of words. Lines that begin with # are comments. Raises ValueError, one
    sentence."""
    with open(path, encoding="ascii", errors="replace") as file:
        lines = [line.split(",") for line in file.read().splitlines() if not line.startswith("#")]
    if not lines:
        raise ValueError(f"{path} is empty: a csv file begins with the names of its columns.")
    columns, *rows = lines
    for number, row in enumerate(rows, 1):
        if len(row) != len(columns):
            raise ValueError(f"{path} is damaged: {len(columns)} columns, but {len(row)} values in row {number}.")
    return columns, rows


def write_table(path, columns, rows):
    """Writes a whole csv file in one stroke; a row holds its values in the order of the columns."""
    replace_text(path, "".join(",".join(map(shown, row)) + "\n" for row in [columns, *rows]))


def replace_text(path, text):
    """Writes a file so that it is, at every moment, whole: the old one or the new one."""
    with replacing(path) as unfinished, open(unfinished, "w", encoding="utf-8") as file:
        file.write(text)


@contextlib.contextmanager
def replacing(path):
    """Gives the name of a file beside `path`, of the same ending, to be written inside of the block. At its end that takes the place of
    `path` in one stroke; after an exception it is removed, and what was there before stays."""
    stem, ending = os.path.splitext(path)
    unfinished = f"{stem}.part{ending}"
    try:
        yield unfinished
        with open(unfinished, "rb") as file:
            os.fsync(file.fileno())
        os.replace(unfinished, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.remove(unfinished)
        raise


def write_json(path, content, nan=False):
    """Writes a dict to a json file, in one stroke. NaN becomes null, unless `nan` lets Python's own NaN stand."""
    replace_text(path, json.dumps(content if nan else _finite(content), indent=2) + "\n")


def read_json(path):
    """The content of a json file. OSError or ValueError when there is none."""
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def digest(data):
    """Of bytes, by which a change of them is found."""
    return hashlib.sha256(data).hexdigest()


def sealed(content):
    """A dict for json with its own digest in it, under "digest"."""
    rest = {key: value for key, value in content.items() if key != "digest"}
    return {**rest, "digest": digest(json.dumps(rest, sort_keys=True).encode())}


def shown(value):
    """A value as it stands in a csv file: numbers with ten digits, words with semicolons for their commas."""
    return str(value).replace(",", ";") if isinstance(value, (int, str)) else f"{value:.10g}"


def _finite(content):
    if isinstance(content, dict):
        return {key: _finite(value) for key, value in content.items()}
    if isinstance(content, (list, tuple)):
        return [_finite(value) for value in content]
    if isinstance(content, float) and not math.isfinite(content):
        return None
    return content
