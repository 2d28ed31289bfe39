# SPDX-License-Identifier: GPL-2.0-or-later
"""What SoftVTKRecorder writes, read back with VTK and compared with what the scene holds."""
import glob
import os
import resource
import subprocess
import sys
import types
import xml.etree.ElementTree as xml

import numpy
from yade import O, FrictMat, utils

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, is_sentence, run_tests  # noqa: E402
from softgrain import (NeoHookeanMat, SoftVTKRecorder, arrays, measures, softBox, softDisc, softEngines, softPolygon,  # noqa: E402
                       stresses)

SINGLE = 2e-7       # twice the round-off of single precision


def squeezed(*recorders):
    """A turned square and a disc under a falling wall, on the bottom of a box; a rigid disc and a facet aside."""
    O.reset()
    O.materials.append(NeoHookeanMat(density=1000, frictionAngle=0.3))
    hard = O.materials.append(FrictMat(frictionAngle=0.1))
    square = softPolygon([(2.2e-3, 0), (4.2e-3, 0), (4.2e-3, 2e-3), (2.2e-3, 2e-3)], 0, points=60)
    O.bodies.append([softDisc((1e-3, 1e-3), 1e-3, 0, points=60), square])
    top = O.bodies.append(softBox(4.3e-3, 2e-3, hard))[3]
    O.bodies[top].state.vel = (0, -1, 0)
    O.bodies.append(utils.sphere((8e-3, 1e-3, 3e-4), 5e-4, fixed=True, material=hard))
    O.bodies.append(utils.facet([(6e-3, 0, -1e-3), (7e-3, 0, 1e-3), (6e-3, 2e-3, 1e-3)], material=hard))
    O.bodies.append(utils.box((9e-3, 1e-3, 0), (3e-4, 2e-4, 1e-3), fixed=True, material=hard))
    O.bodies[0].mask = 2
    O.engines = softEngines(more=list(recorders))


