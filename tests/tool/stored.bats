#!/usr/bin/env bats
# What cycle writes of a frame: without what mgrad makes again, by choice less, and enough to go on. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

leap='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'

# fields: the mesh fields of the last frame of standard input.
fields() { sls | awk '/^frame/ { n = ""; on = 0 } /^  mesh/ { on = 1; next } /^  [a-z]/ { on = 0 } on && /^    / { n = n " " $1 } END { print n }'; }

@test "cycle leaves out the law's field, and diag prints the same digits without it, for every law and order" {
	pinit uniform -n 300 --cells 8 --no-history >gravity
	pinit two-stream -n 500 --cells 16 --no-history >plasma
	pinit langmuir --dim 2 --axes 2 -n 400 --cells 12 --no-history >plane
	pinit shear-layer --cells 16 --no-history >vortex
	pinit plummer -n 300 --cells 12 --no-history >open # no modes there
	for order in "" 2 4 6 spectral; do
		for law in gravity plasma plane vortex open; do
			[ "$law$order" != openspectral ] || continue
			words="push kick/2 drift | p2m | poisson-fft | mgrad ${order:+--order $order} | m2p | push kick/2" modes="--modes 1,2"
			[ $law != vortex ] || words="push euler | p2m | poisson-fft | mgrad ${order:+--order $order} | m2p"
			[ $law != open ] || modes=
			cycle --no-history -n 3 --every 1 --store all "$words" <$law >whole
			cycle --no-history -n 3 --every 1 "$words" <$law >less
			[[ " $(fields <whole) " == *" "[gEu]" "* ]]
			[[ " $(fields <less) " != *" "[gEu]" "* ]]
			diag $modes <whole >want
			[ $law = open ] || [ "$(column mode_1 <want | grep -c '^[0-9]')" = 4 ]
			[[ $law != pla* ]] || [ "$(column energy_field_x <want | grep -c '^[0-9]')" = 4 ]
			diag $modes <less | cmp - want
		done
	done
	[ "$(cycle -n 1 "$leap" <plasma | fields)" = " rho phi" ]
	[ "$(cycle -n 1 --field x,E "$leap" <plasma | fields)" = " E" ]
}

@test "without mgrad's word on the order diag takes the law's" {
	pinit two-stream -n 500 --cells 16 | p2m | poisson-fft | tee potential | mgrad | diag --modes 1 >want
	diag --modes 1 <potential | cmp - want
	! mgrad --order 4 <potential | diag --modes 1 | cmp -s - want
}

@test "a field that cannot be made again is written: another word's, a given one, one that the sentence uses first, a target of the user's" {
	printf '#!/bin/sh\nexec cat\n' >same
	chmod +x same
	pinit two-stream -n 200 --cells 8 | p2m | poisson-fft | mgrad | m2p >a
	force='p2m | poisson-fft | mgrad' kick='push kick/2 drift'
	for engine in fused pipes; do
		while IFS=@ read -r words want; do
			got=$(cycle --engine $engine -n 2 "$words" <a | fields)
			[ "$got" = "$want" ] || { echo "$engine, $words: got$got, want$want"; return 1; }
		done <<-END
			$kick | $force | m2p | push kick/2@ rho phi
			$kick | $force | scalc --mesh mesh 'E = 2*E' | m2p | push kick/2@ rho phi E
			m2p --replace | push kick drift | $force@ rho phi E
			./same | $kick | $force | m2p | push kick/2@ rho phi E
			$kick | ./same | $force | m2p | push kick/2@ rho phi
			$kick | $force --target own | $force | m2p | push kick/2@ own rho phi
			$kick | $force | mgrad --operator lap --target lap | m2p | push kick/2@ rho phi lap
		END
	done
	[ "$(pinit exb | cycle -n 1 'push boris/2 drift | m2p | push boris/2' | fields)" = " B E" ]
}

