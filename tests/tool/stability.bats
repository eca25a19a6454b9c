# docs/stability.md: its rows are those its script measures, and the numbers are right. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

page=$top/docs/stability.md
stability() { PAGE=${copy:-$page} OUT=$PWD bash "$top/docs/stability.sh" "$@"; }
# rows: the cells of every measured row, \| hidden.
rows() { awk '/^## /{ on = !/^## No word/ } on && /^\|/ && !/^\|---/ && !/^\| case/ { gsub(/\\\|/, "/"); print }' "$page"; }

@test "a few sections measured anew agree with the page, within both uncertainties" {
	run -0 stability --check ${PM_LONG:+leapfrog} relaxation misprints # flow is measured below
	[ "$output" = "${PM_LONG:+leapfrog: 6 rows
}relaxation: 3 rows
misprints and their effect: 4 rows" ]
}

@test "a number on the page that differs from the measured one, and a row without a measurement, are found" {
	copy=$PWD/copy.md
	sed '/^| sor /s/| 2 | 8/| 2.1 | 8/' "$page" >copy.md
	run ! cmp -s copy.md "$page"
	run -1 stability --check relaxation
	[[ $output == *"sor is "*", on the page 2.1" ]]
	sed '/^| sor /d' "$page" >copy.md
	run -1 stability --check relaxation
	run -1 stability relaxation
	[[ $output == *"section"*"has 2 rows, and 3 are measured"* ]]
}

@test "measured values are written into the page, which is otherwise unchanged" {
	copy=$PWD/copy.md
	sed '/^## Flow/,/^## Rel/s/| [0-9.]* | [0-9.e-]* | [0-9.]* |/| | | |/' "$page" >copy.md
	[ "$(diff copy.md "$page" | grep -c '^<')" = 1 ]
	# a block that leaves a picture of the page, and one that is not
	awk '{ print } /^## Flow/ { on = 1 } on && /^```sh$/ { print ": >stability.png; : >stray.png"; on = 0 }' copy.md >planted.md
	copy=$PWD/planted.md stability flow >/dev/null
	[[ -e stability.png && ! -e stray.png ]]
	grep -v '^: >stability.png' planted.md >copy.md
	# the last digits may depend on the machine: the bracket does not
	diff <(sed '/^## Flow/,/^## Rel/s/| [0-9.]* | [0-9.e-]* | [0-9.]* |/| | | |/' copy.md) <(sed \
		'/^## Flow/,/^## Rel/s/| [0-9.]* | [0-9.e-]* | [0-9.]* |/| | | |/' "$page")
	[ "$(grep -c '^| crossing | .* | 0\.99[0-9]* | 0\.000[0-9]* | ' copy.md)" = 1 ]
}

@test "every row has a number, or says between which ends there is none; its ratio is 1 within the uncertainty, or its remark says why not" {
	[ "$(rows | wc -l)" -ge 50 ]
	rows | awk -F'|' '{ x = $5; u = $6; r = $7; gsub(/ /, "", r)
		if (x ~ /stable at both ends|^ no edge: the limit moves/) next
		if (x ~ /[0-9]/ && u ~ /[0-9]/ && r == "-" && $3 ~ /no theory/ && $8 ~ /[a-z]/) next
		if (!(x ~ /[0-9]/ && u ~ /[0-9]/ && r ~ /[0-9]/)) { print "no number: " $0; exit 1 }
		d = (r - 1) * x / r; if (d < 0) d = -d
		if (d > u * 1.05 + 1e-4 * x && $8 !~ /[a-z]/) { print "off, without a reason: " $0; exit 1 } }' # ratios have four digits behind the point
}

@test "every section of the page with a table has as many rows as its searches have members" {
	for n in $(awk '/^## / { n++; if (!/No word|Relax|Misp|Regions|Diff|Plasma/) print n }' "$page"); do
		awk -v n="$n" '/^## / { at++ } /^```$/ { on = 0 } on && at == n { print } /^```sh$/ { on = 1 }' "$page" >block
		(echo 'margin() { command margin "$@" --list; }'; cat block) >list.sh
		awk -v n="$n" '/^## / { at++ } at == n && /^\|/ && !/^\|---/ && !/^\| case/' "$page" >rows
		[ "$(bash -euo pipefail list.sh | wc -l)" = "$(wc -l <rows)" ] || { echo "section $n"; cat rows; return 1; }
	done
}

@test "rows for words that do not exist yet have no number" {
	awk '/^## No word/ { on = 1 } on && /^\| / && !/^\| case/' "$page" >waiting
	[ "$(wc -l <waiting)" -ge 5 ]
	for word in maxwell sph collide; do
		[ ! -x "${PM_BIN:-$top/bin}/$word" ] || ! grep -qi "^| $word" waiting || { echo "$word is here: measure its limit in docs/stability.md"
		return 1; }
	done
}
