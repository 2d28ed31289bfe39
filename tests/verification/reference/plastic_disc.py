#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Squeezes a plastic disc between frictionless rigid plates with CalculiX, and lets it go: P_plates.csv.

    apt-get install calculix-ccx
    python3 plastic_disc.py [elements along a quarter of the rim, default 48] > P_plates.csv

A quarter of the disc, one layer of 20-node bricks with reduced integration, held in thickness; the plate is a brick whose nodes
are moved, contact by a stiff penalty. Radius 1, stresses in units of the shear modulus.
"""
import math
import pathlib
import re
import subprocess
import sys
import tempfile

LAME, MU, YIELD, HARDENING = 1.5, 1.0, 0.01, 0.1    # the first Lame constant, shear modulus, yield stress, hardening
PENALTY = 3e3                                       # contact pressure over overlap
THICKNESS = 0.05
SQUEEZE, BACK, INCREMENT = 0.3, 0.02, 0.0025        # approach of a plate over the radius; way back; rows
INNER = 0.55                                        # half the side of the square in the middle of the mesh


def blocks(n):
    """Maps of the unit square to the three blocks of the quarter, counter-clockwise; they share their sides."""
    corner = 0.9 * INNER / math.sqrt(1.28)

    def inner(s, t):
        x = (1 - t) * s * INNER + t * s * corner
        y = (1 - s) * t * INNER + s * t * corner
        return x, y

    def out(point, angle, r):
        return (1 - r) * point[0] + r * math.cos(angle), (1 - r) * point[1] + r * math.sin(angle)

    return [inner, lambda r, t: out(inner(1, t), t * math.pi / 4, r),
            lambda s, r: out(inner(s, 1), math.pi / 2 - s * math.pi / 4, r)]


def mesh(n):
    """Nodes {number: (x, y, z)} and bricks of 20 numbers; the faces on the rim as (brick, face)."""
    numbers, bricks, rim = {}, [], []

    def number(x, y, z):
        return numbers.setdefault((round(x, 9), round(y, 9), round(z, 9)), len(numbers) + 1)

    # corners of a face, then the middles of its sides, in halves of an element
    around = [(0, 0), (2, 0), (2, 2), (0, 2)]
    middles = [(1, 0), (2, 1), (1, 2), (0, 1)]
    for kind, place in enumerate(blocks(n)):
        for i in range(n):
            for j in range(n):
                at = lambda a, b, z: number(*place((2 * i + a) / (2 * n), (2 * j + b) / (2 * n)), z)
                low, high, mid = 0.0, THICKNESS, THICKNESS / 2
                bricks.append([at(a, b, low) for a, b in around] + [at(a, b, high) for a, b in around]
                              + [at(a, b, low) for a, b in middles] + [at(a, b, high) for a, b in middles]
                              + [at(a, b, mid) for a, b in around])
                if kind == 1 and i == n - 1:
                    rim.append((len(bricks), "S4"))     # of nodes 2, 3, 7, 6
                if kind == 2 and j == n - 1:
                    rim.append((len(bricks), "S5"))     # of nodes 3, 4, 8, 7
    return {value: key for key, value in numbers.items()}, bricks, rim


def deck(n):
    """The input of CalculiX."""
    nodes, bricks, rim = mesh(n)
    first = len(nodes) + 1
    corners = [(-0.1, 1.0), (1.6, 1.0), (1.6, 1.3), (-0.1, 1.3)]
    plate = {first + k: (x, y, z) for k, (x, y, z) in enumerate(
        [(x, y, z) for z in (-0.2 * THICKNESS, 1.2 * THICKNESS) for x, y in corners])}
    young = MU * (3 * LAME + 2 * MU) / (LAME + MU)
    poisson = LAME / (2 * (LAME + MU))

    def numbers(words):
        words = [str(word) for word in words]
        return ",\n".join(",".join(words[k:k + 10]) for k in range(0, len(words), 10))

    equator = next(k for k, (x, y, z) in nodes.items() if abs(x - 1) < 1e-9 and abs(y) < 1e-9 and z == 0)
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{k}, {x:.10g}, {y:.10g}, {z:.10g}" for k, (x, y, z) in {**nodes, **plate}.items()]
    lines += ["*ELEMENT, TYPE=C3D20R, ELSET=DISC"]
    lines += [numbers([k + 1, *brick]) for k, brick in enumerate(bricks)]
    lines += ["*ELEMENT, TYPE=C3D8, ELSET=PLATE", numbers([len(bricks) + 1, *plate])]
    for name, holds in (("LEFT", lambda x, y: abs(x) < 1e-9), ("BOTTOM", lambda x, y: abs(y) < 1e-9), ("DISCN", lambda x, y: True)):
        lines += [f"*NSET, NSET={name}", numbers(k for k, (x, y, _) in nodes.items() if holds(x, y))]
    lines += ["*NSET, NSET=PLATEN", numbers(plate), "*NSET, NSET=EQUATOR", str(equator)]
    lines += ["*SURFACE, NAME=RIM"] + [f"{brick}, {face}" for brick, face in rim]
    lines += ["*SURFACE, NAME=UNDER", f"{len(bricks) + 1}, S3"]
    lines += ["*MATERIAL, NAME=SOLID", "*ELASTIC", f"{young}, {poisson}", "*PLASTIC", f"{YIELD}, 0.",
              f"{YIELD + 5 * HARDENING}, 5.", "*MATERIAL, NAME=STIFF", "*ELASTIC", f"{young}, {poisson}",
              "*SOLID SECTION, ELSET=DISC, MATERIAL=SOLID", "*SOLID SECTION, ELSET=PLATE, MATERIAL=STIFF",
              "*SURFACE INTERACTION, NAME=TOUCH", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{PENALTY}",
              "*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE", "RIM, UNDER",
              "*BOUNDARY", "LEFT, 1, 1", "BOTTOM, 2, 2", "DISCN, 3, 3", "PLATEN, 1, 1", "PLATEN, 3, 3"]
    here = 0.0
    for there, way in ((-SQUEEZE, INCREMENT), (-SQUEEZE + BACK, INCREMENT / 10)):
        count = round(abs(there - here) / way)
        lines += ["*STEP, NLGEOM, INC=100000", "*STATIC", f"{1 / count}, 1., 1e-6, {1 / count}", "*BOUNDARY",
                  f"PLATEN, 2, 2, {there}", "*NODE PRINT, NSET=PLATEN, TOTALS=ONLY, FREQUENCY=1", "RF",
                  "*NODE PRINT, NSET=EQUATOR, FREQUENCY=1", "U", "*NODE PRINT, NSET=PLATEN, FREQUENCY=1", "U", "*END STEP"]
        here = there
    return "\n".join(lines) + "\n"


def rows(text):
    """(approach, force per thickness of the whole disc, half-width) of every increment."""
    found = []
    for part in re.split(r"\n total force .*PLATEN and time.*\n", text)[1:]:
        force = float(part.split()[1])
        equator, plate = re.findall(r"displacements .*\n\s*\n\s*\d+\s+(\S+)\s+(\S+)", part)
        found.append((-float(plate[1]), 2 * force / THICKNESS, 1 + float(equator[0])))
    return found


def main():
    n = int(sys.argv[1]) // 2 if len(sys.argv) > 1 else 24
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "disc.inp"
        path.write_text(deck(n), encoding="ascii")
        run = subprocess.run(["ccx", "disc"], cwd=folder, capture_output=True, text=True, check=False)
        table = rows((pathlib.Path(folder) / "disc.dat").read_text(encoding="ascii"))
        if len(table) < 2:
            sys.exit(run.stdout[-2000:])
    print(f"""# plastic disc, R = 1, plane strain, squeezed between two frictionless rigid plates and released, quasi-static: J2 plasticity
# of finite strains with linear isotropic hardening, lambda = {LAME:g}, mu = {MU:g}, yield stress {YIELD:g}, hardening {HARDENING:g},
# in units of mu.
# CalculiX 2.20 (C3D20R, one layer, {3 * n * n} bricks, penalty contact {PENALTY:g} mu / R; elasticity neo-Hookean), by
# python3 plastic_disc.py {2 * n}
# approach: way of each plate towards the centre, over R; force: per thickness, over mu R; half_width: over R.
approach,force,half_width""")
    for approach, force, width in table:
        print(f"{approach:.5f},{abs(force):.6g},{width:.6f}")


main()
