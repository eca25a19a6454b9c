# Loaded by every bats file (`load ../helper`): bin/ on PATH, an empty directory per test, and the comparisons.
# SPDX-License-Identifier: GPL-3.0-or-later
bats_require_minimum_version 1.5.0
top=$(cd "$BATS_TEST_DIRNAME/../.." && pwd)
PATH=${PM_BIN:-$top/bin}:$PATH
export LC_ALL=C OMP_NUM_THREADS=${OMP_NUM_THREADS:-2}
# Test files run side by side: threads that wait for each other must not spin while the others want the core.
export OMP_WAIT_POLICY=${OMP_WAIT_POLICY:-passive}

setup() {
	cd "$BATS_TEST_TMPDIR" || return
}

# within GOT WANT TOLERANCE [sentence]: |got - want| <= tolerance, or says what was got.
within() {
	awk -v g="$1" -v w="$2" -v t="$3" 'BEGIN { d = g - w; if (d < 0) d = -d; exit !(g ~ /[0-9]/ && g !~ /nan|inf/ && d <= t) }' && return
	echo "${4:-within}: got $1, want $2, tolerance $3" >&2
	return 1
}

# below GOT BOUND [sentence]: |got| <= bound.
below() { within "$1" 0 "$2" "${3:-below}"; }

# order CLAIM h1 e1 h2 e2 h3 e3 ...: the least-squares slope of log e on log h is at least CLAIM - 0.1.
order() {
	awk -v c="$1" 'BEGIN { for (i = 2; i < ARGC; i += 2) { x = log(ARGV[i]); y = log(ARGV[i+1]); n++; sx += x; sy += y; sxx += x*x; sxy += x*y }
		p = (n*sxy - sx*sy) / (n*sxx - sx*sx); printf "order: measured %.3f, claimed %g\n", p, c > "/dev/stderr"; exit !(n >= 3 && p >= c - 0.1) }' "$@"
}

# same_as A B: equal bytes.
same_as() { cmp "$1" "$2"; }

# sh_ok COMMAND LINE: runs it under bash -o pipefail and demands exit status 0.
sh_ok() { run -0 bash -o pipefail -c "$1"; }

# column NAME: reads diag's TSV and prints that column, one row a line.
column() { awk -F'\t' -v n="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == n) c = i; if (!c) exit 1; next } { print $c }'; }
