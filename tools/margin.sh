#!/usr/bin/env bash
# margin: how far a run is from the edge. A number in a sentence is bisected until the value is closed in at which the run stops being stable; two numbers make
# a map. A run is unstable if a criterion on diag's columns becomes true (cycle --until) or a word exits 3. A script, because it only starts programs and
# waits for them. The Makefile inserts the files it reads from lib/shell/ into bin/margin.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
export LC_ALL=C
me=margin
version=@VERSION@
# shellcheck source=lib/shell/help.sh
. lib/shell/help.sh
# shellcheck source=lib/shell/braces.sh
. lib/shell/braces.sh
# shellcheck source=lib/shell/run.sh
. lib/shell/run.sh
# shellcheck source=lib/shell/page.sh
. lib/shell/page.sh
# shellcheck source=lib/shell/trials.sh
. lib/shell/trials.sh
# shellcheck source=lib/shell/longer.sh
. lib/shell/longer.sh
# shellcheck source=lib/shell/limit-of.sh
. lib/shell/limit-of.sh
# shellcheck source=lib/shell/bisect.sh
. lib/shell/bisect.sh
# shellcheck source=lib/shell/json.sh
. lib/shell/json.sh
# shellcheck source=lib/shell/limits.sh
. lib/shell/limits.sh
# shellcheck source=lib/shell/map.sh
. lib/shell/map.sh
# shellcheck source=lib/shell/edge-report.sh
. lib/shell/edge-report.sh

summary="how far a run is from the edge: the value of a number at which it stops being stable"
kind="runs sentences and writes text"
arguments=SENTENCE
arguments_text="Words joined by |, in quotes, that leave a stream; {name} stands for the numbers and choices of --vary, {seed} for a seed."
about="--vary dt:0.1:4 is tried at 17 values (--scan), and bisected at the first limit from the stable end; if there is none, or more beyond it, the table says
so. --vary scheme=rk2,rk4, or braces {rk2,rk4} in the sentence, give a row for each choice. A run is unstable when --unstable-when, an expression over the
columns of diag (energy > 10*energy0; NAME0 is the value at the beginning), comes true after a full step of any cycle of the sentence, or when a word exits 3
(not finite, not converged). Any other failure ends the search with its message. The stable end of the bracket is run twice as long; where it is no longer
stable, the limit moves: it is extrapolated from longer runs, or there is no edge, and the table says so. With {seed} in the sentence every limit is found for
--seeds seeds. Two ranges make a map of --map points, with the boundary refined.

With -o DIRECTORY: margin.tsv, margin.json, a picture margin.svg and .png (splot: growth per step on both sides of the limit, or the map) and index.html,
a page of one file whose table sorts; the results are kept there, and the same command continues a search that was stopped."
rows="|vary|TEXT||name:low:high is bisected (in the logarithm where high is more than 10 times low); name=value,value,... gives a row for each; \
may be given several times
u|unstable-when|EXPRESSION||over the columns of diag, put into every cycle as --until; without it only exit status 3 counts
e|expect|EXPRESSION||the theoretical limit: a number, arithmetic with sqrt, pi and the {name} of choices, or rk2=2,rk4=2.785 for each choice
|from|WORD|below above|the side of the limit that is stable (default below)
|scan|N||divide the range by N and begin at the first limit from the stable end (default 16, 64 with modes; 0: bisect between the ends)
|tolerance|X||bisect until half the bracket, relative to the limit, is at most X (default 1e-3)
|given-length|||the limit within runs as long as given: none is repeated twice as long
|seeds|N||how many seeds {seed} stands for: 1, 2, ... (default 3)
|column|NAME||the column of diag whose growth is drawn (default: the first name of --unstable-when)
|map|SIZE||points across and up of a map (default 24x16)
o|output|DIRECTORY||write the results there, and continue from earlier ones
j|jobs|N||runs at a time (default 1)
|format|WORD|table tsv json|what is printed (default table)
|list|||print the sentences, and run nothing
|fresh|||discard earlier results in the directory of -o
|threads|N||threads of every word (OMP_NUM_THREADS)"
examples="The step at which a leapfrog on a spring leaves the orbit; 2 in theory|\
margin 'printf \"x vx\\n1 0\\n\" | stab - --law free | cycle -n 100 \"push --dt {dt} kick/2 drift | field acc=-x | push kick/2\"' \
--vary dt:0.5:4 --expect 2 --unstable-when 'distance_max > 100' --tolerance 0.01
Two schemes on the imaginary axis, each with its own limit|\
margin 'printf \"x y\n1 0\n\" | stab - --law free --dt 1 | cycle -n 99 \"field vel=-{w}*y,{w}*x | push {scheme}\"' --vary w:1:4 \
--vary scheme=lsrk3,rk4 --expect 'lsrk3=sqrt(3),rk4=2*sqrt(2)' --unstable-when 'distance_max > 2' --tolerance 0.02"

