#!/usr/bin/env bash
# An electron drifts across uniform fields at E x B/B^2, exactly on average over a gyration, for any time step.
# Law: electrostatic with given B = 1 along z and E = 0.1 along y, 2-D, push boris/2; Omega dt/2 = tan(pi/N), so that N steps are a gyration.
# Expected (PIC-12): displacement (E/B) N dt along x and 0 along y after a gyration, to 1e-13, at rest in the drift or gyrating at speed 1; and in
# the steady drift the velocity at whole steps is sqrt(1 + (Omega dt/2)^2) E/B.
# Words swapped: the field of the electron itself on a second mesh, by any kernel, solver and gradient, changes nothing (1e-13), since no particle moves itself.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
# shellcheck source=pipelines/numbers.sh
. "$(dirname "$0")/numbers.sh"
export OMP_NUM_THREADS=1 # one particle
step='push boris/2 drift | m2p | push boris/2'

for case in "4 0" "8 0" "50 0" "8 1" "50 1"; do
	read -r n speed <<<"$case"
	dt=$(calc "2 * sin(pi / $n) / cos(pi / $n)")
	pinit exb --dt "$dt" --speed "$speed" | cycle -n "$n" --every "$n" "$step" | diag >"$work/table"
	echo "$n steps a gyration, gyrating at $speed"
	is "drift along x" "$(calc "($(column centre_x last "$work/table") - $(column centre_x 1 "$work/table")) / ($n * $dt)")" 0.1 1e-13
	is "drift along y" "$(calc "($(column centre_y last "$work/table") - $(column centre_y 1 "$work/table")) / ($n * $dt)")" 0 1e-13
done

# Started with the velocity of the steady drift, it does not gyrate.
echo "the steady drift at Omega dt = 1"
pinit exb --dt 1 | scalc 'v = vx * sqrt(1.25), vy' | cycle -n 20 --every 1 "$step" | diag >"$work/steady"
is "momentum along x" "$(column momentum_x last "$work/steady")" "$(calc "0.1 * sqrt(1.25)")" 1e-14
is "momentum along y" "$(column momentum_y last "$work/steady")" 0 1e-14

echo "8 steps, gyrating, with its own field added to the given ones, one word swapped"
while IFS=: read -r name words; do
	pinit exb --dt "$(calc "2 * sin(pi / 8) / cos(pi / 8)")" --speed 1 | smod --rename mesh=given |
		cycle -n 8 --every 8 "push boris/2 drift | $words | m2p --mesh own | m2p --mesh given | push boris/2" | diag >"$work/table"
	is "drift along x, $name" "$(calc "($(column centre_x last "$work/table") - $(column centre_x 1 "$work/table")) / (16 * sin(pi / 8) / cos(pi / 8))")" \
		0.1 1e-13
done <<-END
	cic, poisson-fft, order 2:p2m --mesh own -n 16 | poisson-fft --mesh own | mgrad --mesh own
	kernel tsc:p2m --mesh own -n 16 --kernel tsc | poisson-fft --mesh own | mgrad --mesh own
	poisson-mg:p2m --mesh own -n 16 | poisson-mg --mesh own | mgrad --mesh own
	gradient 4:p2m --mesh own -n 16 | poisson-fft --mesh own | mgrad --mesh own --order 4
END
finish
