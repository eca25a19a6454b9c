# shellcheck shell=bash
# Longer runs: the steps and the time of every cycle of a sentence, multiplied. A value in the log that ends in @2 was run twice as long.
# SPDX-License-Identifier: GPL-3.0-or-later

# lengthen TEXT FACTOR: sets text to TEXT with -n and -t outside quotes multiplied; fails if there is none with a number.
lengthen() {
	text=$(TEXT=$1 awk -v factor="$2" '
	function longer(s,    out, number, lead) {
		while (match(s, /(^|[ \t])(-n[ \t]*|--steps[= \t]+|-t[ \t]*|--time[= \t]+)[0-9.]+([eE][-+]?[0-9]+)?([ \t]|$)/)) {
			lead = substr(s, RSTART, RLENGTH)
			out = out substr(s, 1, RSTART - 1); s = substr(s, RSTART + RLENGTH)
			match(lead, /[0-9.]+([eE][-+]?[0-9]+)?[ \t]*$/)
			number = substr(lead, RSTART); lead = substr(lead, 1, RSTART - 1)
			found = 1; s = (number ~ /[ \t]$/ ? " " : "") s
			out = out lead sprintf("%.15g", number * factor) }
		return out s }
	BEGIN { t = ENVIRON["TEXT"]; n = length(t)
		for (i = 1; i <= n; i++) {
			c = substr(t, i, 1)
			if (quote == "" && (c == "\"" || c == "\047")) { all = all longer(part) c; part = ""; quote = c; continue }
			if (quote == "") { part = part c; continue }
			all = all c
			if (c == "\\" && quote == "\"") all = all substr(t, ++i, 1)
			else if (c == quote) quote = "" }
		printf "%s", all longer(part)
		exit !found }')
}

# can_lengthen: succeeds if every cycle of the sentence says its length as a number; sets cycles to how many there are, and steps to that of the last
# ("" a time).
can_lengthen() {
	local w rest
	cycles=0 steps=
	words "${sentence[0]}"
	for w in "${word[@]}"; do
		[[ $w =~ $cycle_word ]] || continue
		rest=${BASH_REMATCH[4]}
		cycles=$((cycles + 1))
		lengthen "$rest" 2 || return 1
		steps=
		[[ ! $rest =~ ^[[:space:]]+(-n[[:space:]]*|--steps[=[:space:]]+)([0-9]+)[[:space:]] ]] || steps=${BASH_REMATCH[2]}
	done
	[ $cycles != 0 ]
}
