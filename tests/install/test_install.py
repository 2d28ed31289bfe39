#!/usr/bin/python3.11
# SPDX-License-Identifier: GPL-2.0-or-later
"""cmake --install puts a package that works where Debian's Python looks, and uninstall removes all of it; the Debian package
depends on what the plugin was built for, and works too; import softgrain elsewhere says what to do."""
import glob
import os
import re
import shutil
import subprocess
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.environ["SOFTGRAIN_BUILD"]
LIST = os.path.join(BUILD, "installed_files.txt")       # of an install that a person may have made from this tree
SCENE = """
from softgrain import *
import softgrain
assert softgrain.__file__.startswith(FOLDER), softgrain.__file__
O.materials.append(NeoHookeanMat(label="gel"))
O.materials.append(FrictMat(label="steel"))
O.bodies.append(softDisc((1e-3, 1e-3), 1e-3, "gel", points=60))
left, right, bottom, top = O.bodies.append(softBox(2e-3, 2e-3, "steel"))
O.bodies[top].state.vel = (0, -1, 0)
O.engines = softEngines()
O.run(200, wait=True)
assert O.forces.f(top)[1] > 0
print("the grain bears", O.forces.f(top)[1], "N/m")
"""


def run(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)


def must(*command, **options):
    done = run(*command, **options)
    assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout


def files_in(folder):
    return sorted(os.path.join(where, name) for where, _, names in os.walk(folder) for name in names)


def works_from(folder, scratch):
    scene = os.path.join(scratch, "scene.py")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(SCENE.replace("FOLDER", repr(folder)))
    said = must("yade", "-n", "-x", scene, cwd=scratch, env=dict(os.environ, PYTHONPATH=folder))
    assert "the grain bears" in said, said


def installed_and_uninstalled(scratch):
    prefix = os.path.join(scratch, "prefix")
    must("cmake", "--install", BUILD, "--prefix", prefix)
    folder = os.path.join(prefix, "lib/python3.11/dist-packages")
    works_from(folder, scratch)
    must("/usr/bin/python3.11", "-m", "compileall", "-q", folder + "/softgrain")
    other = os.path.join(folder, "other.py")
    shutil.copy(__file__, other)
    must("cmake", "--build", BUILD, "--target", "uninstall")
    assert files_in(prefix) == [other], files_in(prefix)
    assert not os.path.exists(os.path.join(folder, "softgrain"))
    again = run("cmake", "--build", BUILD, "--target", "uninstall")
    assert again.returncode != 0 and "Nothing has been installed" in again.stdout + again.stderr, again


def packaged(scratch):
    must("cpack", "-G", "DEB", "-B", scratch, cwd=BUILD)
    package, = glob.glob(scratch + "/*.deb")
    fields = dict(re.findall(r"^ ([\w-]+): (.*)$", must("dpkg-deb", "-I", package), re.M))
    version = must("dpkg-query", "-W", "-f", "${Version}", "yade")
    with open(os.path.join(BUILD, "pkg", "abi", "_built_for.py"), encoding="utf-8") as file:
        assert version.startswith(re.search('"(.+)"', file.read())[1]), version
    for name, pattern in (("py/__init__.py", r'__version__ = "(.+)"'), ("CITATION.cff", r"(?m)^version: (.+)$")):
        with open(os.path.join(ROOT, name), encoding="utf-8") as file:
            assert re.search(pattern, file.read())[1] == fields["Version"], f"{name} is of another version than the package"
    needs = fields["Depends"].split(", ")
    assert f"yade (= {version})" in needs and "python3-numpy" in needs, needs
    module = os.path.join(BUILD, "py/softgrain/_softgrain.so")
    for library in re.findall(r"NEEDED +(\S+)", must("objdump", "-p", module)):
        owners = {line.partition(":")[0] for line in must("dpkg-query", "-S", f"*/{library}").splitlines()}
        assert owners & {need.split()[0] for need in needs}, f"{library} of {owners} is not in {needs}"
    extracted = os.path.join(scratch, "extracted")
    must("dpkg-deb", "-x", package, extracted)
    folder = extracted + "/usr/lib/python3/dist-packages"
    packed = {os.path.basename(file) for file in files_in(folder + "/softgrain")}
    built = {os.path.basename(file) for file in files_in(BUILD + "/py/softgrain") if not file.endswith(".pyc")}
    assert packed == built, packed ^ built
    works_from(folder, scratch)


def elsewhere_says_what_to_do(_):
    environment = dict(os.environ, PYTHONPATH=os.path.join(BUILD, "py"), PYTHONDONTWRITEBYTECODE="1")
    for path, words in ((os.environ["PATH"], "`yade script.py`"), ("/nonexistent", "apt-get install yade")):
        done = run("/usr/bin/python3.11", "-c", "from softgrain import softDisc", env=dict(environment, PATH=path))
        last = done.stderr.strip().splitlines()[-1]
        assert done.returncode == 1 and last.startswith("ImportError: softgrain.softDisc works inside YADE only") and words in last, last


kept = None
if os.path.exists(LIST):
    with open(LIST, encoding="utf-8") as list_:
        kept = list_.read()
try:
    for test in (installed_and_uninstalled, packaged, elsewhere_says_what_to_do):
        with tempfile.TemporaryDirectory(prefix="softgrain-install-") as scratch_:
            test(scratch_)
finally:
    if kept is not None:
        with open(LIST, "w", encoding="utf-8") as list_:
            list_.write(kept)
print("3 passed, 0 failed")
