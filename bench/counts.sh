#!/usr/bin/env bash
# Instructions of the hot loops per particle, point or pair, counted by callgrind on one thread in a build without -march=native: a regression shows without
# timing. counts.sh PROGRAM writes bench/counts.tsv; counts.sh --check PROGRAM compares with it and fails beyond 5 %; --table runs nothing and compares the
# given file with counts.tsv. Prints "skipped" if valgrind is missing or the compiler differs from that of the file.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$0")/.."
file=${COUNTS:-$PWD/bench/counts.tsv}
CC=${CC:-gcc}
CC=${CC##* } # of "ccache gcc" the compiler
compiler="$(basename "$CC") $("$CC" -dumpfullversion 2>/dev/null || "$CC" -dumpversion) $("$CC" -dumpmachine)"

skip() { echo "counts: skipped, $1" && exit 0; }

# Two tables: every case of the first within 5 % of the second.
compare() {
	awk -F'\t' '
		/^#/ { next }
		FNR == NR { was[$1] = $2; next }
		{
			seen[$1] = 1
			r = $1 in was ? $2 / was[$1] : 0
			bad = r < 0.95 || r > 1.05
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
fi
command -v valgrind >/dev/null || skip "no valgrind"
if [ "$1" = --check ]; then
	[ "$(sed -n '1s/^# //p' "$file")" = "$compiler" ] || skip "counts.tsv is of $(sed -n '1s/^# //p' "$file"), this is $compiler"
	count "$2" >build/counts.now
	compare build/counts.now
else
	count "$1" >build/counts.now
	cp build/counts.now "$file"
	cat "$file"
fi
