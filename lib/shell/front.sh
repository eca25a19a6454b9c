# shellcheck shell=bash
# Makes the result of a sweep from its log: the table of all members with the Pareto front (members to which no other is both cheaper and more accurate),
# as TSV, text, picture and page. SPDX-License-Identifier: GPL-3.0-or-later

# members: prints a line per member: number, path, chosen..., sentence.
members() {
	local m d
	for m in "${!sentence[@]}"; do
		printf '%d\t%s' "$m" "${path[m]}"
		for d in "${!choice_name[@]}"; do printf '\t%s' "${chosen[m * ${#choice_name[@]} + d]}"; done
		printf '\t%s\n' "${sentence[m]}"
	done
}

# The seconds of a member in a round are the sum over its path; its result is the median over the rounds, its spread half their range.
tsv() {
	local names d
	names=$(for d in "${choice_name[@]}"; do printf '%s\t' "$d"; done)
	members | NAMES=$names LOG=$state/log awk -F'\t' -v rounds="$repeat" -v norm="$norm" -v reference_member="$reference_member" '
	function median(v, n,    i, j, t) {
		for (i = 2; i <= n; i++) for (j = i; j > 1 && v[j] < v[j-1]; j--) { t = v[j]; v[j] = v[j-1]; v[j-1] = t }
		return n % 2 ? v[(n+1)/2] : (v[n/2] + v[n/2+1]) / 2 }
	BEGIN {
		OFS = "\t"
		split("n l1 l2 max relative_l2 relative_max", name, " ")
		for (i = 1; i <= 6; i++) if (name[i] == norm) pick = i
		while ((getline line < ENVIRON["LOG"]) > 0) {
			split(line, c, "\t")
			if (c[1] == "time") { up[c[2], c[3]] = c[4]; work[c[2], c[3]] = c[5]; if (c[6] > kb[c[2]]) kb[c[2]] = c[6] }
			else if (c[1] == "fail") dead[c[2]] = c[3]
			else if (c[1] == "bad") bad[c[2]] = c[3]
			else if (c[1] == "error") { for (i = 1; i <= 6; i++) norms[c[2], i] = c[i+2]; known[c[2]] = 1 }
		}
	}
	{
		m = NR; id[m] = $1; k = split($2, p, " "); n = 0; mem[m] = "-"; why[m] = ""
		for (i = 1; i <= k; i++) { if (p[i] in dead) why[m] = dead[p[i]]; if (kb[p[i]] > mem[m] * 1) mem[m] = kb[p[i]] }
		if ($1 in bad) why[m] = bad[$1]
		for (r = 1; r <= rounds; r++) {
			s = 0; u = 0; whole = 1
			for (i = 1; i <= k; i++) { if (!((p[i], r) in work)) { whole = 0; break } s += work[p[i], r]; u += up[p[i], r] }
			if (whole) { n++; all[n] = s; ups[n] = u }
		}
		sec[m] = spread[m] = setup[m] = "-"
		if (n) { sec[m] = median(all, n); setup[m] = median(ups, n); spread[m] = (all[n] - all[1]) / 2 }
		if (why[m] == "" && !($1 in known)) why[m] = "not measured"
		e[m] = norms[$1, pick]
		status[m] = why[m] != "" ? "failed" : $1 == reference_member ? "reference" : "ok"
		tail[m] = $3; for (i = 4; i <= NF; i++) tail[m] = tail[m] OFS $i
	}
	# A NaN or infinite error ranks below every finite one.
	function finite(x) { return x ~ /[0-9]/ && x !~ /[nN][aA][nN]|[iI][nN][fF]/ }
	function beats(a, b) { return status[a] == "ok" && finite(e[a]) && (!finite(e[b]) || e[a] <= e[b]) && sec[a] <= sec[b] && (e[a] < e[b] ||
		sec[a] < sec[b] || !finite(e[b]) || id[a] < id[b]) }
	END {
		print "member", "status", "front", "dominated_by", "error", "l1", "l2", "max", "relative_l2", "relative_max", "seconds", "spread", "setup",
			"memory_mb", ENVIRON["NAMES"] "sentence", "reason"
		for (m = 1; m <= NR; m++) {
			front = "-"; by = "-"
			if (status[m] == "ok" && sec[m] != "-") {
				# Of the members that dominate m, the one with the smallest product of error and seconds is named.
				best = 0
				for (b = 1; b <= NR; b++) if (b != m && sec[b] != "-" && beats(b, m) && (!best || e[b] * sec[b] < e[best] * sec[best])) best = b
				front = best ? "no" : "yes"; if (best) by = id[best] + 1
			}
			row = id[m] + 1 OFS status[m] OFS front OFS by OFS (why[m] == "" ? e[m] : "-")
			for (i = 2; i <= 6; i++) row = row OFS (why[m] == "" ? norms[id[m], i] : "-")
			print row, sec[m] == "-" ? "-" : sprintf("%.6g", sec[m]), sec[m] == "-" ? "-" : sprintf("%.2g", spread[m]),
				setup[m] == "-" ? "-" : sprintf("%.3g", setup[m]), (mem[m] > 0 ? sprintf("%.1f", mem[m] / 1024) : "-"), tail[m],
					why[m] == "" ? "-" : why[m]
		}
	}' | {
		IFS= read -r d
		printf '%s\n' "$d"
		awk -F'\t' -v OFS='\t' '{ print $2 == "failed", $11 == "-" ? 0 : $11, $5 == "-" ? 0 : $5, $0 }' | sort -t $'\t' -s -k1,1n -k2,2g -k3,3g |
			cut -f4-
	}
}

