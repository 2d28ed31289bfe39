# SPDX-License-Identifier: GPL-2.0-or-later
"""Sphinx reads the pages of doc/ as they are: what GitHub shows of them is said here in Sphinx's words. build.py calls it."""
import os
import re

OFFLINE = "/usr/share/javascript/mathjax/MathJax.js"    # Debian's libjs-mathjax

project, author, language = "softgrain", "the authors of softgrain", "en"
copyright = "the authors of softgrain, GNU General Public License, version 2 or later"
extensions = ["myst_parser", "sphinx.ext.mathjax"]
if os.path.exists(OFFLINE):         # else from the network
    mathjax_path = f"file://{OFFLINE}?config=TeX-AMS_HTML"
    mathjax2_config = {"tex2jax": {"ignoreClass": "mathjax_ignore", "processClass": "math"}}
    myst_update_mathjax = False
root_doc = "index"
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
toc_object_entries_show_parents = "hide"
html_theme = "alabaster"
html_theme_options = {"page_width": "1200px", "sidebar_width": "270px", "code_font_size": "0.8em", "description": "Soft grains for YADE"}
html_copy_source = False
highlight_language = "none"


def setup(app):
    app.connect("source-read", _translate)


def _translate(_app, page, source):
    """```math blocks become directives; the pages that index.md lists, and the reference, its table of contents."""
    text = source[0].replace("```math\n", "```{math}\n")
    if page == "index":
        pages = [*dict.fromkeys(re.findall(r"\]\((\w+)\.md\)", text)), "reference/classes", "reference/functions"]
        text += "\n```{toctree}\n:hidden:\n" + "\n".join(pages) + "\n```\n"
    source[0] = text
