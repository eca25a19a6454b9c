#!/usr/bin/env bash
# digits: how many digits of a result can be believed. A sentence runs as it is, with its input moved in the last bit, and with the processor rounding up,
# down and to zero; what differs is not known. The Makefile inserts the files it reads from lib/shell/ into bin/digits.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
export LC_ALL=C
me=digits
version=@VERSION@
# shellcheck source=lib/shell/help.sh
. lib/shell/help.sh
# shellcheck source=lib/shell/braces.sh
. lib/shell/braces.sh
# shellcheck source=lib/shell/run.sh
. lib/shell/run.sh
# shellcheck source=lib/shell/digits-table.sh
. lib/shell/digits-table.sh

summary="how many digits of a result agree when the last bit of the input and the rounding change"
kind="runs sentences and writes text"
arguments=SENTENCE
arguments_text="Words joined by |, in quotes, that leave a stream (measured by diag and field by field) or a table with a line of names."
about="The sentence runs as it is, --runs times with every number of its input moved by its last bit at random (the word perturb behind pinit, stab, sh5,
stack or cat), and with all words rounding up, down and to zero instead of to the nearest number. For every number it prints how many decimal digits
agree at 95 % confidence (Vignes 1993): for the input, for the rounding, and the smaller of the two; worst is the smallest of the frames so far, because runs
that have lost everything may agree again on something else. 16.0 is all a double has; 0 means that not even the size is known. For fields it is the
relative l2 difference of the run that differs most.

Chaos, cancellation and the order of sums leave few digits; a sum that should be zero has none. It is no error bar of the method: errors of the step and the
mesh are the same in every run."
rows="|columns|LIST||the columns of diag (default: all)
|fields|LIST||compare only these fields; none: leave the fields out
|runs|N||runs with moved input (default 4)
|relative|X||move the input by this fraction of each number, not by its last bit: what an uncertain input leaves
|f32|||also a run whose state is rounded to f32 after each step
|all|||every frame; by default the last one (worst counts all that there are)
|least|X||exit 3 if a column of the last frame has fewer digits than this
|format|WORD|table tsv|what is printed (default table)
j|jobs|N||runs at a time (default 1)
|threads|N||threads of every word (OMP_NUM_THREADS)"
examples="Energy and momentum of a cluster after five times: what chaos leaves|\
digits 'pinit plummer -n 60 | cycle -n 100 \"push kick/2 drift | pp | push kick/2\"' --columns energy,momentum_x --fields x
The variance of 1e8 + {1, 2, 3} as the mean of the squares less the square of the mean: 2/3|\
digits 'printf \"x a b c\n0 100000001 100000002 100000003\n\" | stab - | scalc \"w = (a^2+b^2+c^2)/3 - ((a+b+c)/3)^2\" | stab --plain'"

# runs_of KIND: the files of that kind, of all runs but the one as it is.
runs_of() {
	local f
	for f in "$work"/*."$1"; do [[ ! -e $f || $f == */as-is.* ]] || printf '%s\n' "$f"; done
}

# command_name WORD: sets name to the program it runs, without assignments and path.
command_name() {
	name=$1
	while [[ $name =~ ^[A-Za-z_][A-Za-z0-9_]*=[^[:space:]]*[[:space:]]+(.*)$ ]]; do name=${BASH_REMATCH[1]}; done
	name=${name%%[[:space:]]*}
	name=${name##*/}
}

# understand: sets behind to the index of the word that makes the stream.
understand() {
	local i name
	words "${positional[0]//$'\n'/ }"
	sentence=("${word[@]}") behind=-1
	for i in "${!sentence[@]}"; do
		command_name "${sentence[i]}"
		case $name in
		pinit | stab | sh5 | stack) behind=$i && return ;;
		esac
		[ ! -x "$here/$name" ] || break
		behind=$i
	done
	[ "$behind" -ge 0 ] || usage "the sentence begins with '$name', whose input cannot be moved (cat FILE | $name ...)"
}

