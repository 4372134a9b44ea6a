#!/usr/bin/env bash
# ./go on a small project of its own, with package tools that only pretend.
# Usage: go.sh GO
set -euo pipefail
go=$(readlink -f -- "$1")
scratch=$(mktemp -d)
trap 'chmod -R u+w -- "$scratch"; rm -rf -- "$scratch"' EXIT
chmod 755 "$scratch"
wrong=0

top="$scratch/a checkout"
fake=$scratch/fake
mkdir "$top" "$fake"
cp -- "$go" "$top/go"
cd -- "$top"
# shellcheck disable=SC2016 # CMake's variable
echo '{ "version": 3, "configurePresets": [ { "name": "release", "generator": "Ninja",
  "binaryDir": "${sourceDir}/build/release" } ] }' >CMakePresets.json
printf '%s\n' 'cmake_minimum_required(VERSION 3.22)' 'project(small LANGUAGES C)' 'add_executable(assay main.c)' \
  'enable_testing()' 'add_test(NAME it-runs COMMAND assay)' 'add_test(NAME it-runs-long COMMAND assay)' \
  'set_tests_properties(it-runs-long PROPERTIES LABELS "gate;slow")' 'add_test(NAME it-runs-slowly COMMAND assay)' \
  'set_tests_properties(it-runs-slowly PROPERTIES LABELS "slowly")' >CMakeLists.txt
program='#include <stdio.h>\n#include <unistd.h>\nint main(int n, char **v)\n{\n    for (int i = 1; i < n; i++) puts(v[i]);
    fflush(stdout);\n    if (n > 2) sleep(30);\n    return n == 1 ? 0 : 7;\n}\n'
# shellcheck disable=SC2059 # the program holds the line ends
printf "$program" >main.c

# All packages are installed, unless the file `lacks` names one; apt-get writes down how it was called and fails.
cat >"$fake/dpkg-query" <<'END'
#!/usr/bin/env bash
shift 3
lacks=$(cat "${0%/*}/lacks" 2>/dev/null)
for name; do [[ $name == "$lacks" ]] || echo "installed $name"; done
[[ ! $lacks ]] # like the real one, which fails on a name that it does not know
END
cat >"$fake/apt-get" <<'END'
#!/usr/bin/env bash
echo "apt-get $*" >>"${0%/*}/called"
echo "no network today"
exit 100
END
printf '#!/bin/sh\nexit 1\n' | tee "$fake/sudo" >"$fake/apt-cache"
chmod +x "$fake"/*
export PATH=$fake:$PATH

# expect NAME CODE COMMAND...: runs it with closed input; what it says goes to $out and $err.
out=$scratch/out err=$scratch/err
expect() {
  local name=$1 code=$2 got=0
  shift 2
  "$@" </dev/null >"$out" 2>"$err" || got=$?
  ((got == code)) || complain "$name" "exit code $got, not $code"
}
complain() { printf '%s: %s\n--- out\n%s\n--- err\n%s\n' "$1" "$2" "$(cat "$out")" "$(cat "$err")"; wrong=1; }
says() { grep -qF -- "$2" "$3" || complain "$1" "does not say: $2"; }

cd /
expect "first call" 7 "$top/go" 'two words'
[[ $(cat "$out") == 'two words' ]] || complain "first call" "arguments or output changed"
[[ $(wc -l <"$err") == 2 ]] || complain "first call" "must say two lines: that it configures, and that it builds"

start=$(date +%s%N)
expect "second call" 7 "$top/go" list
(($(date +%s%N) - start < 1000000000)) || complain "second call" "takes a second or more"
[[ ! -s $err ]] || complain "second call" "says something though there is nothing to do"
[[ ! -e $fake/called ]] || complain "second call" "calls apt-get though nothing is missing"

expect "tests" 0 "$top/go" test
says "tests" "100% tests passed, 0 tests failed out of 2" "$out"
! grep -q it-runs-long "$out" || complain "tests" "runs one that is labelled slow"
expect "slow tests too" 0 "$top/go" test --slow
says "slow tests too" "100% tests passed, 0 tests failed out of 3" "$out"
expect "slow tests alone" 0 "$top/go" test -L '^slow$' --slow
says "slow tests alone" "100% tests passed, 0 tests failed out of 1" "$out"
expect "tests that do not exist" 8 "$top/go" test -R no-such-test

# A program that runs keeps nobody waiting; a build does.
"$top/go" goes on </dev/null >"$scratch/running" 2>&1 &
until [[ -s $scratch/running ]]; do sleep 0.02; done
expect "beside a running program" 7 "$top/go" list
[[ ! -s $err ]] || complain "beside a running program" "waits for it, or builds again"
kill $!
flock "$top/build/.lock" sleep 0.5 &
sleep 0.1
expect "beside a build" 7 "$top/go" list
says "beside a build" "waiting for another" "$err"

mv -- "$top" "$scratch/moved"
top=$scratch/moved
expect "moved checkout" 7 "$top/go" list

echo 'int oops = ;' >>"$top/main.c"
expect "broken source" 2 "$top/go" list
says "broken source" "int oops = ;" "$err"
says "broken source" "$top/build/release.log" "$err"
# shellcheck disable=SC2059
printf "$program" >"$top/main.c"

echo libgsl-dev >"$fake/lacks"
as_user=()
if ((EUID == 0)); then
  expect "apt that fails" 2 "$top/go" list
  says "apt that fails" "no network today" "$err"
  says "apt that fails" "no package libgsl-dev" "$err"
  says "apt that fails" "apt-get install -y --no-install-recommends libgsl-dev" "$err"
  grep -q 'apt-get.* update' "$fake/called" || complain "apt that fails" "did not fetch the package lists"
  chown -R 65534:65534 "$top"
  as_user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
fi
expect "missing package, no root" 2 "${as_user[@]}" "$top/go" list
says "missing package, no root" "apt-get install -y --no-install-recommends libgsl-dev" "$err"
rm -- "$fake/lacks"

if ((EUID == 0)); then
  chown -R 0:0 "$top"
else
  chmod -R a-w "$top/build"
fi
expect "folder of somebody else" 2 "${as_user[@]}" "$top/go" list
says "folder of somebody else" "cannot write to" "$err"
exit $wrong
