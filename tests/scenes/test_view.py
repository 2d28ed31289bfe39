# SPDX-License-Identifier: GPL-2.0-or-later
"""Soft grains in YADE's 3D view, on a virtual display (Debian's package xvfb): colours of the picture, selection by the mouse, the
inspector, and a view of a simulation that runs.

    python3 tests/scenes/test_view.py

starts the display and, on it, YADE with this file."""
import os
import shutil
import subprocess
import sys
import time

SKIPPED = 77


def on_a_display():
    """Runs this file in YADE on a display of its own; gives its exit code."""
    if not shutil.which("Xvfb"):
        print("skipped: there is no virtual display; install Debian's package xvfb")
        return SKIPPED
    read, write = os.pipe()
    display = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-noreset", "-screen", "0", "1280x1024x24"], pass_fds=[write],
                               stderr=subprocess.DEVNULL)
    os.close(write)
    try:
        number = os.read(read, 16).decode().strip()
        if not number:
            print("skipped: Xvfb could not open a virtual display")
            return SKIPPED
        return subprocess.run(["yade", "-x", "--", os.path.abspath(__file__)], check=False,
                              env={**os.environ, "DISPLAY": f":{number}", "LIBGL_ALWAYS_SOFTWARE": "1"}, timeout=500).returncode
    finally:
        display.terminate()
        display.wait()


if "yade.runtime" not in sys.modules:
    sys.exit(on_a_display())

import matplotlib  # noqa: E402
import numpy  # noqa: E402
from PyQt5 import QtCore, QtGui, QtTest, QtWidgets  # noqa: E402
from yade import O, FrictMat, qt  # noqa: E402

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402
from softgrain import Gl1_SoftGrain, NeoHookeanMat, SoftGrain, arrays, measures, softBox, softCloud, softDisc, softEngines, softPolygon  # noqa: E402

WIDTH = 8e-3
WHITE = (1, 1, 1)


def look(seconds=0.3):
    """Lets the windows work until what has changed is drawn."""
    end = time.time() + seconds
    while time.time() < end:
        QtWidgets.QApplication.instance().processEvents(QtCore.QEventLoop.AllEvents, 20)


def the_view():
    view = qt.views()[0] if qt.views() else qt.View()
    qt.Renderer().bgColor, qt.Renderer().mask = WHITE, 1
    view.viewDir, view.upVector, view.orthographic, view.axes, view.scale, view.timeDisp = (0, 0, -1), (0, 1, 0), True, False, False, ""
    return view


def window(title="Primary view"):
    return next(found for found in QtWidgets.QApplication.topLevelWidgets() if found.windowTitle() == title)


class Picture:
    """Pixels of the view [0 to 1] as the display shows them, and where places of the scene are on it."""

    def __init__(self, view, low, high):
        """of what fills the box from low to high, (x, y) [m]."""
        view.fitAABB((*low, 0), (*high, 0))
        self.low, self.high = numpy.array(low), numpy.array(high)
        self.take()
        rows, columns = numpy.nonzero((self.pixels < 0.99).any(axis=2))
        self.first, self.last = numpy.array([columns.min(), rows.max() + 1]), numpy.array([columns.max() + 1, rows.min()])

    def take(self):
        """The pixels of now."""
        look()
        self.image = QtWidgets.QApplication.primaryScreen().grabWindow(window().winId())
        image = self.image.toImage().convertToFormat(QtGui.QImage.Format_RGBA8888)
        rows = numpy.frombuffer(image.constBits().asstring(image.byteCount()), dtype=numpy.uint8)
        self.pixels = rows.reshape(image.height(), image.width(), 4)[:, :, :3] / 255

    def pixel(self, place):
        """Column and row of a place (x, y) [m]."""
        return self.first + (self.last - self.first) * (numpy.array(place) - self.low) / (self.high - self.low)

    def colour(self, place):
        column, row = numpy.floor(self.pixel(place)).astype(int)
        return self.pixels[row, column]


def bounds():
    outlines = numpy.concatenate([arrays.outline(body) for body in measures.softBodies()])
    return outlines.min(axis=0), outlines.max(axis=0)


