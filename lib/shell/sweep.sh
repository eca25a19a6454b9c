# shellcheck shell=bash
# Runs the members of a sweep. Common beginnings are nodes of a tree: a node runs on the output of its parent, one at a time, once per round,
# and its seconds are charged to every member below it. Results are appended to $state/log, from which a stopped sweep is continued:
#   refined BASE VALUES (refine.sh) | time NODE ROUND SETUP SECONDS KB PROCESSOR | load OTHERS PROCESSORS
#   fail NODE WHY | error MEMBER N l1 l2 max relative_l2 relative_max | bad MEMBER WHY
# SPDX-License-Identifier: GPL-3.0-or-later

# Succeeds if the program has the option --timing.
timed() {
	local program=$1
	while [[ $program =~ ^[A-Za-z_][A-Za-z0-9_]*= ]]; do # skip assignments before the program
		program=${program#* }
	done
	program=${program%%[[:space:]]*}
	if [ -z "${is_timed[$program]:-}" ]; then
		is_timed[$program]=no
		[[ -z $bin || ! -x $bin/$program || $program == "$me" ]] || is_timed[$program]=yes
	fi
	[ "${is_timed[$program]}" = yes ]
}

# plant MEMBER: numbers the nodes of the members from MEMBER on; path[member] is "N N N", without the words before the first brace, of
# which beginning_of[member] is the number.
plant() {
	local m w parent key
	[ "$1" != 0 ] || { node_word=() path=() beginning_text=() beginning_of=() walk=() node_number=() beginning_number=(); }
	for ((m = $1; m < ${#sentence[@]}; m++)); do
		words "${sentence[m]}"
		join "${word[@]}"
		sentence[m]=$text
		[ $skip = 0 ] || join "${word[@]:0:skip}"
		[ $skip != 0 ] || text=
		[ -n "${beginning_number[x$text]:-}" ] || { beginning_number[x$text]=${#beginning_text[@]}; beginning_text+=("$text"); }
		beginning_of[m]=${beginning_number[x$text]}
		if [[ -n $size_choice && -n ${opt_extrapolate:-} ]]; then
			[ "${chosen[m * ${#choice_name[@]} + size_choice - 1]}" != "$opt_extrapolate" ] || continue # not run
		fi
		parent="b${beginning_of[m]}" path[m]=
		for w in "${word[@]:skip}"; do
			key="$parent|$w"
			[ -n "${node_number[$key]:-}" ] || { node_number[$key]=${#node_word[@]}; node_word+=("$w"); }
			path[m]+=" ${node_number[$key]}"
			parent+=" ${node_number[$key]}"
		done
		path[m]=${path[m]# }
		walk+=("$m")
	done
}

# run COMMAND IN OUT: in its own process group, so that all of it can be stopped; its messages are in $work/said.
run() {
	local status=0 clock=()
	[ -z "$time_program" ] || clock=("$time_program" -q -o "$work/clock" -f '%M %U %S %e')
	: >"$work/clock"
	: >"$work/timing"
	set -m
	PARETO_TIMING=$work/timing "${clock[@]}" bash -o pipefail -c "$1" <"$2" >"$3" 2>"$work/said" &
	child=$!
	set +m
	wait $child || status=$?
	child=
	return $status
}

# with_timing WORD: sets text to the command with --timing.
with_timing() {
	text=$1
	# shellcheck disable=SC2016 # for the shell that runs it
	! timed "$1" || text+=' --timing "$PARETO_TIMING"'
}

# Seconds of set-up and of work, kB, and seconds of the processors, of the last run. cycle writes the seconds of its words and then its own, which count
# where its words ran as processes; for a foreign word the clocks of time are used, to 10 ms.
cost() {
	awk -F'[\t]' 'FILENAME == ARGV[1] { split($0, c, " "); kb = c[1]; cpu = c[2] + c[3]; clock = c[4]; next }
		{ own = $3; set = $2; used = $4; work += $3; up += $2; all += $4; n++ }
		END { if (n > 1 && work > own) { work -= own; up -= set; all -= used } else if (n > 1) { work = own; all = used }
			printf "%.9f\t%.9f\t%s\t%.9f\n", up, n ? work : clock, kb + 0, n ? all : cpu }' "$work/clock" "$work/timing"
}

# run_node NODE IN ROUND: writes $work/node.NODE; its seconds are recorded once per round.
run_node() {
	local status=0
	with_timing "${node_word[$1]}"
	run "$text" "$2" "$work/node.$1" || status=$?
	if [ $status != 0 ]; then
		failed[$1]=$(why $status)
		note "fail"$'\t'"$1"$'\t'"${failed[$1]}"
		return 1
	fi
	[ -z "${clocked[$1,$3]:-}" ] || return 0
	clocked[$1,$3]=1
	note "time"$'\t'"$1"$'\t'"$3"$'\t'"$(cost)"
}

# Reduces the rows of scmp, or of diag --exact, to one: the largest of each norm. For diag --exact the norms are taken over the frames.
norms_scmp() { awk -F'\t' 'NR > 1 && $2 != "-" { k++; n += $4; for (i = 5; i <= 9; i++) if (k == 1 || $i ~ /nan/ || (v[i] !~ /nan/ &&
	$i + 0 > v[i] + 0)) v[i] = $i }
	END { if (!k) exit 1; printf "%d", n; for (i = 5; i <= 9; i++) printf "\t%s", v[i]; print "" }'; }
norms_exact() { awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; for (f in at) if (("exact_" f) in at) want[f] = 1; next } /^#/ { next }
	{ for (f in want) { a = $at[f]; b = $at["exact_" f]; d = a - b; if (d < 0) d = -d; c = b < 0 ? -b : b
		n[f]++; s[f] += d; q[f] += d * d; z[f] += c * c; if (d > m[f]) m[f] = d; if (c > t[f]) t[f] = c } }
	function most(i, x) { if (!(i in v) || x != x || x > v[i]) v[i] = x }
	END { for (f in n) { k += n[f]; most(1, s[f] / n[f]); most(2, sqrt(q[f] / n[f])); most(3, m[f]); most(4, z[f] ? sqrt(q[f] / z[f]) : q[f] ? "inf" : 0);
		most(5, t[f] ? m[f] / t[f] : m[f] ? "inf" : 0) }
		if (!k) exit 1; printf "%d", k; for (i = 1; i <= 5; i++) printf "\t%.10g", v[i]; print "" }'; }

# compare_words MEMBER FILE: sets argument to the words that measure its error; for --against exact FILE is the input.
compare_words() {
	if [ "$against" = exact ]; then
		argument=(diag --exact ${field:+--columns "$field"})
	else
		argument=(scmp ${field:+--field "$field"} ${set:+--set "$set"} "$2" "$work/reference.${reference_of[$1]}")
	fi
}

# compare MEMBER FILE: prints the line for the log.
compare() {
	local row='' input=/dev/null argument line
	compare_words "$1" "$2"
	[ "$against" != exact ] || input=$2
	if "${argument[@]}" <"$input" >"$2.rows" 2>"$2.said"; then
		if [ "$against" = exact ]; then
			row=$(norms_exact <"$2.rows") || row=
		else
			row=$(norms_scmp <"$2.rows") || row=
		fi
		if [ -n "$row" ]; then
			printf 'error\t%s\t%s\n' "$1" "$row"
		else
			printf 'bad\t%s\t%s\n' "$1" "nothing to compare (choose --field)"
		fi
	else
		line=$(head -n 1 "$2.said" | tr '\t' ' ')
		line=${line//"$2"/the member}
		line=${line//"$work/reference.${reference_of[$1]:-}"/the reference}
		printf 'bad\t%s\t%s\n' "$1" "$line"
	fi
	rm -f "$2.rows" "$2.said"
}

# Succeeds if nothing of MEMBER is left to measure in ROUND.
is_complete() {
	local n
	for n in ${path[$1]}; do
		[ -z "${failed[$n]:-}" ] || return 0
		[ -n "${clocked[$n,$2]:-}" ] || return 1
	done
	[ -n "${error_known[$1]:-}" ]
}

# input_of MEMBER: the output of the words before its first brace.
input_of() { if [ $skip = 0 ]; then echo /dev/null; else echo "$work/beginning.${beginning_of[$1]}"; fi; }

# visit MEMBER ROUND: runs the missing nodes of its path.
visit() {
	local n from f line
	from=$(input_of "$1")
	for f in "${held[@]}"; do
		[[ " ${path[$1]} " == *" $f "* ]] || rm -f "$work/node.$f"
	done
	held=()
	for n in ${path[$1]}; do
		held+=("$n")
		[ -z "${failed[$n]:-}" ] || return 0
		[ -f "$work/node.$n" ] || run_node "$n" "$from" "$2" || { rm -f "$work/node.$n"; return 0; }
		from=$work/node.$n
	done
	[ -z "${error_known[$1]:-}" ] || return 0
	line=$(compare "$1" "$from")
	error_known[$1]=1
	note "$line"
}

progress() {
	local left=''
	[ "$1" = 0 ] || left=", $((100 * $1 / $2)) %, about $(((SECONDS - began) * ($2 - $1) / $1)) s left"
	doing="$1 of $2 measured$3"
	if [ -n "${opt_quiet:-}" ]; then
		return 0
	elif [ -t 2 ]; then
		in_place "$me: $1 of $2 measured$left$3"
	elif [ -n "${opt_verbose:-}" ]; then
		printf '%s: %s%s\n' "$me" "$doing" "$left" >&2
	fi
}

# One member as one sentence, for errors alone; run by GNU parallel.
member_error() {
	local member=$1 out=$work/member.$1 text
	if bash -o pipefail -c "$(cat "$work/tail.$1")" <"$(cat "$work/input.$1")" >"$out" 2>"$out.err"; then
		reference_of=()
		reference_of[member]=$(cat "$work/against.$1")
		compare "$member" "$out"
	else
		printf 'bad\t%s\t%s\n' "$member" "$(grep -v ': stopped by ' "$out.err" | head -n 1 | tr '\t' ' ' | sed 's/^bash: line 1: //')"
	fi
	rm -f "$out" "$out.err"
}

measure_errors() {
	local m status=0 bar=() list=()
	for m in "${walk[@]}"; do
		[ -z "${error_known[$m]:-}" ] || continue
		list+=("$m")
		words "${sentence[m]}"
		join "${word[@]:skip}"
		printf '%s\n' "$text" >"$work/tail.$m"
		input_of "$m" >"$work/input.$m"
		echo "${reference_of[m]:-}" >"$work/against.$m"
	done
	[ ${#list[@]} != 0 ] || return 0
	[ ! -t 2 ] || bar=(--bar)
	with_parallel=1
	export work against field set
	export -f member_error compare compare_words norms_scmp norms_exact
	doing="${#list[@]} were to be compared"
	set -m
	PARALLEL_SHELL=$(command -v bash) parallel --will-cite "${bar[@]}" -j "$jobs" member_error '{}' ::: "${list[@]}" </dev/null >>"$state/log" \
		2>"$work/parallel" &
	child=$!
	set +m
	wait $child || status=$?
	child=
	[ $status = 0 ] || fail 1 "parallel: $(grep -v '^$' "$work/parallel" | tail -n 1)"
}

# recall: reads the results in the log of an earlier run.
recall() {
	local what a b rest
	while IFS=$'\t' read -r what a b rest; do
		case $what in
		time) clocked[$a,$b]=1 ;;
		fail) failed[$a]=$b ;;
		error | bad) error_known[$a]=1 ;;
		refined) add_again "$a" "$b" ;;
		esac
	done <"$state/log"
}
