#!/usr/bin/env bash
# Installs what is missing, builds and runs assay. A second call finds nothing to do and starts at once.
#   ./go verify swinging-cube    any command of assay; `./go list` shows what there is
#   ./go test [CTEST ARGS]       builds and runs all tests but those labelled slow, which take minutes each
#   ./go test --slow [...]       runs these as well; of them alone with -L slow
set -euo pipefail

here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
build=$here/build/release

libraries=(libgsl-dev libhdf5-dev libcunit1-dev libosmesa6-dev libpng-dev liblua5.4-dev
  libexpat1-dev zlib1g-dev)
packages=(build-essential cmake ninja-build pkg-config python3 "${libraries[@]}") # python3: tests look for it on configuring
# One version of the checkers, so that they say the same on every system; and VTK, which reads our records.
test_packages=(clang-14 clang-format-14 clang-tidy-14 libomp-14-dev valgrind libc6-dbg mandoc python3-vtk9)

say() { printf 'go: %s\n' "$*" >&2; }
fail() { say "$@"; exit 2; }

elsewhere="On systems without Debian's packages, install these with their headers, then call ./go again:
  a C17 compiler with OpenMP (GCC >= 11 or clang >= 14), CMake >= 3.22, Ninja >= 1.10, pkg-config,
  Python 3, GSL >= 2.7, HDF5 >= 1.10 (serial C library), CUnit 2.1, OSMesa (Mesa < 25.1; later ones have none),
  libpng >= 1.6, zlib, Expat >= 2.4, Lua 5.4.
  For './go test' also: clang, clang-format and clang-tidy 14 with libomp, valgrind >= 3.18,
  mandoc, and VTK 9 for Python 3."

# Prints those of the named packages that are not installed.
missing() {
  local installed name
  installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true) # fails on unknown names
  for name in "$@"; do
    [[ $'\n'$installed$'\n' == *$'\n'"installed $name"$'\n'* ]] || printf '%s\n' "$name"
  done
}

install_missing() {
  local wanted log=$here/build/packages.log root=()
  wanted=$(missing "$@")
  [[ $wanted ]] || return 0
  mapfile -t wanted <<<"$wanted"
  local command="apt-get update && apt-get install -y --no-install-recommends ${wanted[*]}"
  if ((EUID != 0)); then
    if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
      root=(sudo -n)
    else
      fail "packages are missing and this user may not install them. As root, run:"$'\n'"  $command"
    fi
  fi
  say "installing ${wanted[*]} (log: $log)"
  local apt=("${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=600)
  local install=("${apt[@]}" install --no-install-recommends "${wanted[@]}")
  # The package lists may be absent or stale: fetch them only then.
  if ! "${install[@]}" </dev/null >"$log" 2>&1 &&
    ! { "${apt[@]}" update && "${install[@]}"; } </dev/null >>"$log" 2>&1; then
    tail -n 15 "$log" >&2
    local name
    for name in "${wanted[@]}"; do
      [[ -n $(apt-cache show "$name" 2>/dev/null) ]] || say "this system has no package $name"
    done
    fail "could not install. The command was:"$'\n'"  $command"$'\n'"$elsewhere"
  fi
}

# Silent if there is nothing to do, else one line; shows the end of the log if it fails.
build() {
  local log=$here/build/release.log
  if [[ -e $build/CMakeCache.txt ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$here" "$build/CMakeCache.txt"; then
    rm -rf -- "$build" # the checkout was moved
  fi
  if [[ ! -e $build/build.ninja ]]; then
    local tool
    for tool in cmake ninja pkg-config; do
      command -v "$tool" >/dev/null || fail "$tool is not installed. $elsewhere"
    done
    say "configuring (log: $log)"
    if ! (cd -- "$here" && cmake --preset release) </dev/null >"$log" 2>&1; then
      tail -n 30 "$log" >&2
      fail "could not configure; the whole log is $log"$'\n'"$elsewhere"
    fi
  fi
  if ! ninja -C "$build" "$1" </dev/null 2>&1 | tee "$log" |
    LOG=$log awk '/^\[/ && !/globbed/ && !said++ { print "go: building (log: " ENVIRON["LOG"] ")" >"/dev/stderr" }'; then
    tail -n 30 "$log" >&2
    fail "the build failed; the whole log is $log"
  fi
}

# One at a time; the lock is given back before the program starts.
{ mkdir -p -- "$here/build" && exec 9>"$here/build/.lock"; } 2>/dev/null ||
  fail "cannot write to $here/build, where the build goes: give this user that folder, or copy the checkout"
if command -v flock >/dev/null && ! flock -n 9; then
  say "waiting for another call of ./go to finish building"
  flock 9
fi
# Threads that wait spin for some microseconds and then sleep. For longer, and beside another program a run on all cores
# takes three times as long; not at all, and alone on them a run of 5000 particles does.
[[ ${OMP_WAIT_POLICY-} ]] || export GOMP_SPINCOUNT=${GOMP_SPINCOUNT-1000}

testing=false
[[ ${1-} != test ]] || testing=true
if command -v dpkg-query >/dev/null && command -v apt-get >/dev/null; then
  $testing && packages+=("${test_packages[@]}")
  install_missing "${packages[@]}"
fi
if $testing; then
  shift
  which=(--label-exclude '^slow$')
  arguments=()
  for argument; do
    if [[ $argument == --slow ]]; then which=(); else arguments+=("$argument"); fi
  done
  build all
  # Held until ctest ends: two runs in one folder would trip over each other.
  exec 8>"$here/build/.test-lock" 9>&-
  if command -v flock >/dev/null && ! flock -n 8; then
    say "waiting for another ./go test to finish"
    flock 8
  fi
  exec ctest --test-dir "$build" --output-on-failure --no-tests=error --no-label-summary --schedule-random \
    --parallel "$(nproc)" "${which[@]}" "${arguments[@]}"
fi
build assay
exec 9>&-
exec "$build/assay" "$@"
