#!/usr/bin/env bash
# PM-02: the particle-mesh force of a pair against its distance, in a periodic box of 64^3 cells (or -n): a unit mass at random places, 8 massless
# particles around it at r = 1, 2 and 4 cells in random directions. Prints a table (markdown): rms error of the force relative to the exact force, and the
# processor seconds of a leapfrog step of 262144 particles on that mesh (one thread, 12 steps less 2, median of 5 turns, least and most). Exact force: that
# of points, 1/r^2, or of clouds S2 of diameter 4 cells (Hockney and Eastwood 1988, equation 8-3 ff.), both less the background. --check N: N places (75), no
# seconds; --only WORD: rows whose name
# has it; --seed S. Expected: docs/methods/pm-force.md. SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
. "$(dirname "$0")/numbers.sh"
n=64 places=75 seconds=1 only='' seed=2
while [ $# -gt 0 ]; do
	case $1 in
	-n) n=$2 ;;
	--check) places=$2 seconds='' ;;
	--only) only=$2 ;;
	--seed) seed=$2 ;;
	*) echo "pm-force.sh: -n CELLS, --check PLACES, --only WORD, --seed S" >&2; exit 2 ;;
	esac
	shift 2
done
export OMP_NUM_THREADS=1

# The frames as text: the header of the scene pair with 25 particles, once per place. Random numbers: x <- 16807 x mod 2^31-1 (Park and Miller 1988).
places() {
	pinit pair --length "$n" --no-history | stab | awk -v n="$n" -v places="$places" -v seed="$seed" '
		function random() { seed = 16807 * seed % 2147483647; return seed / 2147483647 }
		/^#pmpipe/ { gsub(/"n":2,/, "\"n\":25,"); gsub(/"cells":\[[0-9,]*\]/, "\"cells\":[" n "," n "," n "]"); gsub(/"h":\[[0-9.,]*\]/,
			"\"h\":[1.0,1.0,1.0]"); header = $0 }
		END { for (p = 0; p < places; p++) {
			print header; print "#set matter"; print "x\ty\tz\tvx\tvy\tvz\tmass\tid"
			for (d = 0; d < 3; d++) x[d] = n * random()
			printf "%.17g\t%.17g\t%.17g\t0\t0\t0\t1\t0\n", x[0], x[1], x[2]
			for (q = 0; q < 24; q++) {
				r = 2 ^ (q % 3); z = 2 * random() - 1; a = 6.283185307179586 * random(); s = sqrt(1 - z * z)
				e[0] = s * cos(a); e[1] = s * sin(a); e[2] = z
				for (d = 0; d < 3; d++) { y[d] = x[d] + r * e[d]; y[d] -= n * (y[d] >= n) - n * (y[d] < 0) }
				printf "%.17g\t%.17g\t%.17g\t0\t0\t0\t0\t%d\n", y[0], y[1], y[2], q + 1
			}
		}
		print "#end " places }' | stab -
}

# errors CLOUD < text of the forces: for r = 1, 2, 4 mean radial force, rms transverse force, rms error, relative to the exact force.
errors() {
	awk -v n="$n" -v a="$1" '
		function wanted(r,  x, f) {
			f = 1 / (r * r); x = a > 0 ? 2 * r / a : 2
			if (x < 1) f = (224*x - 224*x^3 + 70*x^4 + 48*x^5 - 21*x^6) / (35 * a * a)
			else if (x < 2) f = (12/x^2 - 224 + 896*x - 840*x^2 + 224*x^3 + 70*x^4 - 48*x^5 + 7*x^6) / (35 * a * a)
			return f - 4 * 3.141592653589793 / 3 * r / n^3
		}
		$1 == "x" { for (i = 1; i <= NF; i++) c[$i] = i; first = 1; next }
		NF && first { for (d = 1; d <= 3; d++) x[d] = $d; first = q = 0; next }
		NF { k = q++ % 3; r = 2^k; f = wanted(r); along = all = 0
			for (d = 1; d <= 3; d++) { e = $d - x[d]; e -= n * (e > n/2) - n * (e < -n/2); g = $(c["acc_" d-1]); along -= g * e / r; all += g * g }
			m[k]++; mean[k] += along / f; across[k] += (all - along^2) / f^2; error[k] += (all - along^2 + (along - f)^2) / f^2 }
		END { for (k = 0; k < 3; k++) printf "%.4f %.4f %.4f%s", mean[k] / m[k], sqrt(across[k] / m[k]), sqrt(error[k] / m[k]), k < 2 ? " " : "\n" }'
}

