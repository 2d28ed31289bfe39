# SPDX-License-Identifier: GPL-2.0-or-later
"""Work-precision diagrams: error against CPU time, both logarithmic, a line for each method."""
import math

import matplotlib.pyplot as plt
from matplotlib.ticker import NullFormatter

from .figures import COLOURS, MARKERS, STYLE, save
from .work_precision import front

FLOOR = 1e-9        # errors below are drawn here
APART = 0.2         # points with labels [decades]
BESIDE = ((5, 5), (5, -12), (-20, -12), (-20, 5))      # where labels stand, line after line [points]
ON_GRAIN, IN_PACKING = "CPU time of one grain [s]", "CPU time of a packing [s]"


def draw(measured, methods, sweeps, base, candidates, table, path):
    """Writes figure1.png to figure5.png to the paths that the function `path` makes of these.

    measured    work_precision.Measured
    methods     name -> (settings on one grain, settings in packings), a line each
    sweeps      name -> (knob, settings on one grain, settings in packings), a line each
    base        the setting that all sweeps share
    candidates  (CPU time [s], error [-], ...) of every setting that presets were chosen from
    table       the content of accuracy.json
    """
    with plt.rc_context({**STYLE, "figure.figsize": (7.2, 5.0), "savefig.dpi": 130,
                         "figure.constrained_layout.use": False}):
        grain = {name: _found(measured.grain, settings) for name, (settings, _) in methods.items()}
        packing = {name: _found(measured.packing, settings) for name, (_, settings) in methods.items()}
        _methods(grain, ON_GRAIN, {"force": "error of the force, rms [-]", "area": "error of the area lost, rms [-]"},
                 path("figure1.png"))
        _methods(packing, IN_PACKING, {"stress": "difference of the stress [-]", "coordination": "difference of Z [-]",
                                       "volume": "difference of the volume change [-]"}, path("figure2.png"))
        _knobs(measured, sweeps, base, path("figure3.png"))
        _methods(packing, IN_PACKING, {"energy": "energy residual / external work [-]",
                                       "penetration": "deepest penetration / radius [-]"}, path("figure4.png"))
        _presets(candidates, table, path("figure5.png"))


def _methods(found, time, errors, path):
    """A diagram for each of `errors`, name -> what it is, with a line for each method; found: method -> list of (setting,
    its errors); time: what the time is."""
    figure, axes = plt.subplots(1, len(errors), figsize=(6 + 2.2 * len(errors), 4.9))
    for axis, (error, what) in zip(axes, errors.items()):
        _draw_lines(axis, {method: [(f"{knobs['points']}", known["cpu_s"], *_size(known[error]))
                                    for knobs, known in settings] for method, settings in found.items()})
        axis.set(xlabel=time, ylabel=what)
    _one_legend(figure, axes)
    save(figure, path)


def _knobs(measured, sweeps, base, path):
    figure, axes = plt.subplots(1, 2, figsize=(10.4, 4.9))
    for index, (name, (knob, grain, packing)) in enumerate(sweeps.items()):
        for axis, found, error in ((axes[0], _found(measured.grain, grain), "force"),
                                   (axes[1], _found(measured.packing, packing), "stress")):
            points = [("" if knobs == base else f"{knobs[knob]:g}", errors["cpu_s"], *_size(errors[error]))
                      for knobs, errors in found]
            _line(axis, name, points, index)
    axes[0].set(xlabel=ON_GRAIN, ylabel="error of the force, rms [-]")
    axes[1].set(xlabel=IN_PACKING, ylabel="difference of the stress [-]")
    for axis, errors, error in ((axes[0], measured.grain(base), "force"), (axes[1], measured.packing(base), "stress")):
        axis.set(xscale="log", yscale="log")
        if errors:
            axis.plot(errors["cpu_s"], max(_size(errors[error])[0], FLOOR), "*", markersize=13, color="0.25", zorder=3,
                      label="1, 0.8 and 0.001")
    _one_legend(figure, axes)
    save(figure, path)


