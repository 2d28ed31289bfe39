# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures and movies: what they show is where it is, in the colours of what it is."""
import math
import os
import sys
import unittest.mock
import warnings

import numpy
from PIL import Image
from yade import O, utils
from yade.wrapper import FrictMat

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402
from softgrain import (InputError, NeoHookeanMat, arrays, movie, pictures, rigidDisc, shots, snapshot, softBox,  # noqa: E402
                       softDisc, softEngines, softPolygon, stresses)

RADIUS = 1e-3
NOTCHED = [(2e-3, 0), (4e-3, 0), (4e-3, 2e-3), (3e-3, 0.6e-3), (2e-3, 2e-3)]


def new_scene():
    O.reset()
    O.materials.append(NeoHookeanMat(label="gel"))
    O.materials.append(FrictMat(density=3000, label="steel"))


def zoo(steps=1, **engines):
    """Two soft grains, one concave, and a rigid body of each shape that softgrain knows, none touching."""
    new_scene()
    O.bodies.append([softDisc((0, 0), RADIUS, "gel", 124, velocity=(0.5, 0, 0)), softPolygon(NOTCHED, "gel", 200)])
    O.bodies.append([rigidDisc((-3e-3, 0), 0.9e-3, "steel"),
                     utils.box((1e-3, -2e-3, 0), (2e-3, 0.3e-3, 1e-3), material="steel", fixed=True),
                     utils.facet([(-3e-3, -2e-3, 0), (-2e-3, -2.5e-3, 0), (-2.5e-3, -2.25e-3, -1e-3)], material="steel"),
                     utils.wall(-3e-3, axis=1, sense=1, material="steel"), utils.wall(6e-3, axis=0, sense=-1, material="steel")])
    O.bodies.appendClumped([utils.sphere((1e-3, 4e-3, 0), 0.6e-3, material="steel"), utils.sphere((2e-3, 4e-3, 0), 0.6e-3, material="steel")])
    O.engines = softEngines(**engines)
    O.run(steps, True)


def area(corners):
    x, y = corners.T
    return abs(numpy.dot(x, numpy.roll(y, -1)) - numpy.dot(y, numpy.roll(x, -1))) / 2


def pixels(**how):
    """The picture of the scene: function from a place [m] to its colour, 0 to 1."""
    figure = snapshot(contacts=False, title="", **how)
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    canvas = FigureCanvasAgg(figure)
    figure.set_dpi(150)
    canvas.draw()
    picture = numpy.asarray(canvas.buffer_rgba()) / 255

    def colour(x, y):
        column, row = figure.axes[0].transData.transform((x * 1e3, y * 1e3))
        return picture[len(picture) - 1 - int(row), int(column), :3]
    return colour


def shows_what_is_there(checks):
    zoo()
    shot = shots.take()
    outlines = numpy.split(shot["outlines"], numpy.cumsum(shot["outline_sizes"])[:-1])
    checks.close_to("the polygon's area", area(outlines[1]) / O.bodies[1].shape.area(), 1, 1e-9)
    curve = pictures._rounded(outlines[0])
    # 80 chords of a circle lose 1.0e-3 of its area, the cubics lie off it by 2.3e-4 radii
    checks.close_to("the disc's area, its outline made round", area(curve) / (math.pi * RADIUS**2), 1, 1.6e-3)
    checks.that("and rounder than its polygon", area(outlines[0]) < 0.99 * area(curve))
    rigid = numpy.split(shot["rigid_outlines"], numpy.cumsum(shot["rigid_sizes"])[:-1])
    found = sorted(area(part) for part in rigid)
    expected = sorted([0, 4 * 2e-3 * 0.3e-3, math.pi * 0.9e-3**2, math.pi * 0.6e-3**2, math.pi * 0.6e-3**2])
    checks.that("a line, a box, a sphere and a clump of two", numpy.allclose(found, expected, rtol=3e-3, atol=1e-12), (found, expected))
    checks.that("two walls", sorted(map(tuple, shot["walls"])) == [(0, 6e-3), (1, -3e-3)], shot["walls"])


