# The time of a frame: since.time + (step - since.step) dt, not a sum of steps. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

body() { printf 'x vx\n0 1\n' | stab - --law free --dt 0.1; }
times() { diag | column time; }
# since FILE [FRAME]: `time step` of the header's since, or none.
since() {
	wire header "$@" | python3 -c 'import json, sys; s = json.load(sys.stdin).get("since"); print(*((s["time"], s["step"]) if s else ["none"]))'
}
# clock FILE: the time after the next step, and its own time and step.
clock() { wire header "$1" | python3 -c 'import json, sys; h = json.load(sys.stdin); print(h["time"] + h["dt"], h["time"], h["step"])'; }

# A sum of 0.1 is off by 4e-10 here, and by 1.3e-6 after a million steps (tests/unit/push.c).
@test "20 000 steps of 0.1 end at exactly 2000, by -n and by -t" {
	[ "$(body | cycle -n 20000 'push drift' | times)" = 2000 ]
	[ "$(body | cycle -t 2000 'push drift' | times)" = 2000 ]
	[ "$(body | push --dt -0.1 drift | cycle -t -2000 'push drift' | times)" = -2000 ]
}

# The sum of eight steps of 0.1 is 0.79999999999999993.
@test "--until sees the time of the formula" {
	[ "$(body | cycle -n 99 --until 'time >= 0.8' 'push drift' | diag | column step)" = 8 ]
}

@test "the header says since when dt has been the same" {
	body >a.pm
	[ "$(since a.pm)" = none ]
	cycle -n 3 'push drift' <a.pm >b.pm
	[ "$(since b.pm)" = "0.0 0" ]
	cycle -n 2 'push --dt 0.25 drift' <b.pm >c.pm
	[ "$(since c.pm)" = "0.30000000000000004 3" ]
	[ "$(times <c.pm)" = 0.80000000000000004 ]
	cycle -n 2 'push --dt 0.25 drift' <c.pm >d.pm
	[ "$(since d.pm)" = "0.30000000000000004 3" ]
	cycle -n 1 'push drift --dt 0.1' <d.pm >e.pm
	[ "$(since e.pm)" = "1.3 7" ]
}

@test "smod --time, --step and --dt begin anew" {
	body | cycle -n 3 'push drift' >b.pm
	for change in '--time 7' '--step 12' '--dt 0.25' '--dt 0.1'; do
		smod $change <b.pm >c.pm
		[ "$(since c.pm)" = none ]
		push drift <c.pm >d.pm
		[ "$(clock d.pm | cut -d' ' -f2) $(since d.pm)" = "$(clock c.pm)" ] || { echo "$change: $(since d.pm), wanted $(clock c.pm)"; return 1; }
	done
}

@test "a program that sets time, dt or step and does not know of since need not" {
	body | cycle -n 3 'push drift' >b.pm
	for edit in 'h["time"] = 7.0' 'h["dt"] = 0.25' 'h["step"] = 12'; do
		wire edit b.pm "$edit" >c.pm
		[ "$(since c.pm)" = "0.0 0" ]
		push drift <c.pm >d.pm
		wire edit d.pm 'assert h["time"] == h["since"]["time"] + h["dt"] and h["since"]["step"] == h["step"] - 1, h' >/dev/null
		wire edit c.pm 'del h["since"]' | push drift | cmp - d.pm
	done
	push drift/2 <b.pm >c.pm # inside a step it is start that counts
	[ "$(since c.pm)" = "0.0 0" ]
	wire edit c.pm 'h["start"], h["time"] = 7.0, 7.05' | push drift/2 >d.pm
	[ "$(clock d.pm | cut -d' ' -f2-) $(since d.pm)" = "7.1 4 7.0 3" ]
	for edit in '= 3' '= {"time": 0}' '= {"time": "0", "step": 0}' '= {"time": 0.0, "step": -1}' '= {"time": 0.0, "step": 0.5}'; do
		wire edit b.pm "h['since'] $edit" >c.pm
		run -1 --separate-stderr sls -i c.pm
		[[ $stderr == *since* ]] || { echo "$edit: $stderr"; return 1; }
	done
}

# dt changes at every step, by rules, by hand, and there and back between two pushes.
@test "after resume, in every engine and in a shell loop the times are the same bytes where dt changes" {
	pinit plummer -n 20 --seed 3 --no-history | pp >a.pm
	for words in 'dt --acceleration 0.03 | push kick/2 drift | pp | push kick/2' 'push --dt 0.1 kick/2 drift | pp | push kick/2' \
		'smod --dt 0.05 | smod --dt 0.1 | push kick/2 drift | pp | push kick/2' 'push rk4 | pp' \
		'push --dt 0.1 kick/2 drift/3 | push drift/3 | push drift/3 | pp | push kick/2'; do
		cycle --no-history -n 7 "$words" <a.pm >fused.pm
		cycle --no-history -n 7 --engine pipes "$words" <a.pm | cmp - fused.pm
		cycle --no-history -n 3 --checkpoint c.pm "$words" <a.pm >/dev/null
		cycle --no-history -n 7 --resume c.pm "$words" | cmp - fused.pm
		cp a.pm loop.pm
		until [ "$(wire header loop.pm | jq .step)" = 7 ]; do
			bash -o pipefail -c "${words//|/--no-history |} --no-history" <loop.pm >next.pm
			mv next.pm loop.pm
		done
		cmp loop.pm fused.pm
	done
}

