# SPDX-License-Identifier: GPL-2.0-or-later
"""Soft and rigid compactions of the same discs in one picture."""
import matplotlib.pyplot as plt
import numpy

from .comparison import FACTOR, OVERLAP, smoothed_stress
from .figures import COLOURS, MARKERS, STYLE, save

PANELS = (("stress [kPa]", "log"), ("contacts per grain without rattlers  $Z$  [-]", "linear"),
          ("deepest overlap [radius of the smaller]", "log"), ("CPU time [s]", "log"))


def draw(tables, departures, rows, path):
    """tables: case -> csv columns; departures: see comparison.departures; rows: case -> row of the study."""
    with plt.rc_context({**STYLE, "figure.figsize": (10.4, 7.6), "savefig.dpi": 130}):
        figure, axes = plt.subplots(2, 2, sharex=True)
        for index, (case, table) in enumerate(tables.items()):
            fraction = table["solid_fraction"]
            curves = (smoothed_stress(table) / 1e3, table["coordination"], table["max_penetration_over_R"], table["cpu_s"])
            off = departures.get(case, {}).get("stress")
            for panel, curve in zip(axes.flat, curves):
                panel.plot(fraction, curve, color=COLOURS[index], marker=MARKERS[index], markersize=5,
                           markevery=max(len(curve) // 12, 1), label=f"{case}, {rows[case]['cpu_s']:.1f} CPU s")
                if off is not None:
                    panel.plot(off, numpy.interp(off, fraction, curve), marker="x", markersize=11, markeredgewidth=2.5,
                               color=COLOURS[index])
        for panel, (label, scale) in zip(axes.flat, PANELS):
            panel.set_ylabel(label)
            panel.set_yscale(scale)
        axes[0, 0].set_ylim(bottom=1)
        axes[1, 0].set_ylim(bottom=1e-5)
        axes[1, 0].axhline(OVERLAP, color="0.3", linestyle="--", linewidth=1)
        for panel in axes[1]:
            panel.set_xlabel(r"solid fraction  $\Phi$  [-]")
        axes[0, 1].legend(loc="upper left", fontsize=9, title=f"cross: stress off the soft one's by {FACTOR}", title_fontsize=9)
        save(figure, path)
