# The rows of bench.h as one aligned table, or, with -v markdown=1, a page whose tables between "<!-- rows: KERNEL ... -->" and "<!-- end -->" are rewritten:
# awk -f table.awk rows.tsv; awk -v markdown=1 -f table.awk rows.tsv docs/speed.md. A table without new rows is kept.
# SPDX-License-Identifier: GPL-3.0-or-later
BEGIN {
	FS = "\t"
	split("kernel\tcase\tthreads\tmeasured\tunit\tspread\tbytes\toperations\tlimit\tfraction\tagainst\tits value\tratio\ttarget\treached", head)
	columns = 15
}
FNR == NR {
	n++
	for (c = 1; c <= columns; c++) {
		cell[n, c] = $c
		if (length($c) > width[c]) width[c] = length($c)
	}
	seen[$1] = 1
	next
}
{ page[++lines] = $0 }

function line(i, first,    c, s) {
	s = "|"
	for (c = first; c <= columns; c++) s = s " " (i ? cell[i, c] : head[c]) " |"
	return s
}
# Rows of the kernels; "machine" has five columns only.
function rows(list,    k, i, j, m, names) {
	m = split(list, names, " ")
	if (about) print "Measured by `bench/run.sh --markdown` on: " about ".\n"
	if (list == "machine") print "| what | threads | measured | unit | spread |\n|---|---|---|---|---|"
	else print line(0, 1) "\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
	for (j = 1; j <= m; j++)
		for (i = 1; i <= n; i++)
			if (cell[i, 1] == names[j]) {
				if (list == "machine") print "| " cell[i, 2] " | " cell[i, 3] " | " cell[i, 4] " | " cell[i, 5] " | " cell[i, 6] " |"
				else print line(i, 1)
			}
}
END {
	if (!markdown) {
		for (i = 0; i <= n; i++) {
			s = ""
			for (c = 1; c <= columns; c++) {
				if (length(head[c]) > width[c]) width[c] = length(head[c])
				s = s sprintf("%-" width[c] + 2 "s", i ? cell[i, c] : head[c])
			}
			sub(/ +$/, "", s)
			print s
		}
		exit
	}
	for (l = 1; l <= lines; l++) {
		if (page[l] == "<!-- end -->") inside = 0
		if (!inside) print page[l]
		if (page[l] !~ /^<!-- rows: .* -->$/) continue
		list = page[l]
		sub(/^<!-- rows: /, "", list)
		sub(/ -->$/, "", list)
		m = split(list, names, " ")
		any = 0
		for (j = 1; j <= m; j++) any = any || names[j] in seen
		if (any) {
			rows(list)
			inside = 1
		}
	}
}
