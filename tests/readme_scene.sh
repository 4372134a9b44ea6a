#!/bin/sh
# readme_scene.sh ASSAY README FOLDER: the scene that README.md shows is a whole one, and what is said of it holds.
assay=$1 readme=$2 folder=$3
mkdir -p "$folder" && sed -n '/^    title = "Pulled bar"/,/^$/s/^    //p' "$readme" >"$folder/my-scene.lua" || exit 1
output=$("$assay" verify "$folder/my-scene.lua" --out "$folder") || { printf '%s\n' "$output"; exit 1; }
printf '%s\n' "$output"
printf '%s\n' "$output" | grep -q '^PASS: all gates hold' || { echo "FAIL: the gates of the scene in $readme"; exit 1; }
printf '%s\n' "$output" | grep -q 'period .* 1[.]458e-03 ' || { echo "FAIL: its period is not as $readme says"; exit 1; }
