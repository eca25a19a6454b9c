#!/usr/bin/env bash
# lines.sh FILE X Y BY [COLUMN=VALUE...]: the points (X, Y) of a TSV for gnuplot, a block with its title for every value of the columns BY (with commas
# between), of
# the rows whose COLUMN is VALUE. Lines with # and rows without two numbers above zero are left out. SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
awk -F'\t' -v x="$2" -v y="$3" -v by="$4" 'BEGIN { for (i = 2; i < ARGC; i++) if (i > 4) { k++; split(ARGV[i], c, "="); which[k] = c[1];
	want[k] = substr(ARGV[i], length(c[1]) + 2); delete ARGV[i] } else delete ARGV[i]; nby = split(by, b, ",") }
	/^#/ { next }
	!head { head = 1; for (i = 1; i <= NF; i++) at[$i] = i; next }
	{ for (i = 1; i <= k; i++) if ($at[which[i]] != want[i]) next
		if (!($at[x] > 0 && $at[y] > 0)) next
		t = ""; for (i = 1; i <= nby; i++) t = t (i > 1 ? " " : "") $at[b[i]]
		if (!(t in block)) order[++n] = t
		block[t] = block[t] $at[x] " " $at[y] "\n" }
	END { for (i = 1; i <= n; i++) printf "%s\"%s\"\n%s", (i > 1 ? "\n\n" : ""), order[i], block[order[i]] }' "$@"
