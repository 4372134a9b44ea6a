#!/usr/bin/env bash
# Unit programs and runs of scenes with floating-point traps: what is invalid, divides by zero or overflows ends them.
# Usage: trap.sh BUILD
set -euo pipefail
# All that computes; programs that hand over infinities and NaN to see them refused are not among these.
programs=(schemes run run_composite run_faces run_fluxes run_bodies run_start run_denormal jst material material_loops flow hardening
  integrator kernel stencil ulsph_diffusion ulsph_forces ulsph_gradients ulsph_pairs wall cost
  pressure symmetry balance checkpoint)
# Each exercises what the others do not. At such spacings gates need not hold: an exit code of 1 is no trap.
scenes=("verify swinging-cube --levels 8,12" "verify swinging-cube --levels 8 --set scheme=jst"
  "verify bimaterial-wave --levels 100,200" "verify taylor-bar --levels 1" "verify plastic-cube"
  "verify rings --levels 5 --set t_end=2e-4" "verify rod-impact --levels 50" "verify breathing-cylinder --levels 8"
  "verify spinning-body --levels 2" "verify elastic-cable --levels 50 --set scheme=ulsph"
  "verify twisting-column --levels 6 --set t_end=0.01"
  "run incompressible-column --set n=4 --set t_end=1e-3")

cd -- "$1"
out=$(mktemp -d)
trap 'rm -rf -- "$out"' EXIT
export ASSAY_TRAP=1 OMP_NUM_THREADS=1
wrong=0
for program in "${programs[@]}"; do
  "tests/test_solver_$program" >"$out/said" 2>&1 && continue
  echo "test_solver_$program:"
  tail -n 20 "$out/said"
  wrong=1
done
for scene in "${scenes[@]}"; do
  # shellcheck disable=SC2086 # words of a command line
  ./assay $scene --out "$out/scene" >"$out/said" 2>&1 || (($? == 1)) && continue
  echo "assay $scene:"
  tail -n 20 "$out/said"
  wrong=1
done
# And it strikes: a scene that starts with 1/0 m/s is refused without traps, and ends here with them.
printf '%s\n' 'title, dim, n, t_end = "trap", 1, 8, 1' 'domain = { lower = {0}, upper = {1} }' \
  'material = { model = "linear-elastic", E = 1, nu = 0.3, rho = 1 }' \
  'initial = { velocity = function(X) return 1 / X end }' >"$out/trap.lua"
code=0
./assay run "$out/trap.lua" --out "$out/scene" >"$out/said" 2>&1 || code=$?
if ((code != 99)) || ! grep -q 'ASSAY_TRAP: division by zero' "$out/said"; then
  echo "a division by zero ends with $code:"
  cat "$out/said"
  wrong=1
fi
((wrong)) || echo "${#programs[@]} programs, ${#scenes[@]} scenes"
exit $wrong
