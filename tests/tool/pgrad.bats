# pgrad: derivatives of what particles carry, by corrected weights and by the general integral operator; Eulerian schemes of particles made of it.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# points M JITTER [stab options]: M x M points of the unit square with f = sin 2 pi x cos 2 pi y + x^2 y, moved by up to JITTER spacings.
points() {
	local m=$1 j=$2
	shift 2
	awk -v m="$m" -v j="$j" 'BEGIN { s = 1; h = 1 / m; p = 8 * atan2(1, 1); print "x y f volume"
		for (i = 0; i < m * m; i++) { s = s * 16807 % 2147483647; x = (i % m + 0.5 + j * (2 * s / 2147483647 - 1)) * h
			s = s * 16807 % 2147483647; y = (int(i / m) + 0.5 + j * (2 * s / 2147483647 - 1)) * h
			printf "%.17g %.17g %.17g %.17g\n", x, y, sin(p*x) * cos(p*y) + x*x*y, h * h } }' | stab - --box 0,1 "$@"
}
# worst EXPRESSION: the largest of it over the particles.
worst() { scalc "e = abs($1)" | stab --plain | column e | sort -g | tail -1; }
# rms EXPRESSION: its root mean square.
rms() { scalc "e = $1" | stab --plain | column e | awk '{ s += $1 * $1 } END { printf "%.17g", sqrt(s / NR) }'; }
# wave N [stab options]: c(x) = cos 2 pi x at the middles of N cells of 0..1.
wave() {
	local n=$1
	shift
	awk -v n="$n" 'BEGIN { print "x f volume"; for (i = 0; i < n; i++)
		printf "%.17g %.17g %.17g\n", (i + 0.5) / n, cos(8 * atan2(1, 1) * (i + 0.5) / n), 1 / n }' |
		stab - --box 0,1 --faces periodic --particle-faces periodic "$@"
}

@test "dc has its order on points moved by 0.3 h, to the edge, for first and second derivatives" {
	for case in '2 grad derivative_0-2*pi*cos(2*pi*x)*cos(2*pi*y)-2*x*y' '4 1,1 derivative+4*pi^2*cos(2*pi*x)*sin(2*pi*y)-2*x' \
		'6 0,1 derivative+2*pi*sin(2*pi*x)*sin(2*pi*y)-x^2'; do
		set -- $case
		local p=()
		for m in 24 40 64; do p+=("$(calc "1 / $m")" "$(points $m 0.3 | pgrad --field f --derivative "$2" --order "$1" | rms "$3")"); done
		order "$(calc "0.94 * $1")" "${p[@]}" # of random points
	done
}

@test "the integral operator has orders 2 to 8 on a lattice, for every derivative of degree 1 to 4" {
	for order in 2 4 6 8; do
		for d in 1:sin:-2*pi 2:cos:-4*pi^2 3:sin:8*pi^3 4:cos:16*pi^4; do
			local degree=${d%%:*} rest=${d#*:} p=()
			for n in 13 17 22; do
				p+=("$(calc "1 / $n")" "$(wave $n | pgrad --field f --method integral --derivative "$degree" --order "$order" |
					worst "derivative-(${rest#*:})*${rest%:*}(2*pi*x)")")
			done
			order "$(calc "0.93 * $order")" "${p[@]}" # exp(-s) s^(order/2): its exponential, s = (2 pi/13)^2 = 0.23, takes some
		done
	done
	# mixed and in space: x^2 y z has the derivative 2 x z by x and y
	awk 'BEGIN { print "x y z f volume"; for (i = 0; i < 9261; i++) { x = i % 21; y = int(i / 21) % 21; z = int(i / 441)
		print x, y, z, x * x * y * z, 1 } }' |
		stab - --box=-1,22 | pgrad --field f --method integral --derivative 1,1,0 --order 4 --wall none >a
	within "$(stab --plain a | awk '$1 == 10 && $2 == 10 && $3 == 10 { print $NF }')" 200 1e-3 # the reach 10 ends at the edge: exp(-25)
}

@test "one side alone: order 1 with the integral, that of --order with dc; a sum of both sides' halves is the whole" {
	for how in 1:integral 2:dc '4:dc --order 4'; do
		local p=()
		for n in 60 90 140; do
			p+=("$(calc "1 / $n")" "$(wave $n | pgrad --field f --method ${how#*:} --side below | worst 'derivative+2*pi*sin(2*pi*x)')")
		done
		order "${how%%:*}" "${p[@]}"
	done
	wave 40 | pgrad --field f --method integral --side below --target b | pgrad --field f --method integral --side above --target a |
		pgrad --field f --method integral >a
	below "$(worst '(a+b)/2-derivative' <a)" 1e-13
}

