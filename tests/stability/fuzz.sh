#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Random scenes, judged as the hard cases are; fuzz.py says more.
#
#   bash tests/stability/fuzz.sh --count 500 --seed 7 --at-once 2 --keep failed.jsonl
. "$(dirname "${BASH_SOURCE[0]}")/../../examples/build.sh"

install_missing "${needed[@]}"
build_plugin _softgrain softgrain_python
exec yade -n -j1 -x -- "$root/tests/stability/fuzz.py" "$@" # after -- the options are the script's
