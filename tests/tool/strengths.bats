# The account of strengths: what words may take from the sum of mass, charge or circulation is counted; any other change ends a run of cycle.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

field_step='p2m | poisson-fft | mgrad | diffuse | m2p | push lsrk3'

# account NAME < stream: sums of NAME at the first and the last frame, and what the reports of the last say was given less absorbed, cut off and outside.
account() {
	diag --columns "$1,strength_absorbed,strength_cut_off,strength_outside,strength_given" |
		awk 'NR == 2 { a = $1 } END { printf "%.17g %.17g %.17g\n", a, $1, $5 - $2 - $3 - $4 }'
}

# adds_up: of three numbers the second is the first and the third, to 1e-12 of the first.
adds_up() { awk '{ d = $2 - $1 - $3; print $0, d; exit !(d * d <= 1e-24 * $1 * $1 && $3 != 0) }'; }

@test "circulation that no permission accounts for ends the run at once, exit 3, in both engines and for a resumed run at the same step" {
	# dt |grad u| = 16: particles are thrown apart, and what diffuses to the gaps is lost
	pinit lamb-oseen --cells 64 --nu 1e-4 --dt 0.02 >a
	for engine in fused pipes; do
		run -3 cycle -n 20 --engine $engine "p2m --outside grow | ${field_step#p2m | } | remesh --rim 2 --outside grow" <a
		[[ $output == *"cycle: step 1: the sum of 'circulation' went from 1 to 0.947"*"m2p reports that"*"a shorter dt"* ]]
	done
	# slowly: 1e-3 of the beginning, also if the run was stopped between
	pinit lamb-oseen --cells 24 >a
	run -3 cycle -n 60 "$field_step" <a
	[[ $output == *"step 36:"* ]]
	cycle -n 35 --checkpoint c "$field_step" <a >b
	run -3 cycle -n 60 --resume c "$field_step"
	[[ $output == *"step 36: the sum of 'circulation' went from 1 to 0.99"* ]]
}

@test "absorbed, cut off, left outside and given strength is counted, adds up, and ends no run" {
	pinit uniform -n 500 --dispersion 1 --dt 0.05 --faces open --particle-faces absorb >a
	sh_ok 'cycle -n 10 --every 10 "push drift" <a >b'
	account mass <b | adds_up
	sh_ok 'cycle -n 10 --every 10 "push drift | walk --nu 0.01" <a >b'
	account mass <b | adds_up
	awk 'BEGIN { print "x y circulation volume"; for (i = 0; i < 40; i++) print -3.9 + i / 5, i / 40, 1, 0.04 }' |
		stab - --law vortex --box -4,4 -n 32 --dt 0.1 >a
	for words in 'remesh --cut-off 0.2' 'remesh --outside drop' 'scalc "circulation = 0.9*circulation"' 'sel --where "x < 3 - time"'; do
		sh_ok "cycle -n 8 --every 8 'p2m --outside grow | poisson-fft | mgrad | m2p | push euler | $words' <a >b"
		account circulation <b | adds_up
	done
	# passes of a scheme; what an earlier run was given is not counted again
	sh_ok "pinit polygon -n 4 | cycle -n 5 \"pp | field 'dcirculation = -0.1*circulation' | push rk4\" >a"
	sh_ok "cycle -n 5 --every 5 \"pp | field 'dcirculation = -0.1*circulation' | push rk4\" <a >b"
	diag --columns time,circulation,strength_given <b |
		awk 'END { d = $2 / (4 * exp(-0.1 * $1)) - 1; e = $2 - 4 - $3; exit !(d * d < 1e-12 && e * e < 1e-24) }'
	# viscosity beside walls where omega is 0
	pinit lamb-oseen --cells 32 --start 10 | smod --faces wall --particle-faces reflect >a
	sh_ok "cycle -n 40 --every 40 '$field_step | remesh' <a >b"
	account circulation <b | adds_up
}

@test "a foreign word that changes a strength ends the run, unless --moves names it" {
	printf '#!/bin/sh\nPATH="%s"\nscalc --role state --extensive "m = 0.999*mass" | sel --drop mass | smod --rename m=mass\n' "$PATH" >leak
	chmod +x leak
	pinit plummer -n 20 >a
	run -3 cycle -n 5 'push drift | ./leak' <a
	[[ $output == *"cycle: step 2: the sum of 'mass' went from 0.985185 to 0.983216;"*"--moves WORD"* ]]
	sh_ok "cycle -n 5 --moves ./leak 'push drift | ./leak' <a | sls"
}

@test "the sentence of a viscous vortex in open space needs no options: it keeps circulation and follows Lamb and Oseen while the vortex doubles" {
	# dt |grad u| = 1/2; dropped below 1e-6 of the largest strength
	pinit lamb-oseen --cells 64 --nu 1e-4 | cycle -n 100 "$field_step | remesh" | diag --exact >t
	within "$(column circulation <t)" 1 1e-6
	within "$(column angular_impulse <t)" "$(column exact_angular_impulse <t)" 5e-6
	# four times the age: the mesh grows with it
	pinit lamb-oseen --cells 64 | cycle -n 300 "$field_step | remesh" >b
	diag --exact <b >t
	within "$(column circulation <t)" 1 1e-5
	within "$(column angular_impulse <t)" "$(column exact_angular_impulse <t)" 2e-4
	sh_ok 'sls <b'
	[[ $output =~ (80|96)\ x\ (80|96)\ cells ]]
}
