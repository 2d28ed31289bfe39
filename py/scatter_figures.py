# SPDX-License-Identifier: GPL-2.0-or-later
"""Packings of several seeds in pictures: coordination along the solid fraction, jamming of every case, eq. 10."""
import matplotlib.pyplot as plt
import numpy

from .figures import COLOURS, MARKERS, STYLE, save
from .scatter import REACH

JAMMING_2D = 0.84   # of frictionless discs (O'Hern et al. 2003)


def draw(means, curves, path):
    """Writes figure1.png to figure3.png to the paths that the function `path` makes of these. means: case -> observable
    -> (mean, error), see scatter.over_seeds; curves: case -> column -> (solid fraction, mean, deviation)."""
    with plt.rc_context({**STYLE, "figure.figsize": (7.6, 5.0), "savefig.dpi": 130}):
        _coordination(means, curves, path("figure1.png"))
        _jamming(means, path("figure2.png"))
        _normalised(means, curves, path("figure3.png"))


def _dense(means, curves):
    """Cases with a number for k, and what they are drawn with."""
    shown = [case for case in curves if "k" in means[case] and curves[case]["coordination"][0][-1] > 0.95]
    return [(case, COLOURS[i % len(COLOURS)], MARKERS[i % len(MARKERS)]) for i, case in enumerate(shown)]


def _coordination(means, curves, path):
    figure, axes = plt.subplots()
    for case, colour, marker in _dense(means, curves):
        fraction, mean, deviation = curves[case]["coordination"]
        start, count, k = (means[case][name][0] for name in ("jamming_fraction", "Z0", "k"))
        from_jamming = fraction >= start
        axes.errorbar(fraction[from_jamming], mean[from_jamming], deviation[from_jamming], fmt=marker, markersize=4,
                      color=colour, elinewidth=0.8, label=rf"{case}; line: $Z_0 + k\,(\Phi-\Phi_0)^{{0.5}}$, $k$ = {k:.1f}")
        share = numpy.linspace(0, 1, 60)**2     # the curve is steep at its start
        axes.plot(start + REACH * share, count + k * numpy.sqrt(REACH * share), color=colour)
    axes.set(xlabel=r"solid fraction  $\Phi$  [-]", ylabel=r"contacts per grain without rattlers  $Z$  [-]")
    axes.legend(fontsize=9)
    save(figure, path)


def _jamming(means, path):
    figure, axes = plt.subplots()
    cases = [case for case in means if "jamming_fraction" in means[case]]
    for place, case in enumerate(reversed(cases)):
        mean, error = means[case]["jamming_fraction"]
        rigid = case.startswith("rigid")
        axes.errorbar(mean, place, xerr=error, fmt=MARKERS[1] if rigid else MARKERS[0], markersize=7, capsize=3,
                      color=COLOURS[1] if rigid else COLOURS[0])
        axes.annotate(f"{mean:.3f}", (mean, place), xytext=(0, 7), textcoords="offset points", ha="center", fontsize=9)
    axes.axvline(JAMMING_2D, color="0.3", linestyle="--", linewidth=1)
    axes.annotate("0.84, published,\nno friction, no walls", (JAMMING_2D, len(cases) - 1), xytext=(4, 10),
                  textcoords="offset points", fontsize=9, color="0.3")
    axes.set_yticks(range(len(cases)), list(reversed(cases)))
    axes.set_ylim(-0.6, len(cases) - 0.1)
    axes.margins(x=0.12)
    axes.set_xlabel(r"solid fraction at jamming  $\Phi_0$  [-]")
    save(figure, path)


def _normalised(means, curves, path):
    figure, axes = plt.subplots()
    for case, colour, marker in _dense(means, curves):
        fraction, mean, deviation = curves[case]["coordination"]
        start, count = means[case]["jamming_fraction"][0], means[case]["Z0"][0]
        beyond = fraction >= start
        span, growth = fraction[-1] - start, mean[-1] - count
        exponents = " / ".join(f"{means[case][name][0]:.2f}" for name in ("exponent", "exponent_1", "exponent_2")
                               if name in means[case])
        axes.errorbar((fraction[beyond] - start) / span, (mean[beyond] - count) / growth, deviation[beyond] / growth,
                      fmt=marker, markersize=4, elinewidth=0.8, color=colour, label=f"{case}: best exponents {exponents}")
    share = numpy.linspace(0, 1, 200)
    axes.plot(share, numpy.sqrt(share), color="0.1", linewidth=1.3, label="eq. 10: exponent 0.5")
    axes.set(xlabel=r"$(\Phi-\Phi_0)/(\Phi_1-\Phi_0)$  [-]", ylabel=r"$(Z-Z_0)/(Z_1-Z_0)$  [-]")
    axes.legend(fontsize=9, title=r"for $\Phi_0$ at jamming / 0.01 / 0.02 beyond", alignment="left")
    save(figure, path)
