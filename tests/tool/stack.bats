# stack: puts scenes together. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

scene() { printf 'x y mass id\n%s 0 1 0\n%s 1 2 1\n' "$1" "$1" | stab - --box "$2" --cells 4 --law free --constant G=1 --dt "${3:-0.5}"; }
col() { awk -F'\t' -v n="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == n) c = i; next } { print $c }' | paste -sd' '; }

@test "sets of one name are renamed, the box is the union, dt the smallest, ids stay unique" {
	scene 1 -2,2 >a; scene 5 0,7 0.25 >b
	sh_ok 'stack a b | sls --format json'
	echo "$output" | jq -e \
		'[.sets[].name] == ["matter","matter-2"] and .box.lo == [-2,-2] and .box.hi == [7,7] and .dt == 0.25
		and .meshes[0].h == [2.25,2.25] and (.meshes | length) == 1'
	[ "$(stack a b | stab --plain --set matter-2 | col id)" = "2 3" ]
	[ "$(stack a b a | stab --plain --set matter-3 | col id)" = "4 5" ]
}

@test "--merge makes one set, --as names the sets, --box sets the box" {
	scene 1 -2,2 >a; scene 5 0,7 >b
	[ "$(stack --merge a b | stab --plain | col x)" = "1 1 5 5" ]
	[ "$(stack --merge a b | stab --plain | col id)" = "0 1 2 3" ]
	sh_ok 'stack --as stars,gas --box -9,9 a b | sls --format json'
	echo "$output" | jq -e '[.sets[].name] == ["stars","gas"] and .box.lo == [-9,-9] and .meshes[0].h == [4.5,4.5]'
	sh_ok 'stack --merge --as all,all a b | sls --format json'
	echo "$output" | jq -e '[.sets[] | [.name, .n]] == [["all", 4]]'
}

@test "a uniform field is spelt out when its values differ, and stays uniform when they do not" {
	pinit plummer -n 10 >a; pinit plummer -n 20 >b
	sh_ok 'stack --merge a b | sls --data | grep -A1 mass | tail -1'
	[[ "$output" != *"min 0 "* ]]
	sh_ok 'stack --merge a a | sls | grep mass'
	[[ "$output" == *uniform* ]]
	sh_ok 'stack --merge a b | sel --where "id < 10" | scmp --set matter --tolerance 0 - a'
}

@test "one stream passes with nothing changed but what was derived" {
	pinit plummer -n 10 >a
	sh_ok 'stack a --no-history | cmp - a'
}

@test "standard input can be one of them, frames are taken together" {
	scene 1 -2,2 >a; cat a a >aa
	sh_ok 'stack - aa <aa | sls | tail -1'
	[ "$output" = "2 frames" ]
	run -1 --separate-stderr bash -c 'stack aa a >/dev/null'
	[[ "$stderr" == *"ends before"* ]]
	run -1 bash -c 'stack a aa >/dev/null'
	run -2 bash -c 'stack - - <a'
}

@test "incompatible scenes are refused in one line" {
	scene 1 -2,2 >a
	refused() { run -1 --separate-stderr bash -c "stack ${2:-} a b >/dev/null"; [ "${#stderr_lines[@]}" = 1 ]; [[ "$stderr" == *"$1"* ]]; }
	smod --constant G=2 <a >b; refused "the constant G is 1 in one scene and 2 in another"
	smod --time 1 <a >b; refused "at time 0"
	smod --law gravity <a >b; refused "obeys the law free"
	smod --faces periodic <a >b; refused "different faces"
	printf 'x\n1\n' | stab - >b; refused "2 dimensions"
	printf 'x y id\n1 1 1\n' | stab - --constant G=1 >b; refused "has fields that are missing in some scene" --merge
	scene 1 -2,2 | scalc --mesh mesh --role state 'f = x' >b; refused "is state"
	: >b; refused "no input"
	head -c -200 a >b; refused "cut"
	rm b; refused "cannot open"
}

@test "scenes of no particles can be combined" {
	printf 'x mass id\n' | stab - >a; printf 'x mass id\n1 2 3\n' | stab - --box 0,1 >b
	sh_ok 'stack --merge a b | sls | grep "1 particles"; stack --merge b a | sls | grep "1 particles"; stack --merge a a | sls | grep "0 particles"'
	pinit plummer -n 9000 >all
	sel --where 'mass > 1' <all >none # whose fields are not uniform
	stack --merge none all | scmp --set matter --tolerance 0 - all
	stack --merge all none | scmp --set matter --tolerance 0 - all
	stack --merge --ranks 3 none all | cmp - <(stack --merge none all)
}

@test "ids that could meet others move up just as far as they must, those above stay" {
	printf 'x id\n1 5\n2 6\n' | stab - --set a >a; printf 'x id\n1 6\n2 9\n' | stab - --set b >b; printf 'x id\n1 100\n' | stab - --set c >c
	[ "$(stack a b c | stab --plain --set a | col id)" = "5 6" ]
	[ "$(stack a b c | stab --plain --set b | col id)" = "7 10" ]
	[ "$(stack a b c | stab --plain --set c | col id)" = "100" ]
}
