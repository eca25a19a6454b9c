# PM-10: Kepler orbit, e = 0.9, from the apocentre, by the words. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

period=6.283185307179586477

# orbit STEPS ORBITS SENTENCE: x y of the body at the end; the last frame stays in ./end.
orbit() {
	pinit kepler --dt "$(awk -v n="$1" -v p=$period 'BEGIN { printf "%.17g", p / n }')" |
		OMP_NUM_THREADS=1 cycle -n $(($1 * $2)) "$3" | tee end | stab --plain --set matter |
		awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { printf "%.17g %.17g\n", $c["x"], $c["y"] }'
}

# reaches "X Y" GOT TOLERANCE
reaches() {
	within "${2% *}" "${1% *}" "$3" x && within "${2#* }" "${1#* }" "$3" y
}

kdk='push kick/2 drift | pp | push kick/2'

@test "PM-10: leapfrog, 1000 steps per orbit: the position after 1 and 10 orbits (reference with the same scheme, 1e-8 and 1e-6)" {
	reaches "-1.899890053 0.02043960759" "$(orbit 1000 1 "$kdk")" 1e-8
	reaches "-1.889015833 0.2040059636" "$(orbit 1000 10 "$kdk")" 1e-6
}

@test "PM-10: leapfrog, 4000 steps per orbit, 10 orbits" {
	reaches "-1.899956311 0.01288462278" "$(orbit 4000 10 "$kdk")" 1e-6
}

@test "PM-10: rk4, 1000 steps per orbit, 10 orbits" {
	reaches "-1.889329315 -0.03909421541" "$(orbit 1000 10 'pp | push rk4')" 1e-6
}

@test "PM-10: rk4, 4000 steps per orbit, 10 orbits, has fourth order in position and energy" {
	reaches "-1.899993061 -4.399275757e-05" "$(orbit 4000 10 'pp | push rk4')" 1e-6
	diag --pair --exact <end >t
	within "$(awk -v e="$(column energy <t)" -v exact="$(column exact_energy <t)" 'BEGIN { printf "%.9g", e / exact - 1 }')" 3.465699e-6 3.5e-8 "energy"
}

@test "PM-10: energy error at the end and its maximum, and the rotation of the pericentre, leapfrog with 1000 steps per orbit" {
	pinit kepler | cycle -n 10000 --every 5 "$kdk" | stab --plain --set matter | awk '
		/vx/ { for (i = 1; i <= NF; i++) c[$i] = i; next } NF > 6 {
			x = $c["x"]; y = $c["y"]; u = $c["vx"]; v = $c["vy"]; r = sqrt(x*x + y*y); e = 0.5 * (u*u + v*v) - 1/r
			if (!n++) e0 = e
			d = e / e0 - 1; if (d < 0) d = -d; if (d > worst) worst = d
			l = x * v - y * u; a = atan2(l * u + y / r, -(l * v - x / r)) } # direction of the apocentre
		END { printf "%.17g %.17g %.17g\n", e / e0 - 1, worst, atan2(-sin(a), -cos(a)) }' > out
	read -r end worst turn < out
	within "$end" 6.4e-11 1e-12 "dE/E at the end" # 1 % of the value and round-off of 1e4 steps
	within "$worst" 9.079e-2 9.1e-4 "max dE/E"
	within "$turn" -0.10773086 1e-6 "pericentre"
}
