#!/bin/sh
# pmpipe: all words behind one name. `pmpipe WORD ...` runs a word, `pmpipe` lists them; help, doctor, path, completion. What it says of the words it takes from
# them; the Makefile inserts the files it reads from lib/, and what was built. Starts in 2 ms.
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
version='@VERSION@'
own='help doctor path completion'

fail() {
	status=$1
	shift
	printf 'pmpipe: %s\n' "$*" >&2
	exit "$status"
}

# The words: PREFIX/libexec/pmpipe beside PREFIX/bin, or the directory of this file in a tree that was built.
find_words() {
	here=$(readlink -f -- "$0") && here=${here%/*}
	words=$here
	[ ! -x "$here/../libexec/pmpipe/pinit" ] || words=$(readlink -f "$here/../libexec/pmpipe")
	[ -x "$words/pinit" ] || fail 1 "no words in '$here/../libexec/pmpipe' or '$here' (make install puts them there)"
}

# is_word NAME: a program in that directory, not this one.
is_word() {
	case $1 in '' | pmpipe | -* | .* | */*) return 1 ;; esac
	[ -f "$words/$1" ] && [ -x "$words/$1" ]
}

word_list() {
	for program in "$words"/*; do
		! is_word "${program##*/}" || printf '%s\n' "${program##*/}"
	done
}

find_words
if is_word "${1-}"; then
	program=$words/$1
	shift
	exec "$program" "$@"
fi

# shellcheck source=lib/shell/nearest.sh
. lib/shell/nearest.sh
# shellcheck source=lib/command/topics.sh
. lib/command/topics.sh
# shellcheck source=lib/command/doctor.sh
. lib/command/doctor.sh
# shellcheck source=lib/command/candidates.sh
. lib/command/candidates.sh

no_word() {
	# shellcheck disable=SC2046,SC2086 # one word each
	near=$(nearest "$1" $own $(word_list))
	fail 2 "no word '$1' (${near:+did you mean $near? }pmpipe alone lists them)"
}

command=${1-}
[ $# = 0 ] || shift
case $command in
'' | words) list_words ;;
help | -h | --help) help_on "$@" ;;
doctor) doctor "$@" ;;
path) printf '%s\n' "$words" ;;
completion) completion_of "${1-}" ;;
complete) candidates "$@" ;; # COMMAND LINE: for the shells
--man) print_man ;;
--version) printf 'pmpipe %s\n' "$version" ;;
*) no_word "$command" ;;
esac
