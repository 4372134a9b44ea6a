#!/usr/bin/env bash
# All C files as clang-format 14 would write them.
# Usage: format.sh SOURCE
set -euo pipefail
cd -- "$1"
mapfile -d '' -t files < <(find solver oracles render golden verify tests examples -name '*.[ch]' -print0)
((${#files[@]})) || { echo "no C files under $PWD"; exit 1; }
clang-format-14 --style=file --dry-run -Werror "${files[@]}" ||
  { echo "mend with: clang-format-14 -i FILE"; exit 1; }
echo "${#files[@]} files"
