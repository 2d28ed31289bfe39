#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# The tests of the core under sanitizers: addresses, undefined behaviour and leaks; then races of threads.
#
#   bash tests/sanitizers.sh [ctest options, e.g. -R core_step]
#
# Built by clang: ThreadSanitizer cannot see where the threads of GNU's OpenMP wait for each other and takes that for races;
# LLVM's tells it through its tool archer.
. "$(dirname "${BASH_SOURCE[0]}")/../examples/build.sh"

install_missing "${needed[@]}" libgtest-dev clang-14 libomp-14-dev
archer=/usr/lib/llvm-14/lib/libarcher.so
[ -f "$archer" ] || die "$archer is missing: is libomp5-14 installed?"
export OMP_TOOL_LIBRARIES=$archer TSAN_OPTIONS="ignore_noninstrumented_modules=1 halt_on_error=1"
export ASAN_OPTIONS=strict_init_order=1 UBSAN_OPTIONS=print_stacktrace=1

status=0
for sanitizers in address,undefined thread; do
    build=$root/build/${sanitizers%,*}
    export SOFTGRAIN_CMAKE_OPTIONS="-DCMAKE_CXX_COMPILER=clang++-14 -DSOFTGRAIN_TESTS=ON -DSOFTGRAIN_SANITIZE=$sanitizers"
    build_plugin core_tests
    printf 'softgrain: under the sanitizers %s\n' "$sanitizers"
    ctest --test-dir "$build" --output-on-failure -j"$(nproc)" -R '^(core_|verification|sanitizer_)' -E layering \
        "$@" </dev/null || status=$?
done
exit "$status"
