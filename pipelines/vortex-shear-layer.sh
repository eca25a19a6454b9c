#!/usr/bin/env bash
# A thin double shear layer rolls up (rho = 80, delta = 0.05, nu = 1e-4, unit box, t = 1): a vortex method with too coarse a mesh or too low a kernel makes a vortex
# that is not there, in the braid between the two that are. One number tells: omega at (0, 1/4) is -26.070867 (VM-16).
# Law: vortex, lap psi = -omega, D omega/Dt = nu lap omega.
# Expected, of remeshed particles: m4prime -66, -55, -36 on 128^2, 256^2, 512^2 cells (a spurious vortex on all three), m6prime -60 on 128^2, -26.9 on
# 256^2, -26.07 on 512^2. PM_LONG=1 adds 256^2 and 512^2 with m4prime and 512^2 with m6prime (minutes).
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
# shellcheck source=pipelines/numbers.sh
. "$(dirname "$0")/numbers.sh"

# run CELLS KERNEL DT WANT TOLERANCE: omega in the braid, circulation; leaves $work/table.
run() {
	pinit shear-layer --cells "$1x$1" --nu 1e-4 --dt "$3" |
		cycle -t 1 "p2m --kernel $2 | poisson-fft | mgrad | diffuse | m2p | push lsrk3 | remesh --kernel $2" |
		p2m --kernel "$2" | poisson-fft >"$work/end"
	diag --exact <"$work/end" >"$work/table"
	is "$2 on $1^2: omega at (0, 1/4)" "$(stab --plain --mesh mesh <"$work/end" | awk '$1 == 0 && $2 == 0.25 { print $3 }')" "$4" "$5"
	is "$2 on $1^2: circulation" "$(column circulation last "$work/table")" 0 1e-12
}

# against NAME TOLERANCE: a column of the last run beside the exact one, relative.
against() { is "  $1 over the exact" "$(calc "$(column "$1" last "$work/table") / $(column "exact_$1" last "$work/table")")" 1 "$2"; }

run 128 m4prime 0.01 -65.98 1.5
run 128 m6prime 0.005 -60.65 1.5
run 256 m6prime 0.005 -26.070867 1
against energy 1e-3
against enstrophy 0.02
against omega_max 0.02
[ "${PM_LONG:-}" ] || finish
run 256 m4prime 0.005 -55.32 1.5
run 512 m4prime 0.0025 -35.73 1.5
run 512 m6prime 0.0025 -26.070867 0.1
against enstrophy 1e-3
finish
