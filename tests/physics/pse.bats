# Diffusion on particles against exact solutions: the benchmark of the lecture notes (N64, DF-02), orders (N06, N07), distorted points (S35).
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# rod N [FROM]: u = x exp(-x^2) at the middles of N cells of 0..4, from the FROM-th on.
rod() {
	awk -v n="$1" -v from="${2:-0}" 'BEGIN { h = 4 / n; print "x heat volume"
		for (i = from; i < n; i++) { x = (i + 0.5) * h; printf "%.17g %.17g %.17g\n", x, x * exp(-x * x) * h, h } }'
}
exact='function exact(x) { return x / 1.004^1.5 * exp(-x * x / 1.004) }'
# error N CUT-OFF [options of pse]: rms over the particles at t = 10, nu = 1e-4, explicit Euler with dt = 0.1, eps = h.
error() {
	local n=$1 cut=$2
	shift 2
	rod $n | stab - --strength heat --box 0,4 --faces wall,open --dt 0.1 |
		cycle -n 100 "field 'vel = 0' | pse --field heat --nu 1e-4 --cutoff $cut $* | push euler" |
		scalc 'u = heat / volume' | stab --plain | awk "$exact"'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } {
			s += ($at["u"] - exact($at["x"]))^2 } END { print sqrt(s / (NR - 1)) }'
}
# g: a Gaussian of variance v, periodic in -1..1; gg: its second derivative.
kernel='function g(x, v, m, s) { s = 0; for (m = -3; m < 4; m++) s += exp(-(x - 2*m)^2 / (2*v)) / sqrt(2 * 3.14159265358979324 * v); return s }
	function gg(x, v, m, s) {
		for (m = -3; m < 4; m++) s += ((x - 2*m)^2 / v - 1) / v * exp(-(x - 2*m)^2 / (2*v)) / sqrt(2 * 3.14159265358979324 * v)
		return s + 0 }'
# lattice DIM N BOX EXPRESSION [stab options]: on N^DIM points of the periodic cube -BOX..BOX, as strengths.
lattice() {
	local dim=$1 n=$2 box=$3 e=$4
	shift 4
	# each value of g once
	awk -v n="$n" -v dim="$dim" -v l="$box" "${kernel/function g(/function sum(}"'
		function g(x, v) { if (!((x, v) in kept)) kept[x, v] = sum(x, v); return kept[x, v] }
		BEGIN { CONVFMT = "%.17g"; h = 2 * l / n; V = h^dim; print substr("x y z", 1, 2 * dim - 1) " heat volume"
		for (i = 0; i < n; i++) for (j = 0; j < (dim > 1 ? n : 1); j++) for (k = 0; k < (dim > 2 ? n : 1); k++) {
			x = -l + i * h; y = dim > 1 ? -l + j * h : 0; z = dim > 2 ? -l + k * h : 0
			printf "%.17g ", x; if (dim > 1) printf "%.17g ", y; if (dim > 2) printf "%.17g ", z; printf "%.17g %.17g\n", V * ('"$e"'), V } }' |
		stab - --strength heat --box -$box,$box --faces periodic --particle-faces periodic "$@"
}

@test "N64, DF-02: heat in a half line: the numbers of the benchmark, cut off at 5 and at 10 eps, at 25 to 1600 particles" {
	# 25 to 400 at 5 eps: DF-02; the others as remeasured for tests/reference/cases.md, to their three digits. Beyond 400 the error of euler matters: not
	# tested at 10 eps.
	for row in 25:7.09e-5:7.05e-5 50:1.9545e-5:1.88e-5 100:5.6265e-6:4.76e-6 200:2.1036e-6:1.17e-6 400:1.2492e-6:2.7e-7 800:1.05e-6: 1600:1.00e-6:; do
		IFS=: read -r n five ten <<<"$row"
		within "$(error $n 5)" $five "$(awk "BEGIN { print 5e-3 * $five }")" "$n particles, cut off at 5 eps"
		[ -z "$ten" ] || within "$(error $n 10)" $ten "$(awk "BEGIN { print 1e-2 * $ten }")" "$n particles, cut off at 10 eps"
	done
}

