# HC-17 by the words, 12 orbits of the 1000 (all 1000 are in tests/unit/step.c, where a step costs no frame).
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# watch: |dE/E| and the turn of the apsis at every passage of the apocentre.
watch() {
	awk '/vx/ { for (i = 1; i <= NF; i++) c[$i] = i; next } NF > 6 {
		x = $c["x"]; y = $c["y"]; u = $c["vx"]; v = $c["vy"]; r = sqrt(x*x + y*y); e = 0.5 * (u*u + v*v) - 1/r; l = x * v - y * u
		a = atan2(l * u + y / r, -(l * v - x / r)); now = x * u + y * v
		if (!n++) { e0 = e; a0 = a }
		if (last > 0 && now <= 0) { k++; d = e / e0 - 1; d = d < 0 ? -d : d; turn = atan2(sin(a - a0), cos(a - a0)); printf "%d %.6g %.8g\n", k, d, turn / k }
		last = now }'
}

@test "HC-17: leapfrog on e = 0.9, 1000 steps per orbit: |dE/E| at the apocentre below 1e-8, precession -1.0773e-2 rad per orbit within 1 %" {
	pinit kepler | cycle -n 12500 --every 5 'push kick/2 drift | pp | push kick/2' | stab --plain --set matter | watch > out
	[ "$(wc -l < out)" -ge 12 ]
	awk '$2 > m { m = $2 } END { exit !(m < 1e-8) }' out
	within "$(tail -n 1 out | cut -d' ' -f3)" -1.0773e-2 1.08e-4
}

@test "HC-17: a kick and a drift that are out of step cannot pass: the second drift of a step exits 1" {
	run -1 bash -o pipefail -c "pinit kepler | cycle -n 3 'push kick/2 drift | pp' > /dev/null"
	[[ $output == *"drift on 'matter' adds up to 2 of a step"* ]]
	run -1 bash -o pipefail -c "pinit kepler | cycle -n 3 'pp | push kick/2 drift | pp | push kick' > /dev/null"
	[[ $output == *"kick on 'matter' adds up to 1.5 of a step"* ]]
}
