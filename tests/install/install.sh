#!/bin/sh
# Installs a build to a staging folder, moves that to FOLDER/moved and changes what its program should find: a scene of its
# own in SHARE, without a golden record.
# Usage: install.sh CMAKE BUILD FOLDER SHARE
set -eu
cmake=$1 build=$2 folder=$3 share=$4
rm -rf -- "$folder"
DESTDIR=$folder/stage "$cmake" --install "$build" --prefix /opt/assay
mv -- "$folder/stage/opt/assay" "$folder/moved"
sed 's/^title = .*/title = "A scene of its own"/; s/^name = .*/name = "own"/' "$share/scenes/rings.lua" >"$share/scenes/own.lua"
