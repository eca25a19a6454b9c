#!/usr/bin/env bash
# pick.sh COLUMN|NEW=COLUMN...: of a table that pareto --tsv writes these columns, in this order and under these names, a row a member in the order of the
# sentences; what failed has - for its error. SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
awk -F'\t' -v OFS='\t' 'BEGIN { for (i = 1; i < ARGC; i++) { n = i; name[i] = from[i] = ARGV[i]; sub(/=.*/, "", name[i]); sub(/.*=/, "", from[i]);
	delete ARGV[i] } }
	NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i
		for (i = 1; i <= n; i++) { if (!(from[i] in at)) { print "pick: no column " from[i] > "/dev/stderr"; exit 1 } printf "%s%s", name[i],
			i < n ? OFS : "\n" } next }
	{ member[NR] = $1; row[$1] = ""; for (i = 1; i <= n; i++) row[$1] = row[$1] (i > 1 ? OFS : "") $at[from[i]]; if ($1 > last) last = $1 }
	END { for (m = 1; m <= last; m++) if (m in row) print row[m] }' "$@"
