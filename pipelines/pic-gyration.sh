#!/usr/bin/env bash
# An electron circles in a uniform magnetic field: the angle and the radius of Boris' steps, and the constancy of its speed.
# Law: electrostatic with a given B = 1 along z (Omega = 1) and E = 0, 2-D, push boris/2.
# Expected (PIC-12): a step turns by 2 atan(Omega dt/2): 0.0999167914438855, 0.489957326253728, pi/2 for Omega dt = 0.1, 0.5, 2, to 1e-13, on a
# circle of radius sqrt(1 + (Omega dt/2)^2): 1.00124921972504 at 0.1; |v| stays 1 to 1e-12 over 20000 steps (HC-08: 1e6 in tests/unit/boris.c).
# Words swapped: with the field of the electron itself, by any kernel, solver and gradient, it ends at the same place after 25 steps, to 1e-11, since no
# particle moves itself; and schemes without a magnetic force refuse it (exit 1).
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

# place SENTENCE: where it is after 25 steps of Omega dt = 0.5, from a frame on standard input.
place() { cycle -n 25 "$1" | diag --columns centre_x,centre_y >"$work/place"; }

pinit gyration --dt 0.5 | place "$step"
x=$(column centre_x last "$work/place") y=$(column centre_y last "$work/place")
echo "25 steps with its own field, one word swapped"
while IFS=: read -r name words; do
	pinit gyration --dt 0.5 | sel --drop E | place "push boris/2 drift | $words | m2p | push boris/2"
	is "x, $name" "$(column centre_x last "$work/place")" "$x" 1e-11
	is "y, $name" "$(column centre_y last "$work/place")" "$y" 1e-11
done <<-END
	cic, poisson-fft, order 2:p2m | poisson-fft | mgrad
	kernel tsc:p2m --kernel tsc | poisson-fft | mgrad
	poisson-mg:p2m | poisson-mg | mgrad
	gradient 4:p2m | poisson-fft | mgrad --order 4
END
for scheme in rk4 euler ab2; do
	status=0
	pinit gyration | m2p | push $scheme >"$work/refused" 2>"$work/message" || status=$?
	is "exit status of push $scheme" $status 1 0
done
finish