def new_scene():
    O.reset()
    O.materials.append(NeoHookeanMat(density=1000, frictionAngle=0.3, label="gel"))
    O.materials.append(FrictMat(frictionAngle=0.1, label="steel"))
    Gl1_SoftGrain.field, Gl1_SoftGrain.range, Gl1_SoftGrain.outline, Gl1_SoftGrain.points = "", (0, 0), True, False


def packing(steps=4000):
    new_scene()
    grains, height = softCloud(WIDTH, count=15, diameters=(1.4e-3, 2.4e-3), solidFraction=0.65, material="gel", points=276, seed=1)
    O.bodies.append(grains)
    top = O.bodies.append(softBox(WIDTH, height, "steel"))[3]
    O.bodies[top].state.vel = (0, -1, 0)
    for body in O.bodies:       # bodies touch that share a bit; the view shows those with the first
        body.mask = 3 if isinstance(body.shape, SoftGrain) else 2
    O.engines = softEngines()
    if steps:
        O.run(steps, wait=True)


def close(found, expected, tolerance=0.02):
    return numpy.abs(numpy.asarray(found) - expected).max() <= tolerance


def before_the_first_step(checks):
    """A disc and an L, turned, in the colours of their shapes; the notch of the L shows the background."""
    new_scene()
    corner = softPolygon([(3e-3, 0), (5e-3, 0), (5e-3, 1e-3), (4e-3, 1e-3), (4e-3, 2e-3), (3e-3, 2e-3)], 0, points=100)
    O.bodies.append([softDisc((1e-3, 1e-3), 1e-3, 0, points=60), corner])
    for body, colour in zip(O.bodies, ((1, 0.5, 0), (0, 0.5, 1))):
        body.shape.color = colour
    picture = Picture(the_view(), (0, 0), (5e-3, 2e-3))
    checks.that("the disc in its colour", close(picture.colour((1e-3, 1e-3)), (1, 0.5, 0)), picture.colour((1e-3, 1e-3)))
    for place in ((3.3e-3, 1.8e-3), (4.8e-3, 0.3e-3), (3.5e-3, 0.5e-3)):
        checks.that("the L in its colour", close(picture.colour(place), (0, 0.5, 1)), picture.colour(place))
    for place in ((4.5e-3, 1.5e-3), (0.1e-3, 0.1e-3), (2.5e-3, 1e-3)):
        checks.that("nothing beside them", close(picture.colour(place), WHITE), picture.colour(place))
    checks.that("a dark outline", picture.colour((3e-3, 1e-3)).max() < 0.5 or picture.colour((3.01e-3, 1e-3)).max() < 0.5)


def colours_are_those_of_the_field(checks):
    """The colour at each tenth material point against matplotlib's viridis of its value."""
    packing()
    soft, view = measures.softBodies(), the_view()
    Gl1_SoftGrain.outline = False
    for body in soft:
        body.shape.color = (1, 0, 0)
    picture = Picture(view, *bounds())
    inside = (picture.pixels < 0.99).any(axis=2)
    fields = {"vonMises": arrays.vonMisesStresses, "pressure": arrays.pressures, "J": arrays.volumeRatios,
              "stretch": lambda body: arrays.principalStretches(body)[:, 0],
              "displacement": lambda body: numpy.linalg.norm(arrays.displacements(body), axis=1),
              "velocity": lambda body: numpy.linalg.norm(arrays.pointVelocities(body), axis=1)}
    places = numpy.concatenate([arrays.points(body) for body in soft])[::10]
    for field, array in fields.items():
        Gl1_SoftGrain.field = field
        picture.take()
        checks.that(f"{field} is shown in the grains, and not beside them", ((picture.pixels < 0.99).any(axis=2) == inside).mean() > 0.9999)
        values = numpy.concatenate([array(body) for body in soft])
        low, high = values.min(), values.max()
        checks.that(f"range of {field}", close(tuple(Gl1_SoftGrain.shownRange), (low, high), 1e-9 * abs(high)), Gl1_SoftGrain.shownRange)
        expected = matplotlib.colormaps["viridis"]((values[::10] - low) / (high - low))[:, :3]
        found = numpy.array([picture.colour(place) for place in places])
        off = numpy.abs(found - expected).max(axis=1)
        checks.that(f"colours of {field}", numpy.median(off) < 0.02 and (off > 0.06).mean() < 0.05, (numpy.median(off), (off > 0.06).mean()))
    Gl1_SoftGrain.field, Gl1_SoftGrain.range = "J", (2, 3)
    picture.take()
    checks.that("a range that is given", close(picture.colour(places[5]), (0.267, 0.005, 0.329)), picture.colour(places[5]))
    Gl1_SoftGrain.field = "nonsense"
    with Folder() as folder, open(folder + "/said", "w+b") as file:
        kept = os.dup(2)
        os.dup2(file.fileno(), 2)
        picture.take()
        os.dup2(kept, 2)
        os.close(kept)
        with open(file.name, encoding="utf-8") as said:
            text = said.read()
    checks.that("an unknown field is said", all(word in text for word in ("'nonsense'", "'vonMises'", "or '' for")), text)
    checks.that("an unknown field: the colour of the shape", close(picture.colour(places[5]), (1, 0, 0)))


