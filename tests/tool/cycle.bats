#!/usr/bin/env bats
# cycle: counting, output, priming, checkpoints, refusals. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

leap='push kick/2 drift | pp | push kick/2'
frames() { sls --format json | grep -c '"step"'; }
steps_of() { diag | column step | tr '\n' ' '; }

@test "without --every only the last frame is written" {
	sh_ok "pinit two-body | cycle -n 7 '$leap' | diag"
	[ "$(pinit two-body | cycle -n 7 "$leap" | steps_of)" = "7 " ]
}

@test "with --every the beginning, the multiples and the last are written" {
	[ "$(pinit two-body | cycle -n 7 --every 3 "$leap" | steps_of)" = "0 3 6 7 " ]
}

@test "the beginning is written primed: it holds the force" {
	pinit two-body | cycle -n 1 --every 1 "$leap" | sel --frames 1 | sls | grep -q acc
}

@test "-t stops at the first step with time >= t - dt/2" {
	pinit two-body --dt 0.1 > a
	[ "$(cycle -t 0.449 "$leap" < a | steps_of)" = "4 " ]
	[ "$(cycle -t 0.451 "$leap" < a | steps_of)" = "5 " ]
}

@test "-n 0 passes the frame on" {
	pinit two-body --no-history > a
	cycle -n 0 --no-history "$leap" < a > b
	same_as a b
}

@test "every input frame starts its own run, and two streams stay two" {
	pinit two-body > a
	[ "$(cat a a | cycle -n 2 "$leap" | steps_of)" = "2 2 " ]
	cycle -n 2 "$leap" < a > b
	[ "$(cycle -n 2 "$leap" < b | steps_of)" = "4 " ]
}

@test "-n counts from the beginning, also after resume" {
	pinit two-body > a
	cycle -n 5 --checkpoint c "$leap" < a > five
	cycle -n 9 --resume c "$leap" > nine
	cycle -n 9 "$leap" < a > want
	same_as nine want
}

@test "after resume the frames are the same bytes, history and all" {
	pinit two-body > a
	cycle -n 6 --every 2 "$leap" < a > all
	cycle -n 4 --every 2 --checkpoint c "$leap" < a > first
	cycle -n 6 --every 2 --resume c "$leap" > rest
	sel --no-history --frames 4 < all > x
	sel --no-history --frames 1 < rest > y
	same_as x y
}

@test "a checkpoint is a stream of one frame under its own name" {
	pinit two-body | cycle -n 3 --checkpoint c "$leap" > b
	[ "$(steps_of < c)" = "3 " ]
	[ ! -e c.part ]
}

@test "the history holds one entry for the whole loop" {
	pinit two-body | cycle -n 3 "$leap" | cycle -n 2 "$leap" > b
	[ "$(sls --history < b | grep -c cycle)" -eq 1 ]
	! sls --history < b | grep -q push.*kick/2.*arguments
}

@test "words and quotes are read as the shell does, comments too" {
	sh_ok "pinit two-body | cycle -n 1 '\"push\" kick/2  drift # half a kick
	| pp --softening \"0.1\" # the force
	| push '\"'kick/2'\"'' | diag"
}

@test "a foreign word that does not exist is named" {
	pinit two-body > a
	run -2 bash -c "cycle -n 1 'no-such-word | push kick drift' < a > b"
	[[ $output == "cycle: no word 'no-such-word'"* ]]
	run -2 bash -c "cycle -n 1 'poison-fft | push kick drift' < a > b"
	[[ $output == *"did you mean poisson-fft?"* ]]
	[ "${#lines[@]}" -eq 1 ]
}

@test "a sentence without a push is refused, not run for ever" {
	pinit two-body > a
	run -2 bash -c "cycle -n 1 'pp --replace' < a > b"
	[[ $output == *"no word that completes a step"* ]]
}

@test "a force that is there at the beginning and dropped behind every step is computed again for the next" {
	pinit two-body | pp >start
	cycle -q -n 3 "push kick/2 drift | pp | push kick/2 | sel --drop acc" <start >dropped
	cycle -q -n 3 "push kick/2 drift | pp | push kick/2" <start | sel --drop acc | stab --plain | cmp - <(stab --plain dropped)
}