@test "N64: the error falls as N^-2 with images of opposite sign to 1e-6, the error of the cut-off, and is over ten times larger without (S37)" {
	order 2 .04 "$(error 100 8)" .02 "$(error 200 8)" .01 "$(error 400 8)"
	awk "BEGIN { exit !($(error 50 10 --wall none) > 10 * $(error 50 10)) }"
}

@test "DF-02: u(1, 10) of 400 particles is .367142960673" {
	rod 400 | stab - --strength heat --box 0,4 --faces wall,open --dt 0.1 | cycle -n 100 "field 'vel = 0' | pse --field heat --nu 1e-4 | push rk2" |
		stab --plain |
		awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } $at["x"] > 0.99 && $at["x"] < 1.01 { s += $at["heat"] / $at["volume"] / 2 } END {
			print s }' >u
	within "$(cat u)" 0.367142960673 1e-5 # the mean of its two neighbours differs by u'' h^2/8 = 9e-6
}

@test "N64, N06: the random walk's error is statistical, N^-1/2, and agrees with the benchmark within a third" {
	for row in 25:1.0e-1 50:5.7e-2 100:5.0e-2 200:3.4e-2 400:2.3e-2 800:1.7e-2 1600:1.2e-2; do
		n=${row%:*}
		for seed in $(seq 20); do # 20 bins of 0.2; both halves walk, odd about 0
			rod $n -$n | stab - --strength heat --box -8,8 --dt 10 | walk --nu 1e-4 --seed $seed | stab --plain
		done | awk "$exact"'/heat/ { for (i = 1; i <= NF; i++) at[$i] = i; k++; next } NF { x = $at["x"]; if (x > 0 && x < 4) bin[k,
			int(5 * x)] += 5 * $at["heat"] }
			END { for (j = 1; j <= k; j++) for (i = 0; i < 20; i++) s += (bin[j, i] - exact((i + 0.5) / 5))^2; print sqrt(s / 20 / k) }' >rms
		# 20 seeds of 20 bins, of which a third matter: a statistical error of a tenth
		within "$(cat rms)" ${row#*:} "$(awk "BEGIN { print 0.33 * ${row#*:} }")" "$n particles"
		echo "$n $(cat rms)"
	done >rows
	awk '{ x = log($1); y = log($2); n++; sx += x; sy += y; sxx += x * x; sxy += x * y } END { p = (n * sxy - sx * sy) / (n * sxx - sx * sx); print p;
		exit !(p > -0.6 && p < -0.4) }' rows
}

@test "N07: the heat kernel in 1 and 2 dimensions converges with order 2 and 4 in time; the sum is conserved to round-off" {
	# variance 0.1 to 0.11 in t = 1, as it is between periodic faces; eps = h; rk4 at stable steps, whose error is far smaller
	for dim in 1 2; do
		[ $dim = 1 ] && sizes="60 84 120" steps=14 || sizes="48 56 64" steps=4
		for order in 2 4; do
			points=()
			for n in $sizes; do
				lattice $dim $n 1 'g(x, 0.1) * (dim > 1 ? g(y, 0.1) : 1)' --dt "$(awk "BEGIN { print 1 / $steps }")" >a
				cycle -n $steps "field 'vel = $(echo 0, 0 |
					cut -c1-$((3 * dim - 2)))' | pse --field heat --nu 0.005 --order $order | push rk4" <a |
					stab --plain | awk -v dim=$dim "$kernel"'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
						{ e = $at["heat"] / $at["volume"] - g($at["x"], 0.11) * (dim > 1 ? g($at["y"], 0.11) : 1); if (e < 0) e = -e;
							if (e > m) m = e; s += $at["heat"] }
						END { printf "%.4g %.17g\n", m, s }' >b
				points+=("$(awk "BEGIN { print 2 / $n }")" "$(cut -d' ' -f1 b)")
				below "$(stab --plain <a | column heat | awk -v s="$(cut -d' ' -f2 b)" '{ t += $1 } END { print s / t - 1 }')" 1e-14
			done
			echo "$dim-D, order $order: ${points[*]}"
			order $order "${points[@]}"
		done
	done
}

