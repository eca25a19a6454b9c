# shellcheck shell=bash
# Times and sizes as pareto's options give them, and what a sweep over sizes (--size) says: power laws by least squares of the logarithms with standard
# errors, and the size at which two methods take the same time. SPDX-License-Identifier: GPL-3.0-or-later

# seconds_of OPTION TIME
seconds_of() {
	[[ $2 =~ ^([0-9]*\.?[0-9]+([eE][-+]?[0-9]+)?)(us|ms|s|min|h|)$ ]] || usage "option '--$1': '$2' is not a time (2s, 50ms, 1.5min)"
	awk -v x="${BASH_REMATCH[1]}" -v u="${BASH_REMATCH[3]}" 'BEGIN {
		print x * (u == "us" ? 1e-6 : u == "ms" ? 1e-3 : u == "min" ? 60 : u == "h" ? 3600 : 1) }'
}

# settle_times: the options of timing and of the criteria. fixed: exactly --repeat rounds.
settle_times() {
	local a n=0
	clock=${opt_time:-wall} spread=${opt_spread:-0.05} axes=${opt_axes:-error,time} fixed=
	budget=$(seconds_of budget "${opt_budget:-20s}") || exit 2
	budget=${budget%.*}
	[[ -z ${opt_repeat:-} || -n ${opt_spread:-}${opt_budget:-} ]] || fixed=1
	for a in ${axes//,/ }; do
		[[ $a == error || $a == time || $a == memory ]] || usage "option '--axes': '$a' is none of error, time, memory"
		n=$((n + 1))
	done
	[ $n -ge 2 ] || usage "--axes wants two or three of error, time, memory"
	[[ $axes != *memory* || -n $time_program ]] ||
		fail 1 "no program 'time' here, which measures memory (apt-get install time, or leave memory out of --axes)"
	[[ -z ${opt_jobs:-} || -z ${opt_axes:-}${opt_time:-}${opt_spread:-}${opt_budget:-}${opt_extrapolate:-} ]] ||
		usage "--jobs measures errors alone (leave it out for --axes, --time, --spread, --budget, --extrapolate)"
	[[ -z ${opt_refine:-} || -n ${opt_until_error:-} ]] || usage "--refine wants --until-error: how small shall the error be?"
	[[ -z ${opt_refine:-} || -z ${opt_size:-}${opt_jobs:-} ]] || usage "--refine goes neither with --size nor with --jobs (leave it out)"
	[[ -z ${opt_refine:-} || $against != finest ]] ||
		usage "--refine wants a reference that stays finer than what is refined, which finest does not (--against with a sentence, a file or exact)"
	[[ -z ${opt_extrapolate:-} || -n ${opt_size:-} ]] || usage "--extrapolate wants --size NAME: which of the names of --vary is the size?"
}

# sized: the size that is not run joins the values of --size.
sized() {
	local i
	[ -n "${opt_size:-}" ] || return 0
	for i in "${!varied[@]}"; do
		[[ ${varied[i]} == "$opt_size="* ]] || continue
		[[ -z ${opt_extrapolate:-} || ,${varied[i]#*=}, != *",$opt_extrapolate,"* ]] ||
			usage "--extrapolate: $opt_extrapolate is one of the sizes that are run (leave it out of one of them)"
		varied[i]+=${opt_extrapolate:+,$opt_extrapolate}
		return
	done
	usage "--size $opt_size is no name of --vary (--vary $opt_size=1000,10000,100000)"
}

# find_size: size_choice is the number of the choice that is the size, from 1; empty without.
find_size() {
	local d m
	size_choice=
	for d in "${!linked[@]}"; do [ "${vary_name[d]}" != "${opt_size:-}" ] || size_choice=$((linked[d] + 1)); done
	[ -n "$size_choice" ] || return 0
	for m in "${!sentence[@]}"; do
		d=${chosen[m * ${#choice_name[@]} + size_choice - 1]}
		[[ $d =~ ^[+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$ && $d =~ ^[^eE]*[1-9] ]] || usage "--size $opt_size: '$d' is not a number above 0"
	done
}

# laws TSV: the power laws of every method and the crossovers.
laws() {
	awk -F'\t' -v choices=${#choice_name[@]} -v size="$size_choice" -v clock="$clock" "$straight_line"'
	function law(what,    s) { s = sprintf("^%.2f", fit_b); return what " ~ " name s (fit_error == "-" ? " (two sizes)" : sprintf(" +- %.2g", fit_error)) }
	NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; first = at["sentence"] - choices - 1; name = $(first + size)
		column["time"] = at[clock == "wall" ? "seconds" : "processor"]; column["error"] = 5; column["memory"] = at["memory_mb"]; next }
	$2 == "ok" || $2 == "reference" {
		k = ""; for (i = 1; i <= choices; i++) if (i != size) k = k (k == "" ? "" : " ") ($(first + i) == "" ? "(none)" : $(first + i))
		if (k == "") k = "the sentence"
		if (!(k in seen)) { seen[k] = ++methods; label[methods] = k }
		if ($3 == "yes") front[k] = 1
		if (low == "" || $(first + size) < low) low = $(first + size) + 0
		if ($(first + size) > high) high = $(first + size) + 0
		for (q in column) { v = $(column[q]); if (v ~ /[0-9]/ && v !~ /inf|nan/ && v > 0) { n[k, q]++; x[k, q, n[k, q]] = log($(first + size)); y[k, q,
			n[k, q]] = log(v) } } }
	function fit(k, q,    i, u, v) { for (i = 1; i <= n[k, q]; i++) { u[i] = x[k, q, i]; v[i] = y[k, q, i] } return straight(n[k, q] + 0, u, v) }
	END {
		print "power laws in " name " (" clock " time, error, memory) with standard errors; a crossover within one standard error:"
		for (m = 1; m <= methods; m++) {
			k = label[m]; s = ""
			for (i = 1; i <= 3; i++) { q = i == 1 ? "time" : i == 2 ? "error" : "memory"; if (fit(k, q)) s = s (s == "" ? "" : ", ") law(q) }
			print "  " k ": " (s == "" ? "one size alone" : s)
		}
		for (m = 1; m <= methods; m++) for (l = m + 1; l <= methods; l++) {
			if (methods > 6 && !((label[m] in front) && (label[l] in front))) continue
			if (n[label[m], "time"] < 3 || n[label[l], "time"] < 3) continue
			fit(label[m], "time"); a = fit_a; b = fit_b; e = fit_error; na = fit_n; ma = fit_mean; xa = fit_xx; sa = fit_s2
			fit(label[l], "time")
			if ((b - fit_b) ^ 2 <= 4 * (e ^ 2 + fit_error ^ 2) || b == fit_b) {
				printf "  no crossover: %s and %s have the same exponent within its error\n", label[m], label[l]; continue }
			at_x = (fit_a - a) / (b - fit_b)
			# The errors of both lines at the crossing, over the difference of their slopes.
			s = sqrt(sa * (1 / na + (at_x - ma) ^ 2 / xa) + fit_variance(at_x)) / (b > fit_b ? b - fit_b : fit_b - b)
			where = at_x < log(low) - 1e-9 || at_x > log(high) + 1e-9 ? ", extrapolated" : ""
			if (at_x > 100 || at_x < -100 || s > 5) { printf "  no crossover within reach: %s and %s\n", label[m], label[l]; continue }
			steep = b > fit_b ? m : l
			printf "  crossover at %s = %.3g (%.3g to %.3g%s): %s is the faster one below, %s above\n", name, exp(at_x), exp(at_x - s),
				exp(at_x + s), where, label[steep], label[m + l - steep]
		}
	}' "$1"
}
