# shellcheck shell=bash
# A map of two parameters: stable or not on a grid of points, then the boundary: between two neighbours that differ it is bisected to
# 1/32 of their distance, or interpolated where the growth is known (modes), and the crossings are joined to lines cell by cell.
# Computed from the log, as in bisect.sh. SPDX-License-Identifier: GPL-3.0-or-later

# look_map WHAT: "ask MEMBER SEED X,Y" while trials are missing; then for WHAT points "MEMBER X Y OUTCOME STEP", for WHAT lines "MEMBER X1 Y1 X2 Y2".
look_map() {
	awk -F'\t' -v OFS='\t' -v what="$1" -v members=${#sentence[@]} -v w="$map_width" -v h="$map_height" -v x0="${axis_low[0]}" -v x1="${axis_high[0]}" -v \
		xs="${axis_scale[0]}" \
		-v y0="${axis_low[1]}" -v y1="${axis_high[1]}" -v ys="${axis_scale[1]}" '
	function text(x) { x = sprintf("%.10g", x); return x == "-0" ? "0" : x }
	function place(a, b, scale, i, n) { return text(scale == "log" ? a * (b / a) ^ (i / n) : a + (b - a) * i / n) }
	function asked(m, x, y) { if ((m, x "," y) in is) return 0; print "ask", m, 1, x "," y; return 1 }
	function growth(m, p, x, other,    g) { g = rate[m, p ? x "," other : other "," x]; return g > 50 ? 50 : g < -50 ? -50 : g }
	# The crossing on an edge where the growth per step is known (modes) and changes its sign: the line of exp(growth) through both ends, until its zero
	# moves by less than 1/64 of the edge. "no": it does not change its sign.
	function zero(m, a, b, other, p,    k, ga, gb, x, before, span) {
		if (!((m, p ? a "," other : other "," a) in rate) || !((m, p ? b "," other : other "," b) in rate)) return "no"
		ga = growth(m, p, a, other); gb = growth(m, p, b, other); span = b - a
		if (ga * gb >= 0 || ga * ga < 1e-6 || gb * gb < 1e-6) return "no"
		for (k = 0; k < 5; k++) {
			x = text(a + (b - a) * (1 - exp(ga)) / (exp(gb) - exp(ga)))
			if (k && (x - before) ^ 2 < (span / 64) ^ 2) break
			if (asked(m, p ? x : other, p ? other : x)) return "?"
			before = x
			if (ga * growth(m, p, x, other) > 0) { a = x; ga = growth(m, p, x, other) } else { b = x; gb = growth(m, p, x, other) }
		}
		return x }
	# The crossing on an edge, whose end points differ along one axis; at[] is "" if there is none, "?" if a trial was requested.
	function cross(m, a, b, other, along, scale,    k, mid, first, p) {
		p = along == "x"
		first = is[m, p ? a "," other : other "," a]
		if (first == is[m, p ? b "," other : other "," b]) return ""
		if ((mid = zero(m, a, b, other, p)) != "no") return mid
		for (k = 0; k < 5; k++) {
			mid = text(scale == "log" ? sqrt(a * b) : (a + b) / 2)
			if (asked(m, p ? mid : other, p ? other : mid)) return "?"
			if (is[m, p ? mid "," other : other "," mid] == first) a = mid; else b = mid
		}
		return text(scale == "log" ? sqrt(a * b) : (a + b) / 2) }
	$1 == "trial" { is[$2, $4] = $5; step[$2, $4] = $6; if ($7 ~ /^growth /) rate[$2, $4] = substr($7, 8) + 0 }
	END {
		for (i = 0; i < w; i++) X[i] = place(x0, x1, xs, i, w - 1)
		for (j = 0; j < h; j++) Y[j] = place(y0, y1, ys, j, h - 1)
		for (m = 0; m < members; m++) {
			missing = 0
			for (j = 0; j < h; j++) for (i = 0; i < w; i++) missing += asked(m, X[i], Y[j])
			if (missing) continue
			if (what == "points") {
				for (j = 0; j < h; j++) for (i = 0; i < w; i++)
					print m, X[i], Y[j], is[m, X[i] "," Y[j]], step[m, X[i] "," Y[j]]
				continue }
			for (j = 0; j < h; j++) for (i = 0; i + 1 < w; i++) H[i, j] = cross(m, X[i], X[i+1], Y[j], "x", xs)
			for (j = 0; j + 1 < h; j++) for (i = 0; i < w; i++) V[i, j] = cross(m, Y[j], Y[j+1], X[i], "y", ys)
			if (what != "lines") continue
			for (j = 0; j + 1 < h; j++) for (i = 0; i + 1 < w; i++) {
				n = 0
				if (H[i, j] != "") { n++; px[n] = H[i, j]; py[n] = Y[j] }
				if (V[i+1, j] != "") { n++; px[n] = X[i+1]; py[n] = V[i+1, j] }
				if (H[i, j+1] != "") { n++; px[n] = H[i, j+1]; py[n] = Y[j+1] }
				if (V[i, j] != "") { n++; px[n] = X[i]; py[n] = V[i, j] }
				for (k = 1; k < n; k += 2) print m, px[k], py[k], px[k+1], py[k+1]
			}
		}
	}' "$state/log"
}

search_map() {
	local lines
	while :; do
		mapfile -t lines < <(look_map refine | sed 's/^ask/trial/')
		[ ${#lines[@]} != 0 ] || break
		phase="map, ${#lines[@]} to do"
		batch "${lines[@]}"
	done
}

tsv_map() {
	local d
	for d in "${choice_shown[@]}"; do printf '%s\t' "${choice_name[d]}"; done
	printf '%s\t%s\toutcome\tstep\n' "${axis_name[0]}" "${axis_name[1]}"
	rows_of_members < <(look_map points)
}
tsv_boundary() {
	local d
	for d in "${choice_shown[@]}"; do printf '%s\t' "${choice_name[d]}"; done
	printf '%s\t%s\t%s_2\t%s_2\n' "${axis_name[0]}" "${axis_name[1]}" "${axis_name[0]}" "${axis_name[1]}"
	rows_of_members < <(look_map lines)
}
# Replaces the number of a member by its choices.
rows_of_members() {
	local m d rest
	while IFS=$'\t' read -r m rest; do
		for d in "${choice_shown[@]}"; do printf '%s\t' "${chosen[m * ${#choice_name[@]} + d]}"; done
		printf '%s\n' "$rest"
	done
}

# The map as text, the second axis upwards.
table_map() {
	local m
	printf 'o stable, . unstable: %sexit status 3; %s from %s to %s across, %s from %s to %s upwards\n' "${criterion:+$criterion, or }" \
		"${axis_name[0]}" "${axis_low[0]}" "${axis_high[0]}" "${axis_name[1]}" "${axis_low[1]}" "${axis_high[1]}"
	for m in "${!sentence[@]}"; do
		[ ${#sentence[@]} = 1 ] || name_of_member "$m"$'\n'
		[ ${#sentence[@]} = 1 ] || echo
		look_map points | awk -F'\t' -v m="$m" -v w="$map_width" '$1 == m { row[int(n / w)] = row[int(n / w)] ($4 == "stable" ? "o" : ".");
			n++ } END { for (j = int((n - 1) / w); j >= 0; j--) print row[j] }'
	done
}

# plot_map DIRECTORY: the boundary of each choice as a line; of a single one the stable points too.
plot_map() {
	local m options=()
	{
		printf '%s\t%s\tcase\n' "${axis_name[0]}" "${axis_name[1]}"
		for m in "${!sentence[@]}"; do
			look_map lines | NAME=$([ ${#sentence[@]} = 1 ] && echo boundary || name_of_member "$m") awk -F'\t' -v OFS='\t' -v m="$m" '
				BEGIN { name = ENVIRON["NAME"] } $1 == m { print $2, $3, name; print $4, $5, name; print "" }'
		done
		[ ${#sentence[@]} != 1 ] || look_map points | awk -F'\t' -v OFS='\t' '$4 == "stable" { print $2, $3, "stable" }'
	} >"$1/points.tsv"
	[ "${axis_scale[0]}" != log ] || options+=(--log-x)
	[ "${axis_scale[1]}" != log ] || options+=(--log-y)
	picture "$1" margin --x "${axis_name[0]}" "${axis_name[1]}" --by case --style lines --style-of stable=points "${options[@]}" \
		--x-range="${axis_low[0]},${axis_high[0]}" --y-range="${axis_low[1]},${axis_high[1]}" --title 'Where it is stable'
}
