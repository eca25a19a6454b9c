#!/usr/bin/env bash
# A model of the time of one step on 1 to 4096 cores: rates of one core, measured here, the gain of a second thread in the tables of docs/speed.md (an idle
# machine; 1.85 where it has none), the traffic of docs/distributed.md, and a network that is assumed. Prints the table of that page, and draws
# docs/ranks-model.png (OUT=FILE: elsewhere). No run of that many cores stands behind it. Which words the ranks share is asked of cycle. On a busy machine the
# rates, and all that follows, are too low.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
export PATH=${PM_BIN:-$top/bin}:$PATH LC_ALL=C
out=${OUT:-$top/docs/ranks-model.png}
cd "$(mktemp -d)"
trap 'rm -r "$PWD"' EXIT

threads=16    # cores of a rank: a rank is a node
latency=2e-6  # [s] of a message
band=12.5e9   # [bytes/s] of a rank, 100 Gbit/s

# measured SCENE SENTENCE: a line for each word: seconds of a step on one thread, the part of it that a second thread does not halve, shared by ranks or not.
# The least of five runs: whatever else the machine does only adds.
measured() {
	rm -f all
	for _ in 1 2 3 4 5; do OMP_NUM_THREADS=1 cycle -q -n 1 -i "$1" -o /dev/null --timing times "$2" && cat times >>all && rm times; done
	OMP_NUM_THREADS=1 cycle -q --ranks 2 -n 1 -i "$1" -o /dev/null --timing - "$2" 2>&1 | grep 'all ranks' | sed 's/   .*//; s/ .*//' >shared
	awk -F'\t' '
		FILENAME ~ /speed/ { split($0, c, " *[|] *"); if (c[4] == 2 && $0 ~ /one thread/) { gain[c[2]] += c[14]; rows[c[2]]++ } next }
		FILENAME == "shared" { yes[$1]; next }
		$1 ~ /^cycle/ { next }
		!($1 in s) { at[++m] = $1 }
		!($1 in s) || $3 < s[$1] { s[$1] = $3 }
		END {
			for (i = 1; i <= m; i++) {
				w = at[i]; sub(/ .*/, "", w); g = (w in gain) ? gain[w] / rows[w] : 1.85
				print w, s[at[i]], 2 / g - 1, (w in yes)
			}
		}' \
		"$top/docs/speed.md" shared all
}

# model NAME DIM SIDE N SIDE0 N0 PASSES < measured: the rows `cores time time_if_all_were_shared`, and the shares of words. SIDE^DIM points and N particles;
# SIDE0 and N0: those measured.
model() {
	awk -v name="$1" -v dim="$2" -v n="$3" -v N="$4" -v n0="$5" -v N0="$6" -v passes="$7" -v T=$threads -v a=$latency -v b=$band '
		function mesh(w) { return w ~ /^(poisson|mgrad|diffuse|stretch)/ }
		# what a rank sends and waits for, in a step, where the word is shared
		function travels(w, P,   plane, rows, counts) {
			plane = 8 * n ^ (dim - 1)
			if (P == 1 || w ~ /^push/) return P == 1 ? 0 : 2 * a * log(P) / log(2)
			if (w ~ /^poisson/) return 2 * (8 * M / (P * b) + a * P)                      # two transpositions
			if (mesh(w)) return 4 * plane / b + 4 * a                                     # planes of neighbours
			# records out of place, sorted every ten steps; rows of the tiles at both ends of a rank, of 8 (64) planes: of cic 1.23 numbers a cell
			rows = 2 * (dim == 3 ? 8 : 64) * n ^ (dim - 1)
			# counts of the records of each tile of 4096 cells, added over all ranks and over those before
			counts = 2 * log(P) / log(2) * (8 * M / 4096 / b + a)
			return counts + 4 * N / (P * b) + (w == "m2p" ? dim : 1) * 8 * 1.23 * (rows < M / P ? rows : M / P) / b + 2 * a * P
		}
		# and where it is not: its input to rank 0, its output to all
		function gathers(w, P) {
			return P == 1 ? 0 : (w == "p2m" ? 8 * dim * N + 8 * M : w == "m2p" ? 8 * dim * M + 8 * dim * N : 16 * M) / b
		}
		function speed(k, c) { return 1 / (serial[k] + (1 - serial[k]) / c) }
		function time(k, P, c, shared,   most, Q) {
			most = mesh(word[k]) ? (dim == 3 ? n : n / 16) : P # whole planes, or 16 rows
			Q = P < most ? P : most
			if (!shared) return passes * (work[k] / speed(k, c) + gathers(word[k], P))
			return passes * (work[k] / Q / speed(k, c) + travels(word[k], P))
		}
		BEGIN { M = n ^ dim }
		{ word[++m] = $1; work[m] = $2 * (mesh($1) ? M / n0 ^ dim : N / N0) / passes; serial[m] = $3; shared[m] = $4 }
		END {
			for (cores = 1; cores <= 2 ^ 20; cores *= 2) {
				c = cores < T ? cores : T; P = cores / c; now = all = 0
				for (k = 1; k <= m; k++) {
					part[k] = time(k, P, c, shared[k]); share[k] = time(k, P, c, 1)
					now += part[k]; all += share[k]
				}
				if (cores <= 4096) print name, cores, now, all >"rows"
				if (cores == 1 || cores == 64 || cores == 1024 || cores == 4096) {
					line = sprintf("| %s | %d | %.3g s | %.3g s |", name, cores, now, all)
					for (k = 1; k <= m; k++)
						line = line sprintf("%s %s %.0f/%.0f", k > 1 ? "," : "", word[k], 100 * part[k] / now, 100 * share[k] / all)
					print line " |"
				}
				if (cores > 2 * T && all > before / 1.5 && !stops) stops = cores / 2
				before = all
			}
			print name, stops >"stops"
		}'
	cat rows >>curves
	cat stops >>ends
}

echo '| step | cores | as the words stand | if all were shared | share of each word in % (as it stands/if all were shared) |'
echo '|---|---|---|---|---|'
kicks() { echo "push kick/2 drift | $1 | push kick/2"; }
pinit uniform -n 1000000 --dispersion 0.1 | ssort >pm.pm
measured pm.pm "$(kicks 'p2m -n 96 | poisson-fft | mgrad | m2p')" >pm
model pm 3 256 16777216 96 1000000 1 <pm
pinit taylor-green-2d --cells 512 >vortex.pm
measured vortex.pm 'p2m --kernel m6prime | poisson-fft | mgrad | diffuse | m2p | push lsrk3 | remesh --kernel m6prime' >vortex
model vortex 2 2048 4194304 512 262144 3 <vortex
pinit langmuir --dim 2 --axes 2 -n 1000000 --cells 256 --amplitude 0.1 >pic.pm
measured pic.pm "$(kicks 'p2m | poisson-fft | mgrad | m2p')" >pic
model pic 2 1024 67108864 256 1000000 1 <pic
echo
awk '{ printf "%s: all shared, twice the cores gain less than a factor of 1.5 from %d cores on\n", $1, $2 }' ends
{
	echo step cores time
	awk '$3 == $4 { print $1, $2, $3; next } { print $1 "-as-it-stands", $2, $3; print $1 "-all-shared", $2, $4 }' curves
} >table
splot time -i table -x cores --by step --log --slope -1 -o "$out" --title "A model, not a measurement: one step of each method" --x-label cores \
	--y-label 'time of a step [s]'
