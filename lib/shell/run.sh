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

# why STATUS [FILE]: of the messages of a run, the last that does not merely forward the message of another word: warnings come before it.
why() {
	local line
	line=$(grep -v ': stopped by ' "${2:-$work/said}" | tail -n 1 | tr '\t' ' ')
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

# keep_directory: the directory of -o, never mistaken for an option or an assignment. as_typed ARGUMENTS...: sets command_line.
keep_directory() {
	keep=${opt_output:-}
	[ "$keep" = / ] || keep=${keep%/}
	[[ $keep != *=* && $keep != -* || $keep == /* ]] || keep=./$keep
}
as_typed() {
	command_line=$(printf '%q ' "$me" "$@")
	[[ $* == *"'"* ]] || command_line="$me$(for a; do [[ $a =~ ^[A-Za-z0-9_./:=+-]+$ ]] && printf ' %s' "$a" || printf " '%s'" "$a"; done)"
}

# open_results WHAT KEY RESULT PATTERN: the directory with the log, that of -o or a temporary one. Of another KEY only what has no result yet is replaced:
# a sentence that failed may be corrected. RESULT: the lines of the log that are results, PATTERN: all valid ones.
open_results() {
	work_directory
	state=$work
	if [ -n "$keep" ]; then
		state=$keep/measured
		mkdir -p "$state" 2>/dev/null || fail 1 "cannot make the directory '$keep'"
		if [ -n "${opt_fresh:-}" ]; then rm -f "$state/log" "$state/key"; fi
		if [[ -s $state/key && $(cat "$state/key") != "$2" ]]; then
			! grep -qaE "$3" "$state/log" 2>/dev/null || usage "'$keep' holds another $1 (choose another -o, or --fresh to forget it)"
			rm -f "$state/log"
		fi
		printf '%s\n' "$2" >"$state/key"
	fi
	checked_log "$4"
}
