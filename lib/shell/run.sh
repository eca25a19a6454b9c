# shellcheck shell=bash
# Shared by the tools that run sentences: the working directory, the reason of a failure, the log of results, stopping a run. Only the sentence is parsed by
# a shell: values of options, file names and the log are data. SPDX-License-Identifier: GPL-3.0-or-later

# plain_words ARGUMENTS...: sets text to the command as a person would type it; words with special characters are quoted.
plain_words() {
	local a q="'" all=()
	for a; do
		[[ $a =~ ^[A-Za-z0-9_./:=+,@%-]+$ ]] || a="'${a//"$q"/"'\\''"}'"
		all+=("$a")
	done
	text="${all[*]}"
}

# gnuplot_text TEXT: as a single-quoted gnuplot string; in double-quoted ones gnuplot runs the text between backquotes.
gnuplot_text() {
	local q="'"
	printf "'%s'" "${1//"$q"/"$q$q"}"
}

# own_directory: where this program is, and the other words beside it; they come first on PATH, because other packages have words of our names.
own_directory() { dirname "$(readlink -f -- "$(command -v -- "$0")")"; }

# work_directory: sets work to an absolute path, which neither awk nor a program can mistake for an option or an assignment.
work_directory() {
	work=$(cd -- "${TMPDIR:-/tmp}" 2>/dev/null && mktemp -d "${PWD%/}/$me.XXXXXX") && return
	work=
	fail 1 "cannot make a directory in '${TMPDIR:-/tmp}' (TMPDIR names another place)"
}

# checked_log PATTERN: reports and drops invalid lines of the log, which may come from elsewhere or be truncated by a full disk.
checked_log() {
	touch -- "$state/log"
	grep -qavE "$1" -- "$state/log" || return 0
	tell "$(grep -cavE "$1" -- "$state/log") lines of '$state/log' are no results of $me and are left out"
	{ grep -aE "$1" -- "$state/log" || true; } >"$work/log"
	cat -- "$work/log" >"$state/log"
}

# why STATUS [FILE]: of the messages of a run, the first that does not merely forward the message of another word.
why() {
	local line
	line=$(grep -v ': stopped by ' "${2:-$work/said}" | head -n 1 | tr '\t' ' ')
	line=${line#bash: line 1: }
	echo "${line:-exit status $1, without a word}"
}

note() { printf '%s\n' "$1" >>"$state/log"; }

# in_place TEXT: rewrites the line on the terminal, cut to its width, beyond which it would not be rewritten but repeated.
in_place() {
	local width=80 said
	said=$(stty size <&2 2>/dev/null) && [ "${said#* }" -gt 1 ] && width=${said#* }
	printf '\r%.*s\033[K' $((width - 1)) "$1" >&2
}

# Stops the running processes (child, or the process groups that are the keys of children), reports the progress, keeps the log.
stop() {
	local c
	trap '' INT TERM
	for c in $child "${!children[@]}"; do kill -TERM -- "-$c" 2>/dev/null || true; done
	[ ! -t 2 ] || printf '\r\033[K' >&2
	echo "$me: stopped; ${doing:-nothing measured yet}${keep:+; the same command goes on from here}" >&2
	exit 130
}
