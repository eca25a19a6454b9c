# shellcheck shell=bash
# Trials: a sentence is run with given numbers. It is unstable if a cycle reached the criterion (cycle --until) or a word exited 3, else stable.
# Each result is a line of $state/log, so nothing is run twice (VALUE@2: in a run twice as long,
# VALUE~1: with the last bit of the input moved):
#   trial MEMBER SEED VALUE stable|unstable STEP WHY | growth MEMBER SEED VALUE RATE POINTS (ln of the column per step; - none)
# SPDX-License-Identifier: GPL-3.0-or-later

# Marks {name} of a number in the sentences until its value is inserted.
mark=$'\004'

# filled MEMBER SEED VALUE[,VALUE][@FACTOR|~PERTURBED]: sets text to the member's sentence with these numbers, and factor and perturbed.
filled() {
	local i x
	IFS=, read -r -a x <<<"${3%[@~]*}"
	factor=1 perturbed=
	[[ $3 != *@* ]] || factor=${3#*@}
	[[ $3 != *~* ]] || perturbed=${3#*~}
	text=${sentence[$1]//"${mark}seed$mark"/$2}
	for i in "${!axis_name[@]}"; do text=${text//"$mark${axis_name[i]}$mark"/${x[i]}}; done
}

# shown TEXT: sets text to TEXT with the marked names in braces again.
shown() {
	local t=$1 n
	for n in seed "${axis_name[@]}"; do t=${t//"$mark$n$mark"/"{$n}"}; done
	text=$t
}

# Matches cycle, with assignments and a path before the name.
cycle_word='^(([A-Za-z_][A-Za-z0-9_]*=[^[:space:]]*[[:space:]]+)*([^[:space:]|]*/)?cycle)([[:space:]].*|)$'

# with_until WORD MORE: sets text to WORD; if it is cycle, with the criterion and MORE added, and factor times as long.
with_until() {
	local until=$criterion name rest
	text=$1
	[[ $1 =~ $cycle_word ]] || return 0
	name=${BASH_REMATCH[1]} rest=${BASH_REMATCH[4]}
	if [ "$factor" != 1 ]; then
		lengthen "$rest" "$factor" || true
		rest=$text
	fi
	if [[ $until == *"'"* ]]; then until=$(printf '%q' "$until"); else until="'$until'"; fi
	text="$name${criterion:+ --until $until}$2$rest"
}

# with_unsafe TEXT: sets text to TEXT with --unsafe in every push, so that what is found is where a run grows, and not where push refuses the step.
with_unsafe() {
	local rest=$1
	text=''
	while [[ $rest =~ ^((.*[|\'\"])?[[:space:]]*)push([[:space:]].*)$ ]]; do
		text="push --unsafe${BASH_REMATCH[3]}$text" rest=${BASH_REMATCH[1]}
	done
	text=$rest$text
}

# parts SENTENCE [WORDS]: sets part[] to the sentence, without that many words of its beginning, split after every cycle but the last, with the criterion
# in each cycle.
parts() {
	local w now=() last=-1 i all
	words "$1"
	all=("${word[@]:${2:-0}}")
	for i in "${!all[@]}"; do [[ ! ${all[i]} =~ $cycle_word ]] || last=$i; done
	part=()
	for i in "${!all[@]}"; do
		with_until "${all[i]}" ''
		with_unsafe "$text"
		[[ -z $perturbed || ! ${all[i]} =~ $cycle_word || $((i + ${2:-0})) = 0 || ${#part[@]} != 0 ]] || text="perturb --seed $perturbed | $text"
		now+=("$text")
		[[ ${all[i]} =~ $cycle_word && $i != "$last" ]] || continue
		join "${now[@]}"
		part+=("$text") now=()
	done
	join "${now[@]}"
	part+=("$text")
}

# The commands of a trial as they would be typed one after the other; trial runs the same.
trial_commands() {
	local i before=''
	parts "$1"
	for i in "${!part[@]}"; do
		if [ "$i" = $((${#part[@]} - 1)) ]; then
			echo "${before:+<$before }${part[i]} | sls --report --format json"
		else
			echo "${before:+<$before }${part[i]} >part.$i"
			echo "sls --report --format json <part.$i"
			before=part.$i
		fi
	done
}

# judge FILE: sets outcome, step and, of the word modes, the growth per step as the reason, from the listing of the last frame by sls.
judge() {
	local lines line
	mapfile -t lines <"$1"
	line=${lines[-1]}
	outcome=stable step=-
	if [[ $line =~ \"growth_per_step\":([-+0-9.e]+) ]]; then
		reason="growth ${BASH_REMATCH[1]}"
		[[ ! $line =~ \"unstable\":1(\.0+)?[,}] ]] || outcome=unstable
		return
	fi
	[[ ! $line =~ .*\"step\":([0-9]+) ]] || step=${BASH_REMATCH[1]}
	[[ ! $line =~ \"until\":1(\.0+)?[,}] ]] || outcome=unstable
}

# trial MEMBER SEED VALUE FILES: appends its line to the log, or writes the reason of its failure to $work/failure. What it writes is FILES.*, which the next
# trial with these FILES writes anew: a search has hundreds, and a directory for each, made and removed, took a fifth of its time.
trial() {
	local files=$4 i last before=${begin_file[$1]} status outcome=stable step=- reason=-
	filled "$1" "$2" "$3"
	local whole=$text
	parts "$whole" "${begin_words[$1]}"
	last=$((${#part[@]} - 1))
	for i in "${!part[@]}"; do
		status=0
		if [ "$i" = $last ]; then
			bash -o pipefail -c "${part[i]} | sls --report --format json" <"$before" >"$files.out" 2>"$files.said" || status=$?
		else
			bash -o pipefail -c "${part[i]}" <"$before" >"$files.part.$i" 2>"$files.said" || status=$?
			before=$files.part.$i
			[ $status != 0 ] || sls --report --format json <"$before" >"$files.out" 2>"$files.said" || status=$?
		fi
		if [ $status = 3 ]; then
			outcome=unstable
			reason=$(why 3 "$files.said")
			[[ ! $reason =~ step\ ([0-9]+) ]] || step=${BASH_REMATCH[1]}
			break
		elif [ $status != 0 ]; then
			printf '%s\t%s\n' "$status" "'$whole' fails: $(why $status "$files.said")" >"$work/failure.$BASHPID"
			mv "$work/failure.$BASHPID" "$work/failure"
			break
		elif [ -s "$files.out" ]; then
			judge "$files.out"
			[ $outcome = stable ] || break
		elif [ "$i" = $last ]; then
			printf '1\t%s\n' "'$whole' leaves no frame to judge" >"$work/failure"
		fi
	done
	[ "$last" = 0 ] || rm -f "$files".part.*
	[ -e "$work/failure" ] || note "trial"$'\t'"$1"$'\t'"$2"$'\t'"$3"$'\t'"$outcome"$'\t'"$step"$'\t'"$reason"
}

# growth_sentence MEMBER SEED VALUE STEPS [WORDS]: sets text to the member's sentence, without that many words of its beginning, writing about a hundred
# frames, from which the column is drawn.
growth_sentence() {
	local every=1 all=() w
	filled "$1" "$2" "$3"
	words "$text"
	word=("${word[@]:${5:-0}}")
	[[ ! $4 =~ ^[0-9]+$ ]] || every=$((1 + $4 / 100))
	for w in "${word[@]}"; do
		if [[ $w == *--every* ]]; then with_until "$w" ''; else with_until "$w" " --every $every"; fi
		with_unsafe "$text"
		all+=("$text")
	done
	join "${all[@]}"
}

# growth_of MEMBER SEED VALUE STEPS: gamma of the column by diag --growth, times the mean step; - where diag finds none.
growth_of() {
	local line
	growth_sentence "$1" "$2" "$3" "$4" "${begin_words[$1]}"
	line=$(bash -o pipefail -c "$text" <"${begin_file[$1]}" 2>/dev/null | diag --columns step,time --growth "$growth" 2>/dev/null | awk -F'\t' '
		!/^#/ && NR > 1 { if (!n++) { step = $1; start = $2 } steps = $1 - step; time = $2 - start }
		/^# / { split($0, word, " "); gamma = word[4]; points = $0; sub(/ points.*/, "", points); sub(/.* /, "", points) }
		END { if (gamma ~ /[0-9]/ && steps > 0) printf "%.6g\t%d\n", gamma * time / steps, points; else print "-\t0" }') || true
	note "growth"$'\t'"$1"$'\t'"$2"$'\t'"$3"$'\t'"${line:--$'\t'0}"
}

reap() {
	local gone=
	wait -n -p gone "${!children[@]}" 2>/dev/null || true
	[ -z "$gone" ] || unset "children[$gone]"
	made=$((made + 1))
	progress
	[ ! -e "$work/failure" ] || give_up
}

give_up() {
	local c status text
	for c in "${!children[@]}"; do kill -TERM -- "-$c" 2>/dev/null || true; done
	IFS=$'\t' read -r status text <"$work/failure"
	[ ! -t 2 ] || printf '\r\033[K' >&2
	fail "$status" "$text"
}

progress() {
	doing="$made runs made${1:+, $1}"
	if [ -n "${opt_quiet:-}" ]; then
		return 0
	elif [ -t 2 ]; then
		in_place "$me: $made runs${phase:+ ($phase)}, $SECONDS s"
	elif [ -n "${opt_verbose:-}" ]; then
		printf '%s: %s runs%s\n' "$me" "$made" "${phase:+ ($phase)}" >&2
	fi
}

# beginnings: runs the words of each member before its first cycle and before its first number once, and keeps what they write. Sets begin_file[] and
# begin_words[]. A beginning that fails is left to the trials, which report it.
beginnings() {
	local m k text
	local -A made_of=()
	begin_file=() begin_words=()
	for m in "${!sentence[@]}"; do
		words "${sentence[m]}"
		for ((k = 0; k < ${#word[@]} - 1; k++)); do [[ ${word[k]} != *"$mark"* && ! ${word[k]} =~ $cycle_word ]] || break; done
		begin_file[m]=/dev/null begin_words[m]=0
		[ $k != 0 ] || continue
		join "${word[@]:0:k}"
		with_unsafe "$text"
		if [ -z "${made_of[$text]:-}" ]; then
			made_of[$text]=$work/beginning.$m
			set -m
			bash -o pipefail -c "$text" </dev/null >"$work/beginning.$m" 2>/dev/null &
			child=$!
			set +m
			wait $child || made_of[$text]=none
			child=
		fi
		[ "${made_of[$text]}" != none ] || continue
		begin_file[m]=${made_of[$text]} begin_words[m]=$k
	done
}

# batch LINES: "trial MEMBER SEED VALUE" or "growth MEMBER SEED VALUE STEPS", with tabs between; --jobs of them at a time.
batch() {
	local line c n=0
	[ ${#begin_file[@]} != 0 ] || beginnings
	for line; do
		IFS=$'\t' read -r -a c <<<"$line"
		while [ ${#children[@]} -ge "$jobs" ]; do reap; done
		n=$((n + 1))
		set -m
		if [ "${c[0]}" = trial ]; then
			trial "${c[@]:1}" "$work/trial.$n" &
		else
			growth_of "${c[@]:1}" &
		fi
		children[$!]=1
		set +m
	done
	while [ ${#children[@]} != 0 ]; do reap; done
}
