#!/usr/bin/env bash
# A steady round vortex with straight flanks, omega = 100 max(0, 1 - r/0.5), dt = 5e-3, with particles remeshed every step and without remeshing: t = 0.01,
# 0.1, 0.15 (2, 20, 30 steps), 128^2 cells in open space.
# Law: vortex, lap psi = -omega, no viscosity; the exact solution is the start.
# Expected: the shear separates the particles; without remeshing the largest error of omega grows from 3.5 to 69 by t = 0.1 and passes
# the height of the vortex itself by 0.15 (enstrophy + 29 %); with remeshing it stays below W h/R = 3.1, the fall of the cone over one cell: only the tip and
# the foot, which no kernel reproduces, are wrong. Without remeshing the circulation is conserved to the last digits; with it also, if the strengths below
# 1e-5 of the largest, which are removed here, are counted. (Errors of our own runs; the source shows pictures.)
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
# shellcheck source=pipelines/numbers.sh
. "$(dirname "$0")/numbers.sh"

pinit cone-vortex >"$work/start"

# run STEPS REMESHING: leaves the solved frame's table, and the largest error of omega in $largest.
run() {
	cycle -n "$1" "p2m --kernel m6prime | poisson-fft | mgrad | m2p | push lsrk3 $2" <"$work/start" | p2m --kernel m6prime >"$work/end"
	diag --exact <"$work/end" >"$work/table"
	largest=$(stab --plain --mesh mesh <"$work/end" |
		awk 'NR > 1 { r = sqrt($1 * $1 + $2 * $2); d = $3 - (r < 0.5 ? 100 * (1 - 2 * r) : 0); d = d < 0 ? -d : d; m = d > m ? d : m } END {
			printf "%.17g", m }')
}

# lost: circulation removed by the threshold of remesh.
lost() { sls --format json --report <"$work/end" | grep -o '"lost_circulation":[-+.e0-9]*' | cut -d: -f2; }

# check NAME ERROR CIRCULATION: the largest error of omega, to a tenth, and the circulation against that of the start.
check() {
	is "$1: largest error of omega" "$largest" "$2" "$(calc "0.1 * $2")"
	is "$1: circulation over the first" "$(calc "$(column circulation last "$work/table") / 26.179122147034803")" 1 "$3"
}

while read -r steps remeshed alone; do
	run "$steps" '| remesh --kernel m6prime --cut-off 1e-5'
	check "remeshed, $steps steps" "$remeshed" 1e-5
	is "  and what the cut-off took" "$(calc "($(column circulation last "$work/table") + $(lost)) / 26.179122147034803")" 1 1e-13
	is "  largest error over W h/R" "$(calc "$largest / (100 / 32)")" 0.5 0.5
	kept=$largest
	run "$steps" ''
	check "alone, $steps steps" "$alone" 1e-13
	left=$largest
done <<'END'
2 0.519 3.46
20 1.99 69
30 2.90 111
END
is "30 steps: kept over lost" "$(calc "$kept / $left")" 0 0.04
is "30 steps: alone, the error over the height" "$(calc "$left / 100")" 1.5 0.5
is "alone, 30 steps: enstrophy over the exact" "$(calc "$(column enstrophy last "$work/table") / $(column exact_enstrophy last "$work/table")")" 1.29 0.05
finish