@test "a word between the force and push that drops the force is named: no priming brings it back" {
	pinit lamb-oseen --cells 16 >a
	for word in walk remesh; do
		for engine in fused pipes; do
			run -2 --separate-stderr cycle -q --engine $engine -n 1 "p2m | poisson-fft | mgrad | m2p | $word | push lsrk3" <a
			[[ $stderr == "cycle: step 1: '$word' between the force and 'push lsrk3' drops what the force computed"*"behind the last push"* ]]
		done
		cycle -q -n 1 "p2m | poisson-fft | mgrad | m2p | push lsrk3 | $word" <a >b
		cycle -q -n 1 "$word | p2m | poisson-fft | mgrad | m2p | push lsrk3" <a >b
	done
}

@test "what cannot be part of a sentence is refused before input is read" {
	for word in 'sls' 'pinit plummer' 'cycle -n 1 pp' '' 'pp | | push kick' "pp 'open" 'pp --sofening 1'; do
		run -2 bash -c "cycle -n 1 \"$word\" < /dev/null > b"
		[ "${#lines[@]}" -eq 1 ]
		head -c 64 b | grep -q '^PMPIPE/1 abort 2 '
	done
}

@test "a number of steps, a time or a condition is required" {
	run -2 bash -c "cycle 'pp' < /dev/null > b"
	[[ $output == *"how long"* ]]
}

@test "a failure inside names the step and the stage, and is passed on" {
	pinit two-body > a
	for engine in fused pipes; do
		run -1 bash -c "set -o pipefail; cycle -n 3 --engine $engine 'push kick/2 drift | push kick/2' < a | diag"
		[[ $output == *"cycle: step 1: push"*"no field 'acc'"* ]]
		[[ $output == *"diag: stopped by cycle: step 1"* ]]
	done
}

@test "a value that is not finite stops the run with exit 3, step and stage named" {
	for engine in fused pipes; do
		run -3 bash -c "pinit two-body | cycle -n 50 --engine $engine 'push --unsafe kick/2 drift --dt 1e200 | pp | push kick/2' > b"
		[[ $output == *"cycle: step "*"push"*"not finite"* ]]
		tail -c 512 b | grep -q 'PMPIPE/1 abort 3'
		counted 1
	done
}

@test "SIGTERM: the step is completed, a checkpoint written, the stream aborted; --resume ends in the same bytes" {
	pinit plummer -n 4000 --no-history > a
	cycle --no-history -n 120 --checkpoint c "$leap" < a > b 2> err &
	pid=$!
	sleep 0.3
	kill -TERM $pid
	wait $pid && status=0 || status=$?
	if [ $status -ne 0 ]; then # a fast machine may have finished already
		grep -q 'stopped by signal 15 after step' err
		tail -c 512 b | grep -q 'PMPIPE/1 abort 1'
		cycle --no-history -n 120 --resume c "$leap" > rest
	else cp b rest; fi
	cycle --no-history -n 120 "$leap" < a > want
	same_as rest want
}

@test "the timing file has a line for every stage" {
	pinit two-body | cycle -n 3 --timing t "$leap" > b
	[ "$(wc -l < t)" -eq 4 ]
	cut -f1 t | grep -q '^push kick/2 drift$'
}

@test "the forces are not counted twice: pp after cycle is refused" {
	run -1 bash -c "set -o pipefail; pinit two-body | cycle -n 2 '$leap' | pp > b"
	[[ $output == *"already holds the term 'self'"* ]]
}

@test "a sentence that is out of step with itself is refused, not run for ever" {
	pinit two-body > a
	run -2 bash -c "timeout 10 cycle -n 3 'push drift | pp | push kick' < a > b"
	[[ $output == *"drift --open"* ]]
	sh_ok "cycle -n 3 'push drift --open | pp | push kick' < a | diag"
	run -2 bash -c "timeout 10 cycle -n 3 'pp | push euler | pp | push euler' < a > b"
	[[ $output == *"completes 2 steps"* ]]
}

