#!/usr/bin/env bash
# Builds with the address and undefined-behaviour sanitizers and runs all unit programs, and the program on files that
# are malformed, checkpoints among them.
# Usage: sanitize.sh SOURCE BUILD [CMAKE ARGS]
set -euo pipefail
source=$1 build=$2
# Reports need lines, and no more of what debuggers want, which would take half of the time to link. One path for the
# hot loops, as in the debug build: they are one text.
settings=("${@:3}" -DASSAY_DEBUG='-Og -g1')
[[ $(uname -m) != x86_64 ]] || settings+=(-DASSAY_ARCH=x86-64-v3)
"$(dirname -- "$0")/build.sh" "$source" "$build" sanitize "${settings[@]}"
for program in "$build"/tests/test_*; do
  # A build that lost its flags would pass whatever the code does.
  nm -D "$program" | grep __asan_init >/dev/null || { echo "$program is not built with sanitizers"; exit 1; }
done
export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1 UBSAN_OPTIONS=print_stacktrace=1
# Without what takes minutes: the mutation suites, which run the self-check of the conformance suite again for each fault,
# and the cantilever's own, some twenty eigenproblems as that suite solves one; nor the restarts of every scene, which
# test_solver_checkpoint makes of small ones; nor hundreds of runs, or thousands of steps, of what other programs run
# once (slab, momentum, angular, affine), and the conformance of every oracle.
exec ctest --test-dir "$build" -R '^(unit-|judge-malformed|restart-(full|refused|stopped))' -E 'oracles_(mutations|cantilever|conformance)|verify_checkpoint|solver_(slab|affine|run_momentum|run_angular)' --output-on-failure --no-tests=error --parallel "$(nproc)"
