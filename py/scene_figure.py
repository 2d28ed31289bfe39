# SPDX-License-Identifier: GPL-2.0-or-later
"""Snapshots of a scene in a row, and curves of its csv below: the picture of heavy_ball.py, funnel.py and drum.py."""
import matplotlib.pyplot as plt
import numpy
from matplotlib.colors import PowerNorm

from .figure1 import FIELD, SCALE, draw_packing, round_up
from .figures import COLOURS, STYLE, save

PANEL = 3.6             # width of a snapshot [inches]
KPA = 1e-3              # in a pascal


def draw(run, count, curves, along, along_of=lambda time: time * 1e3):
    """Writes figure1.png into the folder of a run.

    count    of the snapshots, snapshot_1.npz and so on
    curves   (values along the axis, values, label) of each panel below; `along`: label of their common axis
    along_of function that gives the place of a time [s] on that axis"""
    shots = [dict(numpy.load(run.path(f"snapshot_{number + 1}.npz"))) for number in range(count)]
    everything = numpy.concatenate([shot[part] for shot in shots for part in ("outlines", "rigid_outlines")]) * 1e3
    low, high = everything.min(axis=0), everything.max(axis=0)
    margin = 0.02 * max(high - low)
    tall = PANEL * (high[1] - low[1] + 2 * margin) / (high[0] - low[0] + 2 * margin)
    norm = PowerNorm(0.5, 0, round_up(max(numpy.percentile(shot[FIELD], 99) for shot in shots) * KPA))
    with plt.rc_context(STYLE):
        figure = plt.figure(figsize=(PANEL * count + 1.2, tall + 3.4))
        upper, lower = figure.subfigures(2, 1, height_ratios=(tall + 0.7, 2.7))
        axes = upper.subplots(1, count, sharey=True, squeeze=False)[0]
        for axis, shot in zip(axes, shots):
            dots = draw_packing(axis, {**shot, FIELD: shot[FIELD] * KPA / SCALE}, norm, PANEL / (high[0] - low[0]) * 1e3)
            axis.set_title(f"{shot['time'] * 1e3:.0f} ms", fontsize=11)
            axis.set_xlim(low[0] - margin, high[0] + margin)
            axis.set_ylim(low[1] - margin, high[1] + margin)
            axis.set_xlabel("x  [mm]")
        axes[0].set_ylabel("y  [mm]")
        upper.colorbar(dots, ax=list(axes), label="von Mises stress  [kPa]", fraction=0.03, pad=0.01, extend="max")
        for index, (axis, (places, values, label)) in enumerate(zip(lower.subplots(1, len(curves), squeeze=False)[0], curves)):
            axis.plot(places, values, color=COLOURS[index])
            for shot in shots:
                axis.axvline(along_of(shot["time"]), color="0.6", linewidth=0.8, linestyle="--")
            axis.set_xlabel(along)
            axis.set_ylabel(label)
        save(figure, run.path("figure1.png"))