@test "--sign plus conserves the total and is refused where it means nothing; minus is exact for constants" {
	points 20 0.3 --faces periodic --particle-faces periodic >a
	sum=$(pgrad --field f --method integral --sign plus --derivative 1,0 a | stab --plain | column derivative |
		awk '{ s += $1 } END { printf "%.17g", s < 0 ? -s : s }')
	below "$sum" 1e-11 # 400 values of 10
	scalc --role state 'f = 1' <a >b
	below "$(pgrad --field f --method integral <b | worst derivative_0)" 0
	above "$(pgrad --field f --method integral --sign plus <b | worst derivative_0)" 0.1
	for refused in '--derivative lap --method integral --sign plus' '--sign plus' \
		'--derivative 1,2,1' '--derivative 5,0' '--derivative 1,' '--side below --derivative 1,1' \
		'--method integral --side below --order 4' '--order 8' '--order 6 --derivative 3,0' '--method integral --side above --derivative 2,0'; do
		run -2 bash -o pipefail -c "pgrad --field f $refused <a | sls"
	done
	run -1 bash -o pipefail -c 'sel --drop volume <a | pgrad --field f | sls'
	[[ $output == *"no field 'volume' on"*"--eps LENGTH"* ]]
	sh_ok 'sel --drop volume <a | pgrad --field f --eps 0.05 | sls'
	run -1 bash -o pipefail -c "scalc --role state 'y = 0.5' 'x = x, 0.5' <a | pgrad --field f | sls"
	[[ $output == *"which do not determine the derivative (rank"* ]]
}

@test "Eulerian schemes G1 to G4: a wave falls and moves by the symbol of each, in one step and at the limit" {
	# symbol D C K: abs(rho) = |1 - D (1 - exp(-K^2)) - C P - i C Q|, Q = K exp(-K^2/4)... of widths exp(-z^2/4): kappa = K
	wave 64 --dt 0.01 >a
	local k; k=$(calc '2 * pi / 64')
	amplitude() { stab --plain | awk 'BEGIN { p = 8 * atan2(1, 1) } NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
		{ c += cos(p * $at["x"]) * $at["f"]; s += sin(p * $at["x"]) * $at["f"] } END { printf "%.17g %.17g\n", c / 32, s / 32 }'; }
	# G1, diffusion: 1 - nu dt/eps^2 (1 - exp(-k^2))
	read -r c _ < <(cycle -i a -n 1 "field 'vel = 0' | pse --field f --nu 0.01 | push euler" | amplitude)
	within "$c" "$(calc "1 - 0.0001 * 4096 * (1 - exp(-$k ^ 2))")" 1e-9
	# G2, centred advection: 1 - i c k exp(-k^2), c = v dt/eps, grows
	read -r c s < <(cycle -i a -n 1 "field 'vel = 0' | pgrad --field f --method integral | field 'df = -derivative' | push euler" | amplitude)
	within "$c" 1 1e-12
	within "$s" "$(calc "0.64 * $k * exp(-$k ^ 2)")" 1e-8 # the cut-off takes 3e-8 of it
	# G3, upwind: damped, and stable to v dt/eps = 4/sqrt(pi) = 2.26 (half of it for kernels exp(-z^2)), beyond which the longest wave grows first
	run_to() { cycle -q -i a -n 300 "field 'vel = 0' | pgrad --field f --method integral --side below | field 'df = -derivative' | push euler --dt $1" |
		stab --plain | column f | awk '{ a = $1 < 0 ? -$1 : $1; if (a > m) m = a } END { print m }'; }
	below "$(run_to "$(calc "2.2 / 64")")" 0.9
	above "$(run_to "$(calc "2.35 / 64")")" 1.1
	# G4: both, and a source
	sh_ok "cycle -i a -n 5 \"field 'vel = 0' | pse --field f --nu 0.001 | pgrad --field f --method integral --side below |
		field 'df = -derivative + 0.1*sin(2*pi*x)' | push euler\" | sls"
}

@test "pgrad gives the same bytes with three threads; images at walls; strengths are taken over their volume" {
	points 30 0.3 >a
	for t in 1 2 3; do
		for m in dc integral; do OMP_NUM_THREADS=$t pgrad --field f --method $m --no-history <a | cksum; done
	done | sort -u >sums
	[ "$(wc -l <sums)" = 2 ]
	awk 'BEGIN { print "x f volume"; for (i = 0; i < 40; i++)
		printf "%.17g %.17g %.17g\n", (i + 0.5) / 40, sin(4 * atan2(1, 1) * (i + 0.5) / 40) / 40, 1 / 40 }' |
		stab - --strength f --box 0,1 --faces wall >b
	below "$(pgrad --field f --method integral --order 6 <b | worst 'derivative-pi*cos(pi*x)')" 1e-6
	above "$(pgrad --field f --method integral --order 6 --wall none <b | worst 'derivative-pi*cos(pi*x)')" 1
}