@test "text, HDF5 and their way back keep since, between steps and inside" {
	body | cycle -n 3 'push drift' >b.pm
	pinit two-body | cycle -n 3 'pp | push rk4' | pp | push rk4 >inside.pm
	[ "$(since inside.pm)" = "0.0 0" ]
	for f in b.pm inside.pm; do
		stab <$f | stab - | cmp - $f
		sh5 -i $f -o f.h5
		sh5 f.h5 | cmp - $f
		sel <$f | cmp - <(sel <$f | sel)
	done
	wire edit inside.pm 'assert h["substep"] == 1 and h["start"] == 3 * h["dt"], h' >/dev/null
	pp <inside.pm | push rk4 | pp | push rk4 | pp | push rk4 >d.pm
	wire edit d.pm 'assert h["step"] == 4 and h["time"] == 4 * h["dt"], h' >/dev/null
}

@test "a checkpoint without since goes on from its own time" {
	cycle -n 12 --resume "$top/tests/reference/unsealed-checkpoint.pm" 'push --dt 0.1 kick/2 drift | pp | push kick/2' >late.pm
	[ "$(since late.pm)" = "0.7999999999999999 8" ]
	[ "$(times <late.pm)" = 1.2 ]
}

@test "scenes put together go on from the time they share" {
	body | cycle -n 3 'push drift' >b.pm
	body | smod --dt 0.05 | cycle -n 6 'push drift' >c.pm
	stack b.pm c.pm >d.pm
	[ "$(since d.pm)" = none ]
	wire edit d.pm 'assert h["dt"] == 0.05 and h["step"] == 3, h' >/dev/null
	[ "$(push drift <d.pm | times)" = 0.35000000000000003 ]
}

@test "cycle -t --exact ends at exactly that time by a shorter last step, and dt is what it was" {
	for t in 0.01 0.25 1.004 100.04; do
		body | cycle -t $t --exact 'push drift' >a.pm 2>err
		[ ! -s err ]
		wire header a.pm | python3 -c 'import json, sys; h = json.load(sys.stdin); assert (h["time"], h["dt"]) == ('$t', 0.1), h'
		# x = t with v = 1, up to the rounding of each of the steps
		within "$(stab --plain <a.pm | column x)" $t "$(awk -v t=$t 'BEGIN { print 2e-16 * t * (t / 0.1 + 1) }')" "position at $t"
	done
	[ "$(since a.pm)" = "none" ]
	[ "$(body | push --dt -0.1 drift | cycle -t -0.75 --exact 'push drift' | times)" = -0.75 ]
	[ "$(cycle -t 200.04 --exact 'push drift' <a.pm | diag | column step)" = 2001 ]
}

@test "--exact gives the same bytes in every engine, in two runs and resumed, also with schemes of several passes and of memory" {
	pinit plummer -n 20 --dt 0.03 >a.pm
	for words in 'push kick/2 drift | pp | push kick/2' 'pp | push rk4' 'pp | push ab2'; do
		cycle -t 0.2 --exact "$words" <a.pm >b.pm
		cycle -t 0.2 --exact --engine pipes "$words" <a.pm | same_as - b.pm
		cycle -n 2 "$words" <a.pm | cycle -t 0.2 --exact "$words" | same_as - b.pm
		cycle -n 4 --checkpoint c.pm "$words" <a.pm >d.pm
		cycle --resume c.pm -t 0.2 --exact "$words" | same_as - b.pm
		cycle -t 0.2 --exact --checkpoint c.pm "$words" <a.pm >d.pm
		cycle --resume c.pm -t 0.2 --exact "$words" | same_as - b.pm # nothing is left to do
	done
}

@test "--exact changes no byte where whole steps reach the end, and is refused without -t and where a word sets dt" {
	body | cycle -t 0.3 'push drift' >a.pm
	body | cycle -t 0.3 --exact 'push drift' | same_as - a.pm
	run -2 cycle -n 3 --exact 'push drift'
	run -2 --separate-stderr cycle -t 1 --exact 'push --dt 0.3 drift' < <(body)
	[[ $stderr == *"'push --dt 0.3 drift' sets dt in every step"* ]]
	run -2 cycle -t 1 --exact 'dt --max 0.3 | push drift' < <(body)
}

@test "cycle says where a run by -t has ended if that is not where it was to end" {
	said() { body | cycle -t "$1" "${@:2}" 'push drift' 2>&1 >/dev/null; }
	[[ $(said 0.01) == 'cycle: ended at time 0 after 0 steps of dt 0.1, not at 0.01: '*--exact* ]]
	[[ $(said 0.09) == 'cycle: ended at time 0.1 after 1 step of dt 0.1, not at 0.09: '* ]]
	[[ $(said 0.26) == 'cycle: ended at time 0.3 after 3 steps of dt 0.1, not at 0.26: '* ]]
	[[ $(said -0.2) == 'cycle: no step: the frame is at time 0, beyond -t -0.2 (-t is the time at the end'* ]]
	[[ $(body | cycle -t 1 'push --dt -0.1 drift' 2>&1 >/dev/null) == *'after 1 step of dt -0.1: it goes back in time, away from -t 1 '* ]]
	# steps that a scheme chooses end anywhere
	said=$(pinit kepler --dt 50 | cycle -t 100 'pp | push ias15' 2>&1 >/dev/null)
	[[ $said == *'cycle: ended at time '*' steps, not at 100: '*'(--exact makes the last one shorter)'* ]]
	[ -z "$(pinit kepler --dt 50 | cycle -t 1 --exact 'pp | push ias15' 2>&1 >/dev/null | grep ended)" ]
	[ -z "$(said 0.3)$(said 20.04)$(said 0.01 -q)$(said 0.01 --exact)$(said 0.26 -n 1)" ]
}
