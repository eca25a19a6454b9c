# The help, manual page, completion and version of every tool.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

# What every tool says, once.
setup_file() {
	cd "$BATS_FILE_TMPDIR" || return
	for t in $(tools); do
		run -0 --separate-stderr "$t" --help
		[ -z "$stderr" ] || { echo "$t"; return 1; }
		echo "$output" >"$t.help"
		"$t" --complete >"$t.complete"
	done
}
setup() {
	cd "$BATS_TEST_TMPDIR" || return
	said=$BATS_FILE_TMPDIR
}

# lacks TEXT LINES: prints the lines that are nowhere in the text.
lacks() { awk 'NR == FNR { text = text "\n" $0; next } !index(text, $0)' "$1" "$2"; }

@test "--help of every tool: its name, its options, its examples, exit 0, nothing on stderr" {
	for t in $(tools); do
		[[ $(head -n 1 "$said/$t.help") == "$t: "* ]] || { echo "$t"; return 1; }
		{ cut -d' ' -f1 "$said/$t.complete" && "$t" --examples; } >wanted
		[ -s wanted ]
		missing=$(lacks "$said/$t.help" wanted)
		[ -z "$missing" ] || { echo "$t --help lacks $missing"; return 1; }
	done
}

@test "--help: every option has a sentence, and no option is there twice" {
	for t in $(tools); do
		[ -z "$(cut -d' ' -f1 "$said/$t.complete" | sort | uniq -d)" ] || { echo "$t: twice"; return 1; }
		awk -v t="$t" '/^  (-|   )/ && /--/ && NF < 3 { print t ": " $0; bad = 1 } END { exit bad }' "$said/$t.help"
	done
}

@test "--help writes options the same way in every tool: -x, --name or --name" {
	for t in $(tools); do
		! sed -n '/^options/,/^examples/p' "$said/$t.help" | grep -E '^  .*--' | grep -vE '^  (-[a-zA-Z], |    )--[a-z]' | grep -vE '^ {20}' ||
			{ echo "$t"; return 1; }
	done
}

@test "--help: no letter stands for two options" {
	for t in $(tools); do
		[ -z "$(grep -oE '^  -[a-zA-Z],' "$said/$t.help" | sort | uniq -d)" ] || { echo "$t"; return 1; }
	done
}

@test "--man of every tool passes mandoc's lint and names every option" {
	for t in $(tools); do
		"$t" --man >"$t.1"
		run mandoc -T lint -W warning "$t.1"
		[ -z "$output" ] || { echo "$output"; return 1; }
		mandoc -T utf8 "$t.1" | sed 's/.\x08//g; s/‐/-/g' >text
		missing=$(cut -d' ' -f1 "$said/$t.complete" | lacks text -)
		[ -z "$missing" ] || { echo "$t.1 lacks $missing"; return 1; }
	done
}

@test "--version of every tool is the library's" {
	version=$(sed -n 's/^#define PM_VERSION "\(.*\)"/\1/p' "$top/lib/base/base.h")
	for t in $(tools); do
		[ "$("$t" --version)" = "$t (pmpipe) $version" ] || { echo "$t"; return 1; }
	done
}

@test "the same option word means the same kind of value in every tool" {
	for t in $(tools); do
		awk -v t="$t" '/^  (-|   )/ && match($0, /--[a-z0-9-]+( [A-Z][A-Z,.]*)?/) { print substr($0, RSTART, RLENGTH), t }' "$said/$t.help"
	done | sort -u >all
	# Words that rightly differ: cycle --plan is not the --plan of transforms. pareto is about runs, not frames: its --time is a clock, its --size one of
	# its names, its --axes those of its picture, and in pinit they are those of a wave. pinit --mode counts
	# waves, and modes --mode is one of those it found.
	# pse and diffuse --nu may be a field, elsewhere it is a number.
	# cycle --until ends a run by the columns of diag, dt --until at a time.
	awk '/^--(plan cycle|(time|size|axes) [A-Z]+ pareto|mode N modes|nu EXPRESSION (pse|diffuse)|until X dt)$/ { next } {
		kind = NF < 3 ? "flag" : $2 ~ /^(N|X|CELLS|X,Y,.*)$/ ? $2 : "words"; if ($1 in seen && seen[$1] != kind) {
		print $1 ": " seen[$1] " and " kind " in " $NF; bad = 1 } seen[$1] = kind } END { exit bad }' all
}

@test "--help on a full disk: exit 1" {
	run -1 bash -c 'cycle --help >/dev/full'
	[[ $output == *"No space left"* ]]
}
