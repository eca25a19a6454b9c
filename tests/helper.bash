# Loaded by every bats file (`load ../helper`): bin/ on PATH, an empty directory per test, and the comparisons.
# SPDX-License-Identifier: GPL-3.0-or-later
bats_require_minimum_version 1.5.0
top=$(cd "$BATS_TEST_DIRNAME/../.." && pwd)
PATH=${PM_BIN:-$top/bin}:$PATH
export LC_ALL=C OMP_NUM_THREADS=${OMP_NUM_THREADS:-2}
# Test files run side by side: waiting threads must not spin while others need the core.
export OMP_WAIT_POLICY=${OMP_WAIT_POLICY:-passive}

setup() {
	cd "$BATS_TEST_TMPDIR" || return
}

# measured RELATION GOT A B [what]: with PM_MEASURED=FILE a line there, of which docs/hard-cases.sh makes the numbers of docs/hard-cases.md.
measured() {
	[ -z "${PM_MEASURED:-}" ] && return
	local file=${BATS_TEST_FILENAME%.bats}
	printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\n' "${BATS_TEST_DIRNAME##*/}/${file##*/}" "$BATS_TEST_DESCRIPTION" "$1" "$2" "$3" "$4" "${5:-}" >>"$PM_MEASURED"
}

# holds RELATION GOT A B [what]: got is a finite number and the relation holds, or says what was got.
holds() {
	measured "$@"
	awk -v r="$1" -v g="$2" -v a="$3" -v b="$4" 'BEGIN { d = g - a; d = d < 0 ? -d : d; n = g + 0 < 0 ? -g : g + 0
		exit !(g ~ /[0-9]/ && g !~ /nan|inf/ && (r == "within" ? b != "" && d <= b + 0 : r == "below" ? a != "" &&
			n <= a + 0 : r == "above" ? g >= a + 0 : r == "between" ? g >= a + 0 && g <= b + 0 : 0)) }'
}

# within GOT WANT TOLERANCE [sentence]: |got - want| <= tolerance.
within() { holds within "$1" "$2" "$3" "${4:-}" || { echo "${4:-within}: got $1, want $2, tolerance $3" >&2; return 1; }; }

# below GOT BOUND [sentence]: |got| <= bound.
below() { holds below "$1" "$2" "" "${3:-}" || { echo "${3:-below}: got $1, want at most $2" >&2; return 1; }; }

# above GOT BOUND [sentence]: got >= bound.
above() { holds above "$1" "$2" "" "${3:-}" || { echo "${3:-above}: got $1, want at least $2" >&2; return 1; }; }

# between GOT LOW HIGH [sentence]: low <= got <= high.
between() { holds between "$1" "$2" "$3" "${4:-}" || { echo "${4:-between}: got $1, want $2 to $3" >&2; return 1; }; }

# counted N: N checks that have no number (refusals) passed.
counted() { measured counted "$1" "" ""; }

# order CLAIM h1 e1 h2 e2 h3 e3 ...: the least-squares slope of log e on log h is at least CLAIM - 0.1.
order() {
	local p
	p=$(awk 'BEGIN { for (i = 2; i < ARGC; i += 2) { x = log(ARGV[i]); y = log(ARGV[i+1]); n++; sx += x; sy += y; sxx += x*x; sxy += x*y }
		if (n >= 3) printf "%.3f", (n*sxy - sx*sy) / (n*sxx - sx*sx) }' "$@")
	echo "order: measured $p, claimed $1" >&2
	holds above "$p" "$(awk -v c="$1" 'BEGIN { print c - 0.1 }')" "" order
}

# same_as A B: equal bytes.
same_as() { measured within 0 0 0 bytes; cmp "$1" "$2"; }

# edited SCRIPT FILE: sed on the text of a stream, to a text of the same length; the checksums of lines, headers and tails are made anew.
edited() { sed "$@" | python3 -I -S "$top/tests/wire.py" seal /dev/stdin; }

# sh_ok COMMAND LINE: runs it under bash -o pipefail and demands exit status 0.
sh_ok() { run -0 bash -o pipefail -c "$1"; }

# without PROGRAM...: a PATH without these programs. few/ holds links to the programs of the machine: never write into it.
without() {
	local dir p
	mkdir -p few
	while IFS= read -r -d : dir; do
		find "$dir" -maxdepth 1 ! -type d -exec ln -s -t few {} + 2>/dev/null || true # the first of a name is kept
	done <<<"$PATH:"
	for p; do rm -f "few/$p"; done
	PATH=$PWD/few
}

# column NAME: reads diag's TSV and prints that column, one row per line.
column() { awk -F'\t' -v n="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == n) c = i; if (!c) exit 1; next } { print $c }'; }

# calc EXPRESSION: its value, by awk, which knows pi.
calc() { awk "BEGIN { pi = 3.14159265358979323846; printf \"%.17g\", ($1) }"; }

# pipeline NAME N: pipelines/NAME.sh ends with status 0 and N correct numbers.
pipeline() {
	run -0 bash "$top/pipelines/$1.sh"
	[[ $output != *OFF* ]]
	[ "$(grep -c ' ok$' <<<"$output")" = "$2" ]
	echo "$output"
	local got want tolerance
	while read -r got want tolerance; do
		measured within "$got" "$want" "$tolerance"
	done < <(awk '$(NF - 4) == "expected" && /ok$/ { print $(NF - 5), $(NF - 3), $(NF - 1) }' <<<"$output")
}
