#!/usr/bin/env bash
# pareto: what accuracy costs in time. Every combination of the alternatives in a sentence is run, its error measured against a reference and its seconds
# word by word; the Pareto front are the combinations that no other beats in both. A script, because it only starts programs and waits for them: bash
# runs the words as the user's shell would, awk sums. The Makefile inserts the files it reads from lib/shell/ into bin/pareto.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
export LC_ALL=C
me=pareto
version=@VERSION@
# shellcheck source=lib/shell/help.sh
. lib/shell/help.sh
# shellcheck source=lib/shell/braces.sh
. lib/shell/braces.sh
# shellcheck source=lib/shell/run.sh
. lib/shell/run.sh
# shellcheck source=lib/shell/page.sh
. lib/shell/page.sh
# shellcheck source=lib/shell/sweep.sh
. lib/shell/sweep.sh
# shellcheck source=lib/shell/rounds.sh
. lib/shell/rounds.sh
# shellcheck source=lib/shell/members.sh
. lib/shell/members.sh
# shellcheck source=lib/shell/sizes.sh
. lib/shell/sizes.sh
# shellcheck source=lib/shell/refine.sh
. lib/shell/refine.sh
# shellcheck source=lib/shell/json.sh
. lib/shell/json.sh
# shellcheck source=lib/shell/front.sh
. lib/shell/front.sh
# shellcheck source=lib/shell/front-picture.sh
. lib/shell/front-picture.sh
# shellcheck source=lib/shell/references.sh
. lib/shell/references.sh

summary="what accuracy costs in time: error against seconds of all the alternatives in a sentence"
kind="runs sentences and writes text"
arguments=SENTENCE
arguments_text="Words joined by |, with alternatives in braces, in quotes."
about="Alternatives {a,b} split at the commas directly inside, nest, may be empty and may contain |; \\{ \\} \\, are the literal characters. --vary
kernel=cic,tsc gives {kernel} the same value everywhere in the sentence (linked choices). The words before the first brace are run once, and no
sentence is charged for them; after that, a beginning that several sentences share is run once per round and charged to each. One word runs at a time.
The seconds are those that the words report (--timing; for a word without this option those of its process), wall time and processor time, in rounds
over all sentences in changing order, until the medians of the front are known to --spread. Sentences that differ by no more than noise are a tie: both
are on the front. Set-up, and the largest memory of one word, are listed separately. A sentence that fails is reported and does not stop the others.

With -o DIRECTORY: pareto.tsv, pictures (splot) and index.html, a page of one file whose table sorts; the same command continues a sweep that was
stopped. Then --until-error, --within and --format tsv or json need no SENTENCE."
rows="a|against|TEXT||the reference: a sentence (without a source it is fed by the words before the first brace; names in braces as in \
SENTENCE), a file, exact (the exact numbers of the scene; --field then names columns of diag), or finest (the last of all alternatives)
f|field|NAME||compare these fields, with commas between (default: all)
|set|NAME||compare only fields on these sets or meshes
|norm|WORD|l1 l2 max relative_l2 relative_max|the norm of scmp used as the error (default relative_l2), the largest over fields and frames
|vary|TEXT||name=value,value,...: what {name} stands for; may be given several times
o|output|DIRECTORY||write the results there, and continue from earlier ones
|repeat|N||exactly so many rounds of timing (with --spread or --budget: at least so many; default 3)
|spread|X||repeat until the median time of all that may be on the front is known to this fraction (default 0.05; half the interval of 90 %)
|budget|TIME||and no longer than this, as 90s or 5min (default 20s)
|time|WORD|wall processor|which time the front is made of (default wall; processor: of all threads, less disturbed on a loaded machine)
|axes|LIST||the criteria of the front, of error, time and memory (default error,time)
|size|NAME||the name of --vary that is the size of the problem: a front and, by default, a reference for each size, power laws, crossovers
|extrapolate|X||a size that is not run: times, memory and errors by the power laws, labelled
j|jobs|N||only errors, without seconds: run N sentences at a time (GNU parallel)
|until-error|X||print the cheapest sentence with at most this error, and nothing else
|refine|||with --until-error: where no sentence listed meets it, continue the numbers among the alternatives along their measured convergence
|within|TEXT||print the most accurate sentence of at most this cost, as 2s, 50ms or 1.5min, and nothing else
|format|WORD|table tsv json|what is printed (default table)
|tsv|||the same as --format tsv
|list|||print the sentences, and run nothing
|fresh|||discard earlier results in the directory of -o
|threads|N||threads of every word (OMP_NUM_THREADS)"
examples="Two kernels and two meshes: errors of the force against the direct sum|\
pareto 'pinit plummer -n 200 | p2m --kernel {cic,tsc} -n {8,16} | poisson-fft | mgrad | m2p' --against pp --field acc --repeat 1
The same kernel for the way to the mesh and back; only errors|\
pareto 'pinit uniform -n 99 | p2m --kernel {k} -n 8 | poisson-fft | mgrad | m2p --kernel {k}' --vary k=ngp,tsc --against finest --field acc \
--repeat 1 --tsv"