def read(path):
    """The data of a file, as VTK reads it."""
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def fields(held):
    """Arrays of a file's points or cells, by their names."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    return {held.GetArrayName(i): vtk_to_numpy(held.GetArray(i)) for i in range(held.GetNumberOfArrays())}


def places(data):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    return vtk_to_numpy(data.GetPoints().GetData()) if data.GetNumberOfPoints() else numpy.zeros((0, 3))


def series(path):
    """What a .pvd lists: (time, name, file)."""
    return [(float(entry.get("timestep")), entry.get("name"), entry.get("file")) for entry in xml.parse(path).getroot().find("Collection")]


def same(found, expected):
    """Equal in single precision, of the largest value."""
    found, expected = numpy.asarray(found, dtype=float), numpy.asarray(expected, dtype=float)
    return found.shape == expected.shape and numpy.abs(found - expected).max() <= SINGLE * max(numpy.abs(expected).max(), 1e-300)


def in_space(vectors):
    return numpy.pad(vectors, ((0, 0), (0, 1)))


def nothing_is_loaded_before(checks):
    checks.that("import softgrain loads no VTK", not [name for name in sys.modules if name.startswith("vtk")])


def what_points_hold(checks):
    with Folder() as folder:
        squeezed(SoftVTKRecorder(fileName=folder + "/new/run-", iterPeriod=200))
        O.run(201, wait=True)
        soft = measures.softBodies()
        data = read(folder + "/new/run-points.200.vtp")
        found = fields(data.GetPointData())

        def of_all(array):
            return numpy.concatenate([array(body) for body in soft])

        stress, F = of_all(arrays.cauchyStresses), of_all(arrays.deformationGradients)
        expected = {"id": of_all(lambda body: numpy.full(body.shape.pointCount(), body.id)),
                    "displacement": in_space(of_all(arrays.displacements)), "velocity": in_space(of_all(arrays.pointVelocities)),
                    "J": numpy.linalg.det(F), "stretches": numpy.linalg.svd(F, compute_uv=False),
                    "pressure": of_all(arrays.pressures), "vonMises": of_all(arrays.vonMisesStresses),
                    "stress": stress[:, [0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]}
        checks.that("places", same(places(data), in_space(of_all(arrays.points))))
        for name, values in expected.items():
            checks.that(f"{name} of the points", same(found[name], values), f"{found[name][:2]} {values[:2]}")
        checks.that("the grains are squeezed", numpy.abs(found["vonMises"]).max() > 1e4 and found["J"].min() < 0.999)
        checks.that("every point is a cell", data.GetNumberOfVerts() == len(stress))
        checks.close_to("J is the product of the stretches", float(numpy.abs(found["stretches"].prod(axis=1) - found["J"]).max()), 0, 1e-6)
        checks.that("components have names", data.GetPointData().GetArray("stress").GetComponentName(3) == "xy")


def displacements_are_from_the_start(checks):
    """Of a grain that was put down turned, u = x - X vanishes at first, and is the same for all points while it flies."""
    for formulation in ("total", "updated"):
        O.reset()
        O.materials.append(NeoHookeanMat(density=1000))
        O.bodies.append(softDisc((1e-3, 1e-3), 1e-3, 0, points=60))
        grain = O.bodies[0]
        grain.shape.formulation = formulation
        grain.state.ori = utils.Quaternion((0, 0, 1), 0.7)
        grain.state.vel = (2, 0, 0)
        O.engines = softEngines()
        O.run(1, wait=True)
        begin, step = arrays.displacements(grain), O.time
        O.run(50, wait=True)
        way = arrays.displacements(grain) - begin
        checks.that(f"none at first, {formulation}", numpy.abs(begin).max() <= 2 * step * 1.01, begin[:2])
        checks.that(f"all alike in flight, {formulation}", numpy.abs(way - way[0]).max() < 1e-12 and way[0][0] > 0, way[:2])


def outlines_and_means_of_grains(checks):
    with Folder() as folder:
        squeezed(SoftVTKRecorder(fileName=folder + "/", iterPeriod=200))
        O.run(201, wait=True)
        data, soft = read(folder + "/grains.200.vtp"), measures.softBodies()
        found = fields(data.GetCellData())
        checks.that("a polygon a grain", data.GetNumberOfPolys() == 2 and data.GetNumberOfCells() == 2)
        checks.that("outlines", same(places(data), in_space(numpy.concatenate([arrays.outline(body) for body in soft]))))
        checks.that("ids", list(found["id"]) == [0, 1])
        checks.that("J is the change of area", same(found["J"], [body.state.area() / body.shape.area() for body in soft]))
        checks.that("pressure of the mean stress", same(found["pressure"], [arrays.pressure(stresses.ofGrain(body)) for body in soft]))
        checks.that("velocity", same(found["velocity"], [list(body.state.vel) for body in soft]))
        checks.that("displacement", same(found["displacement"], [list(body.state.displ()) for body in soft]))


def contacts_and_their_forces(checks):
    with Folder() as folder:
        squeezed(SoftVTKRecorder(fileName=folder + "/", iterPeriod=200))
        O.run(201, wait=True)
        data, contacts = read(folder + "/contacts.200.vtp"), stresses.contactPoints()
        found = fields(data.GetPointData())
        checks.that("there are some", len(contacts.ids) > 6, len(contacts.ids))
        checks.that("places", same(places(data), in_space(contacts.places)))
        checks.that("ids", numpy.array_equal(numpy.column_stack([found["id1"], found["id2"]]), contacts.ids))
        checks.that("normals", same(found["normal"], in_space(contacts.normals)))
        checks.that("forces", same(found["force"], in_space(contacts.forces)))
        checks.that("normal forces press", (found["normalForce"] > 0).all())


def rigid_bodies(checks):
    with Folder() as folder:
        squeezed(SoftVTKRecorder(fileName=folder + "/", iterPeriod=200))
        O.run(201, wait=True)
        data = read(folder + "/rigid.200.vtp")
        found, where = fields(data.GetCellData()), places(data)
        checks.that("four walls and a facet are lines", data.GetNumberOfLines() == 5)
        checks.that("a disc and a box are polygons", data.GetNumberOfPolys() == 2)
        for cell, body in enumerate(found["id"]):
            corners = [data.GetCell(cell).GetPointId(i) for i in range(data.GetCell(cell).GetNumberOfPoints())]
            here, pos = where[corners], numpy.array(O.bodies[int(body)].state.pos)
            shape = type(O.bodies[int(body)].shape).__name__
            if shape == "Sphere":
                radius = numpy.hypot(*(here - pos)[:, :2].T)
                checks.that("the circle that the plane cuts", numpy.abs(radius - 4e-4).max() < 1e-9, radius)
            elif shape == "Box":
                checks.that("a rectangle", same(here.max(axis=0) - here.min(axis=0), [6e-4, 4e-4, 0]), here)
            elif shape == "Facet":
                checks.that("where the plane cuts the facet", same(sorted(map(tuple, here)), [(6e-3, 1e-3, 0), (6.5e-3, 0, 0)]), here)
            else:
                axis = O.bodies[int(body)].shape.axis
                checks.that("a wall lies where it is", numpy.abs(here[:, axis] - pos[axis]).max() < 1e-9)
                checks.that("and is as long as the scene", numpy.ptp(here[:, 1 - axis]) > (1.9e-3, 9e-3)[axis] * 0.9, here)
        forces = numpy.array([list(O.forces.f(int(body))) for body in found["id"]])
        checks.that("forces on them", same(found["force"], forces) and numpy.abs(forces).max() > 1)


def what_is_left_out(checks):
    with Folder() as folder:
        squeezed(SoftVTKRecorder(fileName=folder + "/", iterPeriod=10, recorders=["points", "J", "id"], mask=2))
        O.run(11, wait=True)
        checks.that("one block a time", sorted(os.listdir(folder)) == ["points.0.vtp", "points.10.vtp", "scene.pvd"], os.listdir(folder))
        found = fields(read(folder + "/points.10.vtp").GetPointData())
        checks.that("two fields", sorted(found) == ["J", "id"], sorted(found))
        checks.that("of the body with this mask", set(found["id"]) == {0} and len(found["id"]) == O.bodies[0].shape.pointCount())
        squeezed(SoftVTKRecorder(fileName=folder + "/bare-", recorders=["grains", "contacts"], iterPeriod=1, mask=64))
        O.run(1, wait=True)
        checks.that("nothing at all is a file too", read(folder + "/bare-grains.0.vtp").GetNumberOfPoints() == 0)


def text_and_compressed(checks):
    with Folder() as folder:
        squeezed(SoftVTKRecorder(fileName=folder + "/plain-", iterPeriod=200),
                 SoftVTKRecorder(fileName=folder + "/text-", iterPeriod=200, ascii=True),
                 SoftVTKRecorder(fileName=folder + "/small-", iterPeriod=200, compress=True))
        O.run(201, wait=True)
        plain, text, small = (read(f"{folder}/{kind}-points.200.vtp") for kind in ("plain", "text", "small"))
        for name, kind in (("text", text), ("compressed", small)):
            checks.that(f"{name} says the same", same(fields(kind.GetPointData())["stress"], fields(plain.GetPointData())["stress"]))
        checks.that("text is text", open(folder + "/text-points.200.vtp").read().isascii())
        sizes = [os.path.getsize(f"{folder}/{kind}-points.200.vtp") for kind in ("small", "plain")]
        checks.that("compressed is smaller", sizes[0] < sizes[1], sizes)


def the_series(checks):
    with Folder() as folder:
        path = folder + "/scene.pvd"
        squeezed(SoftVTKRecorder(fileName=folder + "/", virtPeriod=2e-5))
        times = []
        while O.time < 1.2e-4:
            O.run(7, wait=True)
            times = [time for time, name, _ in series(path) if name == "grains"]
        checks.that("a row each period", len(times) >= 6 and numpy.abs(numpy.diff(times) - 2e-5).max() < 3 * O.dt, times)
        checks.that("from the start", times[0] == 0)
        checks.that("all four blocks", len(series(path)) == 4 * len(times))
        checks.that("files that are there", all(os.path.exists(os.path.join(folder, file)) for _, _, file in series(path)))
        checks.that("and no others", len(glob.glob(folder + "/*")) == 1 + len(series(path)))
        data = read(os.path.join(folder, series(path)[-1][2]))
        checks.that("which know their time", data.GetFieldData().GetArray("TimeValue").GetValue(0) == times[-1])


def a_run_that_is_resumed(checks):
    """The list goes on after the moment that was saved; what came later is written anew."""
    with Folder() as folder:
        path, saved = folder + "/scene.pvd", folder + "/saved.yade"
        squeezed(SoftVTKRecorder(fileName=folder + "/", iterPeriod=10, recorders=["grains", "id"], compress=True))
        O.run(25, wait=True)
        O.save(saved)
        O.run(30, wait=True)
        before = series(path)
        O.reset()
        O.load(saved)
        engine = O.engines[-1]
        checks.that("the engine is loaded as it was", isinstance(engine, SoftVTKRecorder) and engine.recorders == ["grains", "id"]
                    and engine.compress and engine.iterPeriod == 10 and engine.fileName == folder + "/")
        O.run(6, wait=True)
        checks.that("what was later is gone from the list", [file for *_, file in series(path)] ==
                    ["grains.0.vtp", "grains.10.vtp", "grains.20.vtp", "grains.30.vtp"], series(path))
        O.run(24, wait=True)
        checks.that("the same list in the end", series(path) == before, series(path))
        squeezed(SoftVTKRecorder(fileName=folder + "/", iterPeriod=10, recorders=["grains", "id"], initRun=False))
        O.tags["id"] = "of another process"     # simulations of one process that begin in the same second have the same
        O.run(11, wait=True)
        checks.that("another simulation begins anew", [file for *_, file in series(path)] == ["grains.10.vtp"], series(path))


def a_file_that_is_no_list(checks):
    with Folder() as folder:
        path = folder + "/scene.pvd"
        with open(path, "wb") as file:
            file.write(b"\xff\xfe nothing of ours")
        squeezed(SoftVTKRecorder(fileName=folder + "/", iterPeriod=1, recorders=["grains"]))
        O.run(2, wait=True)
        checks.that("a list takes its place", [file for *_, file in series(path)] == ["grains.0.vtp", "grains.1.vtp"])


KILLED = """
import os, sys
sys.path.insert(0, {here!r})
sys.argv[0] = {test!r}
from softgrain import *
from softgrain import vtk_files
O.materials.append(NeoHookeanMat(density=1000))
O.bodies.append(softDisc((1e-3, 1e-3), 1e-3, 0, points=60))
O.engines = softEngines(more=[SoftVTKRecorder(fileName={folder!r} + "/", iterPeriod=1)])
O.run(3, wait=True)
replace = os.replace
def die(*names):
    if names[1].endswith({last!r}):
        os._exit(9)
    replace(*names)
