# The promises of docs/reliability.md: files stay intact, runs can be stopped, nothing ends without a message. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

export OMP_NUM_THREADS=1

# told STATUS PATTERN COMMAND LINE: that exit status, the pattern on standard error, and no signal.
told() {
	run "-$1" --separate-stderr timeout 30 bash -o pipefail -c "$3"
	# shellcheck disable=SC2053
	[[ $stderr == $2 ]] || { echo "$3: $stderr"; return 1; }
}

@test "an unknown law, kernel or mollifier is reported by every word, and none crashes" {
	pinit plummer -n 5 --no-history --dt 0.01 | p2m -n 4 | poisson-fft | mgrad | m2p >good
	edited 's/"name":"gravity"/"name":"grauity"/' good >law
	edited 's/"kernel":"cic"/"kernel":"cyc"/g' good >kernel
	run ! cmp -s good law
	run ! cmp -s good kernel
	for f in law kernel; do
		while read -r word; do
			run timeout 30 bash -c "$word <$f 2>&1 >out"
			[[ $status = 0 || ( $status = [123] && -n $output ) ]] || { echo "$word: status $status: $output"; return 1; }
		done <<-'END'
			pp --replace
			p2m --replace
			m2p --replace
			m2p --field rho --target v
			poisson-fft
			poisson-mg
			poisson-relax
			mgrad
			diffuse --nu 1
			pse --nu 1
			remesh
			dt
			dt --plasma 0.1
			diag
			diag --pair
			diag --exact
			plan
			push drift
			sls
			scmp - good
			sdraw -o x.png
			smod --constant softening=1
			walk --nu 1
			cycle -n 1 --until 'energy > 1e9' 'push kick/2 drift | pp | push kick/2'
			cycle -n 1 --plan
			cycle -n 1 --engine pipes 'push kick/2 drift | pp | push kick/2'
		END
	done
	told 1 "pp: frame 1: no law named grauity" "pp --replace <law >out"
}

@test "-o may name the input: it is replaced when the new file is whole, and stays where the command fails" {
	pinit plummer -n 50 >a.pm
	p2m -n 8 <a.pm >want.pm
	cp a.pm b.pm
	p2m -n 8 -i a.pm -o a.pm
	cmp <(sls -i want.pm --format json | jq -c .fields) <(sls -i a.pm --format json | jq -c .fields)
	cp b.pm a.pm
	told 1 "*" "push kick -i a.pm -o a.pm"
	cmp a.pm b.pm
	told 1 "*" "head -c 3000 b.pm | p2m -n 8 -o a.pm"
	cmp a.pm b.pm
	diag -i a.pm -o a.pm
	[ "$(column step <a.pm)" = 0 ]
	cp b.pm a.pm
	diag -i a.pm --tee a.pm >out.pm
	[ "$(column step <a.pm)" = 0 ]
	cmp <(sls -i out.pm --format json | jq -c .fields) <(sls -i b.pm --format json | jq -c .fields)
	[ "$(ls -A | grep -v separate-stderr | sort | tr '\n' ' ')" = "a.pm b.pm out.pm want.pm " ] || { ls -A; false; }
}

@test "-o and --checkpoint follow a symbolic link, keep the mode of the file, and touch no FILE.part" {
	mkdir there
	pinit two-body >there/real.pm
	chmod 640 there/real.pm
	ln -s there/real.pm link.pm
	for f in link.pm there/real.pm; do echo mine >$f.part; done
	pinit two-body | cycle -n 2 'push kick/2 drift | pp | push kick/2' -o link.pm
	pinit two-body | cycle -n 3 --checkpoint link.pm 'push kick/2 drift | pp | push kick/2' >/dev/null
	[ -L link.pm ]
	[ "$(sls -i there/real.pm --format json | jq .step)" = 3 ]
	[ "$(stat -c %a there/real.pm)" = 640 ]
	[ "$(cat link.pm.part there/real.pm.part)" = $'mine\nmine' ]
	ln -s there/real.h5 link.h5
	echo mine >there/real.h5.part
	pinit two-body | sh5 -o there/real.h5
	pinit two-body | cycle -n 2 --checkpoint link.h5 'push kick/2 drift | pp | push kick/2' >/dev/null
	[ -L link.h5 ]
	[ "$(sh5 there/real.h5 | sls --format json | jq .step)" = 2 ]
	[ "$(cat there/real.h5.part)" = mine ]
	[ "$(ls -A there | wc -l)" = 4 ]
	[ "$(stat -c %a there/real.h5)" = "$(touch x && stat -c %a x)" ]
}

