# What goes to standard error beside errors: --quiet and --verbose, for every word. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

@test "every word has -q and -v, and refuses both together before input is read: exit 2" {
	for t in $(tools); do
		[ "$("$t" --complete | grep -cxE -- '--(quiet|verbose)')" = 2 ]
		run -2 --separate-stderr timeout 5 "$t" -v -q < <(sleep 6)
		[ "$stderr" = "$t: --quiet and --verbose exclude each other (leave one of them out)" ] || { echo "$t: $stderr"; return 1; }
	done
}

@test "-q leaves out the notes of a word and not its errors" {
	pinit plummer -n 20 >a
	field 'acc = -x, -y, -z' <a >f
	run -0 --separate-stderr diag --pair --columns energy -i f
	[[ $stderr == 'diag: energy is nan: '* ]]
	run -0 --separate-stderr diag -q --pair --columns energy -i f
	[ -z "$stderr" ]
	[ "$output" = "$(printf 'energy\nnan')" ]
	run -1 --separate-stderr m2p -q -i a
	[[ $stderr == 'm2p: frame 1: '* ]]
}

@test "cycle -q is quiet for itself and for its words, cycle -v verbose, in both engines; what was typed behind a word stays" {
	pinit lamb-oseen --cells 16 >a
	pinit plummer -n 60 --cells 8 --box -4,4 --dt 0.001 >b
	notes() { cycle -n 1 --engine "$1" ${2:+"$2"} "$3" <"$4" 2>&1 >/dev/null | cut -d: -f1 | sort -u | tr '\n' ' '; }
	for engine in fused pipes; do
		[ "$(notes $engine '' 'p2m | poisson-fft | mgrad | m2p | push rk2' a)" = 'cycle ' ]
		[ -z "$(notes $engine -q 'p2m | poisson-fft | mgrad | m2p | push rk2' a)" ]
		order4='p2m | poisson-fft | mgrad --order 4'
		[ "$(notes $engine '' "push kick/2 drift | $order4 | m2p | push kick/2" b)" = 'mgrad ' ]
		[ -z "$(notes $engine --quiet "push kick/2 drift | $order4 | m2p | push kick/2" b)" ]
		[ -z "$(notes $engine '' "push kick/2 drift | $order4 -q | m2p | push kick/2" b)" ]
		[ -z "$(notes $engine -v "push kick/2 drift | $order4 -q | m2p | push kick/2" b | grep mgrad)" ]
		[[ $(notes $engine -v "push kick/2 drift | $order4 | m2p | diffuse --nu 0 | push kick/2" b) == *diffuse* ]]
	done
	run -1 --separate-stderr cycle -q -n 1 'push kick/2 drift | p2m --outside error | poisson-fft | mgrad | m2p | push kick/2' < <(smove --shift 90,0,0 <b)
	[[ $stderr == 'cycle: step 1: p2m'* ]]
}

@test "pareto and margin -q print no progress and no hint" {
	sweep() { pareto "$@" 'pinit uniform -n 20 | p2m --kernel {cic,tsc} -n 8 | sel' --against finest --repeat 1 -o here; }
	run -0 --separate-stderr sweep -q
	[ -z "$stderr" ]
	log=$(find here -name log)
	echo 'no result' >>"$log"
	run -0 --separate-stderr sweep
	[[ $stderr == *'are no results of pareto and are left out'* ]]
	echo 'no result' >>"$log"
	run -0 --separate-stderr sweep -q
	[ -z "$stderr" ]
	run -2 --separate-stderr margin -q
	[[ $stderr == 'margin: '* ]]
}