@test "a run that goes on from a written frame ends in the same bytes as one run" {
	pinit plummer -n 100 --cells 8 --no-history >a
	pinit shear-layer --cells 16 --no-history >b
	pinit gyration -n 60 --velocities 3 --speed 2 --no-history | sel --drop E --no-history >c
	f='p2m | poisson-fft | mgrad | m2p'
	while read -r scene words; do
		cycle --no-history -n 7 --every 1 "$words" <$scene >whole
		cycle --no-history -n 3 "$words" <$scene | cycle --no-history -n 4 "$words" >late
		sel --last --no-history <whole | cmp - late || { echo "$words"; return 1; }
	done <<-END
		a push kick/2 drift | $f | push kick/2
		a pp | push ab3
		a $f | push rk4
		b p2m | poisson-fft | mgrad | diffuse | m2p | push lsrk3 | remesh
		c push boris/2 drift | $f | push boris/2
	END
}

@test "a checkpoint is whole, whatever is written" {
	pinit plummer -n 50 --cells 4 --no-history >a
	cycle --no-history -n 2 --checkpoint c --drop rho,v --store f32 "$leap" <a | fields | grep -qx ' phi'
	[ "$(fields <c)" = " rho phi g" ]
	sls <c | grep -q '^    v  *3 f64'
	cycle --no-history -n 5 --resume c --store all "$leap" | stab >late
	cycle --no-history -n 5 --store all "$leap" <a | stab | cmp - late
}

@test "--set, --mesh, --field, --drop and --store f32 choose what is written, in both engines as sel and smod do" {
	pinit plummer -n 50 --cells 4 --no-history >a
	cycle --no-history -n 2 --every 1 --store all "$leap" <a >whole
	for engine in fused pipes; do
		cycle --no-history -n 2 --every 1 --engine $engine --set matter --field x,id,matter/acc,g "$leap" <a >got
		sel --no-history --set matter --field x,id,matter/acc,g <whole | cmp - got
		cycle --no-history -n 2 --every 1 --engine $engine --store all --drop mesh,v "$leap" <a >got
		sel --no-history --drop mesh,v <whole | cmp - got
		cycle --no-history -n 2 --every 1 --engine $engine --mesh mesh --store f32,all "$leap" <a >got
		sel --no-history --mesh mesh <whole | smod --no-history --store f32 | cmp - got
	done
}

@test "a name that no frame has is refused after the first step; one that comes with it is none of these" {
	pinit plummer -n 50 --cells 4 >a
	for option in --set --mesh --field --drop; do
		run -1 --separate-stderr timeout 5 cycle -n 1000000000 $option nosuch 'push kick/2 drift | pp | push kick/2' -i a
		[[ $stderr == "cycle: $option: there is no 'nosuch'"* ]]
	done
	cycle -n 2 --every 1 --drop acc 'push euler | pp --potential' <a >b # the first frame has none
	run -2 cycle -n 1 --store f16 "$leap"
}

@test "--checkpoint-every writes checkpoints by steps or by wall time and at the end, apart from --every" {
	pinit two-body --no-history --dt 0.1 >a
	words='push kick/2 drift | pp | push kick/2'
	# The run fails after step 25 (exit 3), so what is there is a checkpoint on the way: of step 20, not of frame 24.
	run -3 cycle --no-history -n 40 --every 4 --checkpoint c --checkpoint-every 10 "$words | scalc 'w = mass*sqrt(2.55 - time)'" -i a -o b
	sls <c | grep -q 'step 20 '
	cycle --no-history -n 40 --resume c "$words" | scmp --field x,v --tolerance 0 - <(cycle --no-history -n 40 "$words" <a) >/dev/null
	cycle --no-history -n 33 --every 4 --checkpoint d --checkpoint-every 10 "$words" <a >b # and at the end
	sls <d | grep -q 'step 33 '
	cycle -n 100000000 --checkpoint e --checkpoint-every 0.3s 'push drift' -i a -o b &
	pid=$!
	for _ in {1..100}; do [ ! -s e ] || break; sleep 0.1; done
	kill -KILL $pid
	wait $pid || true
	[ "$(sls <e | sed -n 's/.* step \([0-9]*\) .*/\1/p')" -gt 0 ]
	for bad in 0 -3 2.5 10x '' 5mm nan 1e; do
		run -2 --separate-stderr cycle -n 1 --checkpoint c --checkpoint-every "$bad" "$words"
		[[ $stderr == "cycle: --checkpoint-every '$bad' (a number of steps, or a time: 30s, 10m, 2h)" ]]
	done
	run -2 cycle -n 1 --checkpoint-every 5 "$words"
}
