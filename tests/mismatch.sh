#!/bin/sh
# mismatch.sh PROGRAM FOLDER OVERRIDE: a configuration whose gates all pass must fail once the oracle is told OVERRIDE.
# Both are run, so that a failure for another reason does not count.
program=$1 folder=$2 override=$3
study() {
    "$program" verify swinging-cube --set stencil=sbp2 --set evolved=pF --set integrator=tvd-rk2 --set cfl=0.3 \
        --out "$folder" "$@"
}
study > "$folder.plain.txt" 2>&1
plain=$?
study --set "$override" > "$folder.told.txt" 2>&1
told=$?
tail -n 40 "$folder.plain.txt" "$folder.told.txt"
if [ "$plain" != 0 ] || [ "$told" != 1 ]; then
    echo "FAIL: exit codes $plain without and $told with $override, expected 0 and 1"
    exit 1
fi
grep -q "TOLD" "$folder.told.txt" && grep -q "FAIL: a gate does not hold" "$folder.told.txt"