@test "N07: the Laplacian of the heat kernel converges with order 2 and 4 in 3 dimensions" {
	for n in 32 38 46; do lattice 3 $n 1 'g(x, 0.25) * g(y, 0.25) * g(z, 0.25)' >lattice.$n; done
	for order in 2 4; do
		points=()
		for n in 32 38 46; do
			pse --field heat --nu 1 --order $order <lattice.$n | stab --plain |
				awk "$kernel"'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
					{ for (d = 0; d < 3; d++) { t = $at[substr("xyz", d + 1, 1)]; if (!(t in one)) { one[t] = g(t, 0.25); two[t] = gg(t,
						0.25) } u[d] = one[t]; v[d] = two[t] }
					e = $at["dheat"] / $at["volume"] - v[0]*u[1]*u[2] - u[0]*v[1]*u[2] - u[0]*u[1]*v[2]; if (e < 0) e = -e;
						if (e > m) m = e } END { print m }' >b
			points+=("$(awk "BEGIN { print 2 / $n }")" "$(cat b)")
		done
		echo "order $order: ${points[*]}"
		order $order "${points[@]}"
	done
}

@test "DF-03: a Gaussian of variance 0.04 in the plane, nu = 0.01, t = 1: peak and variance to 1e-3, mass to round-off" {
	lattice 2 96 1.28 'exp(-(x*x + y*y) / 0.08) / (0.08 * 3.14159265358979324)' --dt 0.05 |
		cycle -n 20 "field 'vel = 0, 0' | pse --field heat --nu 0.01 --order 4 | push rk2" |
		stab --plain | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { h = $at["heat"]; s += h; v += h * $at["x"]^2;
			p = h / $at["volume"]; if (p > m) m = p } END { printf "%.17g %.17g %.17g\n", m, v / s, s }' >b
	read -r peak variance mass <b
	within $peak 2.65258238486492 2.6e-3
	within $variance 0.06 6e-5
	within $mass 1 1e-6 # of the Gaussian in this box
}

@test "VM-01: Lamb and Oseen's vortex, carried, diffused by exchange and remeshed: omega to 3e-3 at t = 2, circulation except for the threshold of remesh" {
	pinit lamb-oseen --cells 80 --dt 0.05 >a
	cycle -t 1 'p2m --kernel m6prime | poisson-fft | mgrad | m2p | pse --order 4 | push rk2 | remesh --kernel m6prime --cut-off 1e-8' <a |
		p2m --kernel m6prime >b
	p2m --kernel m6prime <b | diag --exact >t
	within "$(column omega_max <t)" "$(column exact_omega_max <t)" "$(awk "BEGIN { print 3e-3 * $(column exact_omega_max <t) }")"
	within "$(column circulation <t)" 1 1e-6
}

# largest M JITTER INTERIOR OPTIONS: the largest error of the Laplacian of f = sin 2 pi x cos 2 pi y + x^2 on M x M points of the unit square, moved by JITTER
# h, at least INTERIOR h from its rim.
largest() {
	awk -v m="$1" -v j="$2" 'BEGIN { srand(4); p = 8 * atan2(1, 1); h = 1 / m; print "x y f volume"
		for (i = 0; i < m; i++) for (k = 0; k < m; k++) { x = (i + 0.5 + j * (2 * rand() - 1)) * h; y = (k + 0.5 + j * (2 * rand() - 1)) * h
			printf "%.17g %.17g %.17g %.17g\n", x, y, sin(p*x) * cos(p*y) + x*x, h*h } }' | stab - | pse --field f --nu 1 $4 | stab --plain |
		awk -v r="$(awk "BEGIN { print $3 / $1 }")" 'BEGIN { p = 8 * atan2(1, 1) } NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
			{ x = $at["x"]; y = $at["y"]; if (x < r || x > 1 - r || y < r || y > 1 - r) next; e = $at["df"] - 2 + 2*p*p * sin(p*x) * cos(p*y);
				if (e < 0) e = -e; if (e > w) w = e } END { print w }'
}

@test "S35: on points displaced by 0.3 h the Laplacian diverges as 1/h, on a lattice it converges: the table of the lecture notes" {
	for m in 40:1.9:15 80:0.49:42 160:0.13:100; do
		IFS=: read -r n straight moved <<<"$m"
		echo "$n $straight $(largest $n 0 8) $moved $(largest $n 0.3 8)"
	done >rows
	awk '{ a = $3 / $2; b = $5 / $4; print; if (!(a > 0.5 && a < 2 && b > 0.5 &&
		b < 2)) exit 1 }' rows # other random numbers than the lecture notes, hence a margin
	order 2 $(awk '{ print 1 / $1, $3 }' rows)
	order 0.8 $(awk '{ print $1, $5 }' rows)
}