@test "words that leave frames out, and files inside a sentence, are refused in both engines" {
	pinit two-body > a
	for engine in fused pipes; do
		run -2 bash -c "timeout 10 cycle -n 2 --engine $engine 'sel --every 2 | pp | push rk2' < a > b"
		[[ $output == *"leaves frames out"* ]]
		run -2 bash -c "timeout 10 cycle -n 2 --engine $engine 'pp -i a | push rk2' < a > b"
		[[ $output == *"belong to cycle itself"* ]]
		run -2 bash -c "timeout 10 cycle -n 2 --engine $engine 'phase --help x y z vx vy vz | push rk2' < a > b" # more arguments than it takes
		[[ $output == *"belong to cycle itself"* ]]
	done
}

@test "a checkpoint that cannot be written is refused before anything is computed" {
	pinit two-body > a
	run -2 bash -c "cycle -n 2 --checkpoint /dev/null '$leap' < a > b"
	[[ $output == *"is not a file"* ]]
	run -1 bash -c "cycle -n 2 --checkpoint nowhere/c '$leap' < a > b"
	[ -c /dev/null ]
}

@test "fused and piped agree where a uniform field is stored as f32" {
	pinit uniform -n 200 --cells 8 --dispersion 0.1 --no-history > a
	for engine in fused pipes; do
		cycle --no-history -n 2 --engine $engine 'push drift | p2m -n 16 | smod --store f32' < a | cksum
	done | sort -u > sums
	[ "$(wc -l < sums)" -eq 1 ]
}

