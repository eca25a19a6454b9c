# shellcheck shell=bash
# What the tools that run sentences share: a directory to work in, why a sentence failed, the log of what is known, how a run is stopped. A shell parses the
# sentence and nothing else: values of options, names of files and the log are data. SPDX-License-Identifier: GPL-3.0-or-later

# plain_words ARGUMENTS...: sets text to the command as a person would type it; a word with other signs is put between quotes.
plain_words() {
	local a q="'" all=()
	for a; do
		[[ $a =~ ^[A-Za-z0-9_./:=+,@%-]+$ ]] || a="'${a//"$q"/"'\\''"}'"
		all+=("$a")
	done
	text="${all[*]}"
}

# gnuplot_text TEXT: as a string of gnuplot, which runs what stands between backquotes in its other kind of string.
gnuplot_text() {
	local q="'"
	printf "'%s'" "${1//"$q"/"$q$q"}"
}

# work_directory: sets work, by its whole path: neither awk nor a program may take it for an option or an assignment.
work_directory() {
	work=$(cd -- "${TMPDIR:-/tmp}" 2>/dev/null && mktemp -d "${PWD%/}/$me.XXXXXX") || { work=; fail 1 "cannot make a directory in '${TMPDIR:-/tmp}' (TMPDIR names another place)"; }
}

# checked_log PATTERN: lines of the log that are no results are said and left out; it may come from somebody else, or end where a disk was full.
checked_log() {
	touch -- "$state/log"
	grep -qavE "$1" -- "$state/log" || return 0
	echo "$me: $(grep -cavE "$1" -- "$state/log") lines of '$state/log' are no results of $me and are left out" >&2
	{ grep -aE "$1" -- "$state/log" || true; } >"$work/log"
	cat -- "$work/log" >"$state/log"
}

# why STATUS [FILE]: of what a run said, the first line that does not only pass on what another said.
why() {
	local line
	line=$(grep -v ': stopped by ' "${2:-$work/said}" | head -n 1 | tr '\t' ' ')
	line=${line#bash: line 1: }
	echo "${line:-exit status $1, without a word}"
}

note() { printf '%s\n' "$1" >>"$state/log"; }

# Stops what runs (child, or the groups whose numbers are the keys of children), says how far it came, leaves the log.
stop() {
	local c
	trap '' INT TERM
	for c in $child "${!children[@]}"; do kill -TERM -- "-$c" 2>/dev/null || true; done
	[ ! -t 2 ] || printf '\r\033[K' >&2
	echo "$me: stopped; ${doing:-nothing measured yet}${keep:+; the same command goes on from here}" >&2
	exit 130
}
