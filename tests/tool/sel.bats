# sel: selects frames, sets, fields and particles. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
wire() { python3 "$top/tests/wire.py" "$@"; }

frames() { for i in "$@"; do printf "x y id\n$i 0 1\n0.5 2 2\n" | stab - --box -9,9 --cells 2 | smod --step "$i" --time "$i"; done; }
steps() { sls --format json | jq -r .step | paste -sd' '; }
fields() { sls --format json | jq -r '.fields[] | .on + "/" + .name' | paste -sd' '; }

@test "frames are chosen by number, from 1, over all streams of the input" {
	frames 1 2 3 4 5 6 >a
	[ "$(sel --frames 1,3:4,6 <a | steps)" = "1 3 4 6" ]
	[ "$(sel --frames 5: <a | steps)" = "5 6" ]
	[ "$(sel --frames 9 <a | steps)" = "" ]
}

@test "--every chooses by step, --last the last of each stream of those left" {
	frames 1 2 3 4 5 6 >a
	[ "$(sel --every 3 <a | steps)" = "3 6" ]
	stab <a | stab - >b # one stream of six frames
	[ "$(sel --last <b | steps)" = 6 ]
	[ "$(sel --last --every 4 <b | steps)" = 4 ]
	[ "$(sel --last --frames 2:3 <b | steps)" = 3 ]
	[ "$(sel --last --frames 99 <b | steps)" = "" ]
}

@test "fields, sets and meshes are kept or left out" {
	printf 'x mass id\n1 2 3\n' | stab - --set a >a; printf 'x mass id\n1 2 3\n' | stab - --set b >b
	stack a b >c
	[ "$(sel --field x,b/mass <c | fields)" = "a/x b/x b/mass" ]
	[ "$(sel --drop id,a/mass <c | fields)" = "a/x b/x b/mass" ]
	[ "$(sel --set b <c | fields)" = "b/x b/mass b/id" ]
	[ "$(sel --drop a <c | fields)" = "b/x b/mass b/id" ]
	sh_ok 'sel --drop mesh <c | sls'
	[[ "$output" != *"mesh mesh"* ]]
	sh_ok 'sel --mesh mesh <c | sls'
	[[ "$output" == *"mesh mesh"* ]]
}

@test "--where keeps the particles for which it holds, with all their fields" {
	sh_ok 'printf "x y q_0 q_1 name id\n1 2 3 4 a 5\n-1 2 5 6 b 6\n2 2 7 8 c 7\n" | stab - | sel --where "x > 0 && id != 5" | stab --plain | tail -n +2'
	[ "$output" = "2	2	7	8	c	7" ] || [ "$(echo "$output" | tr '\t' '\n' | sort | paste -sd' ')" = "2 2 7 7 8 c" ]
	sh_ok 'pinit plummer -n 1000 | sel --where "x^2+y^2+z^2 < 1" --drop mass | sls'
	[[ "$output" != *"mass"*"strength"* ]]
}

@test "--where on a uniform field, on all and on none" {
	pinit plummer -n 10 >a
	sh_ok 'sel --where "mass > 0" <a | scmp --tolerance 0 - a'
	sh_ok 'sel --where "mass < 0" <a | sls | grep "0 particles"'
	sh_ok 'printf "x\n" | stab - | sel --where "x > 0" | sls | grep "0 particles"'
}

@test "--where asks only for what the expression needs: what is not finite elsewhere is carried along, or dropped" {
	pinit plummer -n 4 --no-history > a
	wire edit a 'put("v", 3, float("nan"))' > b
	sh_ok 'sel --where "x > -100" --no-history < b > c; sel --where "x > -100" --drop v < b | sls'
	[ "$(sel --field x --no-history < b | cksum)" = "$(sel --field x --no-history < c | cksum)" ] # all four particles
	run -1 --separate-stderr bash -c 'sel --where "vx > -100" < b > /dev/null'
	[[ $stderr == *"'v' of 'matter' is not finite"* ]]
	run -1 --separate-stderr bash -c 'push drift < c > /dev/null' # words that compute with it still refuse
	[[ $stderr == *"'v' of 'matter' is not finite"* ]]
	run -1 --separate-stderr bash -c "cycle -n 1 'sel --where \"x > -100\" | push drift' < b > /dev/null"
	[[ $stderr == *"'v' of 'matter' is not finite"* ]]
}

@test "selected particles are the same as those written, through any number of threads" {
	pinit plummer -n 3000 >a
	sel --no-history --threads 1 --where 'x*y > z' <a >one
	for n in 2 3; do sel --no-history --threads $n --where 'x*y > z' <a | cmp - one; done
}

@test "missing names and meaningless options are refused in one line" {
	pinit plummer -n 10 >a
	for o in '--set nobody' '--mesh nowhere' '--field nothing' '--drop nothing' '--where q' '--where "sqrt(x)"'; do
		run --separate-stderr bash -c "sel $o <a >/dev/null"
		[ "$status" != 0 ]
		[ "${#stderr_lines[@]}" = 1 ]
	done
	for o in '--frames 0' '--frames 3:2' '--frames x' '--frames -1' '--every 0' '--where "x >"'; do
		run -2 bash -c "sel $o <a >/dev/null"
	done
	head -c -200 a >cut
	run -1 bash -c 'sel --field x <cut >/dev/null'
	run -1 bash -c 'sel --last <cut >/dev/null'
	run -1 bash -c 'sel --where "x > 0" <cut >/dev/null'
}
