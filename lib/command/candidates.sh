# shellcheck shell=sh
# pmpipe complete COMMAND WORDS...: what the last of these words may become, a line each, with a tab and a description where there is one. Nothing where
# a file is meant: the shell completes those itself. bash, zsh and fish ask it (lib/command/completion.*), so that they know the same.
# SPDX-License-Identifier: GPL-3.0-or-later

# field_names FILES...: the fields in the headers of the streams that are named on the line; without any those that the laws name.
field_names() {
	any=
	for file; do
		[ -f "$file" ] && [ "$(head -c 7 -- "$file" | tr -d '\0')" = PMPIPE/ ] || continue
		head -c 65536 -- "$file" | tr -d '\0' | grep -aoE '"name": ?"[A-Za-z0-9_.-]+", ?"on"' | sed 's/^"name": *"//; s/".*//'
		any=1
	done
	[ -z "$any" ] || return 0
	for scene in plummer two-stream vortex-pair; do
		"$words/pinit" $scene -n 4 --cells 4 2>/dev/null | "$words/p2m" 2>/dev/null | "$words/poisson-fft" 2>/dev/null |
			"$words/mgrad" 2>/dev/null | "$words/m2p" 2>/dev/null | "$words/sls" 2>/dev/null | awk '/^    / { print $1 }'
	done | sort -u
}

# The rows of a word's help: letter, name, value, sentence.
option_rows() {
	"$words/$1" --help | sed -nE 's/^  (-(.),|   ) --([a-z0-9-]+)( ([A-Z][^ ]*))? +(.*)$/\2|\3|\5|\6/p'
}

choices_of() { "$words/$1" --complete | awk -v want="$2" '$1 == want { for (i = 2; i <= NF; i++) print $i }'; }

# after_option WORD OPTION FILES...: the values it may have.
after_option() {
	word=$1 name=${2#-}
	shift 2
	given=$(option_rows "$word" | awk -F'|' -v n="$name" '$1 == n || "-" $2 == n { print $2 "|" $3; exit }')
	[ -n "$given" ] && [ "${given#*|}" != '' ] || return 1 # a flag, or no option: an argument follows
	list=$(choices_of "$word" "--${given%|*}")
	[ -z "$list" ] || printf '%s\n' "$list"
	[ -n "$list" ] || case $given in *'|EXPRESSION' | field'|'* | drop'|WORD'* | keep'|'*) field_names "$@" ;; esac
}

candidates() {
	word=${1##*/}
	[ $# != 0 ] || return 0
	shift
	if [ "$word" = pmpipe ] && [ $# -le 1 ]; then
		word_rows | cut -f1,3
		printf '%s\n' "help	on a word, a page, kernels ..." "doctor	what is installed and what is missing" "path	the directory of the words" \
			"completion	for bash, zsh or fish"
		return
	elif [ "$word" = pmpipe ]; then
		word=$1
		shift
	fi
	before= now=
	for text; do before=$now now=$text; done
	case $word in
	help)
		find_pages
		word_rows | cut -f1,3
		page_list | sed -E 's/^ *([^ ]+) */\1	/'
		printf '%s\n' words exit kernels scenes
		return
		;;
	completion) printf '%s\n' bash zsh fish && return ;;
	esac
	is_word "$word" || return 0
	case $before in -?*) ! after_option "$word" "$before" "$@" || return 0 ;; esac
	case $now in
	-*) option_rows "$word" | awk -F'|' '{ print "--" $2 "\t" $4 }' ;;
	*) "$words/$word" --complete | awk '$1 !~ /^-/ { for (i = 2; i <= NF; i++) print $i }' ;;
	esac
}

completion_of() {
	case $1 in
	bash | zsh | fish) ;;
	*) fail 2 "completion for which shell: bash, zsh or fish?" ;;
	esac
	for file in "$here/../share/pmpipe" "$words/../../share/pmpipe" "$here/../lib/command"; do
		[ ! -f "$file/completion.$1" ] || exec cat "$file/completion.$1"
	done
	fail 1 "no completion.$1 is installed (it is in lib/command/ of the source)"
}
