# ssort: reorders particles. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

ids() { stab --plain | awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "id") c = i; next } { print $c }' | paste -sd' '; }

@test "particles come in the order of their cells, x fastest, equal cells in the order they had" {
	printf 'x y id\n3.5 3.5 1\n0.5 0.5 2\n1.5 0.2 3\n0.9 0.1 4\n0.5 1.5 5\n-1 -9 6\n4 4 7\n' >t
	[ "$(stab t --box 0,4 --cells 4 --number 2>&1 | head -c 0; stab t --box 0,4 --cells 4 | ssort | ids)" = "2 4 6 3 5 1 7" ]
	printf 'x y id\n5 1.5 8\n3.5 1.5 9\n' >t # beyond the last cell
	[ "$(stab t --box 0,4 --cells 4 | ssort | ids)" = "8 9" ]
}

@test "a periodic axis wraps" {
	printf 'x id\n4.5 1\n-0.5 2\n1.5 3\n0.1 4\n' >t
	[ "$(stab t --box 0,4 --cells 4 --faces periodic | ssort | ids)" = "1 4 3 2" ]
}

@test "--by sorts by an expression or by ids beyond 2^53, --reverse turns the order round, both are stable" {
	printf 'x q id\n1 2 9007199254740993\n2 1 9007199254740992\n3 2 -5\n' >t
	[ "$(stab t | ssort --by id | ids)" = "-5 9007199254740992 9007199254740993" ]
	[ "$(stab t | ssort --by q | ids)" = "9007199254740992 9007199254740993 -5" ]
	[ "$(stab t | ssort --by q --reverse | ids)" = "9007199254740993 -5 9007199254740992" ]
	[ "$(stab t | ssort --by '-x*q' | ids)" = "-5 9007199254740993 9007199254740992" ]
}

@test "every field is permuted, nothing else changes" {
	pinit plummer -n 3001 --seed 2 >a
	sh_ok 'ssort <a | scmp --tolerance 0 - a'
	sh_ok 'ssort <a | ssort --by id | scmp --by-index --set matter --tolerance 0 - a'
	sh_ok 'printf "x name id\n3 c 1\n1 a 2\n2 b 3\n" | stab - | ssort --by x | stab --plain | tail -n +2 | paste -sd" " | tr "\t" " "'
	[[ "$output" == *a*b*c* ]]
}

@test "the order does not depend on the number of threads" {
	pinit plummer -n 5000 >a
	ssort --no-history --threads 1 <a >one
	for n in 2 3; do ssort --no-history --threads $n <a | cmp - one; done
}

@test "sorting twice is sorting once, and only frames whose step is a multiple of --every are touched" {
	pinit plummer -n 500 >a
	ssort --no-history <a >b
	ssort --no-history <b | cmp - b
	smod --no-history --step 7 <a >c
	ssort --no-history --every 5 <c | cmp - c
	run ! cmp -s <(ssort --no-history --every 7 <c) c
}

@test "a frame inside a step is passed on unchanged" {
	pinit plummer -n 50 | push drift/2 --no-history >a || skip "push is not there"
	ssort --no-history <a 2>said | cmp - a
	grep -q 'nothing is sorted: every frame lies inside a step' said
	pinit plummer -n 50 | cycle -n 2 'push drift/2 | ssort | push drift/2' 2>&1 >/dev/null | grep -q 'nothing is sorted'
	[ -z "$(pinit plummer -n 50 | cycle -n 2 'push drift/2 | push drift/2 | ssort --every 7' 2>&1 >/dev/null | grep sorted)" ]
}

@test "sets without particles are sorted; --set chooses one" {
	sh_ok 'printf "x\n" | stab - | ssort | sls'
	printf 'x id\n2 1\n1 2\n' | stab - --box 0,4 --set a >a; printf 'x id\n2 3\n1 4\n' | stab - --box 0,4 --set b >b
	sh_ok 'stack a b | ssort --set b --by x >c
		for s in a b; do stab --plain --set $s <c | tail -n +2 | cut -f2 | paste -sd" "; done'
	[ "${lines[0]}" = "1 2" ]
	[ "${lines[1]}" = "4 3" ]
}

@test "what cannot be sorted is refused in one line" {
	pinit plummer -n 10 >a
	for o in '--set nobody' '--by nothing' '--mesh nowhere' "--by 'log(x-100)'" '--every 0' "--by 'x+'"; do
		run --separate-stderr bash -c "ssort $o <a >/dev/null"
		[ "$status" != 0 ]
		[ "${#stderr_lines[@]}" = 1 ]
	done
	head -c -200 a >cut
	run -1 bash -c 'ssort <cut >/dev/null'
	sel --drop mesh <a >b
	run -1 --separate-stderr bash -c 'ssort <b >/dev/null'
	[[ "$stderr" == *"no mesh to sort by"* ]]
}

@test "on a mesh of several tiles the order is that of p2m's tiles, and of cells inside a tile" {
	pinit uniform -n 3000 --cells 40x20x10 --seed 3 | ssort >sorted.pm
	stab <sorted.pm | grep -v '^#' >rows
	# box 1 in 40, 20 and 10 cells; tiles of 32, 16 and 8 cells
	awk -v OFS=' ' 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
		{ i = int($at["x"] * 40); j = int($at["y"] * 20); k = int($at["z"] * 10)
		tile = int(i / 32) + 2 * (int(j / 16) + 2 * int(k / 8)); cell = i % 32 + 32 * (j % 16 + 16 * (k % 8)); key = tile * 4096 + cell
		if (key < last) { print NR, key, last; exit 1 }
		last = key }' rows
	[ "$(wc -l <rows)" -ge 3000 ]
}

# Few cells, which are counted, and more than are counted.
@test "many particles in a random order: by three threads the order of one, which is stable, and the values travel together" {
	for cells in 12 40 128; do
		pinit uniform -n 70001 --cells $cells --dispersion 1 --seed 3 >a
		ssort --threads 3 --no-history a >three
		ssort --threads 1 --no-history a | cmp - three
		scalc "cell = floor($cells*x) + $cells*floor($cells*y) + $cells^2*floor($cells*z)" <three | stab --plain |
			awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } $c["cell"] == last && $c["id"] < id { bad = 1 }
				$c["cell"] != last && seen[$c["cell"]]++ { bad = 1 } { last = $c["cell"]; id = $c["id"]; n++ } END { exit bad || n != 70001 }'
		ssort --by id <three >back
		scmp --by-index --tolerance 0 a back
	done
}
