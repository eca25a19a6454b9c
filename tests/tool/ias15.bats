# push ias15: every way of running it, what it refuses, the clock of its steps. Its accuracy: tests/physics/integrators.bats, tests/hard/kepler.bats.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

words='pp | push ias15 --tolerance 1e-7'

# three bodies that meet, with a first step that is too long, beside a set of test particles
start() {
	local law='--law gravity --constant G=1,softening=0.01 --dt 3 --no-history'
	printf 'x y z vx vy vz mass\n1 3 0 0 0 0 3\n-2 -1 0 0 0 0 4\n1 -1 0.1 0 0 0 5\n' | stab - $law >bodies
	printf 'x y z vx vy vz mass\n2 0 1 0 1 0 0\n0 2 1 1 0 0 0\n' | stab - $law | smod --rename matter=dust --no-history | sel --set dust --no-history >dust
	stack --no-history bodies dust
}

@test "equal bytes: ias15 in a shell loop of passes, fused, as processes, with 1 and 3 threads, resumed, and from the middle of a rejected step" {
	start >now
	run -0 cycle --no-history -n 8 "$words" -i now -o want
	sls --report want >report
	grep -q '"rejected":[1-9]' report
	for threads in 1 3; do
		for engine in fused pipes; do
			OMP_NUM_THREADS=$threads cycle --no-history -n 8 --engine $engine "$words" <now >got
			same_as want got
			OMP_NUM_THREADS=$threads cycle --no-history -n 3 --checkpoint c --engine $engine "$words" <now >got
			OMP_NUM_THREADS=$threads cycle --no-history -n 8 --resume c --engine $engine "$words" >got
			same_as want got
		done
	done
	cp now here
	for i in $(seq 45); do # passes; the first step has more than that, with its rejection
		pp --no-history <here | push ias15 --tolerance 1e-7 --no-history >next
		mv next here
		[ $i != 4 ] || cp here middle
	done
	grep -aq '"substep":45' here
	sls --report here | grep -q '"rejected":1'
	for f in middle here; do
		cycle --no-history -n 8 "$words" <$f >got
		same_as want got
	done
}

@test "ias15 says what it cannot do, in a line each" {
	pinit uniform -n 3 | smod --particle-faces reflect >a
	run -1 bash -o pipefail -c "field 'acc = 0, 0, 0' <a | push ias15 -o b"
	[[ $output == *'ias15 follows a smooth path, and the box has faces that reflect particles (smod --particle-faces open, or push rk4)'* ]]
	smod --particle-faces absorb <a >b
	run -1 bash -o pipefail -c "field 'acc = 0, 0, 0' <b | push ias15 -o c"
	[[ $output == *'and the box has faces that absorb particles (smod --particle-faces open, or push rk4)'* ]]
	printf 'x y vx mass\n1 2 0 1\n2 1 0 1\n' | stab - --dt 0.1 | field 'acc = -x' >a
	run -1 push ias15 -i a -o b
	[[ $output == *"'acc' on 'matter' has 1 components, and 'x' 2: ias15 needs the rate of every position"* ]]
	pinit exb -n 2 | m2p >a
	run -1 push ias15 -i a -o b
	[[ $output == *"has a magnetic field, which ias15 would leave out"* ]]
	pinit plummer -n 3 | pp >a
	run -2 push ias15 --dt 0.1 -i a -o b
	[[ $output == *'ias15 chooses its steps (smod --dt before it gives the first one, --min and --max limit them; with --tolerance 0 all are --dt)'* ]]
	run -2 push rk4 --tolerance 1e-6 -i a -o b
	[[ $output == *'--tolerance belongs to a scheme that chooses its steps by their error (push ias15, rk45, rk23, rk4-double, midpoint-double)'* ]]
	run -2 push ias15 --min 2 --max 1 -i a -o b
	[[ $output == *'--min 2 is above --max 1'* ]]
	stack a <(pinit plummer -n 3 | smod --rename matter=others) | pp >b
	run -1 push ias15 --set matter -i b -o c
	[[ $output == *"ias15 moves all sets together, and 'others' is left out (without --set; or fix it with smod --fixed)"* ]]
	run -1 bash -o pipefail -c "cycle -n 1 --store f32 'push kick/2 drift | pp | push kick/2' <a | push clear | pp | push ias15 -o b"
	[[ $output == *"is in single precision, which ias15 cannot use"* ]]
	push ias15 <a | sel --drop q_v | pp >b
	run -1 push ias15 -i b -o c
	[[ $output == *"no register 'q_v' on 'matter' after 1 passes of ias15"* ]]
	run -1 push rk4 -i <(push ias15 <a | pp) -o c
	[[ $output == *'while ias15 is under way'* ]]
	start | pp | push ias15 >a
	edited '0,/"stage":1/s//"stage":8/' a | pp >b
	run -1 push ias15 -i b -o c
	[[ $output == *"'matter' claims node 8 of ias15, which has 8"* ]]
	edited '0,/"stage":1/s//"stage":2/' a | pp >b
	run -1 push ias15 -i b -o c
	[[ $output == *"'matter' is at node 2 of a step of ias15, 'dust' at node 1 (start the step anew from a frame at substep 0)"* ]]
}

@test "rates that are not smooth end a run of ias15 with exit 3, or are passed by --min, whose steps are counted" {
	printf 'x v mass\n-1 0 1\n' | stab - --law free --dt 0.3 >a
	fall="field 'acc = x > 0 ? -1 : 1'"
	run -3 bash -o pipefail -c "cycle -t 3 \"$fall | push ias15\" <a | sls"
	[[ $output == *'ias15 would need steps of '*'the rates are not smooth there (bodies that meet, a coarse mesh; a softening, push rk4, a '* ]]
	cycle -t 3 "$fall | push ias15 --min 1e-3" <a 2>err | sls --report >report
	grep -q '"below_min":[1-9]' report
}

@test "ias15 and the end of a run: --exact ends there, also after a rejection; a step is at most --max; with --tolerance 0 all are dt" {
	pinit kepler --dt 50 >a
	cycle -t 2 --exact 'pp | push ias15' <a >b
	sls b >text
	grep -q '^frame 1: time 2 ' text
	pinit kepler >a
	cycle -t 2 --exact --every 1 'pp | push ias15 --max 0.02' <a | diag --columns time |
		awk 'NR > 2 { d = $1 - last; if (d > m) m = d } { last = $1 } END { print m, last }' >steps
	below "$(cut -d' ' -f1 steps)" 0.0200000001
	[ "$(cut -d' ' -f2 steps)" = 2 ]
	cycle -n 7 'pp | push ias15 --tolerance 0 --dt 0.125' <a | sls >text
	grep -q '^frame 1: time 0.875 step 7 substep 0 dt 0.125 ' text
}
