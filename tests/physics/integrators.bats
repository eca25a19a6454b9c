# Orders and invariants of the integrators by the words, on two bodies with softening 0. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# miss SENTENCE STEPS: distance of the second body from the exact position after a quarter of an eccentric orbit, T = 2 pi.
miss() {
	pinit two-body --eccentricity 0.3 --dt "$(awk -v n="$2" 'BEGIN { printf "%.17g", atan2(0, -1) / 2 / n }')" |
		cycle -n "$2" "$1" | stab --plain |
		awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { x[NR] = $c["x"]; y[NR] = $c["y"] }
			END { # relative orbit from the apocentre: mean anomaly pi + t
				t = atan2(0, -1) / 2; f = 0; for (i = 0; i < 60; i++) f -= (f + 0.3 * sin(f) - t) / (1 + 0.3 * cos(f))
				ex = -cos(f) - 0.3; ey = -sqrt(1 - 0.09) * sin(f)
				dx = x[3] - x[2]; dy = y[3] - y[2]; if (dx * ex < 0) { dx = -dx; dy = -dy }
				printf "%.10g\n", sqrt((dx - ex)^2 + (dy - ey)^2) }'
}

# has_order CLAIM SENTENCE: from 40, 80, 160 steps.
has_order() {
	order "$1" 4 "$(miss "$2" 40)" 2 "$(miss "$2" 80)" 1 "$(miss "$2" 160)"
}

@test "TI-01: global orders of the integrators: leapfrog 2 (both ways round), euler 1, rk2 and midpoint 2, lsrk3 3, rk4 4, ab2 2, ab3 3" {
	has_order 2 'push kick/2 drift | pp | push kick/2'
	has_order 2 'push drift/2 | pp | push kick drift/2'
	has_order 1 'pp | push kick drift'
	has_order 1 'pp | push euler'
	has_order 2 'pp | push rk2'
	has_order 2 'pp | push midpoint'
	has_order 3 'pp | push lsrk3'
	has_order 4 'pp | push rk4'
	has_order 2 'pp | push ab2'
	has_order 3 'pp | push ab3'
}

@test "symmetric compositions: yoshida4 and blanes-moan4 have order 4, yoshida6 and blanes-moan6 order 6 on an eccentric orbit" {
	has_order 4 'pp | push yoshida4'
	has_order 4 'pp | push blanes-moan4'
	order 6 4 "$(miss 'pp | push yoshida6' 20)" 2 "$(miss 'pp | push yoshida6' 40)" 1 "$(miss 'pp | push yoshida6' 80)"
	order 6 4 "$(miss 'pp | push blanes-moan6' 4)" 2 "$(miss 'pp | push blanes-moan6' 8)" 1 "$(miss 'pp | push blanes-moan6' 16)"
}

# worst_energy SCHEME STEPS: largest |dE/E| at the end of 100 turns of an orbit of e = 0.6, STEPS steps a turn.
worst_energy() {
	pinit kepler --eccentricity 0.6 --dt "$(awk -v n="$2" 'BEGIN { printf "%.17g", 2 * atan2(0, -1) / n }')" |
		cycle -n $((100 * $2)) --every "$2" "pp --potential | push $1 --unsafe" | pp --potential | diag --columns energy |
		awk 'NR == 2 { e = $1 } NR > 2 { d = $1 / e - 1; d = d < 0 ? -d : d; if (d > m || d != d) m = d } END { print m }'
}

@test "at 160 forces a turn compositions keep the energy of an orbit of e = 0.6 for 100 turns, rk4 does not" {
	# Measured 0.0037, 0.011, 0.0070 and 73 (rk4 loses 1.8 % in the first turn and spirals in). The bounds are 1.4 to 1.6 of the measured values.
	below "$(worst_energy yoshida4 40)" 0.006
	below "$(worst_energy blanes-moan4 22)" 0.016
	below "$(worst_energy blanes-moan6 13)" 0.01
	above "$(worst_energy rk4 40)" 0.2
}

@test "a composition is reversible, and its steps are the same on processes" {
	pinit kepler --eccentricity 0.6 --dt 0.05 >a
	for s in yoshida4 yoshida6 blanes-moan4 blanes-moan6; do
		cycle -n 50 "pp | push $s" <a >b
		cycle -n 50 --engine pipes "pp | push $s" <a >c
		same_as b c
		cycle -n 50 "pp | push $s --dt -0.05" <b >c
		below "$(scmp --field x a c | column relative_l2)" 1e-11 # as leapfrog: 600 passes forth and back
	done
}

@test "a composition says what it cannot do: no velocity, a decay" {
	pinit point-vortices -n 3 >a
	pp <a >b
	run -1 push yoshida4 -i b -o c
	[[ $output = *"kicks velocities and moves by them, and 'vortices' has no 'v' (rk4, lsrk3 advance what moves by a flow)"* ]]
	pinit plummer -n 2 | field 'acc = -0.1 * vx, -0.1 * vy, -0.1 * vz' >b
	run -3 push yoshida4 -i b -o c
	[[ $output = *'has parts of a step that go backwards (rk4, lsrk3, or --unsafe)'* ]]
	push yoshida4 --unsafe <b >c
}

@test "leapfrog is reversible: 200 steps forward and 200 back with dt < 0 return to the start to round-off" {
	pinit plummer -n 100 > a
	cycle -n 200 "push kick/2 drift | pp --softening 0.1 | push kick/2" < a > b
	dt=$(stab < a | grep -o '"dt":[-+.e0-9]*' | cut -d: -f2)
	cycle -n 200 "push kick/2 drift --dt -$dt | pp --softening 0.1 | push kick/2" < b > c
	below "$(scmp --field x a c | column relative_l2)" 1e-11
}

@test "momentum of 500 stars under pp and leapfrog stays at round-off, energy error falls with dt^2" {
	pinit plummer -n 500 --dt 0.04 > a
	for k in 1 2 4; do
		cycle -n $((25 * k)) "push --dt $(awk -v k=$k 'BEGIN { print 0.04 / k }') kick/2 drift | pp | push kick/2" < a | pp --potential --replace |
			diag > "d$k"
	done
	pp --potential < a | diag > d0
	# 25 to 100 steps of 500 sums of 500 terms
	within "$(column momentum_x < d4)" "$(column momentum_x < d0)" "$(awk -v s="$(column momentum_scale < d0)" 'BEGIN { print 1e-12 * s }')"
	e0=$(column energy < d0)
	err() { awk -v a="$(column energy < "$1")" -v b="$e0" 'BEGIN { d = a - b; print d < 0 ? -d : d }'; }
	order 2 4 "$(err d1)" 2 "$(err d2)" 1 "$(err d4)"
}
