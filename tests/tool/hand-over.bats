#!/usr/bin/env bats
# Words joined by a pipe hand their fields over as memory (docs/stream.md); the bytes are those of copies, alone, in cycle, and with programs between that
# know nothing of it. Fields here are above the 64 KiB from which that is done. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

both_ways() {
	local want got
	want=$(PM_HANDOVER=0 bash -o pipefail -c "$1" | cksum)
	got=$(bash -o pipefail -c "$1" | cksum)
	[ "${want##* }" -gt 500000 ]
	[ "$got" = "$want" ] || { echo "handed over: $got, copied: $want: $1"; return 1; }
}

@test "handed over or copied, a pipe of words gives the same bytes" {
	pinit uniform -n 20000 --no-history > start.pm
	both_ways 'pinit uniform -n 20000 | p2m -n 24 | poisson-fft | mgrad | m2p | push kick drift'
	both_ways 'p2m -n 24 < start.pm | cat | poisson-fft | tee copy.pm | mgrad | m2p | cat | push kick drift'
	both_ways '{ pinit uniform -n 20000 --seed 2; cat start.pm; pinit uniform -n 10000; } | push drift'
	both_ways 'stack <(push drift < start.pm) <(pinit uniform -n 9000 | push drift)'
	both_ways 'pinit uniform -n 30000 | sel --where "x < 0.4" | ssort | push drift'
}

@test "many writers one after the other on a pipe, of fields too small to be handed over and of large ones, keep nobody waiting" {
	for n in 200 20000; do
		timeout 20 bash -c "for k in 0 1 2 3 4 5; do pinit uniform -n $n | smod --time \$k; done | stab | grep -c time" >seen
		[ "$(cat seen)" -ge 6 ]
	done
	# the first gives nothing, so that nobody takes up its connection; those that follow do
	both_ways 'for n in 200 200 200 200 20000 200 30000; do pinit uniform -n $n --no-history; done | push drift'
}

@test "memory of fields that grow from frame to frame is given up by the next word, with its descriptors" {
	for k in {1..40}; do pinit uniform -n $((9000 + 700 * k)) --no-history; done > grows.pm
	PM_HANDOVER=0 bash -o pipefail -c 'push drift < grows.pm | push drift' > want.pm
	(ulimit -n 48; push drift < grows.pm | push drift > seen.pm)
	cmp want.pm seen.pm
}

@test "processes of cycle give the bytes of the fused run, with foreign words among them" {
	pinit uniform -n 20000 --no-history > start.pm
	local step='push kick/2 drift | p2m -n 24 | poisson-fft | mgrad | m2p | push kick/2'
	local foreign=${step/24/24 | cat} # reads and writes the plain stream
	cycle -q -n 3 --no-history "$step" < start.pm > fused.pm
	for words in "$step" "$foreign"; do
		for hand in 0 1; do
			PM_HANDOVER=$hand cycle -q -n 3 --no-history --engine pipes "$words" < start.pm > pipes.pm
			cmp fused.pm pipes.pm
		done
	done
}

@test "a failure among processes that hand over is said once, with its place and status" {
	pinit uniform -n 20000 > start.pm
	for hand in 0 1; do
		PM_HANDOVER=$hand run -3 bash -c "
			cycle -q -n 3 --engine pipes 'push drift/2 | field acc=1/(time-0.015),0,0 | push kick drift/2' < start.pm 2>&1 > /dev/null"
		[ "${#lines[@]}" = 1 ]
		[[ "$output" == *'step 2: field: frame 2: '*"'acc' of 'matter' is not finite"* ]]
	done
}
