# shellcheck shell=bash
# --until-error E --refine: what would do when no listed sentence does. The numbers among the alternatives (cells, order, dt, theta) are continued along the
# convergence that the measured members show: of members that differ in one number alone, error = rest + part with part ~ value^-p, time ~ value^q. Each
# step changes one number of one method, the one that lowers the error most for its time, towards the value that would meet E, by at most the square of
# the ratio between the listed values; it is run, and the next step starts from what was measured. Where no number lowers the error by 10 % there is a
# floor, set by a word or by the reference. The steps are kept in the log: refined BASE VALUES...
# SPDX-License-Identifier: GPL-3.0-or-later

# settle_refine: which choices are numbers: numeric[choice] is 1, or "whole" where all listed values are whole numbers.
settle_refine() {
	local d k whole any=
	numeric=()
	[ -n "${opt_refine:-}" ] || return 0
	for d in "${!choice_name[@]}"; do
		numeric[d]=1 whole=whole
		for ((k = choice_first[d]; k < choice_first[d] + choice_count[d]; k++)); do
			[[ ${alternative[k]} =~ ^([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$ && ${alternative[k]} =~ ^[^eE]*[1-9] ]] || numeric[d]=0
			[[ ${alternative[k]} =~ ^[0-9]+$ ]] || whole=1
		done
		[[ ${numeric[d]} = 0 || ${choice_count[d]} -lt 2 ]] || numeric[d]=$whole any=1
		[ "${choice_count[d]}" -ge 2 ] || numeric[d]=0
	done
	[ -n "$any" ] || usage "--refine finds no numbers to refine (alternatives that are numbers, in braces of their own or by --vary: -n {16,32})"
}

# add_refined BASE VALUES...: a member like BASE with these values of the choices; - keeps the one of BASE.
add_refined() {
	local d base=$1 value=() indices
	local -A there=()
	shift
	read -r -a indices <<<"${at_of[base]}"
	for d in "${!choice_name[@]}"; do
		value[d]=${alternative[choice_first[d] + indices[d]]}
		[ "${numeric[d]:-0}" = 0 ] || value[d]=${chosen[base * ${#choice_name[@]} + d]}
		[ "$1" = - ] || value[d]=$1
		shift
	done
	at=("${indices[@]}")
	add_values
	plant $((${#sentence[@]} - 1))
	refer $((${#sentence[@]} - 1))
}

# add_again BASE VALUES: a step of the log.
add_again() {
	local values
	read -r -a values <<<"$2"
	[[ $1 =~ ^[0-9]+$ && $1 -lt ${#sentence[@]} && ${#values[@]} = "${#choice_name[@]}" ]] || return 0
	add_refined "$1" "${values[@]}"
}

# next_step: from the table of what is measured, one line: step BASE CHOICE VALUE ERROR SECONDS KB ORDER | met MEMBER | then `floor MEMBER WHY` lines.
next_step() {
	tsv | awk -F'\t' -v choices=${#choice_name[@]} -v numeric="${numeric[*]}" -v until="$until" -v clock="$clock" -v closed="$closed_methods" \
		-v listed="$listed" '
	function alike(a, b, d,    i) { for (i = 1; i <= choices; i++) if (i != d && v[a, i] != v[b, i]) return 0; return v[a, d] + 0 != v[b, d] + 0 }
	function good(x) { return x ~ /[0-9]/ && x !~ /nan|inf/ }
	function smooth(n,    m) { for (m = n; m % 2 == 0; m /= 2); for (; m % 3 == 0; m /= 3); for (; m % 5 == 0; m /= 5); return m == 1 }
	# The value in the direction of refinement: whole and even, with small prime factors as meshes like it, or three digits.
	function rounded(x, from, whole) {
		if (!whole) return sprintf("%.3g", x) + 0 == from + 0 ? sprintf("%.5g", x) : sprintf("%.3g", x)
		if (x < from) return int(x)
		x = x == int(x) ? x : int(x) + 1
		if (from % 2 == 0) { x += x % 2; while (!smooth(x)) x += 2 }
		return sprintf("%d", x) }
	BEGIN { split(numeric, num, " ") }
	NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; first = at["sentence"] - choices - 1; time = at[clock == "wall" ? "seconds" : "processor"]
		for (i = 1; i <= choices; i++) names[i] = $(first + i); next }
	$2 == "ok" || $2 == "failed" {
		n++; id[n] = $1 - 1; ok[n] = $2 == "ok"; e[n] = $5; t[n] = $time; kb[n] = $14 == "-" ? 0 : $14 * 1024; why[n] = $NF; k = ""
		for (i = 1; i <= choices; i++) { v[n, i] = $(first + i); if (num[i] == "0") k = k "\t" $(first + i) }
		if (!(k in seen)) { seen[k] = ++methods; key[methods] = k }
		of[n] = seen[k]
		if (ok[n] && good(e[n]) && (!(of[n] in cur) || e[n] + 0 < e[cur[of[n]]] + 0)) cur[of[n]] = n }
	# One number of one method, in the model error = rest + part, part ~ value^-p: sets dir (of refinement), p (the largest order of a pair; of a number
	# not tried from here at least 1), part (from the last step towards cur, -1 where it was not tried from here), cost (q), ratio, finer.
	function look(m, d,    a, b, c, x, y, s, w, q, z, low, high, count, values, fine) {
		c = cur[m]; s = w = q = z = finer = p = 0
		for (a = 1; a <= n; a++) if (of[a] == m && ok[a] && e[a] > 0) {
			x = log(v[a, d])
			if (id[a] < listed && !(x in values)) { values[x] = 1; if (!count++) low = high = x; if (x < low) low = x; if (x > high) high = x }
			for (b = 1; b < a; b++) if (of[b] == m && ok[b] && e[b] > 0 && alike(a, b, d)) {
				x = log(v[a, d] / v[b, d]); y = log(e[a] / e[b]); s += x * y; w += x * x; q += x * log(t[a] / t[b])
				if (kb[a] > 0 && kb[b] > 0) z += x * log(kb[a] / kb[b]) } }
		if (!w) return 0
		dir = s < 0 ? 1 : -1; cost = dir * q / w; memory = dir * z / w; part = -1
		ratio = (high - low) / (count - 1); ratio = ratio < 0.22 ? 0.22 : ratio > 1.4 ? 1.4 : ratio # of the logarithm: 1.25 to 4
		if (cost * ratio < 0.05) cost = 0.05 / ratio
		for (a = 1; a <= n; a++) if (of[a] == m && ok[a] && e[a] > 0) {
			for (b = 1; b < a; b++) if (of[b] == m && ok[b] && e[b] > 0 && alike(a, b, d)) {
				y = -dir * log(e[a] / e[b]) / log(v[a, d] / v[b, d]); if (y > p) p = y > 12 ? 12 : y } }
		for (a = 1; a <= n; a++) if (of[a] == m && alike(a, c, d) && dir * log(v[a, d] / v[c, d]) > 0) finer = a
		# The last step to this value: of members like cur, else of others where the error was about as small, so that nothing else ruled.
		fine = coarser(m, d, c) ? c : 0
		if (!fine) for (a = 1; a <= n; a++) if (of[a] == m && ok[a] && e[a] > 0 && e[a] < 1.2 * e[c] && v[a, d] == v[c, d] && coarser(m, d, a) &&
			(!fine || e[a] + 0 < e[fine] + 0)) fine = a
		if (fine) {
			a = coarser(m, d, fine)
			part = p > 0 ? (e[a] - e[fine]) / (exp(p * dir * log(v[fine, d] / v[a, d])) - 1) : 0
			part = part < 0 ? 0 : part > e[c] ? e[c] : part
		} else if (p < 1) p = 1
		return 1 }
	# The nearest coarser neighbour of a member in a number, or 0.
	function coarser(m, d, c,    a, x, best) {
		best = 0
		for (a = 1; a <= n; a++) if (of[a] == m && ok[a] && e[a] > 0 && alike(a, c, d)) {
			x = dir * log(v[a, d] / v[c, d])
			if (x < 0 && (!best || x > dir * log(v[best, d] / v[c, d]))) best = a }
		return best }
	END {
		for (m = 1; m <= methods; m++) if ((m in cur) && e[cur[m]] <= until + 0 && (!met || t[cur[m]] + 0 < t[met] + 0)) met = cur[m]
		for (m = 1; m <= methods; m++) {
			if (!(m in cur) || e[cur[m]] <= until + 0 || index(closed, "," m ",")) continue
			c = cur[m]; top = 0; text = ""; rest = e[c]
			for (d = 1; d <= choices; d++) if (num[d] != "0" && look(m, d) && part > 0) rest -= part
			for (d = 1; d <= choices; d++) {
				if (num[d] == "0" || !look(m, d)) continue
				if (text != "") sep = "; "; else sep = ""
				if (finer) { text = text sep names[d] " " v[finer, d] (ok[finer] ? " has error " e[finer] : " fails: " why[finer]); continue }
				stale = part < 0
				if (stale) part = rest > 0.01 * e[c] ? rest : 0.01 * e[c]
				fall = -log(1 - part / e[c] * (1 - exp(-p * ratio)) + 1e-12)
				if (!stale && fall < 0.1) { text = text sep names[d] " finer than " v[c, d] " would not lower it by 10 %"; continue }
				score = fall / (cost * ratio)
				if (score <= top) continue
				far = stale ? ratio : 2 * ratio
				left = (part - e[c] + 0.9 * until) / part # of the part, where the error is met
				need = left > 0 ? -log(left) / p : ratio
				if (need > far) need = far
				x = rounded(v[c, d] * exp(dir * need), v[c, d], num[d] == "whole")
				if (x + 0 == v[c, d] + 0 || x + 0 <= 0) { text = text sep names[d] " " v[c, d] " cannot be finer"; continue }
				top = score
				y = dir * log(x / v[c, d])
				line = sprintf("step\t%d\t%d\t%s\t%.3g\t%.3g\t%d\t%.2f\t%d", id[c], d - 1, x, e[c] - part * (1 - exp(-p * y)),
					t[c] * exp(cost * y), kb[c] * exp((memory > 0 ? memory : 0) * y), p, m)
			}
			if (text == "") text = "none of its numbers changes the error"
			if (!top) { floors = floors sprintf("floor\t%d\t%s\t%s\n", id[c] + 1, e[c], text); continue }
			goal = log(t[c] > 0 ? t[c] : 1e-9) + log(e[c] / until) / top
			if (met && goal > log(0.8 * t[met])) continue
			if (best == "" || goal < lowest) { lowest = goal; best = line }
		}
		if (best != "") print best
		else if (met) print "met\t" id[met]
		else printf "%s", floors
	}'
}

# refine: steps until the error is met or nothing is left; then the sentence found is timed as often as the others.
refine() {
	local step what base d x error seconds kb order method m row left from said values steps=$((${#sentence[@]} - listed)) began_all=$SECONDS round todo
	closed_methods=,
	if [[ -n $keep && -s $keep/refine.tsv && ${#sentence[@]} -gt $listed ]]; then # it goes on
		cp "$keep/refine.tsv" "$work/refine.tsv"
	else
		printf 'step\tmember\tnumber\tfrom\tto\torder\tpredicted\terror\tseconds\n' >"$work/refine.tsv"
	fi
	while step=$(next_step); IFS=$'\t' read -r what base d x error seconds kb order method <<<"$step"; [ "$what" = step ]; do
		steps=$((steps + 1))
		left=$((budget - SECONDS + began_all))
		if awk -v t="$seconds" -v left="$left" 'BEGIN { exit !(t > left) }'; then
			tell "refine: ${choice_name[d]} $x would take about $seconds s, more than what is left of the budget, $left s (--budget 10min)"
			closed_methods+=$method,
			continue
		elif awk -v kb="$kb" '/^MemAvailable/ { found = kb > $2 } END { exit !found }' /proc/meminfo 2>/dev/null; then
			tell "refine: ${choice_name[d]} $x would need about $((kb / 1024)) MB, more than is free"
			closed_methods+=$method,
			continue
		fi
		values=()
		for m in "${!choice_name[@]}"; do values+=(-); done
		values[d]=$x
		note "refined"$'\t'"$base"$'\t'"${values[*]}"
		add_refined "$base" "${values[@]}"
		m=$((${#sentence[@]} - 1))
		prepare
		progress $((steps - 1)) "$steps" " (refine: ${sentence[m]})"
		visit "$m" 1
		rm -f "$work"/node.*
		held=()
		row=$(tsv | awk -F'\t' -v m=$((m + 1)) -v clock="$clock" '$1 == m {
			print ($2 == "failed" ? "failed\t" $NF : $5 "\t" (clock == "wall" ? $11 : $18)) }')
		[ ! -t 2 ] || printf '\r\033[K' >&2
		from=${chosen[base * ${#choice_name[@]} + d]} said="error ${row/$'\t'/, } s"
		[[ $row != failed* ]] || said="fails: ${row#*$'\t'}"
		tell "refine: ${choice_name[d]} $from -> $x (order $order): $said, predicted $error, $seconds s"
		printf '%d\t%d\t%s\t%s\t%s\t%s\t%s\t%s\n' "$steps" $((m + 1)) "${choice_name[d]}" "$from" "$x" "$order" "$error" "$row" >>"$work/refine.tsv"
	done
	if [ "$what" = met ]; then
		todo=("$base")
		prepare
		for ((round = 2; round <= (repeat > 3 ? repeat : 3); round++)); do began=$SECONDS; one_round; done
		tsv | awk -F'\t' -v m=$((base + 1)) -v clock="$clock" '$1 == m { printf "error %s, %s +- %s s", $5, (clock == "wall" ? $11 : $18),
			(clock == "wall" ? $12 : $19) }' >"$work/found"
		tell "refine: met after $steps steps: $(cat "$work/found")"
	else
		while IFS=$'\t' read -r what base error x; do
			[ "$what" = floor ] || continue
			tell "refine: floor: member $base stays at error $error: $x (another number or word sets it, or the reference: take a finer one)"
		done <<<"$step"
	fi
	[ -z "$keep" ] || cp "$work/refine.tsv" "$keep/refine.tsv"
}
