# The contract of a stage, for every tool: usage errors, aborts, terminals, the order of what it does, frames without memory.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

# writes_text TOOL: its help says so; asked once a tool.
writes_text() {
	local kept=$BATS_FILE_TMPDIR/writes-$1
	[ -e "$kept" ] || { "$1" --help | grep 'writes text' || true; } >"$kept"
	[ -s "$kept" ]
}

# usage PATTERN COMMAND LINE: exit 2 before the input is read (there is none), one line, and only an abort for later stages.
usage() {
	local got=0 tool=${2%% *} word='' length=0
	[ -p silent ] || mkfifo silent # nothing comes out of it, and no end
	timeout 5 bash -c "exec $2" <>silent >out 2>err || got=$?
	[ $got = 2 ] || { echo "$2: exit status $got"; cat err; return 1; }
	[ "$(wc -l <err)" = 1 ] && grep -Eq -- "^$tool: .*($1)" err || { echo "$2: wanted '$1', got"; cat err; return 1; }
	if writes_text "$tool"; then
		[ ! -s out ]
	else
		read -r word length < <(head -n 1 out | sed -nE 's|^PMPIPE/1 abort 2 ([0-9]+) [0-9a-f]{8} *$|abort \1|p') || true
		[ "$word" = abort ] && [ "$(wc -c <out)" = $((64 + length)) ] && [ "$(tail -c "$length" out | sed 's/ *$//')" = "$(cat err)" ]
	fi || { echo "$2: on standard output"; cat out; return 1; }
}

