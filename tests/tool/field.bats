# field: rates of change from expressions: terms, sets, refusals. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

table() { stab --plain; }
# one VALUES [options of stab]: one particle of x y, and its numbers.
one() { local v=$1; shift; printf 'x y a b\n%s\n' "$v" | stab - --law free --dt 0.125 "$@"; }

@test "acc, vel and d<state> have the values of the expression, belong to the right state, and are the term external" {
	pinit plummer -n 50 >a
	field 'acc = -2*x, y - vx, time + 3' <a >b
	paste <(table <a | tail -n +2) <(scalc 'acc = -2*x, y - vx, time + 3' <a | table | awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } {
		print $c["acc_0"], $c["acc_1"], $c["acc_2"] }') >want
	table <b | awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { print $c["acc_0"], $c["acc_1"], $c["acc_2"] }' >got
	[ "$(wc -l <got)" = 50 ]
	awk '{ print $(NF-2), $(NF-1), $NF }' want | diff - got
	sls <b >list
	grep -qE 'acc +3 f64 change value of v terms external' list
	one '1 2 3 4' | field --term flow 'vel = -y, x' | sls >list
	grep -qE 'vel +2 f64 change value of x terms flow' list
	pinit polygon -n 3 | field 'dcirculation = -0.5*circulation' | sls >list
	grep -qE 'dcirculation +1 f64 change.* of circulation terms external' list
}

@test "it adds to an existing change, in either order, and twice only under two terms or with --replace" {
	pinit plummer -n 40 >a
	pp <a | field 'acc = x, 2*y, z' >b
	field 'acc = x, 2*y, z' <a | pp >c
	scmp --field acc --tolerance 1e-15 b c
	if pp <a | scmp --field acc --tolerance 0.1 b - >/dev/null; then return 1; fi
	run -1 bash -c 'field "acc = x, y, z" <a | field "acc = x, y, z" | sls'
	[[ $output == *"already holds the term 'external'"* ]]
	field 'acc = x, y, z' <a | field --term more 'acc = -x, -y, -z' | table | awk 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^acc/) c[i] } NR > 1 {
		for (i in c) if ($i != 0) exit 1 }'
	field 'acc = x, y, z' <a | field --replace 'acc = 3*x, 0, 0' >d
	field 'acc = 3*x, 0, 0' <a | scmp --field acc --tolerance 0 d -
}

@test "a spring under leapfrog keeps v^2 + x^2 (1 - dt^2/4) to round-off (C9)" {
	printf 'x vx\n1 0\n' | stab - --law free --dt 0.4 | cycle -n 1000 --every 1 "push kick/2 drift | field 'acc = -x' | push kick/2" |
		scalc 'h = vx^2 + x^2*(1 - 0.04)' | table | awk '$1 == "x" { for (i = 1; i <= NF; i++) if ($i == "h") c = i; next } NF { d = $c - 0.96;
			if (d < 0) d = -d; if (d > m) m = d; n++ }
			END { print n, m; exit !(n == 1001 && m < 1e-12) }' # 3000 roundings of 1e-16, without drift
}

@test "an expression of the time uses the time of the pass: orders 1, 2, 4 for x' = cos t" {
	for case in euler:1 rk2:2 rk4:4; do
		points=()
		for n in 10 20 40; do
			x=$(echo 'x 0' | tr ' ' '\n' | stab - --law free --dt "$(awk -v n=$n 'BEGIN { print 2 / n }')" |
				cycle -n $n "field 'vel = cos(time)' | push ${case%:*}" | table | tail -n 1)
			points+=("$(awk -v n=$n 'BEGIN { print 1 / n }')" "$(awk -v x="$x" 'BEGIN { d = x - sin(2); print d < 0 ? -d : d }')")
		done
		order "${case#*:}" "${points[@]}"
	done
}

