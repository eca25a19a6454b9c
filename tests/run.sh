#!/usr/bin/env bash
# Runs what is built: the unit tests and the bats files (all, or those named; `unit` names the unit tests). What fails is shown with its
# reasons; the last line counts. B: where it was built; PM_WRAP: a command put before each unit test (valgrind).
# SPDX-License-Identifier: GPL-3.0-or-later
set -u
cd "$(dirname "$0")/.." || exit 1
B=${B:-build}
[ "$B" = build ] && bin=$PWD/bin || bin=$PWD/$B/bin
export PM_BIN=$bin
export LC_ALL=C OMP_WAIT_POLICY=passive # threads that wait leave the core to the other stages of a pipe
passed=0 failed=0 skipped=0

# As many at a time as there are processors. One that dies, or says so by its exit status alone, counts as one failure.
# shellcheck disable=SC2016 # what is in single quotes is for the inner shell
unit_tests() {
	local t out status bad results=$B/unit-results
	mkdir -p "$results"
	find tests/unit -name '*.c' | sed 's|.*/||; s|\.c$||' | sort |
		B=$B results=$results xargs -r -P "$(nproc)" -I{} sh -c '${PM_WRAP:-} "$B/tests/unit/{}" >"$results/{}" 2>&1 </dev/null; echo $? >>"$results/{}"'
	for t in tests/unit/*.c; do
		t=${t##*/} t=${t%.c}
		status=$(tail -n 1 "$results/$t")
		out=$(sed '$d' "$results/$t")
		bad=$(grep -c '^not ok' <<<"$out")
		passed=$((passed + $(grep -c '^ok' <<<"$out")))
		[ "$status" != 0 ] && [ "$bad" = 0 ] && bad=1 && out+=$'\n'"not ok - exit status $status"
		failed=$((failed + bad))
		[ "$bad" = 0 ] || printf '%s\n' "--- $B/tests/unit/$t" "$(grep -v '^ok' <<<"$out" | head -n 40)"
	done
}

# A test that never reported (a bats file that does not parse, a run cut short) counts as failed.
bats_tests() {
	local jobs=() tap=$B/check.tap
	parallel --version 2>/dev/null </dev/null | grep -q 'GNU parallel' && jobs=(-j "$(nproc)")
	bats "${jobs[@]}" --formatter tap "$@" 2>&1 | tee "$tap" | awk '/^not ok/ { bad = 1 } /^ok/ { bad = 0 } bad || !/^(ok|#|1\.\.)/ { print; fflush() }'
	[ -s "$tap" ] || echo "not ok bats did not run" >"$tap"
	local planned seen skips bad
	planned=$(sed -n '1s/^1\.\.//p' "$tap")
	seen=$(grep -cE '^(not )?ok' "$tap")
	bad=$(grep -c '^not ok' "$tap")
	skips=$(grep -cE '^ok .*# skip' "$tap")
	[ "${planned:-0}" -gt "$seen" ] && echo "not ok: $((planned - seen)) tests did not report" && bad=$((bad + planned - seen))
	passed=$((passed + seen - $(grep -c '^not ok' "$tap") - skips))
	failed=$((failed + bad))
	skipped=$((skipped + skips))
}

files=()
for f in "$@"; do
	[ "$f" = unit ] || files+=("$f")
done
[ $# = 0 ] && files=(tests/tool tests/physics tests/hard)
wanted=()
for f in "${files[@]}"; do
	[ -f "$f" ] && wanted+=("$f")
	[ -d "$f" ] && while IFS= read -r g; do wanted+=("$g"); done < <(find "$f" -name '*.bats' | sort)
done
if [ $# = 0 ] || [[ " $* " == *" unit "* ]] || [ "$B" != build ]; then unit_tests; fi
[ ${#wanted[@]} = 0 ] || bats_tests "${wanted[@]}"
echo "$passed passed, $failed failed, $skipped skipped"
[ $failed = 0 ] && [ $((passed + skipped)) != 0 ]
