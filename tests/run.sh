#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Installs what is missing, builds everything and runs all tests.
#
#   bash tests/run.sh [ctest options, e.g. -R contact]
. "$(dirname "${BASH_SOURCE[0]}")/../examples/build.sh"

install_missing "${needed[@]}" libgtest-dev clang-format-14 python3-siconos libfclib-dev python3-h5py python3-vtk9 xvfb dpkg-dev python3-sphinx python3-myst-parser
export SOFTGRAIN_CMAKE_OPTIONS="-DSOFTGRAIN_TESTS=ON -DSOFTGRAIN_WERROR=$([ "${CI:-}" = true ] && echo ON || echo OFF)"
build_plugin

log=$build/tests.log
status=0
ctest --test-dir "$build" --output-on-failure --timeout 900 -j"$(nproc)" "$@" 2>&1 </dev/null | tee "$log" || status=$?
# ctest says "X% tests passed, F tests failed out of N"
read -r failed total < <(sed -n 's/.*tests passed, \([0-9]*\) tests failed out of \([0-9]*\).*/\1 \2/p' "$log" | tail -n 1) || true
[ -n "${total:-}" ] || die "no test ran; the output is in $log."
printf '%d passed, %d failed\n' "$((total - failed))" "$failed"
exit "$status"