words() { echo "p2m $1 | poisson-fft $2 | mgrad --order $3 | m2p"; }

# cpu STEPS SENTENCE: processor seconds (user) of so many steps of 262144 particles.
cpu() {
	local TIMEFORMAT=%U
	# shellcheck disable=SC2154 # work is of numbers.sh
	{ time cycle -n "$1" "push kick/2 drift | $2 | push kick/2" < "$work/many" > "$work/out"; } 2>&1
}

lines=() sentences=()
row() { # NAME P2M SOLVER ORDER CLOUD
	local e name=$1 sentence
	[[ $name == *$only* ]] || return 0
	sentence=$(words "$2" "$3" "$4")
	e=$(bash -o pipefail -c "$sentence" < "$work/places" | stab --plain --set matter | errors "$5")
	# shellcheck disable=SC2086 # nine numbers
	set -- $e
	lines+=("| $name | $1 $2 $3 | $4 $5 $6 | $7 $8 $9 |")
	sentences+=("$sentence")
}
part() { # NAME
	lines+=("| **$1** | | | |") sentences+=('')
}

# Seconds of a step of every sentence, in turns: a burst of other work on the machine affects one turn of all sentences, not one sentence. Median, least and
# most of 5.
turns() {
	for _ in 1 2 3 4 5; do
		for i in "${!sentences[@]}"; do
			[ -z "${sentences[i]}" ] || echo "$i $(cpu 2 "${sentences[i]}") $(cpu 12 "${sentences[i]}")"
		done
	done | awk '{ printf "%d %.4f\n", $1, ($3 - $2) / 10 }' | sort -k1,1n -k2,2g |
		awk '{ v[$1] = v[$1] " " $2 } END { for (i in v) { split(v[i], t, " "); printf "%d %.3f (%.3f-%.3f)\n", i, t[3], t[1], t[5] } }'
}

places > "$work/places"
if [ -n "$seconds" ]; then
	pinit uniform -n 262144 --length "$n" --cells "$n" --dt 1e-6 > "$work/many"
fi
echo '| kernel, options, order of mgrad | r = 1: mean, across, error | r = 2 | r = 4 |'"${seconds:+ seconds |}"
echo '|---|---|---|---|'"${seconds:+---|}"
part 'the force of points'
row 'ngp, fd2, 2' '--kernel ngp' '--symbol fd2' 2 0
for k in cic tsc; do
	row "$k, fd2, 2" "--kernel $k" '--symbol fd2' 2 0
	row "$k, spectral, 4" "--kernel $k" '' 4 0
	row "$k, spectral, spectral" "--kernel $k" '' spectral 0
	row "$k, --influence deconvolved, 4" "--kernel $k" '--influence deconvolved' 4 0
	row "$k, --influence optimal, 4" "--kernel $k" '--influence optimal --order 4' 4 0
	row "$k --interlace, spectral, spectral" "--kernel $k --interlace" '' spectral 0
done
row 'pcs, spectral, spectral' '--kernel pcs' '' spectral 0
part 'the force of clouds, --cloud 4'
for k in cic tsc; do
	row "$k, plain, 4" "--kernel $k" '--cloud 4' 4 4
	row "$k, deconvolved, 2" "--kernel $k" '--cloud 4 --influence deconvolved' 2 4
	row "$k, deconvolved, 4" "--kernel $k" '--cloud 4 --influence deconvolved' 4 4
	row "$k, deconvolved, spectral" "--kernel $k" '--cloud 4 --influence deconvolved' spectral 4
	row "$k, optimal, 2" "--kernel $k" '--cloud 4 --influence optimal --order 2' 2 4
	row "$k, optimal, 4" "--kernel $k" '--cloud 4 --influence optimal --order 4' 4 4
	row "$k --interlace, deconvolved, spectral" "--kernel $k --interlace" '--cloud 4 --influence deconvolved' spectral 4
	row "$k --interlace, optimal, 4" "--kernel $k --interlace" '--cloud 4 --influence optimal --order 4' 4 4
done
row 'pcs, optimal, 4' '--kernel pcs' '--cloud 4 --influence optimal --order 4' 4 4
[ -z "$seconds" ] || turns > "$work/seconds"
for i in "${!lines[@]}"; do
	echo "${lines[i]}${seconds:+ $(awk -v i="$i" '$1 == i { print $2, $3 }' "$work/seconds") |}"
done
