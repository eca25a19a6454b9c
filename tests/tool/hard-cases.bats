# The index of the hard cases and the tests it names are the same. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

page() { cat "$top/docs/hard-cases.md"; }
rows() { bash "$top/docs/hard-cases.sh" --rows; }

# names DIRECTORY/FILE: the names of its tests.
names() { sed -n 's/^@test "\(.*\)" {.*$/\1/p' "$top/tests/$1.bats"; }

@test "every test of tests/hard is in docs/hard-cases.md" {
	rows >rows
	for f in "$top"/tests/hard/*.bats; do
		f=hard/$(basename "$f" .bats)
		names "$f" | awk -F'\t' -v f="$f" 'FILENAME == "rows" { if ($2 == f) begins[++n] = $3; next }
			{ for (i = 1; i <= n; i++) if (index($0, begins[i]) == 1) next;
				print "no row of docs/hard-cases.md for `" f " " $0 "` (its head says how)"; bad = 1 } END { exit bad }' rows -
	done
}

@test "every hard case of tests/reference/cases.md is in docs/hard-cases.md" {
	grep -oE '^\| HC-[0-9]+ ' "$top/tests/reference/cases.md" | tr -d '| ' >cases
	[ "$(wc -l <cases)" -ge 40 ]
	while read -r case; do
		page | grep -qE "^\|.*\b$case\b" || { echo "no row for $case"; return 1; }
	done <cases
}

@test "every row of docs/hard-cases.md has five cells and names existing tests, or a missing word" {
	page | awk -F'|' '/^\|/ && NF != 7 { print NR ": " NF - 2 " cells"; bad = 1 } END { exit bad }'
	rows | cut -f2,3 >rows
	[ "$(wc -l <rows)" -ge 80 ]
	while IFS=$'\t' read -r file begins; do
		if [ "${file%%/*}" = unit ]; then
			grep -qF -- "${begins%% *}" "$top/tests/$file.c" || { echo "tests/$file.c has no check '$begins'"; return 1; }
		else
			names "$file" | awk -v b="$begins" 'index($0, b) == 1 { n++ } END { exit !n }' ||
				{ echo "tests/$file.bats has no test that begins with '$begins'"; return 1; }
		fi
	done <rows
	page | grep '^| ' | grep -vE '^\| case \|.*margin \|$|`(hard|physics|tool|unit)/' >without
	while read -r row; do
		word=$(sed -n 's/.*| no word yet: `\([a-z0-9-]*\)`.*/\1/p' <<<"$row")
		[ -n "$word" ] || { echo "neither a test nor 'no word yet: \`WORD\`': $row"; return 1; }
		[ ! -x "${PM_BIN:-$top/bin}/$word" ] || { echo "there is a word $word now; its test? $row"; return 1; }
	done <without
}

@test "every row with a test has a number in docs/hard-cases.md, made by make hard-cases" {
	rows >rows
	# a line is one row; comparisons by the helpers of tests/helper.bash give a number, counted says how many inputs there were
	while IFS=$'\t' read -r line file begins number; do
		[[ $number =~ ^([0-9]+(\.[0-9]+)?(e[0-9]+)?\ \(.*\)|exact|([0-9]+)\ of\ ([0-9]+))$ ]] ||
			{ echo "line $line of docs/hard-cases.md: '$number' (make hard-cases)"; return 1; }
	done <rows
}

@test "the number of a row is the comparison nearest to its bound, and the rest of the page is unchanged" {
	mkdir -p tests/hard docs
	cp "$top/docs/hard-cases.sh" docs
	ln -s "$top/tests/helper.bash" tests
	# the sign before test is put in here: bats takes every line that begins so for a test of this file
	sed 's/^%/@/' >tests/hard/one.bats <<-'END'
		load ../helper
		%test "a: two (of them)" { within 1.5 1 1 "one | two"; below 0.25 1; above 30 10; between 3 2 4; }
		%test "b: none" { true; }
		%test "c: as it should" { within 2 2 0.1; }
		%test "d: a long one" { skip "long"; }
		%test "e: refusals" { counted 3; counted 4; }
	END
	{
		printf '# A page\n\n| case | breaks elsewhere | stable means here | test | margin |\n|---|---|---|---|---|\n'
		printf '| %s | | | `hard/one %s` |%s|\n' A 'a: two (of' ' ' B b: ' 7 ' C 'c: as' ' ' D d: ' 8 (2, at most 16) ' E e: ' '
		printf '| F | | | no word yet: `tree` | |\n\nThe end | of it | a | b |\n'
	} >docs/hard-cases.md
	cp docs/hard-cases.md before
	sh_ok 'bash docs/hard-cases.sh'
	run diff before docs/hard-cases.md
	[ "$(grep '^>' <<<"$output")" = '> | A | | | `hard/one a: two (of` | 2.00 (one / two: off by 0.5, 1 allowed) |
> | B | | | `hard/one b:` | yes or no |
> | C | | | `hard/one c: as` | exact |
> | E | | | `hard/one e:` | 7 of 7 |' ]
	cp docs/hard-cases.md good
	sed -i 's/within 1.5 1 1/within 1.5 1 0.1/' tests/hard/one.bats
	run -1 bash docs/hard-cases.sh hard/one
	[[ $output == *"got 1.5, want 1, tolerance 0.1"*"hard-cases: tests/hard/one.bats failed" ]]
	same_as good docs/hard-cases.md
	run -1 bash docs/hard-cases.sh hard/nothing
	[[ $output == "hard-cases: no row of docs/hard-cases.md names a test of hard/nothing" ]]
}
