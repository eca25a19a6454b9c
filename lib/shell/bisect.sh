# shellcheck shell=bash
# Bisection computed from the log: each call repeats the bisection from the end points with the recorded trials, and requests the first one that is missing.
# So a stopped search can be continued, and a finer --tolerance starts where the coarser one ended. SPDX-License-Identifier: GPL-3.0-or-later

# look WHAT: prints, from $state/log, lines
#   ask MEMBER SEED VALUE            the trial to run next
#   limit MEMBER SEED LOW HIGH HOW   the final bracket; HOW: where it was in runs of each length, if it moved; how far the last bit of the input moves it
#   moves MEMBER SEED HOW            the limit moves with the length of the run, and has no value that it approaches
#   none MEMBER SEED WHY             no limit between the end points, and whether they are stable
# WHAT sample: instead "ask MEMBER SEED VALUE" and "grow MEMBER SEED VALUE STEPS" for a curve of growth on both sides of the first seed's limit.
look() {
	awk -F'\t' -v OFS='\t' -v what="$1" -v members=${#sentence[@]} -v seeds="$seeds" -v low="${axis_low[0]}" -v high="${axis_high[0]}" -v \
		scale="${axis_scale[0]}" \
		-v from="$from" -v tolerance="$tolerance" -v cycles="${cycles:-0}" -v steps="${steps:-}" -v growth="$growth" -v moved="${moved:-0}" \
		-v scan="${scan:-0}" \
		"$by_growth$by_noise"'
	function size(x) { return x < 0 ? -x : x }
	function text(x) { return sprintf("%.10g", x) }
	function between(a, b) { return text(scale == "log" ? sqrt(a * b) : (a + b) / 2) }
	# The next value to try between a and b: the middle, or a little beside the zero of the growth g per step where trials have one (modes). With decay at
	# one end the zero lies on the line of exp(g) through both; where the stable end is neutral, on that of sinh(g/2)^2 over two unstable values, which a
	# leapfrog makes linear in the square of the step. Every third time the middle, so that a wrong guess costs little.
	function size_of(g) { return g > 50 ? 50 : g < -50 ? -50 : g }
	function root(g) { g = size_of(g); return exp(g) + exp(-g) - 2 }
	function next_of(m, s, a, b, width, k,    x, good, bad, g, h, d) {
		good = from == "below" ? a : b; bad = from == "below" ? b : a
		if (k % 3 == 2 || !((m, s, good) in rate) || !((m, s, bad) in rate)) return between(a, b)
		g = size_of(rate[m, s, bad]); h = size_of(rate[m, s, good])
		if (h < -1e-3) x = bad - (exp(g) - 1) * (bad - good) / (exp(g) - exp(h))
		else if ((m, s, worse) in rate && rate[m, s, worse] > g) x = bad - root(g) * (worse - bad) / (root(rate[m, s, worse]) - root(g))
		else return between(a, b)
		d = 0.8 * tolerance * width
		if (d < 0.03 * (b - a)) d = 0.03 * (b - a)
		x += size(x - good) > size(bad - x) ? (good < bad ? -d : d) : (good < bad ? d : -d)
		return x > a + 0 && x < b + 0 ? text(x) : between(a, b) }
	# Value i of the scan, 0 .. scan, from the end of the range that is said to be stable.
	function scanned(i,    k) {
		k = from == "below" ? i : scan - i
		return k == 0 ? low : k == scan ? high : text(scale == "log" ? low * (high / low) ^ (k / scan) : low + (high - low) * k / scan) }
	function search(m, s,    a, b, good, mid, width, k, asked) {
		a = low; b = high; steps_of_path = 2
		if (!((m, s, a) in is)) print "ask", m, s, a
		if (!((m, s, b) in is)) print "ask", m, s, b
		if (!((m, s, a) in is) || !((m, s, b) in is)) return
		good = from == "below" ? "stable" : "unstable"
		# The first limit from the stable end: a gap of instability, or an island of stability beyond the limit, is not to be stepped over.
		if (is[m, s, scanned(0)] == "stable") {
			for (k = 1; k < scan; k++) if (!((m, s, scanned(k)) in is)) { print "ask", m, s, scanned(k); asked = 1 }
			if (asked) return
			for (k = 1; k < scan && is[m, s, scanned(k)] == "stable";) k++
			if (scan && is[m, s, scanned(k)] == "unstable") {
				a = scanned(k - (from == "below")); b = scanned(k - (from != "below"))
				while (++k <= scan && is[m, s, scanned(k)] == "unstable") path[++steps_of_path] = scanned(k) } }
		if (what == "sample" && is[m, s, a] == is[m, s, b]) { curve(m, s, 0); return }
		if (is[m, s, a] == is[m, s, b]) { print "none", m, s, is[m, s, a] " at both ends, " a " and " b; return }
		if (is[m, s, a] != good) {
			print "none", m, s, "stable at " (from == "below" ? b : a) " and unstable at " (from == "below" ? a : b) " (--from " \
				(from == "below" ? "above" : "below") ")"
			return }
		worse = ""; path[1] = a; path[2] = b
		for (k = 0;; k++) {
			mid = between(a, b)
			width = size(mid) > 0 && a * b > 0 ? size(mid) : size(a) > size(b) ? size(a) : size(b)
			if ((b - a) / 2 <= tolerance * width || mid == a || mid == b) break
			mid = next_of(m, s, a, b, width, k)
			if (!((m, s, mid) in is)) { print "ask", m, s, mid; print m, s, a, b >"/dev/fd/3"; return }
			path[++steps_of_path] = mid
			if (is[m, s, mid] == "unstable") worse = from == "below" ? b : a
			if (is[m, s, mid] == good) a = mid; else b = mid
		}
		if (what == "sample") curve(m, s, between(a, b) + 0); else again(m, s, a, b) }
	function key(x, f) { return f == 1 ? x : x "@" f }
	# The outcome at x in a run f times as long, "" if it is not known. What one cycle has reached it has reached in a longer run too.
	function known(x, f) {
		if ((M, S, key(x, f)) in is) return is[M, S, key(x, f)]
		return f > 1 && cycles == 1 ? (known(x, f / 2) == "unstable" ? "unstable" : "") : "" }
	# The bracket G, B in a run f times as long: good is no longer stable there. Steps away from bad, each twice as large, until it is stable,
	# then bisects to 1/16 of the shift. 1; 0 if a trial was requested; -1 if there is nothing stable in the range.
	function shifted(good, bad, f,    sign, d, end, x, k, was, before) {
		before = (good + bad) / 2; sign = good < bad ? -1 : 1; d = size(bad - good); end = sign < 0 ? low : high; B = good
		for (k = 1;; k++) {
			x = text(good + sign * d * (2 ^ k - 1))
			if ((x - end) * sign >= 0) x = end
			if ((was = known(x, f)) == "") { print "ask", M, S, key(x, f); return 0 }
			if (was == "stable") break
			if (x == end) return -1
			B = x }
		for (G = x;;) {
			x = text((G + B) / 2); d = size(before - x) / 16
			if (d < size(bad - good) / 2) d = size(bad - good) / 2
			if (size(B - G) / 2 <= d || x == G || x == B) return 1
			if ((was = known(x, f)) == "") { print "ask", M, S, key(x, f); return 0 }
			if (was == "stable") G = x; else B = x } }
	function run_of(f) { return steps != "" ? "in " steps * f (f == 1 ? " steps" : "") : f == 1 ? "in the run as given" : "in one " f " times as long" }
	# How fast the runs became unstable: the slowest, and each next one at least twice as fast.
	function slow(m, s,    k, one, most, x, last, n, t) {
		for (last = 1e300; n < 3; n++) {
			most = 0
			for (k in is) {
				split(k, one, SUBSEP)
				if (one[1] != m || one[2] != s || is[k] != "unstable" || one[3] ~ /[@~]/ || step[k] !~ /^[0-9]+$/ ||
					step[k] > last / 2) continue
				if (step[k] > most || (step[k] == most && one[3] + 0 < x + 0)) { most = step[k]; x = one[3] } }
			if (!most) break
			t = t (n ? ", " : "; unstable after ") most " steps at " x; last = most }
		return t }
	# The stable end a (or b) once more in a run twice as long. If it is unstable there, the limit is where the fitted growth vanishes; where that cannot be
	# told, it is found in runs of two and four times the length, and extrapolated: a rate of growth that is linear in the distance halves the distance
	# with each doubling, one that goes with its root quarters it.
	function again(m, s, a, b,    g, u, l1, l2, l4, h, ratio, rest, l, width, how, found) {
		M = m; S = s; g = from == "below" ? a : b; u = from == "below" ? b : a
		# A growth that is called neutral (modes) is there still: the limit is where the line through both ends has none.
		if (rate[m, s, g] > 1e-6 && rate[m, s, u] > rate[m, s, g]) {
			l = g - rate[m, s, g] * (u - g) / (rate[m, s, u] - rate[m, s, g]); h = (b - a) / 2
			print "limit", m, s, l - h, l + h, ""; return }
		if (!cycles) { final(a, b, a, b, ""); return }
		if (known(g, 2) == "") { print "ask", m, s, key(g, 2); return }
		if (known(g, 2) == "stable") { final(a, b, a, b, ""); return }
		if (by_growth(a, b)) return
		l1 = (a + b) / 2; how = sprintf("%.5g %s", l1, run_of(1))
		found = shifted(g, u, 2)
		if (!found) return
		if (found < 0) { print "moves", m, s, how ", unstable in the whole range " run_of(2) slow(m, s); return }
		l2 = (G + B) / 2; h = size(B - G) / 2; g = G; u = B; how = how sprintf(", %.5g %s", l2, run_of(2))
		if (known(g, 4) == "") { print "ask", m, s, key(g, 4); return }
		if (known(g, 4) == "stable") {
			# what a shift too small for this bracket may leave: as much again if it halves
			rest = size(l1 - l2) / 2; h += rest < 2 * h ? rest : 2 * h
			final(l2 - h, l2 + h, a, b, "settled: " how ", and so " run_of(4)); return }
		found = shifted(g, u, 4)
		if (!found) return
		if (found < 0) { print "moves", m, s, how ", unstable in the whole range " run_of(4) slow(m, s); return }
		l4 = (G + B) / 2; h += size(B - G) / 2; how = how sprintf(", %.5g %s", l4, run_of(4))
		ratio = size(l1 - l2) / size(l2 - l4)
		l = l4 - (l2 - l4) / ((ratio < 2 ? 2 : ratio > 4 ? 4 : ratio) - 1); rest = size(l4 - l) + h
		width = size(l) > 0 && low * high > 0 ? size(l) : size(low) > size(high) ? size(low) : size(high)
		if (ratio < 1.5 || rest > 0.05 * width || l < low + 0 || l > high + 0) print "moves", m, s, how slow(m, s)
		else final(l - rest, l + rest, a, b, "extrapolated: " how) }
	function point(m, s, x) {
		if (x < low + 0 || x > high + 0 || (x in had)) return
		had[x] = 1; x = text(x)
		if (!((m, s, x) in is)) print "ask", m, s, x
		else if ((m, s, x) in rate) return
		else if (!((m, s, x) in grew)) print "grow", m, s, x, step[m, s, x] }
	# Nine points over the range, and twelve close to the limit l.
	function curve(m, s, l,    i, near) {
		if (s != 1) return
		split("", had)
		for (i = 0; i <= 8; i++) point(m, s, scale == "log" ? low * (high / low) ^ (i / 8) : low + (high - low) * i / 8)
		split("0.01 0.03 0.06 0.1 0.2 0.35", near, " ")
		for (i = 1; i <= 6 && l != 0; i++) { point(m, s, l * (1 - near[i])); point(m, s, l * (1 + near[i])) } }
	$1 == "growth" { fitted[$2, $3, $4] = $5 }
	$1 == "trial" && $7 ~ /^growth / { rate[$2, $3, $4] = substr($7, 8) + 0 }
	{ if ($1 == "trial") { is[$2, $3, $4] = $5; step[$2, $3, $4] = $6 } else if ($1 == "growth") grew[$2, $3, $4] = 1 }
	END { for (m = 0; m < members; m++) for (s = 1; s <= seeds; s++) search(m, s) }' "$state/log" 3>"$work/brackets"
}

# Runs the requested trials until there are no more requests.
search() {
	local line lines asked=() a b
	while :; do
		mapfile -t lines < <(look "$1")
		asked=()
		for line in "${lines[@]}"; do
			case $line in
			ask*) asked+=("trial${line#ask}") ;;
			grow*) asked+=("growth${line#grow}") ;;
			esac
		done
		[ ${#asked[@]} != 0 ] || break
		IFS=$'\t' read -r _ _ a b <"$work/brackets" || true
		phase=
		[ -z "${b:-}" ] || phase="${axis_name[0]} between $a and $b"
		[ "$1" != sample ] || phase="growth on both sides"
		batch "${asked[@]}"
	done
}

# expected MEMBER: the value of --expect for this member, computed by awk; of a list name=number,name=number the one whose name is a choice of the member.
expected() {
	local e=${reference[$1]} one=() d arithmetic='^[A-Za-z0-9_.+*/^%() ,?:=!-]*$'
	if [[ $e =~ ^[[:space:]]*[A-Za-z0-9_.-]+[[:space:]]*=[^=] ]]; then
		IFS=, read -r -a one <<<"$e"
		e=
		for one in "${one[@]}"; do
			[[ $one == *=* ]] || usage "--expect: '$one' is not name=number"
			trim "${one%%=*}"
			for d in "${choice_shown[@]}"; do [ "$text" != "${chosen[$1 * ${#choice_name[@]} + d]}" ] || e=${one#*=}; done
		done
	fi
	[ -n "$e" ] || return 0
	# awk could write files and run programs, so only the characters of arithmetic are passed to it
	[[ $(sed 's/"[A-Za-z0-9_. -]*"//g' <<<"$e") =~ $arithmetic ]] || usage "--expect: '$e' has signs that are none of arithmetic"
	# awk reads unknown names as 0 and prints non-finite numbers as inf or nan
	one=$(! grep -oE '[0-9.]+([eE][-+]?[0-9]+)?|[A-Za-z_][A-Za-z_0-9]*' <<<"$(sed 's/"[^"]*"//g' <<<"$e")" | grep -E '^[A-Za-z_]' |
		grep -qvxE 'pi|sqrt|exp|log|sin|cos|atan2' &&
		awk 'BEGIN { pi = atan2(0, -1); printf "%.10g", ('"$e"') }' 2>/dev/null) && [[ $one =~ ^-?[0-9] ]] ||
		usage "--expect: '$e' is not a number (2, 2*sqrt(2), {name}^2/2, or rk2=2,rk4=2.785 for choices)"
	printf %s "$one"
}

# The result: a line per member. Uncertainty: half the bracket plus half the range over the seeds.
tsv() {
	local m d
	for m in "${!sentence[@]}"; do
		shown "${sentence[m]}"
		printf 'member\t%d\t%s\t%s\t' "$m" "$(expected "$m")" "$text"
		for d in "${choice_shown[@]}"; do printf '\t%s' "${chosen[m * ${#choice_name[@]} + d]}"; done
		echo
	done >"$work/members"
	look limits | awk -F'\t' -v OFS='\t' -v names="$(for d in "${choice_shown[@]}"; do printf '%s\t' "${choice_name[d]}"
	done)" -v from="$from" -v axis="${axis_name[0]}" '
	function median(v, n,    i, j, t) {
		for (i = 2; i <= n; i++) for (j = i; j > 1 && v[j] < v[j-1]; j--) { t = v[j]; v[j] = v[j-1]; v[j-1] = t }
		return n % 2 ? v[(n+1)/2] : (v[n/2] + v[n/2+1]) / 2 }
	# Rounded up to two digits: an uncertainty must not be rounded down.
	function up(x,    e, k) {
		if (x <= 0) return 0
		e = 10 ^ (int(log(x) / log(10) + 100) - 101); k = int(x / e); if (k < x / e * (1 - 1e-12)) k++
		return sprintf("%.3g", k * e) }
	FILENAME != "-" && $1 == "member" {
		want[$2] = $3; sentence[$2] = $4; rest[$2] = ""; for (i = 6; i <= NF; i++) rest[$2] = rest[$2] $i OFS
		count++; next }
	FILENAME != "-" { if ($1 == "trial") { k = ++runs[$2]; seed[$2, k] = $3; at[$2, k] = $4; was[$2, k] = $5
		if ($5 == "stable" && $7 ~ /^growth / && substr($7, 8) + 0 > 1e-6) neutral[$2, k] = 1 } next }
	$1 == "limit" {
		n[$2]++; low[$2, n[$2]] = $4; high[$2, n[$2]] = $5; mid[$2, n[$2]] = ($4 + $5) / 2
		if (($5 - $4) / 2 > half[$2]) half[$2] = ($5 - $4) / 2 }
	$1 == "limit" && $6 != "" { moved[$2] = $6; status[$2] = $6 ~ /noise: / ? "noise" : $6 ~ /^settled/ ? "settled" : "extrapolated" }
	$1 == "moves" { why[$2] = "no edge: the limit moves: " $4; status[$2] = "moves" }
	$1 == "none" { why[$2] = $4 }
	# Trials on the wrong side of the first seed'"'"'s bracket: there is more than one limit.
	function astray(m,    k, below, first, last, x) {
		first = last = ""
		for (k = 1; k <= runs[m]; k++) if (seed[m, k] == 1 && at[m, k] !~ /[@~]/ && !((m, k) in neutral)) {
			x = at[m, k] + 0; below = x <= low[m, 1]
			if (was[m, k] == ((below == (from == "below")) ? "stable" : "unstable")) continue
			if (was[m, k] == "unstable") return "unstable again at " at[m, k] ": there is more than one limit"
			if (first == "" || x < first + 0) first = at[m, k]
			if (last == "" || x > last + 0) last = at[m, k] }
		if (first == "") return ""
		first = "stable again " (first == last ? "at " first : "between " first " and " last)
		return first ": there is more than one limit, and this is the first from " from }
	END {
		print "member", names "parameter", "limit", "uncertainty", "half_bracket", "spread", "expected", "ratio", "agrees", "stable", "seeds", \
			"runs", "sentence", "status", "reason"
		for (m = 0; m < count; m++) {
			row = m + 1 OFS rest[m] axis
			if (why[m] != "" || !n[m]) row = row OFS "-" OFS "-" OFS "-" OFS "-" OFS (want[m] == "" ? "-" : want[m]) OFS "-" OFS "-"
			else {
				for (i = 1; i <= n[m]; i++) v[i] = mid[m, i]
				l = median(v, n[m]); s = (v[n[m]] - v[1]) / 2; u = half[m] + s; d = l - want[m]; if (d < 0) d = -d
				row = row OFS sprintf("%.8g", l) OFS up(u) OFS up(half[m]) OFS (n[m] > 1 ? sprintf("%.2g", s) : "-")
				row = row OFS (want[m] == "" ? "-" : want[m]) OFS (want[m] + 0 == 0 ? "-" : sprintf("%.6g", l / want[m]))
				row = row OFS (want[m] == "" ? "-" : d <= u * (1 + 1e-9) ? "yes" : "no")
			}
			if (why[m] == "" && n[m]) why[m] = moved[m] != "" ? moved[m] : astray(m)
			if (status[m] == "") status[m] = n[m] ? "limit" : "none"
			print row, from, n[m] + 0, runs[m] + 0, sentence[m], status[m], why[m] == "" ? "-" : why[m]
		}
	}' "$work/members" "$state/log" -
}
