# shellcheck shell=bash
# What a bracket does not tell of a limit, for the awk of bisect.sh: where the fitted growth vanishes, and whether the last bit of the input moves it.
# SPDX-License-Identifier: GPL-3.0-or-later

# by_growth(A, B): the limit from the growth per step that diag fits to three runs on the unstable side: at the end of the bracket, and two that grow 1.3 to
# 2.5 times as fast as the one before. A rate that is linear in the distance to the edge makes exp(growth) - 1 a line, one that goes with its root (a
# leapfrog) sinh(growth/2)^2: of both the one whose two zeros agree better. The uncertainty is their difference and half the bracket. The limit stands if the
# run on its stable side is stable four times as long; 1: it does, or a run was requested; 0: no limit can be told in this way.
# shellcheck disable=SC2034 # read by bisect.sh
by_growth='
	function linear(g) { return exp(size_of(g)) - 1 }
	function by_growth(a, b,    n, k, x, y, v, last, most, missing, i, z1, z2, d, l, best, width, check) {
		if (growth == "") return 0
		x[1] = from == "below" ? b : a; x[2] = x[3] = ""
		for (n = 2; n <= 3; n++) {
			if (step[M, S, x[n - 1]] !~ /^[0-9]+$/) return 0
			# of the bisection, the one next to it that is 1.3 times as fast; halfway to it while that is more than 2.5 times as fast
			last = step[M, S, x[n - 1]]; most = 0
			for (k = 1; k <= steps_of_path; k++)
				if (is[M, S, path[k]] == "unstable" && (i = step[M, S, path[k]]) ~ /^[0-9]+$/ && i <= last / 1.3 && i > most) {
					most = i; x[n] = path[k] }
			for (k = 0; most && most < last / 2.5 && k < 8; k++) {
				z1 = text((x[n - 1] + x[n]) / 2)
				if (!((M, S, z1) in is)) { print "ask", M, S, z1; return 1 }
				if (is[M, S, z1] == "stable" || step[M, S, z1] > last / 1.3) break
				most = step[M, S, z1]; x[n] = z1 }
			if (most < 8) return 0 # of fewer steps diag fits no rate
		}
		for (k = 1; k <= 3; k++) if (!((M, S, x[k]) in grew)) { print "grow", M, S, x[k], step[M, S, x[k]]; missing = 1 }
		if (missing) return 1
		for (k = 1; k <= 3; k++) {
			v[k] = size(fitted[M, S, x[k]])
			if (fitted[M, S, x[k]] !~ /[0-9]/ || v[k] <= (k > 1 ? v[k - 1] : 0) || fitted[M, S, x[k]] * fitted[M, S, x[1]] <= 0) return 0 }
		best = 1e300
		for (i = 0; i < 2; i++) {
			for (k = 1; k <= 3; k++) y[k] = i ? root(v[k]) : linear(v[k])
			z1 = x[1] - y[1] * (x[2] - x[1]) / (y[2] - y[1]); z2 = x[2] - y[2] * (x[3] - x[2]) / (y[3] - y[2])
			if (size(z1 - z2) < best) { best = size(z1 - z2); l = z1 } }
		d = best + (b - a) / 2
		width = size(l) > 0 && low * high > 0 ? size(l) : size(low) > size(high) ? size(low) : size(high)
		check = text(from == "below" ? l - d : l + d)
		if ((x[1] - l) * (from == "below" ? 1 : -1) < 0 || d > 0.05 * width || check < low + 0 || check > high + 0) return 0
		if (known(check, 4) == "") { print "ask", M, S, key(check, 4); return 1 }
		if (known(check, 4) != "stable") return 0
		final(l - d, l + d, a, b, sprintf("extrapolated: grows by %.3g a step at %.6g, %.3g at %.6g, %.3g at %.6g", v[1], x[1], v[2], x[2], v[3], x[3]))
		return 1 }'

# final(LOW, HIGH, A, B, HOW): the limit, unless runs whose input is moved in the last bit (perturb, two of them: VALUE~1, VALUE~2) decide otherwise at an end
# of the bracket A, B: then steps outwards, each twice as large, until both decide as the other runs do, are added to the uncertainty.
# shellcheck disable=SC2034 # read by bisect.sh
by_noise='
	# sure(X): do both decide at X as its side of the bracket does; -1 if a run was requested.
	function sure(x, want) {
		if (!((M, S, x "~1") in is)) { print "ask", M, S, x "~1"; return -1 }
		if (is[M, S, x "~1"] != want) return 0
		if (!((M, S, x "~2") in is)) { print "ask", M, S, x "~2"; return -1 }
		return is[M, S, x "~2"] == want }
	# The nearest value outside of the bracket (sign: on which side) that is sure; "" if a run was requested; "none" up to the end of the range.
	function outside(x, sign, d, want,    k, at, end, was) {
		end = sign < 0 ? low : high
		for (k = 0;; k++) {
			at = k ? text(x + sign * d * (2 ^ k - 1)) : x
			if ((at - end) * sign >= 0) at = end
			if ((was = sure(at, want)) < 0) return ""
			if (was) return at
			if (at == end) return "none" } }
	function final(l, h, a, b, how,    p, q, r, said) {
		if (!moved) { print "limit", M, S, l, h, how; return }
		p = outside(a, -1, b - a, from == "below" ? "stable" : "unstable")
		q = outside(b, 1, b - a, from == "below" ? "unstable" : "stable")
		if (p == "" || q == "") return
		if (p == a && q == b) { print "limit", M, S, l, h, how; return }
		said = "noise: runs that differ in the last bit of their input "
		if (p == "none" || q == "none") {
			print "none", M, S, said "decide otherwise up to the end of the range: rounding or chaos, and no limit"; return }
		l -= a - p; h += q - b; r = size(l + h) > 0 ? log(size(l + h) / (h - l)) / log(10) : 0
		print "limit", M, S, l, h, sprintf("%s%sdisagree between %s and %s: %.1f digits of the limit are known, and --tolerance %s is refused",
			how == "" ? "" : how "; ", said, p, q, r > 0 ? r : 0, tolerance) }'
