# shellcheck shell=bash
# The limits that margin found as a table, as JSON, as a picture of growth against the parameter, and as a page.
# SPDX-License-Identifier: GPL-3.0-or-later

conditions() {
	shown "${criterion:-}"
	echo "limit of ${axis_name[0]} between ${axis_low[0]} and ${axis_high[0]}, stable $from it; unstable is ${criterion:+$criterion, or }exit status 3"
	if [ -n "$has_seed" ]; then
		echo "$seeds seeds; the uncertainty is half of the bracket plus half of the range over the seeds"
	else
		echo "no {seed} in the sentence: every run is deterministic, and the uncertainty is half of the bracket"
	fi
	[ "$scan" = 0 ] || awk -v a="${axis_low[0]}" -v b="${axis_high[0]}" -v n="$scan" -v scale="${axis_scale[0]}" -v from="$from" 'BEGIN {
		printf "the first limit from %s of %d values tried: a gap or an island narrower than %.2g%s may be missed (--scan)\n", from, n + 1,
			scale == "log" ? 100 * ((b / a) ^ (1 / n) - 1) : (b - a) / n, scale == "log" ? " %" : "" }'
	if [ -n "${opt_given_length:-}" ]; then
		echo "within runs as long as given"
	elif [ -n "$has_modes" ]; then
		echo "unstable is also a mode that grows (modes): the growth of the linear map, and no run"
	elif [ "$cycles" = 0 ]; then
		echo "nothing was run longer: no cycle whose -n or -t is a number"
	else
		echo "the stable end of each bracket was run twice as long"
	fi
	[ "$moved" = 0 ] || echo "both ends were run twice more with the last bit of the input moved"
}

table() {
	conditions
	awk -F'\t' -v choices=${#choice_shown[@]} '
	function cell(r, c, text) { t[r, c] = text; if (length(text) > w[c]) w[c] = length(text) }
	{ r++; for (c = 1; c <= choices; c++) cell(r, c, $(c + 1))
		k = choices + 2 # parameter; limit uncertainty half spread expected ratio agrees stable seeds runs sentence status reason
		cell(r, c++, NR == 1 ? "limit" : $(k+1) == "-" ? "none" : sprintf("%.6g", $(k+1))); cell(r, c++, NR == 1 ? "+-" : $(k+2))
		if (NR == 1 || $(k+5) != "-") any = 1
		cell(r, c++, $(k+5)); cell(r, c++, $(k+6)); cell(r, c++, NR == 1 ? "agrees" : $(k+7)); cell(r, c++, $(k+10)); last = c - 1
		found[r] = $(k+1) != "-"; why[r] = NR > 1 && $(k+13) != "-" ? $(k+13) : "" }
	END { for (i = 1; i <= r; i++) { s = ""; for (c = 1; c <= last; c++) s = s sprintf(c <= choices ? "%-" w[c] "s  " : "%" w[c] "s  ", t[i, c]);
		sub(/ +$/, "", s); print s }
		for (i = 2; i <= r; i++) if (why[i] != "") { s = ""; for (c = 1; c <= choices; c++) s = s t[i, c] " ";
			what = sub(/^no edge: /, "", why[i]) ? "no edge" : "no limit"
			print found[i] ? s why[i] : what (s == "" ? "" : " for " s) ": " why[i] } }' "$1" | sed 's/ : /: /'
}

json() {
	printf '{"sentence": %s, "unstable_when": %s, "version": "%s", "%s": [\n' "$(quoted "${positional[0]}")" "$([ -z "$criterion" ] && echo null ||
		quoted "$criterion")" "$version" "$2"
	json_rows "$1"
	printf ']}\n'
}

# curve MEMBER: prints value and growth, sorted by value.
curve() { awk -F'\t' -v OFS='\t' -v m="$1" '$2 != m || $3 != 1 { next } $1 == "growth" && $5 != "-" { print $4, $5 }
	$1 == "trial" && $7 ~ /^growth / { print $4, substr($7, 8) }' "$state/log" | sort -g; }

# name_of_member MEMBER: its choices in words.
name_of_member() {
	local d s=''
	for d in "${choice_shown[@]}"; do s+="${s:+ }${chosen[$1 * ${#choice_name[@]} + d]}"; done
	printf '%s' "${s:-${axis_name[0]}}"
}

# plot DIRECTORY: growth against the parameter, a line for each choice; the limits dashed.
plot() {
	local m marks options=()
	{
		printf '%s\tgrowth\tcase\n' "${axis_name[0]}"
		for m in "${!sentence[@]}"; do
			curve "$m" | NAME=$(name_of_member "$m") awk -F'\t' -v OFS='\t' '{ print $1, $2, ENVIRON["NAME"] }'
		done
	} >"$1/points.tsv"
	if [ "$(wc -l <"$1/points.tsv")" = 1 ]; then
		tell "no growth could be measured: no picture (--column NAME)"
		return
	fi
	marks=$(awk -F'\t' -v c=$((${#choice_shown[@]} + 3)) 'NR > 1 && $c != "-" && n++ < 16 { printf "%s%s", (n > 1 ? "," : ""), $c }' "$1/margin.tsv")
	[ -z "$marks" ] || options=(--mark="$marks")
	[ "${axis_scale[0]}" != log ] || options+=(--log-x)
	[ ${#sentence[@]} = 1 ] || options+=(--by case)
	picture "$1" margin --x "${axis_name[0]}" growth --level 0 "${options[@]}" --title 'Growth on both sides of the limit (dashed)' \
		--y-label "growth ${growth:+of ln($growth) }per step"
}

# Every command that was run, in the order of the log.
commands() {
	local what m s x rest one
	while IFS=$'\t' read -r what m s x rest; do
		filled "$m" "$s" "$x"
		if [ "$what" = trial ]; then
			while IFS= read -r one; do echo "$one   # ${rest%%$'\t'*}"; done < <(trial_commands "$text")
		else
			growth_sentence "$m" "$s" "$x" "$(awk -F'\t' -v m="$m" -v s="$s" -v x="$x" '$1 == "trial" && $2 == m && $3 == s && $4 == x { print $6;
				exit }' "$state/log")"
			one=$text
			plain_words diag --columns step,time --growth "$growth"
			echo "$one | $text"
		fi
	done <"$state/log"
}

# page DIRECTORY TITLE TEXT-FILE
page() {
	local dir=$1
	{
		page_head margin
		printf '<h1>%s</h1>\n' "$2"
		pasted 'The sentence' "$command_line"
		if [ -s "$dir/margin.svg" ]; then
			inline_svg "$dir/margin.svg"
			pasted 'The picture from points.tsv' "$picture_command"
		fi
		printf '<h2>In words</h2>\n<pre>%s</pre>\n' "$(escape <"$3")"
		printf '<h2>The numbers</h2>\n<p>A click on the head of a column sorts by it.</p>\n'
		rows_html "$dir/margin.tsv"
		page_foot
	} >"$dir/index.html"
}
