#!/bin/sh
# golden_spoilt.sh ASSAY SPOIL GOLDEN FOLDER FILE WHAT LINE: in a copy of the stored results WHAT is spoilt in FILE;
# assay golden check must end with exit code 1 because of LINE, the only one that fails.
set -eu
assay=$1 spoil=$2 golden=$3 folder=$4 file=$5 what=$6 line=$7
rm -rf -- "$folder"
mkdir -p -- "$folder"
cp -- "$golden/swinging-cube.vtkhdf" "$golden/swinging-cube.png" "$folder"
"$spoil" "$folder/$file" "$what"
code=0
"$assay" golden check swinging-cube --dir "$folder" --out "$folder/out" > "$folder/check.txt" 2>&1 || code=$?
cat -- "$folder/check.txt"
if [ "$code" != 1 ]; then
    echo "FAIL: exit code $code, expected 1"
    exit 1
fi
if ! grep -q "^  $line.* FAIL" "$folder/check.txt" || [ "$(grep -c "^  .* FAIL" "$folder/check.txt")" != 1 ]; then
    echo "FAIL: \"$line\" should be the one line that fails"
    exit 1
fi
