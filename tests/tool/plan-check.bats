# plan --check: every choice of a sentence against the next one, and what chaos leaves. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

leapfrog='kick/2 drift | pp | push kick/2'

# row CHOICE < table: difference and error, from the columns' end since the changes have blanks
row() { awk -v c="$1" '$1 == c { print substr($0, 47, 10) + 0, substr($0, 58, 10) + 0 }'; }
# proposed < table
proposed() { grep -A 1 '^# this one passes' | tail -n 1; }

@test "plan --check: a step too long exits 3 with the error that the run has, and the sentence it proposes passes when tested and is right when run" {
	turn=6.283185307179586 # the bodies come back
	pinit two-body >start
	run -3 plan --check -t $turn --instead "push --dt 0.0314159265358979 $leapfrog" --accuracy 1e-4 <start
	[[ $output == *"more than the accuracy 0.0001: by the step"* ]]
	printf '%s\n' "$output" >table
	cycle -t $turn "push --dt 0.0314159265358979 $leapfrog" <start >end
	true=$(scmp --set matter --field x end start | awk 'NR == 2 { print $8 }')
	read -r _ error < <(row step <table)
	within "$error" "$true" "$(awk "BEGIN { print 0.05 * $true }")" "the error of the places" # 2 digits are printed
	better=$(proposed <table)
	run -0 plan --check -t $turn --instead "$better" --accuracy 1e-4 <start
	cycle -t $turn "$better" <start >end
	scmp --set matter --field x --tolerance 1e-4 end start
}

@test "plan --check: places are measured from a sun that does not move, and a step by the force stands behind the force in another scheme" {
	turn=6.283185307179586
	pinit kepler --eccentricity 0.99 >start
	plan --check -t $turn <start >table
	cycle -t $turn "$(plan -t $turn --sentence <start)" <start >end
	true=$(scmp --set matter --field x end start | awk 'NR == 2 { print $8 }')
	error=$(sed -n 's/^# error \([^ ]*\) +- .*: pass$/\1/p' table)
	within "$error" "$true" "$(awk "BEGIN { print 0.1 * $true }")" "the error of the places" # one digit may be printed
	grep -qE '^scheme +leapfrog -> blanes-moan4 +[0-9]' table
}

@test "plan --check: a mesh too coarse exits 3, and the sentence it proposes has the right velocities" {
	pinit langmuir >start
	run -3 plan --check --instead 'push kick/2 drift | p2m -n 8 | poisson-fft | mgrad | m2p | push kick/2' <start
	[[ $output == *"by the mesh"* ]]
	printf '%s\n' "$output" >table
	better=$(proposed <table)
	[[ $better == *"p2m --cells "* ]]
	cycle -t 10 "$better" <start >end
	scalc 'v = -0.05*sin(2*pi*(id + 0.5)/4096)*sin(time)' <end >right # cold: each sheet swings by itself
	scmp --set electrons --field v --tolerance 0.01 end right
	run -0 plan --check --instead "$better" <start
}

@test "plan --check: a pericentre within the run is run through, and not continued from a quiet part" {
	pinit kepler --eccentricity 0.99 >start
	run -3 plan --check --instead "push --dt 0.002 $leapfrog" -t 6.283185307179586 <start
	[[ $output == *"over the whole run, 3142 steps"* ]]
	run -0 plan --check --instead "push --dt 0.002 $leapfrog" -t 0.3 <start # half of it from the apocentre ... before any of that
}

@test "plan --check: the noise of a sample is its error, and no sentence cures it" {
	pinit landau -n 512 >start
	run -3 plan --check --instead 'push kick/2 drift | p2m | poisson-fft | mgrad --order 4 | m2p | push kick/2' --accuracy 0.001 <start
	[[ $output == *"no sentence was found that passes: "*"particles"* ]]
}

@test "plan --check --format json: one object with effects, choices and the sentence that passes" {
	pinit two-body >start
	plan --check --instead "push --dt 0.2 $leapfrog" --format json <start >found || [ $? = 3 ]
	[ "$(jq -r '.trial.verdict' found)" = fail ]
	[ "$(jq -r '.proposed.verdict' found)" = pass ]
	[ "$(jq -r '[.trial.choices[].choice] | join(",")' found)" = 'step,scheme,last bit' ]
	[ "$(plan --check --format json <start | jq '.effects | length')" -ge 1 ]
	run -2 plan --instead "push $leapfrog" <start
	[[ $output == *"--instead belongs to --check"* ]]
}

@test "plan refuses an accuracy that chaos forbids, says so first, and until when it can be had" {
	pinit plummer -n 200 >start
	run -3 --separate-stderr plan --no-cost -t 50 <start
	[[ "${lines[0]}" == "# accuracy 0.01 of x refused: rounding and chaos forbid it after t = "* ]]
	[[ $stderr == *"accuracy 0.01 of x refused"* ]]
	until=$(sed -n 's/.*after t = \([0-9.]*\):.*/\1/p' <<<"${lines[0]}")
	words=$(plan --sentence -t 50 <start 2>/dev/null) || [ $? = 3 ]
	# where it ends the words give the same places, and at the end others
	for t in "$until" 50; do
		cycle -t "$t" "$words" <start >a
		perturb --seed 7 <start | cycle -t "$t" "$words" >b
		scmp --set matter --field x a b | awk 'NR == 2 { print $8 }'
	done >parted
	awk 'NR == 1 && $1 > 0.05 || NR == 2 && $1 < 0.05 { exit 1 }' parted # the other seed parts a little earlier or later
	run -0 plan --no-cost -t 10 <start
	[[ $output != *refused* ]]
	run -0 --separate-stderr cycle -t 50 --plan -o end <start
	[[ $stderr == *"refused: rounding and chaos"* ]]
}
