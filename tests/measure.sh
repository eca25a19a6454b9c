#!/usr/bin/env bash
# The size of the code: lines per directory, the longest files and functions, and the distribution of function lengths (goals: most under 20
# lines, nine in ten under 50). A function extends from an opening brace to the next brace in column 0.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$0")/.."
mapfile -t code < <(find lib tools -name '*.c' | sort)
echo "lines  files  directory"
for d in lib/* tools pipelines tests/unit tests/tool tests/physics tests/hard bench docs docs/methods; do
	mapfile -t f < <(find "$d" -maxdepth 1 -type f 2>/dev/null | grep -E '\.(c|h|sh|bats|py|md|bash)$' | sort)
	[ ${#f[@]} = 0 ] || printf '%5d  %5d  %s\n' "$(cat "${f[@]}" | wc -l)" ${#f[@]} "$d"
done
echo
echo "longest files"
wc -l "${code[@]}" | grep -v ' total$' | sort -rn | head -n 8
echo
functions=$(awk 'FNR == 1 { open = 0 } /^[a-z].*\)$/ { name = $0 } /^\{/ { open = FNR } /^\}/ && open { print FNR - open - 1, FILENAME, name;
	open = 0 }' "${code[@]}" | sort -rn)
echo "longest functions"
sed -E 's/^([0-9]+) ([^ ]+) .*[ *]([a-z_0-9]+)\(.*/\1 \2 \3/' <<<"$functions" | head -n 12
awk '{ v[NR] = $1 } END { if (NR) printf "\n%d functions: median %d lines, 90th percentile %d, longest %d\n", NR, v[int((NR + 1) / 2)], v[int(NR / 10) + 1],
	v[1] }' <<<"$functions"