os.replace = die
O.run(1, wait=True)
"""


def a_run_that_is_killed(checks):
    """The process ends in the middle of a run of the engine: the list is whole, and so are the files that it names."""
    for last in ("points.3.vtp", "scene.pvd"):
        with Folder() as folder:
            script = folder + "/killed.py"
            with open(script, "w") as file:
                file.write(KILLED.format(here=sys.path[0], test=script, folder=folder, last=last))
            ended = subprocess.run(["yade", "-n", "-x", script], capture_output=True, text=True)
            listed = [file for *_, file in series(folder + "/scene.pvd")]
            checks.that(f"killed before {last} is there", ended.returncode == 9, ended.stderr[-500:])
            checks.that("the list is that of before", len(listed) == 12 and not any(".3." in file for file in listed), listed)
            checks.that("its files are whole", all(read(os.path.join(folder, file)).GetFieldData().GetArray("TimeValue") for file in listed))


def no_room(checks, folder):
    """The system lets files grow to 2 kB only."""
    squeezed(SoftVTKRecorder(fileName=folder + "/full-", iterPeriod=1))
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (2000, limits[1]))
    try:
        checks.raises("no room", RuntimeError, ["/full-", "VTK could not write all of it"], lambda: O.run(1, wait=True))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)


def its_own_fault(checks, folder):
    from softgrain import vtk_recorder

    squeezed(SoftVTKRecorder(fileName=folder + "/", iterPeriod=1))
    record, vtk_recorder.record = vtk_recorder.record, None
    try:
        checks.raises("a fault of its own", RuntimeError, ["SoftVTKRecorder failed as printed above"], lambda: O.run(1, wait=True))
    finally:
        vtk_recorder.record = record


def mistakes(checks):
    def says(what, words, **attributes):
        squeezed(SoftVTKRecorder(iterPeriod=1, **attributes))
        checks.raises(what, RuntimeError, words, lambda: O.run(1, wait=True))

    with Folder() as folder:
        says("an unknown name", ["SoftVTKRecorder", "'spheres'", "vonMises", "grains"], fileName=folder + "/", recorders=["spheres"])
        says("fields alone", ["names no block", "'J'", "points"], fileName=folder + "/", recorders=["J"])
        open(folder + "/file", "w").close()
        says("a file for a folder", ["fileName", "/file/run-"], fileName=folder + "/file/run-")
        says("a folder that cannot be", ["fileName", "/proc/none/"], fileName="/proc/none/")
        os.mkdir(folder + "/scene.pvd")
        says("a folder in the place of the list", ["fileName", "directory"], fileName=folder + "/")
        checks.that("nothing half-done is left", not glob.glob(folder + "/*.part*"), os.listdir(folder))
        no_room(checks, folder)
        its_own_fault(checks, folder)
        loaded = [name for name in sys.modules if name.startswith(("vtkmodules", "softgrain.vtk_"))]
        kept = {name: sys.modules.pop(name) for name in loaded}
        other = types.ModuleType("vtkmodules")
        other.__version__ = "9.2.20230111"              # of Debian's python3-paraview
        try:
            for module, what, words in ((None, "no VTK", ["python3-vtk9", "install"]),
                                        (other, "another VTK", ["9.2.20230111", "python3-vtk9", "python3-paraview"])):
                vars(sys.modules["softgrain"]).pop("vtk_files", None)
                sys.modules["vtkmodules"] = module
                says(what, words, fileName=folder + "/", recorders=["grains"])
        finally:
            sys.modules.update(kept)
        squeezed(SoftVTKRecorder(fileName=folder + "/first-", iterPeriod=1))
        O.engines = O.engines[-1:] + O.engines[:-1]
        checks.raises("before the integrator", RuntimeError, ["SoftVTKRecorder", "#0", "behind SoftIntegrator"], lambda: O.run(1, wait=True))


run_tests(nothing_is_loaded_before, what_points_hold, displacements_are_from_the_start, outlines_and_means_of_grains,
          contacts_and_their_forces, rigid_bodies, what_is_left_out, text_and_compressed, the_series, a_run_that_is_resumed,
          a_file_that_is_no_list, a_run_that_is_killed, mistakes)
