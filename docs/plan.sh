#!/usr/bin/env bash
# The table of docs/plan.md: runs of `cycle --plan` at three accuracies, each with its error against what is known of its end. Expected: errors of the order
# of the accuracy or below, but where the mesh of the scene is too coarse, which plan says. PM_LONG=1 adds the shear layer on 256^2.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
PATH=${PM_BIN:-$top/bin}:$PATH
export LC_ALL=C
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
turn=6.283185307179586

# Errors of the frame `end`: against the places at the start; of a cold wave, whose sheets swing each by itself; against a finer run; of the largest vorticity.
difference() { scmp --set "$1" --field "$2" "$3" "$4" | awk -F'\t' 'NR == 2 { printf "%.1e", $8 }'; }
back() { difference "$set" x end start; }
swing() {
	scalc 'v = -0.05*sin(2*pi*(id + 0.5)/4096)*sin(time)' <end >right
	difference electrons v end right
}
finer() {
	[ -s finer ] || cycle -t 1 'pp | push --dt 0.001 rk4' <start >finer
	difference matter x end finer
}
peak() {
	p2m --kernel m6prime <end | diag --exact --columns omega_max | awk -F'\t' 'NR == 2 { e = $1 / $2 - 1; printf "%.1e", e < 0 ? -e : e }'
}

# row NAME ERROR TIME SCENE...
row() {
	printf '| %s ' "$1"
	for a in 0.1 0.01 0.001; do
		pinit "${@:4}" >start
		cycle -t "$3" --plan --accuracy $a <start >end
		printf '| %s ' "$($2)"
	done
	echo '|'
}

echo '| run | 0.1 | 0.01 | 0.001 |'
echo '|---|---|---|---|'
set=matter
row 'kepler, e = 0.9, one turn: place' back $turn kepler
row 'kepler, e = 0.9, ten turns: place' back 62.83185307179586 kepler
row 'kepler, e = 0.99, one turn: place' back $turn kepler --eccentricity 0.99
row 'kepler, e = 0.99, ten turns: place' back 62.83185307179586 kepler --eccentricity 0.99
row 'kepler, e = 0.999, one turn: place' back $turn kepler --eccentricity 0.999
row 'kepler, e = 0.999, ten turns: place' back 62.83185307179586 kepler --eccentricity 0.999
row 'two-body, ten turns: place' back 62.83185307179586 two-body
row 'plummer, 2000 bodies, t = 1: places' finer 1 plummer -n 2000
row 'langmuir, t = 10: velocities' swing 10 langmuir
set=vortices
row 'polygon, one turn: places' back 19.739208802178716 polygon
row 'vortex-pair, one turn: places' back 13.159472534785811 vortex-pair
row 'lamb-oseen, t = 4: peak' peak 4 lamb-oseen
row 'taylor-green-2d, t = 5: peak' peak 5 taylor-green-2d
row 'shear-layer, 128^2, t = 1: peak' peak 1 shear-layer --cells 128
[ -z "${PM_LONG:-}" ] || row 'shear-layer, 256^2, t = 1: peak' peak 1 shear-layer