def _presets(candidates, table, path):
    figure, axis = plt.subplots()
    axis.plot([cost for cost, *_ in candidates], [error for _, error, _ in candidates], "o", color="0.6", label="settings")
    best = table["settings"]
    axis.plot([chosen["packing_cpu_s"] for chosen in best], [chosen["error"] for chosen in best], "-o",
              color=COLOURS[0], markersize=9, markerfacecolor="none", markeredgewidth=1.8, label="Pareto front")
    for chosen in best:
        axis.annotate(f"{chosen['points']} points, {chosen['surface_spacing']:g}, {chosen['tolerance']:g}",
                      (chosen["packing_cpu_s"], chosen["error"]), (-8, -10), ha="right", textcoords="offset points",
                      fontsize=8.5)
    for name, error in table["names"].items():
        axis.axhline(error, color=COLOURS[1], linewidth=1, linestyle="--")
        axis.annotate(f"'{name}'", (1, error), (-3, 3), xycoords=("axes fraction", "data"), textcoords="offset points",
                      ha="right", color=COLOURS[1], fontsize=10)
    axis.set(xscale="log", yscale="log", xlabel=IN_PACKING, ylabel="largest error in stress [-]")
    axis.margins(x=0.1)
    _whole_decades(axis)
    axis.legend(loc="lower left")
    figure.tight_layout()
    save(figure, path)


def _size(error):
    """An error and its spread: some are means that come with one."""
    return (abs(error[0]), error[1]) if isinstance(error, tuple) else (error, 0.0)


def _found(measure, settings):
    """Those settings of which there are errors, with them."""
    return [(knobs, errors) for knobs, errors in ((knobs, measure(knobs)) for knobs in settings) if errors]


def _draw_lines(axis, lines):
    """lines: name -> list of (label, CPU time, error, spread); rings mark the Pareto front of all, where errors count
    with their spread. Of points close together the first has its label."""
    labelled = []
    for index, (name, points) in enumerate(lines.items()):
        _line(axis, name, [(_label(point, labelled), *point[1:]) for point in points], index)
    best = front([(cost, error + spread, error) for points in lines.values() for _, cost, error, spread in points
                  if not math.isnan(spread)])
    axis.plot([cost for cost, *_ in best], [max(error, FLOOR) for *_, error in best], "o:", color="0.25", markersize=13,
              markerfacecolor="none", label="Pareto front", zorder=1)
    axis.set(xscale="log", yscale="log")


def _label(point, labelled):
    """Its own, or none near one of `labelled`, the places in decades of points that have theirs."""
    label, cost, error, _ = point
    place = math.log10(cost), math.log10(max(error, FLOOR))
    if any(math.dist(place, other) <= APART for other in labelled):
        return ""
    labelled.append(place)
    return label


def _line(axis, name, points, index):
    colour, marker = COLOURS[index % len(COLOURS)], MARKERS[index % len(MARKERS)]
    costs, errors = [cost for _, cost, _, _ in points], [max(error, FLOOR) for _, _, error, _ in points]
    axis.plot(costs, errors, "-" if index < len(COLOURS) else "--", marker=marker, color=colour, label=name)
    for (label, *_, spread), cost, error in zip(points, costs, errors):
        if spread > 0:
            axis.plot([cost, cost], [max(error - spread, error / 5), error + spread], color=colour, linewidth=1)
        axis.annotate(label, (cost, error), BESIDE[index % len(BESIDE)], textcoords="offset points", fontsize=8, color=colour)


def _one_legend(figure, axes):
    """Above all axes."""
    for axis in axes:
        _whole_decades(axis)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="upper center", ncol=3)
    figure.tight_layout(rect=(0, 0, 1, 0.86))


def _whole_decades(axis):
    """Limits at powers of ten, so that both axes have numbers."""
    for low_and_high, limit in ((axis.get_xlim(), axis.set_xlim), (axis.get_ylim(), axis.set_ylim)):
        low, high = (math.log10(value) for value in low_and_high)
        limit(10 ** math.floor(low), 10 ** math.ceil(high))
    for direction in (axis.xaxis, axis.yaxis):
        direction.set_minor_formatter(NullFormatter())
