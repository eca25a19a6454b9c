#!/usr/bin/env bash
# One evaluation of the velocity of N vortices in space, without a mesh (pp: Gaussian cores of a cell, of order 4 of 1.5) and with one (m6prime, order 6,
# open space): error and processor seconds of one thread, as TSV. The flow psi = exp(-r^2/s^2) along z, omega = curl curl psi, fills a cube of n^3 particles
# with s = 0.15 n cells; the mesh is as large as the cube (fill 1), or so large that the cube is a quarter of it (fill 0.244). The error is the relative l2 of
# u against curl psi. `velocity.sh [ROUNDS [SIDE...]]`: 3 rounds in turn, of which the medians are printed, and sides 10, 15, 20, 30, 40, 60, 80; pp up to a
# side of 40. Three minutes.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$0")/.."
export PATH=$PWD/bin:$PATH LC_ALL=C OMP_NUM_THREADS=1
rounds=${1:-3} sides=("${@:2}")
[ ${#sides[@]} != 0 ] || sides=(10 15 20 30 40 60 80)
scratch=$(mktemp -d /dev/shm/pm-velocity-XXXXXX)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# cube N M: n^3 particles in the middle of a box of m cells a side, with their exact velocity `right`.
cube() {
	local x y z q="(0.15*$1)^2"
	x="(x - $2/2)" y="(y - $2/2)" z="(z - $2/2)"
	pinit lattice --dim 3 -n $(($2 * $2 * $2)) --cells "$2" --spacing 1 --no-history |
		sel --where "max(max(abs($x), abs($y)), abs($z)) < $1/2" --drop v,mass |
		smod --law vortex --faces open --particle-faces open | scalc --extensive 'volume = 1' |
		scalc --role state "e = exp(-($x^2 + $y^2 + $z^2)/$q)" "right = -2*$y/$q*e, 2*$x/$q*e, 0" |
		scalc --extensive "alpha = 4*$z*$x/$q^2*e, 4*$z*$y/$q^2*e, (4/$q - 4*($x^2 + $y^2)/$q^2)*e"
}

# The words of the method on the standard input, each with its seconds to `times`.
mesh() { p2m --rim 2 --outside grow --timing times | poisson-fft --timing times | mgrad --timing times | m2p --timing times; }
pairs() { pp --form none --mollifier "$1" --softening "$2" --timing times; }

# measure FILL METHOD COMMAND...: a line of seconds and error.
measure() {
	rm -f times
	scalc 'w = right.x, right.y, right.z' <frame >exact
	"${@:3}" <frame >out
	printf '%s\t%s\t%d\t%s\t%s\n' "$1" "$2" "$n" "$(awk -F'\t' '{ s += $4 } END { printf "%.4g", s }' times)" \
		"$(scalc 'w = vel.x, vel.y, vel.z' <out | scmp --field w exact - | awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i }
			$1 != "frame" && !/^#/ { e = $at["relative_l2"] } END { printf "%.4g", e }')"
}

for ((r = 0; r < rounds; r++)); do
	for n in "${sides[@]}"; do
		cube "$n" "$n" >frame
		measure 1 mesh mesh
		[ "$n" -gt 40 ] || { measure 1 pp pairs gaussian 1 && measure 1 pp-gaussian-4 pairs gaussian-4 1.5; }
		[ "$n" -gt 40 ] || { measure 0.244 pp pairs gaussian 1 && measure 0.244 pp-gaussian-4 pairs gaussian-4 1.5; }
		[ $((n % 5)) != 0 ] || { cube "$n" $((8 * n / 5)) >frame && measure 0.244 mesh mesh; }
	done
done | awk -F'\t' -v OFS='\t' '
	{ k = $1 OFS $2 OFS $3; if (!(k in count)) order[++m] = k; seconds[k, ++count[k]] = $4 + 0; error[k] = $5 }
	function middle(k,   i, j, t) {
		for (i = 2; i <= count[k]; i++)
			for (j = i; j > 1 && seconds[k, j] < seconds[k, j - 1]; j--) {
				t = seconds[k, j]
				seconds[k, j] = seconds[k, j - 1]
				seconds[k, j - 1] = t
			}
		return seconds[k, int((count[k] + 1) / 2)]
	}
	END {
		print "fill", "method", "side", "particles", "error", "seconds", "h_over_scale", "ns_per_particle"
		for (i = 1; i <= m; i++) {
			split(order[i], a, OFS)
			# sqrt(abs(lap omega)/abs(omega)) in l2 is 63^(1/4)/s
			print a[1], a[2], a[3], a[3]^3, error[order[i]], middle(order[i]), sprintf("%.4g", 2.817 / (0.15 * a[3])),
				sprintf("%.4g", middle(order[i]) / a[3]^3 * 1e9)
		}
	}'