@test "S35, N56: with corrected weights it converges on the same points with order 2 and 4, up to the boundary: the table of the lecture notes" {
	for m in 20:2.4e1 40:5.0 80:1.4 160:4.7e-1; do
		IFS=: read -r n moved <<<"$m"
		echo "$n $moved $(largest $n 0.3 0 '--method dc') $(largest $n 0.3 0 '--method dc --order 4')"
	done >rows
	awk '{ a = $3 / $2; print; if (!(a > 0.4 && a < 2)) exit 1 }' rows # other random numbers than the lecture notes, hence a margin
	order 1.7 $(awk '{ print 1 / $1, $3 }' rows) # the largest error is at a corner and fluctuates; the order in the table is 1.9
	order 3.7 $(awk '{ print 1 / $1, $4 }' rows)
	for n in 40 80 160; do echo "$n $(largest $n 0.3 10 '--method dc --order 4')"; done >rows
	order 3.9 $(awk '{ print 1 / $1, $2 }' rows)
}

@test "DF-04: sin 2x cos 3y + x^2 y on points displaced by half a spacing: the errors of the reference within its factor of 2, order 2" {
	for row in 16:9.601e-02 32:3.116e-02 64:8.531e-03; do
		n=${row%:*}
		awk -v n=$n 'BEGIN { s = 1; h = 1 / n; print "x y f volume"
			for (j = 0; j < n; j++) for (i = 0; i < n; i++) { s = s * 16807 % 2147483647; x = (i + 0.5 + 0.5 * (s / 2147483647 - 0.5)) * h;
				s = s * 16807 % 2147483647; y = (j + 0.5 + 0.5 * (s / 2147483647 - 0.5)) * h
				printf "%.17g %.17g %.17g %.17g\n", x, y, sin(2*x) * cos(3*y) + x*x*y, h*h } }' | stab - | pse --field f --nu 1 --method dc |
					stab --plain |
			awk -v r="$(awk "BEGIN { print 4 / $n }")" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { x = $at["x"]; y = $at["y"];
				if (x < r || x > 1 - r || y < r || y > 1 - r) next
				e = $at["df"] + 13 * sin(2*x) * cos(3*y) - 2 * y; if (e < 0) e = -e; if (e > w) w = e } END { print w }' >got
		echo "$n ${row#*:} $(cat got)"
	done >rows
	cat rows
	awk '{ a = $3 / $2; if (!(a > 0.5 && a < 2)) exit 1 }' rows
	order 1.7 $(awk '{ print 1 / $1, $3 }' rows) # the reference has order 1.75
}

@test "heat on distorted points between insulated faces: with corrected weights it follows the series; plain exchange does not" {
	for method in exchange dc; do
		awk 'BEGIN { srand(8); n = 30; p = 4 * atan2(1, 1); h = 1 / n; print "x y heat volume"; for (i = 0; i < n; i++) for (k = 0; k < n; k++) {
			x = (i + 0.5 + 0.6 * (rand() - 0.5)) * h; y = (k + 0.5 + 0.6 * (rand() - 0.5)) * h
			printf "%.17g %.17g %.17g %.17g\n", x, y, h*h * cos(p*x) * cos(2*p*y), h*h } }' |
				stab - --strength heat --box 0,1 --faces neumann --dt 1e-4 |
			cycle -t 0.02 "field 'vel = 0, 0' | pse --field heat --nu 0.5 --method $method | push rk2" | stab --plain |
			awk 'BEGIN { p = 4 * atan2(1, 1) } NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } {
				e = $at["heat"] * 900 - cos(p * $at["x"]) * cos(2*p * $at["y"]) * exp(-5 * p*p * 0.01); if (e < 0) e = -e;
					if (e > w) w = e } END { print w }'
	done >errors
	awk 'NR == 1 { e = $1 } NR == 2 { print e, $1; exit !(e > 5 * $1 && $1 < 5e-3) }' errors
}

