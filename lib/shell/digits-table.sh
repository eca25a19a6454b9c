# shellcheck shell=bash
# How many digits agree: the tables and streams of the runs of digits, compared number by number.
# SPDX-License-Identifier: GPL-3.0-or-later

# agreement GROUPS: a line "frame quantity value GROUP..." for each number of the tables $work/NAME.table, after a line of names. GROUPS: names of groups of
# runs, NAME.1, NAME.2 ...; the run "as-is" belongs to each. The digits of a group are those of Vignes (1993), log10(sqrt(n) |mean| / (t s)), with the
# standard deviation s of its n runs and Student's t for 95 %; of f32, a single run, -log10 of the relative difference.
agreement() {
	local files
	mapfile -t files < <(runs_of table)
	awk -F'\t' -v OFS='\t' -v groups="$1" '
	function size(x) { return x < 0 ? -x : x }
	function number(x) { return x ~ /^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$/ }
	function clip(d) { return d < 0 ? 0 : d > most ? most : d }
	function student(n) { return n < 1 ? 12.706 : n <= 10 ? t[n] : 2.1 }
	function digits(g, row, c,    i, n, x, sum, mean, s) {
		n = 1; x[1] = at["as-is", row, c]; sum = x[1]
		for (i = 1; (g "." i, row, c) in at; i++) { if (!number(at[g "." i, row, c])) return "-"; x[++n] = at[g "." i, row, c]; sum += x[n] }
		if (n == 1) return "-"
		mean = sum / n
		for (i = 1; i <= n; i++) s += (x[i] - x[1]) ^ 2
		if (s == 0) return most
		if (g == "f32") return clip(-log(size(x[2] - x[1]) / (size(x[1]) > 0 ? size(x[1]) : size(x[2]))) / log(10))
		s = 0; for (i = 1; i <= n; i++) s += (x[i] - mean) ^ 2
		s = sqrt(s / (n - 1))
		if (mean == 0) return 0
		return s == 0 ? most : clip(log(sqrt(n) * size(mean) / (student(n - 1) * s)) / log(10)) }
	BEGIN { most = 53 * log(2) / log(10)
		split("12.706 4.303 3.182 2.776 2.571 2.447 2.365 2.306 2.262 2.228", t, " ")
		ng = split(groups, group, " ") }
	FNR == 1 { run = FILENAME; sub(/\.table$/, "", run); sub(/.*\//, "", run); row = 0; names = 0 }
	/^#/ || NF == 0 { next }
	!names { names = NF; if (run == "as-is") { columns = NF; for (i = 1; i <= NF; i++) name[i] = $i } next }
	{ row++; if (run == "as-is") rows = row; for (i = 1; i <= NF; i++) at[run, row, i] = $i }
	END {
		for (r = 1; r <= rows; r++) for (i = 1; i <= columns; i++) if (number(at["as-is", r, i])) {
			line = r OFS name[i] OFS at["as-is", r, i]
			for (g = 1; g <= ng; g++) { d = digits(group[g], r, i); line = line OFS (d == "-" ? d : sprintf("%.1f", d)) }
			print line } }' "$work/as-is.table" "${files[@]}"
}

# fields_agree GROUPS: the same for the fields of the streams, "frame set.field - GROUP...", by the largest relative l2 difference of a group from the run as
# it is.
fields_agree() {
	local files
	mapfile -t files < <(runs_of fields)
	awk -F'\t' -v OFS='\t' -v groups="$1" '
	function digits(x) { return x == 0 ? most : x >= 1 ? 0 : -log(x) / log(10) > most ? most : -log(x) / log(10) }
	BEGIN { most = 53 * log(2) / log(10); ng = split(groups, group, " ") }
	FNR == 1 { run = FILENAME; sub(/\.[0-9]+\.fields$/, "", run); sub(/.*\//, "", run)
		for (i = 1; i <= NF; i++) if ($i == "relative_l2") column = i; next }
	$2 != "-" {
		q = $1 OFS $2 "." $3; if (!(q in had)) { had[q] = 1; order[++n] = q }
		if (!((run, q) in worst) || $column > worst[run, q] || $column != $column + 0) worst[run, q] = $column }
	END {
		for (i = 1; i <= n; i++) {
			line = order[i] OFS "-"
			for (g = 1; g <= ng; g++) {
				x = worst[group[g], order[i]]
				line = line OFS ((group[g], order[i]) in worst && x ~ /^[0-9.]/ ? sprintf("%.1f", digits(x + 0)) : "-") }
			print line } }' "${files[@]}"
}

# report: lines of "frame quantity value input rounding [f32] digits worst".
report() {
	local groups="input rounding${opt_f32:+ f32}"
	{ agreement "$groups"; [ -z "$(runs_of fields)" ] || fields_agree "$groups"; } | awk -F'\t' -v OFS='\t' -v all="${opt_all:-}" \
		-v least="${opt_least:-}" -v form="${opt_format:-table}" -v groups="$groups" '
	{ line[NR] = $0; frame[NR] = $1; if ($1 > last) last = $1 }
	function show(f, n,    i, text) {
		if (form == "tsv") { for (i = 1; i <= n; i++) printf "%s%s", f[i], i < n ? OFS : "\n"; return }
		text = sprintf("%5s %-26s %24s", f[1], f[2], f[3]); for (i = 4; i <= n; i++) text = text sprintf(" %9s", f[i]); print text }
	END {
		n = split("frame\tquantity\tvalue\t" groups "\tdigits\tworst", f, /[\t ]/); show(f, n)
		for (k = 1; k <= NR; k++) {
			n = split(line[k], f, "\t"); f[n + 1] = "-"
			for (i = 4; i <= 5; i++) if (f[i] != "-" && (f[n + 1] == "-" || f[i] + 0 < f[n + 1] + 0)) f[n + 1] = f[i]
			if (f[n + 1] != "-" && !((f[2] in worst) && worst[f[2]] <= f[n + 1] + 0)) worst[f[2]] = f[n + 1] + 0
			f[n + 2] = f[2] in worst ? sprintf("%.1f", worst[f[2]]) : "-"
			if (all || frame[k] == last) show(f, n + 2)
			if (frame[k] == last && least != "" && f[3] != "-" && f[n + 1] != "-" && f[n + 1] + 0 < least + 0)
				few = few (few == "" ? "" : ", ") f[2] }
		if (few != "") { print "digits: fewer than " least " digits: " few >"/dev/stderr"; exit 3 } }'
}