def colours_stand_where_the_values_are(checks):
    zoo()
    import matplotlib

    viridis = matplotlib.colormaps["viridis"]
    at = pixels(field=lambda body: arrays.points(body)[:, 0], limits=(-1e-3, 4e-3), unit="m")
    worst = max(abs(at(x, y) - viridis((x + 1e-3) / 5e-3)[:3]).max() for x in numpy.linspace(-0.9e-3, 0.9e-3, 9)
                for y in (-0.3e-3, 0, 0.25e-3))
    checks.that("the field x shows x, to the rim", worst < 0.05, worst)
    checks.that("in the concave grain too", abs(at(3e-3, 0.3e-3) - viridis(0.8)[:3]).max() < 0.03, at(3e-3, 0.3e-3))
    checks.that("not in its notch", (at(3e-3, 1.2e-3) == 1).all(), at(3e-3, 1.2e-3))
    checks.that("rigid bodies are grey", numpy.ptp(at(-3e-3, 0)) == 0 and at(-3e-3, 0)[0] < 0.8, at(-3e-3, 0))
    checks.that("white between them", (at(-1.5e-3, 0) == 1).all())
    checks.that("a wall", at(1.5e-3, -3e-3).max() < 0.5, at(1.5e-3, -3e-3))
    at = pixels(field=lambda body: 1.0, limits=(0, 1), points=True)
    places = arrays.points(O.bodies[0])
    away = places[numpy.linalg.norm(places, axis=1) < 0.9 * RADIUS]     # from the line of the outline
    checks.that("points", all(abs(at(*place) - viridis(1.0)[:3]).max() < 0.01 for place in away[::5]))
    at = pixels(field=None)
    checks.that("no field: pale", abs(at(0, 0) - float(pictures.GRAIN)).max() < 0.01, at(0, 0))


def fields_are_what_they_say(checks):
    zoo(100)
    shot = shots.take(list(shots.FIELDS))
    checks.that("all fields", list(shot["fields"]) == list(shots.FIELDS) and shot["values"].shape == (len(shots.FIELDS), len(shot["points"])))
    values, count = dict(zip(shot["fields"], shot["values"])), shot["point_sizes"][0]
    flown = 0.5 * O.time
    checks.that("a disc in flight: displacement v t", abs(values["displacement"][:count] / flown - 1).max() < 1e-9)
    checks.that("speed v", abs(values["velocity"][:count] / 0.5 - 1).max() < 1e-9)
    bar = snapshot(field="vonMises").axes[-1]
    checks.that("round-off shows no colours", bar.get_ylabel() == "von Mises stress  [Pa]" and bar.get_ylim() == (0, 1), bar.get_ylim())
    checks.that("no stress, no strain", abs(values["vonMises"][:count]).max() < 1 and abs(values["J"][:count] - 1).max() < 1e-9
                and abs(values["stretch"][:count] - 1).max() < 1e-9)
    checks.that("id", set(values["id"]) == {0, 1})
    squeezed(0.15)
    body = O.bodies[0]
    shot = shots.take(["stretch", "pressure"])
    F = arrays.deformationGradients(body)
    C = numpy.einsum("pki,pkj->pij", F, F)
    checks.that("the square of the largest stretch is C's largest eigenvalue",
                numpy.allclose(shot["values"][0]**2, numpy.linalg.eigvalsh(C)[:, 1]))
    checks.that("pressure", (shot["values"][1] == arrays.pressures(body)).all() and shot["values"][1].max() > 1e4)


def squeezed(squeeze):
    """A disc between two plates, at rest on average."""
    new_scene()
    O.bodies.append(softDisc((0, 0), RADIUS, "gel", 124))
    for side in (-1, 1):
        plate = utils.wall(side * RADIUS, axis=1, sense=-side, material="steel")
        plate.state.vel = (0, -side * 1.0, 0)
        O.bodies.append(plate)
    O.engines = softEngines(damping=0.2)
    while RADIUS - O.bodies[2].state.pos[1] < squeeze * RADIUS:
        O.step()