def lines_and_dots(checks):
    packing()
    view = the_view()
    dark = {}
    for outline, points in ((False, False), (True, False), (False, True)):
        Gl1_SoftGrain.outline, Gl1_SoftGrain.points = outline, points
        for body in measures.softBodies():
            body.shape.color = (1, 1, 0)
        picture = Picture(view, *bounds())
        dark[outline, points] = (picture.pixels.max(axis=2) < 0.5).mean()
    checks.that("neither", dark[False, False] < 1e-4, dark)
    checks.that("outlines", 0.01 < dark[True, False] < 0.1, dark)
    checks.that("dots", 0.01 < dark[False, True] < 0.2, dark)


def selected_with_the_mouse(checks):
    packing()
    view = the_view()
    for body in measures.softBodies():
        body.shape.color = (0.4, 0.5, 0.4)
    picture = Picture(view, *bounds())
    for grain in (3, 11):
        x, y = picture.pixel(list(O.bodies[grain].state.pos)[:2])
        QtTest.QTest.mouseClick(window(), QtCore.Qt.LeftButton, QtCore.Qt.ShiftModifier, QtCore.QPoint(int(x), int(y)))
        look()
        checks.that(f"a click with shift selects grain {grain}", view.selection == grain, view.selection)
    beside = [list(O.bodies[grain].state.pos)[:2] + numpy.array([0.3e-3, 0.3e-3]) for grain in (3, 11)]    # the number is in the middle
    seen = []
    for _ in range(8):
        picture.take()
        seen.append([picture.colour(place) for place in beside])
    checks.that("which blinks", numpy.ptp(seen, axis=0)[1].max() > 0.2 and numpy.ptp(seen, axis=0)[0].max() < 0.01, seen)
    qt.Inspector()
    inspector = window("Simulation Inspection")
    inspector.changeBodyId(11)
    look()
    shown = " ".join(label.text() for label in inspector.findChildren(QtWidgets.QLabel))
    for text in ("SoftGrain", "SoftState", "NeoHookeanMat", "surfaceSpacing"):
        checks.that(f"the inspector shows {text}", text in shown, shown[:2000])
    inspector.close()
    view.selection = -1


def in_the_display_tab(checks):
    """The controller was opened before softgrain was imported; what its editor sets, the view draws with."""
    controller = qt.controller
    shown = [controller.displayCombo.itemText(i) for i in range(controller.displayCombo.count())]
    checks.that("the tab offers it once", shown.count("Gl1_SoftGrain") == 1, shown)
    controller.displayCombo.setCurrentIndex(shown.index("Gl1_SoftGrain"))
    controller.displayComboSlot("Gl1_SoftGrain")
    look()
    box = next(box for box in controller.displayArea.findChildren(QtWidgets.QCheckBox) if box.isChecked())
    box.click()
    look()
    checks.that("its box for the outline works", not Gl1_SoftGrain.outline)


def while_it_runs(checks):
    """The picture follows a simulation in another thread."""
    packing(steps=0)
    the_view()
    heights = []
    Gl1_SoftGrain.field = "vonMises"
    O.run(5000)
    while O.running:
        look(0.1)
        heights.append((O.iter, Gl1_SoftGrain.shownRange[1]))
    checks.that("it went on", heights[-1][0] > heights[0][0] + 100, heights)
    checks.that("and so did the picture", len({stress for _, stress in heights}) > 4, heights)


run_tests(before_the_first_step, colours_are_those_of_the_field, lines_and_dots, selected_with_the_mouse, in_the_display_tab,
          while_it_runs)
