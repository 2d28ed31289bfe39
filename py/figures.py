# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures 1 to 5 of Vu et al. 2017 (EPJ Web of Conferences 140, 15031) from folders of finished or unfinished runs.

Needs numpy and matplotlib, not YADE. softgrain.figures.draw(folders, out) draws the curves of all folders together; figure 1 is of
the first."""
import argparse
import io
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402

from . import jamming, pictures
from .records import read_json, read_table, replacing

# Okabe and Ito's colours, told apart by colour-blind readers; each curve has its own dash and marker too
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")
MOMENTS = (("start", "start"), ("jamming", "jamming"), ("end", "end"))    # of figure 1
PANEL = 4.3         # width of a packing [inches]
MARKERS = ("o", "s", "^", "D", "v", "P")
STYLE = {"font.size": 11, "axes.labelsize": 12, "legend.fontsize": 10, "axes.grid": True, "grid.color": "0.9",
         "axes.axisbelow": True, "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
         "savefig.dpi": 160, "figure.figsize": (6.4, 4.4), "figure.constrained_layout.use": True}


class Curves:
    """The table of one run folder and how it is drawn."""

    def __init__(self, folder, index):
        names = [name for name in sorted(os.listdir(folder)) if name.endswith(".csv")]
        if not names:
            raise ValueError(f"{folder} holds no csv file: give the folder of a run.")
        self.folder, self.table = folder, read_table(os.path.join(folder, names[0]))
        if not len(self.table.get("strain", ())):
            raise ValueError(f"{os.path.join(folder, names[0])} holds no rows of a compaction.")
        self.name = names[0][:-len(".csv")]
        self.label = self._label(_parameters(folder))
        self.colour, self.marker = COLOURS[index % len(COLOURS)], MARKERS[index % len(MARKERS)]
        self.jamming = jamming.jamming_point(self.table)

    def __getitem__(self, column):
        return self.table[column]

    def _label(self, parameters):
        if self.name.startswith("rigid"):
            label = "rigid discs"
        else:
            label = {"nh": "Neo-Hookean", "mr": "Mooney-Rivlin", "plastic": "elastoplastic",
                     "ogden": "Ogden"}.get(parameters.get("material"), self.name)
        if parameters.get("friction"):
            label += f", friction {parameters['friction']:g}"
        return label


def draw(folders, out):
    """Writes figure1.png to figure5.png into the folder `out` and returns their paths. Raises ValueError, one
    sentence, for a folder without a run."""
    curves = [Curves(folder, i) for i, folder in enumerate(folders)]
    _tell_apart(curves)
    written = []
    with plt.rc_context(STYLE):
        for number, figure in ((1, snapshots), (2, _volume_change), (3, _solid_fraction), (4, _stress),
                               (5, _coordination)):
            drawn = figure(curves[0].folder) if number == 1 else figure(curves)
            if drawn is None:
                continue
            path = os.path.join(out, f"figure{number}.png")
            save(drawn, path)
            written.append(path)
    return written


def save(figure, path):
    """Writes a figure to a file, in one stroke, and closes it."""
    pictures.save(figure, path, None)
    plt.close(figure)


def snapshots(folder, moments=MOMENTS, points=True):
    """Figure 1, from snapshot_start.npz, _jamming, _end in the folder, those that are there; None without any. moments: which, as
    (name, title); points: grains with their material points, else filled."""
    taken = [(title, os.path.join(folder, f"snapshot_{name}.npz")) for name, title in moments]
    taken = [(title, pictures.read([path])[0]) for title, path in taken if os.path.exists(path)]
    if not taken:
        return None
    titles = [r"%s:  $\varepsilon$ = %.3f,  $\Phi$ = %.3f" % (title, shot["strain"], shot["solid_fraction"]) for title, shot in taken]
    return pictures.row([shot for _, shot in taken], titles, pictures.Look(contacts=False, points=points, scale="root"), PANEL * len(taken))


def draw_picture(folder, path):
    """Writes figure 1 without jamming, small, for a page that shows what this is about. Raises ValueError, one
    sentence, for a folder without snapshots."""
    from PIL import Image       # comes with matplotlib

    with plt.rc_context({**STYLE, "savefig.dpi": 110}):
        drawn = snapshots(folder, (("start", "before"), ("end", "after")), points=False)
        if drawn is None:
            raise ValueError(f"{folder} holds no snapshots: give the folder of a finished run of compaction.py.")
        content = io.BytesIO()
        drawn.savefig(content, format="png")
        plt.close(drawn)
    small = Image.open(content).convert("RGB").quantize(256, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    with replacing(path) as unfinished:
        small.save(unfinished, format="png", optimize=True)      # a third of the size


def _volume_change(curves):
    if not any(curve["log_volume_change"].any() for curve in curves):
        return None     # rigid grains
    figure, axes = plt.subplots()
    for curve in curves:
        axes.plot(curve["strain"], 100 * curve["log_volume_change"], color=curve.colour, label=curve.label)
    _mark_jamming(axes, curves, "log_volume_change", 100)
    axes.set_xlabel(r"cumulative vertical strain  $\varepsilon = \ln(h_0/h)$  [-]")
    axes.set_ylabel(r"volume change of the grains  $\ln(V_s/V_{s0})$  [%]")
    axes.legend()
    return figure


def _solid_fraction(curves):
    figure, axes = plt.subplots()
    for curve in curves:
        axes.plot(curve["strain"], curve["solid_fraction"], color=curve.colour, label=curve.label)
    first = max(curves, key=lambda curve: curve["strain"][-1])
    start = first["solid_fraction"][0] / numpy.exp(first["strain"][0] + first["log_volume_change"][0])
    axes.plot(first["strain"], start * numpy.exp(first["strain"]), color="0.3", linestyle="--", linewidth=1,
              label=r"incompressible grains, $\Phi_0'\,e^{\varepsilon}$ with $\Phi_0' = %.3f$" % start)
    _mark_jamming(axes, curves, "solid_fraction", 1)
    axes.set_xlabel(r"cumulative vertical strain  $\varepsilon = \ln(h_0/h)$  [-]")
    axes.set_ylabel(r"solid fraction  $\Phi$  [-]")
    axes.legend()
    return figure


def _stress(curves):
    jammed = [curve for curve in curves if curve.jamming]
    figure, axes = plt.subplots()
    for curve in jammed:
        strain = curve["strain"] - curve.jamming["strain"]
        beyond = strain >= 0
        axes.plot(numpy.append(0, strain[beyond]), numpy.append(1, curve["stress_bottom_Pa"][beyond] / jamming.STRESS),
                  color=curve.colour, label=curve.label)
    axes.set_xlabel(r"cumulative vertical strain from the reference state  $\varepsilon'$  [-]")
    axes.set_ylabel(r"axial stress on the bottom wall  $\sigma/\sigma_0$  [-]")
    if jammed:
        axes.legend(title=r"$\sigma_0$ = %g kPa at $\varepsilon' = 0$" % (jamming.STRESS / 1e3), alignment="left")
    else:
        _say(axes, "no run has jammed")
    return figure


def _coordination(curves):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), width_ratios=(1, 1))
    for curve in curves:
        left.plot(curve["solid_fraction"], curve["coordination"], curve.marker, markersize=3, color=curve.colour,
                  label=curve.label, alpha=0.7)
    _mark_jamming(left, curves, "coordination", 1, along="solid_fraction")
    left.set_xlabel(r"solid fraction  $\Phi$  [-]")
    left.set_ylabel(r"contacts per grain without rattlers  $Z$  [-]")
    left.legend()
    lines = 0
    for curve in curves:
        shades = (curve.colour, _lighter(curve.colour, 0.45), _lighter(curve.colour, 0.7))
        for i, fit in enumerate(jamming.growth_fits(curve.table)):
            right.plot(fit["x"], fit["y"], curve.marker, markersize=3, color=shades[i],
                       label=r"%s: $\Phi_0$ = %.3f, $Z_0$ = %.2f, residual %.3f, best exponent %.2f" % (
                           curve.label, fit["phi0"], fit["Z0"], fit["residual"], fit["best_exponent"]))
            lines += 1
    share = numpy.linspace(0, 1, 200)
    right.plot(share, share**jamming.EXPONENT, color="0.1", linewidth=1.3, label="eq. 10: exponent 0.5, no fitting")
    right.set_xlabel(r"$(\Phi-\Phi_0)/(\Phi_1-\Phi_0)$  [-]")
    right.set_ylabel(r"$(Z-Z_0)/(Z_1-Z_0)$  [-]")
    right.set_xlim(-0.03, 1.03)
    right.set_ylim(-0.35 - 0.07 * lines, 1.15)
    right.set_yticks(numpy.arange(0, 1.01, 0.2))
    right.legend(fontsize=8, loc="lower right", markerscale=1.5)
    if not lines:
        _say(right, "no run reaches far enough\nbeyond jamming")
    return figure


def _mark_jamming(axes, curves, column, scale, along="strain"):
    marked = [curve for curve in curves if curve.jamming]
    for curve in marked:
        value = curve.jamming["coordination"] if column == "coordination" else numpy.interp(
            curve.jamming["strain"], curve["strain"], curve[column])
        if value is None:
            continue
        axes.plot(curve.jamming[along], scale * value, curve.marker, markersize=9, markerfacecolor="white",
                  markeredgewidth=1.8, color=curve.colour,
                  label="jamming (%g kPa)" % (jamming.STRESS / 1e3) if curve is marked[0] else None)


def _say(axes, text):
    axes.text(0.5, 0.6, text, transform=axes.transAxes, ha="center", va="center", color="0.4")


def _lighter(colour, share):
    rgb = numpy.array(matplotlib.colors.to_rgb(colour))
    return tuple(rgb + (1 - rgb) * share)


def _tell_apart(curves):
    """Adds the folder's name to labels that several runs share."""
    labels = [curve.label for curve in curves]
    for curve in curves:
        if labels.count(curve.label) > 1:
            curve.label += f" ({os.path.basename(os.path.abspath(curve.folder))})"


def _parameters(folder):
    for name in ("summary.json", "checkpoint.json"):
        try:
            return read_json(os.path.join(folder, name)).get("parameters", {})
        except (OSError, ValueError):
            continue
    return {}


def main():
    parser = argparse.ArgumentParser(description="Figures 1 to 5 from the folders of compactions; the curves of all "
                                                 "folders together, figure 1 of the first.")
    parser.add_argument("folders", nargs="+", metavar="DIR", help="folder of a run")
    parser.add_argument("--out", default=None, metavar="DIR", help="folder for the figures; default: the first DIR")
    parser.add_argument("--picture", default=None, metavar="FILE",
                        help="instead of the figures: the packing of the first DIR before and after, in one png file")
    options = parser.parse_args()
    out = options.out or options.folders[0]
    try:
        if options.picture:
            draw_picture(options.folders[0], options.picture)
            print(options.picture)
            return 0
        os.makedirs(out, exist_ok=True)
        print("\n".join(draw(options.folders, out)))
    except (OSError, ValueError) as error:
        print(f"figures.py: {error}", file=sys.stderr)
        return 2
    return 0
