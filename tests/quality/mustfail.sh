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
  mkdir -p "$scratch/tree"/{solver,oracles,render,golden,verify,tests,.ci}
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
exit $wrong
