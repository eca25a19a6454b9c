#!/usr/bin/env bash
# Runs every sentence of docs/notes/*.md and compares what it prints with the lines below it; says which do not agree, and exits 1 then.
# notes.sh FILE ...: these files, by default all of docs/notes/. --rows FILE ...: a line for every row: file, its IDs one by one, and "sentence" or "none".
# A row is a line that begins with **ID, ID-ID** up to the next one. `    $ ` begins a sentence, the indented lines below it are what it prints. A number agrees
# if it differs by at most one in the last digit that the page prints, an integer if it is equal; `<1e-12` stands for a number of at most this size (rounding);
# `...` at the end of a line for the rest of it.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
export LC_ALL=C

if [ "${1:-}" = --rows ]; then
	shift
	awk 'function out() { if (ids != "") print file "\t" ids "\t" (said ? "sentence" : none ? "none" : "nothing"); ids = said = none = "" }
		FNR == 1 { out(); file = FILENAME; sub(/.*\//, "", file) }
		/^\*\*[A-Za-z]+[0-9, A-Za-z-]*\*\* / { out(); split($0, half, /\*\*/); n = split(half[2], id, /, */)
			for (i = 1; i <= n; i++) if (split(id[i], end, "-") == 2) {
				letters = end[1]; sub(/[0-9]+$/, "", letters); width = length(end[1]) - length(letters)
				for (k = substr(end[1], length(letters) + 1) + 0; k <= substr(end[2], length(letters) + 1) + 0; k++)
					ids = ids sprintf(" %s%0" width "d", letters, k)
			} else ids = ids " " id[i] }
		/none: / { none = 1 }
		/^    \$ / { said = 1 }
		END { out() }' "$@"
	exit
fi
[ $# -gt 0 ] || set -- "$(cd "$(dirname "$0")" && pwd)"/notes/*.md

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
wrong=0 count=0
for page in "$@"; do
	rm -rf "$work/all" && mkdir "$work/all"
	# N/line: where it stands; N/sentence, N/want
	awk -v dir="$work/all" '/^\*\*/ { split($0, half, /\*\*/); row = half[2] }
		/^    \$ / { n++; d = dir "/" sprintf("%04d", n); system("mkdir " d); print FNR ": " row >(d "/line")
			print substr($0, 7) >(d "/sentence"); printf "" >(d "/want"); on = 1
			close(d "/line"); close(d "/sentence"); close(d "/want"); next }
		on && /^    / { print substr($0, 5) >>(d "/want"); close(d "/want"); next }
		{ on = 0 }' "$page"
	for d in "$work"/all/*/; do
		count=$((count + 1))
		(cd "$d" && mkdir here && cd here && timeout -k 1 60 bash ../sentence >../got 2>&1 </dev/null) || true
		awk 'function number(s) { return s ~ /^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$/ }
			function last(s, e) { e = 0; if (match(s, /[eE]/)) { e = substr(s, RSTART + 1) + 0; s = substr(s, 1, RSTART - 1) }
				return 10^(e - (index(s, ".") ? length(s) - index(s, ".") : 0)) * 1.0000001 }
			function agree(w, g, d) {
				if (w ~ /^<[0-9]/ && number(g)) return g + 0 <= substr(w, 2) + 0 && -g <= substr(w, 2) + 0
				if (!number(w) || !number(g)) return w == g
				if (w !~ /[.eE]/) return w + 0 == g + 0
				d = w - g; return (d < 0 ? -d : d) <= last(w)
			}
			{ gsub(/[(),;:=|]/, " & ") }
			FILENAME ~ /want$/ { want[++wants] = $0; next }
			{ gots++; n = split(want[gots], w, /[ \t]+/); m = split($0, g, /[ \t]+/); open = n && w[n] == "..."
				if (gots > wants || (open ? m < n - 1 : n != m)) bad = 1
				for (i = 1; i <= n - open; i++) if (!agree(w[i], g[i])) bad = 1 }
			END { exit bad || wants != gots || !wants }' "$d/want" "$d/got" || { wrong=$((wrong + 1))
			echo "${page##*/}, line $(cat "$d/line"): $(cat "$d/sentence")"
			sed 's/^/  page    /' "$d/want"; head -n 20 "$d/got" | sed 's/^/  printed /'; }
	done
done
echo "$count sentences, $wrong of them do not print what the page says"
[ "$wrong" = 0 ]
