# SPDX-License-Identifier: GPL-2.0-or-later
"""Snapshots of a scene in a row, and curves of its csv below: the picture of heavy_ball.py, funnel.py and drum.py."""
import matplotlib.pyplot as plt
import numpy

from .figures import COLOURS, STYLE, save
from .pictures import Look, View, row

PANEL = 3.6             # width of a snapshot [inches]


def draw(run, count, curves, along, along_of=lambda time: time * 1e3):
    """Writes figure1.png into the folder of a run.

    count    of the snapshots, snapshot_1.npz and so on
    curves   (values along the axis, values, label) of each panel below; `along`: label of their common axis
    along_of function that gives the place of a time [s] on that axis"""
    shots = [dict(numpy.load(run.path(f"snapshot_{number + 1}.npz"))) for number in range(count)]
    tall = View(shots).height(PANEL)
    with plt.rc_context(STYLE):
        figure = plt.figure(figsize=(PANEL * count + 1.2, tall + 3.4))
        upper, lower = figure.subfigures(2, 1, height_ratios=(tall + 0.7, 2.7))
        row(shots, [None] * count, Look(scale="root"), PANEL * count, within=upper)
        for index, (axis, (places, values, label)) in enumerate(zip(lower.subplots(1, len(curves), squeeze=False)[0], curves)):
            axis.plot(places, values, color=COLOURS[index])
            for shot in shots:
                axis.axvline(along_of(shot["time"]), color="0.6", linewidth=0.8, linestyle="--")
            axis.set_xlabel(along)
            axis.set_ylabel(label)
        save(figure, run.path("figure1.png"))