def contacts_are_as_thick_as_their_forces(checks):
    squeezed(0.1)
    shot = shots.take(None)
    forces = [abs(O.forces.f(wall)[1]) for wall in (1, 2)]
    checks.that("forces on the plates", numpy.allclose(sorted(shot["contact_forces"]), sorted(forces), rtol=1e-9), (shot["contact_forces"], forces))
    ends = shot["contact_lines"][:, 1]
    checks.that("from the centre to the plates", numpy.allclose(sorted(abs(ends[:, 1])), RADIUS * 0.9, rtol=2e-3)
                and abs(shot["contact_lines"][:, 0]).max() < 0.02 * RADIUS, shot["contact_lines"])
    figure = snapshot(field=None)
    lines = [part for part in figure.axes[0].collections if len(part.get_linewidths()) == 2]
    widths = lines[-1].get_linewidths()
    checks.that("widths as forces", abs(widths[0] / widths[1] / (shot["contact_forces"][0] / shot["contact_forces"][1]) - 1) < 1e-6, widths)
    told = figure.axes[0].get_legend()
    number, unit = told.texts[0].get_text().split()
    scale = {"N/m": 1, "kN/m": 1e3}[unit]
    checks.close_to("what a thick line means", told.get_lines()[0].get_linewidth() * shot["contact_forces"][0] / (float(number) * scale),
                    widths[0], 1e-3 * widths[0])
    checks.that("none when not wanted", snapshot(field=None, contacts=False).axes[0].get_legend() is None)


def before_the_first_step_and_without_soft_grains(checks):
    new_scene()
    checks.raises("nothing", InputError, ["nothing to draw"], snapshot)
    O.bodies.append([softDisc((0, 0), RADIUS, "gel", angle=0.3), softPolygon(NOTCHED, "gel")])
    shot = shots.take()
    checks.that("undeformed outlines", len(shot["points"]) == 0 and list(shot["outline_sizes"]) == [64, 5])
    checks.that("drawn", snapshot() is not None)
    O.reset()
    O.bodies.append([utils.sphere((0, 0, 0), 1), utils.wall(-1, axis=1)])
    checks.that("rigid bodies alone", len(snapshot().axes) == 1)


def files(checks):
    zoo()
    with Folder() as folder:
        def path(ending):
            return os.path.join(folder, "new", f"picture.{ending}")

        for ending, begin in (("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")):
            snapshot(path(ending))
            with open(path(ending), "rb") as file:
                content = file.read()
            checks.that(ending, content.startswith(begin))
        checks.that("svg: outlines are paths", content.count(b"<path") > 10, content.count(b"<path"))
        checks.that("svg: the field is one picture in it", content.count(b"<image") in (1, 2), content.count(b"<image"))
        with unittest.mock.patch("matplotlib.figure.Figure.savefig", side_effect=KeyboardInterrupt):
            try:
                snapshot(path("svg"))
            except KeyboardInterrupt:
                pass
        with open(path("svg"), "rb") as file:
            checks.that("an interrupted picture leaves the finished one", file.read() == content)
        checks.that("and nothing else", sorted(os.listdir(os.path.join(folder, "new"))) == ["picture.pdf", "picture.png", "picture.svg"])
        size = Image.open(path("png")).size
        checks.that("width times dpi", size[0] == 1200, size)


