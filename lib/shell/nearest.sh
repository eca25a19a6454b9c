# shellcheck shell=sh
# SPDX-License-Identifier: GPL-3.0-or-later

# nearest NAME WORDS...: the word at the smallest edit distance (deletions, insertions, replacements, transpositions), if that is at most two.
nearest() {
	awk 'BEGIN { a = ARGV[1]; n = length(a); best = 3
		for (w = 2; w < ARGC; w++) { b = ARGV[w]; m = length(b)
			for (i = 0; i <= n; i++) for (j = 0; j <= m; j++) {
				if (!i || !j) { d[i, j] = i + j; continue }
				x = substr(a, i, 1); y = substr(b, j, 1)
				v = d[i-1, j-1] + (x != y); if (d[i-1, j] + 1 < v) v = d[i-1, j] + 1; if (d[i, j-1] + 1 < v) v = d[i, j-1] + 1
				if (i > 1 && j > 1 && x == substr(b, j-1, 1) && y == substr(a, i-1, 1) && d[i-2, j-2] + 1 < v) v = d[i-2, j-2] + 1
				d[i, j] = v }
			if (d[n, m] < best) { best = d[n, m]; found = b } }
		print found }' "$@"
}
