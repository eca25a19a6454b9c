#!/usr/bin/env bash
# Runs the built tests: the unit tests and the bats files (all, or those named; `unit` names the unit tests), one more at a time than there are processors.
# Prints its progress every ten seconds, failures with their reasons, skipped tests by name, and the counts in the last line. The reports stay in $B/check/,
# with the time of every test. B: the build directory; REPORTS: another place for the reports; PM_WRAP: a command put before each unit test (valgrind).
# LEAVE_OUT: unit tests not to run, as poisson-fft|transfer.
# SPDX-License-Identifier: GPL-3.0-or-later
set -u
cd "$(dirname "$0")/.." || exit 1
export B=${B:-build}
reports=${REPORTS:-$B/check}
[ "$B" = build ] && PM_BIN=$PWD/bin || PM_BIN=$PWD/$B/bin
export PM_BIN reports
export PM_MANY_TURNS=16384             # threads on small frames too
export LC_ALL=C OMP_WAIT_POLICY=passive # waiting threads must not occupy the cores of the other stages of a pipe

# suites [FILE...]: the test files, one per line. The long ones come first, so that no core is idle at the end: those that take half a minute, then the others
# by their size.
suites() {
	local f
	if [ $# = 0 ]; then
		{
			printf 'tests/%s.bats\n' tool/{ranks,plan,ways,ranks-random,margin,house,pareto,hostile,contract} physics/vortex \
				tool/{readme,course,cut-stream,python,sh5,foreign-readers,command,plan-random}
			ls -S tests/hard/*.bats tests/physics/*.bats
			ls -S tests/tool/*.bats
		} | awk '!there[$0]++'
	fi
	for f; do
		[ "$f" = unit ] && continue
		[ -d "$f" ] && find "$f" -name '*.bats' | sort || echo "$f"
	done
	if [ $# = 0 ] || [[ " $* " == *" unit "* ]] || [ "$B" != build ]; then
		{
			printf 'tests/unit/%s.c\n' poisson-mg-variable transfer transfer-ranks pm-force poisson-mg dcpse
			ls -S tests/unit/*.c
		} | awk '!there[$0]++' | grep -vxE "tests/unit/(${LEAVE_OUT:-})\.c"
	fi
}

# suite FILE: its report, then its failures. A file that does not parse, an incomplete run and a program that crashes count as failures.
suite() {
	local name=${1#tests/} report status planned seen
	name=${name%.*}
	report=$reports/${name//\//-}
	if [[ $1 == *.c ]]; then
		${PM_WRAP:-} "$B/tests/$name"
	else
		bats --formatter tap --timing "$1"
	fi >"$report.tap" 2>&1 </dev/null
	status=$?
	planned=$(sed -n '1s/^1\.\.//p' "$report.tap")
	seen=$(grep -cE '^(not )?ok' "$report.tap")
	if [ "${planned:-0}" -gt "$seen" ]; then
		echo "not ok - $((planned - seen)) tests did not report" >>"$report.tap"
	elif { [ $status != 0 ] || [ "$seen" = 0 ]; } && ! grep -q '^not ok' "$report.tap"; then
		echo "not ok - exit status $status" >>"$report.tap"
	fi
	touch "$report.done"
	grep -q '^not ok' "$report.tap" || return 0
	printf '%s\n' "--- $1" "$(awk '/^ok/ { bad = 0 } /^not ok/ { bad = 1 } bad || !/^(ok|1\.\.)/' "$report.tap" | head -n 60)"
}
export -f suite

# count PATTERN: the number of lines in all reports that match it.
count() { cat "$reports"/*.tap 2>/dev/null | grep -cE "$1"; }

# Prints a line every ten seconds (EVERY) until its standard input is closed.
signs_of_life() {
	local finished
	while read -r -t "${EVERY:-10}"; [ $? -gt 128 ]; do
		finished=("$reports"/*.done)
		[ -e "${finished[0]}" ] || finished=()
		echo "check: ${#finished[@]} of $1 files, $(count '^(not )?ok') tests, $(count '^not ok') failed, $SECONDS s"
	done
}

# The files that differ from the commit, except build/ and bin/.
tree() { git status --porcelain --ignored --untracked-files=all 2>&1 | grep -vE '^!! (build|bin)/'; }

# Tests that the tests leave the tree as it was. $1: the tree before.
tree_test() {
	local now
	if ! git rev-parse --git-dir >/dev/null 2>&1; then
		echo "ok 1 the tests leave the tree as it was # skip no git, or no repository of it, here"
	elif now=$(tree); [ "$now" = "$1" ]; then
		echo "ok 1 the tests leave the tree as it was"
	else
		echo "not ok 1 the tests leave the tree as it was: besides the commit there are now, or no longer,"
		diff <(echo "$1") <(echo "$now") | sed -n 's/^[<>]/#&/p'
	fi
}

rm -rf "$reports"
mkdir -p "$reports"
# If python3 is a wrapper script (pyenv: 0.1 s per start), the tests, which start it a thousand times, use the real python3.
python=$(python3 -c 'import sys; print(sys.executable)' 2>/dev/null)
if [ -n "$python" ] && ! [ "$python" -ef "$(command -v python3)" ]; then
	mkdir "$reports/bin"
	printf '#!/bin/sh\nexec "%s" "$@"\n' "$python" >"$reports/bin/python3"
	chmod +x "$reports/bin/python3"
	PATH=$(cd "$reports/bin" && pwd):$PATH
fi
mapfile -t all < <(suites "$@")
before=$(tree)
exec {life}> >(signs_of_life ${#all[@]})
ticker=$!
# One file more than processors: a file waits (pipes, sleeps, limits of time) for a quarter of its time.
# shellcheck disable=SC2016 # for the inner shell
printf '%s\n' "${all[@]}" | xargs -r -d '\n' -P "$(($(nproc) + 1))" -I{} bash -c 'suite "$1"' _ {} {life}>&-
exec {life}>&-
wait "$ticker"
tree_test "$before" | tee "$reports/tree.tap" | grep -v '^ok'

skipped=$(count '^ok .*# skip')
[ "$skipped" = 0 ] || echo "skipped:"
for report in "$reports"/*.tap; do
	name=${report##*/}
	sed -nE "s|^ok [0-9]+ (.*) # skip ?(.*)|    ${name%.tap}: \1: \2|p" "$report" | sed -E 's/ in [0-9]+ms: /: /'
done
echo "check: $SECONDS s"
failed=$(count '^not ok')
echo "$(($(count '^ok') - skipped)) passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ]
