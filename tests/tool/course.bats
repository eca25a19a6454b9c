# docs/notes: every sentence prints what the page says, and every item of the three courses has its row. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

parts="koumoutsakos sbalzarini springel pp-pm"

# The items of a course, each to stand on its page once.
items() {
	case $1 in
		koumoutsakos) echo S01-S107 N01-N45 H01-H39 C1-C14 ERR1-ERR51 E1-E4 ;;
		sbalzarini) echo A1-A9 B1-B6 C1-C9 D1-D6 E1-E3 F1-F10 G0-G4 H1-H4 K1-K15 N1-N21 N30-N57 N60-N65 S1-S50 X1-X51 ;;
		springel) echo FP1-FP7 OD1-OD12 CL1-CL4 TR1-TR6 PM1-PM11 FT1-FT7 MG1-MG8 MD1-MD19 MC1-MC14 GD1-GD11 FV1-FV14 SP1-SP8 \
			FE1-FE2 DG1-DG6 PA1-PA6 N1-N74 H1-H77 E1-E39 ;;
		pp-pm) echo P1-P14 N1-N9 T1-T13 E1-E8 ;;
	esac
}

rows() { bash "$top/docs/notes.sh" --rows "$@"; }

# all_there PART: the page has the items of the part, each once, and every row a sentence or a reason.
all_there() {
	items "$1" | sed 's/ /, /g; s/.*/**&** none: x/' >all
	rows all | cut -f2 | tr ' ' '\n' | grep . | sort >want
	rows "$top/docs/notes/$1.md" | cut -f2 | tr ' ' '\n' | grep . | sort >have
	diff want have || return 1
	rows "$top/docs/notes/$1.md" | awk -F'\t' '$3 == "nothing" { print "neither a sentence nor \"none: \":" $2; bad = 1 } END { exit bad }'
}

@test "Koumoutsakos: every sentence prints what docs/notes/koumoutsakos.md says" {
	bash "$top/docs/notes.sh" "$top/docs/notes/koumoutsakos.md"
}

@test "Sbalzarini: every sentence prints what docs/notes/sbalzarini.md says" {
	bash "$top/docs/notes.sh" "$top/docs/notes/sbalzarini.md"
}

@test "Springel and Gräter: every sentence prints what docs/notes/springel.md says" {
	bash "$top/docs/notes.sh" "$top/docs/notes/springel.md"
}

@test "PP and PM: every sentence prints what docs/notes/pp-pm.md says" {
	bash "$top/docs/notes.sh" "$top/docs/notes/pp-pm.md"
}

@test "every item of the courses is in docs/notes/ once, with a sentence or the reason why there is none" {
	for part in $parts; do all_there "$part" || { echo "docs/notes/$part.md"; return 1; }; done
}

@test "docs/notes.md counts its rows" {
	for part in $parts; do
		count=$(rows "$top/docs/notes/$part.md" | awk -F'\t' '{ n[$3] += split($2, id, " ") } END { printf "| %d | %d |", n["sentence"], n["none"] }')
		grep -qF -- "(notes/$part.md) $count" "$top/docs/notes.md" || { echo "notes/$part.md: $count"; return 1; }
	done
}

@test "a number that is off, a line too many, a missing item and one that stands twice are told" {
	printf '%s\n' '**S1** a thing' '' '    $ echo 0.33333 1e-17 7 and so on' '    0.333 <1e-15 7 and ...' '' '**S2-S3** another: none: x' >good
	bash "$top/docs/notes.sh" good
	[ "$(rows good)" = $'good\t S1\tsentence\ngood\t S2 S3\tnone' ]
	sed 's/0.333 /0.335 /' good >bad
	run -1 bash "$top/docs/notes.sh" bad
	[[ $output == "bad, line 3: S1: echo 0.33333"*"1 sentences, 1 of them"* ]]
	sed 's/and \.\.\./&\n    more/' good >bad
	run -1 bash "$top/docs/notes.sh" bad
	for change in s/1e-15/1e-18/ 's/7 and \.\.\./8 and .../'; do
		sed "$change" good >bad
		run -1 bash "$top/docs/notes.sh" bad
	done
	items() { echo S1-S3; }
	top=$PWD/tree
	mkdir -p tree/docs/notes
	cp "$BATS_TEST_DIRNAME/../../docs/notes.sh" tree/docs
	for change in s/x/y/ s/S2-S3/S2/ s/S2-S3/S1-S3/ 's/none: x/x/'; do
		sed "$change" good >tree/docs/notes/part.md
		case $change in s/x/y/) run -0 all_there part ;; *) run -1 all_there part ;; esac
	done
}