# rounded_words: the words with the state rounded to f32 behind the input and at the end of each step.
rounded_words() {
	local i w name
	all=()
	for i in "${!sentence[@]}"; do
		w=${sentence[i]}
		command_name "$w"
		if [ "$name" = cycle ]; then
			[[ $w == *[\'\"] ]] || usage "--f32: the sentence of cycle is not the last argument: $w"
			w="${w%?} | smod --store f32${w: -1}"
		fi
		all+=("$w")
		[ "$i" != "$behind" ] || all+=("smod --store f32")
	done
}

# one RUN ROUNDING SEED: runs a variant; its stream or table goes to $work/RUN.out.
one() {
	local all=("${sentence[@]}")
	[ "$1" != f32.1 ] || rounded_words
	[ -z "$3" ] || all[behind]+=" | perturb --seed $3${opt_relative:+ --relative $opt_relative}"
	join "${all[@]}"
	local status=0
	PM_ROUNDING=$2 bash -o pipefail -c "$text" >"$work/$1.out" 2>"$work/$1.said" </dev/null || status=$?
	[ $status = 0 ] || printf '%s\t%s\n' $status "the run '$1' fails: $(why $status "$work/$1.said")" >"$work/failure"
}

# measure RUN: the numbers and fields of its result.
measure() {
	if [ "$(head -c 7 "$work/$1.out")" = PMPIPE/ ]; then
		diag ${opt_columns:+--columns "$opt_columns"} <"$work/$1.out" >"$work/$1.table" 2>"$work/$1.said" || fail 1 "$(why 1 "$work/$1.said")"
		[[ $1 == as-is || ${opt_fields:-} == none ]] || scmp --common ${opt_fields:+--field "$opt_fields"} "$work/$1.out" "$work/as-is.out" \
			>"$work/$1.fields" 2>"$work/$1.said" || fail 1 "$(why 1 "$work/$1.said")"
	else
		awk 'BEGIN { OFS = "\t" } { $1 = $1; print }' "$work/$1.out" >"$work/$1.table"
	fi
	[ "$1" = as-is ] || rm -f "$work/$1.out"
}

settle() {
	read_options "$@"
	[ ${#positional[@]} = 1 ] || usage "one SENTENCE, in quotes, not ${#positional[@]} arguments"
	runs=${opt_runs:-4} jobs=${opt_jobs:-1}
	[ "$runs" -ge 2 ] || usage "--runs $runs has no spread (--runs 4)"
	[ "$jobs" -ge 1 ] || usage "--jobs 0 runs nothing (--jobs 1)"
	[ -z "${opt_threads:-}" ] || export OMP_NUM_THREADS=$opt_threads
}

# reap: waits for one run; ends them all if it failed.
reap() {
	local gone='' c status text
	wait -n -p gone "${!children[@]}" 2>/dev/null || true
	[ -z "$gone" ] || unset "children[$gone]"
	doing="${#children[@]} runs under way"
	[ -e "$work/failure" ] || return 0
	for c in "${!children[@]}"; do kill -TERM -- "-$c" 2>/dev/null || true; done
	IFS=$'\t' read -r status text <"$work/failure"
	fail "$status" "$text"
}

# batch: the variants, --jobs of them at a time.
batch() {
	local i list=("as-is nearest ") line run mode seed
	for ((i = 1; i <= runs; i++)); do list+=("input.$i nearest $i"); done
	list+=("rounding.1 up " "rounding.2 down " "rounding.3 zero ")
	[ -z "${opt_f32:-}" ] || list+=("f32.1 nearest ")
	for line in "${list[@]}"; do
		while [ ${#children[@]} -ge "$jobs" ]; do reap; done
		IFS=' ' read -r run mode seed <<<"$line"
		[ -z "${opt_verbose:-}" ] || tell "run $run"
		set -m # a process group of its own, for stop
		one "$run" "$mode" "$seed" &
		children[$!]=1
		set +m
	done
	while [ ${#children[@]} != 0 ]; do reap; done
	for line in "${list[@]}"; do measure "${line%% *}"; done
}

main() {
	declare -A children=()
	child='' doing='' work=''
	here=$(own_directory)
	PATH=$here:$PATH
	settle "$@"
	understand
	[ -z "${opt_f32:-}" ] || rounded_words
	trap stop INT TERM
	trap '[ -z "$work" ] || rm -rf "$work"' EXIT
	work_directory
	batch
	report
}

main "$@"
