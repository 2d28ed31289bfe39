# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures and movies of scenes on matplotlib, without a display: snapshot() of the scene as it is, movie() of the shots of a run.
Shots are taken by shots.py; all but snapshot() works without YADE."""
import glob
import os
import zipfile
import zlib

import numpy

from .checks import InputError, positive
from .records import replacing

GRAIN, EDGE, WALL, RIGID, CONTACT = "0.9", "0.15", "0.1", "0.6", "black"
SCALES = ("linear", "root")
WIDTH = 6.0         # of a picture [inches]
BESIDE, ABOVE = (0.6, 1.4), 1.0     # room for labels without and with a bar of colours, for title and labels [inches]
LEAST_HEIGHT, MOST_HEIGHT = 2.0, 2.5    # of a picture [inches], [its width]
MARGIN = 0.02       # around what is drawn [longer side]
SMOOTH = 72         # corners that a rounded outline is drawn with, at least
THICK = 4.0, 0.1    # contact line of a force below which most others lie: no more than [points], [width of a grain]
DOT = 1.0           # width of a dot [spacing of the points of its grain]
SPREAD = 99         # per cent of the values that the colours tell apart
NOISE = {"Pa": 1e-3}    # by unit: values that are round-off, such as stresses of grains in flight; others: 1e-12, also of differences
FRAMES_A_SECOND = 12


def snapshot(path=None, field="vonMises", contacts=True, points=False, limits=None, scale="linear", colormap="viridis", label=None,
             unit=None, title=None, width=WIDTH, dpi=200, axes=None):
    """Draws the scene as it is: soft grains filled with a field, rigid bodies grey, walls as lines, contacts as lines as thick as
    their normal forces.

    path      file to write, of any kind that matplotlib knows (png, pdf, svg): the field in it has dpi dots per inch, all else is lines
              and letters. With the ending .npz the shot itself is written, for movie(). None: nothing is written
    field     "vonMises" or "pressure" [Pa], "J" or "stretch" (the largest principal one) [-], "plasticStrain" [-], "velocity" (speed)
              [m/s], "displacement" [m], "id"; a function from a body to a number, or to numbers one a material point; an array of such
              numbers of all soft grains; None: grains are pale. Of a shot also a list of names
    contacts  draw the contact network
    points    draw material points as dots, instead of filling the grains
    limits    (lowest, highest) value of the colours, in the unit of the field; None: from 0, or the lowest if that is negative or the
              field is no magnitude, to what 99 % of the values stay below
    scale     "linear", or "root": colours by the square root, which shows small values beside large ones
    colormap  a name of matplotlib's; viridis and cividis are even and safe for colour-blind readers
    label, unit  of the field, where it has no name of the above
    title     None: the time
    width     of the picture [inches]
    axes      of matplotlib, to draw into; path and width are without effect
    Returns the matplotlib figure; None for a shot. Raises InputError.
    """
    from . import shots

    width, dpi = positive("snapshot: width", width, "inches"), positive("snapshot: dpi", dpi)
    shot = shots.take(field, label, unit)
    if path is not None and axes is None and str(path).endswith(".npz"):
        with _writing(path):
            shots.save(path, shot)
        return None
    look = Look(contacts, points, limits, scale, colormap)
    if axes is not None:
        look.colours_of([shot])
        look.draw(axes, shot, View([shot]))
        return axes.figure
    figure = row([shot], [title], look, width)
    if path is not None:
        save(figure, path, dpi)
    return figure


def movie(frames, path=None, field=None, contacts=True, points=False, limits=None, scale="linear", colormap="viridis", width=WIDTH,
          dpi=150, framesPerSecond=FRAMES_A_SECOND):
    """Makes a movie of shots, all with the same colours and view.

    frames    a folder of npz files that snapshot() or a run has written, or a list of such files; ordered by time
    path      file to write: mp4 (by ffmpeg) or gif; None: movie.mp4, or movie.gif without ffmpeg, in the folder
    field     which of the fields in the shots; None: the first
    Others are those of snapshot(). Returns the path. Raises InputError.
    """
    from matplotlib import animation

    shots = read(frames)
    folder = frames if isinstance(frames, (str, os.PathLike)) else os.path.dirname(frames[0])
    path = os.fspath(path or os.path.join(folder, movie_name()))
    rate = positive("movie: framesPerSecond", framesPerSecond)
    if path.endswith(".gif"):
        writer = animation.PillowWriter(fps=rate)
    elif animation.writers.is_available("ffmpeg"):
        writer = animation.FFMpegWriter(fps=rate)
    else:
        raise InputError(f"movie: {path} wants ffmpeg, which is not there: apt-get install ffmpeg, or give a path that ends in .gif.")
    look, view = Look(contacts, points, limits, scale, colormap, field), View(shots)
    figure = row(shots[:1], [None], look, positive("movie: width", width, "inches"), common=shots)
    with _writing(path), replacing(path) as unfinished, writer.saving(figure, unfinished, positive("movie: dpi", dpi)):
        for shot in shots:
            axes = figure.axes[0]
            axes.clear()
            look.draw(axes, shot, view)
            axes.set_title(view.time(shot), loc="left", fontsize="medium")
            writer.grab_frame()
    return path


def movie_name():
    """Of a movie that can be made here."""
    from matplotlib import animation

    return "movie.mp4" if animation.writers.is_available("ffmpeg") else "movie.gif"


def read(frames):
    """Shots in the order of time, from a folder or a list of npz files. Raises InputError."""
    single = isinstance(frames, (str, os.PathLike))
    paths = sorted(glob.glob(os.path.join(glob.escape(os.fspath(frames)), "*.npz"))) if single else list(frames)
    if not paths:
        raise InputError(f"{frames if single else 'the list of frames'} holds no shots: write some with snapshot('NAME.npz').")
    shots = []
    for path in paths:
        try:
            shot = dict(numpy.load(path))
            shot["outlines"], shot["rigid_sizes"], shot["values"], shot["contact_lines"]    # KeyError without
        except (OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile, zlib.error):
            raise InputError(f"{path} is no shot, or is damaged: give npz files that snapshot() has written.") from None
        shots.append(shot)
    return sorted(shots, key=lambda shot: float(shot["time"]))


def row(shots, titles, look, width, common=None, within=None):
    """A figure, or the subfigure `within`, of shots side by side with one bar of colours. titles: None stands for the time; width of all
    [inches]; common: shots that the colours and the view are chosen for, by default these."""
    from matplotlib.figure import Figure
    from matplotlib.ticker import MaxNLocator

    view = View(common or shots)
    look.colours_of(common or shots)
    # no less, or matplotlib's layout, which knows nothing of equal scales, cuts the title off
    height = view.height((width - BESIDE[look.colours is not None]) / len(shots)) + ABOVE
    figure = within or Figure(figsize=(width, min(max(height, LEAST_HEIGHT), MOST_HEIGHT * width)), layout="constrained")
    panels = figure.subplots(1, len(shots), sharey=True, squeeze=False)[0]
    for axes, shot, title in zip(panels, shots, titles):
        look.draw(axes, shot, view, first=axes is panels[0], last=axes is panels[-1])
        axes.set_title(view.time(shot) if title is None else title, loc="left", fontsize="medium")
    if look.colours is not None:
        bar = figure.colorbar(look.colours, ax=list(panels), label=look.label, fraction=0.05, pad=0.02, extend=look.extend)
        bar.locator = MaxNLocator(integer=True) if look.counts else bar.locator
    return figure


def save(figure, path, dpi=200):
    """Writes a figure to a file of any kind that matplotlib knows, in one stroke. Raises InputError."""
    with _writing(path), replacing(path) as unfinished:
        figure.savefig(unfinished, dpi=dpi)


class _writing:
    """Around the writing of a file: what goes wrong is an InputError that names it."""

    def __init__(self, path):
        self.path = path

    def __enter__(self):
        folder = os.path.dirname(os.path.abspath(self.path))
        try:
            os.makedirs(folder, exist_ok=True)
        except OSError as error:
            raise InputError(f"{self.path} cannot be written ({error.strerror}): give another path.") from None

    def __exit__(self, _, error, __):
        if isinstance(error, OSError):
            raise InputError(f"{self.path} cannot be written ({error.strerror or error}): give another path.") from None
        if isinstance(error, ValueError) and not isinstance(error, InputError) and "not supported" in str(error):
            raise InputError(f"{self.path} has an ending that no format has: give .png, .pdf, .svg or .npz.") from None


class View:
    """What is to be seen of shots: a box about all their bodies, and the unit of length that suits it."""

    def __init__(self, shots):
        places = [shot[part] for shot in shots for part in ("outlines", "rigid_outlines")]
        for axis in (0, 1):
            places += [_walls(shot, axis) for shot in shots]
        places = numpy.concatenate(places)
        self.low, self.high = numpy.nanmin(places, axis=0), numpy.nanmax(places, axis=0)
        longer = max(self.high - self.low)
        self.unit, self.factor = next((unit, factor) for unit, factor, least in (("m", 1, 2), ("mm", 1e3, 2e-3), ("µm", 1e6, 0))
                                      if longer >= least)
        self.margin = MARGIN * longer
        self.latest = max(abs(float(shot["time"])) for shot in shots)

    def time(self, shot):
        """Of a shot in words, all in one unit and with the decimals of the latest."""
        unit, factor = _unit("s", self.latest)
        decimals = 3 - int(numpy.floor(numpy.log10(self.latest * factor))) if self.latest > 0 else 0
        return f"t = {float(shot['time']) * factor:.{max(decimals, 0)}f} {unit}"

    @staticmethod
    def grain_width(shot):
        """Of a middling grain or rigid body [m]."""
        parts = _split(shot["outlines"], shot["outline_sizes"]) + _split(shot["rigid_outlines"], shot["rigid_sizes"])
        return numpy.median([numpy.ptp(part, axis=0).max() for part in parts])

    def points_per_metre(self, axes):
        """Scale of axes, about [points/m]."""
        room = axes.get_window_extent()
        return 72 / axes.figure.dpi * min(numpy.array([room.width, room.height]) / (self.high - self.low + 2 * self.margin))

    def height(self, width):
        """Of a panel of this width [inches]."""
        return width * (self.high[1] - self.low[1] + 2 * self.margin) / (self.high[0] - self.low[0] + 2 * self.margin)

    def show(self, axes, first):
        """Makes axes of matplotlib show the box; first: of a row."""
        low, high = (self.low - self.margin) * self.factor, (self.high + self.margin) * self.factor
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])
        axes.set_aspect("equal")
        axes.grid(False)
        for side in axes.spines.values():
            side.set_visible(False)
        axes.set_xlabel(f"x  [{self.unit}]")
        axes.tick_params(left=first)
        if first:
            axes.set_ylabel(f"y  [{self.unit}]")


class Look:
    """How shots are drawn; arguments as of snapshot(). field: None: the first of a shot."""

    def __init__(self, contacts=True, points=False, limits=None, scale="linear", colormap="viridis", field=None):
        self.contacts, self.points, self.limits, self.scale, self.colormap = contacts, points, limits, scale, colormap
        self.field, self.colours, self.force = field, None, 0.0
        if scale not in SCALES:
            raise InputError(f"scale '{scale}' is none: give {' or '.join(map(repr, SCALES))}.")

    def colours_of(self, shots):
        """Chooses colours, and the force of a thick line, for these shots."""
        from matplotlib import cm, colors

        forces = [shot["contact_forces"] for shot in shots if len(shot["contact_forces"])]
        self.force = round_up(max(numpy.percentile(part, 95) for part in forces)) if self.contacts and forces else 0.0
        known = [self._number(shot) for shot in shots]
        if None in known:
            return
        values = [shot["values"][number] for number, shot in zip(known, shots)]
        values = [part[numpy.isfinite(part)] for part in values]
        values = [part for part in values if len(part)]
        if not values:
            return
        unit = str(shots[0]["units"][known[0]])
        low, high = self._limits(values, unit)
        self.counts = not any(numpy.any(part % 1) for part in values)
        unit, self.factor = _unit(unit, max(abs(low), abs(high)))
        self.label = f"{shots[0]['labels'][known[0]]}{f'  [{unit}]' if unit else ''}"
        self.extend = {(False, False): "neither", (False, True): "max", (True, False): "min", (True, True): "both"}[
            bool(min(part.min() for part in values) < low), bool(max(part.max() for part in values) > high)]
        bounds = low * self.factor, high * self.factor
        norm = colors.PowerNorm(0.5, *bounds) if self.scale == "root" else colors.Normalize(*bounds)
        try:
            self.colours = cm.ScalarMappable(norm, self.colormap)
        except ValueError:
            raise InputError(f"colormap '{self.colormap}' is none of matplotlib's: give 'viridis' or 'cividis'.") from None

    def _limits(self, values, unit):
        """Of the colours, for the values of each shot."""
        if self.limits is not None:
            try:
                low, high = map(float, self.limits)
            except (TypeError, ValueError):
                low = high = 0.0
            if not low < high or self.scale == "root" and low < 0:
                raise InputError(f"limits is {self.limits!r}: give (lowest, highest) value of the colours"
                                 f"{', not below 0 with the scale root' if self.scale == 'root' else ''}.")
            return low, high
        low = min(numpy.percentile(part, 100 - SPREAD) for part in values)
        high = max(numpy.percentile(part, SPREAD) for part in values)
        noise, magnitude = NOISE.get(unit, 1e-12), unit not in ("-", "")
        if magnitude:
            high = round_up(high) if high > noise else 0.0
            low = -round_up(-low) if low < -max(0.01 * high, noise) else 0.0
        if self.scale == "root":
            low = max(low, 0.0)
        if high - low > 1e-12 * abs(high):
            return low, high
        return (0.0, 1.0) if magnitude else (low - 0.5, low + 0.5)

    def _number(self, shot):
        """Place of the field among those of a shot; None where it has none."""
        names = [str(name) for name in shot["fields"]]
        if self.field is None:
            return 0 if names else None
        if self.field not in names:
            raise InputError(f"field '{self.field}' is not in the shots, which hold {', '.join(map(repr, names)) or 'none'}.")
        return names.index(self.field)

    def draw(self, axes, shot, view, first=True, last=True):
        """Draws a shot into axes of matplotlib. first, last: of a row."""
        from matplotlib.collections import LineCollection, PolyCollection

        view.show(axes, first)
        corners = [_rounded(part) if rounded else part
                   for part, rounded in zip(_split(shot["outlines"], shot["outline_sizes"]), shot["rounded"])]
        shown = [part * view.factor for part in corners]
        axes.add_collection(PolyCollection(shown, facecolors=GRAIN, edgecolors="none", zorder=1))
        if self.colours is not None:
            (self._dots if self.points else self._fill)(axes, shot, corners, view)
        axes.add_collection(PolyCollection(shown, facecolors="none", edgecolors=EDGE, linewidths=0.5, zorder=3))
        bodies = [part * view.factor for part in _split(shot["rigid_outlines"], shot["rigid_sizes"])]
        axes.add_collection(PolyCollection(bodies, facecolors=RIGID, edgecolors=WALL, linewidths=0.8, zorder=3))
        walls = numpy.concatenate([_walls(shot, 0), _walls(shot, 1)]).reshape(-1, 2, 2)
        ends = [numpy.where(numpy.isnan(wall), [view.low, view.high], wall) * view.factor for wall in walls]
        axes.add_collection(LineCollection(ends, colors=WALL, linewidths=1.6, zorder=3.5, capstyle="projecting"))
        if self.force:
            self._network(axes, shot, view, last)

    def _fill(self, axes, shot, corners, view):
        """Grains filled with the field, which between points is linear."""
        from matplotlib.collections import TriMesh
        from matplotlib.tri import Triangulation

        values = shot["values"][self._number(shot)] * self.factor
        places, triangles, colours, first = [], [], [], 0
        for outline, points, own in zip(corners, _split(shot["points"], shot["point_sizes"]), _split(values, shot["point_sizes"])):
            if not len(points):
                continue
            places += [points, outline]
            colours += [own, _at_rim(outline, points, own)]
            triangles.append(_triangles(points, outline) + first)
            first += len(points) + len(outline)
        if not triangles:
            return
        places = numpy.concatenate(places) * view.factor
        mesh = TriMesh(Triangulation(places[:, 0], places[:, 1], numpy.concatenate(triangles)), norm=self.colours.norm,
                       cmap=self.colours.cmap, zorder=2, rasterized=True)
        mesh.set_array(numpy.concatenate(colours))
        mesh.set_in_layout(False)       # with autolim it would become a path a triangle, which takes long
        axes.add_collection(mesh, autolim=False)

    def _dots(self, axes, shot, corners, view):
        """Material points as dots of the colours of the field."""
        from matplotlib.collections import EllipseCollection

        points, counts = shot["points"] * view.factor, shot["point_sizes"]
        spacing = DOT * view.factor * numpy.repeat(numpy.sqrt([_area(part) / max(n, 1) for part, n in zip(corners, counts)]), counts)
        dots = EllipseCollection(spacing, spacing, 0, units="xy", offsets=points, offset_transform=axes.transData, norm=self.colours.norm,
                                 cmap=self.colours.cmap, linewidths=0, zorder=2, rasterized=True)
        dots.set_array(shot["values"][self._number(shot)] * self.factor)
        axes.add_collection(dots)

    def _network(self, axes, shot, view, told):
        """Contacts, and, where that is to be told, what a thick line means."""
        from matplotlib.collections import LineCollection
        from matplotlib.lines import Line2D

        thick = min(THICK[0], THICK[1] * view.grain_width(shot) * view.points_per_metre(axes))
        widths = thick * numpy.maximum(shot["contact_forces"], 0) / self.force
        axes.add_collection(LineCollection(shot["contact_lines"] * view.factor, linewidths=numpy.minimum(widths, 3 * thick),
                                           colors=CONTACT, capstyle="round", zorder=4, alpha=0.8))
        if not told:
            return
        unit, factor = _unit("N/m", self.force)
        axes.legend(handles=[Line2D([], [], color=CONTACT, linewidth=thick, label=f"{self.force * factor:g} {unit}")], frameon=False,
                    loc="lower right", bbox_to_anchor=(1, 1), borderpad=0, borderaxespad=0.3)


def round_up(value):
    """The next of a few round numbers times a power of ten, for bars that end on a round number."""
    if not value > 0:
        return 1.0
    power = 10.0**numpy.floor(numpy.log10(value))
    return float(next(step * power for step in (1, 1.5, 2, 3, 4, 5, 6, 8, 10) if step * power >= value * 0.999))


def _unit(unit, largest):
    """The unit with the prefix that suits the largest value, and the factor to it."""
    if unit in ("", "-") or largest <= 0:
        return unit, 1.0
    power = int(min(max(numpy.floor((numpy.log10(largest) + 1e-9) / 3), -3), 3))
    return {-3: "n", -2: "µ", -1: "m", 0: "", 1: "k", 2: "M", 3: "G"}[power] + unit, 10.0**(-3 * power)


def _split(values, sizes):
    return numpy.split(values, numpy.cumsum(sizes)[:-1]) if len(sizes) else []


def _walls(shot, axis):
    """Ends of the walls across an axis, two rows each, as far as the walls across the other axis reach; where there are none, nan, which
    stands for the edge of the picture."""
    walls = shot["walls"]
    mine, others = walls[walls[:, 0] == axis, 1], walls[walls[:, 0] == 1 - axis, 1]
    reach = (others.min(), others.max()) if len(others) > 1 else (numpy.nan, numpy.nan)
    ends = numpy.empty((2 * len(mine), 2))
    ends[:, axis] = numpy.repeat(mine, 2)
    ends[:, 1 - axis] = numpy.tile(reach, len(mine))
    return ends


def _rounded(outline):
    """Points of the closed curve through an outline that contacts see, a cubic between neighbours (Catmull and Rom 1974)."""
    between = -(-SMOOTH // len(outline))
    before, ahead, beyond = (numpy.roll(outline, shift, axis=0) for shift in (1, -1, -2))
    parts = []
    for t in numpy.arange(between) / between:
        parts.append(outline + t / 2 * (ahead - before + t * (2 * before - 5 * outline + 4 * ahead - beyond
                                                              + t * (3 * (outline - ahead) + beyond - before))))
    return numpy.stack(parts, axis=1).reshape(-1, 2)


def _at_rim(outline, points, values):
    """Values at an outline: means of the three nearest points, the nearer the heavier."""
    apart = ((outline[:, None] - points[None])**2).sum(axis=2)
    near = numpy.argpartition(apart, min(3, len(points) - 1), axis=1)[:, :3]
    weight = 1 / numpy.maximum(numpy.take_along_axis(apart, near, axis=1), 1e-300)
    return (weight * values[near]).sum(axis=1) / weight.sum(axis=1)


def _triangles(points, outline):
    """Triangles between the points of a grain and its outline, as numbers in the one list after the other; none outside of it."""
    from matplotlib.path import Path
    from matplotlib.tri import Triangulation

    places = numpy.concatenate([points, outline]).astype(float)
    places = (places - places.mean(axis=0)) / numpy.ptp(places, axis=0).max()
    triangles = Triangulation(places[:, 0], places[:, 1]).triangles
    inside = Path(places[len(points):]).contains_points(places[triangles].mean(axis=1))
    return triangles[inside]


def _area(corners):
    here, ahead = corners - corners[0], numpy.roll(corners, -1, axis=0) - corners[0]
    return 0.5 * abs(numpy.sum(here[:, 0] * ahead[:, 1] - ahead[:, 0] * here[:, 1]))
