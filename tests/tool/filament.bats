# filament: rings, Kelvin's waves, Crow's instability, local induction, conservation, refusals.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

marked() { stab - --law vortex "$@" | scalc --role state --type i64 'node = i' 'curve = c'; }
# ring NODES CORE [NUMBER]: of radius 1 and circulation 1 about the z axis.
ring() {
	awk -v n="$1" -v a="$2" 'BEGIN { print "x y z circulation core c i"; for (i = 0; i < n; i++) { t = 6.283185307179586 * i / n
		printf "%.17g %.17g 0 1 %.17g 7 %d\n", cos(t), sin(t), a, i } }' | marked --box=-2,2 --faces open --dt "${3:-0.01}"
}
# mean FIELD [COMPONENT]: over the particles.
mean() { sls --data | awk -v f="$1" -v c="${2:-0}:" '$1 == f { on = 1; next } on && $1 == c { print $7; exit }'; }

@test "a ring moves at the speed of the smoothed integral, and of Kelvin and Saffman within 3 %" {
	# a = 0.05: the integral 0.3839378 (scipy.integrate.quad); Kelvin 0.3839752, with a Gaussian core 0.3594653 (VM-10); a = 0.1: 0.3288162
	for n in 32 64 128; do
		within "$(ring $n 0.05 | filament | mean vel 2)" 0.3839378 5e-5
	done
	run -0 --separate-stderr diag <(ring 64 0.05)
	[[ $stderr == *"'matter' are filaments, whose length and impulse are in the report of the word filament (sls --report)" ]]
	run -1 plan < <(ring 16 0.05)
	[[ $output == *"'matter' are filaments, which no effect of a plan is about (cycle 'filament | push rk4')" ]]
	within "$(ring 64 0.05 | filament --core-profile gaussian | mean vel 2)" 0.3594653 1e-3
	within "$(ring 64 0.1 | filament | mean vel 2)" 0.3288162 0.003
	within "$(ring 64 0.05 | filament --local 4 | mean vel 2)" 0.3839752 1e-5 # ln(2 l/sigma) - 1 = ln(8 R/a) - 1/4, but for (sigma/l)^2
	within "$(ring 64 0.1 | filament --core-profile smoothed --local 2 | mean vel 2)" "$(calc '(log(40) - 1) / (4 * pi)')" 3e-4
}

@test "Kelvin's waves turn at their frequency, of order 2 in the elements, against their sense" {
	# for exp(i k x): Gamma/(4 pi) (2 k K1(k s)/s - 2/s^2 + 2 k^2 K0(k s)), s = 0.1 exp(-3/4), k = 1: 0.2126259 (scipy.special)
	for n in 16 32 64; do
		awk -v n=$n 'BEGIN { print "x y z circulation core c i"; for (i = 0; i < n; i++) { t = 6.283185307179586 * i / n
			printf "%.17g %.17g %.17g 1 0.1 0 %d\n", t, 1e-4 * cos(t), 1e-4 * sin(t), i } }' |
			marked --box=0,-5,-5,6.283185307179586,5,5 --faces periodic,open,open |
			filament | scalc 'turn = (vel.z*cos(x) - vel.y*sin(x))*1e4' | mean turn >>turns
	done
	awk '{ e[NR] = 0.2126259 + $1 } END { print log(e[1] / e[3]) / log(4), e[3] }' turns >fit
	within "$(cut -d' ' -f1 fit)" 2 0.2 # measured 1.9
	below "$(cut -d' ' -f2 fit)" 3e-4
}

# pair NODES AMPLITUDE: two vortices a distance 1 apart with the symmetric wave of k b = 0.73, inclined by 48 degrees.
pair() {
	awk -v n="$1" -v q="$2" 'BEGIN { print "x y z circulation core c i"; L = 6.283185307179586 / 0.73
		for (c = 0; c < 2; c++) for (i = 0; i < n; i++) { s = 1 - 2 * c; w = q * cos(6.283185307179586 * i / n)
			printf "%.17g %.17g %.17g %d 0.0981 %d %d\n", L * i / n, s * (0.5 + 0.67 * w), 0.74 * w, s, c, i } }' |
		marked --box=0,-5,-5,8.607103160520,5,5 --faces periodic,open,open --dt 0.1
}

