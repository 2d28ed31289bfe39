# SPDX-License-Identifier: GPL-2.0-or-later
"""Data flows one way through pkg/core: a folder includes only itself and folders listed before it, Eigen and the standard
library; nothing of YADE, Boost or Python. The built library asks for none of their symbols."""
import os
import re
import subprocess
import tempfile
import unittest

FOLDERS = ["base", "grain", "grid", "material", "contact", "law", "solver", "step"]
ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".."))
CORE = os.path.join(ROOT, "pkg", "core")
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')
FOREIGN = re.compile(r"yade|boost|\bPy[A-Z_]|python|Q[A-Z][a-z]+Widget|vtk", re.IGNORECASE)


def objections(core):
    """One sentence for every include that is not allowed."""
    found = []
    for folder in sorted(os.listdir(core)):
        if folder not in FOLDERS:
            found.append(f"pkg/core/{folder} is none of the layers {' '.join(FOLDERS)}")
            continue
        for name in sorted(os.listdir(os.path.join(core, folder))):
            path = os.path.join(core, folder, name)
            with open(path, encoding="utf-8") as source:
                lines = source.read().splitlines()
            for number, line in enumerate(lines, 1):
                match = INCLUDE.match(line)
                if match and not allowed(folder, core, *match.groups()):
                    found.append(f"{folder}/{name}:{number}: {line.strip()}")
    return found


def allowed(folder, core, bracket, target):
    head = target.split("/")[0]
    if bracket == "<":  # the standard library has no folders
        return head == "Eigen" or ("/" not in target and not target.endswith((".hpp", ".hxx")) and target != "Python.h")
    return (head in FOLDERS and FOLDERS.index(head) <= FOLDERS.index(folder) and "/" in target
            and os.path.isfile(os.path.join(core, target)))


def foreign_symbols(listing):
    """Undefined symbols that the core must not ask for, from the output of nm -C -u."""
    return [line.strip() for line in listing.splitlines() if re.match(r"\s+U ", line) and FOREIGN.search(line)]


class TheCore(unittest.TestCase):
    def test_includes_flow_one_way(self):
        self.assertEqual(objections(CORE), [])

    def test_every_layer_is_there(self):
        self.assertEqual(sorted(os.listdir(CORE)), sorted(FOLDERS))

    def test_library_asks_for_nothing_of_yade(self):
        library = os.environ.get("SOFTGRAIN_CORE_LIBRARY")
        if not library or not os.path.exists(library):
            self.skipTest("the core is not built")
        listing = subprocess.run(["nm", "-C", "-u", library], check=True, capture_output=True, text=True).stdout
        self.assertIn(" U ", listing)
        self.assertEqual(foreign_symbols(listing), [])


class TheCheck(unittest.TestCase):
    """The rules see what they are there to see."""

    def objections_to(self, folder, line):
        with tempfile.TemporaryDirectory() as core:
            for layer in FOLDERS:
                os.mkdir(os.path.join(core, layer))
                with open(os.path.join(core, layer, "a.hpp"), "w", encoding="utf-8") as source:
                    source.write("#pragma once\n")
            with open(os.path.join(core, folder, "b.cpp"), "w", encoding="utf-8") as source:
                source.write(f"// first line\n{line}\n")
            return objections(core)

    def test_lets_through_what_is_allowed(self):
        for folder, line in [("base", "#include <vector>"), ("step", '#include "base/a.hpp"'), ("grid", '#include "grid/a.hpp"'),
                             ("solver", '#include "law/a.hpp"'), ("base", "#include <Eigen/Dense>"), ("step", "#include <omp.h>")]:
            self.assertEqual(self.objections_to(folder, line), [], line)

    def test_refuses_the_rest(self):
        for folder, line in [("base", '#include "grain/a.hpp"'), ("material", '#include "contact/a.hpp"'),
                             ("law", '  #  include "step/a.hpp"'), ("step", "#include <core/Engine.hpp>"),
                             ("step", '#include "core/Engine.hpp"'), ("step", '#include "pkg/yade/SoftGrain.hpp"'),
                             ("step", "#include <lib/base/Math.hpp>"), ("base", "#include <boost/python.hpp>"),
                             ("base", "#include <Python.h>"), ("step", '#include "../yade/SoftGrain.hpp"'),
                             ("step", '#include "base/missing.hpp"'), ("step", '#include "a.hpp"')]:
            self.assertEqual(self.objections_to(folder, line), [f"{folder}/b.cpp:2: {line.strip()}"], line)

    def test_refuses_a_folder_that_is_no_layer(self):
        with tempfile.TemporaryDirectory() as core:
            os.mkdir(os.path.join(core, "util"))
            self.assertEqual(len(objections(core)), 1)

    def test_sees_foreign_symbols(self):
        listing = ("                 U std::terminate()\n                 U PyErr_SetString\n                 U boost::python::throw_error_already_set()\n"
                   "                 U yade::Scene::byName\n0000 T yade_is_defined_here\n                 U GOMP_parallel\n")
        self.assertEqual(len(foreign_symbols(listing)), 3)


if __name__ == "__main__":
    unittest.main()
