#!/usr/bin/env bash
# The outer solar system over 1000 years from real positions (data/solar-system.tsv), by direct summation; leapfrog, then one word swapped for rk4.
# Law: gravity, G = 0.01720209895^2 AU^3/(solar mass day^2), no softening, steps of 50 days.
# Expected: sidereal periods of 11.862, 29.457, 84.01, 164.79 and 247.94 years (NASA planetary fact sheets, in Julian years; the planets'
# pull on each other moves the mean over 1000 years by up to 0.5 %). Leapfrog's energy error oscillates, up to 2e-4, and its phases lag by (w dt)^2/3, 0.18 %
# for Jupiter; that of rk4 accumulates, to 3e-5 in 1000 years.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
# shellcheck source=pipelines/numbers.sh
. "$(dirname "$0")/numbers.sh"
export OMP_NUM_THREADS=1 # too small for threads
years=${YEARS:-1000}
dt=50 # days
every=10
steps=$(calc "int($years * 365.25 / $dt)")
gauss=$(calc "0.01720209895 ^ 2")

stab "$top/data/solar-system.tsv" --law gravity --constant "G=$gauss,softening=0" --dt $dt >"$work/start"

# Mean orbital period of each planet over complete orbits; the input has one row per planet and frame.
periods() {
	stab --plain |
		awk -F'\t' -v dt=$((every * dt)) 'BEGIN { pi = atan2(0, -1) }
			NF < 2 { next }
			/name/ { for (i = 1; i <= NF; i++) c[$i] = i; frame++; next }
			{ name = $c["name"] }
			name == "sun" { sx = $c["x"]; sy = $c["y"]; next }
			{ a = atan2($c["y"] - sy, $c["x"] - sx)
			  if (name in last) {
				step = a - last[name]; step -= step > pi ? 2 * pi : step < -pi ? -2 * pi : 0
				before = turned[name]; turned[name] += step
				while (turned[name] >= 2 * pi * (turns[name] + 1)) {
					turns[name]++; when[name] = frame - 2 + (2 * pi * turns[name] - before) / step } }
			  last[name] = a }
			END { for (n in turns) printf "%s %.17g\n", n, when[n] * dt / 365.25 / turns[n] }'
}

report() {
	echo "$1, $years years"
	for row in "jupiter 11.862" "saturn 29.457" "uranus 84.01" "neptune 164.79" "pluto 247.94"; do
		read -r planet want <<<"$row"
		is "period of $planet [years]" "$(awk -v p="$planet" '$1 == p { print $2 }' "$work/periods")" "$want" "$(calc "0.005 * $want")"
	done
	is "energy error, largest" "$(awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "energy") c = i; next } NR == 2 { e = $c } { d = $c / e - 1;
		if (d < 0) d = -d; if (d > m) m = d } END { print m }' "$work/table")" 0 "$2"
	is "momentum over its scale" "$(calc "$(column momentum_x last "$work/table") / $(column momentum_scale last "$work/table")")" \
		"$(calc "$(column momentum_x 1 "$work/table") / $(column momentum_scale 1 "$work/table")")" 1e-12
}

cycle -n "$steps" --every $every 'push kick/2 drift | pp | push kick/2' <"$work/start" |
	diag --pair --tee "$work/table" |
	periods >"$work/periods"
report leapfrog 3e-4

cycle -n "$steps" --every $every 'pp | push rk4' <"$work/start" |
	diag --pair --tee "$work/table" |
	periods >"$work/periods"
report rk4 4e-5
finish
