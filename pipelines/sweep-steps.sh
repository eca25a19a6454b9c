#!/usr/bin/env bash
# A sweep with GNU parallel: an ellipse of eccentricity 0.5, 1 orbit, at steps of 2 pi / (100, 200, 400), by two schemes: six runs side by side, a row each.
# Law: gravity, G M = a = 1; softening 0. The start and the sentence are one line each; parallel writes the parameters into it and keeps the order of the rows.
# Expected: the distance from the start after one orbit falls by 4 for leapfrog (order 2) when the step is halved, by 16 and more for rk4 (order 4; 19 +- 3
# here, where its error of order 5 still counts).
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
# shellcheck source=pipelines/numbers.sh
. "$(dirname "$0")/numbers.sh"
export OMP_NUM_THREADS=1 # too small for threads: parallel runs one per core
command -v parallel >/dev/null || { echo "sweep-steps: no GNU parallel here (apt-get install parallel)" >&2; exit 1; }

# one SCHEME STEPS: a row with the distance from the start after one orbit.
# shellcheck disable=SC2317 # parallel calls it
one() {
	local sentence='push kick/2 drift | pp | push kick/2'
	[ "$1" = rk4 ] && sentence='pp | push rk4'
	pinit kepler --eccentricity 0.5 --dt "$(calc "2 * pi / $2")" | cycle -n "$2" "$sentence" | sel --last | stab --plain |
		awk -v scheme="$1" -v n="$2" 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } END { x = $c["x"] + 1.5; y = $c["y"]
			printf "%s\t%d\t%.9g\n", scheme, n, sqrt(x * x + y * y) }'
}
export -f one calc

parallel --will-cite -k one ::: leapfrog rk4 ::: 100 200 400 >"$work/sweep.tsv"
printf 'scheme\tsteps\tdistance\n' | cat - "$work/sweep.tsv"
error() { awk -v s="$1" -v n="$2" '$1 == s && $2 == n { print $3 }' "$work/sweep.tsv"; }
for n in 100 200; do
	is "leapfrog: gain from $n to $((2 * n)) steps" "$(calc "$(error leapfrog $n) / $(error leapfrog $((2 * n)))")" 4 0.1
	is "rk4: gain from $n to $((2 * n)) steps" "$(calc "$(error rk4 $n) / $(error rk4 $((2 * n)))")" 19 3
done
finish
