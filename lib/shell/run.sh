# shellcheck shell=bash
# What the tools that run sentences share: why one failed, the log of what is known, how a run is stopped. SPDX-License-Identifier: GPL-3.0-or-later

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
