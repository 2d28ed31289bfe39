# SPDX-License-Identifier: GPL-2.0-or-later
"""The guard of the plugin: one clear sentence for every YADE that cannot hold it."""
import importlib.util
import os

path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "py", "_guard.py")
spec = importlib.util.spec_from_file_location("softgrain_guard", path)
guard = importlib.util.module_from_spec(spec)
spec.loader.exec_module(guard)

DEBIAN = ["LOGGER", "USEFUL_ERRORS", "COMPLEX_MP", "VTK", "OPENMP", "GTS", "QT5", "CGAL", "PFVFLOW", "LINSOLV", "MPI", "TWOPHASEFLOW", "LS_DEM",
          "FEMLIKE", "GL2PS", "LBMFLOW", "THERMAL", "PARTIALSAT", "POTENTIAL_PARTICLES"]
VERSION = "2023.02a"


def refused(sentence, *words):
    assert sentence and "\n" not in sentence and sentence.endswith("."), sentence
    assert all(word in sentence for word in words), sentence


assert guard.objection(VERSION, DEBIAN, 64, VERSION) is None
assert guard.objection("2025-01-01.git", DEBIAN, 64, "") is None  # built from a source tree: any version
refused(guard.objection("2022.01a", DEBIAN, 64, VERSION), VERSION, "2022.01a", "YADE_SOURCE_DIR")
refused(guard.objection(VERSION, [f for f in DEBIAN if f != "MPI"], 64, VERSION), "without MPI")
refused(guard.objection(VERSION, DEBIAN + ["SPH"], 64, VERSION), "with SPH")
refused(guard.objection(VERSION, DEBIAN, 128, VERSION), "128-bit")

refused(str(guard.outside("softgrain.softDisc")), "softgrain.softDisc", "inside YADE", "yade script.py")
os.environ["PATH"] = "/nonexistent"
refused(str(guard.outside("softgrain")), "apt-get install yade")
assert not guard.inside_yade()
print("9 passed, 0 failed")
