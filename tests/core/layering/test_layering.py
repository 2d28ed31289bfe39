# SPDX-License-Identifier: GPL-2.0-or-later
"""The rooms of pkg/core are passed in one direction, and the core knows nothing of YADE: run by ctest with
SOFTGRAIN_CORE_LIBRARY naming the core's library."""
import os
import pathlib
import re
import subprocess
import unittest

CORE = pathlib.Path(__file__).resolve().parents[3] / "pkg" / "core"
ROOMS = ["base", "grain", "grid", "material", "contact", "law", "solver", "step"]


def includes():
    """(file, what it includes) for every line #include of the core."""
    for path in sorted(CORE.rglob("*.?pp")):
        for name in re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', path.read_text(encoding="utf-8"), re.MULTILINE):
            yield path.relative_to(CORE), name


class Layering(unittest.TestCase):
    def test_the_rooms_are_these(self):
        self.assertEqual(sorted(p.name for p in CORE.iterdir() if p.is_dir()), sorted(ROOMS))

    def test_a_room_includes_itself_and_rooms_before_it(self):
        seen = 0
        for path, name in includes():
            room = name.split("/")[0]
            if room in ROOMS:
                seen += 1
                self.assertLessEqual(ROOMS.index(room), ROOMS.index(path.parts[0]), f"{path} includes {name}")
        self.assertGreater(seen, 30)

    def test_nothing_else_but_the_standard_library_and_eigen(self):
        for path, name in includes():
            standard = re.fullmatch(r"[a-z_]+", name) is not None
            self.assertTrue(standard or name.startswith("Eigen/") or name.split("/")[0] in ROOMS, f"{path} includes {name}")

    def test_the_library_wants_no_symbol_of_yade_boost_or_python(self):
        library = os.environ["SOFTGRAIN_CORE_LIBRARY"]
        symbols = subprocess.run(["nm", "-C", "--undefined-only", library], capture_output=True, text=True, check=True).stdout
        self.assertIn("operator new", symbols)
        for foreign in ("yade::", "boost::", "Py_", "PyObject"):
            self.assertNotIn(foreign, symbols)


if __name__ == "__main__":
    unittest.main()
