#!/usr/bin/env bash
# Fuzzes: run.sh SECONDS [NAME...] runs each harness of this directory (or those named) for that long, and ends with `N passed, N failed, N skipped`.
# Harnesses in C are libFuzzer's; `sealed` is the reader with checksums of lines on. Those in shell and Python get the seconds and a seed (SEED=n; default:
# the clock). A failure is told with its input, which stays in $B/fuzz/found/; $B/fuzz/NAME/ keeps the inputs that reached something new, from where the
# next run goes on. All results go to $B/fuzz/log.tsv: date, name, inputs, failures. SPDX-License-Identifier: GPL-3.0-or-later
set -u
cd "$(dirname "$0")/../.." || exit 1
seconds=$1
shift
[ $# != 0 ] || set -- reader sealed pmpipe-read table expression sentence braces hdf5
B=${B:-build/asan-clang}
here=$PWD work=$PWD/$B/fuzz
mkdir -p "$work/found" "$work/empty"
export LC_ALL=C OMP_NUM_THREADS=1
export ASAN_OPTIONS=allocator_may_return_null=1:max_allocation_size_mb=256:malloc_context_size=4:quarantine_size_mb=8
export LSAN_OPTIONS=suppressions=$here/tests/leaks.txt:print_suppressions=0

# library NAME PROGRAM [CORPUS]: libFuzzer, in an empty directory; the first corpus directory gets what is new.
library() {
	local -a corpus=("$work/$1")
	mkdir -p "$work/$1"
	for dir in "$here/tests/fuzz/corpus/${3:-$2}" "$here/tests/fuzz/crashes/${3:-$2}"; do [ ! -d "$dir" ] || corpus+=("$dir"); done
	if [ "$1" = sealed ]; then unset PM_UNSEALED; else export PM_UNSEALED=1; fi
	cd "$work/empty" && timeout $((seconds + 120)) "$here/$B/tests/fuzz/$2" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=2048 \
		-artifact_prefix="$work/found/$1-" -print_final_stats=1 -verbosity=1 "${corpus[@]}"
}

# one NAME: runs it and prints its count of inputs, or the end of its log.
one() {
	local name=$1 log=$work/$1.log status inputs
	case $name in
	sealed) library sealed reader ;;
	pmpipe-read) library pmpipe-read pmpipe-read reader ;;
	braces) bash tests/fuzz/braces.sh "$seconds" "${SEED:-$(date +%s)}" ;;
	hdf5) python3 tests/fuzz/hdf5.py "$seconds" "${SEED:-$(date +%s)}" "$work/found" ;;
	*) library "$name" "$name" ;;
	esac >"$log" 2>&1
	status=$?
	inputs=$(sed -n 's/^stat::number_of_executed_units: //p' "$log" | tail -n 1)
	printf '%s\t%s\t%s\t%s\n' "$(date -u +%F)" "$name" "${inputs:-0}" "$((status != 0))" >>"$work/log.tsv"
	if [ $status = 0 ] && [ "${inputs:-0}" != 0 ]; then
		echo "fuzz: $name: $inputs inputs in $seconds s"
		return 0
	fi
	echo "fuzz: $name failed with exit status $status:"
	grep -vaE '^(#[0-9]|"|###)' "$log" | tail -n 40
	return 1
}

# As many at a time as there are processors: a harness is one thread.
marks=$(mktemp -d)
for name; do
	while [ "$(jobs -rp | wc -l)" -ge "$(nproc)" ]; do wait -n; done
	{ said=$(one "$name") && : >"$marks/$name"; printf '%s\n' "$said"; } &
done
wait
passed=$(find "$marks" -type f | wc -l) failed=$(($# - passed))
rm -r "$marks"
echo "$passed passed, $failed failed, 0 skipped"
[ $failed = 0 ]
