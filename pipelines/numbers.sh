# shellcheck shell=bash
# Shared by the pipelines: bin/ on PATH, a temporary directory, and functions that print and check numbers.
# SPDX-License-Identifier: GPL-3.0-or-later
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export PATH=${PM_BIN:-$top/bin}:$PATH LC_ALL=C
export OMP_WAIT_POLICY=${OMP_WAIT_POLICY:-passive} # spinning threads slow each other down on a busy machine
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
off=0

# is NAME GOT WANT TOLERANCE: prints a line; within the tolerance or not decides the exit status of `finish`.
is() {
	local word=ok
	awk -v g="$2" -v w="$3" -v t="$4" 'BEGIN { d = g - w; if (d < 0) d = -d; exit !(g ~ /[0-9]/ && g !~ /nan|inf/ && d <= t) }' || { word=OFF off=1; }
	printf '%-44s %16.9g   expected %14.9g +- %-9.3g %s\n' "$1" "$2" "$3" "$4" "$word"
}

# column NAME ROW FILE: a number of diag's table; ROW counts from 1, or is `last`.
column() {
	awk -F'\t' -v n="$1" -v r="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == n) c = i; if (!c) exit 1; next } NR == r + 1 { print $c; found = 1;
		exit } { x = $c }
		END { if (!found && r == "last") print x }' "$3"
}

# calc EXPRESSION: awk's arithmetic to all digits.
calc() { awk "BEGIN { pi = 3.14159265358979323846; printf \"%.17g\", $1 }"; }

finish() { exit $off; }