def nothing_is_cut_off(checks):
    """matplotlib's layout knows little of axes of equal scales."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    zoo()
    for field in ("vonMises", None):
        for count in (1, 2, 4):
            for width in (3 * count, 13):
                shot = shots.take(field)
                figure = pictures.row(count * [shot], count * [None], pictures.Look(), width)
                canvas = FigureCanvasAgg(figure)
                canvas.draw()
                seen = figure.get_tightbbox(canvas.get_renderer())
                room = figure.get_size_inches()
                checks.that(f"{count} panels on {width} inches, {field}", seen.x0 >= 0 and seen.y0 >= 0 and seen.x1 <= room[0]
                            and seen.y1 <= room[1], (seen.extents, room))


def movies(checks):
    zoo()
    with Folder() as folder:
        times = []
        for number in (3, 1, 2):        # names say nothing of the order
            snapshot(os.path.join(folder, f"frame{number}.npz"), ["vonMises", "velocity"])
            times.append(O.time)
            O.run(300, True)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            path = movie(folder, os.path.join(folder, "movie.gif"), field="velocity", framesPerSecond=5)
        film = Image.open(path)
        checks.that("a frame a shot, of 200 ms", film.n_frames == 3 and film.info["duration"] == 200, (film.n_frames, film.info))
        checks.that("in the order of time", [float(shot["time"]) for shot in pictures.read(folder)] == times)
        first = numpy.asarray(film.convert("RGB"))
        film.seek(2)
        checks.that("frames differ where the disc flies", (first != numpy.asarray(film.convert("RGB"))).any())
        shot = pictures.read([os.path.join(folder, "frame3.npz")])[0]
        view = pictures.View([shot])
        checks.that("a shot keeps what it shows", abs(shot["points"] - pictures.read(folder)[0]["points"]).max() == 0 and view.unit == "mm")
        if pictures.movie_name() == "movie.gif":
            checks.raises("no ffmpeg", InputError, ["ffmpeg", ".gif"], lambda: movie(folder, os.path.join(folder, "x.mp4")))
        else:
            checks.that("mp4", os.path.getsize(movie(folder)) > 5000)
        checks.raises("a field that is not there", InputError, ["'J'", "'vonMises'"], lambda: movie(folder, field="J"))
        broken = os.path.join(folder, "frame2.npz")
        with open(broken, "r+b") as file:
            file.truncate(300)
        checks.raises("a damaged shot", InputError, [broken, "damaged"], lambda: movie(folder))
        checks.raises("an empty folder", InputError, ["no shots"], lambda: movie(os.path.join(folder, "none")))
    checks.raises("no frames", InputError, ["the list of frames holds no shots"], lambda: movie([]))


def mistakes(checks):
    zoo()
    count = sum(len(arrays.points(O.bodies[i])) for i in (0, 1))
    for what, words, how in (
            ("a name", ["'stress'", "'vonMises'"], {"field": "stress"}),
            ("a number of values", ["(3,)", "2 numbers", str(count)], {"field": [1, 2, 3]}),
            ("a function's values", ["#0", "124"[:1]], {"field": lambda body: [1, 2]}),
            ("no numbers", ["complex"], {"field": 1j}),
            ("limits", ["(2, 1)", "(lowest, highest)"], {"limits": (2, 1)}),
            ("limits of roots", ["(-1, 1)", "not below 0"], {"limits": (-1, 1), "scale": "root"}),
            ("scale", ["'cubic'", "'root'"], {"scale": "cubic"}),
            ("colormap", ["'jetsam'", "'viridis'"], {"colormap": "jetsam"}),
            ("width", ["width", "0"], {"width": 0}),
            ("ending", [".foo", ".pdf"], {"path": "picture.foo"}),
            ("folder", ["/proc/none", "written"], {"path": "/proc/none/picture.png"})):
        checks.raises(what, InputError, words, lambda: snapshot(**how))
    checks.that("an array of all points, one of all grains", snapshot(field=numpy.arange(count)) and snapshot(field=[1.0, 2.0]))
    checks.that("into one's own axes", own_axes())


def own_axes():
    from matplotlib.figure import Figure

    figure = Figure()
    left, right = figure.subplots(1, 2)
    return snapshot(axes=right) is figure and len(right.collections) > 3 and not left.collections


def chains_agree(checks):
    squeezed(0.1)
    checks.that("as many as stresses.forceChains(0) says", len(shots.take(None)["contact_forces"]) == len(stresses.forceChains(0).ids) == 2)
    O.bodies.append(softBox(1, 1, "steel"))
    checks.that("a box far away is in the view", pictures.View([shots.take(None)]).unit == "mm")


run_tests(shows_what_is_there, colours_stand_where_the_values_are, fields_are_what_they_say, contacts_are_as_thick_as_their_forces,
          before_the_first_step_and_without_soft_grains, files, nothing_is_cut_off, movies, mistakes, chains_agree)