@test "an unknown option: exit 2, the nearest name, before input is read, for every tool" {
	for t in $(tools); do
		# Every second letter pair of its first own option, swapped; all tools have the library's --threads.
		usage 'did you mean --threads' "$t --thraeds 2"
		first=$("$t" --complete | head -n 1 | cut -d' ' -f1)
		[ ${#first} -lt 6 ] || usage "did you mean $first" "$t ${first%?}x"
		# what follows is the same code in all of C, and in all of shell
		[[ ! -e $top/tools/$t.c || $t =~ ^(cycle|p2m|pinit|diag)$ ]] || continue
		usage 'no option' "$t --qqqqqqqqqq"
		usage 'no option' "$t -Q"
	done
}

@test "a missing value, an invalid value, a value too many: exit 2" {
	usage 'needs a value' 'p2m --kernel'
	usage 'not a number' 'push kick --dt fast'
	usage 'not a number' 'push kick --dt nan'
	usage 'not a number' 'push kick --dt inf'
	usage 'not a number' 'push kick --dt 1e999'
	usage 'not a whole number' "cycle -n 1.5 'push drift'"
	usage 'takes no value' 'push kick --verbose=yes'
	usage 'not a number of cells' 'p2m -n 64x'
	usage 'not a number of cells' 'p2m -n 0'
	usage 'more than three' 'p2m -n 4x4x4x4'
}

@test "a value out of its range: exit 2, the range" {
	usage 'outside its range, 1 to 4096' 'diag --threads 0'
	usage 'outside its range' "cycle -n -1 'push drift'"
	usage 'outside its range, 1e-09 to 1e' 'dt --courant 0'
	usage 'outside its range, 1e-09 to 1e' 'dt --courant 1e10'
	usage 'outside its range' 'pinit plummer -n -5'
	usage 'outside its range' "cycle -n 5 --every 0 'push drift'"
}

@test "a wrong choice: exit 2, the choices and the nearest" {
	usage 'cic.*did you mean cic' 'p2m --kernel cci'
	usage 'did you mean tsc' 'p2m --kernel tcs' # a transposition, not pcs with one letter replaced
	usage 'fused.*did you mean fused' "cycle -n 1 --engine fusde 'push drift'"
	usage 'did you mean plummer' 'pinit plumer'
	usage 'spectral' 'poisson-fft --symbol special'
}

@test "a missing argument, an argument too many: exit 2" {
	usage 'SENTENCE is missing' 'cycle -n 1'
	usage 'missing' pinit
	usage 'missing' push
	usage 'unexpected argument' "cycle -n 1 'p2m p2m'"
	usage 'expected: SENTENCE; -i reads a file' "cycle -n 1 'push drift' ."
	usage 'unexpected argument' "cycle -n 1 'push drift' again"
	usage 'how long' "cycle 'push drift'"
}

@test "a usage error inside a sentence: exit 2 before input is read, the word is named" {
	usage 'p2m.*kernel' "cycle -n 1 'p2m --kernel cci'"
	usage 'did you mean' "cycle -n 1 'p2m --kernle cic'"
}

@test "abort travels: a failure in stage 2 of 5 ends every later stage with its code and message" {
	five() { # COMMAND LINE OF STAGE 2, CODE, PATTERN
		bash -c "cat in.pm | $1 2>err.2 | p2m 2>err.3 | poisson-fft 2>err.4 | diag 2>err.5 >out
			echo \"\${PIPESTATUS[@]:1}\" >codes"
		[ "$(cat codes)" = "$2 $2 $2 $2" ] || { echo "$1: codes $(cat codes)"; cat err.*; return 1; }
		grep -Eq -- "$3" err.2 || { cat err.2; return 1; }
		[ "$(cat err.3)" = "p2m: stopped by $(cat err.2)" ]
		[ "$(cat err.4)" = "poisson-fft: stopped by $(cat err.2)" ]
		[ "$(cat err.5)" = "diag: stopped by $(cat err.2)" ]
	}
	cloud >in.pm
	five 'push kick' 1 "push: frame 1: .*acc"
	five 'push --nonsense' 2 "push: no option"
	pinit plummer -n 12 --cells 4 | tee slow.pm >/dev/null
	wire edit slow.pm 'put("v", 3, 1e308)' >in.pm
	five 'push drift --dt 10' 3 "push: frame 1: .*not finite"
	# A stage that does not exist, and one that is killed: later stages read a truncated stream.
	run bash -o pipefail -c 'pinit uniform -n 12 --cells 4 | nosuchstage 2>/dev/null | p2m 2>/dev/null | diag'
	[[ $output == *"diag: stopped by p2m: frame 1: no input: zero bytes"* ]]
}

@test "abort travels out of cycle, and through cycle, with its code and message" {
	run bash -c 'pinit uniform -n 12 --cells 4 | cycle -n 2 "push kick/2 drift | push kick/2" 2>err | diag'
	[ "$status" = 1 ]
	[ "${lines[-1]}" = "diag: stopped by $(cat err)" ]
	run bash -c 'pinit uniform --nonsense 2>err | cycle -n 2 "push drift" 2>/dev/null | diag'
	[ "$status" = 2 ]
	[ "${lines[-1]}" = "diag: stopped by $(cat err)" ]
}

@test "a failure in the second frame: the first is written completely, then the abort" {
	cloud >a.pm
	wire edit a.pm 'put("x", 1, float("nan"))' >b.pm
	wire frames a.pm b.pm >two.pm
	p2m <a.pm >alone.pm
	got=0
	p2m <two.pm >out.pm 2>err || got=$?
	[ $got = 1 ]
	grep -q '^p2m: frame 2: ' err
	[ "$(wire messages out.pm)" = "1 $(cat err)" ]
	cmp -n "$(($(wc -c <alone.pm) - 64))" alone.pm out.pm
}

@test "a stream on a terminal is refused with a hint: exit 2, for every tool that writes one" {
	cloud >in.pm
	for t in $(tools); do
		writes_text "$t" && continue
		[ "$t" = pinit ] && line="pinit uniform -n 12 --cells 4" || { input "$t" >in.pm && cp in.pm same.pm && line="$(words "$t") <in.pm"; }
		got=0
		script -qec "bash -c $(printf %q "$line")" /dev/null >screen </dev/null || got=$?
		[ $got = 2 ] && grep -q "$t: .*standard output is a terminal.*sls" screen && ! grep -q PMPIPE screen || { echo "$t: exit status $got"
		cat -A screen | head; return 1; }
	done
}

@test "a stage writes frame k completely before it reads k+1" {
	cloud >a.pm
	p2m <a.pm >want.pm
	coproc P { p2m 2>err; }
	# The frame without the end marker: the output must come while the input is still open.
	wire cut a.pm before-end-line >&"${P[1]}"
	timeout 5 head -c $(($(wc -c <want.pm) - 64)) <&"${P[0]}" >got.pm
	cmp -n "$(wc -c <got.pm)" want.pm got.pm
	[ "$(wc -c <got.pm)" = $(($(wc -c <want.pm) - 64)) ]
	exec {P[1]}>&-
	wait
}

@test "equal runs give equal bytes, for every tool that writes a stream" {
	for t in $(readers); do
		writes_text "$t" && continue
		input "$t" >in.pm
		cp in.pm same.pm
		bash -c "$(words "$t")" <in.pm >one.pm
		bash -c "$(words "$t")" <in.pm >two.pm
		cmp one.pm two.pm
	done
}

@test "state between frames is only a cache: a frame gives the same result after others as alone" {
	for t in $(readers); do
		writes_text "$t" && continue
		case $t in stack | scmp) continue ;; esac # they take a second stream, frame by frame
		# odd and even: buffers that are exchanged at every frame
		input "$t" >in.pm
		wire edit in.pm 'h["seed"] = 5; put("x", 0, 0.25)' >other.pm
		bash -c "$(words "$t")" <in.pm >alone.pm
		for before in 1 2; do
			wire frames $(yes other.pm | head -n $before) in.pm >many.pm
			bash -c "$(words "$t")" <many.pm | tail -c "$(wc -c <alone.pm)" >last.pm
			cmp <(head -c -64 alone.pm) <(head -c -64 last.pm) || { echo "$t after $before others"; return 1; }
		done
	done
}

@test "history: one entry per stage with the options that change results, none for those that do not, none twice" {
	pinit uniform -n 12 --cells 4 --threads 2 | push drift | push drift | p2m --kernel tsc --threads 1 >a.pm
	wire header a.pm | python3 -c '
import json, sys
h = json.load(sys.stdin)["history"]
assert [e["program"] for e in h] == ["pinit", "push", "p2m"], h
assert h[2]["options"] == {"kernel": "tsc"}, h
assert "threads" not in h[0]["options"], h'
	pinit uniform -n 12 --cells 4 --no-history | push drift --no-history >b.pm
	[ "$(wire header b.pm | python3 -c 'import json, sys; print(len(json.load(sys.stdin)["history"]))')" = 0 ]
}

# Green's functions and hierarchies are made at the first frame: a third (poisson-fft) and a fifth of three solves on 32^3 cells; begin and plan alone
# are a hundredth.
@test "--timing: the one-time preparation of a solver is set-up, not work" {
	pinit plummer -n 100 --cells 32 | p2m >a.pm
	for word in poisson-fft poisson-mg; do
		cat a.pm a.pm a.pm | "$word" --timing t >/dev/null
	done
	awk -F'\t' '!($2 > $3 / 30 && $3 > 0) { print; bad = 1 } END { exit bad || NR != 2 }' t
}

@test "--timing - says on standard error what a word cost; of cycle a table of its words, whose shares add to 100 %" {
	pinit uniform -n 12 --cells 4 | p2m --timing - 2>err >/dev/null
	grep -qE '^p2m: [0-9.]+ (s|ms|us) of work, [0-9.]+ (s|ms|us) of set-up$' err
	pinit plummer -n 3000 | cycle -n 3 --timing - 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' 2>err >/dev/null
	[ "$(head -n 1 err | tr -s ' ')" = 'word set-up work share' ]
	grep -qE '^poisson-fft +[0-9.]+ (s|ms|us) +[0-9.]+ (s|ms|us) +[0-9]+ %$' err
	within "$(awk '/ %$/ { sum += $(NF - 1) } END { print sum }' err)" 100 3 # six roundings to one per cent
	grep -qE '^cycle -n 3 .*: [0-9.]+ (s|ms) of work' err
	pinit two-body | cycle -n 3 --engine pipes --timing - 'push kick/2 drift | pp | push kick/2' 2>err >/dev/null
	grep -q '^the words ran as processes, whose times are not measured' err
}

@test "--timing appends the word, its seconds of set-up and of work, and those of the processors" {
	pinit uniform -n 12 --cells 4 | p2m --timing t.tsv >/dev/null
	pinit uniform -n 12 --cells 4 | p2m --kernel tsc --timing t.tsv >/dev/null
	[ "$(wc -l <t.tsv)" = 2 ]
	awk -F'\t' 'NF != 4 || $2 !~ /^[0-9.]+$/ || $3 !~ /^[0-9.]+$/ || $4 !~ /^[0-9.]+$/ { bad = 1 } END { exit bad }' t.tsv
	[ "$(cut -f1 t.tsv | tail -n 1)" = "p2m --kernel tsc" ]
}

# One thread cannot use more processor time than wall time (5 ms for the ticks of the two clocks); on a loaded machine it uses less.
@test "--timing: one thread uses no more seconds of the processors than of the clock, and of cycle the processes count" {
	pinit plummer -n 20000 | pp --threads 1 --timing t >/dev/null
	awk -F'\t' '!($4 > 0 && $4 < $3 + 0.005) { print; exit 1 }' t
	pinit plummer -n 20000 | cycle -n 1 --engine pipes --threads 1 --timing u 'push drift | pp' >/dev/null
	awk -F'\t' -v pp="$(cut -f4 t)" '/^cycle/ && $4 < pp / 2 { print; exit 1 }' u # half: the state of the machine
}

@test "-i and -o stand for standard input and output" {
	cloud >a.pm
	p2m <a.pm >b.pm
	p2m -i a.pm -o c.pm
	cmp b.pm c.pm
	run -1 p2m -i nosuch.pm -o d.pm
	[[ $output == "p2m: "*"cannot open 'nosuch.pm'"*"No such file"* ]]
	run -1 p2m -i a.pm -o /nosuch/d.pm
	[[ $output == "p2m: "*"cannot write '/nosuch/d.pm'"* ]]
}

# peak COMMAND <FILE: the smallest sufficient address space in MB, on one thread, by bisection to 8 MB
peak() {
	local low=0 high=2000 mid
	cat >begin
	while [ $((high - low)) -gt 8 ]; do
		mid=$(((low + high) / 2))
		if (ulimit -v $((mid * 1024)) && OMP_NUM_THREADS=1 "$@" <begin >/dev/null 2>&1); then high=$mid; else low=$mid; fi
	done
	echo $high
}

@test "a stage holds only the fields it reads: poisson-fft's memory does not depend on the number of particles" {
	[ -z "$PM_SANITIZED" ] || skip "the memory of a sanitized program says nothing"
	pinit uniform -n 1000 --cells 8 | p2m >small.pm
	pinit uniform -n 1000000 --cells 8 | p2m >large.pm
	[ "$(wc -c <large.pm)" -gt 48000000 ]
	within "$(peak poisson-fft <large.pm)" "$(peak poisson-fft <small.pm)" 10 "megabytes" # one step of the bisection
}

@test "a fused step in any order needs 1.5 times the bytes of all fields at its end at most: records become accelerations and velocities" {
	[ -z "$PM_SANITIZED" ] || skip "the memory of a sanitized program says nothing"
	local n=1000000
	step() { cycle -q -n 2 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'; }
	pinit uniform -n 1000 --cells 10 >small.pm
	pinit uniform -n $n --cells 100 >large.pm
	# 56 bytes of state, 24 of accelerations, 40 of rho, phi and its gradient; what is asked for and not touched counts too; bisected to 8 MB
	awk -v most="$(peak step <large.pm)" -v least="$(peak step <small.pm)" -v n=$n \
		'BEGIN { ratio = (most - least) * 1048576 / (120 * n); print ratio; exit !(ratio > 1 && ratio < 1.5) }'
}