@test "- is standard output, or refused, and never a file of that name" {
	pinit two-body >a.pm
	[ "$(p2m -n 4 -i - -o - <a.pm | sls --format json | jq .step)" = 0 ]
	diag -i a.pm -o - | grep -q step
	pinit two-body -o - | cmp - a.pm
	told 2 "*sh5*-o -*" "sh5 -o - <a.pm"
	told 2 "*--tee -*" "diag --tee - <a.pm >/dev/null"
	told 2 "*--checkpoint '-'*" "cycle -n 1 --checkpoint - 'push drift' <a.pm >/dev/null"
	p2m -n 4 --timing - <a.pm 2>said >/dev/null
	grep -q '^p2m -n 4' said
	sdraw -i a.pm -o - | head -c 4 | grep -q PNG
	[ ! -e - ]
}

@test "two cycles with one checkpoint: the second is refused, and that of the first can be resumed" {
	mkfifo hold
	cat >pause <<-'SH'
		#!/bin/sh
		[ -e held ] || { touch held; cat hold >/dev/null; }
		exec cat
	SH
	chmod +x pause
	for c in c.pm c.h5; do
		rm -f held
		pinit two-body | cycle -n 1 --checkpoint $c 'push kick/2 drift | pp | push kick/2' >/dev/null
		pinit two-body | PATH=$PWD:$PATH cycle -n 3 --checkpoint $c 'push kick/2 drift | pp | push kick/2 | pause' >one.pm &
		first=$!
		for _ in $(seq 200); do [ -e held ] && break; sleep 0.05; done
		told 1 "cycle: *'$c' is the checkpoint of another cycle that runs*" \
			"pinit two-body | cycle -n 2 --checkpoint $c 'push kick/2 drift | pp | push kick/2' >two.pm"
		: >hold
		wait $first
		cycle --resume $c -n 4 'push kick/2 drift | pp | push kick/2' --checkpoint $c | sls --format json >s
		[ "$(jq .step s)" = 4 ]
	done
	# without a file to begin with, too: whatever happens, the file is whole
	for i in 1 2 3 4 5; do
		rm -f d.pm
		for k in 1 2 3; do (pinit plummer -n 2000 | cycle -n 3 --every 1 --checkpoint d.pm 'push drift' >/dev/null 2>said.$k ||
			grep -q 'another cycle' said.$k) & done
		wait
		sls -i d.pm >/dev/null
	done
	[ -z "$(ls -A | grep '^\.')" ]
}

@test "a full disk is reported with the name of the file: --timing, --checkpoint, -o" {
	[ -e /dev/full ] || skip "no /dev/full here"
	told 1 "p2m: *'/dev/full'*" "pinit uniform -n 9 | p2m -n 4 --timing /dev/full >/dev/null"
	told 1 "cycle: *'/dev/full'*" "pinit two-body | cycle -n 1 --timing /dev/full 'push drift' >/dev/null"
	told 1 "p2m: *'/nowhere/t'*" "pinit uniform -n 9 | p2m -n 4 --timing /nowhere/t >/dev/null"
	# a limit on the size of files stands for a full disk
	pinit uniform -n 99 | cycle -n 1 --checkpoint c.pm 'push drift' >/dev/null
	cp c.pm before.pm
	told 1 "cycle: *c.pm*: File too large*" "trap '' XFSZ; pinit uniform -n 9999 | (ulimit -f 8; cycle -n 2 --checkpoint c.pm 'push drift') >/dev/null"
	cmp c.pm before.pm
}

