# smod: sets attributes, stores and renames. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

t() { printf 'x y z vx vy vz mass id\n1 2 3 4 5 6 7 8\n' | stab - --box -8,8 --cells 2 --law free --constant G=1; }
row() { stab --plain | awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) n[i] = $i; next } { for (i = 1; i <= NF; i++) print n[i], $i }' | sort | awk '{
	printf "%s%s", (NR > 1 ? " " : ""), $2 }'; }
# id mass vx vy vz x y z

@test "attributes are set" {
	sh_ok 't() { printf "x y\n1 2\n"; }
		t | stab - | smod --dt 0.125 --time 2.5 --step 7 --seed 9 --law free --constant a=1.5 --box -4,4 --faces periodic --unit x=pc |
		sls --format json'
	echo "$output" | jq -e \
		'.dt == 0.125 and .time == 2.5 and .step == 7 and .seed == 9 and .law.constants.a == 1.5 and .box.hi == [4,4]
		and .box.fields[1][1] == "periodic"
		and .box.particles[0][0] == "periodic" and .meshes[0].h == [0.25,0.25] and .fields[0].unit == "pc"'
	sh_ok 'printf "x\n1\n" | stab - --box 0,4 | smove --scale box=0.5 | smod --particle-faces reflect,absorb | sls --format json'
	echo "$output" | jq -e '.box.particles == [["reflect","absorb"]] and .box.hi == [2] and .meshes[0].h == [0.0625]'
}

@test "--store changes the type: single precision and back keeps seven digits" {
	pinit plummer -n 100 >a
	sh_ok 'smod --store f32 <a | sls | grep -c f32'
	[ "$output" = 3 ]
	sh_ok 'smod --store f32 <a | smod --store f64 | scmp --set matter --tolerance 6e-8 - a' # half a unit of 2^-23
	run -1 bash -c 'smod --store f32 <a | scmp --set matter --tolerance 1e-12 - a'
	sh_ok 'smod --store x=f32 <a | sls | grep f32'
	[[ "$output" == *" x "* ]]
}

@test "--rename changes names of fields, sets and meshes; --fixed and --loose a set" {
	sh_ok 'pinit plummer -n 10 | smod --rename matter=stars,mesh=grid,mass=m --fixed matter | sls'
	[[ "$output" == *"set stars: 10 particles, fixed"* && "$output" == *"mesh grid"* && "$output" == *" m  "* ]]
	sh_ok 'pinit plummer -n 10 | smod --fixed matter | smod --loose matter | sls'
	[[ "$output" != *fixed* ]]
	[ "$(t | smod --shift 1,1,1 --rename x=q | stab --plain | head -1 | tr '\t' ' ')" = "mass id q_0 q_1 q_2" ] || t | smod --shift 1,1,1 --rename x=q |
		stab --plain | grep -q 'q_0'
	[ "$(t | smod --shift 1,1,1 --rename v=w | row)" = "8 7 4 5 6 2 3 4" ] || [ "$(t | smod --shift 1,1,1 --rename v=w | stab --plain | tail -1 |
		tr '\t' '\n' | sort -n | paste -sd' ')" = "2 3 4 4 5 6 7 8" ]
}

@test "which sets are fixed can change between steps only" {
	pinit kepler | pp | push kick/2 drift > a
	for o in '--fixed sun' '--loose sun'; do
		run -1 --separate-stderr bash -c "smod $o < a > /dev/null"
		[[ $stderr == *"which sets are fixed can change only between steps (substep 1 here)"* ]]
	done
}

@test "what was derived is dropped when the law changes, and kept when the time step does" {
	pinit plummer -n 50 | pp >a
	sh_ok 'smod --constant G=2 <a | sls | grep -c " acc " || true'
	[ "$output" = 0 ]
	sh_ok 'smod --dt 0.25 <a | sls | grep -c " acc "'
	[ "$output" = 1 ]
}

@test "wrong options are usage errors, missing things data errors, in one line" {
	t >a
	for o in '--shift 1,2' '--boost 1' '--rotate q,3' '--rotate z' '--scale x' '--scale x=q' '--store f16' '--scale box=-1' '--box 3,1' '--faces soft' \
		'--constant G' '--dt -1' '--law nothing' '--law electromagnetic --constant c=-1' '--law electromagnetic --constant c=0' \
		'--law electrostatic --constant eps0=-1'; do
		run -2 --separate-stderr bash -c "smod $o <a >/dev/null"
		[ "${#stderr_lines[@]}" = 1 ]
	done
	for o in '--set nobody --shift 1,1,1' '--scale q=2' '--scale id=2' '--rename q=r' '--rename x=v' '--fixed nobody' '--store q=f32' '--store id=f32' \
		'--unit q=m'; do
		run -1 --separate-stderr bash -c "smod $o <a >/dev/null"
		[ "${#stderr_lines[@]}" = 1 ]
	done
	smod --constant c=-1 a >b # of a law without light it is any constant
	run -2 --separate-stderr bash -c "smod --law electromagnetic <b >/dev/null"
	[[ $stderr == *'c=-1, but under the law electromagnetic the speed of light is above 0' ]]
	head -c -200 a >cut
	run -1 bash -c 'smod --dt 1 <cut >/dev/null'
}

@test "a set of no particles is valid" { sh_ok 'printf "x y z\n" | stab - | smod --store f32 | sls'; }
