# SPDX-License-Identifier: GPL-2.0-or-later
# Sourced by examples/run.sh and tests/run.sh: installs what is missing on Debian 12 and builds the plugin.
#
#   install_missing PACKAGE...    Debian packages; asks the network only when one is missing
#   build_plugin [TARGET...]      into $SOFTGRAIN_BUILD (default: build/ beside the sources)
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${SOFTGRAIN_BUILD:-$root/build}
needed=(yade g++ cmake ninja-build libeigen3-dev libboost-python-dev libboost-serialization-dev libboost-log-dev
        libglu1-mesa-dev python3-dev python3-numpy python3-matplotlib)

die() {
    printf 'softgrain: %s\n' "$1" >&2
    exit 1
}

install_missing() {
    local missing=() package
    for package; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    command -v apt-get >/dev/null || die "the packages ${missing[*]} are missing and there is no apt-get: use Debian 12."
    [ "$(id -u)" = 0 ] || die "the packages ${missing[*]} are missing: run 'apt-get install ${missing[*]}' as root, or this script."
    printf 'softgrain: installing %s\n' "${missing[*]}" >&2
    local log
    log=$(mktemp)
    { apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"; } \
        >"$log" 2>&1 </dev/null || { tail -n 15 "$log" >&2; die "apt-get could not install ${missing[*]}: is the network up, and is this Debian 12?"; }
    rm -f "$log"
}

# Of ninja's output on a terminal its count of what is built.
count_built() {
    if [ -t 2 ]; then
        sed -un 's/^\(\[[0-9]*\/[0-9]*\]\).*/\1/p' | while read -r built; do printf '\rsoftgrain: %s ' "$built" >&2; done
        printf '\r\033[K' >&2
    else
        cat >/dev/null
    fi
}

build_plugin() {
    local log=$build/build.log
    mkdir -p "$build"
    [ -f "$build/build.ninja" ] || printf 'softgrain: building in %s (some minutes the first time)\n' "$build" >&2
    { cmake -S "$root" -B "$build" -G Ninja ${SOFTGRAIN_CMAKE_OPTIONS:-} && cmake --build "$build" --target "${@:-all}"; } \
        2>&1 </dev/null | tee "$log" | count_built || { tail -n 40 "$log" >&2; die "the build failed; all of its output is in $log."; }
    export PYTHONPATH=$build/py${PYTHONPATH:+:$PYTHONPATH}
}
