#!/usr/bin/env bash
# Instructions of the hot loops per particle, point or pair, counted by callgrind on one thread in a build without -march=native: a regression shows without
# timing. counts.sh PROGRAM writes bench/counts.tsv; counts.sh --check PROGRAM compares with it and fails beyond 3 %, or where the table has a count that was
# raised without a reason; --table and --renew-table run nothing and compare the given file with counts.tsv, or put it there. Prints "skipped" if valgrind
# is missing or the compiler differs from that of the file.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$0")/.."
file=${COUNTS:-$PWD/bench/counts.tsv}
CC=${CC:-gcc}
CC=${CC##* } # of "ccache gcc" the compiler
compiler="$(basename "$CC") $("$CC" -dumpfullversion 2>/dev/null || "$CC" -dumpversion) $("$CC" -dumpmachine)"

skip() { echo "counts: skipped, $1" && exit 0; }

# Two tables: every case of the first within 3 % of the second, and a reason in the second for every count that was raised.
compare() {
	awk -F'\t' '
		/^#/ { next }
		FNR == NR && $4 == "?" { print "not ok - " $1 ": more than before without a reason (write it in the last column)"; status = 1 }
		FNR == NR { was[$1] = $2; next }
		{
			seen[$1] = 1
			r = $1 in was ? $2 / was[$1] : 0
			bad = r < 0.97 || r > 1.03
			printf "%s - %s: %s instructions per %s, %s recorded%s\n", bad ? "not ok" : "ok", $1, $2, $3, $1 in was ? was[$1] : "none", \
				bad ? " (if that is meant: make counts)" : ""
			status = status || bad
		}
		END {
			for (c in was)
				if (!(c in seen)) { print "not ok - " c " was not counted"; status = 1 }
			exit status
		}' "$file" "$1"
}

# renew NEW: the table with new counts. Within 3 % more the old count stays, so that many small steps are seen too; beyond, the reason is asked for.
renew() {
	awk -F'\t' -v OFS='\t' '
		FNR == NR { was[$1] = $2; why[$1] = $4; next }
		/^# case/ { print "# case, instructions per item, item, why it is more than before"; next }
		/^#/ { print; next }
		!($1 in was) || $2 < was[$1] { print $1, $2, $3, (($1 in was) && $2 >= 0.97 * was[$1]) ? why[$1] : ""; next }
		$2 <= 1.03 * was[$1] { print $1, was[$1], $3, why[$1]; next }
		{ print $1, $2, $3, "?" }' "$file" "$1"
}

# count PROGRAM: the table.
count() {
	local scratch names
	scratch=$(mktemp -d)
	# shellcheck disable=SC2064 # expand the directory now
	trap "rm -rf '$scratch'" EXIT
	OMP_NUM_THREADS=1 valgrind -q --tool=callgrind --toggle-collect=pm_counted --dump-after=pm_counted --callgrind-out-file="$scratch/out" "$1" \
		>"$scratch/cases"
	echo "# $compiler"
	echo "# case, instructions per item, item"
	names=0
	while IFS=$'\t' read -r name per items; do
		names=$((names + 1))
		awk -v OFS='\t' -v name="$name" -v per="$per" -v items="$items" '/^(totals|summary):/ { print name, sprintf("%.4g", $2 / items), per;
			exit }' "$scratch/out.$names"
	done <"$scratch/cases"
}

if [ "$1" = --table ]; then
	compare "$2"
	exit
elif [ "$1" = --renew-table ]; then
	renew "$2" >"$file.part" && mv "$file.part" "$file"
	exit
fi
command -v valgrind >/dev/null || skip "no valgrind"
if [ "$1" = --check ]; then
	[ "$(sed -n '1s/^# //p' "$file")" = "$compiler" ] || skip "counts.tsv is of $(sed -n '1s/^# //p' "$file"), this is $compiler"
	count "$2" >build/counts.now
	compare build/counts.now
else
	count "$1" >build/counts.now
	renew build/counts.now >"$file.part" && mv "$file.part" "$file"
	cat "$file"
fi
