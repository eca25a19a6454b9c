#!/usr/bin/env bash
# The tables of docs/methods/kernels.md: W(x) as m2p gathers it from one node, 1000 points a cell, and from it
#   g(k) = integral W(x) cos(kx) dx,    A_s(k) = sum_j W(j + s) exp(ik(j + s)),    the factor of a wave in a remesh at the shift s; its mean over s is g.
# docs/kernels.sh [KERNEL ...] prints: kernel, g at 32, 16, 8, 4, 2 cells a wave, the orders of the zeros of 1 - g at 0 and of g at 2 pi; then at 16 and
# at 4 cells a wave the rms of A_s - g (sampling), the least |A_s|, the largest |A_s| - 1 where positive, the largest phase [rad].
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
export PATH=${PM_BIN:-$top/bin}:$PATH LC_ALL=C.UTF-8
[ $# -gt 0 ] || set -- ngp cic tsc lambda-2 pcs m4prime lambda-2-2 m6prime lambda-4-4 lambda-6-4 lambda-6-6 lambda-8-4
printf 'kernel\tg32\tg16\tg8\tg4\tg2\tzero\tzeros\tsampling16\tleast16\tphase16\tsampling4\tleast4\tphase4\n'
for kernel; do
	awk 'BEGIN { print "x"; for (i = 0; i < 5000; i++) printf "%.17g\n", 16 + (i + 0.5) / 1000 }' |
		stab - --box 0,32 -n 32 --faces periodic | scalc --mesh mesh 'delta = abs(x - 16) < 0.5' | m2p --kernel "$kernel" --field delta | stab --plain |
		awk -v kernel="$kernel" '
			function g(k, i, s) { for (i = 0; i < n; i++) s += W[i] * cos(k * (i + 0.5) / 1000); return 2 * s / 1000 }
			function slope(a, b) { return log(b / a) / log(2) }
			function size(x) { return x < 0 ? -x : x }
			function distortion(k, i, j, x, c, s, m, mean) { # even: points below 0 are those above
				rms = 0; least = 9; phase = 0; mean = g(k)
				for (i = 0; i < 1000; i++) {
					for (j = c = s = 0; j < 5; j++) {
						x = j + (i + 0.5) / 1000; c += W[1000 * j + i] * cos(k * x); s += W[1000 * j + i] * sin(k * x)
						x = j + (999.5 - i) / 1000; c += W[1000 * j + 999 - i] * cos(k * x); s -= W[1000 * j + 999 - i] * sin(k * x) }
					m = sqrt(c * c + s * s); rms += (c - mean)^2 + s * s; least = m < least ? m : least
					m = size(atan2(s, c)); phase = m > phase ? m : phase }
				rms = sqrt(rms / 1000) }
			NR > 1 { W[n++] = $NF }
			END { pi = atan2(0, -1); printf "%s", kernel
				for (cells = 32; cells > 1; cells /= 2) printf "\t%.5f", g(2 * pi / cells)
				printf "\t%.0f\t%.0f", slope(size(1 - g(0.6)), size(1 - g(1.2))), slope(size(g(2 * pi + 0.3)), size(g(2 * pi + 0.6)))
				distortion(pi / 8); printf "\t%.2e\t%.5f\t%.1e", rms, least, phase
				distortion(pi / 2); printf "\t%.2e\t%.5f\t%.1e\n", rms, least, phase }'
done
