# SPDX-License-Identifier: GPL-2.0-or-later
"""Refuses a YADE whose objects lie in memory otherwise than the compiled plugin expects."""
import shutil
import sys

try:
    from ._built_for import YADE_VERSION
except ImportError:  # run from the source folder
    YADE_VERSION = "2023.02a"

# Features of YADE that move members of its classes (pkg/abi), as yade.config.features names them.
NEEDED = {"FEMLIKE", "MPI", "OPENMP", "QT5"}
EXCLUDED = {"DEFORM", "LIQMIGRATION", "MASK_ARBITRARY", "SPH", "VECTORIZE"}


def objection(version, features, bits, expected=YADE_VERSION):
    """One sentence saying why this YADE cannot hold the plugin, or None."""
    if expected and version != expected:
        return (f"softgrain was built for YADE {expected}, but this is YADE {version}: use the package `yade` of Debian 12, "
                "or build softgrain for your YADE with cmake -DYADE_SOURCE_DIR=<its source tree>.")
    missing, clashing = NEEDED - set(features), EXCLUDED & set(features)
    if missing or clashing or bits != 64:
        found = [f"without {name}" for name in sorted(missing)] + [f"with {name}" for name in sorted(clashing)]
        if bits != 64:
            found.append(f"with {bits}-bit numbers instead of 64")
        return (f"softgrain cannot use this YADE, which was built {', '.join(found)}: use the package `yade` of Debian 12, "
                "or a YADE built with the same features.")
    return None


def inside_yade():
    """Whether this process is YADE."""
    return "yade.wrapper" in sys.modules


def outside(what):
    """The ImportError of what works inside YADE only."""
    hint = "" if shutil.which("yade") else " YADE is not installed here: on Debian 12, `apt-get install yade` as root does that."
    return ImportError(f"{what} works inside YADE only: import it in a script run by `yade script.py`." + hint)


def check():
    """Raises ImportError unless the plugin may be loaded into this YADE."""
    from yade import config

    sentence = objection(config.version, config.features, config.highPrecisionBits)
    if sentence:
        raise ImportError(sentence)
