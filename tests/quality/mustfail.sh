#!/usr/bin/env bash
# The checks of the code must be able to fail: each offence in a copy of the tree must be caught by its check.
# Usage: mustfail.sh SOURCE
set -euo pipefail
source=$1
here=$source/tests/quality
scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT
wrong=0

# A tree that passes, to be spoilt by one file at a time.
fresh() {
  rm -rf -- "$scratch/tree"
  mkdir -p "$scratch/tree"/{solver,oracles,render,golden,verify,tests,examples,cmake,.ci}
  cp -- "$source/.clang-format" "$source/.clang-tidy" "$scratch/tree"
  (cd -- "$scratch/tree" && touch CMakeLists.txt CMakePresets.json go)
  echo 'int solver_one(void);' >"$scratch/tree/solver/one.h"
  printf '#include "solver/one.h"\n\nint solver_one(void)\n{\n    return 1;\n}\n' >"$scratch/tree/solver/one.c"
}
database() {
  printf '[{ "directory": "%s", "command": "cc -I. -c %s", "file": "%s" }]\n' "$PWD" "$1" "$PWD/$1" >compile_commands.json
}
# expect CODE CHECK NAME FILE TEXT: with TEXT in FILE, CHECK must end with CODE (0, or 1 for caught) and name FILE.
expect() {
  local code=$1 check=$2 name=$3 file=$4 text=$5 got=0
  fresh
  cd -- "$scratch/tree"
  printf '%b' "$text" >>"$file"
  [[ $check != tidy ]] || database solver/one.c
  "$here/$check.sh" "$PWD" "$PWD" >"$scratch/said" 2>&1 || got=1
  if ((got != code)) || { ((code)) && ! grep -qF -- "$file" "$scratch/said"; }; then
    printf '%s: %s was expected to be %s, and it said:\n' "$check" "$name" "$( ((code)) && echo caught || echo fine)"
    cat "$scratch/said"
    wrong=1
  fi
}
expect 0 format "a formatted tree" solver/one.c ''
expect 1 format "a misplaced brace" solver/one.c 'int f(void) {\n return 1; }\n'
expect 1 format "a misplaced brace in an example" examples/a.c 'int f(void) {\n return 1; }\n'
expect 0 tidy "a clean tree" solver/one.c ''
expect 1 tidy "a use of freed memory" solver/one.c \
  '#include <stdlib.h>\nint f(void)\n{\n    int *p = calloc(1, 4);\n    free(p);\n    return p ? *p : 0;\n}\n'
expect 1 tidy "an ignored result" solver/one.c '#include <stdio.h>\nvoid f(FILE *a)\n{\n    fclose(a);\n}\n'
expect 0 forbidden "a clean tree" solver/one.c ''
expect 0 forbidden "snprintf" solver/one.c 'int s = snprintf(a, 1, "");\n'
expect 0 forbidden "verify that prints" verify/a.c '#include "oracles/oracle.h"\nint a = printf("");\n'
expect 0 forbidden "golden that reads records" golden/a.c '#include "solver/record.h"\n'
expect 1 forbidden "fast arithmetic" CMakeLists.txt 'add_compile_options(-f''fast-math)\n'
expect 1 forbidden "work left open" oracles/a.c '// TO''DO: the rest\n'
expect 1 forbidden "an example left open" examples/a.c '// TO''DO: the rest\n'
expect 1 forbidden "a folder for everybody's files" tests/a.c 'char a[] = "/t''mp/a";\n'
expect 1 forbidden "a solver that prints" solver/a.c 'int a = printf("");\n'
expect 1 forbidden "an oracle that writes to stderr" oracles/a.c 'int a = fputs("", stderr);\n'
expect 1 forbidden "a renderer that aborts" render/a.c 'void a(void) { abort(); }\n'
expect 1 forbidden "a golden that exits" golden/a.c 'void a(void) { exit(1); }\n'
expect 1 forbidden "an oracle that knows the solver" oracles/a.c '#include "solver/run.h"\n'
expect 1 forbidden "a renderer that knows records" render/a.h '#include "solver/record.h"\n'
expect 1 forbidden "a solver that knows verify" solver/a.c '#include "verify/study.h"\n'
expect 1 forbidden "a golden that knows oracles" golden/a.c '#include "oracles/oracle.h"\n'
expect 1 forbidden "a path around the rooms" solver/a.c '#include "../verify/study.h"\n'
expect 1 forbidden "a large file" golden/a.h5 "$(head -c 1100000 /dev/zero | tr '\0' a)"
expect 1 forbidden "a long file" solver/a.c "$(yes '\n' | head -n 501 | tr -d '\n')"

