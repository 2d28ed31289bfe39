#!/usr/bin/python3.11
# SPDX-License-Identifier: GPL-2.0-or-later
"""Every message of the sources is met by a test and explained in doc/troubleshooting.md, and that page explains no other.

A message is met when a test of a scene has met it (it leaves what it met in BUILD/messages) or a test of the core quotes it."""
import glob
import os
import re
import sys

import messages

BUILD = os.environ["SOFTGRAIN_BUILD"]
LEAST_QUOTED = 8    # characters that a test of the core has to quote

met = "\n".join(messages.read(path) for path in glob.glob(os.path.join(BUILD, "messages", "*.txt")))
tests = "\n".join(messages.read(path) for path in messages.files("tests/core/*/*.cpp"))
quotes = [quote for quote in re.findall(messages.CPP, tests) if len(quote) >= LEAST_QUOTED and " " in quote.strip()]
explained, begun = messages.page()
statements, literals = messages.statements(), messages.literals()
faults = []
for path, parts in statements:
    quoted = any(quote.strip() in part for quote in quotes for part in parts)
    faults += [f"{path}: no test meets '{part}'" for part in parts if not quoted and part not in met]
    faults += [f"{path}: doc/troubleshooting.md lacks '{part}'" for part in parts if not any(part in code for code in explained)]
faults += [f"doc/troubleshooting.md: no source says '{code}'" for code in begun
           if not any(part in code for part in literals)]
print(*faults, sep="\n")
count = sum(len(parts) for _, parts in statements)
print(f"{2 * count - len(faults)} passed, {len(faults)} failed")
sys.exit(1 if faults or count < 250 else 0)
