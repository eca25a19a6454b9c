#!/usr/bin/env bash
# A thin double shear layer rolls up (rho = 80, delta = 0.05, nu = 1e-4, unit box, t = 1): a vortex method with too coarse a mesh or a kernel of too low
# order produces a spurious vortex in the braid between the two real ones. One number shows it: omega at (0, 1/4) is -26.070867 (VM-16).
# Law: vortex, lap psi = -omega, D omega/Dt = nu lap omega.
# Expected, of particles remeshed every step: m4prime with dt = 0.01, 0.005, 0.005 on 128^2, 256^2, 512^2 cells -66, -55, -36 (a spurious vortex on all
# three; the number depends on the step, because every step remeshes), m6prime -60 on 128^2, on 256^2 within 1 of the exact -26.07, on 512^2 within 0.1;
# energy, enstrophy and the largest omega at t = 0.4, 0.8, 1 and samples of omega of a spectral code on 1024^2. PM_LONG=1 adds m4prime on 256^2, and
# 512^2 (minutes).
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
# shellcheck source=pipelines/numbers.sh
. "$(dirname "$0")/numbers.sh"

# omega X Y: at a node, of the last run.
omega() { awk -v x="$1" -v y="$2" '$1 == x && $2 == y { print $3 }' "$work/omega"; }

# run CELLS KERNEL DT WANT TOLERANCE: omega in the braid, circulation; leaves $work/table (t = 0.4, 0.8, 1) and $work/omega.
run() {
	pinit shear-layer --cells "$1x$1" --nu 1e-4 --dt "$3" |
		cycle -t 1 --every "$(calc "0.4 / $3")" "p2m --kernel $2 | poisson-fft | mgrad | diffuse | m2p | push lsrk3 | remesh --kernel $2" |
		p2m --kernel "$2" |
		poisson-fft >"$work/frames"
	sel --frames 2:4 <"$work/frames" | diag --exact >"$work/table"
	sel --frames 4 <"$work/frames" | stab --plain --mesh mesh >"$work/omega"
	is "$2 on $1^2: omega at (0, 1/4)" "$(omega 0 0.25)" "$4" "$5"
	is "$2 on $1^2: circulation" "$(column circulation last "$work/table")" 0 1e-13
}

# against NAME TOLERANCE: a column of the last run compared with the exact one at t = 0.4, 0.8, 1, relative.
against() {
	for row in 1 2 3; do
		is "  $1 over the exact, t = $(printf %.3g "$(column time $row "$work/table")")" "$(calc "$(column "$1" $row "$work/table") / $(column \
			"exact_$1" $row "$work/table")")" 1 "$2"
	done
}

# samples TOLERANCE: the largest difference to the spectral code at x = 0, 1/8 ... 7/8 of two lines.
samples() {
	while read -r y list; do
		i=0
		for want in $list; do
			calc "$(omega "$(calc "$i / 8")" "$y") - ($want)" && echo
			i=$((i + 1))
		done
	done <<-'END' | awk '{ d = $1 < 0 ? -$1 : $1; if (d > m) m = d; n++ } END { print n == 16 ? m : "nan" }' >"$work/most"
		0.25 -26.070867 0.29263065 0.10088914 -0.097124088 -58.564916 -0.097124088 0.10088914 0.29263065
		0.3125 0.057216891 0.120498 0.23063935 -21.156546 -28.134527 -5.7189294 0.049964597 0.310044
	END
	is "  omega at 16 places, largest difference" "$(cat "$work/most")" 0 "$1"
}

run 128 m4prime 0.01 -65.98 1.5
run 128 m6prime 0.005 -60.65 1.5
[ -z "${PM_LONG:-}" ] || run 256 m4prime 0.005 -55.32 1.5
run 256 m6prime 0.005 -26.070867 1
against energy 1e-4
against enstrophy 0.005
against omega_max 0.02
samples 1
[ "${PM_LONG:-}" ] || finish
run 512 m4prime 0.005 -35.73 1.5
run 512 m6prime 0.0025 -26.070867 0.1 # three times the error of 256^2, scaled by h^5
against energy 1e-5
against enstrophy 1e-3
against omega_max 2e-3
samples 0.1
finish