# The table as text: the front marked with a star, then the alternatives that are never on it, then the failures.
table() {
	awk -F'\t' -v choices=${#choice_name[@]} -v norm="$norm" -v field="${field:-all fields}" -v against="$against" -v errors_only="${jobs:+1}" '
	function cell(r, c, text) { t[r, c] = text; if (length(text) > w[c]) w[c] = length(text) }
	function number(x) { return x == "-" ? x : sprintf("%.3g", x) }
	function line(r,    c, s) { s = ""; for (c = 0; c <= last; c++) s = s sprintf(c == 0 || (c > 1 && c < choices + 2) ? "%-" w[c] "s  " : "%" w[c] "s  ",
		t[r, c]); sub(/ +$/, "", s); print s }
	NR == 1 {
		cell(1, 0, " "); cell(1, 1, "member")
		for (i = 1; i <= choices; i++) { cell(1, i + 1, $(14 + i)); name[i] = $(14 + i) }
		c = choices + 2; cell(1, c++, "error")
		if (!errors_only) { cell(1, c++, "seconds"); cell(1, c++, "spread"); cell(1, c++, "set-up"); cell(1, c++, "MB"); cell(1, c++, "beaten by") }
		last = c - 1; rows = 1; next
	}
	$2 == "failed" { why = $(16 + choices); if (!(why in bad)) { reason[++nbad] = why } else bad[why] = bad[why] ", "; bad[why] = bad[why] $1 }
	{
		r = ++rows; cell(r, 0, $3 == "yes" ? "*" : " "); cell(r, 1, $1)
		for (i = 1; i <= choices; i++) { cell(r, i + 1, $(14 + i)); if ($2 == "reference") continue; if ($3 == "yes") on[i, $(14 + i)] = 1; if (!((i,
			$(14 + i)) in had)) { had[i, $(14 + i)] = 1; order[i] = order[i] "\t" $(14 + i) } }
		c = choices + 2; cell(r, c++, $2 == "ok" ? number($5) : $2); if ($3 == "yes") fronts++
		if (!errors_only) { cell(r, c++, number($11)); cell(r, c++, $12); cell(r, c++, number($13)); cell(r, c++, $14); cell(r, c++,
			$4 == "-" ? "" : $4); }
	}
	END {
		printf "error: %s of %s against %s", norm, field, against
		print errors_only ? "" : "; * on the Pareto front; seconds of the words behind the shared beginning"
		for (r = 1; r <= rows; r++) line(r)
		if (fronts) for (i = 1; i <= choices; i++) {
			n = split(substr(order[i], 2), v, "\t"); s = ""
			for (k = 1; k <= n; k++) if (!((i, v[k]) in on)) s = s (s == "" ? "" : ", ") v[k]
			if (s != "") printf "never on the front: %s %s\n", name[i], s
		}
		for (i = 1; i <= nbad; i++) printf "failed: %s: %s\n", bad[reason[i]], reason[i]
	}' "$1"
}

# The picture: error against seconds, the front as a step line, its members labelled with their choices, the others with their number.
points() {
	awk -F'\t' -v choices=${#choice_name[@]} -v front="$2" -v OFS='\t' 'NR > 1 && $2 == "ok" && $3 == front && $5 > 0 && $11 > 0 {
		label = $1
		if (front == "yes") for (i = 1; i <= choices; i++) label = label " " $(14 + i)
		if (length(label) > 40) label = substr(label, 1, 37) "..."
		print $11, $5, label }' "$1"
}

plot() {
	local dir=$1
	terminal
	if [ -n "$jobs" ]; then
		plot_errors "$dir" || return 1
	else
		plot_front "$dir" || return 1
	fi
	draw "$dir" pareto.gp
}

# The picture without seconds: a line per member with its choices, the smallest error at the top.
plot_errors() {
	local rows
	rows=$(awk -F'\t' -v choices=${#choice_name[@]} 'NR > 1 && $2 == "ok" && $5 > 0 && $5 !~ /inf/ {
		label = $1; for (i = 1; i <= choices; i++) label = label " " $(14 + i)
		gsub(/"/, "\047", label); print ++n "\t" $5 "\t" (length(label) > 60 ? substr(label, 1, 57) "..." : label) }' "$1/pareto.tsv")
	[ -n "$rows" ] || { tell "no member with an error above zero: no picture"; return 1; }
	cat >"$1/pareto.gp" <<GP
set datafile separator tab
\$members << END
$rows
END
set logscale x
set format x "%g"
set yrange [$(wc -l <<<"$rows").5:0.5]
set ytics font ",9" noenhanced
set grid
set key off
set title "Errors, without seconds; numbers are members"
set xlabel $(gnuplot_text "$norm${field:+ of $field}") noenhanced
draw = 'plot \$members using 2:1:yticlabels(3) with points pt 7 ps 0.8 lc rgb "#c03030"'
set terminal svg size 900,$((100 + 18 * $(wc -l <<<"$rows"))) dynamic font "sans,12" background "white"
set output "pareto.svg"
@draw
set terminal $png size 900,$((100 + 18 * $(wc -l <<<"$rows"))) font "sans,11"
set output "pareto.png"
@draw
GP
}

plot_front() {
	local dir=$1
	[ -n "$(points "$dir/pareto.tsv" yes)" ] || { tell "no member with an error and seconds above zero: no picture"; return 1; }
	cat >"$dir/pareto.gp" <<GP
set datafile separator tab
\$front << END
$(points "$dir/pareto.tsv" yes)
END
\$others << END
$(points "$dir/pareto.tsv" no)
END
set logscale xy
set format "%g"
$(awk -F'\t' 'NR > 1 && $2 == "ok" && $5 > 0 && $11 > 0 { x = log($11); y = log($5); n++
		if (n == 1) { a = b = x; c = d = y } if (x < a) a = x; if (x > b) b = x; if (y < c) c = y; if (y > d) d = y }
		END { w = b - a; h = d - c; printf "set xrange [%g:%g]\n", exp(a - 0.04 * w - 0.1), exp(b + 0.3 * w + 0.2)
		printf "set yrange [%g:%g]\n", exp(c - 0.08 * h - 0.1), exp(d + 0.1 * h + 0.1) }' "$dir/pareto.tsv")
set grid
set key off
set title "Error against seconds; red: the Pareto front; numbers are members"
set xlabel "seconds"
set ylabel $(gnuplot_text "$norm${field:+ of $field}") noenhanced
draw = 'plot \$front using 1:2 with steps lw 2 lc rgb "#c03030", '
draw = draw . '\$front using 1:2 with points pt 7 ps 1 lc rgb "#c03030", '
draw = draw . '\$front using 1:2:3 with labels noenhanced left offset 0.8,0.5 font ",10"'
if (|\$others| > 0) draw = draw . ', \$others using 1:2 with points pt 7 ps 0.6 lc rgb "#888888", '
if (|\$others| > 0) draw = draw . '\$others using 1:2:3 with labels noenhanced left offset 0.4,0.3 font ",8" tc rgb "#666666"'
set terminal svg size 900,620 dynamic font "sans,12" background "white"
set output "pareto.svg"
@draw
set terminal $png size 900,620 font "sans,11"
set output "pareto.png"
@draw
GP
}

# Every command that was run, ready to be pasted into a shell: files of the temporary working directory are replaced by files in the current directory.
commands() {
	local m n before start='' i argument
	local -A said=()
	printf '# run in %q\n' "$PWD"
	for n in OMP_NUM_THREADS OMP_WAIT_POLICY; do
		[ -z "${!n:-}" ] || printf 'export %s=%q\n' "$n" "${!n}"
	done
	if [ ${#beginning[@]} != 0 ]; then
		join "${beginning[@]}"
		echo "$text > beginning"
		start=beginning
	fi
	for i in "${!reference_text[@]}"; do
		if [ -f "${reference_text[i]}" ]; then
			printf 'ln -s %q reference.%d\n' "$(realpath -- "${reference_text[i]}")" "$i"
		else
			echo "{ ${reference_text[i]}; }${start:+ < $start} > reference.$i"
		fi
	done
	for m in "${walk[@]}"; do
		before=$start
		if [ -n "$jobs" ]; then
			words "${sentence[m]}"
			join "${word[@]:${#beginning[@]}}"
			echo "{ $text; }${start:+ < $start} > member.$((m + 1))"
			before=member.$((m + 1))
		else
			for n in ${path[m]}; do
				text=${node_word[n]}
				! timed "$text" || text+=" --timing FILE"
				[ -n "${said[$n]:-}" ] || echo "$text${before:+ < $before} > word.$n"
				said[$n]=1 before=word.$n
			done
		fi
		if [ "$against" = exact ]; then
			compare_words "$m" ''
			plain_words "${argument[@]}"
			echo "$text <$before"
		else
			compare_words "$m" "$before"
			plain_words "${argument[@]/#"$work/"/}"
			echo "$text"
		fi
	done
}

rows_html() {
	escape <"$1" | awk -F'\t' '{ tag = NR == 1 ? "<th>" : "<td>"; s = ""; for (i = 1; i <= NF; i++) if (i < 6 || i > 10) s = s tag $i
		print ($3 == "yes" ? "<tr class=front>" : "<tr>") s }'
}

page() {
	local dir=$1
	{
		page_head pareto '.front{background:#fbe9e7}'
		printf '<h1>What accuracy costs in time</h1>\n<h2>The sentence</h2>\n<pre>%s</pre>\n' "$(escape <<<"$command_line")"
		if [ -s "$dir/pareto.svg" ]; then
			[ -n "$jobs" ] || printf '<h2>Error against seconds</h2>\n<p>Red: the Pareto front. Numbers are members.</p>\n'
			[ -z "$jobs" ] || printf '<h2>Errors</h2>\n'
			inline_svg "$dir/pareto.svg"
		fi
		printf '<h2>The members</h2>\n<p>'
		[ -n "$jobs" ] || printf \
			'Of %s repetitions the median seconds of the words behind the shared beginning, half their range as spread; %s' "$repeat" \
			'set-up apart; the largest memory of one word. '
		[ ! -e "$state/reference.0.seconds" ] || printf 'The reference took %s s.' "$(cat "$state"/reference.*.seconds | awk '{ s += $1 } END {
			printf "%.3g", s }')"
		printf '</p>\n<table>\n'
		rows_html "$dir/pareto.tsv"
		printf '</table>\n<h2>In words</h2>\n<pre>%s</pre>\n' "$(table "$dir/pareto.tsv" | escape)"
		page_foot
	} >"$dir/index.html"
}

# choose TSV: prints the cheapest sentence within --until-error, or the most accurate one --within the cost.
choose() {
	awk -F'\t' -v choices=${#choice_name[@]} -v until="$until" -v within="$within_seconds" -v me=$me '
		NR > 1 && $2 == "ok" && $5 !~ /nan|inf/ {
			if (floor == "" || $5 + 0 < floor) floor = $5 + 0
			if ($11 != "-" && (quick == "" || $11 + 0 < quick)) quick = $11 + 0
			if (until != "" && $5 + 0 > until + 0) next
			if (within != "" && ($11 == "-" || $11 + 0 > within + 0)) next
			key = until != "" ? $11 + 0 : $5 + 0
			if (found == "" || key < best) { best = key; found = $(15 + choices) } }
		END { if (found != "") { print found; exit }
			if (floor == "") print me ": no sentence could be measured" > "/dev/stderr"
			else printf "%s: no sentence meets this: the smallest error is %.3g, the shortest time %s s\n", me, floor,
				quick == "" ? "-" : sprintf("%.3g", quick) > "/dev/stderr"
			exit 1 }' "$1"
}
