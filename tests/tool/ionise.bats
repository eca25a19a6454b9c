# ionise: rates and chains against their equations, conservation, where it stands, keys, refusals. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# The frame has atomic units: E, time and energy in those of the rates. gas FIELD N OPTIONS: N atoms at rest in a given field, and no electrons.
units="--time-unit 2.4188843265864e-17 --length-unit 5.29177210544e-11"
argon="ionise argon --element Ar --mass 72820 $units"
gas() {
	pinit plasma --length 1 --cells 4 --background 0 --no-history | scalc --mesh mesh --role state "E = $1" --no-history |
		species argon -n "$2" --charge 0 --mass 72820 --velocities 3 --no-history "${@:3}" | species electrons -n 0 --velocities 3 --no-history
}
# how many of the $1 argon particles have the charge 0, 1, 2, 3 (in that of one electron); more than these: the fifth
stages() {
	stab --plain --set argon | awk -v n="$1" '/charge/ { for (k = 1; k <= NF; k++) c[$k] = k; next }
		NF { z = $c["charge"] * n + 0.5; s[z >= 4 ? 4 : int(z)]++ } END { print s[0]+0, s[1]+0, s[2]+0, s[3]+0, s[4]+0 }'
}

@test "the part of the atoms that is left falls as exp(-W t), for any step; both rates; the kernel's field" {
	gas 0.08 20000 >a
	# W of argon: 0.004213915494715 (tests/unit/tunnel-rate.c); t = 200; four standard errors of 20000
	for steps in 1 10; do
		read -r s0 s1 _ < <(smod --dt "$(calc "200/$steps")" a | cycle -q -n $steps "push drift | $argon" | stages 20000)
		within "$(calc "$s0/20000")" "$(calc 'exp(-0.004213915494715*200)')" 0.014
		within "$s1" "$(calc "20000 - $s0")" 20 # the next: 6.9e-7
	done
	# in a field of 0.2 the barrier is gone: 2.4 E^2/(2 I)^2 = 0.0715519606934, where the formula of tunnelling has 0.978
	for rate in adk-bsi=0.0715519606934 adk=0.977578631376; do
		read -r s0 _ < <(gas 0.2 20000 | smod --dt 1 | cycle -n 1 "push drift | $argon --method ${rate%=*}" 2>note | stages 20000)
		within "$(calc "$s0/20000")" "$(calc "exp(-${rate#*=})")" 0.014
		[ $rate = "${rate#adk=}" ] || grep -q 'the field is 2.16 times that from where the barrier is suppressed' note
	done
	# E = 0.16 x at the nodes, which cic interpolates: the mean of W is not that of the mean field
	pinit plasma --length 1 --cells 8 --background 0 | smod --faces neumann | scalc --mesh mesh --role state 'E = 0.16*x' |
		species argon -n 20000 --charge 0 --mass 72820 | species electrons -n 0 | smod --dt 20 | $argon >b
	awk 'BEGIN { I = 15.7596119/27.211386245981; k = sqrt(2*I); a = 2*k^3; n = 1/k; w8 = 0.004213915494715
		for (i = 0.5; i < 1000; i++) { E = 0.16*i/1000; r = w8*(0.08/E)^(2*n - 1)*exp(-a/3*(1/E - 1/0.08)); if (E > 0.09266)
			r = 2.4*E*E/k^4; s += exp(-20*r) }
		print s/1000 }' >want
	within "$(calc "$(stages 20000 <b | cut -d' ' -f1)/20000")" "$(cat want)" 0.014
}

@test "a chain of ionisations within one step and over twenty follows the rate equations; energy is that of the stages" {
	gas 0.2 20000 >a
	# a, b: barriers suppressed, 2.4 E^2/(2 I)^2; c: tunnelling; the next is 1.9e-7
	awk 'BEGIN { a = 0.07155196069344602; b = 0.023278831657845687; c = 0.004807347163357018; t = 100; A = exp(-a*t); B = exp(-b*t); C = exp(-c*t)
		p = A; q = a/(b - a)*(A - B); r = a*b*(A/((b - a)*(c - a)) + B/((a - b)*(c - b)) + C/((a - c)*(b - c))); print p, q, r, 1 - p - q - r }' >want
	read -r w0 w1 w2 w3 <want
	for steps in 1 20; do
		smod --dt "$(calc "100/$steps")" a | cycle -q -n $steps "push drift | $argon" >b
		read -r s0 s1 s2 s3 more < <(stages 20000 <b)
		below "$more" 3 # 0.03 expected
		for k in "$s0 $w0" "$s1 $w1" "$s2 $w2" "$s3 $w3"; do
			within "$(calc "${k% *}/20000")" "${k#* }" "$(calc "4*sqrt(${k#* }*(1 - ${k#* })/20000) + 1e-12")" # four standard errors
		done
		n=$((s1 + 2 * s2 + 3 * s3 + 4 * more))
		[ "$(sls b | awk '$2 == "electrons:" { print $3 }')" = $n ]
		[ "$(sls --report b | grep -o '"ionisations":[0-9]*' | cut -d: -f2)" = $n ]
		within "$(sls --report b | grep -o '"ionisation_energy":[0-9.e-]*' | cut -d: -f2)" \
			"$(calc "((20000 - $s0)*15.7596119 + ($s2 + $s3 + $more)*27.62967 + ($s3 + $more)*40.735 + $more*59.58)/27.211386245981/20000")" 1e-12
	done
	within "$(sls --report b | grep -o '"strongest_field":[0-9.e+]*' | cut -d: -f2)" "$(calc '0.2*5.14220675112e11')" 1e2 # V/m
}

@test "nitrogen in a pulse of light of 800 nm and 10 fs has the charges of the rate equations, step by step in the field of the moment" {
	# 0.2 exp(-(t/110)^2) cos(0.057 t), t from -250 to 250, in atomic units, at the middles of 400 steps. Rate equations by Runge-Kutta 4 in Python, 8000
	# steps and energies written down there: 0.00555 0.59986 0.39451 0.00009
	pinit plasma --length 1 --cells 4 --background 0 --no-history | species argon -n 20000 --charge 0 --mass 25532 |
		species electrons -n 0 | smod --dt 1.25 --no-history |
		cycle -q -n 400 "push drift | scalc --mesh mesh --role state 'E = 0.2*exp(-((time - 250.625)/110)^2)*cos(0.057*(time - 250.625))' |
			ionise argon --element N --mass 25532 $units" >b
	read -r s0 s1 s2 s3 more < <(stages 20000 <b)
	for k in "$s0 0.00555" "$s1 0.59986" "$s2 0.39451" "$s3 0.00009"; do
		within "$(calc "${k% *}/20000")" "${k#* }" "$(calc "4*sqrt(${k#* }*(1 - ${k#* })/20000)")" # four standard errors
	done
	[ "$more" = 0 ]
}

@test "charge, mass and momentum stay, electrons begin where their ions are and with their velocity, each id once; ions may begin charged" {
	gas 0.2 5000 --vth 0.3 --drift 0.1,0.2,0.3 >a
	diag --columns mass,charge,momentum_x,momentum_y,momentum_z --format tsv a | tail -1 >before
	smod --dt 100 a | $argon >b
	diag --columns mass,charge,momentum_x,momentum_y,momentum_z --format tsv b | tail -1 >after
	paste before after | awk '{ for (k = 1; k <= 5; k++) { d = $k - $(k + 5); if (d < 0) d = -d; if (d > 72820*1e-14 || (k == 2 && d > 1e-13)) exit 1 } }'
	for set in argon electrons; do
		stab --plain --set $set b | awk '/vx/ { for (k = 1; k <= NF; k++) c[$k] = k; next }
			{ print $c["x"], $c["vx"], $c["vy"], $c["vz"] }' | sort -u >$set
	done
	[ "$(comm -13 argon electrons | wc -l)" = 0 ]
	above "$(wc -l <electrons)" 4000
	for set in argon electrons; do stab --plain b --set $set | column id; done | sort | uniq -d >twice
	[ ! -s twice ]
	# Ar2+ has the mass of the atom less two electrons; in 0.3 it loses one or two more in this time (W 0.0241, 0.0016, then 6e-6)
	gas 0.3 1 | species ions -n 1000 --charge 2 --mass 72818 --velocities 3 | smod --dt 200 | ionise ions ${argon#ionise argon} >c
	stab --plain --set ions c | column charge | awk '{ z = $1 * 1000; w = int(z + 0.5); n[w]++; bad += (z - w)^2 > 1e-20 || w < 2 || w > 4 }
		END { exit bad || n[3] < 500 || n[4] < 100 }'
}

@test "electrons belong to seed, set, id and step: not to threads, ranks, the engine, the order, or where a run is interrupted" {
	gas 0.15 6000 --vth 0.3 | smod --dt 4 >a
	s="push drift | $argon"
	cycle -q --no-history -n 6 "$s" <a >b
	same_as b <(cycle -q --no-history -n 6 --threads 1 "$s" <a)
	same_as b <(cycle -q --no-history -n 6 --engine pipes "$s" <a)
	same_as b <(cycle -q --no-history -n 6 --ranks 3 "$s" <a)
	same_as b <(cycle -q --no-history -n 2 "$s" <a | cycle -q --no-history -n 4 "$s")
	same_as <(ssort --by id b | sel --set argon --field charge,id | stab --plain --set argon) \
		<(ssort --by id --reverse a | cycle -q -n 6 "$s" | ssort --by id | sel --set argon --field charge,id | stab --plain --set argon)
	cycle -q --no-history -n 6 "$s --seed 3" <a | cmp -s - b && return 1
	[ "$(sls b | awk '$2 == "electrons:" { print ($3 > 3000) }')" = 1 ]
}

@test "behind the drift with light: Gauss's law holds to round-off while atoms lose electrons; behind mgrad the density stays; each also as processes" {
	# light of 800 nm, whose frequency is 1: E in 4e12 V/m; the length follows from c. Electrons that are there make a charge to measure against.
	pinit em-wave --wave-field 0.02 | smod --constant background=0 | species electrons -n 900 --vth 0.1 --velocities 3 --loading random --profile 0.05 |
		species protons -n 300 --charge 1 --mass 1836 --velocities 3 --vth 1e-3 --profile 0.05 |
		species argon -n 400 --charge 0 --mass 72820 --velocities 3 --vth 0.01 --profile 0.01 |
		p2m | maxwell --gauss >a
	light="push boris/2 | p2m --current | maxwell | push drift | ionise argon --element Ar --mass 72820 --time-unit 4.246e-16 | m2p | push boris/2"
	cycle -q --no-history -n 60 "$light" <a >b
	above "$(sls b | awk '$2 == "electrons:" { print $3 }')" 1100
	# 0.02 of m c omega/e = 4.01e12 V/m, and the noise of the electrons
	within "$(sls --report b | grep -o '"strongest_field":[0-9.e+]*' | cut -d: -f2)" 8.3e10 0.7e10
	below "$(p2m b | diag --columns gauss_residual --format tsv | tail -1)" 1e-12 # of the largest rho; 7e-14 without ionise
	same_as b <(cycle -q --no-history -n 60 --engine pipes "$light" <a)
	# electrostatic: ions in the field of a sheet of charge
	pinit plasma --length 4 --cells 16 --background 0 --dt 0.1 | smod --faces wall --particle-faces reflect |
		species argon -n 2000 --charge 0 --mass 72820 --vth 0 | species electrons -n 0 >e
	force='p2m | poisson-fft --x-high 0.6 | mgrad'
	cycle -q --no-history -n 30 "push kick/2 drift | $force | $argon | m2p | push kick/2" <e >f
	above "$(sls f | awk '$2 == "electrons:" { print $3 }')" 200
	same_as f <(cycle -q --no-history -n 30 --engine pipes "push kick/2 drift | $force | $argon | m2p | push kick/2" <e)
}

@test "what is missing or wrong is said: element, units, mass, sets, places in the step, ions that are none" {
	gas 0.08 10 >a
	refused() {
		run --separate-stderr bash -o pipefail -c "$2 | sls"
		[[ $status = "$3" && $stderr == *"$1"* ]] || { echo "$2: $status $stderr"; return 1; }
	}
	refused 'atoms of which element? (--element, one of H He Li' "ionise argon --mass 1 --time-unit 1 <a" 2
	refused "there are no ionisation energies of 'Uuo'" "ionise argon --element Uuo --mass 1 --time-unit 1 <a" 2
	refused 'the mass of one neutral atom' "ionise argon --element Ar --time-unit 1 <a" 2
	refused "how long is the frame's unit of time?" "ionise argon --element Ar --mass 72820 <a" 2
	refused "how long is the frame's unit of length? (--length-unit METRES, or the constant c" "${argon% --length*} <a" 1
	refused 'light has the speed 137.036, and the frame'\''s c is 1 (leave out --length-unit)' "smod --constant c=1 a | $argon" 2
	refused 'an electron of the charge 1' "$argon --electron-charge 1 <a" 2
	refused "no set 'helium' (species helium --charge 0 makes atoms)" "ionise helium --element He --mass 1 $units <a" 1
	refused "no set 'e' of electrons with 3 components of v (species e -n 0 --velocities 3)" "$argon --electrons e <a" 1
	refused 'behind the drift' "cycle -n 1 'push kick/2 | $argon | push drift | m2p | push kick/2' <a" 1
	refused "put ionise in front of m2p" "cycle -n 1 'push kick/2 drift | m2p | $argon | push kick/2' <a" 1
	refused "particle 0 of 'argon' is no ion of Ar: an atom of the mass 72820 that has lost Z electrons has the mass 72820 - Z 1 and the charge Z 1" \
		"scalc --set argon 'charge = mass*0.3/72820' <a | $argon" 1
	refused 'is no ion of Ar' "scalc --set argon 'charge = mass*19/72820' <a | $argon" 1
	refused "the law 'gravity' has no electric field" "smod --law gravity a | $argon" 1
	refused "no field 'E' on mesh 'mesh'" "sel --drop E a | $argon" 1
	refused 'the time step is 0' "smod --dt 0 a | $argon" 1
}
