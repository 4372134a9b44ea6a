#!/bin/sh
# Usage: mustfail_unit.sh TEST PROGRAM BROKEN: TEST passes in the unit program PROGRAM, exit code 0, and fails in BROKEN
# by its assertions, exit code 1. A crash, or a test that is not there, is no catch. What is broken may compute anything:
# it runs without floating-point traps.
UNIT_ONLY=$1 "$2" || { echo "FAIL: $1 fails in $2, where nothing is broken"; exit 1; }
ASSAY_TRAP='' UNIT_ONLY=$1 "$3"
code=$?
[ "$code" -eq 1 ] || { echo "FAIL: exit code $code, expected 1: $1 did not notice"; exit 1; }
