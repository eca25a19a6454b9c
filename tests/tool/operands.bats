# Files as arguments: streams read one after another, as cat would.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

setup() {
	cd "$BATS_TEST_TMPDIR" || return
	pinit uniform -n 12 --seed 3 --cells 4 >a.pm
	pinit uniform -n 13 --seed 4 --cells 4 >b.pm
}

@test "every word without other arguments reads a file as it reads standard input, to the byte" {
	for t in $(readers); do
		"$t" --help | grep -q '^usage: .*\[FILE\.\.\.\]' && [[ $t != sh5 && $t != stab && $t != sdraw && $t != plan ]] || continue # plan prints times
		count=$((${count:-0} + 1))
		input "$t" >in.pm
		bash -c "$(words "$t")" <in.pm >want
		bash -c "$(words "$t") in.pm" </dev/null >got
		cmp want got || { echo "$t"; return 1; }
	done
	above "$count" 17 'words that read files'
}

@test "several files are read one after the other: what cat gives, frames, end markers and all" {
	for t in p2m sls diag 'sel --every 2' 'stab --plain' stab; do
		cat a.pm b.pm a.pm | $t >want
		$t a.pm b.pm a.pm >got
		cmp want got || { echo "$t"; return 1; }
		$t a.pm - a.pm <b.pm >got
		cmp want got || { echo "$t with -"; return 1; }
	done
	p2m -- a.pm b.pm | cmp - <(cat a.pm b.pm | p2m)
	sls a.pm --report b.pm | cmp - <(cat a.pm b.pm | sls --report)
	sls <(cat a.pm) <(cat b.pm) | cmp - <(cat a.pm b.pm | sls)
}

# says PATTERN COMMAND LINE: exit status 1 or 2 and one line that matches.
says() {
	local got=0
	bash -c "$2" >out 2>err </dev/null || got=$?
	[[ $got == [12] && $(wc -l <err) = 1 ]] && grep -Eq -- "$1" err || { echo "$2: exit status $got"; cat err; return 1; }
}

@test "a file that is missing, cut, empty, text or a directory is one line that names it" {
	head -c 1000 a.pm >cut.pm
	: >empty.pm
	cat a.pm b.pm >two.pm
	head -c -64 two.pm >open.pm
	says "^sls: cannot open 'no.pm': No such file" 'sls a.pm no.pm'
	[ ! -s out ]
	says '^sls: cut.pm: frame 1: the input ends in .*: it was cut' 'sls a.pm cut.pm b.pm'
	says '^sls: open.pm: frame 3: the input ends without an end marker' 'sls open.pm b.pm'
	says '^p2m: empty.pm: frame 1: no input: zero bytes' 'p2m a.pm empty.pm b.pm'
	says '^sls: text: frame 1: this is not a pmpipe stream \(stab - reads text' 'echo 1 2 3 >text; sls text'
	says '^sls: \.: frame 1: cannot read: Is a directory' 'sls .'
	says '^sls: frame 1: this is an HDF5 file .*sh5 FILE' 'sh5 a.pm -o a.h5; sls <a.h5'
}

@test "standard input twice, -i beside a file, a file inside a sentence, a file for cycle: usage errors" {
	for line in 'sls - a.pm -' 'sls -i a.pm b.pm' "cycle -n 1 'p2m a.pm'" "cycle -n 1 'push drift' a.pm"; do
		run -2 --separate-stderr bash -c "$line <a.pm"
		[ "${#stderr_lines[@]}" = 1 ]
	done
	[[ $stderr == *'-i reads a file'* ]]
}

@test "an HDF5 file is known by its first bytes, under any name, and goes on into the next file" {
	sh5 a.pm b.pm -o run.h5
	cp run.h5 run.dat
	cat a.pm b.pm b.pm | p2m >want
	p2m run.h5 b.pm | cmp - want
	p2m run.dat b.pm | cmp - want
	p2m -i run.dat | cmp - <(cat a.pm b.pm | p2m)
	scmp --tolerance 0 run.dat run.h5 >/dev/null
	mkdir beside && cp "$(command -v sls)" beside
	run -1 --separate-stderr env PATH=/usr/bin:/bin beside/sls run.h5
	[[ $stderr == *'no program sh5, which .h5 files need'* && ${#stderr_lines[@]} = 1 ]]
	sdraw run.h5 && [ -s frame-0002.png ]
}

@test "stab and sh5 tell the kind by the first bytes: text, stream, HDF5" {
	stab a.pm >a.txt
	stab b.pm >b.txt
	sh5 a.pm -o a.h5
	cp a.txt text.pm
	stab text.pm | cmp - a.pm
	stab a.txt b.txt | cmp - <(cat a.txt b.txt | stab -)
	stab a.h5 | cmp - a.txt
	stab --plain a.h5 | cmp - <(stab --plain <a.pm)
	printf 'x y\n1 2\n' >one
	printf 'x y\n3 4\n5 6\n' >two
	[ "$(stab one two | diag --columns particles | tr '\n' ' ')" = 'particles 1 2 ' ]
	sh5 a.h5 a.h5 | cmp - <(cat a.pm a.pm)
	sh5 a.h5 b.pm -o both.h5
	sls both.h5 | cmp - <(sls a.pm b.pm)
	says "^sh5: 'a.pm' is a stream already" 'sh5 a.h5 a.pm'
	says '^stab: --plain and --mesh are for writing text' 'stab --plain a.txt'
	says '^stab: --law is for reading a table' 'stab --law gravity a.pm'
	says '^stab: two: line 2' "printf 'x y\n1\n' >two; stab one two"
}