# rate: nu/eps^2 (transform - M0) of that wave with eps = h: the sum over a lattice is that of the transform over all its aliases k + 2 pi m/h.
rate='function T(z) { return order == 2 ? exp(-z) : (2 + z) * exp(-z) }
	function S(dim, a, b, c, x, y, z, s, p, Y, Z) { p = 2 * pi; Y = dim > 1 ? 2 : 0; Z = dim > 2 ? 2 : 0
		for (x = -2; x < 3; x++) for (y = -Y; y <= Y; y++) for (z = -Z; z <= Z; z++)
		s += T((a + p*x)^2 + (b + p*y)^2 + (c + p*z)^2); return s }
	function rate(dim, m, a, b, c) {
		pi = atan2(0, -1); a = 2 * m * pi / 16; b = dim > 1 ? m * pi / 24 : 0; c = dim > 2 ? 3 * m * pi / 12 : 0
		return 0.37 * 256 * (S(dim, a, b, c) - S(dim, 0, 0, 0)) }'
# mode DIM FACES ORDER CUT-OFF: a wave on a lattice in a box 1 x 1.5 x 0.75, and the difference of pse's rate from nu/eps^2 (transform - M0), over the
# largest rate.
mode() {
	local zero=0,0,0
	awk -v dim="$1" -v faces="$2" 'BEGIN { pi = atan2(0, -1); N[1] = 16; N[2] = 24; N[3] = dim < 3 ? 1 : 12; if (dim < 2) N[2] = 1; L[1] = 1; L[2] = 1.5;
		L[3] = 0.75; M[1] = 2; M[2] = 1; M[3] = 3
		for (d = 1; d <= dim; d++) k[d] = (faces == "periodic" ? 2 : 1) * pi * M[d] / L[d]
		print substr("x y z", 1, 2 * dim - 1), "heat wave volume"; V = 16^-dim
		for (a = 0; a < N[1]; a++) for (b = 0; b < N[2]; b++) for (c = 0; c < N[3]; c++) { X[1] = a; X[2] = b; X[3] = c; u = 1
			for (d = 1; d <= dim; d++) { x = (X[d] + 0.5) / 16; printf "%.17g ", x;
				u *= faces == "wall" ? sin(k[d] * x) : faces == "periodic" ? cos(k[d] * x + d) : cos(k[d] * x) }
			printf "%.17g %.17g %.17g\n", u * V, u, V } }' |
		stab - --strength heat --box "$(case $1 in 1) echo 0,1 ;; 2) echo 0,0,1,1.5 ;; 3) echo 0,0,0,1,1.5,0.75 ;; esac)" --faces $2 --dt 1e-3 >lattice
	field "vel = ${zero:0:2*$1-1}" <lattice | pse --field heat --nu 0.37 --order $3 --cutoff $4 | stab --plain |
		awk -v dim="$1" -v faces="$2" -v order="$3" "$rate"'BEGIN { V = 16^-dim; s = rate(dim, faces == "periodic" ? 2 : 1) } NR == 1 {
			for (i = 1; i <= NF; i++) at[$i] = i; next }
		{ e = $at["dheat"] / V - s * $at["wave"]; if (e < 0) e = -e; if (e > w) w = e } END { printf "%.3g\n", -w / s }'
}

@test "the rate of a mode on a lattice is nu/eps^2 (exp(-k^2 eps^2) - 1) to round-off: 1 to 3 dimensions, both orders, periodic, walled and insulated" {
	# the cut-off removes a tail of exp(-z^2/4) and a polynomial: exp(-49), exp(-36), exp(-30) here; the rest is round-off
	for faces in periodic wall neumann; do
		for order in 2 4; do
			below "$(mode 1 $faces $order 14)" 1e-12 "order $order, 1-D, $faces"
			below "$(mode 2 $faces $order 12)" 5e-12 "order $order, 2-D, $faces"
			below "$(mode 3 $faces $order 11)" 5e-10 "order $order, 3-D, $faces"
		done
	done
	# many steps of euler: (1 + dt lambda)^n
	mode 2 periodic 2 12
	cycle -n 40 --no-history "field 'vel = 0, 0' | pse --field heat --nu 0.37 --cutoff 12 | push euler" <lattice | stab --plain |
		awk -v order=2 "$rate"'BEGIN { g = (1 + 1e-3 * rate(2, 2))^40 }
		NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { e = $at["heat"] * 256 - g * $at["wave"]; if (e < 0) e = -e; if (e > w) w = e } END {
			print w / g, g; exit !(NR == 385 && w < 1e-11 * g && g < 0.2) }'
}
