#!/usr/bin/env bash
# A vortex spreads by viscosity in open space, t = 1 to 4, Gamma = 1, nu = 0.01: remeshed particles on 120^2 cells (h = sqrt(4 nu t)/6 at the start).
# Law: vortex, lap psi = -omega, D omega/Dt = nu lap omega.
# Expected (VM-01): omega = Gamma/(4 pi nu t) exp(-r^2/(4 nu t)), u_theta = Gamma/(2 pi r) (1 - exp(-r^2/(4 nu t))): at t = 1, r = 0.2 2.92749157621596
# and 0.503025557837881, at t = 4, r = 0.5 0.417008604918078 and 0.251588509396898; u_theta is largest at 1.1209
# sqrt(4 nu t), 0.10157 Gamma/sqrt(4 nu t). Circulation is conserved to 3e-8, not to the last digit: remesh removes the smallest strengths, and circulation
# that diffuses beyond its rim of two cells is lost (2.8e-5 without the rim). Both are reported and printed here.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
# shellcheck source=pipelines/numbers.sh
. "$(dirname "$0")/numbers.sh"

pinit lamb-oseen --cells 120 >"$work/start"
cycle -t 4 'p2m --kernel m6prime | poisson-fft | mgrad | diffuse | m2p | push lsrk3 | remesh --kernel m6prime --cut-off 1e-8 --rim 2' <"$work/start" \
	>"$work/end"

for f in start end; do
	p2m --kernel m6prime <"$work/$f" | poisson-fft | mgrad | tee "$work/$f.solved" | stab --plain --mesh mesh >"$work/$f.text"
	diag --exact <"$work/$f.solved" >"$work/$f.table"
done

# at FILE X NAME: a column of the mesh at (X, 0).
at() {
	awk -v x="$2" -v n="$3" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == n) c = i; next } ($1 - x) ^ 2 + $2 ^ 2 < 1e-16 { print $c }' "$work/$1.text"
}

# fastest FILE: place and value of the maximum of u_theta along x > 0, by a parabola through the largest value and its neighbours.
fastest() {
	awk 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "u_1") c = i; next } $1 > 0 && $2 ^ 2 < 1e-16 { n++; x[n] = $1; u[n] = $c; if (u[n] > u[k]) k = n }
		END { a = u[k + 1] - u[k - 1]; b = u[k + 1] - 2 * u[k] + u[k - 1]; printf "%.17g %.17g\n", x[k] - a / b / 2 * (x[k + 1] - x[k]),
			u[k] - a * a / b / 8 }' "$work/$1.text"
}

is "omega at t = 1, r = 0.2" "$(at start 0.2 omega)" 2.92749157621596 1e-12
is "u_theta at t = 1, r = 0.2" "$(at start 0.2 u_1)" 0.503025557837881 5e-4
is "omega at t = 4, r = 0.5" "$(at end 0.5 omega)" 0.417008604918078 4e-4
is "u_theta at t = 4, r = 0.5" "$(at end 0.5 u_1)" 0.251588509396898 2.5e-4
for f in start:0.2 end:0.4; do # sqrt(4 nu t)
	read -r radius speed <<<"$(fastest "${f%:*}")"
	is "${f%:*}: r_max over sqrt(4 nu t)" "$(calc "$radius / ${f#*:}")" 1.12090642277853 0.0112
	is "${f%:*}: u_max sqrt(4 nu t)" "$(calc "$speed * ${f#*:}")" 0.101568337577078 2e-4
done
is "circulation at t = 4" "$(column circulation last "$work/end.table")" 1 1e-7
is "  of that, cut off by remesh" "$(sls --format json --report <"$work/end" | grep -o '"lost_circulation":[-+.e0-9]*' | cut -d: -f2)" 0 1e-8
is "  lost by diffusion, rate at the end" "$(sls --format json --report <"$work/end" | grep -o '"lost_dcirculation":[-+.e0-9]*' | cut -d: -f2)" 0 1e-7
for name in angular_impulse enstrophy omega_max palinstrophy; do
	want=$(column "exact_$name" last "$work/end.table")
	is "$name at t = 4" "$(column "$name" last "$work/end.table")" "$want" "$(calc "1e-3 * sqrt(($want) ^ 2)")"
done
is "impulse_x at t = 4" "$(column impulse_x last "$work/end.table")" 0 1e-12
is "impulse_y at t = 4" "$(column impulse_y last "$work/end.table")" 0 1e-12
finish
