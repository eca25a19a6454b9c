# shellcheck shell=bash
# The table of all members of a sweep from its log: errors, times with the interval that noise leaves them, and the Pareto front.
# The time of a member in a round is the sum over its words; its result is the median over the rounds. The interval [low, high] are the order statistics
# between which the true median lies with at least 90 % (5 rounds: the whole range, 94 %; 3 rounds: 75 %); the spread is half of it. A member is beaten
# only by one whose interval lies below its own: whatever may be noise is a tie, and both are on the front. So the order of the braces changes nothing.
# SPDX-License-Identifier: GPL-3.0-or-later

# members: prints a line per member: number, path (- if it is not run), chosen..., sentence.
members() {
	local m d
	for m in "${!sentence[@]}"; do
		printf '%d\t%s' "$m" "${path[m]:--}"
		for d in "${!choice_name[@]}"; do printf '\t%s' "${chosen[m * ${#choice_name[@]} + d]}"; done
		printf '\t%s\n' "${sentence[m]}"
	done
}

# Least squares of y = a + b x for awk: straight(n, x, y) sets fit_a, fit_b, fit_error (standard error of b, - for two points); fit_at(x) is the value there,
# fit_sigma(x) its standard error. shellcheck reads it as text.
straight_line='
	function straight(n, x, y,    i, d) {
		fit_n = n; fit_mean = fit_my = fit_xx = fit_b = fit_s2 = 0
		for (i = 1; i <= n; i++) { fit_mean += x[i] / n; fit_my += y[i] / n }
		for (i = 1; i <= n; i++) { fit_xx += (x[i] - fit_mean) ^ 2; fit_b += (x[i] - fit_mean) * y[i] }
		if (n < 2 || fit_xx == 0) return 0
		fit_b /= fit_xx; fit_a = fit_my - fit_b * fit_mean
		for (i = 1; i <= n; i++) { d = y[i] - fit_a - fit_b * x[i]; fit_s2 += d * d }
		fit_s2 = n > 2 ? fit_s2 / (n - 2) : 0
		fit_error = n > 2 ? sqrt(fit_s2 / fit_xx) : "-"
		return 1 }
	function fit_at(x) { return fit_a + fit_b * x }
	function fit_variance(x) { return fit_s2 * (1 / fit_n + (x - fit_mean) ^ 2 / fit_xx) }'

