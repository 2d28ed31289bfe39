# SPDX-License-Identifier: GPL-2.0-or-later
"""Stress and solid fraction of mixtures of soft and rigid discs in one picture."""
import matplotlib.pyplot as plt
import numpy

from .figures import COLOURS, MARKERS, STYLE, save
from .mixtures import fraction_at

DASHES, WORDS = ("-", "--", ":", "-."), ("full:", "dashed:", "dotted:", "dash-dotted:")
LEAST = 0.3         # stress that is shown: below, the walls stir the discs [kPa]


def draw(table, cases, stresses, path):
    """table: columns of mixed_packing.csv; cases: (rigid fraction, friction), of up to four frictions; stresses [Pa]: those of the right
    panel, the largest that of the end."""
    rigid, frictions = sorted({case[0] for case in cases}), sorted({case[1] for case in cases})
    with plt.rc_context({**STYLE, "figure.figsize": (11.2, 4.8)}):
        figure, (left, right) = plt.subplots(1, 2)
        shades = plt.get_cmap("viridis")(numpy.linspace(0, 0.88, len(rigid)))
        for share, friction in cases:
            rows = (table["rigid_fraction"] == share) & (table["friction"] == friction)
            stress = numpy.where(table["stress_Pa"][rows] > 0, table["stress_Pa"][rows], numpy.nan) / 1e3
            index = rigid.index(share)
            left.plot(table["solid_fraction"][rows], stress, color=shades[index], linestyle=DASHES[frictions.index(friction)],
                      marker=MARKERS[index % len(MARKERS)], markersize=4, markevery=4, linewidth=1.5,
                      label=f"{share:g}" if friction == frictions[0] else None)
        left.set_yscale("log")
        left.set_ylim(LEAST, 3 * max(stresses) / 1e3)
        left.set_xlabel(r"solid fraction  $\Phi$  [-]")
        left.set_ylabel("mean stress on the walls  [kPa]")
        told = ", ".join(f"{word} friction {friction:g}" for word, friction in zip(WORDS, frictions))
        left.legend(title=f"share of rigid discs\n({told})", ncols=2, loc="lower right", fontsize=9, title_fontsize=9)
        for index, stress in enumerate(stresses):
            for friction in frictions:
                fraction = [fraction_at(table, (share, friction), stress) for share in rigid]
                right.plot(rigid, fraction, color=COLOURS[index], marker=MARKERS[index],
                           linestyle=DASHES[frictions.index(friction)], label=f"{stress / 1e3:g} kPa, friction {friction:g}")
        right.set_xlabel("share of rigid discs  [-]")
        right.set_ylabel(r"solid fraction  $\Phi$  at a stress  [-]")
        right.legend(fontsize=9, handlelength=3.5)
        save(figure, path)
