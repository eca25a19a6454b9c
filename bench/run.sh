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
/usr/bin/env time -f 'pass-through	peak memory	%M kB' true 2>/dev/null || true
rm through.pm

# A fused cycle: 1 - sum of the stages' seconds / wall.
pinit uniform -n "$n" >start.pm
cycle -n 5 --timing timing.tsv 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' <start.pm >/dev/null
cat timing.tsv

for b in "$top"/build/bench/*; do
	case $b in */start | *.o | *.d) ;; *) "$b" ;; esac
done
