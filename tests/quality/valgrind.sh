#!/usr/bin/env bash
# Memcheck over the unit programs of BUILD, which must not use AVX-512.
# Usage: valgrind.sh BUILD
set -euo pipefail
# One program and its reason per line; the sanitizers see these too.
skipped=''
memcheck() {
  local name=${1##*/}
  timeout 120 valgrind --quiet --error-exitcode=99 --leak-check=full --show-leak-kinds=definite \
    --errors-for-leak-kinds=definite "$1" >"$name.memcheck" 2>&1 && return 0
  printf '%s fails under memcheck, exit code %d:\n' "$name" $?
  tail -n 40 "$name.memcheck"
  return 1
}
export -f memcheck
cd -- "$1"
mapfile -t programs < <(find "$PWD/tests" -maxdepth 1 -name 'test_*' -executable -type f |
  grep -vxF "$(awk -v at="$PWD/tests/" 'NF { print at $1 }' <<<"$skipped")")
((${#programs[@]})) || { echo "no unit programs in $1"; exit 1; }
printf '%s\0' "${programs[@]}" | xargs -0 -P "$(nproc)" -I '{}' bash -c 'memcheck "$@"' memcheck '{}'
echo "${#programs[@]} programs"
