#!/usr/bin/python3.11
# SPDX-License-Identifier: GPL-2.0-or-later
"""Builds the pages of doc/ and the reference of classes and functions with Sphinx; a warning of Sphinx is an error.

    apt-get install python3-sphinx python3-myst-parser
    cmake --build build --target doc        # calls  build.py BUILD_FOLDER  and writes BUILD_FOLDER/doc/html
"""
import os
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
build = os.path.abspath(sys.argv[1])
source, html = os.path.join(build, "doc", "source"), os.path.join(build, "doc", "html")
shutil.rmtree(os.path.join(build, "doc"), ignore_errors=True)
shutil.copytree(os.path.dirname(HERE), source, ignore=shutil.ignore_patterns("sphinx"))
environment = dict(os.environ, PYTHONPATH=os.path.join(build, "py"), PYTHONDONTWRITEBYTECODE="1")
for command in (["yade", "-n", "-x", os.path.join(HERE, "reference.py"), os.path.join(source, "reference")],
                ["/usr/bin/python3.11", "-m", "sphinx", "-W", "--keep-going", "-q", "-c", HERE, source, html]):
    if subprocess.run(command, env=environment, check=False).returncode != 0:
        sys.exit(f"failed: {' '.join(command)}")
print(f"{html}/index.html")
