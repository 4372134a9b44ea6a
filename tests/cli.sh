#!/bin/sh
# cli.sh CODE TEXT PROGRAM WORD...: runs the program and checks its exit code and that its output holds TEXT.
code=$1 text=$2
shift 2
output=$("$@" 2>&1)
got=$?
printf '%s\n' "$output"
if [ "$got" != "$code" ]; then
    echo "FAIL: exit code $got, expected $code"
    exit 1
fi
case $output in
    *"$text"*) ;;
    *) echo "FAIL: the output does not hold: $text"; exit 1 ;;
esac
