# circuit: R, L and C around a plasma. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

diode() { pinit plasma --background 0 "$@" | smod --faces neumann,wall --particle-faces absorb --constant charge_x_low=0 | species electrons -n 0; }
reported() { sls --report "$1" | grep -o "\"$2\":[-0-9.e+]*" | cut -d: -f2; }

@test "an empty gap with R, L and C follows the equation of the circuit, at order 2, from either side" {
	# 3 I' + 6 I + 2 q + 4 q = sin t from rest at t = 8: scipy's solve_ivp to 1e-10; the potential is 4 q
	for side in low high; do
		list=
		for n in 40 80 160; do
			faces=neumann,wall
			[ $side = low ] || faces=wall,neumann
			pinit plasma --background 0 --length 4 --dt "$(calc 8/$n)" | smod --faces $faces --constant charge_x_$side=0 |
				species electrons -n 0 | cycle -q -n $n "push drift --open | circuit --at x-$side --voltage 'sin(time)' -R 6 -L 3 -C 0.5 |
					field 'acc = 0' | push kick" >a
			list="$list $(calc 8/$n) $(awk -v p="$(reported a potential)" 'BEGIN { e = p - 0.34149135662; print e < 0 ? -e : e }')"
		done
		order 2 $list
	done
}

@test "a wire holds the electrode at its voltage, with particles and a background; a current fills the gap; the sum of all charges stays" {
	s='push kick/2 drift | inject electrons --density 0.1 -n 50'
	f='p2m | poisson-fft --x-low charge_x_low/eps0 | mgrad | m2p | push kick/2'
	diode | smod --constant background=0.03 >a
	cycle -q -n 40 "$s | circuit --voltage '3*cos(time)' | $f" <a >b
	within "$(stab --plain --mesh mesh b | column phi | head -1)" "$(calc '3*cos(4)')" 1e-12
	below "$(sls b | grep -o 'charge_x_low [-0-9.e]*' | cut -d' ' -f2 | awk -v q="$(diag b --columns charge | tail -1)" -v w="$(reported b charge)" \
		-v out="$(reported b absorbed_charge)" '{ print $1 - w + q + out }')" 1e-9 # the constant is printed with 10 digits
	diode | cycle -q -n 40 "$s | circuit --current-source -0.02 | $f" >b
	within "$(reported b charge)" -0.08 1e-15
	# R alone, in the steady state: V = phi + R I
	diode | cycle -q -n 40 "$s | circuit --voltage -5 -R 10 | $f" >b
	within "$(awk -v p="$(reported b potential)" -v i="$(reported b current)" 'BEGIN { print p + 10 * i }')" -5 1e-12
}

@test "a run that is interrupted goes on with the same bytes; the word acts once a step" {
	s="push kick/2 drift | inject electrons --density 0.1 -n 50 | circuit --voltage 'sin(time)' -R 2 -L 0.3 -C 4 | p2m |
		poisson-fft --x-low charge_x_low/eps0 | mgrad | m2p | push kick/2"
	diode --no-history >a
	cycle -q --no-history -n 30 "$s" <a >b
	same_as b <(cycle -q --no-history -n 11 "$s" <a | cycle -q --no-history -n 19 "$s")
	same_as b <(cycle -q --no-history -n 30 --engine pipes "$s" <a)
	circuit --voltage 9 <b --no-history | cmp - b # between steps
}

@test "a diode limited by its space charge carries the current of Child and Langmuir, with the correction for a warm cathode" {
	diode --length 1 --cells 128 | smod --dt 0.004 | cycle -q -t 2.4 --every 5 'push kick/2 drift | inject electrons --influx 20 --vth 0.1 -w 2e-3 |
		circuit --voltage -8 | p2m | poisson-fft --x-low charge_x_low/eps0 | mgrad | m2p | push kick/2' >a
	# 4/9 sqrt(2) V^1.5 (1 + 2.66/sqrt(V/T)): the first term of Langmuir's series, the next is of 1 %; a transit takes 0.75
	within "$(reported a current | awk 'NR > 40 { n++; s += $1 } END { print s / n }')" -15.56 0.3
}

@test "frames without an electrode that is known by its charge are refused" {
	refused() {
		run --separate-stderr bash -o pipefail -c "$2 | sls"
		[[ $status = "$3" && $stderr == *"$1"* ]] || { echo "$2: $status $stderr"; return 1; }
	}
	refused 'the face x-low is no electrode (smod --constant charge_x_low=0)' 'pinit plasma | circuit' 1
	refused 'opposite a wall (smod --faces neumann,wall' 'pinit plasma | smod --constant charge_x_low=0 | circuit' 1
	refused 'a circuit belongs to a plasma in 1-D' 'pinit plasma --dim 2 | circuit' 1
	refused '--current-source is all that passes' 'pinit plasma | circuit --current-source 1 -R 2' 2
}
