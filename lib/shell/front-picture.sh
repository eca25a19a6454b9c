# shellcheck shell=bash
# The picture of a sweep, drawn by splot: error against seconds with a line per method and the Pareto front, or the errors alone.
# SPDX-License-Identifier: GPL-3.0-or-later

# front_points TSV: the front, then the members by method: what their choices that are words have in common. Numbers among the choices (cells, orders,
# steps) vary along the line. More than 12 methods are too many lines: then the first choice of words, as points.
front_points() {
	awk -F'\t' -v OFS='\t' -v choices=${#choice_name[@]} -v size="$size_choice" -v clock="$clock" '
	function short(s) { return length(s) > 44 ? substr(s, 1, 41) "..." : s }
	function named(s) { return s == "" ? "(none)" : s }
	function method(f, k,    i, s) {
		s = ""
		for (i = 1; i <= choices; i++) if (word[i] && (!k || i == k)) s = s (s == "" ? "" : " ") named(f[first + i])
		return s == "" ? "members" : s }
	NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; first = at["sentence"] - choices - 1; name = $(first + size)
		time = clock == "wall" ? 11 : at["processor"]; bar = clock == "wall" ? 12 : at["processor_spread"]; next }
	($2 == "ok" || $2 == "extrapolated") && $5 !~ /nan|inf/ && $time != "-" { row[++n] = $0
		for (i = 1; i <= choices; i++) if (i != size && $(first + i) !~ /^[-+]?[0-9]*\.?[0-9]+([eE][-+]?[0-9]+)?$/) {
			word[i] = 1; if (!word1) word1 = i } }
	END {
		for (r = 1; r <= n; r++) { split(row[r], f, "\t"); m = method(f, 0); if (!(m in seen)) { seen[m] = 1; methods++ } }
		print "method", "error", "seconds", "spread", "name", "style"
		for (front = 1; front >= 0; front--) for (r = 1; r <= n; r++) {
			split(row[r], f, "\t")
			if (front && f[3] != "yes") continue
			label = f[1]
			for (i = 1; i <= choices; i++) label = label " " f[first + i]
			at_size = size ? " " name " " f[first + size] (f[2] == "extrapolated" ? " (extrapolated)" : "") : ""
			m = (front ? "Pareto front" : short(method(f, methods > 12 ? word1 : 0))) at_size
			label = front ? short(label) : ""
			style = methods > 12 ? "points" : "both"
			print m, f[5], f[time], front ? "-" : f[bar], label, style, front ? 0 : 1, size ? f[first + size] : 0, front ? f[time] : f[1]
		}
	}' "$1" | { IFS= read -r head; printf '%s\n' "$head"; sort -t $'\t' -s -k7,7n -k8,8g -k9,9g | cut -f1-6 |
		awk -F'\t' '/^Pareto front/ { if (($1 in low) && $2 + 0 >= low[$1]) next; low[$1] = $2 + 0 } { print }'; } # ties are points, not steps
}

# plot DIRECTORY: points.tsv, pareto.svg and pareto.png there; sets picture_command.
plot() {
	local style m steps=()
	if [ -n "$jobs" ]; then
		awk -F'\t' -v OFS='\t' -v choices=${#choice_name[@]} 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "sentence") first = i - choices - 1
			print "member", "error" } NR > 1 && $2 == "ok" && $5 !~ /nan|inf/ {
			label = $1; for (i = 1; i <= choices; i++) label = label " " $(first + i)
			if (length(label) > 50) label = substr(label, 1, 47) "..."
			print label, $5 }' "$1/pareto.tsv" >"$1/points.tsv"
		picture "$1" pareto --x error member --log-x --style points --title "Errors, without seconds" --y-label '' \
			--x-label "$norm${field:+ of $field}" --height $((120 + 26 * $(wc -l <"$1/points.tsv")))
		return
	fi
	front_points "$1/pareto.tsv" >"$1/points.tsv"
	style=$(awk -F'\t' 'NR == 2 { print $6 }' "$1/points.tsv")
	while IFS= read -r m; do steps+=(--style-of "$m=steps"); done < <(cut -f1 "$1/points.tsv" | grep '^Pareto front' | uniq)
	picture "$1" pareto --x seconds error --x-error spread --by method --name name --log --style "${style:-both}" "${steps[@]}" \
		--title "Error against seconds" --x-label "$([ "$clock" = wall ] || echo 'processor ')seconds" \
		--y-label "$norm${field:+ of $field}" --width 1000 --height 660
}