# swallowing SIGNAL...: a cycle whose process takes the third frame and never answers gets the signals, a second apart; what it left is in c.pm.
swallowing() {
	cat >swallow <<-'SH'
		#!/usr/bin/env python3
		import os, sys, time
		n, line = 0, sys.stdin.buffer.read(64)
		while line:
		    sys.stdout.buffer.write(line)
		    w = line.split()
		    if w[1] == b"frame":
		        n += 1
		        if n == 3:
		            open("swallowed", "w").close()
		            time.sleep(60)
		        sys.stdout.buffer.write(sys.stdin.buffer.read(int(w[2]) + int(w[3])))
		    elif w[1] == b"tail":
		        sys.stdout.buffer.write(sys.stdin.buffer.read(int(w[2])))
		        sys.stdout.buffer.flush()
		    line = sys.stdin.buffer.read(64)
		sys.stdout.buffer.flush()
	SH
	chmod +x swallow
	rm -f c.pm swallowed
	pinit two-body >in.pm
	PATH=$PWD:$PATH env --default-signal=TERM,HUP,INT cycle -n 9 --checkpoint c.pm 'push kick/2 drift | swallow | pp | push kick/2' -i in.pm >out.pm \
		2>said &
	pid=$!
	for _ in $(seq 200); do [ -e swallowed ] && break; sleep 0.05; done
	for s; do kill -"$s" $pid; sleep 1; done
	for _ in $(seq 100); do kill -0 $pid 2>/dev/null || break; sleep 0.05; done
	kill -9 $pid 2>/dev/null && { echo "it did not end"; return 1; }
	wait $pid && return 1
	cat said
	grep -q 'waits for the processes of this step' said
	grep -q 'continue with --resume c.pm' said
	steps=$(sls -i c.pm --format json | jq .step)
	[ "$steps" = 1 ] || [ "$steps" = 2 ]
	cycle --resume c.pm -n 9 'push kick/2 drift | pp | push kick/2' >got.pm
	cycle -i in.pm -n 9 'push kick/2 drift | pp | push kick/2' >want.pm
	cmp <(stab -i got.pm | grep -v '^#') <(stab -i want.pm | grep -v '^#')
}

@test "a process that never answers: the second signal gives up its step and leaves the checkpoint of the one before" {
	swallowing TERM TERM
	swallowing HUP TERM
}

@test "SIGHUP ends a cycle as SIGTERM does, with its checkpoint; under nohup it goes on" {
	pinit two-body >in.pm
	env --default-signal=HUP cycle -n 100000000 --checkpoint c.pm 'push drift' -i in.pm >out.pm 2>said &
	pid=$!
	sleep 1
	kill -HUP $pid
	wait $pid && return 1
	grep -q 'stopped by signal 1 after step [0-9]*, continue with --resume c.pm' said
	sls -i c.pm >/dev/null
	env --ignore-signal=HUP cycle -n 100000000 --checkpoint c.pm 'push drift' -i in.pm >out.pm 2>said &
	pid=$!
	sleep 1
	kill -HUP $pid
	sleep 0.5
	kill -0 $pid
	kill -TERM $pid
	wait $pid && return 1
	grep -q 'stopped by signal 15' said
}

@test "a library that ends the process: a message, an abort, exit 1" {
	pinit uniform -n 20000 | p2m -n 16 >mesh.pm
	run --separate-stderr bash -c 'ulimit -v 3000000; OMP_NUM_THREADS=8 OMP_STACKSIZE=1G poisson-fft <mesh.pm >out.pm'
	[[ $stderr == *libgomp* ]] || skip "libgomp starts its threads here: $stderr"
	[ "$status" = 1 ]
	[[ $stderr == *"poisson-fft: frame 1: ended by a library before it was done"* ]]
	told 1 "*stopped by poisson-fft: *ended by a library*" "sls <out.pm"
}

