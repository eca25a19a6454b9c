# cycle --plan --again: the sentence is planned anew during the run. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# A cold sphere that falls together at t = 1.2; softened, so that it collapses as a whole and not in pairs.
sphere() { pinit cold-sphere -n 300 --dt 0.05 --softening 0.1; }
# The relative l2 difference of the places of two files.
places() { scmp --field x "$1" "$2" | awk 'END { print $8 }'; }

@test "a cold sphere through collapse: planned again it is within the accuracy, planned once it is not" {
	sphere >start
	# 0.0002: half of it changes the places by 2.6e-7
	cycle -t 2 'push --dt 0.0002 kick/2 drift | pp | push kick/2' <start >exact
	cycle -t 2 --plan --accuracy 0.03 <start >once
	cycle -t 2 --plan --accuracy 0.03 --again 20 -q <start >again
	within "$(places again exact)" 0 0.03 # 0.005
	above "$(places once exact)" 0.06 # 0.095
	# the step is short only while it has to be: a tenth of the steps that its shortest would need
	[ "$(diag --columns step again | tail -n 1)" -lt 300 ]
}

# Velocities of the first particle.
velocity() { stab "$1" | grep -v '^#' | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i } NR == 2 { print $at["vx"], $at["vy"] }'; }

@test "an electron accelerated past v/c = 0.1: relativity comes in between two decisions, before that it is left out" {
	pinit exb --dt 0.05 | sel --drop B | smod --constant c=2 >start # (q/m) E = -0.1 along y, v = 0.1 along x
	cycle -t 20 --plan <start >once
	cycle -t 20 --plan --again 10 <start 2>said >again
	read -r vx vy < <(velocity once)
	within "$vy" -2 1e-9 # v = a t
	read -r vx vy < <(velocity again)
	# u = gamma v = (0.1/sqrt(1 - 0.0025), -2), v = u/sqrt(1 + u^2/4); the accuracy 0.01 is asked for, 2e-4 is reached: two steps are without it
	within "$vx" 0.0707549 1e-3
	within "$vy" -1.4133283 1e-3
	grep -q '^cycle: step 2, .*relativity comes in, max v/c = 0.097' said
	sed -n 2p again | grep -q '"from step 2: push relativistic/2 drift | m2p | push relativistic/2"'
}

@test "relativistic/2 is exact in a uniform E, turns by Omega/gamma in B as boris does, keeps |v| below c, and refuses what it cannot do" {
	pinit exb | sel --drop B | smod --constant c=2 >straight
	cycle -t 20 'push --dt 0.5 relativistic/2 drift | m2p | push relativistic/2' <straight >a
	read -r vx vy < <(velocity a)
	within "$vx" 0.0707549137677 1e-12 # closed form, as above, of 13 digits; 40 kicks round by 1e-16 each
	within "$vy" -1.41332829558063 1e-12
	pinit gyration --dt 0.05 | smod --constant c=2 | cycle -t 20 'push relativistic/2 drift | m2p | push relativistic/2' >b
	read -r vx vy < <(velocity b) # 400 steps of 2 atan(Omega dt/2 gamma), 1/gamma = sqrt(3/4), that round by 1e-16 each
	within "$vx" 0.03903299404360 1e-12
	within "$vy" -0.99923792230679 1e-12
	run -1 bash -o pipefail -c 'pinit exb | sel --drop B | cycle -n 1 "push relativistic/2 drift | m2p | push relativistic/2"'
	[[ "$output" = *"the frame has no speed of light c (smod --constant c=C, or push kick/2)"* ]]
	run -1 bash -o pipefail -c 'pinit exb | sel --drop B | smod --constant c=0.05 | cycle -n 1 "push relativistic/2 drift | m2p | push relativistic/2"'
	[[ "$output" = *"has the speed 0.1, and c is 0.05"* ]]
}

@test "two vortices that merge: the step gets shorter once, when their strain has grown" {
	two='exp(-((x.x-3.14159-0.8)^2+(x.y-3.14159)^2)/0.1) + exp(-((x.x-3.14159+0.8)^2+(x.y-3.14159)^2)/0.1)'
	pinit ellipse --cells 64 --nu 0 --dt 0.02 | scalc --extensive "circulation = volume*5*($two)" >start
	cycle -t 5 --plan --accuracy 0.05 --again 25 <start 2>said >again
	[ "$(grep -c '^cycle: step 25, time .*: dt [0-9.]* instead of [0-9.]*$' said)" = 1 ]
}

