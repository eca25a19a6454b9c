# shellcheck shell=bash
# Makes the result of a sweep from its log: the table of all members with the Pareto front (members to which no other is both cheaper and more accurate),
# as TSV, text and page. SPDX-License-Identifier: GPL-3.0-or-later

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

page() {
	local dir=$1
	{
		page_head pareto
		printf '<h1>What accuracy costs in time</h1>\n'
		pasted 'The sentence' "$command_line"
		if [ -s "$dir/pareto.svg" ]; then
			[ -n "$jobs" ] || printf '<h2>Error against seconds</h2>\n<p>Black steps: the Pareto front, %s.</p>\n' \
				'with the numbers and choices of its members'
			[ -z "$jobs" ] || printf '<h2>Errors</h2>\n'
			inline_svg "$dir/pareto.svg"
			pasted 'The picture from points.tsv' "$picture_command"
		fi
		printf '<h2>The members</h2>\n<p>'
		[ -n "$jobs" ] || printf \
			'Of %s repetitions the median seconds of the words behind the shared beginning, half their range as spread; %s' "$repeat" \
			'set-up apart; the largest memory of one word. '
		[ ! -e "$state/reference.0.seconds" ] || printf 'The reference took %s s.' "$(cat "$state"/reference.*.seconds | awk '{ s += $1 } END {
			printf "%.3g", s }')"
		printf ' A click on the head of a column sorts by it.</p>\n'
		rows_html "$dir/pareto.tsv" 6 10
		printf '<h2>In words</h2>\n<pre>%s</pre>\n' "$(table "$dir/pareto.tsv" | escape)"
		page_foot
	} >"$dir/index.html"
}

# choose TSV: prints the cheapest sentence within --until-error, or the most accurate one --within the cost.
choose() {
	awk -F'\t' -v until="$until" -v within="$within_seconds" -v me=$me '
		NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
		$2 == "ok" && $5 !~ /nan|inf/ {
			if (floor == "" || $5 + 0 < floor) floor = $5 + 0
			if ($11 != "-" && (quick == "" || $11 + 0 < quick)) quick = $11 + 0
			if (until != "" && $5 + 0 > until + 0) next
			if (within != "" && ($11 == "-" || $11 + 0 > within + 0)) next
			key = until != "" ? $11 + 0 : $5 + 0
			if (found == "" || key < best) { best = key; found = $at["sentence"] } }
		END { if (found != "") { print found; exit }
			if (floor == "") print me ": no sentence could be measured" > "/dev/stderr"
			else printf "%s: no sentence meets this: the smallest error is %.3g, the shortest time %s s\n", me, floor,
				quick == "" ? "-" : sprintf("%.3g", quick) > "/dev/stderr"
			exit 1 }' "$1"
}

# answer_again: without a sentence, --until-error, --within and --tsv are answered from the finished sweep in the directory of -o.
answer_again() {
	[[ -n $keep && -n $until$within_seconds${opt_tsv:-} ]] || usage "SENTENCE is missing"
	[ -s "$keep/pareto.tsv" ] || usage "SENTENCE is missing, and '$keep' holds no finished sweep (pareto.tsv)"
	if [ -n "$until$within_seconds" ]; then choose "$keep/pareto.tsv"; else cat -- "$keep/pareto.tsv"; fi
}
