# shellcheck shell=bash
# Help, manual page, completion, examples and option parsing of the tools in shell, from one table of rows, in the form of the tools in C
# (lib/stage/help.c, options.c). The tool sets me, summary, arguments, arguments_text, kind, about, examples (lines
# "TEXT|COMMAND") and rows (lines "letter|name|VALUE|choices|text"); the value of --a-b is stored in opt_a_b.
# SPDX-License-Identifier: GPL-3.0-or-later

common_rows='q|quiet|||print no notes on standard error, only errors
v|verbose|||say on standard error what is done
h|help|||print this help
|man|||print the manual page (troff)
|examples|||print the examples, one command a line
|complete|||print the options with their choices, for completion
|version|||print the version'

# fail STATUS TEXT...: prints one line and exits.
fail() {
	local status=$1
	shift
	echo "$me: $*" >&2
	exit "$status"
}
usage() { fail 2 "$@"; }
# tell TEXT...: a note, one line; --quiet leaves it out.
tell() { [ -n "${opt_quiet:-}" ] || echo "$me: $*" >&2; }

help_rows() {
	local letter name value choices text
	while IFS='|' read -r letter name value choices text; do
		[ -z "$choices" ] || text="$text; one of ${choices// /, }"
		printf '  %-26s %s\n' "$([ -n "$letter" ] && echo "-$letter," || echo '   ') --$name${value:+ $value}" "$text"
	done
}

print_help() {
	printf '%s: %s\n\nusage: %s [options] %s\n%s %s.\n%s: %s\n\n%s\n' "$me" "$summary" "$me" "$arguments" "$me" "$kind" "$arguments" "$arguments_text" \
		"$about"
	printf '\noptions:\n'
	help_rows <<<"$rows"
	printf '\noptions of every tool:\n'
	help_rows <<<"$common_rows"
	printf '\nexamples:\n'
	sed -E 's/^([^|]*)\|(.*)/  # \1\n  \2/' <<<"$examples"
}

# troff: backslashes and leading dots or quotes are escaped, hyphens are minus signs.
troff() { sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^[.']/\\\\\\&&/" -e 's/^$/.PP/'; }

man_rows() {
	local letter name value choices text
	while IFS='|' read -r letter name value choices text; do
		[ -z "$choices" ] || text="$text; one of ${choices// /, }"
		echo .TP
		troff <<<"${letter:+-$letter, }--$name${value:+ $value}" | sed 's/^/.B /'
		troff <<<"$text"
	done
}

print_man() {
	printf '.TH %s 1 2026-11-21 "pmpipe %s" "pmpipe"\n.SH NAME\n%s \\- %s\n' "${me^^}" "$version" "$me" "$(troff <<<"$summary")"
	printf '.SH SYNOPSIS\n.B %s\n[options] %s\n.SH DESCRIPTION\n%s %s.\n' "$me" "$arguments" "$me" "$(troff <<<"$kind")"
	troff <<<"$about"
	printf '.TP\n%s\n%s\n.SH OPTIONS\n' "$arguments" "$(troff <<<"$arguments_text")"
	printf '%s\n%s\n' "$rows" "$common_rows" | man_rows
	printf '.SH EXIT STATUS\n0 fine; 1 data or system; 2 usage; 3 numerics (not finite, not converged, unstable); 130 stopped.\n.SH EXAMPLES\n'
	local text command
	while IFS='|' read -r text command; do
		printf '.TP\n%s\n.EX\n%s\n.EE\n' "$(troff <<<"$text")" "$(troff <<<"$command")"
	done <<<"$examples"
	printf '.SH SEE ALSO\nThe stream and the methods are described in docs/ of the source.\n'
}

print_complete() { printf '%s\n%s\n' "$rows" "$common_rows" | awk -F'|' '{ print "--" $2 ($4 != "" ? " " $4 : "") }'; }

print_and_go() {
	case $1 in
	help) print_help ;;
	man) print_man ;;
	complete) print_complete ;;
	examples) cut -d'|' -f2- <<<"$examples" ;;
	version) echo "$me (pmpipe) $version" ;;
	*) return 0 ;;
	esac
	exit
}

# shellcheck source=lib/shell/nearest.sh
. lib/shell/nearest.sh

unknown() {
	local near='' names
	mapfile -t names < <(print_complete | cut -d' ' -f1)
	[[ $1 != --* ]] || near=$(nearest "$1" "${names[@]}")
	usage "no option '$1' (${near:+did you mean $near? }$me --help lists them)"
}

# take NAME VALUE KIND CHOICES: stores the value if it is valid.
take() {
	local name=$1 value=$2 var=opt_${1//-/_} near
	[[ $value != *[[:cntrl:]]* ]] || usage "option '--$name': a line break, a tab or another control character does not belong there"
	case $3 in
	N) [[ $value =~ ^[0-9]{1,9}$ ]] || usage "option '--$name': '$value' is not a whole number" ;;
	X) [[ $value =~ ^[+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$ ]] || usage "option '--$name': '$value' is not a number from 0 up" ;;
	esac
	# shellcheck disable=SC2086 # the choices are words
	if [[ -n $4 && " $4 " != *" $value "* ]]; then
		near=$(nearest "$value" $4)
		usage "option '--$name': '$value' is none of ${4// /, }${near:+ (did you mean $near?)}"
	fi
	[[ $name != vary ]] || varied+=("$value")
	printf -v "$var" %s "$value"
}

# read_options ARGUMENTS...: sets opt_* and positional.
read_options() {
	local word letter name value choices text given
	positional=() varied=()
	while [ $# != 0 ]; do
		word=$1 given=
		shift
		[ "$word" != -- ] || { positional+=("$@"); break; }
		[[ $word == -?* ]] || { positional+=("$word"); continue; }
		[[ $word != --*=* ]] || { given=${word#*=}; set -- "$given" "$@"; word=${word%%=*} given=1; }
		while IFS='|' read -r letter name value choices text; do
			[ "$word" = "--$name" ] || [ "$word" = "-${letter:--}" ] && break
			name=
		done < <(printf '%s\n%s\n' "$rows" "$common_rows")
		[ -n "$name" ] || unknown "$word"
		if [ -z "$value" ]; then
			[ -z "$given" ] || usage "option '--$name' takes no value"
			print_and_go "$name"
			printf -v "opt_${name//-/_}" %s 1
		else
			[ $# != 0 ] || usage "option '--$name' wants a value"
			take "$name" "$1" "$value" "$choices"
			shift
		fi
	done
	[[ -z ${opt_quiet:-} || -z ${opt_verbose:-} ]] || usage "--quiet and --verbose exclude each other (leave one of them out)"
}