@test "Crow's instability grows by 0.83 Gamma/(2 pi b^2) at k b = 0.73, with the cut-off 0.063 b of Crow 1970" {
	# a cut-off d stands for a uniform core a = d/0.642; measured 0.8222
	pair 32 1e-4 | cycle -t 16 --every-time 8 'filament | push rk4' >a
	scalc 'wide = node == 0 && curve == 0 ? y - 0.5 : 0' <a | sls --data | awk '$1 == "wide" { getline; print $3 + $5 }' >wide
	within "$(awk '{ b = a; a = $1 } END { print log(a / b) / 8 * 6.283185307179586 }' wide)" 0.83 0.0125
	within "$(awk '{ b = a; a = $1 } END { print log(a / b) / 8 * 6.283185307179586 }' wide)" 0.8222 0.002
	# the pair sinks by Gamma/(2 pi b) t
	within "$(sel --last <a | mean x 2)" "$(calc '-16 / (2 * pi) / (1 + 0.0463^2)')" 1e-3
}

@test "a leapfrogging pair keeps impulse and length as it should, and carries other particles as it moves itself" {
	awk 'BEGIN { print "x y z circulation core c i"; for (c = 0; c < 2; c++) for (i = 0; i < 48; i++) { t = 6.283185307179586 * i / 48
		printf "%.17g %.17g %.17g 1 0.1 %d %d\n", cos(t), sin(t), 0.6 * c, c, 47 - i } }' | marked --box=-3,3 --faces open --dt 0.05 >a
	cycle -i a -n 100 'filament | push rk4' | filament | sls --report >late
	filament <a | sls --report >early
	for f in early late; do sed -n 's/.*"impulse_z":\([^,}]*\).*/\1/p' $f | tail -1 >$f.z; done
	within "$(<early.z)" "$(calc '-48 * sin(2 * pi / 48)')" 1e-9 # -2 pi, of polygons
	within "$(<late.z)" "$(<early.z)" 0.006 # 0.1 %: elements are straight
	printf 'x y z\n0 0 0\n0.3 0 0.7\n' | stab - --law vortex --box=-2,2 --faces open --set tracer | stack --merge - <(ring 32 0.1) |
		filament --carry tracer | sel --set tracer | stab --plain --set tracer >tracer
	# on the axis of a polygon of n sides with apothem c: n sin(pi/n)/(2 pi)/(c^2 + s^2)/sqrt(1 + s^2) c
	within "$(awk 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k } NR == 2 { print $at["vel_2"] }' tracer)" \
		"$(calc '32 * cos(pi/32) * sin(pi/32) / (2 * pi) / (cos(pi/32)^2 + 0.04723665^2) / sqrt(1 + 0.04723665^2)')" 1e-8
	cycle -i a -n 2 'filament --threads 1 | push rk4' | scmp --quiet - <(cycle -i a -n 2 'filament --threads 3 | push rk4')
}

@test "filament: refusals in one sentence" {
	ring 16 0.1 >a
	while IFS=';' read -r code command text; do
		run "-$code" --separate-stderr bash -c "$command" <a
		[[ $stderr == *"$text"* ]] || { echo "$command: $stderr"; return 1; }
	done <<-'END'
		1;sel --drop core | filament;no field 'core'
		1;scalc 'core = -1' | filament;has the core -1 (a radius above 0)
		1;sel --where 'node < 2' | filament;curve 7 has 2 nodes, and a closed curve needs 3 and more (more nodes
		1;scalc --type i64 'node = 3' | filament;curve 7 has two nodes 3
		1;scalc 'circulation = x' | filament;but a filament has one (Helmholtz)
		1;scalc 'x = 1, 2, 3' | filament;nodes 0 and 1 of curve 7 coincide
		1;sel --drop curve | filament;no set of filaments
		1;pinit lamb-oseen --cells 8 | filament;filaments are curves in space
		1;smod --faces periodic | filament;periodic along 3 axes
		1;smod --faces wall | filament;the box is wall along x
		1;filament --carry no;--carry no: no other set of that name with positions (sls lists
	END
}
