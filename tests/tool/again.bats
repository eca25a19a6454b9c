# again: the history of a file, run once more; what a history may not do.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

leapfrog='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'

@test "again gives the bytes of the file: scenes, frames of a run, tables, stacks, options of all kinds, HDF5" {
	pinit plummer -n 50 --cells 8 | p2m --kernel tsc | poisson-fft >1.pm
	pinit plummer -n 50 --cells 8 | cycle -n 5 --every 2 "$leapfrog" >2.pm
	pinit plummer -n 50 --cells 8 | cycle -n 3 "$leapfrog" | sel --where 'x > 0' | smod --constant G=2,softening=0.1 >3.pm
	printf 'x y vx\n1 2 -3\n' >-table
	stab --number -- -table | scalc "e = x*x + y^2" | field 'acc = -x,-y' >4.pm
	pinit plummer -n 20 --seed 2 | smove --shift 3,0,0 >b.pm
	pinit plummer -n 20 >a.pm
	stack --merge a.pm b.pm | p2m -n 8 >5.pm
	pinit plummer -n 20 | cycle -t 0.05 --plan >6.pm
	for f in 1 2 3 4 5 6; do
		again $f.pm >got 2>said || { cat said; return 1; }
		cmp got $f.pm && [ "$(wc -l <said)" = 1 ] || { echo "$f"; cat said; return 1; }
	done
	again --verbose 2.pm -o 2.h5 2>said
	grep -qx "again: the same bytes as '2.pm'" said
	again 2.h5 2>said | cmp - 2.pm
	again - <2.pm 2>/dev/null | cmp - 2.pm
	again -q 2.pm 2>said | cmp - 2.pm && [ ! -s said ]
}

@test "again --list prints a line that a shell can run" {
	pinit plummer -n 50 --cells 8 | cycle -n 4 --every 2 "$leapfrog" | scalc 'e = x  + 1' >a.pm
	run -0 --separate-stderr again --list a.pm
	[ "$output" = "pinit --cells 8 --particles 50 plummer | cycle -n 4 --every 2 '$leapfrog' | scalc 'e = x  + 1'" ]
	bash -c "$output" | cmp - a.pm
}

@test "again says where the bytes are others: a run that ended at an exact time, fields that were not written" {
	pinit two-body | cycle -t 0.2 --exact 'push kick/2 drift | pp | push kick/2' >a.pm
	pinit two-body | cycle -n 2 --drop acc 'push kick/2 drift | pp | push kick/2' >b.pm
	for f in a b; do
		again $f.pm 2>said >got
		grep -q "^again: the run gives other bytes than '$f.pm'" said
		sls got >/dev/null
	done
}

# refused PATTERN FILE: exit 1, a line that matches, and nothing has been run.
refused() {
	local got=0
	again "$2" >out 2>err </dev/null || got=$?
	[[ $got == 1 ]] && grep -Eq -- "^again: $1" err && [ "$(ls touched* 2>/dev/null)" = '' ] || { echo "$2: exit status $got"; cat err; return 1; }
}

# forge CODE: in.pm with another history (h["history"]) in forged.pm.
forge() { wire edit in.pm "$1" >forged.pm; }

@test "again refuses what is not there: a version, a file, standard input, a history, a cycle's end, a cut stream" {
	pinit uniform -n 12 --cells 4 | p2m >in.pm
	forge 'h["history"][1]["version"] = "0.0.9"'
	refused "it was made by p2m of version 0.0.9, and this is $(sed -n 's/^#define PM_VERSION "\(.*\)"/\1/p' "$top/lib/base/base.h")" forged.pm
	pinit uniform -n 12 >a.pm
	stack a.pm a.pm >s.pm
	rm a.pm
	refused "its history needs the file 'a.pm': No such file" s.pm
	printf 'x\n1\n' | stab - >t.pm
	refused "'stab -' read standard input" t.pm
	p2m --no-history <in.pm | wire edit /dev/stdin 'h["history"] = []' >none.pm
	refused 'it has no history' none.pm
	pinit two-body | cycle -n 1 'push drift' | cycle -n 2 'push  drift' >c.pm
	refused 'two cycles made it' c.pm
	pinit uniform -n 13 --cells 4 >b.pm
	wire frames in.pm b.pm >two.pm
	refused 'frame 2 has another history' two.pm
	head -c 1000 in.pm >cut.pm
	refused 'the input ends in' cut.pm
}

@test "again runs nothing that a history has no business to run, and no shell parses it" {
	pinit uniform -n 12 --cells 4 | p2m >in.pm
	for p in touch /usr/bin/touch ./touch ../bin/p2m sh again diag sdraw svtk pareto 'p2m; touch touched'; do
		forge "h['history'][1] = {'program': '$p', 'version': h['history'][1]['version'], 'options': {}, 'arguments': ['touched']}"
		refused "'$p' (is no word|never stands)" forged.pm
	done
	for o in output input timing checkpoint verbose nonsense 'n 5; touch touched'; do
		forge "h['history'][1]['options']['$o'] = 'touched'"
		refused "'p2m' never records an option" forged.pm
		forge "h['history'][0]['options']['$o'] = 'touched'"
		refused "'pinit' never records an option" forged.pm
	done
	forge 'h["history"][1]["arguments"] = ["in.pm"]'
	refused "'p2m' never stands like this" forged.pm
	for s in 'touch touched' 'push drift | touch touched' 'diag --tee touched | push drift' "push drift; touch touched" '$(touch touched)'; do
		forge "h['history'][1] = {'program': 'cycle', 'version': h['history'][1]['version'], 'options': {}, 'arguments': ['$s']}"
		again forged.pm >out 2>err && return 1
		[ -z "$(ls touched* 2>/dev/null)" ]
	done
	# A flag that comes with a text, and a text that comes as a flag, would shift the arguments.
	for o in '"interlace": "--output=touched"' '"kernel": True, "mesh": "--output=touched"'; do
		forge "h['history'][1]['options'] = {$o}"
		refused "'p2m' never records an option" forged.pm
	done
	# Values are data: these reach the word as they are, and it refuses them.
	for v in '$(touch touched)' '`touch touched`' "a; touch touched" '| touch touched' '--output=touched' "\\'; touch touched #"; do
		forge "h['history'][1]['options'] = {'kernel': '$v'}"
		again forged.pm >out 2>err && return 1
		grep -q "p2m: --kernel '.*' is not one of" err || { cat err; return 1; }
		forge "h['history'][0]['arguments'] = ['$v']"
		again forged.pm >out 2>err && return 1
		grep -qE "pinit: (no scene|no option|unexpected)" err || { cat err; return 1; }
		[ -z "$(ls touched* 2>/dev/null)" ]
	done
	forge 'h["history"] = [h["history"][0]] + [dict(h["history"][1], options={"mesh": str(i)}) for i in range(99)]'
	refused 'its history has more than 64 words' forged.pm
	forge 'h["history"][1]["options"] = 5'
	refused "the options of 'p2m' are no list of names: the history was edited" forged.pm
	[ -z "$(ls touched* 2>/dev/null)" ]
}
