#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Runs an example of this folder: installs what is missing, builds the plugin, then `yade -n -x NAME.py [options]`.
#
#   bash examples/run.sh compaction.py --grains 100 --out my-run
#
# --threads N also starts YADE with N threads (yade -jN).
. "$(dirname "${BASH_SOURCE[0]}")/build.sh"

[ $# -gt 0 ] || die "name an example: $(cd "$root/examples" && printf '%s ' *.py)"
name=$(basename "$1")
[ -f "$root/examples/$name" ] || die "there is no example '$1'; take one of: $(cd "$root/examples" && printf '%s ' *.py)"
shift

threads=1
arguments=("$@")
for ((i = 0; i < $#; i++)); do
    case ${arguments[i]} in
        --threads) threads=${arguments[i + 1]:-1} ;;
        --threads=*) threads=${arguments[i]#*=} ;;
    esac
done
[[ $threads =~ ^[1-9][0-9]*$ ]] || die "--threads $threads: give a whole number from 1 up."

install_missing "${needed[@]}"
build_plugin _softgrain softgrain_python
exec yade -n -j"$threads" -x -- "$root/examples/$name" "$@" # after -- the options are the script's
