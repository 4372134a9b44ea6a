#!/bin/sh
# The manual page without a warning, and with a mistake in it not so. It has no date: it is of a version.
# Usage: manual.sh PAGE
page=$1
command -v groff mandoc || { echo "neither groff nor mandoc is there"; exit 77; }

warnings() {
    ! command -v groff >/dev/null || groff -man -Tutf8 -ww -z "$1" 2>&1
    ! command -v mandoc >/dev/null || mandoc -Tlint -Wwarning "$1" 2>&1 | grep -v 'missing date'
}
said=$(warnings "$page")
[ -z "$said" ] || { printf '%s\n' "$said"; exit 1; }

for mistake in '.PQ' '.RE' '\\fQ' '\\(qq'; do
    { cat "$page"; printf "$mistake\n"; } >"$page.wrong"
    [ -n "$(warnings "$page.wrong")" ] || { echo "$mistake passes for right"; exit 1; }
done
