#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the hard cases and writes what they gave into doc/stability.csv and between the marks in doc/stability.md.

    PYTHONPATH=build/py python3 tests/stability/report.py [--long] [--only-write]
"""
import csv
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
DOC = os.path.join(os.path.dirname(os.path.dirname(HERE)), "doc")
ROWS = os.path.join(DOC, "stability.csv")
BEGIN, END = "<!-- written by tests/stability/report.py: begin -->", "<!-- end -->"
GROUPS = "poisson squeeze steps impact ratios packing shapes rest cutcells long".split()
SHOWN = (("min_J", "least J"), ("penetration_over_R", "penetration / R"), ("energy_drift", "energy"),
         ("residual", "residual"), ("iterations", "iterations"), ("cuts", "cuts"), ("steps", "steps"))


def run_all(options):
    if os.path.exists(ROWS):
        os.remove(ROWS)
    for group in GROUPS:
        subprocess.run(["yade", "-n", "-j1", "-x", os.path.join(HERE, f"test_{group}.py"), *options, "--rows", ROWS], check=False)


def table(rows):
    """One line a run, under a heading a group."""
    lines = []
    for group in GROUPS:
        own = [row for row in rows if row["file"] == f"test_{group}.py"]
        if not own:
            continue
        passed = sum(row["passed"] == "yes" for row in own)
        lines += [f"### {group}: {passed} of {len(own)} pass", "",
                  "| case | method | | " + " | ".join(name for _, name in SHOWN) + " | remark |",
                  "|---|---|---|" + "---|" * (len(SHOWN) + 1)]
        for row in own:
            verdict = "passes" if row["passed"] == "yes" else "**fails**"
            remark = "; ".join(text for text in (row["note"].strip(), row["known"]) if text).replace("|", "/")
            lines.append(f"| {row['case']} | {row['method']} | {verdict} | "
                         + " | ".join(row[key] for key, _ in SHOWN) + f" | {remark} |")
        lines.append("")
    return lines


def main():
    options = [word for word in sys.argv[1:] if word == "--long"]
    if "--only-write" not in sys.argv:
        run_all(options)
    with open(ROWS, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    page = os.path.join(DOC, "stability.md")
    with open(page, encoding="utf-8") as file:
        text = file.read()
    before, after = text[:text.index(BEGIN) + len(BEGIN)], text[text.index(END):]
    with open(page, "w", encoding="utf-8") as file:
        file.write("\n".join([before, "", *table(rows), after]))


main()