# A name that is no function, as abs( is.
column_name='(^|[^A-Za-z0-9_.])([A-Za-z_][A-Za-z0-9_.]*)[[:space:]]*([^A-Za-z0-9_.([:space:]]|$)'
number='[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?'

# Separates the ranges from the choices.
axes() {
	local v
	axis_name=() axis_low=() axis_high=() axis_scale=() choices=()
	for v in "${varied[@]}"; do
		if [[ $v =~ ^([A-Za-z_][A-Za-z0-9_-]*):($number):($number)$ ]]; then
			axis_name+=("${BASH_REMATCH[1]}") axis_low+=("${BASH_REMATCH[2]}") axis_high+=("${BASH_REMATCH[5]}")
			axis_scale+=("$(awk -v a="${BASH_REMATCH[2]}" -v b="${BASH_REMATCH[5]}" 'BEGIN { print (a >= b ? "wrong" : a > 0 &&
				b > 10 * a ? "log" : "linear") }')")
			[ "${axis_scale[-1]}" != wrong ] || usage "--vary '$v': the first number is not below the second"
		elif [[ $v == *=* ]]; then
			choices+=("$v")
		else
			usage "--vary wants name:low:high or name=value,value,..., not '$v'"
		fi
	done
	[ ${#axis_name[@]} != 0 ] || usage "--vary is missing: which number is searched for? (--vary dt:0.1:4)"
	[[ ${#axis_name[@]} != 2 || ${axis_name[0]} != "${axis_name[1]}" ]] || usage "--vary ${axis_name[0]} has two ranges"
	[ ${#axis_name[@]} -le 2 ] || usage "one range is bisected and two make a map; here are ${#axis_name[@]}"
}

settle() {
	read_options "$@"
	[ ${#positional[@]} != 0 ] || usage "SENTENCE is missing ($arguments_text)"
	[ ${#positional[@]} = 1 ] || usage "one SENTENCE, in quotes, not ${#positional[@]} arguments"
	criterion=${opt_unstable_when:-} from=${opt_from:-below} tolerance=${opt_tolerance:-1e-3} jobs=${opt_jobs:-1} \
		format=${opt_format:-table} growth=${opt_column:-} scan=${opt_scan:-16}
	keep_directory
	axes
	map_width=24 map_height=16 seeds=1 has_seed=
	if [ -n "${opt_map:-}" ]; then
		[ ${#axis_name[@]} = 2 ] || usage "--map wants two ranges (--vary x:0:1 --vary y:0:1)"
		[[ $opt_map =~ ^([0-9]{1,4})x([0-9]{1,4})$ && ${BASH_REMATCH[1]} -ge 2 && ${BASH_REMATCH[2]} -ge 2 ]] ||
			usage "--map '$opt_map' is not a size of at least 2x2 (40x30)"
		map_width=${BASH_REMATCH[1]} map_height=${BASH_REMATCH[2]}
	fi
	[[ ${#axis_name[@]} = 1 || -z ${opt_expect:-} ]] || usage "--expect belongs to one range, not to a map"
	[[ ${positional[0]} != *'{seed}'* ]] || has_seed=1
	[[ -z ${opt_seeds:-} || -n $has_seed ]] || usage "--seeds without {seed} in the sentence would run the same thing again (pinit ... --seed {seed})"
	[[ -z $has_seed || ${#axis_name[@]} != 1 ]] || seeds=${opt_seeds:-3}
	[ "$seeds" -ge 1 ] || usage "--seeds 0 runs nothing (--seeds 1)"
	[ "$jobs" -ge 1 ] || usage "--jobs 0 runs nothing (--jobs 1)"
	awk -v x="$tolerance" 'BEGIN { exit !(x >= 1e-9 && x < 1) }' || usage "--tolerance $tolerance is not between 1e-9 and 1"
	if [ -z "$growth" ] && [[ "$criterion " =~ $column_name ]]; then growth=${BASH_REMATCH[2]}; fi
	[ -z "${opt_threads:-}" ] || export OMP_NUM_THREADS=$opt_threads
	as_typed "$@"
}

# The sentences, in which the numbers are not yet inserted.
understand() {
	local template=${positional[0]//$'\n'/ } n open=() w
	cycles=0 has_modes= moved=0
	for n in ${has_seed:+seed} "${axis_name[@]}"; do open+=("$n=$mark$n$mark"); done
	sentences "$template" "${opt_expect:-}" "${open[@]}" "${choices[@]}"
	choice_shown=()
	for n in "${!choice_name[@]}"; do [[ ${alternative[choice_first[n]]} == "$mark"* ]] || choice_shown+=("$n"); done
	[[ ${reference[*]} != *"$mark"* ]] || usage "--expect cannot depend on the number that is searched for"
	words "${sentence[0]}"
	for w in "${word[@]}"; do
		[[ ! $w =~ $cycle_word ]] || cycles=$((cycles + 1))
		[[ ! $w =~ $cycle_word || $w == "${word[0]}" || $cycles != 1 ]] || moved=1
		[[ ! $w =~ ^([^[:space:]]*/)?modes[[:space:]] ]] || has_modes=1 scan=${opt_scan:-64}
		[[ ! $w =~ $cycle_word || -z $criterion || $w != *--until* ]] ||
			usage "a cycle of the sentence has an --until of its own (leave it out, or --unstable-when)"
	done
	[[ $cycles != 0 || -z $criterion ]] ||
		usage "--unstable-when is looked at by cycle, and there is none in the sentence (without it exit status 3 counts)"
	for n in "${!sentence[@]}"; do expected "$n" >/dev/null; done
	if [ -n "${opt_given_length:-}" ] || ! can_lengthen; then cycles=0; fi
}

open_state() {
	local x='[-+0-9.eE,]+' count=$'\t''[0-9]+' result
	result="^(trial$count$count"$'\t'"$x(@[24]|~[12])?"$'\t'"(stable|unstable)"$'\t'"([0-9]+|-)"$'\t'".*|growth$count$count"
	result+=$'\t'"$x"$'\t'"([-+0-9.eE]+|-?nan|-?inf)"$'\t'"[0-9]+)$"
	open_results search "$(printf '%s\n' "$version" "${positional[0]}" "$criterion" "${choices[*]}" "${axis_name[*]}" "$growth")" "$result" "$result"
}

main() {
	declare -A children=()
	child='' doing='' phase='' work='' made=0 begin_file=()
	PATH=$(own_directory):$PATH
	settle "$@"
	understand
	if [ -n "${opt_list:-}" ]; then
		for text in "${sentence[@]}"; do
			shown "$text"
			printf '%s\n' "$text"
		done
		return
	fi
	trap stop INT TERM
	trap '[ -z "$work" ] || rm -rf "$work"' EXIT
	open_state
	if [ ${#axis_name[@]} = 2 ]; then
		search_map
	else
		search limits
		[[ -z $keep || -z $growth$has_modes ]] || search sample
	fi
	report
}

main "$@"