@test "a header of a few hundred bytes does not become gigabytes" {
	pinit uniform -n 9 --no-history >a.pm
	wire edit a.pm '
for s in h["sets"]: s["n"] = 2 ** 31
for i, f in enumerate(h["fields"]): f["uniform"], data[i] = [0.5] * f["components"], b""' >bomb.pm
	[ "$(wc -c <bomb.pm)" -lt 4000 ]
	for word in 'push drift --dt 1' 'cycle -n 1 "push --dt 1 drift"' 'scalc "a = x"' 'p2m -n 4' 'diag' 'dt --courant 1'; do
		told 1 "*uniform values only, and *GB would be made of them (PM_EXPAND_GB=*" \
			"ulimit -v 8000000; $word <bomb.pm | head -c 100000000 | wc -c >bytes"
		[ "$(cat bytes)" -lt 10000 ] || { echo "$word: $(cat bytes) bytes"; return 1; }
	done
	sls -i bomb.pm >/dev/null
}

@test "cycle --plan --resume runs no program that the history of a checkpoint names" {
	pinit plummer -n 20 | cycle -n 2 --plan --checkpoint c.pm >/dev/null
	cycle --resume c.pm --plan -n 3 | sls >/dev/null
	for words in "touch touched" "push drift | touch touched" "diag --tee touched | push drift"; do
		wire edit c.pm '
for e in h["history"]:
    if e["program"] == "cycle": e["arguments"] = ["'"$words"'"]' >evil.pm
		told 1 "cycle: *none of plan's*" "cycle --resume evil.pm --plan -n 3 >/dev/null"
		[ ! -e touched ]
	done
}

@test "an allocation that fails, anywhere, is a message and exit 1, or the same bytes: every 149th of twelve commands, alone and with all behind it" {
	[ -z "${PM_SANITIZED:-}" ] || skip "a sanitizer has its own malloc"
	run -0 python3 "$top/tests/fail-malloc.py" 149 pinit p2m-many poisson-fft poisson-mg mgrad m2p push remesh diag cycle-checkpoint pp stab
	[[ ${lines[-1]} == *", 0 with another outcome" ]] || { echo "$output"; return 1; }
}

@test "without memory for a checkpoint or an output nothing is left behind, and the checkpoint before stays" {
	[ -z "${PM_SANITIZED:-}" ] || skip "a sanitizer has its own malloc"
	run -0 python3 "$top/tests/fail-malloc.py" 499 push-file diag-file cycle-checkpoint sdraw sh5 sh5-write cycle-pipes
	[[ ${lines[-1]} == *", 0 with another outcome" ]] || { echo "$output"; return 1; }
}

# The header reader of a program with a main of its own, in which each calloc fails once: sets, meshes and fields are made by calloc.
@test "a header that the library has no memory for is a failure with that message, at every set, mesh and field" {
	[ -z "${PM_SANITIZED:-}" ] || skip "a sanitizer has its own malloc"
	pinit plummer -n 5 --no-history | p2m -n 4 | head -n 2 | tail -n 1 >header.json
	cat >reads.c <<'END'
#include <jansson.h>
#include <stdio.h>
#include <string.h>

#include "stream/declare.h"
#include "stream/header.h"

extern void *__libc_calloc(size_t n, size_t size);
static int left;

void *calloc(size_t n, size_t size) { return left && !--left ? NULL : __libc_calloc(n, size); }

int main(void)
{
	json_t *header = json_load_file("header.json", 0, NULL);
	int failed = 0;
	for (int n = 1; header; n++) {
		struct pm_frame *f = NULL;
		left = n;
		const int status = pm_header_frame(header, &f);
		if (left) {
			printf("%d\n", failed);
			return status != 0;
		}
		if (status != -PM_DATA || strcmp(pm_message(), "out of memory")) {
			printf("calloc %d: status %d, '%s'\n", n, status, pm_message());
			return 1;
		}
		failed++;
	}
	return 1;
}
END
	gcc -std=c11 -Wall -Wextra -Werror -I"$top/lib" -fopenmp -o reads reads.c "$top/build/libpmpipe.a" -lfftw3 -lgsl -lgslcblas -lpng -ljansson -lm
	run -0 ./reads
	[ "$output" -ge 6 ] # the frame, the set, its three fields, the mesh
}
