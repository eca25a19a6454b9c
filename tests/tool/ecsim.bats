# ecsim: energy to round-off, waves and streams, its place in a step, refusals. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

step='push drift/2 | ecsim | push kick drift/2'
# plasma DEBYE DT: thermal electrons, 64 a cell, places evenly, Debye length in cells.
plasma() {
	pinit plasma --length "$(calc "64/$1")" --cells 64 --dt "$2" --no-history | species electrons -n 4096 --loading random |
		scalc --set electrons 'x = Lx*(id + 0.5)/4096'
}
energies() { diag --columns energy_kinetic,energy_field_x | awk 'NR > 1 { printf "%.17g %.17g\n", $1, $1 + $2 }'; }

@test "kinetic and field energy add up to a constant to round-off, with cells of 0.3 to 100 Debye lengths and steps to 5/omega_p; a plasma does not heat" {
	while read -r debye dt n; do
		plasma "$debye" "$dt" | ecsim --gauss | cycle -q -n "$n" --every "$n" "$step" | energies >e
		# round-off of a sum of 4096 squares in n steps, at random: 1e-16 sqrt(n) 64
		below "$(awk 'NR == 1 { k = $1; s = $2 } END { print $2 / s - 1 }' e)" 2e-13 "debye $debye dt $dt"
		within "$(awk 'NR == 1 { k = $1 } END { print $1 / k }' e)" 1 0.02
	done <<-'END'
		0.3 0.2 500
		0.1 1 200
		0.01 5 200
	END
	plasma 0.1 0.2 | cycle -q -n 1000 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' | diag --columns energy_kinetic |
		awk 'NR == 2 { print $1 / 308.05 }' >k
	above "$(cat k)" 1.5 # what is cured
	# mobile ions, unequal weights, a fixed set that only adds to Gauss's law
	pinit plasma --dt 1 --cells 30 | species electrons -n 3000 --weighted --profile '1 + 0.3*cos(x/2)' |
		species ions -n 2000 --charge 2 --mass 9 --vth 0.2 | smod --constant background=0 | ecsim --gauss |
		cycle -q -n 50 --every 50 "$step" | energies | awk 'NR == 1 { s = $2 } END { print $2 / s - 1 }' >e
	below "$(cat e)" 2e-13
}

@test "a cold oscillation has its frequency to order 2 in the step, two streams their growth" {
	list=
	for n in 20 40 80; do # the error of cells and particles is the same for all; against n = 1280
		pinit langmuir -n 2048 --cells 64 --amplitude 0.02 --dt "$(calc 5/$n)" | ecsim --gauss | cycle -q -n $n "$step" >a
		stab --plain --mesh mesh a | awk '/x/ { for (k = 1; k <= NF; k++) if ($k == "E") c = k; next } NR == 17 { printf "%.15g", $c }' >e$n
	done
	pinit langmuir -n 2048 --cells 64 --amplitude 0.02 --dt "$(calc 5/1280)" | ecsim --gauss | cycle -q -n 1280 "$step" >a
	stab --plain --mesh mesh a | awk '/x/ { for (k = 1; k <= NF; k++) if ($k == "E") c = k; next } NR == 17 { printf "%.15g", $c }' >exact
	for n in 20 40 80; do list="$list $(calc 5/$n) $(calc "sqrt(($(cat e$n) - $(cat exact))^2)")"; done
	order 2 $list
	pinit two-stream -n 4000 --dt 0.1 | ecsim --gauss | cycle -q -t 30 --every 1 "$step" |
		diag --columns energy_field_x --growth energy_field_x | tail -1 >g
	within "$(awk '{ print $4 / 2 }' g)" 0.35355 0.004 # energy grows twice as fast; 64 cells and the step take 0.5 %
}

@test "a run that is interrupted, threads and engines give the same bytes; --gauss makes E of the charge and repeats itself" {
	plasma 0.5 0.5 | ecsim --gauss --no-history >a
	cycle -q --no-history -n 20 "$step" <a >b
	same_as b <(cycle -q --no-history -n 7 "$step" <a | cycle -q --no-history -n 13 "$step")
	same_as b <(cycle -q --no-history -n 20 --threads 1 "$step" <a)
	same_as b <(cycle -q --no-history -n 20 --engine pipes "$step" <a)
	pinit plasma --cells 64 | species electrons -n 40000 --profile '1 + 0.1*cos(x/2)' | ecsim --gauss >c
	below "$(ecsim --gauss c | sls --report | grep -o '"residual":[0-9.e-]*' | tail -1 | cut -d: -f2)" 1e-12
	# E = -0.1/k sin(k x) at x half a cell up of the node 8: k = 1/2
	stab --plain --mesh mesh c | awk '/x/ { for (k = 1; k <= NF; k++) if ($k == "E") c = k; next } NR == 10 { print $c }' >e
	within "$(cat e)" "$(calc '-0.2*sin(8.5*4*pi/64/2)')" 1e-3
}

@test "it stands in the middle of a drift-kick-drift step, on a periodic line, and says what is missing" {
	refused() {
		run --separate-stderr bash -o pipefail -c "$2 | sls"
		[[ $status = 1 && $stderr == *"$1"* ]] || { echo "$2: $status $stderr"; return 1; }
	}
	refused 'ecsim --gauss in front of the steps makes it of the charge' 'pinit langmuir | ecsim'
	refused 'is not in the middle of a step (push drift/2 | ecsim | push kick drift/2)' 'pinit langmuir | ecsim --gauss | ecsim'
	refused 'is not in the middle of a step' "pinit langmuir | ecsim --gauss | cycle -n 2 'push drift | ecsim | push kick'"
	refused 'of charges on a periodic line with the law electrostatic' 'pinit langmuir --dim 2 | ecsim --gauss'
	refused 'of charges on a periodic line with the law electrostatic' 'pinit sheath | ecsim --gauss'
}
