# shellcheck shell=bash
# The result of a sweep (lib/shell/members.sh) as text, JSON and page, the commands that were run, and the answers to --until-error and --within.
# SPDX-License-Identifier: GPL-3.0-or-later

# The table as text: the front marked with *, or ~ where another member may beat it within noise; then the alternatives that are never on it, the failures,
# the power laws of --size, and the load of the machine.
table() {
	awk -F'\t' -v choices=${#choice_name[@]} -v norm="$norm" -v field="${field:-all fields}" -v against="$against" -v errors_only="${jobs:+1}" \
		-v size="$size_choice" -v clock="$clock" '
	function cell(r, c, text) { t[r, c] = text; if (length(text) > w[c]) w[c] = length(text) }
	function number(x) { return x == "-" ? x : sprintf("%.3g", x) }
	function line(r,    c, s) { s = ""; for (c = 0; c <= last; c++) s = s sprintf(c == 0 || (c > 1 && c < choices + 2) ? "%-" w[c] "s  " : "%" w[c] "s  ",
		t[r, c]); sub(/ +$/, "", s); print s }
	NR == 1 {
		for (i = 1; i <= NF; i++) at[$i] = i
		first = at["sentence"] - choices - 1
		cell(1, 0, " "); cell(1, 1, "member")
		for (i = 1; i <= choices; i++) { cell(1, i + 1, $(first + i)); name[i] = $(first + i) }
		n = split(errors_only ? "error" : "error seconds spread processor spread set-up MB beaten_by tie_with", head, " ")
		for (i = 1; i <= n; i++) { sub(/_/, " ", head[i]); cell(1, choices + 1 + i, head[i]) }
		last = choices + 1 + n; rows = 1; next
	}
	$2 == "failed" { why = $NF; if (!(why in bad)) { reason[++nbad] = why } else bad[why] = bad[why] ", "; bad[why] = bad[why] $1 }
	{
		r = ++rows; tied = $(at["ties"]) != "-"; cell(r, 0, $3 != "yes" ? " " : tied ? "~" : "*"); cell(r, 1, $1)
		for (i = 1; i <= choices; i++) {
			x = $(first + i); cell(r, i + 1, x); if ($2 == "reference") continue; if ($3 == "yes") on[i, x] = 1
			if (!((i, x) in had)) { had[i, x] = 1; order[i] = order[i] "\t" x } }
		if (size && $2 == "extrapolated") cell(r, size + 1, $(first + size) " (extrapolated)")
		c = choices + 2; cell(r, c++, $2 == "ok" || $2 == "extrapolated" ? number($5) : $2); if ($3 == "yes") fronts++
		if (tied) ties = 1
		if ($(at["rounds"]) == 1) once = 1
		if (!errors_only) { cell(r, c++, number($11)); cell(r, c++, $12)
			cell(r, c++, number($(at["processor"]))); cell(r, c++, $(at["processor_spread"]))
			cell(r, c++, number($13)); cell(r, c++, $14); cell(r, c++, $4 == "-" ? "" : $4); cell(r, c++, tied ? $(at["ties"]) : "") }
	}
	END {
		printf "error: %s of %s against %s", norm, field, against
		said = size ? " of its size" : ""
		if (ties) said = said ", ~ on it within noise"
		said = said "; " clock " seconds of the words behind the shared beginning" (once ? ", one round: noise unknown" : "")
		print errors_only ? "" : "; * on the Pareto front" said
		for (r = 1; r <= rows; r++) line(r)
		if (fronts) for (i = 1; i <= choices; i++) if (i != size) {
			n = split(substr(order[i], 2), v, "\t"); s = ""
			for (k = 1; k <= n; k++) if (!((i, v[k]) in on)) s = s (s == "" ? "" : ", ") v[k]
			if (s != "") printf "never on the front: %s %s\n", name[i], s
		}
		for (i = 1; i <= nbad; i++) printf "failed: %s: %s\n", bad[reason[i]], reason[i]
	}' "$1"
	[[ -z $size_choice || -n $jobs ]] || laws "$1"
	loaded
}

# Every command that was run, ready to be pasted into a shell: files of the temporary working directory are replaced by files in the current directory.
commands() {
	local m n before start='' i argument
	begins() { [ ${#beginning_text[@]} = 1 ] && echo beginning || echo "beginning.$1"; }
	local -A said=()
	printf '# run in %q\n' "$PWD"
	for n in OMP_NUM_THREADS OMP_WAIT_POLICY; do
		[ -z "${!n:-}" ] || printf 'export %s=%q\n' "$n" "${!n}"
	done
	[ $skip = 0 ] || for i in "${!beginning_text[@]}"; do
		[[ " ${reference_begins[*]} ${beginning_of[*]:0:${#walk[@]}} " != *" $i "* ]] || echo "${beginning_text[i]} > $(begins "$i")"
	done
	for i in "${!reference_text[@]}"; do
		if [ -f "${reference_text[i]}" ]; then
			printf 'ln -s %q reference.%d\n' "$(realpath -- "${reference_text[i]}")" "$i"
		else
			[ $skip = 0 ] || start=$(begins "${reference_begins[i]}")
			echo "{ ${reference_text[i]}; }${start:+ < $start} > reference.$i"
		fi
	done
	for m in "${walk[@]}"; do
		[ $skip = 0 ] || start=$(begins "${beginning_of[m]}")
		before=$start
		if [ -n "$jobs" ]; then
			words "${sentence[m]}"
			join "${word[@]:skip}"
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
			'Median seconds over the rounds, of the words behind the shared beginning; their true median lies within the spread with 90 %% %s' \
			'(3 rounds: 75 %, 5: 94 %); set-up apart; the largest memory of one word. Members within noise of each other are a tie. '
		printf '%s ' "$(loaded | escape)"
		[ ! -e "$state/reference.0.seconds" ] || printf 'The reference took %s s.' "$(cat "$state"/reference.*.seconds | awk '{ s += $1 } END {
			printf "%.3g", s }')"
		printf ' A click on the head of a column sorts by it.</p>\n'
		rows_html "$dir/pareto.tsv" 6 10
		printf '<h2>In words</h2>\n<pre>%s</pre>\n' "$(table "$dir/pareto.tsv" | escape)"
		page_foot
	} >"$dir/index.html"
}

# choose TSV: prints the cheapest sentence within --until-error, or the most accurate one --within the cost; a note names those that cost as much within noise.
choose() {
	awk -F'\t' -v until="$until" -v within="$within_seconds" -v me=$me -v clock="$clock" -v quiet="${opt_quiet:-}" -v refined="${opt_refine:-}" '
		NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; t = at[clock == "wall" ? "seconds" : "processor"]
			s = at[clock == "wall" ? "spread" : "processor_spread"]; next }
		$2 == "ok" && $5 !~ /nan|inf/ {
			if (floor == "" || $5 + 0 < floor) floor = $5 + 0
			if ($t != "-" && (quick == "" || $t + 0 < quick)) quick = $t + 0
			if (until != "" && $5 + 0 > until + 0) next
			if (within != "" && ($t == "-" || $t + 0 > within + 0)) next
			low[++n] = $t - $s; id[n] = $1
			key = until != "" ? $t + 0 : $5 + 0
			if (found == "" || key < best) { best = key; found = $at["sentence"]; which = $1; high = $t + $s } }
		END { if (found != "") {
				print found
				if (until != "") for (i = 1; i <= n; i++) if (id[i] != which && low[i] <= high) same = same " " id[i]
				if (same != "" && !quiet) print me ": within noise members" same " cost as much" > "/dev/stderr"
				exit }
			if (floor == "") print me ": no sentence could be measured" > "/dev/stderr"
			else printf "%s: no sentence meets this: the smallest error is %.3g, the shortest time %s s%s\n", me, floor,
				quick == "" ? "-" : sprintf("%.3g", quick), until == "" || refined ? "" : " (--refine searches finer numbers)" > "/dev/stderr"
			exit 1 }' "$1"
}

# answer_again: without a sentence, --until-error, --within and --format tsv or json are answered from the finished sweep in the directory of -o.
answer_again() {
	[[ -n $keep && ( -n $until$within_seconds || ${format:-table} != table ) ]] || usage "SENTENCE is missing ($arguments_text)"
	[ -s "$keep/pareto.tsv" ] || usage "SENTENCE is missing ($arguments_text), and '$keep' holds no finished sweep (pareto.tsv)"
	if [ -n "$until$within_seconds" ]; then choose "$keep/pareto.tsv"; else cat -- "$keep/pareto.$format"; fi
}

# json TSV: the table, with what was asked.
json() {
	printf '{"sentence": %s, "against": %s, "field": %s, "norm": "%s", "time": "%s", "version": "%s", "members": [\n' "$(quoted "${positional[0]}")" \
		"$(quoted "$against")" "$([ -z "$field" ] && echo null || quoted "$field")" "$norm" "$clock" "$version"
	json_rows "$1"
	printf ']}\n'
}

report() {
	tsv >"$work/pareto.tsv"
	[ ! -t 2 ] || printf '\r\033[K' >&2
	if [ -n "$keep" ]; then
		cp "$work/pareto.tsv" "$keep/pareto.tsv"
		json "$work/pareto.tsv" >"$keep/pareto.json"
		plot "$keep"
		page "$keep"
	fi
	[[ -z $until$within_seconds && ${format:-table} = table ]] || tell_loaded
	if [ -n "$until$within_seconds" ]; then
		choose "$work/pareto.tsv"
	elif [ "$format" = tsv ]; then
		cat "$work/pareto.tsv"
	elif [ "$format" = json ]; then
		json "$work/pareto.tsv"
	else
		table "$work/pareto.tsv"
		[ -z "$keep" ] || echo "page: $keep/index.html"
	fi
	awk -F'\t' 'NR > 1 && $2 != "failed" { found = 1 } END { exit !found }' "$work/pareto.tsv" || fail 1 "every sentence failed"
}
