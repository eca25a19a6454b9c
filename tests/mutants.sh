#!/usr/bin/env bash
# Checks that the tests catch errors: plants those of tests/mutants.tsv, one at a time, in scratch copies of the tree, runs the test that should fail, and
# prints a line for each, caught or NOT CAUGHT; the last line counts them, without those whose test is skipped here. Exit 1 if one is not caught, cannot be
# planted, or does not build.
# bash tests/mutants.sh [NAME...] plants only those whose names begin with a NAME.
# A row of the list: name, file, old text (exactly once in the file), new text, and the test: `unit NAME` or `bats FILE FILTER`, where FILTER is part of
# the name of a test. SPDX-License-Identifier: GPL-3.0-or-later
set -u
cd "$(dirname "$0")/.." || exit 1
export LC_ALL=C OMP_WAIT_POLICY=passive OMP_NUM_THREADS=2 PM_MANY_TURNS=16384
limit=600 # [s] per test: one that takes longer decides nothing

# rows [NAME...]
rows() {
	awk -F'\t' '/^#/ || NF == 0 { next } NF != 5 { print "tests/mutants.tsv: line " NR " has " NF " columns, not 5" >"/dev/stderr"; exit 1 }
		{ print }' tests/mutants.tsv |
		if [ $# = 0 ]; then cat; else grep -E "^($(IFS='|'; echo "$*"))"; fi
}

# programs FILE: those that a bats file names, cycle and plan, which contain every word, and sh5; all of them if it loops over lists of programs.
programs() {
	local t
	grep -qE 'load words|pipelines/|README' "tests/$1" && echo all && return
	for t in tools/*.c tools/*.sh; do
		t=${t##*/} t=${t%.*}
		[[ $t =~ ^(cycle|plan|sh5)$ ]] || grep -qw -- "$t" "tests/$1" && echo "bin/$t"
	done
}

# sight WHAT: builds and runs a test in this directory; 0: it passes, 1: it fails, 2: it does not build, 3: there is no such test, 4: it took too long, 5: it is
# skipped on this machine.
# A unit test ends at its first failure.
sight() {
	local kind name filter status log=$PWD/mutant.log
	read -r kind name filter <<<"$1"
	if [ "$kind" = unit ]; then
		make -s OPT=-O1 "build/tests/unit/$name" >"$log" 2>&1 || return 2
		timeout $limit stdbuf -oL "build/tests/unit/$name" 2>&1 | tee "$log" | grep -q '^not ok' && return 1
		status=${PIPESTATUS[0]}
	else
		# shellcheck disable=SC2046 # names without blanks
		make -s OPT=-O1 $(programs "$name") >"$log" 2>&1 || return 2
		PM_BIN=$PWD/bin timeout $limit bats -f "$filter" "tests/$name" >"$log" 2>&1 </dev/null
		status=$?
		grep -q '^not ok' "$log" && return 1
		grep -q '^ok' "$log" || return 3
		grep '^ok' "$log" | grep -qv ' # skip' || return 5
	fi
	[ "$status" != 124 ] || return 4
	[ "$status" = 0 ]
}

# one ROW: in the copy of this lane. With an empty name: only the test, which must pass without an error planted.
one() {
	local name file old new what text rest seen
	IFS=$'\037' read -r name file old new what <<<"${1//$'\t'/$'\037'}" # columns may be empty
	cd "$scratch/$lane" || exit 1
	if [ "$name" = - ]; then
		sight "$what"
		seen=$?
		[ $seen = 0 ] || [ $seen = 5 ] || { echo "FAILS WITHOUT ERROR $what ($seen)"; tail -n 5 mutant.log | sed 's/^/	/'; }
		return
	fi
	[ -f "$file" ] || { echo "DOES NOT APPLY $name ($file is not there)"; return; }
	text=$(cat "$file"; printf x)
	rest=${text#*"$old"}
	if [ "$rest" = "$text" ] || [ "${rest#*"$old"}" != "$rest" ]; then
		echo "DOES NOT APPLY $name ($file: '$old' is not there once)"
		return
	fi
	cp -p "$file" original
	rest=${text%%"$old"*}$new$rest
	printf %s "${rest%x}" >"$file"
	sight "$what"
	seen=$?
	cp original "$file"
	case $seen in
	0) echo "NOT CAUGHT $name ($file; $what)" ;;
	1) echo "caught $name ($file; $what)" ;;
	2) echo "DOES NOT BUILD $name ($file)"; tail -n 5 mutant.log | sed 's/^/	/' ;;
	3) echo "DOES NOT APPLY $name (no test: $what)" ;;
	5) echo "NOT TESTED HERE $name (skipped: $what)" ;;
	*) echo "TOO LONG $name ($what)" ;;
	esac
}
if [ "${lane:-}" ]; then
	one "$1"
	exit 0
fi

lanes=$(nproc)
scratch=$(mktemp -d)
export scratch
trap 'rm -rf "$scratch"' EXIT
wanted=$(rows "$@") || exit 1
[ "$wanted" ] || { echo "tests/mutants.sh: no such name in tests/mutants.tsv" >&2; exit 1; }

# Built once, in a copy of the tracked and the new files (not the ignored ones); the other lanes are copies of that.
mkdir "$scratch/1"
git ls-files -co --exclude-standard -z | tar --null --ignore-failed-read -T - -cf - 2>/dev/null | tar -xf - -C "$scratch/1"
make -C "$scratch/1" -s -j"$lanes" OPT=-O1 all unit >"$scratch/build" 2>&1 || { tail -n 5 "$scratch/build"; exit 1; }
for ((l = 2; l <= lanes; l++)); do cp -a "$scratch/1" "$scratch/$l"; done

# First every test without an error, then the errors.
# shellcheck disable=SC2016 # single quotes: for the inner shell
{ cut -f5 <<<"$wanted" | sort -u | sed 's/^/-\t-\t-\t-\t/'; echo "$wanted"; } |
	xargs --process-slot-var=lane -d '\n' -n 1 -P "$lanes" sh -c 'lane=$((lane + 1)) exec bash "$scratch/1/tests/mutants.sh" "$1"' sh | tee "$scratch/lines"
caught=$(grep -c '^caught ' "$scratch/lines")
total=$(($(wc -l <<<"$wanted") - $(grep -c '^NOT TESTED HERE ' "$scratch/lines")))
echo "$caught of $total errors are caught"
[ "$caught" = "$total" ] && ! grep -q '^FAILS' "$scratch/lines"
