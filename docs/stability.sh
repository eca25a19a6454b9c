#!/usr/bin/env bash
# Measures the limits of docs/stability.md: runs the blocks of that page as printed and writes measured value, uncertainty and ratio into the table behind
# each, in the order of the rows. Words as arguments: the sections whose headings begin so, alone. --check: compares with the page instead, and fails where
# they differ by
# more than both uncertainties. Pictures go to docs/. Needs bin/; gnuplot and netpbm for the pictures. SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
page=${PAGE:-$top/docs/stability.md} # PAGE=FILE, OUT=DIRECTORY for the pictures: elsewhere
export PATH=${PM_BIN:-$top/bin}:$PATH LC_ALL=C.UTF-8 OMP_NUM_THREADS=1
check=
if [ "${1:-}" = --check ]; then check=1; shift; fi

# sections: "NUMBER HEADING" of every section; the first block of the page, above them, is number 0 and always run.
sections() { awk '/^## / { n++; print n, tolower(substr($0, 4)) }' "$page"; }
# blocks SECTION: how many it has. block SECTION K: the commands of its Kth.
blocks() { awk -v n="$1" '/^## / { at++ } at == n && /^```sh$/ { k++ } END { print k + 0 }' "$page"; }
block() { awk -v n="$1" -v k="$2" '/^## / { at++ } /^```$/ { on = 0 } on { print } at + 0 == n && /^```sh$/ { on = ++b == k }' "$page"; }

# Of margin's tables, one row behind another: choices, measured, uncertainty, ratio; or why there is none.
numbers() {
	awk -F'\t' -v OFS='\t' '$1 == "member" { split("", c); for (i = 1; i <= NF; i++) c[$i] = i; next }
	{ key = ""; for (i = 2; i < c["parameter"]; i++) key = key (key == "" ? "" : " ") $i
		sub(/; unstable after.*/, "", $c["reason"])
		if ($c["limit"] == "-") print key, $c["reason"], "-", "-"; else print key, sprintf("%.5g", $c["limit"]), $c["uncertainty"],
			($c["ratio"] == "-" ? "-" : sprintf("%.4f", $c["ratio"])) }'
}

# write SECTION NUMBERS: the page with them in the first table of the section; every word of a key must be in the first cell of its row.
write() {
	awk -F'\t' -v n="$1" 'FILENAME == ARGV[1] { rows++; key[rows] = $1; new[rows] = " " $2 " | " $3 " | " $4; next }
	/^## / { at++; if (at == n) on = 1; else on = 0 }
	on && /^\|/ && !/^\|---/ && !/^\| case/ {
		r++; gsub(/\\\|/, "\001"); split($0, cell, "|"); k = split(key[r], word, " ")
		for (i = 1; i <= k; i++) if (index(cell[2], word[i]) == 0) { printf "stability: row %d of the section, %s, is measured as %s\n", r, cell[2],
			key[r] >"/dev/stderr"; exit 1 }
		$0 = "|" cell[2] "|" cell[3] "|" cell[4] "|" new[r] " |" cell[8] "|"; gsub("\001", "\\|") }
	{ print }
	END { if (r != rows) { printf "stability: section %d has %d rows, and %d are measured\n", n, r, rows >"/dev/stderr"; exit 1 } }' "$2" "$page"
}

# differs SECTION NUMBERS: compares the numbers with those of the page.
differs() {
	awk -F'\t' -v n="$1" 'FILENAME == ARGV[1] { rows++; new[rows] = $2; u[rows] = $3; next }
	/^## / { at++ }
	at == n && /^\|/ && !/^\|---/ && !/^\| case/ {
		r++; gsub(/\\\|/, "\001"); split($0, cell, "|"); old = cell[5]; gsub(/^ | $/, "", old); d = old - new[r]; if (d < 0) d = -d
		if (u[r] == "-" ? old != new[r] : !(old ~ /[0-9]/ && d <= u[r] + cell[6])) { printf "stability:%sis %s, on the page %s\n", cell[2], new[r],
			old >"/dev/stderr"; bad = 1 } }
	END { exit bad || r != rows }' "$2" "$page"
}

measure() {
	local n=$1 k
	: >"$work/numbers"
	for ((k = 1; k <= $(blocks "$n"); k++)); do
		# margin as in the page, but a table for programs; 1 is also "no limit", which its table says.
		{
			# shellcheck disable=SC2016 # for the shell that runs it
			echo 'margin() { command margin "$@" --format tsv --jobs "${JOBS:-2}" || [ $? = 1 ]; }'
			block "$n" $k
		} >"$work/block"
		(cd "$work/run" && bash -euo pipefail "$work/block" </dev/null 2>"$work/said") >"$work/table" || { cat "$work/said" >&2
		echo "stability: block $k of section $n failed" >&2; return 1; }
		numbers <"$work/table" >>"$work/numbers"
	done
	[ -s "$work/numbers" ] || return 0
	if [ -n "$check" ]; then
		differs "$n" "$work/numbers"
	else
		write "$n" "$work/numbers" >"$work/page"
		cp "$work/page" "$page"
	fi
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/run"
measure 0
while read -r n heading; do
	[ $# != 0 ] || [ "$heading" != "no word yet" ] || continue
	wanted=$([ $# != 0 ] || echo yes)
	for w; do [[ $heading != "$w"* ]] || wanted=yes; done
	[ -n "$wanted" ] || continue
	measure "$n"
	echo "$heading: $(wc -l <"$work/numbers") rows"
done < <(sections)
# Its pictures, and no other file that a block may leave.
sed -n 's|^!\[.*](\([A-Za-z0-9-]*\.png\))$|\1|p' "$page" | while read -r picture; do
	[ ! -e "$work/run/$picture" ] || mv "$work/run/$picture" "${OUT:-$top/docs}/"
done
