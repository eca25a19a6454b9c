# sls: lists what a stream holds. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

@test "attributes, sets, meshes and fields are listed with type, role, kind and uniform value" {
	printf 'x y mass q_0 q_1\n0 1 2.5 1 2\n3 5 2.5 1 4\n' |
		stab - --law free --constant a=1.5 --box -8,8 --faces periodic --cells 4x6 --unit mass=kg --dt 0.25 --time 3 >a
	sh_ok 'sls <a'
	[ "${lines[0]}" = "frame 1: time 3 step 0 substep 0 dt 0.25 dim 2 seed 0" ]
	[ "${lines[1]}" = "  law free (a 1.5)" ]
	[ "${lines[2]}" = "  box [-8, 8] periodic x [-8, 8] periodic; particles periodic periodic" ]
	[ "${lines[3]}" = "  set matter: 2 particles" ]
	[ "${lines[4]}" = "    x           2 f64 state value" ]
	[ "${lines[5]}" = "    mass        1 f64 state strength [kg]" ]
	[ "${lines[6]}" = "    q           2 f64 state value" ]
	[ "${lines[7]}" = "  mesh mesh: 4 x 6 cells, h 4 2.6666666666666665" ] || [ "${lines[7]}" = "  mesh mesh: 4 x 6 cells, h 4 2.666666667" ]
	[ "${lines[8]}" = "1 frames" ]
}

@test "--data prints smallest, largest and mean of every component, of whole numbers too" {
	printf 'x y id\n0 1 5\n3 5 -8\n3 0 6\n' | stab - >a
	sh_ok 'sls --data <a | grep min'
	[ "${lines[0]}" = "      0: min 0 max 3 mean 2" ]
	[ "${lines[1]}" = "      1: min 0 max 5 mean 2" ]
	[ "${lines[2]}" = "      0: min -8 max 6 mean 1" ]
	sh_ok 'sls --data --format json <a'
	echo "$output" | jq -e '.data[0] == {"name":"x","on":"matter","min":[0,0],"max":[3,5],"mean":[2,2]}'
}

@test "json is the header, a line a frame, with history and report on request" {
	printf 'x\n1\n' | stab - >a
	cat a a >aa
	sh_ok 'sls --format json <aa | wc -l'
	[ "$output" -eq 2 ]
	sh_ok 'sls --format json <a'
	echo "$output" | jq -e '.dim == 1 and (has("history") | not) and (has("report") | not) and .sets[0].n == 1'
	sh_ok 'sls --format json --history --report <a'
	echo "$output" | jq -e '.history[0].program == "stab" and .report["stab -"].box == "automatic"'
	sh_ok 'sls --history --report <a'
	[[ "$output" == *'"program":"stab"'* && "$output" == *'stab -: {"box":"automatic"}'* ]]
}

@test "a uniform field shows its value" {
	sh_ok 'pinit plummer -n 10 | sls | grep mass'
	[[ "$output" == *"strength"*"uniform 0.0"* ]]
}

@test "a set of no particles has no values, a stream of no frames no frames" {
	sh_ok 'printf "x\n" | stab - | sls --data | grep min'
	[ "$output" = "      0: min nan max nan mean nan" ]
	sh_ok 'printf "x\n" | stab - | sls --data --format json'
	echo "$output" | jq -e '.data[0].min == [null]'
	sh_ok 'printf "#end 0\n" | stab - | sls'
	[ "$output" = "0 frames" ]
}

@test "a stream that was cut, garbage, empty, or a full disk is exit 1; an unknown format exit 2" {
	pinit plummer -n 100 >a
	head -c 3000 a >cut
	run -1 bash -c 'sls <cut'
	run -1 bash -c ': | sls'
	run -1 bash -c 'yes | head -100 | sls'
	run -1 bash -c 'sls <a >/dev/full'
	run -2 bash -c 'sls --format xml <a'
}

@test "columns stand below each other whatever the alphabet of the names" {
	printf 'x y größe name_two αβγδεζηθικλμ\n0 0 2 1 1\n' | stab - >a
	sh_ok "sls <a | grep ' value'"
	[ "${lines[1]}" = '    größe       1 f64 state value' ]
	[ "${lines[2]}" = '    name_two    1 f64 state value' ]
	[ "${lines[3]}" = '    αβγδεζηθικλμ  1 f64 state value' ]
}
