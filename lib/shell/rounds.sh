# shellcheck shell=bash
# The rounds of timing: all members once, then again until the times of those that may be on the front are known to --spread, or the budget is used up.
# Every round has another order, drawn from the texts of the words alone, so that drift affects all alike and the order of the braces nothing. How busy
# other programs kept the processors meanwhile is measured (/proc/stat) and said.
# SPDX-License-Identifier: GPL-3.0-or-later

# ordered ROUND MEMBERS...: prints the members in the order of this round; those with a common beginning stay together.
ordered() {
	local n m round=$1
	shift
	{
		for n in "${!node_word[@]}"; do printf 'w\t%d\t%s\n' "$n" "${node_word[n]}"; done
		for m; do printf 'm\t%d\t%s\n' "$m" "${path[m]}"; done
	} | awk -F'\t' -v round="$round" '
		BEGIN { for (i = 1; i < 256; i++) code[sprintf("%c", i)] = i }
		$1 == "w" { h = 7; for (i = 1; i <= length($3); i++) h = (h * 31 + code[substr($3, i, 1)]) % 2147483647
			h = (h * (round * 7919 + 12345)) % 2147483647; key[$2] = sprintf("%010d.%06d", (h * 48271) % 2147483647, $2); next }
		{ n = split($3, p, " "); s = ""; for (i = 1; i <= n; i++) s = s key[p[i]] "/"; print s "\t" $2 }' | sort | cut -f2
}

# unsettled: prints the members that may be on the front and whose time is not known to --spread (or to 0.1 ms).
unsettled() {
	tsv | awk -F'\t' -v clock="$clock" -v spread="$spread" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
		$2 == "ok" && $3 == "yes" { t = $(at[clock == "wall" ? "seconds" : "processor"]); half = $(at[clock == "wall" ? "spread" : "processor_spread"])
			if (half > spread * t && half > 1e-4) print $1 - 1 }'
}

# Seconds of all processors together since the machine started that were not idle, and those of this program and the words that it has run; the second
# are in $work/times, which `times` must write outside of every $( ).
busy_seconds() {
	awk -v hz="$(getconf CLK_TCK)" 'FNR == 1 && FILENAME ~ /stat$/ { busy = ($2 + $3 + $4 + $7 + $8 + $9) / hz }
		FILENAME !~ /stat$/ { for (i = 1; i <= 2; i++) { t = $i; sub(/s$/, "", t); split(t, c, "m"); own += 60 * c[1] + c[2] } }
		END { print busy, own }' "${PROC_STAT:-/proc/stat}" "$work/times" 2>/dev/null || true
}

load_begin() {
	times >"$work/times"
	load_then="$(busy_seconds) $EPOCHREALTIME"
}

# load_end: how many processors others kept busy since load_begin; a loaded machine is one where that is above a tenth of all.
load_end() {
	local others
	times >"$work/times"
	others=$(awk -v then="$load_then" -v now="$(busy_seconds) $EPOCHREALTIME" 'BEGIN {
		if (split(then, a, " ") != 3 || split(now, b, " ") != 3 || b[3] - a[3] < 0.3) exit
		x = (b[1] - a[1] - (b[2] - a[2])) / (b[3] - a[3]); printf "%.1f", (x > 0 ? x : 0) }')
	[ -n "$others" ] || return 0
	note "load"$'\t'"$others"$'\t'"$(processors)"
}

# loaded: prints a sentence if the machine was loaded during one of the measurements in the log.
loaded() {
	awk -F'\t' '$1 == "load" && $2 > most { most = $2; all = $3 } END { if (most > 0.1 * all && most >= 0.2) printf \
		"the machine was loaded: others kept %.1f of %d processors busy during the measurement (wall times are too long then; --time processor)\n",
			most, all }' "$state/log"
}

tell_loaded() {
	local said
	said=$(loaded)
	[ -z "$said" ] || tell "$said"
}

# One round over the members in todo.
one_round() {
	local m order done_now=0 to_do=0 missing=()
	for m in "${todo[@]}"; do is_complete "$m" "$round" || missing+=("$m"); done
	[ ${#missing[@]} != 0 ] || return 0
	mapfile -t order < <(ordered "$round" "${missing[@]}")
	to_do=${#order[@]}
	for m in "${order[@]}"; do
		progress $done_now "$to_do" " (round $round${opt_repeat:+ of $repeat}: ${sentence[m]})"
		visit "$m" "$round"
		done_now=$((done_now + 1))
	done
	rm -f "$work"/node.*
	held=()
}

# measure: exactly --repeat rounds where these are given; else three, then until all is known to --spread, for at most the budget. Five rounds are the
# least after which an interval has its 90 %.
measure() {
	local round todo=("${walk[@]}") began_all=$SECONDS
	load_begin
	for ((round = 1; ; round++)); do
		began=$SECONDS
		one_round
		if [ "$fixed" = 1 ]; then
			[ "$round" -lt "$repeat" ] || break
		elif [ "$round" -ge "$repeat" ]; then
			if [ $((SECONDS - began_all)) -ge "$budget" ]; then
				mapfile -t todo < <(unsettled)
				[ ${#todo[@]} = 0 ] || tell "after $round rounds and $budget s the time of ${#todo[@]} sentences that may be on the front is" \
					"not known to $(awk -v x="$spread" 'BEGIN { print 100 * x }') %" \
					"(--budget, --spread; --time processor on a loaded machine)"
				break
			elif [ "$round" -ge 5 ]; then
				mapfile -t todo < <(unsettled)
				[ ${#todo[@]} != 0 ] || break
			fi
		fi
	done
	load_end
}
