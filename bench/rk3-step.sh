#!/usr/bin/env bash
# One RK3 step of the Taylor-Green vortex in space with viscosity, fused as in cycle, beside the sum of its words measured alone, each as a process from file to
# file; and the transforms of a spectral code: `rk3-step.sh [CELLS [ROUNDS]]`, 128 and 3. Both take turns; seconds are those of the processor, of one thread
# (--timing), so that other programs matter less, and the medians are printed. A spectral code needs 9 transforms of a scalar in a pass (3 velocities, 3
# vorticities, 3 products), and poisson-fft of a vector does 6. Target: a ratio of at most 1.25. Needs 1 GB in /dev/shm at 128^3, two minutes.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$0")/.."
export PATH=$PWD/bin:$PATH LC_ALL=C OMP_NUM_THREADS=1
cells=${1:-128} rounds=${2:-3} steps=2
words=(p2m poisson-fft mgrad stretch diffuse m2p 'push lsrk3')
sentence="$(printf '%s | ' "${words[@]}")remesh"
scratch=$(mktemp -d /dev/shm/pm-rk3-XXXXXX)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# alone WORD...: the frame through one word; its seconds to alone.ROUND.
alone() {
	"$@" --no-history --timing alone."$r" <in >out
	mv out in
}

pinit taylor-green-3d --cells "$cells" --no-history >start
for ((r = 0; r < rounds; r++)); do
	cycle -n $steps "$sentence" --timing fused.$r <start | cat >/dev/null
	cp start in
	for _ in 1 2 3; do
		# shellcheck disable=SC2086 # a word and its scheme
		for w in "${words[@]}"; do alone $w; done
	done
	alone remesh
	rm in
done
for ((r = 0; r < rounds; r++)); do
	awk -F'\t' -v OFS='\t' -v r=$r -v steps=$steps '{ split($1, w, " "); one = FILENAME ~ /alone/
		print w[1], r, $4 / (one ? 1 : steps), !one }' fused.$r alone.$r
done | awk -F'\t' -v n="$cells" '
	function middle(name, of,   i, k, v, t, m) {
		for (i = 0; i in round; i++) v[++m] = of ? fused[name, i] : alone[name, i]
		for (i = 2; i <= m; i++) for (k = i; k > 1 && v[k] < v[k - 1]; k--) { t = v[k]; v[k] = v[k - 1]; v[k - 1] = t }
		return m % 2 ? v[(m + 1) / 2] : (v[m / 2] + v[m / 2 + 1]) / 2
	}
	function row(name, of) { printf "%-12s %10.1f %10.1f\n", of, 1e9 * middle(name, 1) / n^3, 1e9 * middle(name, 0) / n^3 }
	{ round[$2] = 1 }
	$4 && $1 != "cycle" { fused[$1, $2] += $3; fused["all", $2] += $3 }
	$4 && $1 == "cycle" { fused["cycle", $2] = $3 }
	!$4 { alone[$1, $2] += $3; alone["all", $2] += $3 }
	!($1 in known) && $1 != "cycle" { known[$1] = 1; name[++names] = $1 }
	END {
		printf "%-12s %10s %10s   ns per particle and step, %d^3\n", "word", "fused", "alone", n
		for (i = 1; i <= names; i++) row(name[i], name[i])
		row("all", "sum")
		for (i = 0; i in round; i++) fused["ratio", i] = alone["ratio", i] = fused["cycle", i] / alone["all", i]
		for (i = 0; i in round; i++) fused["spectral", i] = 1.5 * fused["poisson-fft", i]
		for (i = 0; i in round; i++) alone["spectral", i] = 1.5 * alone["poisson-fft", i]
		printf "%-12s %10.1f\n", "whole step", 1e9 * middle("cycle", 1) / n^3
		printf "%-12s %10.2f   target 1.25\n", "ratio", middle("ratio", 1)
		row("spectral", "27 transforms")
	}'
