# The checksums of lines, headers and tails, and streams of versions that had none. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

# Written by version 0.1.0, before lines had checksums and frames had `since`:
#   unsealed-stream.pm: pinit landau -n 64 --cells 16 --seed 3 | smod --dt 0.1 | cycle -n 8 --every 4 '<leapfrog with mesh words>' | p2m | poisson-mg,
#     and behind it a frame half-way through a step: pinit two-body | pp | push rk4 | pp | push rk4
#   unsealed-checkpoint.pm: pinit plummer -n 30 --cells 4 --seed 3 | cycle -n 8 --checkpoint FILE "$forces"
old=$top/tests/reference
forces='push --dt 0.1 kick/2 drift | pp | push kick/2'

@test "a stream without checksums of its lines is read, and its values are those that were written" {
	sh_ok "sls -i '$old/unsealed-stream.pm' | grep '^frame'"
	[ "$output" = "frame 1: time 0 step 0 substep 0 dt 0.1 dim 1 seed 3
frame 2: time 0.4 step 4 substep 0 dt 0.1 dim 1 seed 3
frame 3: time 0.8 step 8 substep 0 dt 0.1 dim 1 seed 3
frame 4: time 0.01570796327 step 0 substep 2 dt 0.03141592654 dim 3 seed 1" ]
	python3 "$top/docs/read.py" <"$old/unsealed-stream.pm" >values
	[ "$(cksum <values)" = "1115991245 23786" ]
	sel -i "$old/unsealed-stream.pm" -o passed.pm
	python3 "$top/docs/read.py" <passed.pm | cmp - values
	sls --report -i "$old/unsealed-stream.pm" >reports
	sls --report -i passed.pm | cmp - reports
}

# Times before `since` are sums, so they agree to round-off only.
@test "a checkpoint without them is taken up where it was left" {
	cycle -n 12 --resume "$old/unsealed-checkpoint.pm" "$forces" >late.pm
	pinit plummer -n 30 --cells 4 --seed 3 | cycle -n 12 "$forces" | scmp --tolerance 1e-12 late.pm - >/dev/null
	[[ $(sls <late.pm) == "frame 1: time 1.2 step 12 substep 0 dt 0.1 "* ]]
}

@test "a step begun before is completed" {
	sel --frames 4 -i "$old/unsealed-stream.pm" | pp | push rk4 | pp | push rk4 >late.pm
	pinit two-body | cycle -n 1 'pp | push rk4' >new.pm
	scmp --tolerance 1e-12 late.pm new.pm >/dev/null
	[[ $(sls <late.pm) == "frame 1: time 0.03141592654 step 1 substep 0 "* ]]
}
