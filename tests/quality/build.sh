#!/usr/bin/env bash
# Builds everything in a folder of its own, warnings being errors.
# Usage: build.sh SOURCE BUILD PRESET [CMAKE ARGS]
set -euo pipefail
source=$1 build=$2 preset=$3
shift 3
cd -- "$source"
cmake --preset "$preset" -B "$build" "$@" >"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
ninja -C "$build" -t cleandead >/dev/null # programs whose source is gone
ninja -C "$build" -k 0 >"$build.log" 2>&1 || { grep -v '^\[' "$build.log"; exit 1; }
tail -n 1 "$build.log"
