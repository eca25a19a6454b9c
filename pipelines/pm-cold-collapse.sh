#!/usr/bin/env bash
# A cold plane wave collapses in a periodic box in one dimension: k A = 0.05 at rest, 1024 sheets, on meshes of 16 to 128 cells a wave.
# Law: gravity, lap phi = 4 pi G (rho - mean), 4 pi G rho = 1, so that A grows as cosh(t) until the sheets cross at t = 3.68825.
# Expected (PM-06): k A = 0.0771540 at t = 1 and 0.1881098 at t = 2 on 128 cells; growth rate cos(k dx/2) on every mesh; crossing to 1 %.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
# shellcheck source=pipelines/numbers.sh
. "$(dirname "$0")/numbers.sh"
export OMP_NUM_THREADS=1 # too small for threads
dt=0.05

# k A after every step: 2 k/n sum (x - q) sin(k q), q from the id.
amplitude() {
	stab --plain |
		awk 'function out() { if (n) printf "%.17g\n", 2 * k * s / n }
			BEGIN { k = 2 * atan2(0, -1) }
			NF == 0 { next }
			/x/ { out(); for (i = 1; i <= NF; i++) c[$i] = i; n = s = 0; next }
			{ q = ($c["id"] + 0.5) / 1024; d = $c["x"] - q; d -= d > 0.5 ? 1 : d < -0.5 ? -1 : 0; s += d * sin(k * q); n++ }
			END { out() }'
}

run() { # CELLS TIME AMPLITUDE
	pinit cold-collapse -n 1024 --cells "$1" --dt $dt --amplitude "$3" |
		cycle -t "$2" --every 1 'push kick/2 drift | p2m | poisson-fft --symbol fd2 | mgrad --order 2 | m2p | push kick/2' |
		amplitude
}

run 128 3.75 0.05 >"$work/a"
is "k A at t = 1, 128 cells" "$(sed -n 21p "$work/a")" 0.0771540317407622 7.7e-5
is "k A at t = 2" "$(sed -n 41p "$work/a")" 0.188109784554182 1.9e-4
is "time of crossing" "$(awk -v dt=$dt 'NR > 1 && $1 >= 1 && a < 1 { printf "%.17g", dt * (NR - 2 + (1 - a) / ($1 - a)); exit } {
	a = $1 }' "$work/a")" 3.68825386736 0.037
for cells in 16 32 64; do
	rate=$(run $cells 2 1e-4 | awk -v dt=$dt '{ a[NR] = $1 } END { i = int(NR / 2); c = (a[i+1] + a[i-1]) / (2 * a[i]); g = log(c + sqrt(c * c - 1));
		printf "%.17g", (exp(g / 2) - exp(-g / 2)) / dt }')
	is "growth rate, $cells cells: cos(k dx/2)" "$rate" "$(calc "cos(pi / $cells)")" 1e-4
done
finish
