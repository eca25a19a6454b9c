# shellcheck shell=sh
# pmpipe: the list of words, and help on a word, a page, the choices of an option or the exit status, all from the words' own help and the pages in docs/.
# SPDX-License-Identifier: GPL-3.0-or-later

all_help() {
	for word in $(word_list); do
		printf '\001%s\n' "$word"
		"$words/$word" --help
	done
}

# Every word with its kind and its summary, tab-separated.
word_rows() {
	all_help | awk '/^\001/ { name = substr($0, 2); n = 0; next } { n++ }
		n == 1 { summary = substr($0, length(name) + 3) }
		n == 4 { print name "\t" substr($0, length(name) + 2) "\t" summary }'
}

list_words() {
	printf 'pmpipe %s: particle methods as words of a shell sentence.\n' "$version"
	word_rows | awk -F'\t' '{ k = $2; sub(/\.$/, "", k)
		if (!(k in lines)) { kinds[++n] = k; rank[k] = k ~ /^makes/ ? 1 : k ~ /writes one/ ? 2 : k ~ /^reads/ ? 3 : 4 }
		lines[k] = lines[k] sprintf("  %-14s %s\n", $1, $3) }
		END { for (r = 1; r <= 4; r++) for (i = 1; i <= n; i++) if (rank[kinds[i]] == r) printf "\n%s:\n%s", kinds[i], lines[kinds[i]] }'
	cat <<-'END'

		pmpipe WORD ...        runs a word, as WORD ... does where the words are on PATH
		pmpipe help TOPIC      a word, a page, kernels, scenes ...; pmpipe help lists the topics
		pmpipe doctor          what is installed, what is missing, threads, processor, caches
		pmpipe path            the directory of the words: PATH=$(pmpipe path):$PATH
		pmpipe completion SH   completion for bash, zsh or fish: eval "$(pmpipe completion bash)"
	END
}

# The pages: PREFIX/share/doc/pmpipe or docs/ of the tree.
find_pages() {
	for pages in "$here/../share/doc/pmpipe" "$here/../docs" "$words/../../share/doc/pmpipe"; do
		[ ! -d "$pages/methods" ] || return 0
	done
	fail 1 "no pages here: share/doc/pmpipe is not installed (they are in docs/ of the source)"
}

# What can be chosen from a list: the word, the option or argument as typed, its name, the list; tab-separated.
choice_rows() {
	for word in $(word_list); do
		"$words/$word" --complete | awk -v word="$word" 'NF > 1 { name = tolower($1); gsub(/^--|\.\.\.$/, "", name)
			text = $2; for (i = 3; i <= NF; i++) text = text ", " $i; print word "\t" $1 "\t" name "\t" text }'
	done
}

# choices NAME: who chooses from such a list, and the list: kernels are what --kernel takes, scenes what pinit takes.
choices() {
	choice_rows | WANT=$1 awk -F'\t' 'BEGIN { want = ENVIRON["WANT"] } $3 != want && $3 "s" != want { next }
		!($4 in by) { order[++n] = $4 } { by[$4] = by[$4] (by[$4] == "" ? "" : ", ") $1 " " $2 }
		END { for (i = 1; i <= n; i++) print by[order[i]] ":\n  " order[i]; exit !n }'
}

page_list() {
	for page in "$pages"/*.md "$pages"/methods/*.md; do
		[ -f "$page" ] || continue
		name=${page##*/}
		printf '  %-18s %s\n' "${name%.md}" "$(sed -n 's/^# //p' "$page" | head -n 1)"
	done
}

show() {
	if [ -t 1 ] && command -v less >/dev/null; then
		less -FRX "$1"
	else
		cat "$1"
	fi
}

topics() {
	printf 'pmpipe help TOPIC, where TOPIC is\n\na word (its --help), words (all of them), exit (exit status),\n'
	printf 'or what is chosen from a list (kernel or kernels, scenes, laws ...):\n'
	choice_rows | cut -f3 | sort -u | tr '\n' ' ' | fold -s -w 78 | sed 's/^/  /'
	find_pages
	printf '\n\nor a page (NAME.md where a word has the same name):\n'
	page_list
}

help_on() {
	topic=${1-}
	case $topic in
	'') topics && return ;;
	words) list_words && return ;;
	exit | exit-status | exit-codes) "$words/pinit" --man | sed -n '/^\.SH EXIT STATUS/,/^\.SH/{/^\.SH/d;s/; /\n/g;p;}' && return ;;
	*/* | .*) no_topic "$topic" ;;
	esac
	if is_word "$topic"; then
		"$words/$topic" --help
		return
	fi
	found=
	! choices "$topic" || found=1
	find_pages
	for page in "$pages/${topic%.md}.md" "$pages/methods/${topic%.md}.md"; do
		[ -f "$page" ] || continue
		[ -z "$found" ] || echo
		show "$page"
		found=1
	done
	[ -n "$found" ] || no_topic "$topic"
}

no_topic() {
	find_pages
	# shellcheck disable=SC2046,SC2086 # one word each
	near=$(nearest "$1" words exit kernels scenes $(word_list) $(page_list | awk '{ print $1 }'))
	fail 2 "no topic '$1' (${near:+did you mean $near? }pmpipe help lists them)"
}

print_man() {
	printf '.TH PMPIPE 1 2026-11-22 "pmpipe %s" "pmpipe"\n.SH NAME\npmpipe \\- particle methods as words of a shell sentence\n' "$version"
	printf '.SH SYNOPSIS\n.B pmpipe\n[WORD [arguments]]\n.SH DESCRIPTION\nRuns a word. Without one, lists them:\n.nf\n'
	list_words | sed -e 1d -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^[.']/\\\\\&&/" -e 's/^$/.sp/'
	printf '.fi\n.SH EXIT STATUS\nThat of the word; 2 where there is none of that name.\n'
	printf '.SH SEE ALSO\nThe page of a word is pmpipe\\-WORD(1); pmpipe help lists further pages.\n'
}