@test "a friction is of first order under leapfrog, of second under rk2" {
	for case in "1|push kick/2 drift | F | push kick/2" "2|F | push rk2"; do
		s=${case#*|} points=()
		for n in 10 20 40; do
			v=$(printf 'x vx\n0 1\n' | stab - --law free --dt "$(awk -v n=$n 'BEGIN { print 2 / n }')" |
				cycle -n $n "${s/F/field \'acc = -vx\'}" | table | tr ' ' '\t' | column vx)
			points+=("$(awk -v n=$n 'BEGIN { print 1 / n }')" "$(awk -v v="$v" 'BEGIN { d = v - exp(-2); print d < 0 ? -d : d }')")
		done
		order "${case%%|*}" "${points[@]}" 2>said
		[ "${case%%|*}" = 2 ] || awk '{ exit !($3 < 1.1) }' said
	done
}

@test "the test equation: one step of rk4 is 1 + z + z^2/2 + z^3/6 + z^4/24 for every lambda of the set" {
	printf 'x y a b\n1 0 -1 2\n1 0 3 0\n0.5 0 0 -8\n' | stab - --law free --dt 0.125 | cycle -n 1 "field 'vel = a*x - b*y, b*x + a*y' | push rk4" | table >b
	awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
		{ p = $c["a"] / 8; q = $c["b"] / 8; x = 1; y = 0; u = 1; w = 0; for (k = 1; k <= 4; k++) { t = (u * p - w * q) / k; w = (u * q + w * p) / k;
			u = t; x += u; y += w }
			f = NR == 4 ? 0.5 : 1; d = ($c["x"] - f * x)^2 + ($c["y"] - f * y)^2; if (d > 1e-30) { print; exit 1 } }' b
}

@test "each of several sets gets the rates of its own states, --set names one" {
	pinit plummer -n 4 >matter
	printf 'x y z\n1 2 3\n' | stab - --set tracers --law gravity --dt 1 --box -9,9 >tracers
	stack matter tracers >both
	field 'vel = 1, 2, 3' 'acc = 0, 0, 1' <both | sls >list
	[ "$(grep -cE 'vel +3 f64 change' list)" = 1 ]
	[ "$(grep -cE 'acc +3 f64 change' list)" = 1 ]
	run -1 bash -c "field --set matter 'vel = 1, 2, 3' <both | sls"
	[[ $output == *"'vel' moves nothing: no such set has the state 'x' without a velocity v (acc is the rate"* ]]
	run -1 bash -c "field --set nobody 'vel = 1, 2, 3' <both | sls"
	[[ $output == *"no set 'nobody'"* ]]
}

@test "a target that is not a rate is refused with a remedy" {
	pinit plummer -n 4 >a
	refused() { run -"$1" bash -c "$2 <a | sls"; [[ ${lines[0]} == *"$3"* ]] || { echo "$2: ${lines[0]}"; return 1; }; }
	refused 2 "field 'speed = x'" "'speed' is no rate of change (acc of v, vel of x"
	refused 2 "field 'dv = x, y, z'" "is no rate of change"
	refused 2 "field 'acc'" "is not NAME = EXPRESSION"
	refused 1 "field 'acc = x'" "'v' on 'matter' has 3 components, and 'acc' here 1"
	refused 1 "field 'dcharge = 1'" "'dcharge' moves nothing: no set has the state 'charge'"
	refused 1 "field 'vel = x, y, z'" "without a velocity v"
	refused 1 "field 'acc = x, y, w'" "no field or number 'w'"
	pp <a >f
	run -1 bash -c "field 'acc = -accx, 0, 0' <f | sls"
	[[ ${lines[0]} == *"'acc' is what is added to, and cannot be read"* ]]
	run -1 bash -c "field 'did = 1' <a | sls"
	[[ ${lines[0]} == *"holds whole numbers"* || ${lines[0]} == *"no set has the state 'id'"* ]]
	run -3 bash -c "field 'acc = 1/(x-x), 0, 0' <a | sls"
	[[ $output == *"not finite"* ]]
}

@test "cycle primes it, and the set without v needs no priming" {
	pinit plummer -n 30 >a
	cycle -n 2 "push kick/2 drift | field 'acc = -x, -y, -z' | push kick/2" <a >b
	field 'acc = -x, -y, -z' <a | cycle -n 2 "push kick/2 drift | field 'acc = -x, -y, -z' | push kick/2" >c
	scmp --tolerance 0 b c
}

@test "bfield: a uniform field is that of a mesh, a gradient makes charges drift, a mirror keeps those outside its loss cone" {
	pinit exb --dim 2 -n 5 --speed 0.3 --no-history >a
	sel --drop E,B a | cycle -q -n 30 "push boris/2 drift | field 'acc = 0, -0.1' 'bfield = 0, 0, 1' | push boris/2" | sel --field x | stab --plain >b
	same_as <(cycle -q -n 30 'push boris/2 drift | m2p | push boris/2' <a | sel --field x | stab --plain) b
	printf 'x y vx vy mass charge\n0 0 0 0.1 1 1\n' | stab - --law electrostatic --box=-9,9 --dt 0.05 | cycle -q -t 125.66370614359172 \
		"push boris/2 drift | field 'acc = 0, 0' 'bfield = 0, 0, 1 + 0.02*x' | push boris/2" | scalc 'centre = y - vx/(1 + 0.02*x)' | stab --plain |
		awk '/vx/ { for (k = 1; k <= NF; k++) if ($k == "centre") c = k; next } { print $c }' >y
	within "$(cat y)" "$(calc '0.01*0.02/2*40*pi')" 1.3e-4 # the next order is a part (0.02 0.1)^2; of the step 0.05^2/12: 1 % is allowed
	pinit uniform --dim 3 -n 4000 --dispersion 1 | smod --law electrostatic --box=-1,1 --faces open --particle-faces absorb --dt 0.2 |
		scalc --extensive 'charge = mass' | scalc 'x = 0, 0, 0' | scalc --role state 'w = 0.02/sqrt(vx^2 + vy^2 + vz^2)' 'across = 1 - (vz*w/0.02)^2' |
		scalc 'v = vx*w, vy*w, vz*w' |
		cycle -q -t 300 "push boris/2 drift | field 'acc = 0, 0, 0' 'bfield = -x*z, -y*z, 1 + z^2' | push boris/2" >b
	within "$(sls b | awk '$2 == "matter:" { print $3 }')" 2828 90 # sqrt(1 - 1/2) of all, three standard errors
	stab --plain b |
		awk '/vx/ { for (k = 1; k <= NF; k++) if ($k == "across") c = k; next } least == "" || $c < least { least = $c } END { print least }' >least
	above "$(cat least)" 0.498 # the circle is 0.02 wide
	run -1 --separate-stderr bash -o pipefail -c "field 'bfield = 0, 1' <a | sls"
	[[ $stderr == *'a magnetic field has 3 components'* ]]
}

# charges VALUES: charges of 1 and mass 1, lines of x y z vx vy vz.
charges() { printf "x y z vx vy vz charge mass\n$1" | stab - --law electrostatic --constant c=1 --box=-200,200 --dt "$2"; }

@test "bfield: a quadrupole focuses along x and not along y, a dipole turns guiding centres about its axis" {
	charges '0.1 0 0 0 0 1 1 1\n0 0.01 0 0 0 1 1 1\n' 0.05 |
		cycle -q -n 100 "push boris/2 drift | field 'acc = 0, 0, 0' 'bfield = 0.25*y, 0.25*x, 0' | push boris/2" | stab --format tsv >b
	within "$(column x <b | sed -n 1p)" "$(calc '0.1*cos(2.5)')" 1e-4 # vz falls by vx^2/2 = 1.3e-3 at most
	within "$(column y <b | sed -n 2p)" "$(calc '0.01*(exp(2.5)+exp(-2.5))/2')" 6e-5
	# 3 v^2 r^2/2 at the guiding centre r = 0.98: an angle of 3 v^2 r t/2, to a part of order v/r; r + v x B/B^2 is the centre to v^2
	charges '1 0 0 0 0.02 0 1 1\n' 0.05 | cycle -q -n 2500 "push boris/2 drift | field 'acc = 0, 0, 0' 'bfield = 3*x*z/(x^2+y^2+z^2)^2.5,
		3*y*z/(x^2+y^2+z^2)^2.5, (2*z^2-x^2-y^2)/(x^2+y^2+z^2)^2.5' | push boris/2" | scalc 'b = -(x^2+y^2)^-1.5' |
		scalc 'angle = atan2(y - vx/b, x + vy/b)' | stab --format tsv >b
	within "$(column angle <b)" "$(calc '1.5*0.02^2*0.98*125')" 0.0015
}

@test "field: a charge in a plane wave keeps gamma (1 - vx) and its canonical momentum, to second order in the step" {
	for n in 250 500 1000; do
		charges '0 0 0 0 0 0 1 1\n' "$(calc 10/$n)" | cycle -q -n $n "push higuera-cary/2 drift | field 'acc = 0, 2*charge/mass*cos(x-time), 0' \
			'bfield = 0, 0, 2*cos(x-time)' | push higuera-cary/2" | scalc 'g = 1/sqrt(1 - vx^2 - vy^2)' |
			scalc 'light = g*(1 - vx) - 1' 'canonical = g*vy + 2*sin(x - time)' | stab --format tsv >b
		light[n]=$(column light <b | sed 's/^-//') canonical[n]=$(column canonical <b | sed 's/^-//')
	done
	order 2 4 "${light[250]}" 2 "${light[500]}" 1 "${light[1000]}"
	order 2 4 "${canonical[250]}" 2 "${canonical[500]}" 1 "${canonical[1000]}"
}

@test "bfield: a charge in a mirror oscillates at sqrt(2 mu) and keeps its magnetic moment" {
	# B = 1 + z^2 on the axis, mu = vy^2/(2 B) = 2e-4: z'' = -2 mu z; over two periods. The orbit is 0.02 wide: corrections of 0.02^2
	charges '0 0 0 0 0.02 0.01 1 1\n' 0.1 | cycle -q -n 6280 --every 10 "push boris/2 drift | field 'acc = 0, 0, 0' 'bfield = -x*z, -y*z, 1 + z^2' |
		push boris/2" | scalc 'bx = -x*z' 'by = -y*z' 'bz = 1 + z^2' 'along = (vx*bx + vy*by + vz*bz)/hypot(bx, by, bz)' \
		'mu = (vx^2 + vy^2 + vz^2 - along^2)/2/hypot(bx, by, bz)' |
		sel --field mu,x --no-history | stab --plain | awk '/mu/ { for (k = 1; k <= NF; k++) c[$k] = k; next } NF { print $c["z"] "\t" $c["mu"] }' >t
	awk -F'\t' '{ d = $1 - 0.5*sin(0.02*(NR - 1)); d = d < 0 ? -d : d; if (d > z) z = d; m = $2/2e-4 - 1; m = m < 0 ? -m : m; if (m > mu) mu = m }
		END { print z, mu, NR }' t >most
	read -r z mu n <most
	[ "$n" = 629 ]
	below "$z" 0.002 # of 0.5; measured 8e-4
	below "$mu" 0.001 # measured 4e-4 = 0.02^2
}

# given FIELDS: a frame with these on a mesh of 32^3 cells (or as `cells` says) in the box -2..2, its faces open.
given() { printf 'x y z\n0 0 0\n' | stab - --law electrostatic --box=-2,2 --faces open -n "${cells:-32}" | scalc --mesh mesh --role state "$@"; }

@test "field --file: a field that is linear in space is that of its expression, a mirror to the second order of the cell" {
	given 'B = 0.25*y, 0.25*x, 0' 'E = 0.1*z, 0.2, -0.1*x' >g
	charges '0.1 0 0 0 0.1 0.2 1 1\n0 0.01 0.3 0.1 0 0.2 -2 1\n' 0.05 >a
	cycle -q -n 50 "push boris/2 drift | field --file g | push boris/2" <a >b
	cycle -q -n 50 "push boris/2 drift | field 'acc = charge/mass*0.1*z, charge/mass*0.2, -charge/mass*0.1*x' 'bfield = 0.25*y, 0.25*x, 0' |
		push boris/2" <a >c
	scmp --field x --tolerance 1e-13 b c
	scmp --field v --tolerance 1e-12 b c
	for n in 8 16 32; do # cic: h^2/8 of the second derivative, 2
		cells=$n given 'B = -x*z, -y*z, 1 + z^2' >g
		charges '0.013 0.031 0.29 0 0.02 0.01 1 1\n' 0.1 | field --file g | stab --format tsv | column bfield_2 >"b$n"
	done
	order 2 4 "$(calc "$(cat b8) - 1.0841")" 2 "$(calc "$(cat b16) - 1.0841")" 1 "$(calc "$(cat b32) - 1.0841")"
}

@test "field --file: refusals, a line each" {
	given 'B = 0, 0, 1' >g
	given 'w = 0, 0, 1' >w
	charges '0.1 0 0 0 0.1 0.2 1 1\n' 0.05 >a
	refused() { run -"$1" --separate-stderr bash -o pipefail -c "$2 <a | sls"; [[ $stderr == *"$3"* ]] || { echo "$2: $stderr"; return 1; }; }
	refused 2 "field" "field needs rates of change, or --file"
	refused 2 "field --file g 'acc = 0, 0, 0'" "of both a word each"
	refused 2 "field --kernel tsc 'acc = 0, 0, 0'" "--kernel belongs to --file"
	refused 2 "field --file -" "--file reads a file of its own"
	refused 1 "field --file nothing" "nothing"
	refused 1 "field --file w" "w: no mesh has the law's field 'E', nor a magnetic one"
	smove --shift 2,0,0 <a >far
	field --file g <a >once
	refused 1 "field --file g -i far" "the mesh of --file must contain all particles"
	refused 1 "field --file g -i once" "already holds the term 'external'"
	pinit exb >two
	refused 1 "field --file two" "two has 2 dimensions, and this frame 3"
}
