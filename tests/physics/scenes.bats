# Orbits of the scenes against the reference. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# errors TABLE: the energy error of every row against the exact one.
errors() { awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { printf "%.17g\n", $c["energy"] / $c["exact_energy"] - 1 }' "$1"; }

# kepler ORBITS STEPS SENTENCE: the body at the end as "x y" (centre of body and sun, times two).
kepler() {
	export OMP_NUM_THREADS=1
	pinit kepler --dt "$(awk -v n="$2" 'BEGIN { printf "%.17g", 8 * atan2(1, 1) / n }')" |
		cycle -n $(($1 * $2)) "$3" |
		diag --pair --exact > end
	awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { printf "%.17g %.17g\n", 2 * $c["centre_x"], 2 * $c["centre_y"] }' end
}

# 10 orbits and the other schemes: kepler.bats.
@test "PM-10: leapfrog, 1 orbit of 1000 steps, ends where the same scheme ends" {
	read -r x y <<<"$(kepler 1 1000 'push kick/2 drift | pp | push kick/2')"
	within "$x" -1.899890053 1e-8
	within "$y" 0.02043960759 1e-8
	below "$(errors end)" 1e-11 # 7.4e-13, by rounding
}

@test "HC-17: over 100 orbits of e = 0.9 the energy at the apocentre is constant to 1e-8 without a trend, and the pericentre rotates uniformly" {
	orbits=100
	[ -z "${PM_LONG:-}" ] || orbits=1000
	sh_ok "export OMP_NUM_THREADS=1; pinit kepler | cycle -n $((1000 * orbits)) --every 1000 'push kick/2 drift | pp | push kick/2' |
		diag --pair --exact > t"
	[ "$(wc -l < t)" = $((orbits + 2)) ]
	# largest error, and the ratio of its means in the last and first tenth, which a trend would increase
	errors t | awk -v n=$orbits '{ d = $1 < 0 ? -$1 : $1; if (d > m) m = d } NR <= n / 2 { a += $1 } NR > n / 2 { b += $1 } END { d = (b - a) / (n / 2);
		if (d < 0) d = -d; exit !(m < 1e-8 && d < m) }'
	# -1.0773e-2 rad an orbit, 1 %, from the Laplace vector of the last frame
	turn=$(awk -F'\t' -v n=$orbits 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
		{ x = 2 * $c["centre_x"]; y = 2 * $c["centre_y"]; vx = $c["momentum_x"]; vy = $c["momentum_y"]; l = x * vy - y * vx; r = sqrt(x * x + y * y)
		  a = atan2(-vx * l - y / r, vy * l - x / r); if (NR > 2) { d = a - last; pi = atan2(0, -1); d -= d > pi ? 2 * pi : d < -pi ? -2 * pi : 0;
		  	sum += d } last = a }
		END { printf "%.17g", sum / n }' t)
	within "$turn" -1.0773e-2 1.1e-4
}

@test "two bodies return after a period, with an error that falls as dt^2" {
	errors=()
	for k in 200 400 800; do
		sh_ok "pinit two-body --eccentricity 0.3 --ratio 3 --dt $(awk \
			"BEGIN { printf \"%.17g\", 8 * atan2(1, 1) / $k }") | cycle -n $k 'push kick/2 drift | pp | push kick/2' |
			stab --plain > t"
		errors+=("$k" "$(awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { x[NR] = $c["x"]; y[NR] = $c["y"] } END { dx = x[3] - x[2] + 1.3;
			dy = y[3] - y[2]; print 1 / sqrt(dx * dx + dy * dy) }' t)")
	done
	order 2 "${errors[@]}" # the inverse of the error against the number of steps
}

@test "a uniform box with a Maxwellian has the temperature given" {
	sh_ok "pinit uniform -n 20000 --dispersion 0.3 | diag --exact > t"
	# variance of the kinetic energy of 60000 components: sqrt(2/60000) = 0.6 %; three of them
	within "$(column energy_kinetic < t)" "$(column exact_energy_kinetic < t)" "$(awk -v e="$(column exact_energy_kinetic < t)" \
		'BEGIN { print 0.018 * e }')"
}

@test "HC-15: a cold lattice is at rest at the start, and every spacing of whole cells fills its box" {
	for o in "--spacing 2 -n 5832" "--spacing 3 -n 512" "--spacing 1.5 -n 5832" "--spacing 2 --dim 1 -n 18" "--spacing 1 --dim 2 -n 49"; do
		sh_ok "pinit lattice $o | diag --exact --columns mass,speed_rms > t"
		within "$(column mass < t)" "$(column exact_mass < t)" 1e-9
		[ "$(column speed_rms < t)" = 0 ]
	done
}
