#!/usr/bin/env bash
# Two tables of docs/plan.md: what a cold lattice does on a mesh, and what encounters of many bodies leave of a leapfrog. Errors are the same in every run, of
# which there are 70: a minute. SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
PATH=${PM_BIN:-$top/bin}:$PATH
export LC_ALL=C
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# lattice KERNEL A CELLS N TIME...: sheets of a cold wave swing each by itself; the rms of the velocities' error over that of the wave, A/sqrt 2.
lattice() {
	local kernel=$1 A=$2 cells=$3 n=$4 T
	pinit langmuir -n "$n" --cells "$cells" --amplitude "$A" >start
	printf '| %s | %s, %s, %s ' "$kernel" "$A" "$cells" "$(awk "BEGIN { printf \"%.3g\", $n / $cells }")"
	for T in "${@:5}"; do
		cycle -t "$T" "p2m --kernel $kernel | poisson-fft --symbol spectral | mgrad --order spectral | m2p | push --dt 0.1 rk4" <start >end 2>/dev/null
		scalc "v = -$A*sin(2*pi*(id + 0.5)/$n)*sin(time)" <end >right
		printf '| %.1e ' "$(scmp --set electrons --field v end right | awk -F'\t' -v A="$A" 'NR == 2 { print $6 / A * sqrt(2) }')"
	done
	echo '|'
}

# encounter TIME SCENE...: of velocities, l2, with dt = C/sqrt(2 G m/softening^3), against C = 0.02.
encounter() {
	local T=$1 rate C
	shift
	pinit "$@" >start
	rate=$(awk -v n="$3" -v eps="$5" 'BEGIN { printf "%.17g", sqrt(2 / n / eps ^ 3) }')
	printf '| %s, t = %s ' "$*" "$T"
	for C in 0.02 0.06 0.2 0.6 2; do
		cycle -t "$T" "push --dt $(awk "BEGIN { printf \"%.17g\", $C / $rate }") kick/2 drift | pp | push kick/2" <start >end 2>/dev/null
		[ $C != 0.02 ] || { cp end right; continue; }
		printf '| %.1e ' "$(scmp --set matter --field v end right | awk -F'\t' 'NR == 2 { print $8 }')"
	done
	echo '|'
}

echo '| kernel | A, cells, n | 5 | 20 | 40 | 60 | 100 |'
echo '|---|---|---|---|---|---|---|'
for kernel in cic tsc m6prime lambda-6-4; do
	lattice $kernel 0.05 64 4096 5 20 40 60 100
done
lattice lambda-6-4 0.05 64 1000 5 20 40 60 100
lattice lambda-6-4 0.02 64 541 5 20 40 60 100
echo
echo '| scene | 0.06 | 0.2 | 0.6 | 2 |'
echo '|---|---|---|---|---|'
encounter 0.421 plummer -n 102 --softening 0.0219 --seed 228
encounter 3.62 plummer -n 487 --softening 0.00871 --seed 281
encounter 1.06 plummer -n 677 --softening 0.00341 --seed 224
encounter 2.5 plummer -n 1040 --softening 0.00589 --seed 288
encounter 0.464 cold-sphere -n 88 --softening 0.00529 --seed 974
encounter 0.309 cold-sphere -n 172 --softening 0.00803 --seed 428
encounter 0.57 cold-sphere -n 968 --softening 0.00518 --seed 400