# The checks that run programs get a project of one test program each.
project() {
  fresh
  cd -- "$scratch/tree"
  cp -- "$source/CMakePresets.json" .
  printf '%s\n' 'cmake_minimum_required(VERSION 3.22)' 'project(small LANGUAGES C)' 'enable_testing()' \
    'add_subdirectory(tests)' >CMakeLists.txt
  printf '%s\n' "$1" 'add_executable(test_x x.c)' 'add_test(NAME unit-x COMMAND test_x)' >tests/CMakeLists.txt
  printf '#include <stdlib.h>\nint main(int n, char **v)\n{\n    (void)v;\n    %s\n}\n' "$2" >tests/x.c
}
# ends CODE NAME SAYS CHECK ARGS: the check ends so and, if it caught something, says what.
ends() {
  local code=$1 name=$2 says=$3 got=0
  shift 3
  "$here/$1.sh" "${@:2}" >"$scratch/said" 2>&1 || got=1
  if ((got != code)) || ! grep -qF -- "$says" "$scratch/said"; then
    printf '%s: %s was expected to end with %d and say "%s", and it said:\n' "$1" "$name" "$code" "$says"
    cat "$scratch/said"
    wrong=1
  fi
}
warn='add_compile_options(-g -gdwarf-4 -Wall -Wextra -Werror)'
# shellcheck disable=SC2016 # a variable of CMake
sanitize='add_compile_options(-g -fsanitize=${ASSAY_SANITIZE} -fno-sanitize-recover=all)
add_link_options(-fsanitize=${ASSAY_SANITIZE})'
overrun='volatile char *p = malloc((size_t)n); p[0] = 0; int r = p[n]; free((void *)p); return r * 0;' # read at any -O

project "$warn" 'int unused = n; return 0;'
ends 1 "a warning" 'unused variable' build "$PWD" "$PWD/build" debug -DCMAKE_C_COMPILER=clang-14
project "$warn" 'return n - 1;'
ends 0 "a clean program" '' build "$PWD" "$PWD/build" debug -DCMAKE_C_COMPILER=clang-14
ends 0 "a clean program" '1 programs' valgrind "$PWD/build"
project "$warn" "$overrun"
ends 0 "a clean build" '' build "$PWD" "$PWD/build" debug -DCMAKE_C_COMPILER=clang-14
ends 1 "a read past the end" 'Invalid read' valgrind "$PWD/build"
project "$warn" 'void *volatile p = malloc((size_t)n); p = NULL; return p != NULL;'
ends 0 "a clean build" '' build "$PWD" "$PWD/build" debug -DCMAKE_C_COMPILER=clang-14
ends 1 "a leak" 'definitely lost' valgrind "$PWD/build"
project "$sanitize" 'return n - 1;'
ends 0 "a clean program" '100% tests passed' sanitize "$PWD" "$PWD/build"
project "$sanitize" "$overrun"
ends 1 "a read past the end" 'heap-buffer-overflow' sanitize "$PWD" "$PWD/build"
project "$sanitize" 'int big = 2147483647; return big + n > 0;'
ends 1 "an overflow" 'signed integer overflow' sanitize "$PWD" "$PWD/build"
project '' 'return n - 1;'
ends 1 "a build without sanitizers" 'not built with sanitizers' sanitize "$PWD" "$PWD/build"
exit $wrong
