#!/usr/bin/env bash
# Fills the last column of the tables of docs/hard-cases.md: runs the tests that a row names (`hard/pic HC-02: a thermal`: all of tests/hard/pic.bats whose
# name begins so; `unit/pp HC-19`: the checks of that program) and writes how far the tightest of their comparisons is from its bound. The rest of the page is
# left alone.
# hard-cases.sh [hard/pic ...]: only the rows that name these files. --rows: prints line, file, beginning and number of every row. PM_LONG=1: with the long
# tests.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
page=${PAGE:-$top/docs/hard-cases.md}
export LC_ALL=C

# One line per test that a row of the page names: line, file, beginning of the name, number.
rows() {
	awk -F'|' '/^\|.*`(hard|physics|tool|unit)\// { cell = $6; gsub(/^ +| +$/, "", cell); rest = $5
		while (match(rest, /`[a-z]+\/[^` ]+ [^`]+`/)) {
			key = substr(rest, RSTART + 1, RLENGTH - 2); rest = substr(rest, RSTART + RLENGTH); at = index(key, " ")
			printf "%d\t%s\t%s\t%s\n", NR, substr(key, 1, at - 1), substr(key, at + 1), cell } }' "$page"
}
[ "${1:-}" != --rows ] || { rows; exit; }

# The lines of rows on standard input, those of the files in the arguments alone and the others of the same lines of the page.
chosen() {
	awk -F'\t' -v only=" $* " 'index(only, " " $2 " ") || only == "  " { line[$1] } { row[NR] = $0; of[NR] = $1 } END {
		for (i = 1; i <= NR; i++) if (of[i] in line) print row[i] }'
}

# run_file FILE: the tests of this file that the rows name; what they compare goes to $PM_MEASURED, what they say to $work/tap.
run_file() {
	if [ "${1%%/*}" = unit ]; then
		"$top/build/tests/$1" >"$work/out" 2>&1 || { grep -v '^ok' "$work/out" >&2; echo "hard-cases: tests/$1.c failed" >&2; return 1; }
	else
		# any sign may stand for itself: what is measured is found by its name afterwards
		awk -F'\t' -v f="$1" '$2 == f { gsub(/[^A-Za-z0-9 ]/, ".", $3); printf "%s%s", (n++ ? "|" : ""), $3 }' "$work/rows" >"$work/names"
		bats --formatter tap -f "^($(cat "$work/names"))" "$top/tests/$1.bats" </dev/null >"$work/out" 2>&1 || { grep -A 20 '^not ok' "$work/out" >&2
		echo "hard-cases: tests/$1.bats failed" >&2; return 1; }
		cat "$work/out" >>"$work/tap"
	fi
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export PM_MEASURED=$work/measured
touch "$PM_MEASURED" "$work/tap"
rows | chosen "$@" >"$work/rows"
[ -s "$work/rows" ] || { echo "hard-cases: no row of docs/hard-cases.md names a test of $*" >&2; exit 1; }
mapfile -t files < <(cut -f2 "$work/rows" | sort -u)
for file in "${files[@]}"; do
	echo "$file"
	run_file "$file"
done

# The number of a line: the comparison that is nearest to its bound, as the factor by which it is away from it.
awk -F'\t' -v OFS='\t' '
	FILENAME ~ /tap$/ { if (/^ok .* # skip/) { sub(/^ok [0-9]+ /, ""); skipped[++skips] = $0 } next }
	FILENAME ~ /measured$/ { n++; file[n] = $1; test[n] = $2; relation[n] = $3; got[n] = $4; a[n] = $5; b[n] = $6; what[n] = $7; next }
	function size(x) { return x < 0 ? -x : x }
	# How far comparison i is from its bound: 1 is at it, 1e300 is exact.
	function margin(i, d) {
		if (relation[i] == "within") { d = size(got[i] - a[i]); return d > 0 ? b[i] / d : 1e300 }
		if (relation[i] == "below") { d = size(got[i]); return d > 0 ? a[i] / d : 1e300 }
		if (relation[i] == "above") return a[i] > 0 ? got[i] / a[i] : 1e300
		d = size(2 * got[i] - a[i] - b[i]); return d > 0 ? (b[i] - a[i]) / d : 1e300
	}
	function said(i, m, of) {
		m = margin(i)
		m = m < 1.995 ? sprintf("%.3f", m) : m < 9.95 ? sprintf("%.2f", m) : m < 999.5 ? sprintf("%.0f", m) : sprintf("%.0e", m)
		sub(/e\+0*/, "e", m)
		of = what[i] == "" ? "" : what[i] ": "
		gsub(/ *\| */, " / ", of)
		if (relation[i] == "within") return sprintf("%s (%soff by %.2g, %.4g allowed)", m, of, size(got[i] - a[i]), b[i])
		if (relation[i] == "below") return sprintf("%s (%s%.4g, at most %.4g)", m, of, size(got[i]), a[i])
		if (relation[i] == "above") return sprintf("%s (%s%.4g, at least %.4g)", m, of, got[i], a[i])
		return sprintf("%s (%s%.4g, from %.4g to %.4g)", m, of, got[i], a[i], b[i])
	}
	{
		if (!($1 in lines)) { lines[$1]; best[$1] = 0; least[$1] = 1e301; old[$1] = $4 }
		for (i = 1; i <= n; i++) if (file[i] == $2 && index(test[i], $3) == 1) {
			if (relation[i] == "counted") count[$1] += got[i]
			else if (margin(i) < least[$1]) { least[$1] = margin(i); best[$1] = i }
		}
		for (i = 1; i <= skips; i++) if (index(skipped[i], $3) == 1) late[$1]
	}
	END {
		for (l in lines) {
			if (l in late && !best[l]) cell = old[l]
			else if (best[l] && least[l] < 1e300) cell = said(best[l])
			else if (count[l]) cell = count[l] " of " count[l]
			else cell = best[l] ? "exact" : "yes or no"
			print l, cell
		}
	}' "$work/tap" "$PM_MEASURED" "$work/rows" >"$work/cells"
awk -F'\t' 'FNR == NR { cell[$1] = $2; next } FNR in cell { match($0, /\|[^|]*\|[ \t]*$/); $0 = substr($0, 1, RSTART) " " cell[FNR] " |" } {
	print }' "$work/cells" "$page" >"$work/page"
cmp -s "$work/page" "$page" || cp "$work/page" "$page"