settle() {
	read_options "$@"
	[ ${#positional[@]} -le 1 ] || usage "one SENTENCE, in quotes, not ${#positional[@]} arguments"
	against=${opt_against:-} field=${opt_field:-} set=${opt_set:-} norm=${opt_norm:-relative_l2} repeat=${opt_repeat:-3} jobs=${opt_jobs:-}
	format=${opt_format:-${opt_tsv:+tsv}}
	[[ -z ${opt_tsv:-} || $format = tsv ]] || usage "--tsv and --format $format (leave one of them out)"
	settle_times
	keep_directory
	until=${opt_until_error:-} within_seconds=
	[ -z "${opt_within:-}" ] || within_seconds=$(seconds_of within "$opt_within")
	if [ ${#positional[@]} = 0 ]; then
		answer_again
		exit
	fi
	[ -n "$against" ] || usage "--against is missing: what is the reference? (a sentence such as 'pp', a file, exact, or finest)"
	[ "$repeat" -ge 1 ] || usage "--repeat 0 measures nothing (--repeat 1)"
	[[ -z $jobs || $jobs -ge 1 ]] || usage "--jobs 0 runs nothing (--jobs 1)"
	[[ -z $jobs || -z $within_seconds ]] || usage "--within wants seconds, which --jobs does not measure (leave --jobs out)"
	[[ $against != exact || -n $field ]] || usage "--against exact wants --field: columns that diag --exact knows (--field energy_kinetic)"
	[ -z "${opt_threads:-}" ] || export OMP_NUM_THREADS=$opt_threads
	as_typed "$@"
}

# The sentences, their common beginning, and the tree of the remaining words.
understand() {
	local template=${positional[0]//$'\n'/ } w
	sized
	words "${template//"{${opt_size:- }}"/0}"
	skip=0
	for w in "${word[@]}"; do
		[[ ${w//'\{'/} != *'{'* ]] || break
		skip=$((skip + 1))
	done
	sentences "$template" "$against" "${varied[@]}"
	find_size
	settle_refine
	plant 0
	refer 0
}

open_state() {
	local x='[^[:space:]]+'
	open_results sweep "$(printf '%s\n' "$version" "${positional[0]}" "$against" "$field" "$set" "${varied[*]}" "${OMP_NUM_THREADS:-}" \
		"${jobs:+errors}" ${opt_size:+"$opt_size"})" '^error' \
		"$(printf '^(refined\t[0-9]+\t[-0-9.e+ ]+|load(\t%s){2}|time(\t[0-9]+){2}(\t%s){3,4}|(fail|bad)\t[0-9]+\t.*|error\t[0-9]+(\t%s){6})$' "$x"{,,})"
}

all_known() {
	local m r
	for m in "${walk[@]}"; do
		if [ -n "$jobs" ]; then
			[ -n "${error_known[$m]:-}" ] || return 1
		else
			[ "$fixed" = 1 ] || return 1
			for ((r = 1; r <= repeat; r++)); do is_complete "$m" $r || return 1; done
		fi
	done
}

main() {
	declare -A children=() is_timed=() failed=() clocked=() error_known=() node_number=() beginning_number=() reference_number=()
	held=() child='' doing='' work='' bin=$(own_directory)
	PATH=$bin:$PATH
	time_program=$(type -P time) || time_program=
	settle "$@"
	understand
	[ -z "${opt_list:-}" ] || { printf '%s\n' "${sentence[@]}"; return; }
	trap stop INT TERM
	trap '[ -z "$work" ] || rm -rf "$work"' EXIT
	open_state
	listed=${#sentence[@]}
	recall
	if ! all_known; then
		prepare
		if [ -n "$jobs" ]; then
			command -v parallel >/dev/null || fail 1 "no GNU parallel here (apt-get install parallel, or leave --jobs out)"
			measure_errors
		else
			measure
		fi
	fi
	[ -z "${opt_refine:-}" ] || refine
	report
}

main "$@"
