# SPDX-License-Identifier: GPL-2.0-or-later
"""Figure 1: snapshots of a compaction, grains drawn with their material points. Numpy and matplotlib only.

A snapshot is a npz file: width, height [m] of the box, strain, solid_fraction, outlines (corners of all grains one
after the other) [m], outline_sizes (corners of each grain) and, for soft grains, points [m], point_sizes (points of
each grain) and the points' von_mises_Pa."""
import os

import numpy

MOMENTS = (("start", "start"), ("jamming", "jamming"), ("end", "end"))
FIELD, SCALE, LABEL = "von_mises_Pa", 1e-6, "von Mises stress  [MPa]"
DOT = 1.0           # width of a dot [spacing of the points of its grain]
GRAIN, EDGE, BOX, RIGID = "0.93", "0.15", "0.1", "0.6"


def draw_snapshots(folder, moments=MOMENTS):
    """The figure from snapshot_start.npz, _jamming, _end in the folder, those that are there; None without any.
    moments: which, as (name, title)."""
    import matplotlib.pyplot as plt
    from matplotlib.colors import PowerNorm

    taken = [(title, os.path.join(folder, f"snapshot_{name}.npz")) for name, title in moments]
    taken = [(title, dict(numpy.load(path))) for title, path in taken if os.path.exists(path)]
    if not taken:
        return None
    tallest = max(float(shot["height"]) for _, shot in taken)
    width = float(taken[0][1]["width"])
    panel = 4.3
    figure, axes = plt.subplots(1, len(taken), figsize=(panel * len(taken) + 0.9, panel * tallest / width + 0.75),
                                squeeze=False, sharey=True)
    fields = [shot[FIELD] * SCALE for _, shot in taken if FIELD in shot]
    # the root shows the small stresses at jamming beside the large ones at the end
    norm = PowerNorm(0.5, 0, round_up(max(numpy.percentile(field, 99) for field in fields))) if fields else None
    dots = None
    for axis, (title, shot) in zip(axes[0], taken):
        dots = draw_packing(axis, shot, norm, panel / width) or dots
        axis.set_title(r"%s:  $\varepsilon$ = %.3f,  $\Phi$ = %.3f" % (title, shot["strain"], shot["solid_fraction"]),
                       fontsize=11)
        axis.set_xlim(-0.02 * width * 1e3, 1.02 * width * 1e3)
        axis.set_ylim(-0.02 * width * 1e3, tallest * 1e3 + 0.02 * width * 1e3)
        axis.set_xlabel("x  [mm]")
    axes[0][0].set_ylabel("y  [mm]")
    if dots is not None:
        figure.colorbar(dots, ax=list(axes[0]), label=LABEL, fraction=0.03, pad=0.01, extend="max")
    return figure


def draw_packing(axis, shot, norm, inches_per_metre):
    """Grains, points, and box or rigid bodies of one snapshot, in mm; the dots, or None for rigid grains."""
    from matplotlib.collections import PolyCollection
    from matplotlib.patches import Rectangle

    corners = numpy.split(shot["outlines"] * 1e3, numpy.cumsum(shot["outline_sizes"])[:-1])
    axis.add_collection(PolyCollection(corners, facecolors=GRAIN, edgecolors="none", zorder=1))
    axis.add_collection(PolyCollection(corners, facecolors="none", edgecolors=EDGE, linewidths=0.6, zorder=2.5))
    if "width" in shot:
        width, height = float(shot["width"]), float(shot["height"])
        axis.add_patch(Rectangle((0, 0), width * 1e3, height * 1e3, fill=False, edgecolor=BOX, linewidth=1.6, zorder=3))
    elif len(shot["rigid_sizes"]):
        bodies = numpy.split(shot["rigid_outlines"] * 1e3, numpy.cumsum(shot["rigid_sizes"])[:-1])
        axis.add_collection(PolyCollection(bodies, facecolors=RIGID, edgecolors=BOX, linewidths=1.2, zorder=3))
    axis.set_aspect("equal")
    axis.grid(False)
    for side in axis.spines.values():
        side.set_visible(False)
    if FIELD not in shot:
        return None
    points, counts = shot["points"], shot["point_sizes"]
    spacing = numpy.repeat(numpy.sqrt(_areas(corners) / counts), counts) * 1e-3
    size = DOT * spacing * inches_per_metre * 72
    return axis.scatter(points[:, 0] * 1e3, points[:, 1] * 1e3, c=shot[FIELD] * SCALE, s=size**2, norm=norm,
                        cmap="viridis", linewidths=0, zorder=2, rasterized=True)


def _areas(polygons):
    """Areas of the polygons, arrays of corners."""
    areas = []
    for corners in polygons:
        here, ahead = corners - corners[0], numpy.roll(corners, -1, axis=0) - corners[0]
        areas.append(0.5 * abs(numpy.sum(here[:, 0] * ahead[:, 1] - ahead[:, 0] * here[:, 1])))
    return numpy.array(areas)


def round_up(value):
    """The next of a few round numbers times a power of ten, for a colour bar that ends on a round number."""
    if value <= 0:
        return 1.0
    power = 10.0**numpy.floor(numpy.log10(value))
    return float(next(step * power for step in (1, 1.5, 2, 3, 4, 5, 6, 8, 10) if step * power >= value * 0.999))
