#!/bin/sh
# Programs compiled by what pkg-config says of the installed libraries.
# Usage: pkg_config.sh CC PKG_CONFIG_PATH SOURCES SHARE OUT
set -eu
compiler=$1 sources=$3 share=$4 out=$5
mkdir -p -- "$out"
export PKG_CONFIG_PATH=$2
# shellcheck disable=SC2046 # flags are words
set -- $(pkg-config --variable=includedir assay)
for header in "$1"/*/*.h; do
    echo "#include \"$header\"" | "$compiler" -std=c17 -Wall -Werror -I"$1" -x c -fsyntax-only - # each by itself
done
# shellcheck disable=SC2046
"$compiler" "$share/examples/pulse-c/pulse.c" $(pkg-config --cflags --libs assay-oracles) -o "$out/pulse"
"$out/pulse"
# shellcheck disable=SC2046
"$compiler" "$sources/libraries.c" $(pkg-config --cflags --libs assay) -o "$out/libraries"
"$out/libraries" "$share"
