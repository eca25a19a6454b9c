#!/usr/bin/env bats
# How far a run is: cycle and pareto on a terminal, cycle --verbose without one. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

force='p2m | poisson-fft | mgrad | m2p' x='[-+.0-9e]+'
leap="push kick/2 drift | $force | push kick/2"
slow="push kick/2 drift | ./slow | $force | push kick/2"

# terminal COLUMNS LINE: runs a command line on a terminal; a line in `screen` for every rewriting.
terminal() { python3 -I -S "$top/tests/on-terminal.py" "$1" bash -o pipefail -c "$2" >raw || return; tr '\r' '\n' <raw | sed '/^$/d' >screen; }

# A word ./slow that takes some 30 ms for a small frame.
slow_word() {
	printf '%s\n' '#!/usr/bin/env -S python3 -I -S' 'import os, time' 'while b := os.read(0, 65536):' ' time.sleep(0.01)' ' os.write(1, b)' >slow
	chmod +x slow
}

@test "on a terminal cycle rewrites one line: step, time, per cent, speed, time left, energy; at the end one stays, and the bytes are the same" {
	pinit uniform -n 200 --cells 8 --dispersion 0.1 --no-history >a
	slow_word
	terminal 100 "cycle --no-history -n 400 --until 'time > 0.205' '$slow' <a >b"
	grep -Eq "^cycle: step [0-9]+/400, time $x, [0-9] %, $x steps/s, [0-9]:[0-9]+ left, energy [-+][0-9]\.[0-9]e[-+][0-9]+.\[K$" screen
	[ "$(tail -n 1 screen | grep -Ec "^.\[Kcycle: step 21, time 0.21, $x s, $x steps/s, energy [-+][0-9]\.[0-9]e[-+][0-9]+$")" = 1 ]
	[ "$(tr -cd '\n' <raw | wc -c)" = 1 ]
	cycle --no-history -n 400 --until 'time > 0.205' "$slow" <a | cmp - b
	terminal 100 "cycle -t 0.3 'push drift | ./slow' <a >b" # per cent of the time; no potential, so no energy
	grep -Eq "^cycle: step [0-9]+, time $x, [0-9]+ %, $x steps/s, [0-9:]+ left.\[K$" screen
}

@test "the line is cut to the terminal's width; messages and the rows of the next word get lines of their own" {
	pinit uniform -n 200 --cells 8 --no-history >a
	slow_word
	terminal 40 "cycle -n 15 '$slow' <a >b"
	[ "$(sed 's/.\[K//g' screen | sed '$d' | awk 'length > n { n = length } END { print n }')" = 39 ]
	terminal 100 "cycle -n 30 --every 10 '$slow' <a | diag --format tsv --columns step"
	sed 's/\r$//; s/.*\r//; s/.\[K//g' raw >seen
	[ "$(grep -Ec '^ *[0-9]+ *$' seen)" = 4 ]
}

@test "no line with -q, and none without a terminal unless --verbose asks for lines" {
	pinit uniform -n 200 --cells 8 --dispersion 0.1 --no-history >a
	slow_word
	terminal 80 "cycle -q -n 12 '$slow' <a >b"
	[ ! -s raw ]
	cycle -n 12 "$slow" <a 2>said >b
	[ ! -s said ]
	cycle -v -n 120 "$slow" <a 2>said >b
	# After a second; its energy too, where that is cheap: not on a busy machine.
	grep -Eq "^cycle: step [0-9]+/120, time $x, [0-9]+ %, $x steps/s, [0-9:]+ left" said
	tail -n 1 said | grep -Eq "^cycle: step 120, time $x, $x s, $x steps/s, energy [-+]"
}

@test "pareto rewrites a line that fits the terminal" {
	terminal 40 "pareto 'pinit plummer -n 200 | p2m --kernel {cic,tsc} | poisson-fft | mgrad | m2p' --field acc --against pp --repeat 1 -o page >table"
	grep -Eq '^pareto: 1 of 2 measured, 50 %, about' screen
	[ "$(sed 's/.\[K//g' screen | awk 'length > n { n = length } END { print n }')" = 39 ]
}
