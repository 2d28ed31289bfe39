# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures 1 to 5 of Vu et al. 2017 from folders of runs of compaction.py and rigid_compaction.py.

    python3 examples/figures.py DIR [DIR ...] [--out DIR]

For instance the two materials of the paper together:

    yade -n -x examples/compaction.py --material nh --out nh
    yade -n -x examples/compaction.py --material mr --out mr
    python3 examples/figures.py nh mr --out both

A small picture of a packing before and after, for a page:

    python3 examples/figures.py nh --picture packing.png

The curves of all folders share the figures, figure 1 is of the first folder; without --out the figures go there. Works
without YADE.
"""
import importlib.util
import sys

if importlib.util.find_spec("softgrain") is None:
    sys.exit("figures.py: softgrain is not installed for this python3: install it, or set PYTHONPATH to where it lies.")
if importlib.util.find_spec("matplotlib") is None:
    sys.exit(f"figures.py: {sys.executable} has no matplotlib: use /usr/bin/python3 with the package python3-matplotlib.")
from softgrain import figures  # noqa: E402

sys.exit(figures.main())
