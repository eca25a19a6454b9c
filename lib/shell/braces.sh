# shellcheck shell=bash
# Sentences with alternatives: {a,b,c} splits at the commas directly inside, nests, and may contain |; \{ \} \, are the literal characters;
# {name} stands for the value of --vary name=a,b,c wherever it occurs (linked choices). `sentences TEMPLATE REFERENCE VARY...` sets sentence[], choice_name[]
# and chosen[member * choices + choice]. The last choice varies fastest; of equal sentences the first is kept. last_member is the member with the last
# alternative of every choice.
# SPDX-License-Identifier: GPL-3.0-or-later

# Escaped characters are replaced by control characters until everything is expanded.
hide_escapes() {
	text=${1//'\{'/$'\001'}
	text=${text//'\}'/$'\002'}
	text=${text//'\,'/$'\003'}
}
show_escapes() {
	text=${1//$'\001'/'{'}
	text=${text//$'\002'/'}'}
	text=${text//$'\003'/,}
}

trim() {
	text=${1#"${1%%[![:space:]]*}"}
	text=${text%"${text##*[![:space:]]}"}
}

piece() {
	trim "$1"
	[[ -z $behind_word || $1 != [[:space:]]* || $text != -[[:alpha:]-]* ]] || text=" $text"
	pieces+=("$text")
}

# group TEXT BEFORE: TEXT begins with {; sets end to the index of the matching }, pieces to the alternatives between its commas. Blanks around them are
# removed, except one that separates an option from the word before the brace: a{, --b}.
group() {
	local i depth=0 from=1 behind_word=
	pieces=()
	[[ ${2:-} != *[[:alnum:]] ]] || behind_word=1
	for ((i = 0; i < ${#1}; i++)); do
		case ${1:i:1} in
		'{') depth=$((depth + 1)) ;;
		'}') depth=$((depth - 1)) ;;
		,) [ $depth != 1 ] || { piece "${1:from:i-from}"; from=$((i + 1)); } ;;
		esac
		[ $depth != 0 ] || { end=$i; piece "${1:from:i-from}"; return; }
	done
	show_escapes "$1"
	usage "a brace is not closed: '$text' (\\{ for the sign itself)"
}

no_stray() {
	[[ $1 != *'}'* ]] && return
	show_escapes "$1"
	usage "a } without its { in '$text' (\\} for the sign itself)"
}

# known NAME: succeeds if it is a name of --vary.
known() {
	local n
	for n in "${vary_name[@]}"; do
		[ "$n" != "$1" ] || return 0
	done
	show_escapes "$1"
	usage "'{$text}' is neither alternatives, which have a comma, nor a name of --vary (\\{ for the sign itself)"
}

# expand TEXT [BEFORE]: sets expanded to all expansions of TEXT; {name} is left as it is.
expand() {
	local s=$1 before='' head one all=() last=() parts=()
	while [[ $s == *'{'* ]]; do
		head=${s%%'{'*}
		no_stray "$head"
		before+=$head s=${s:${#head}}
		group "$s" "${before:-${2:-}}"
		parts=("${pieces[@]}") head=${s:0:end+1} s=${s:end+1}
		if [ ${#parts[@]} = 1 ]; then
			known "${parts[0]}"
			before+=$head
			continue
		fi
		expand "$s"
		last=("${expanded[@]}")
		for head in "${parts[@]}"; do
			expand "$head"
			for head in "${expanded[@]}"; do
				for one in "${last[@]}"; do all+=("$before$head$one"); done
			done
		done
		expanded=("${all[@]}")
		return
	done
	no_stray "$s"
	expanded=("$before$s")
}

# add_choice NAME ALTERNATIVES...
add_choice() {
	local name=$1 n=1 have
	shift
	for have in "${choice_name[@]}"; do
		[[ $have != "$name" && ! $have =~ ^$name[0-9]+$ ]] || n=$((n + 1))
	done
	[ $n = 1 ] || name+=$n
	choice_name+=("$name") choice_first+=("${#alternative[@]}") choice_count+=($#)
	alternative+=("$@")
}

# link_names TEXT: makes each {name} in it a choice, once.
link_names() {
	local i
	for i in "${!vary_name[@]}"; do
		[[ -n ${linked[i]:-} || $1 != *"{${vary_name[i]}}"* ]] && continue
		linked[i]=${#choice_name[@]}
		hide_escapes "{${vary_list[i]}}"
		group "$text"
		local values=() piece
		for piece in "${pieces[@]}"; do
			expand "$piece"
			values+=("${expanded[@]}")
		done
		add_choice "${vary_name[i]}" "${values[@]}"
	done
}

# The name of a choice: the option before it, "word" at the beginning of a word, else "choice".
name_of() {
	if [[ $1 =~ (^|[[:space:]])--?([A-Za-z][A-Za-z0-9-]*)[=[:space:]]+$ ]]; then
		name=${BASH_REMATCH[2]}
	elif [[ $1 =~ (^|\|)[[:space:]]*$ ]]; then
		name=word
	else
		name=choice
	fi
}

# parse TEMPLATE: sets segment[] to the text before each brace with alternatives, then the rest.
parse() {
	local s=$1 head before='' parts
	segment=() segment_choice=()
	while [[ $s == *'{'* ]]; do
		head=${s%%'{'*}
		no_stray "$head"
		before+=$head s=${s:${#head}}
		group "$s" "$before"
		head=${s:0:end+1} s=${s:end+1}
		parts=("${pieces[@]}")
		link_names "$head"
		if [ ${#parts[@]} = 1 ]; then
			known "${parts[0]}"
			before+=$head
			continue
		fi
		expand "$head" "$before"
		name_of "${segment_choice:+...}$before"
		segment+=("$before") segment_choice+=("${#choice_name[@]}")
		add_choice "$name" "${expanded[@]}"
		before=
	done
	no_stray "$s"
	segment+=("$before$s")
}

vary_read() {
	local v
	vary_name=() vary_list=() linked=()
	for v; do
		[[ $v =~ ^([A-Za-z_][A-Za-z0-9_-]*)=(.*)$ ]] || usage "--vary wants name=value,value,..., not '$v'"
		vary_name+=("${BASH_REMATCH[1]}") vary_list+=("${BASH_REMATCH[2]}")
	done
}

# with_names TEXT: sets text to TEXT with the values of this member in place of the names and the escaped characters restored.
with_names() {
	local i t=$1
	for i in "${!linked[@]}"; do
		t=${t//"{${vary_name[i]}}"/"${value[linked[i]]}"}
	done
	show_escapes "$t"
}

# quoting TEXT: sets quote to the quotation mark that is still open at the end of TEXT.
quoting() {
	local i
	quote=
	for ((i = 0; i < ${#1}; i++)); do
		case $quote${1:i:1} in
		"'" | '"') quote=${1:i:1} ;;
		"''" | '""') quote= ;;
		'\' | '"\') i=$((i + 1)) ;;
		esac
	done
}

# with_data TEXT: as with_names, for a sentence, which a shell parses: a value is quoted so that it stays one word.
with_data() {
	local instead='write the alternatives into the sentence, in braces' i t=$1 name v before done quote q="'" plain='^[A-Za-z0-9_./:+,@%^-]*$'
	for i in "${!linked[@]}"; do
		name="{${vary_name[i]}}"
		show_escapes "${value[linked[i]]}"
		v=$text
		if [[ ${v//$'\004'/} =~ $plain ]]; then # the marks of margin need no quotes either
			t=${t//"$name"/"$v"}
			continue
		fi
		done=
		while [[ $t == *"$name"* ]]; do
			before=$done${t%%"$name"*}
			t=${t#*"$name"}
			quoting "$before"
			# shellcheck disable=SC2016 # for the shell that runs the sentence
			if [[ $before == *'`'* || $before == *'$('* || $before == *'<('* || $before == *'>('* || $before == *'${'* ]]; then
				usage "--vary ${vary_name[i]}: '$v' cannot stand behind a \$( ) of the sentence ($instead)"
			elif [[ -n $quote && $v == *[\'\"\\\$\`\|]* ]]; then
				usage "--vary ${vary_name[i]}: '$v' stands between quotes in the sentence, where it can have none of ' \" \\ \$ \` | ($instead)"
			fi
			if [ -n "$quote" ]; then done=$before$v; else done="$before'${v//"$q"/"'\\''"}'"; fi
		done
		t=$done$t
	done
	show_escapes "$t"
}

# Adds the member with the alternatives at[].
add_member() {
	local d
	value=()
	for d in "${!at[@]}"; do
		value[d]=${alternative[choice_first[d] + at[d]]}
	done
	add_values
}

# Adds the member with the values value[], unless the same sentence exists already; at_of[member] are the numbers of its alternatives.
add_values() {
	local d i v s=''
	for d in "${!segment_choice[@]}"; do
		s+=${segment[d]}${value[segment_choice[d]]}
	done
	with_data "$s${segment[-1]}"
	[ -n "${there[$text]:-}" ] && { last_member=${there[$text]}; return; }
	last_member=${#sentence[@]}
	there[$text]=$last_member
	sentence+=("$text")
	at_of+=("${at[*]}")
	for d in "${!at[@]}"; do
		v=${value[d]}
		for i in "${!linked[@]}"; do # {NAME} of --size stays, and with --refine of all: a method is the same at all sizes
			[[ -z ${opt_refine:-} && ${vary_name[i]} != "${opt_size:-}" ]] || v=${v//"{${vary_name[i]}}"/$'\001'${vary_name[i]}$'\002'}
		done
		with_names "$v"
		trim "$text"
		chosen+=("$text")
	done
	if [ "$me" = margin ]; then with_names "$reference_template"; else with_data "$reference_template"; fi # --expect is arithmetic, --against a sentence
	reference+=("$text")
}

# sentences TEMPLATE REFERENCE VARY...: also sets reference[], REFERENCE with the values of each member.
sentences() {
	local d at=() value=()
	local -A there=()
	choice_name=() choice_first=() choice_count=() alternative=() sentence=() chosen=() reference=() at_of=()
	hide_escapes "$2"
	reference_template=$text
	vary_read "${@:3}"
	hide_escapes "$1"
	parse "$text"
	for d in "${!vary_name[@]}"; do
		[ -n "${linked[d]:-}" ] || usage "'{${vary_name[d]}}' of --vary is nowhere in the sentence"
	done
	[ ${#choice_name[@]} != 0 ] || usage "nothing to choose from (write alternatives as {a,b}, or {name} with --vary name=a,b)"
	for d in "${!choice_name[@]}"; do at[d]=0; done
	while :; do
		add_member
		for ((d = ${#at[@]} - 1; d >= 0; d--)); do
			at[d]=$((at[d] + 1))
			[ "${at[d]}" = "${choice_count[d]}" ] || break
			at[d]=0
		done
		[ "$d" -ge 0 ] || return 0
	done
}

# words TEXT: splits TEXT into word[] at each | outside quotes, braces and parentheses.
words() {
	local i c quote='' depth=0 from=0
	word=()
	for ((i = 0; i < ${#1}; i++)); do
		c=${1:i:1}
		if [ -n "$quote" ]; then
			[ "$c" != "$quote" ] || quote=
			[[ $c != '\' || $quote != '"' ]] || i=$((i + 1))
			continue
		fi
		case $c in
		"'" | '"') quote=$c ;;
		'\') i=$((i + 1)) ;;
		'{' | '(') depth=$((depth + 1)) ;;
		'}' | ')') depth=$((depth - 1)) ;;
		';') [ $depth != 0 ] || usage "a sentence is words joined by |, without ';'" ;;
		'|') [ $depth != 0 ] || { trim "${1:from:i-from}"; word+=("$text"); from=$((i + 1)); } ;;
		esac
	done
	[ -z "$quote" ] || usage "a quote is not closed in '$1'"
	trim "${1:from}"
	word+=("$text")
	for c in "${word[@]}"; do
		[ -n "$c" ] || usage "an empty word in '$1'"
	done
}

# join WORDS...: sets text to the words joined by |.
join() {
	text=$1
	shift
	[ $# = 0 ] || text+=$(printf ' | %s' "$@")
}
