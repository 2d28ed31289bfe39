# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks of cells as files of VTK, and the list of them that ParaView opens. Importing it raises InputError
where VTK is missing, or is another than YADE's: two VTKs in one process end it."""
import collections
import os
import re
from xml.sax.saxutils import quoteattr

import numpy
from yade import libVersions

from .checks import InputError
from .records import replace_text, replacing

try:
    import vtkmodules
except ImportError:
    raise InputError("SoftVTKRecorder needs the VTK library for Python: install Debian's package python3-vtk9.") from None
of_yade = libVersions.getVersion("vtk")
if of_yade and vtkmodules.__version__.split(".")[:2] != [str(number) for number in of_yade[:2]]:
    raise InputError(f"SoftVTKRecorder: Python's VTK is {vtkmodules.__version__}, YADE's {'.'.join(map(str, of_yade))}: install Debian's "
                     "package python3-vtk9, which replaces python3-paraview.")
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray  # noqa: E402
from vtkmodules.vtkCommonCore import vtkPoints  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter  # noqa: E402

# A part of a scene. outlines: arrays of places [m], shape (places, 2); whole: each outline is a cell, those of two places, which come
# first, lines, the others polygons; else each place is a cell. fields: arrays with a row a cell, by their names.
Block = collections.namedtuple("Block", "outlines whole fields")

# When: step, time [s], and the id of the simulation, which O.save keeps.
Moment = collections.namedtuple("Moment", "step time simulation")

COMPONENTS = {"stretches": ("larger", "smaller"), "stress": ("xx", "yy", "zz", "xy", "yz", "xz")}
VECTORS = {"position", "displacement", "velocity", "normal", "force"}
TIME = re.compile('timestep="([^"]*)"')
COUNTS = {"id", "id1", "id2", "materialId", "mask"}


def write(prefix, blocks, moment, ascii=False, compress=False):
    """Writes each block into prefix + NAME.STEP.vtp and enters it into prefix + 'scene.pvd'. Raises InputError."""
    folder = os.path.dirname(prefix)
    try:
        if folder:
            os.makedirs(folder, exist_ok=True)
        files = {name: f"{prefix}{name}.{moment.step}.vtp" for name in blocks}
        for name, block in blocks.items():
            with replacing(files[name]) as unfinished:
                _write(_polydata(block, moment.time), unfinished, ascii, compress)
        replace_text(prefix + "scene.pvd", _series(prefix + "scene.pvd", files, moment))
    except OSError as error:
        raise InputError(f"SoftVTKRecorder: files of fileName = {prefix!r} cannot be written ({error.strerror}): take a folder that can "
                         "be written to and has room.") from None


def _write(data, path, ascii, compress):
    with open(path, "wb"):
        pass                                    # the system says why it cannot be
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(path)
    writer.SetInputData(data)
    if ascii:
        writer.SetDataModeToAscii()
    else:
        writer.SetDataModeToAppended()
        writer.EncodeAppendedDataOff()
    if compress:
        writer.SetCompressorTypeToZLib()
    else:
        writer.SetCompressorTypeToNone()
    if not writer.Write() or writer.GetErrorCode():
        raise OSError(0, "VTK could not write all of it; its message stands above")


def _polydata(block, time):
    data, points = vtkPolyData(), vtkPoints()
    points.SetData(_array("position", numpy.concatenate([numpy.zeros((0, 2)), *block.outlines])))
    data.SetPoints(points)
    sizes = numpy.array([len(outline) for outline in block.outlines], dtype=int)
    if block.whole:
        lines = numpy.count_nonzero(sizes == 2)
        data.SetLines(_cells(sizes[:lines], 0))
        data.SetPolys(_cells(sizes[lines:], sizes[:lines].sum()))
    else:
        data.SetVerts(_cells(numpy.ones(sizes.sum(), dtype=int), 0))
    held = data.GetCellData() if block.whole else data.GetPointData()
    for name, values in block.fields.items():
        held.AddArray(_array(name, values))
    data.GetFieldData().AddArray(_array("TimeValue", numpy.array([time]), numpy.float64))
    return data


def _cells(sizes, first):
    """Cells of these sizes over the points from the first on, one after the other."""
    cells = vtkCellArray()
    ends = numpy.concatenate([[0], numpy.cumsum(sizes)])
    cells.SetData(numpy_to_vtkIdTypeArray(ends.astype(numpy.int64), deep=True),
                  numpy_to_vtkIdTypeArray(numpy.arange(first, first + ends[-1], dtype=numpy.int64), deep=True))
    return cells


def _array(name, values, kind=None):
    """A row a cell; vectors in the plane get a third component, 0, without which ParaView takes them for no vectors."""
    rows = numpy.zeros((len(values), 3 if name in VECTORS else len(COMPONENTS.get(name, "1"))))
    if len(values):
        given = numpy.reshape(values, (len(values), -1))
        rows[:, :given.shape[1]] = given
    array = numpy_to_vtk(rows.astype(kind or (numpy.int32 if name in COUNTS else numpy.float32)), deep=True)
    array.SetName(name)
    for index, component in enumerate(COMPONENTS.get(name, ())):
        array.SetComponentName(index, component)
    return array


def _series(path, files, moment):
    """Text of the list with these files: after those that the same simulation has entered at earlier times, if it has. A line a file."""
    head = ['<?xml version="1.0"?>', '<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">',
            f"  <Collection simulation={quoteattr(moment.simulation)}>"]
    tail = ["  </Collection>", "</VTKFile>", ""]
    entries = _entries(path, head, tail)
    while entries and float(TIME.search(entries[-1]).group(1)) >= moment.time:
        entries.pop()
    entries += [f'    <DataSet timestep="{moment.time!r}" part="{part}" name={quoteattr(name)} file={quoteattr(os.path.basename(file))} />'
                for part, (name, file) in enumerate(files.items())]
    return "\n".join(head + entries + tail)


def _entries(path, head, tail):
    """Lines between the head and the tail; none where the file is not there or has others."""
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            lines = file.read().split("\n")
    except FileNotFoundError:
        return []
    return lines[len(head):-len(tail)] if lines[:len(head)] == head and lines[-len(tail):] == tail else []
