#!/usr/bin/env bash
# Two bodies on a circle in open space on a mesh: 64^3 cells, 16 cells apart, one orbit of 200 steps; then the four mesh words swapped for pp.
# Law: gravity, lap phi = 4 pi G rho, G = M = a = 1, period 2 pi.
# Expected: after one period the pair is 1 apart, E = K + W = -1/8 by pairs, L_z = 1/4, no momentum. Leapfrog started on the exact circle lags
# by 2 pi (w dt)^2/3 = 0.002067 (its rate is 1/24 (w dt)^2 high, its orbit 1/4 wide). The mesh force at 16 cells adds 0.02 at most.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
# shellcheck source=pipelines/numbers.sh
. "$(dirname "$0")/numbers.sh"
cells=${CELLS:-64}
steps=200

pinit two-body --cells "$cells" >"$work/start"

# The relative position at the end: phase against the exact one, and separation.
places() {
	stab --plain |
		awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { x[NR] = $c["x"]; y[NR] = $c["y"] }
			END { dx = x[3] - x[2]; dy = y[3] - y[2]; printf "%.17g %.17g\n", atan2(-dy, -dx), sqrt(dx * dx + dy * dy) }'
}

report() {
	read -r phase apart <<<"$(places <"$work/end")"
	diag --pair <"$work/end" >"$work/table"
	is "phase after one period" "$phase" "$(calc "-2 * pi * (2 * pi / $steps) ^ 2 / 3")" "$1"
	is "separation" "$apart" 1 "$2"
	is "energy, kinetic and pair" "$(column energy last "$work/table")" -0.125 "$2"
	is "angular momentum" "$(column angular_momentum_z last "$work/table")" 0.25 "$3"
	is "momentum over its scale" "$(calc "$(column momentum_x last "$work/table") / $(column momentum_scale last "$work/table")")" 0 1e-12
}

cycle -n $steps 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' <"$work/start" >"$work/end"
echo "on the mesh, $cells cells"
report 0.025 0.004 0.0005

cycle -n $steps 'push kick/2 drift | pp | push kick/2' <"$work/start" >"$work/end"
echo "by direct summation"
report 1e-5 1e-6 1e-14
finish