# tsv: the table, fronts first by size. A member that was not run (--extrapolate) is continued along the power laws of its method.
tsv() {
	local names d
	names=$(for d in "${choice_name[@]}"; do printf '%s\t' "$d"; done)
	members | NAMES=$names LOG=$state/log REFERENCES="${reference_members[*]}" awk -F'\t' -v norm="$norm" -v clock="$clock" -v axes="$axes" \
		-v choices=${#choice_name[@]} -v size="$size_choice" "$straight_line"'
	function sort_up(v, n,    i, j, t) { for (i = 2; i <= n; i++) for (j = i; j > 1 && v[j] < v[j-1]; j--) { t = v[j]; v[j] = v[j-1]; v[j-1] = t } }
	function middle(v, n) { return n % 2 ? v[(n+1)/2] : (v[n/2] + v[n/2+1]) / 2 }
	# The largest rank k such that fewer than k of n values lie below the median with a probability of at most 5 %; else 1.
	function rank(n,    k, p, c) {
		p = c = 0.5 ^ n
		for (k = 1; 2 * k < n && p <= 0.05; k++) { c *= (n - k + 1) / k; p += c }
		return k > 1 && p > 0.05 ? k - 1 : k }
	# A NaN or infinite error ranks below every finite one.
	function finite(x) { return x ~ /[0-9]/ && x !~ /[nN][aA][nN]|[iI][nN][fF]/ }
	# Does a surely beat b: nowhere worse, somewhere better? One megabyte or one per cent of memory is no difference.
	function beats(a, b,    better) {
		if (!stands[a] || group[a] != group[b]) return 0
		better = 0
		if (axes ~ /error/) {
			if (!finite(e[a]) || (finite(e[b]) && e[a] + 0 > e[b] + 0)) return 0
			better += !finite(e[b]) || e[a] + 0 < e[b] + 0 }
		if (axes ~ /time/) { if (high[a, clock] > low[b, clock]) return 0; better += high[a, clock] < low[b, clock] }
		if (axes ~ /memory/) {
			if (mem[a] > mem[b] + slack(mem[b])) return 0
			better += mem[a] + slack(mem[a]) < mem[b] }
		return better > 0 }
	function slack(kb) { return kb < 102400 ? 1024 : kb / 100 }
	# Are a and b apart by no more than noise, a at least as accurate and no larger?
	function ties(a, b) {
		return a != b && stands[a] && group[a] == group[b] && axes ~ /time/ && low[a, clock] <= high[b, clock] && low[b, clock] <= high[a, clock] &&
			(axes !~ /error/ || (finite(e[a]) && e[a] + 0 <= e[b] + 0)) && (axes !~ /memory/ || mem[a] <= mem[b] + slack(mem[b])) }
	# What is left of a member when its size is taken away.
	function method(m,    i, s) { s = ""; split(tail[m], f, "\t"); for (i = 1; i <= choices; i++) if (i != size) s = s "\t" f[i]; return s }
	# continued(m, what): exp of the power law of the method of m at its size; sets sigma, the standard error of the logarithm.
	function continued(m, what,    i, n, y, x, v, none) {
		n = none = 0
		for (i = 1; i <= NR; i++) {
			if (status[i] == "failed" || status[i] == "extrapolated" || key[i] != key[m]) continue
			v = what == "error" ? e[i] : what == "memory" ? mem[i] : mid[i, what]
			if (finite(v) && v == 0) none++
			if (finite(v) && v > 0) { x[++n] = log(group[i]); y[n] = log(v) } }
		sigma = 0
		if (!n && none) return 0
		if (n < 3 || !straight(n, x, y)) return "-"
		sigma = sqrt(fit_variance(log(group[m])) + fit_s2)
		return exp(fit_at(log(group[m]))) }
	BEGIN {
		OFS = "\t"
		split("n l1 l2 max relative_l2 relative_max", name, " ")
		for (i = 1; i <= 6; i++) if (name[i] == norm) pick = i
		n = split(ENVIRON["REFERENCES"], c, " "); for (i = 1; i <= n; i++) refers[c[i]] = 1
		most = 0
		while ((getline line < ENVIRON["LOG"]) > 0) {
			split(line, c, "\t")
			if (c[1] == "time") { up[c[2], c[3]] = c[4]; work[c[2], c[3]] = c[5]; if (c[6] > kb[c[2]]) kb[c[2]] = c[6]
				cpu[c[2], c[3]] = c[7] == "" ? c[5] : c[7]; if (c[3] > most) most = c[3] + 0 }
			else if (c[1] == "fail") dead[c[2]] = c[3]
			else if (c[1] == "bad") bad[c[2]] = c[3]
			else if (c[1] == "error") { for (i = 1; i <= 6; i++) norms[c[2], i] = c[i+2]; known[c[2]] = 1 }
		}
	}
	{
		m = NR; id[m] = $1; k = split($2, p, " "); n = 0; mem[m] = 0; why[m] = ""
		for (i = 1; i <= k; i++) { if (p[i] in dead) why[m] = dead[p[i]]; if (kb[p[i]] > mem[m] * 1) mem[m] = kb[p[i]] }
		if ($1 in bad) why[m] = bad[$1]
		for (r = 1; r <= most; r++) {
			s = u = z = 0; whole = k > 0
			for (i = 1; i <= k; i++) { if (!((p[i], r) in work)) { whole = 0; break } s += work[p[i], r]; u += up[p[i], r]; z += cpu[p[i], r] }
			if (whole) { n++; all[n] = s; ups[n] = u; cpus[n] = z }
		}
		rounds[m] = n; setup[m] = mid[m, "wall"] = mid[m, "processor"] = "-"
		if (n) {
			sort_up(all, n); sort_up(ups, n); sort_up(cpus, n); k = rank(n); setup[m] = middle(ups, n)
			mid[m, "wall"] = middle(all, n); low[m, "wall"] = all[k]; high[m, "wall"] = all[n + 1 - k]; least[m, "wall"] = all[1]
			mid[m, "processor"] = middle(cpus, n); low[m, "processor"] = cpus[k]; high[m, "processor"] = cpus[n + 1 - k]
			least[m, "processor"] = cpus[1]
		}
		if (why[m] == "" && !($1 in known)) why[m] = "not measured"
		e[m] = norms[$1, pick]
		status[m] = $2 == "-" ? "extrapolated" : why[m] != "" ? "failed" : $1 in refers ? "reference" : "ok"
		tail[m] = $3; for (i = 4; i <= NF; i++) tail[m] = tail[m] OFS $i
		group[m] = size ? $(2 + size) : 0
	}
	function extrapolate(m,    i, c, t) {
		why[m] = ""; e[m] = continued(m, "error"); for (i = 2; i <= 6; i++) norms[id[m], i] = i == pick ? e[m] : "-"
		t = continued(m, "memory"); mem[m] = t == "-" ? 0 : t
		for (i = 1; i <= 2; i++) { c = i == 1 ? "wall" : "processor"; t = continued(m, c); mid[m, c] = t
			if (t != "-") { low[m, c] = t * exp(-2 * sigma); high[m, c] = t * exp(2 * sigma); least[m, c] = "-" } }
		if (e[m] == "-" || mid[m, clock] == "-") { status[m] = "failed"; why[m] = "no power law of three sizes to extrapolate" } }
	function half(m, c) { return sprintf("%.2g", (high[m, c] - low[m, c]) / 2) }
	function digits(x) { return x == "-" ? x : sprintf("%.6g", x) }
	END {
		print "member", "status", "front", "dominated_by", "error", "l1", "l2", "max", "relative_l2", "relative_max", "seconds", "spread", "setup",
			"memory_mb", "ties", "rounds", "seconds_min", "processor", "processor_spread", "processor_min", ENVIRON["NAMES"] "sentence", "reason"
		for (m = 1; m <= NR; m++) key[m] = method(m)
		for (m = 1; m <= NR; m++) if (status[m] == "extrapolated") extrapolate(m)
		for (m = 1; m <= NR; m++) stands[m] = (status[m] == "ok" || status[m] == "extrapolated") && mid[m, clock] != "-"
		for (m = 1; m <= NR; m++) {
			front = "-"; by = "-"; tie = ""
			if (stands[m]) {
				# Of the members that beat m, the one with the smallest product of error and seconds is named.
				best = 0
				for (b = 1; b <= NR; b++) if (b != m && beats(b, m) && (!best || e[b] * mid[b, clock] < e[best] * mid[best, clock])) best = b
				front = best ? "no" : "yes"; if (best) by = id[best] + 1
				if (!best) for (b = 1; b <= NR; b++) if (ties(b, m)) tie = tie (tie == "" ? "" : ",") id[b] + 1
			}
			row = id[m] + 1 OFS status[m] OFS front OFS by OFS (why[m] == "" ? (status[m] == "extrapolated" ? digits(e[m]) : e[m]) : "-")
			for (i = 2; i <= 6; i++) row = row OFS (why[m] == "" ? norms[id[m], i] : "-")
			timed = mid[m, "wall"] != "-"
			print row, digits(mid[m, "wall"]), timed ? half(m, "wall") : "-", setup[m] == "-" ? "-" : sprintf("%.3g", setup[m]),
				(mem[m] > 0 ? sprintf("%.1f", mem[m] / 1024) : "-"), tie == "" ? "-" : tie, rounds[m], timed ? digits(least[m, "wall"]) : "-",
				digits(mid[m, "processor"]), timed ? half(m, "processor") : "-", timed ? digits(least[m, "processor"]) : "-", tail[m],
				why[m] == "" ? "-" : why[m]
		}
	}' | {
		IFS= read -r d
		printf '%s\n' "$d"
		awk -F'\t' -v OFS='\t' -v clock="$clock" -v size="$size_choice" '{ t = $(clock == "wall" ? 11 : 18)
			print $2 == "failed", size ? $(20 + size) : 0, t == "-" ? 0 : t, $5 == "-" ? 0 : $5, $0 }' |
			sort -t $'\t' -s -k1,1n -k2,2g -k3,3g -k4,4g | cut -f5-
	}
}
