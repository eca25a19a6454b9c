#!/usr/bin/env bash
# An electron circles in a uniform magnetic field: the angle and the radius of Boris' steps, and its speed for ever.
# Law: electrostatic with a given B = 1 along z (Omega = 1) and E = 0, 2-D, push boris/2.
# Expected (PIC-12): a step turns by 2 atan(Omega dt/2): 0.0999167914438855, 0.489957326253728, pi/2 for Omega dt = 0.1, 0.5, 2, to 1e-13, on a
# circle of radius sqrt(1 + (Omega dt/2)^2): 1.00124921972504 at 0.1; |v| stays 1 to 1e-12 over 20000 steps (HC-08: 1e6 in tests/unit/boris.c).
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
# shellcheck source=pipelines/numbers.sh
. "$(dirname "$0")/numbers.sh"
export OMP_NUM_THREADS=1 # one particle
step='push boris/2 drift | m2p | push boris/2'

# circle DT: "angle radius" of the first two steps, from the velocities (the momentum of mass 1) and three places.
circle() {
	pinit gyration --dt "$1" | cycle -n 2 --every 1 "$step" | diag --columns momentum_x,momentum_y,centre_x,centre_y |
		awk 'NR > 1 { a[NR] = atan2($2, $1); x[NR] = $3; y[NR] = $4 }
			END { p = sqrt((x[3]-x[2])^2 + (y[3]-y[2])^2); q = sqrt((x[4]-x[3])^2 + (y[4]-y[3])^2); r = sqrt((x[4]-x[2])^2 + (y[4]-y[2])^2)
				area = (x[3]-x[2]) * (y[4]-y[2]) - (x[4]-x[2]) * (y[3]-y[2])
				printf "%.17g %.17g\n", a[3] - a[2], p * q * r / (2 * area) }'
}

for case in "0.1 0.0999167914438855" "0.5 0.489957326253728" "2 1.5707963267948966"; do
	read -r dt angle <<<"$case"
	read -r turned radius <<<"$(circle "$dt")"
	echo "Omega dt = $dt"
	is "angle of a step" "$turned" "$angle" 1e-13
	is "radius" "$radius" "$(calc "sqrt(1 + $dt * $dt / 4)")" 1e-12
done

pinit gyration --dt 0.1 | cycle -n 20000 "$step" | diag >"$work/long"
echo "20000 steps"
is "kinetic energy" "$(column energy_kinetic last "$work/long")" 0.5 1e-12
finish