@test "a change is a line on standard error, in the history with its step, in the report, and in the attribute plan" {
	sphere | cycle -t 1.3 --plan --again 20 --every 20 2>said >run
	[ "$(grep -c '^cycle: step [0-9]*, time [0-9.]*: dt [0-9.e-]* instead of [0-9.e-]*$' said)" = "$(wc -l <said)" ]
	sel --frames "$(diag --columns step run | sed 1d | wc -l)" run >last
	sed -n 2p last >header
	first=$(sed -n '1s/^cycle: step \([0-9]*\),.*/\1/p' said)
	grep -q "\"from step $first: push --dt " header
	grep -q "\"changes\":$(wc -l <said)," header
	# one was due by a number of the frame, not by the count of steps
	sed 's/^cycle: step \([0-9]*\),.*/\1/' said | awk '$1 % 20 { n++ } END { exit !n }'
	grep -aq '"cycle":{"changed":"step [0-9]*: dt ' last
}

@test "the same bytes from every engine, with any threads, from a checkpoint at any step, and by again" {
	sphere >start
	cycle -t 1.5 --plan --again 20 -q <start >all
	cycle -t 1.5 --plan --again 20 -q --engine pipes <start | same_as all -
	OMP_NUM_THREADS=1 cycle -t 1.5 --plan --again 20 -q <start | same_as all -
	for n in 20 26 150; do # at a decision, at a change that is due by a number, between two decisions of which the second lengthens the step
		cycle -t 1.5 --plan --again 20 -q --every 1 --checkpoint part --checkpoint-every $n <start 2>/dev/null | head -c $((30000 * n)) >/dev/null
		[ "$(($(diag --columns step part | tail -n 1) % n))" = 0 ]
		cycle --resume part -t 1.5 --plan -q | same_as all -
	done
	sphere | cycle -t 1.5 --plan --again 20 --every 20 -q >run
	again -q run | same_as run -
}

@test "nothing that stays as it is is decided otherwise: a cluster in equilibrium, a plasma wave, vortices that decay" {
	pinit plummer -n 300 --softening 0.05 | cycle -t 5 --plan --again 20 2>said >a
	pinit taylor-green-2d --cells 16 | cycle -t 5 --plan --again 5 2>>said >b
	pinit langmuir -n 256 | cycle -t 10 --plan --again 5 2>>said >c
	[ "$(grep -c instead said)" = 0 ]
	for f in a b c; do sed -n 2p $f | grep -q '"again":[0-9]*,.*"changes":0,'; done
	# what does not stay is decided otherwise: the same cluster at rest
	pinit plummer -n 300 --softening 0.05 | scalc 'v = 0*vx,0*vy,0*vz' | cycle -t 5 --plan --again 20 2>&1 >fallen | grep -q '^cycle: step .* instead of'
	# and the state is that of the sentence that plan makes once
	pinit taylor-green-2d --cells 16 | cycle -t 5 --plan >d
	scmp --tolerance 0 b d
}

@test "decisions in a collapse test no chaos by runs: what is decided often costs a few forces" {
	pinit cold-sphere -n 200 >start
	timeout 30 cycle -t 1.6 --plan --accuracy 0.05 --again 30 <start >end 2>/dev/null # 0.05 s; minutes with two runs for each decision
	[ "$(sls end | grep -c '^frame 1: time 1\.5994')" = 1 ]
}

@test "few bodies whose steps follow their orbits keep their sentence" {
	pinit kepler --eccentricity 0.9 >start
	cycle -t 6 --plan --again 2 --accuracy 1e-3 <start 2>said >again
	cycle -t 6 --plan --accuracy 1e-3 <start >once
	plan --sentence -t 6 --accuracy 1e-3 <start | grep -q 'dt --oscillation'
	[ "$(grep -c instead said)" = 0 ]
	scmp --tolerance 0 once again
}

@test "what --again cannot do is refused" {
	run -2 cycle -n 2 --again 5 'push drift'
	[[ "$output" = *"cycle: --again belongs to --plan"* ]]
	run -2 cycle -t 2 --exact --plan --again 5
	[[ "$output" = *"--exact and --again both choose the step"* ]]
	sphere | cycle -n 2 --plan --checkpoint part >/dev/null
	run -1 bash -o pipefail -c 'cycle --resume part -n 4 --plan --again 5 >x'
	[[ "$output" = *"the attribute 'plan' of the checkpoint"* ]]
}