@test "a foreign stage that dies is named, with how it ended, in both engines" {
	pinit two-body > a
	printf '#!/bin/sh\nhead -c 300 >/dev/null\nexit 7\n' > seven
	printf '#!/bin/sh\nkill -9 $$\n' > nine
	chmod +x seven nine
	for engine in fused pipes; do
		run -1 bash -c "timeout 10 cycle -n 2 --engine $engine './seven | pp | push rk2' < a > b"
		[[ $output == *"'./seven' ended with status 7"* && ${#lines[@]} -eq 1 ]]
		run -1 bash -c "timeout 10 cycle -n 2 --engine $engine './nine | pp | push rk2' < a > b"
		[[ $output == *"'./nine' was killed by signal 9"* ]]
		counted 2
	done
}

@test "--until stops at the first step where it is true, in both engines, and reports this in the tail" {
	pinit cold-sphere -n 100 > a
	words='push kick/2 drift | pp --potential | push kick/2'
	cycle -n 500 --every 1 "$words" < a | diag --columns step,virial_ratio > table
	first=$(awk 'NR > 1 && $2 > 1 { print $1; exit }' table)
	[ "$first" -gt 100 ]
	cycle -n 500 --until 'virial_ratio > 1' --no-history "$words" < a > b
	cycle -n 500 --until 'virial_ratio > 1' --no-history --engine pipes "$words" < a > c
	same_as b c
	[ "$(sls --report --format json < b | jq -c '[.step, .report.cycle.until]')" = "[$first,1]" ]
	[ "$(cycle -n 5 --until 'virial_ratio > 1' "$words" < a | sls --report --format json | jq -c '[.step, .report.cycle.until]')" = "[5,0]" ]
	[ "$(cycle --until 'virial_ratio > 1' --every 100 "$words" < a | steps_of)" = "0 100 $first " ]
}

@test "--until: NAME0 is the value at the beginning, of radii and modes NAME_0, also after resume" {
	pinit cold-sphere -n 100 > a
	words='push kick/2 drift | pp --potential | push kick/2'
	cycle -n 500 --every 1 "$words" < a | diag --columns step,energy_field_pair --radii 0.5 > table
	want=$(awk 'NR == 2 { w = $2; r = $3 } NR > 2 && $2 < 1.5*w && $3 < 0.6*r { print $1; exit }' table)
	until='energy_field_pair < 1.5*energy_field_pair0 && radius_0.5 < 0.6*radius_0.5_0'
	cycle -n 500 --until "$until" "$words" < a > b
	[ "$(steps_of < b)" = "$want " ]
	cycle -n 50 --until "$until" --checkpoint c "$words" < a > d
	cycle -n 500 --until "$until" --resume c "$words" > e
	same_as b e
	[ "$(cycle -n 9 --until 'step == step0' "$words" < a | steps_of)" = "0 " ] # true at the beginning: no step
	[ "$(cat b | cycle -n 9 --until 'step >= step0 + 3' "$words" | steps_of)" = "$((want + 3)) " ]
}

@test "--until takes up a checkpoint that was made without it, unless it asks for the beginning; what was the beginning stays it" {
	pinit cold-sphere -n 100 > a
	words='push --dt 0.01 kick/2 drift | pp | push kick/2' # no potential in the frame: the energy is summed over pairs
	cycle --no-history -n 500 --until 'virial_ratio > 1' "$words" < a > b
	cycle --no-history -n 5 --checkpoint c "$words" < a > /dev/null
	cycle --no-history --resume c --until 'virial_ratio > 1' -n 20 --checkpoint d "$words" > /dev/null
	cycle --no-history --resume d --until 'virial_ratio > 1' "$words" > e
	same_as b e
	# at step 20 the ratio is not the initial one, and must not be used as such
	run --separate-stderr cycle --no-history --resume d --until 'virial_ratio > virial_ratio0 + 0.5' "$words"
	[ "$status" = 2 ]
	[[ $stderr == *"has no value of 'virial_ratio' at the beginning"* ]]
}

@test "--until: a plasma's energy at twice the leapfrog's limit and below" {
	words='push --unsafe --dt {} kick/2 drift | p2m | poisson-fft | mgrad | m2p | push --unsafe kick/2'
	for dt in 1.95 2.05; do
		pinit langmuir -n 512 --cells 32 --amplitude 0.001 | cycle -n 200 --until 'energy > 10*energy0' "${words/\{\}/$dt}" |
			sls --report --format json | jq .report.cycle.until
	done > met
	[ "$(tr '\n' ' ' < met)" = "0 1 " ]
}

@test "--until refuses what it cannot read or measure, in words" {
	pinit two-body > a
	fails() { run --separate-stderr cycle -n 3 --until "$2" "${3:-$leap}" < a; [ "$status" = "$1" ] && [[ $stderr == *"$4"* ]]; }
	fails 2 'energyy > 1' '' "no column 'energyy'"
	fails 2 'energy >' '' 'the expression stops here'
	fails 2 'energy, time' '' 'one expression'
	fails 1 'omega_max > 1' '' "'omega_max' cannot be computed"
	fails 1 'mode_1 > 1' '' 'periodic in x'
	cycle -n 1 --checkpoint c "$leap" < a > /dev/null
	run --separate-stderr cycle -n 3 --resume c --until 'energy > energy0' "$leap"
	[ "$status" = 2 ]
	[[ $stderr == *"has no value of 'energy' at the beginning"* ]]
	# the energy of a direct sum that leaves no potential behind is summed; in a periodic box it is not there
	cycle -n 3 --until 'energy > 0' "$leap" < a > /dev/null
	pinit langmuir -n 64 --cells 8 > a
	fails 1 'energy > 0' 'p2m | poisson-fft | mgrad | m2p | push rk4' "the column 'energy' cannot be computed"
}

@test "--until ends where diag's table of every step first says so: two sets of bodies, a plasma, vortices that walk or diffuse; both engines" {
	stack <(pinit plummer -n 40 | smod --rename matter=stars) <(pinit plummer -n 30 --seed 4 | smod --rename matter=gas | smove --shift 3,0,0) >bodies
	pinit langmuir -n 256 --cells 32 --dt 0.02 >plasma
	pinit lamb-oseen --cells 24 >vortex
	# scene, sentence, column, factor of the beginning, and what is added
	for row in "bodies|push --dt 0.02 kick/2 drift | pp | push kick/2|energy_kinetic|1.02|0" \
		"plasma|push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2|speed_rms|1|0.02" \
		"vortex|pp --softening 0.1 | push rk2 | walk|distance_max|1.2|0" \
			"vortex|p2m | poisson-fft | mgrad | diffuse | m2p | push lsrk3 | remesh|angular_impulse|0.5|-0.02"; do
		read -r name factor add < <(awk -F'|' '{ print $(NF - 2), $(NF - 1), $NF }' <<<"$row")
		scene=${row%%|*} words=${row#*|} words=${words%|"$name"|*}
		sign=$(awk "BEGIN { print $factor < 1 ? \"<\" : \">\" }")
		cycle -n 60 --every 1 "$words" <$scene | diag --columns step,$name >table
		want=$(awk -v f=$factor -v a=$add 'NR == 2 { edge = f * $2 + a } NR > 1 && (f < 1 ? $2 < edge : $2 > edge) { print $1; exit }' table)
		for how in '' '--engine pipes' '--every 7'; do
			got=$(cycle -n 60 $how --until "$name $sign $factor*${name}0 + $add" "$words" <$scene | sls --format json | jq -s '.[-1].step')
			echo "$scene, $name: $got, in the table '$want' ($how)"
			[ "$want" -gt 3 ]
			[ "$want" -lt 60 ]
			[ "$got" = "$want" ]
		done
	done
}

@test "what a frame asks for and the sentence does not do is told once, where plan would put it in: viscosity, a magnetic field, a softening" {
	pinit lamb-oseen --cells 32 >a
	for words in 'p2m | poisson-fft | mgrad | m2p | push lsrk3' 'pp --softening 0.1 | push rk4'; do
		for engine in fused pipes; do
			run --separate-stderr bash -o pipefail -c "cat a a | cycle -n 2 --engine $engine '$words' | sls"
			[ "$status" = 0 ]
			[ "$stderr" = "${stderr_lines[0]}" ]
			[[ $stderr == "cycle: the frame has nu = 0.01, but no word of the sentence acts by it (diffuse, pse, walk): "* ]]
		done
	done
	run --separate-stderr bash -o pipefail -c "pinit exb | cycle -n 20 'push drift' | sls"
	[[ $stderr == *"the frame has a magnetic field B, but no word of the sentence acts by it (boris, boris-tan, relativistic, vay, "* ]]
	[[ $stderr == *"higuera-cary, landau-lifshitz): omega_c dt = 0.1, omega_c T = 2" ]]
	push --help | grep -oE '[a-z-]+/2' | grep -v '^kick' | sort -u >kicks
	[ "$(wc -l <kicks)" -ge 5 ]
	for kick in $(cat kicks); do # every kick that turns velocities
		cycle -n 1 "push $kick drift | m2p | push $kick" < <(pinit exb | smod --constant c=10,radiation_time=0) 2>said >/dev/null
		[ ! -s said ] || { echo "$kick: $(cat said)"; return 1; }
	done
	pinit uniform -n 2000 --box 0,1 --cells 16 --softening 0.1 >soft
	for solver in poisson-fft 'poisson-mg --order 4' 'poisson-relax --tolerance 1e-2'; do
		run --separate-stderr bash -o pipefail -c "cycle -n 1 'push kick/2 drift | p2m | $solver | mgrad | m2p | push kick/2' <soft | sls"
		[[ $stderr == "cycle: the frame has softening = 0.1, but no word of the sentence acts by it (poisson-fft --green plummer, "* ]]
		[[ $stderr == *"): softening/h = 1.6, changes the force by "* && ${#stderr_lines[@]} = 1 ]]
	done
	# done, too small to matter, softening below the cells, nothing asked for; and a foreign word may do anything
	for line in "pinit lamb-oseen --cells 32 | cycle -n 2 'p2m | poisson-fft | mgrad | diffuse | m2p | push lsrk3'" \
		"cycle -n 2 'pp --softening 0.1 | push rk4 | walk' <a" "cycle -n 2 'pp --softening 0.1 | cat | push rk4' <a" \
		"pinit lamb-oseen --cells 32 --dt 1e-5 | cycle -n 1 'p2m | poisson-fft | mgrad | m2p | push lsrk3'" \
		"cycle -n 1 'push kick/2 drift | p2m | poisson-fft --green plummer | mgrad | m2p | push kick/2' <soft" \
		"cycle -n 1 'push kick/2 drift | p2m | cat | poisson-fft | mgrad | m2p | push kick/2' <soft" "cycle -n 1 'push drift' <soft" \
		"pinit plummer | cycle -n 20 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'" \
		"pinit plummer -n 1000 | cycle -n 2 'push kick/2 drift | p2m -n 32 | poisson-fft | mgrad | m2p | push kick/2'"; do
		run --separate-stderr bash -o pipefail -c "$line | sls"
		[ "$status" = 0 ]
		[ -z "$stderr" ] || { echo "$line: $stderr"; return 1; }
	done
}
