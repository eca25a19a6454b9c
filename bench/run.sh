#!/usr/bin/env bash
# Where the seconds go that are not physics: the start of a filter, the rate at which it passes on what it does not need, and the share of a
# fused cycle that no stage accounts for; then the measuring programs of this directory. Tab-separated: what, case, value.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$0")/.."
top=$PWD
export PATH=$top/bin:$PATH LC_ALL=C
n=${N:-1000000} # particles of the large cases
scratch=$(mktemp -d /dev/shm/pm-bench-XXXXXX)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# median SECONDS...
median() { printf '%s\n' "$@" | sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

# seconds COMMAND LINE: wall time.
seconds() {
	local t=$EPOCHREALTIME
	bash -o pipefail -c "$1"
	awk -v a="$t" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.6f\n", b - a }'
}

# rate NAME FILE COMMAND LINE: GB/s of the file through it, median of 5.
rate() {
	local t=()
	for _ in 1 2 3 4 5; do t+=("$(seconds "$3")"); done
	awk -v b="$(wc -c <"$2")" -v t="$(median "${t[@]}")" -v n="$1" 'BEGIN { printf "pass-through\t%s\t%.2f GB/s\n", n, b / t / 1e9 }'
}

"$top/build/bench/start"

# poisson-fft reads the density of a small mesh; the particles only pass by.
pinit uniform -n $((4 * n)) --cells 8 | p2m >through.pm
rate "one stage, file to /dev/null" through.pm 'poisson-fft <through.pm >/dev/null'
rate "one stage, pipe to pipe" through.pm 'cat through.pm | poisson-fft | cat >/dev/null'
rate "three stages" through.pm 'poisson-fft <through.pm | mgrad | poisson-fft >/dev/null'
rm through.pm

# A fused cycle: the seconds of its stages, and what is left of the wall clock. The first run makes the plans of the transforms.
pinit uniform -n "$n" >start.pm
sentence='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'
cycle -n 1 "$sentence" <start.pm >/dev/null
for _ in 1 2 3 4 5; do
	rm -f timing.tsv
	cycle -n 10 --timing timing.tsv "$sentence" <start.pm >/dev/null
	awk -F'\t' '/^cycle/ { wall = $3; next } { sum += $3 } END { printf "%.4f %.3f %.3f\n", 1 - sum / wall, sum, wall }' timing.tsv
done | sort -g | sed -n 3p | while read -r share sum wall; do
	printf 'fused cycle\t%s particles, 10 steps\tframework share %s (stages %s s of %s s)\n' "$n" "$share" "$sum" "$wall"
done
awk -F'\t' '!/^cycle/ { printf "fused cycle\t%s\t%.4f s per step\n", $1, $3 / 10 }' timing.tsv

for b in "$top"/build/bench/*; do
	case $b in */start | *.o | *.d) ;; *) "$b" ;; esac
done
