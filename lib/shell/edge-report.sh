# shellcheck shell=bash
# The output of margin: the table on standard output, and with -o TSV, JSON, pictures and the page. SPDX-License-Identifier: GPL-3.0-or-later

# show TABLE-COMMAND TSV NAME: prints the result in the chosen format.
show() {
	case $format in
	tsv) cat "$2" ;;
	json) json "$2" "$3" ;;
	*) "$1" "$2" ;;
	esac
}

report() {
	local title="How far from the edge" table=table name=limits drawn=plot
	if [ ${#axis_name[@]} = 2 ]; then
		title="Where it is stable" table=table_map name=points drawn=plot_map
		tsv_map >"$work/margin.tsv"
	else
		tsv >"$work/margin.tsv"
	fi
	[ ! -t 2 ] || printf '\r\033[K' >&2
	if [ -n "$keep" ]; then
		cp "$work/margin.tsv" "$keep/margin.tsv"
		[ ${#axis_name[@]} = 1 ] || tsv_boundary >"$keep/boundary.tsv"
		json "$work/margin.tsv" $name >"$keep/margin.json"
		$drawn "$keep"
		$table "$work/margin.tsv" >"$work/text"
		page "$keep" "$title" "$work/text"
	fi
	show $table "$work/margin.tsv" $name
	[[ -z $keep || $format != table ]] || echo "page: $keep/index.html"
	if [ ${#axis_name[@]} = 1 ]; then
		awk -F'\t' -v c=$((${#choice_shown[@]} + 3)) 'NR > 1 && $c != "-" { found = 1 } END { exit !found }' "$work/margin.tsv" ||
			fail 1 "$(awk -F'\t' 'NR == 2 { print ($NF ~ /^no edge/ ? "" : "no limit: ") $NF }' "$work/margin.tsv")"
	fi
}
