#!/usr/bin/env bash
# Memcheck over the unit programs of BUILD.
# Usage: valgrind.sh BUILD
set -euo pipefail
# What is left out, and why; memcheck slows programs down by about 100, and the sanitizers see these too.
declare -A skipped=(
  [test_oracles_conformance]="eigenproblems as test_oracles_cantilever solves one, and what each oracle's own program calls: a minute"
  [test_oracles_self_check]="the self-checks of test_oracles_conformance: minutes"
  [test_oracles_everywhere]="the self-checks of test_oracles_conformance, for two dozen sets of parameters each: minutes"
  [test_oracles_outside]="the eigenproblems of both cantilevers, to ask where their bodies are: minutes"
  [test_oracles_mutations_round]="the self-checks of test_oracles_breathing and test_oracles_tube, for each fault: 30 s"
  [test_oracles_mutations_every]="the self-check of test_oracles_conformance, again for each fault: minutes"
  [test_oracles_mutations]="the self-check of test_oracles_conformance, again for each wrong formula: 50 s"
  [test_verify_sample_fuzz]="thousands of files, each of which the sanitizers see read: 20 s"
  [test_render_draw]="most of it is OSMesa, with machine code of its own making: 50 s"
  [test_solver_run_threads]="the runs of test_solver_run, three times each: minutes"
  [test_solver_slab]="the loops of test_solver_run_composite and test_solver_ulsph_states, for thousands of steps: minutes"
  [test_solver_scene_refusals]="thousands of scenes, each of which the sanitizers see refused: 50 s"
  [test_solver_stencil_refusals]="the clouds and stencils of test_solver_stencil, again for each refusal: 40 s"
  [test_solver_run_round]="factorised stencils of balls, and runs on them: minutes"
  [test_solver_stencil_round]="factorised stencils of balls: minutes"
  [test_verify_checkpoint]="runs of every scene, which test_solver_checkpoint makes of small ones: minutes"
  [test_solver_fields]="thousands of runs of test_solver_run, poisoned: a minute"
  [test_verify_trap]="valgrind 3.19 knows no floating-point traps"
  [test_golden_solved]="the runs of test_golden_paths, of other bodies"
  [test_solver_run_momentum]="a thousand steps of each run of test_solver_run: 90 s"
)
# Of these, some tests.
declare -A only=(
  [test_solver_cloud_solid]="refusals"                       # others: the same in 3D, and factorised stencils
  [test_solver_stl]="changed bytes"                          # others: thousands of distances, and runs
  [test_oracles_cantilever]="gets thinner in plane stress"   # the others solve such eigenproblems too, some twenty
  [test_oracles_thin_plate]="bends under its own inertia"    # another solves the eigenproblem of the body, as above
  [test_solver_affine]="what claims affine motions keeps them, 1D"       # others: more dimensions, hundreds of runs
  [test_verify_plasticity]="return maps along finite uniaxial cycles are exact" # others: runs through whole cycles
  [test_solver_run_plastic]="a step taken back"              # others: runs of hundreds of steps
  [test_solver_run_angular]="forces have no resultant"       # others: a thousand steps, many times
  [test_solver_checkpoint]="every evolved set"               # others: more of the same, for tens of steps
  [test_solver_pressure]="what it took is reported"          # others: thousands of iterations, many times
  [test_solver_precision]="bytes"                           # others: runs of fifty steps
  [test_solver_wall]="oblique wall"                          # others: every integrator in every dimension
  [test_verify_manufactured]="body force"                    # others: the self-checks of all kinds, by quadrature
  [test_solver_rotation]="F of a cell led through a turn|materials at F = R|the rotation itself" # others: long runs
  [test_solver_roots]="what has none"                        # others: against long double, which valgrind rounds to double
  [test_solver_wave]="a front of sweeps"                     # others: clang's OpenMP loses memory where teams change size
  [test_solver_closure]="nested spaces"                      # others: solutions, over and over: minutes
  [test_solver_closure_factor]="tree"                    # others: wide paths, and eliminations over and over
  [test_solver_single]="bytes|breakdown"                     # others: runs beside those in double precision: minutes
  [test_solver_symmetry]="whatever the terms"                # others: factorised stencils of balls and cylinders
  [test_solver_balance]="asked for"                          # others: more runs of the same
  [test_oracles_bimaterial_wave]="is the sum over all paths" # the others call it as often as that check does, or more
)

# Of others these are left out, beside what repeats.txt names: the sanitizers see them.
declare -A without=(
  [test_solver_run_walls]="carried along"      # walls of every kind in every dimension: 25 s
  [test_solver_run_composite]="a step for materials that differ ten thousand times" # long runs
  [test_solver_stencil_share]="runs give the same bits|other clouds keep all of theirs" # ten scenes, twice each, and more clouds: 45 s
  [test_solver_stencil_runs]="runs give the same bits|a wrong run is seen" # more scenes, on each path: minutes
  [test_solver_stencil_ranks]="each pair once gives the same rates|a wrong weight is seen" # the same
  [test_solver_run_faces]="faces hold their components, also on edges and in corners" # every kind on every body: 27 s
  [test_solver_stencil]="every builder in 3D"  # schemes and materials are run in 3D: 20 s
  [test_solver_flow]="work is stored or dissipated; order of the return map" # thousands of return maps: 8 s
  [test_solver_cost]="so it is of what few scenes ask for|what is allocated is what is declared" # fifty scenes: 15 s
  [test_solver_die]="distance and normal" # thousands of distances; "where pieces meet" and runs along walls ask for some: 9 s
  [test_solver_perturbed]="steps are short enough|slopes near the surface of a solid" # 32 spectra, and test_solver_spectrum makes some: 33 s
  [test_solver_slopes]="spectra of uneven bodies" # 20 of them; "momentum of a composite body" runs with such slopes: 67 s
)
while IFS='|' read -r program tests; do
  without[$program]+=${without[$program]:+|}$tests
done < <(grep '^test_' "$(dirname -- "$0")/repeats.txt")

# memcheck PROGRAM ONLY WITHOUT: of the program the tests that ONLY names, or all if it is empty, but those of WITHOUT.
memcheck() {
  local name=${1##*/}
  UNIT_ONLY=$2 UNIT_WITHOUT=$3 timeout 600 valgrind --quiet --error-exitcode=99 --leak-check=full --show-leak-kinds=definite \
    --errors-for-leak-kinds=definite "$1" >"$name.memcheck" 2>&1 && return 0
  printf '%s fails under memcheck, exit code %d:\n' "$name" $?
  tail -n 40 "$name.memcheck"
  return 1
}
export -f memcheck
# Valgrind knows no AVX-512 and computes fused multiply-adds by software: with them hot loops take three times as long.
export ASSAY_ISA=baseline
# Self-checks of an oracle at the ends of its parameters: of each list two; the sanitizers see all.
export UNIT_FEW=1
cd -- "$1"
programs=()
for program in "$PWD"/tests/test_*; do
  reason=${skipped[${program##*/}]-}
  some=${only[${program##*/}]-} others=${without[${program##*/}]-}
  [[ ! $some ]] || others=
  [[ $reason ]] && echo "${program##*/} left out: $reason" || programs+=("$program" "$some" "$others")
done
[[ -x ${programs[0]-} ]] || { echo "no unit programs in $1"; exit 1; }
printf '%s\0' "${programs[@]}" | xargs -0 -n 3 -P "$(nproc)" bash -c 'memcheck "$@"' memcheck
echo "$((${#programs[@]} / 3)) programs"
