# Hard cases of remeshing and diffusion through the words: a thousand remeshes (HC-41), steps (HC-43), the limit of explicit diffusion (HC-44), and
# the waves of RM-01. The same on arrays, for every kernel: tests/unit/remesh.c. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# line CELLS EXPRESSION VX: strengths on the nodes of a periodic line, all with the same velocity (uniform, so that remesh keeps it).
line() {
	awk -v n="$1" 'BEGIN { pi = atan2(0, -1); print "x vx mass"; for (i = 0; i < n; i++) printf "%.17g 9 %.17g\n", i / n, ('"$2"') }' |
		stab - --box 0,1 -n "$1" --faces periodic --particle-faces periodic --dt 1 | stab |
			sed '1s/"name":"v",/&"uniform":['"$3"'],/; s/\tvx$//; s/\tvx\t/\t/; s/\t9$//; s/\t9\t/\t/' | stab -
}
masses() { stab --plain | column mass; }

@test "HC-41: a constant remeshed 1000 times stays constant, and so does its sum" {
	for kernel in cic m4prime m6prime lambda-6-4 lambda-6-6; do
		# 33 nodes, 0.377 of a cell per step: all fractions of a cell differ
		line 33 2.385 0.011424242424242424 | cycle -n 1000 "push drift | remesh --kernel $kernel" | masses >a
		[ "$(wc -l <a)" = 33 ]
		below "$(awk '{ d = $1 / 2.385 - 1; if (d < 0) d = -d; if (d > m) m = d } END { printf "%.9g",
			m }' a)" 3.2e-11 "$kernel, constant" # 1e-12 sqrt(1000)
		below "$(awk '{ s += $1 } END { printf "%.9g", s / (33 * 2.385) - 1 }' a)" 1e-13 "$kernel, sum"
	done
}

@test "HC-43: a unit step remeshed at its worst shift overshoots by 2/27 for m4prime, 0.10157 for m6prime, 0 for cic, tsc, pcs" {
	# the worst shifts: 1/3 (exact for M'4) and .342154 (of M6*, from its weights)
	for case in "m4prime 0.33333333333333333 0.074074074074 1e-10" "m6prime 0.342154 0.10156766 1e-6" "cic 0.37 0 1e-14" "tsc 0.37 0 1e-14" \
		"pcs 0.37 0 1e-14"; do
		read -r kernel shift want tolerance <<<"$case"
		line 32 '(i >= 16) + 1e-300' "$(awk -v s="$shift" 'BEGIN { printf "%.17g", s / 32 }')" | push drift | remesh --kernel "$kernel" | masses >a
		within "$(awk '$1 - 1 > m { m = $1 - 1 } END { printf "%.12g", m }' a)" "$want" "$tolerance" "$kernel above"
		within "$(awk '0 - $1 > m { m = 0 - $1 } END { printf "%.12g", m }' a)" "$want" "$tolerance" "$kernel below"
	done
}

@test "RM-01: the amplitude of a wave of 16 cells after 100 remeshings at shifts of 0.3 h" {
	for case in cic:0.1969824138 pcs:0.07618229684 m4prime:0.9619883394 lambda-2-2:0.9660087992 m6prime:0.9988947768 lambda-6-4:0.9999672286; do
		line 32 'cos(4 * pi * i / n)' 0.009375 | cycle -n 100 "push drift | remesh --kernel ${case%:*}" | masses |
			awk 'BEGIN { k = 4 * atan2(0, -1) / 32 } { c += $1 * cos(k * (NR - 1)) / 16; s += $1 * sin(k * (NR - 1)) / 16 } END {
				printf "%.12g\n", sqrt(c * c + s * s) }' >a
		within "$(cat a)" "${case#*:}" 1e-9 "${case%:*}"
	done
}

# noise CELLS: white noise (too weak to move anything) on a periodic lattice with nu = 0.1.
noise() {
	awk -v n="$1" 'BEGIN { srand(3); print "x y circulation volume"; for (j = 0; j < n; j++) for (i = 0; i < n; i++) printf "%.17g %.17g %.17g %.17g\n",
		i / n, j / n, 1e-9 * (rand() - 0.5), 1 / n / n }' |
		stab - --law vortex --box 0,1 -n "$1" --faces periodic --particle-faces periodic --constant nu=0.1
}
largest() { stab --plain | column circulation | awk '{ c = $1 < 0 ? -$1 : $1; if (c > m) m = c } END { print m }'; }

@test "HC-44: explicit diffusion decays at 0.98 of its limit; at 1.02 push refuses (exit 3), and --unsafe shows why" {
	noise 16 >a
	# nu dt/h^2 = 0.25 for euler and differences of order 2; other orders and schemes by their eigenvalues and real limits
	for case in euler:2:8:2 euler:4:32/3:2 euler:spectral:2*9.869604401089358:2 rk4:2:8:2.785293563405282 lsrk3:2:8:2.512745326618329 rk2:6:544/45:2; do
		IFS=: read -r scheme order eigenvalue limit <<<"$case"
		at() { awk -v f="$1" "BEGIN { printf \"%.15g\", f * $limit / (0.1 * 256 * $eigenvalue) }"; }
		s="p2m | poisson-fft | mgrad | diffuse --order $order | m2p | push $scheme"
		cycle -n 30 "$s --dt $(at 0.98)" <a | largest >below
		run -3 bash -o pipefail -c "cycle -n 30 '$s --dt $(at 1.02)' <a | sls"
		[[ $output =~ "is 1.02 times the limit of $scheme: 'dcirculation' of 'matter' (diffusion) decays at up to" ]]
		cycle -n 250 "$s --unsafe --dt $(at 1.02)" <a | largest >beyond
		below "$(cat below)" 0.5e-9 "$case, at 0.98" \
			# relative to the start; its smooth waves decay at once, those at the edge of the spectrum by 0.96^30 = 0.3
		above "$(cat beyond)" 5e-9 "$case, at 1.02" # 1.04^250 = 18000 times the part at the edge of the spectrum, a thousandth or more
	done
}

@test "HC-44: in the plane that limit is nu dt/h^2 = 0.25" {
	noise 16 >a
	s='p2m | poisson-fft | mgrad | diffuse --order 2 | m2p | push euler --dt'
	sh_ok "cycle -n 1 '$s $(awk 'BEGIN { printf "%.15g", 0.24999 / 25.6 }')' <a | sls"
	run -3 bash -o pipefail -c "cycle -n 1 '$s $(awk 'BEGIN { printf "%.15g", 0.25001 / 25.6 }')' <a | sls"
	[[ $output =~ "dt up to "([0-9.e-]+) ]]
	within "$(awk -v dt="${BASH_REMATCH[1]}" 'BEGIN { printf "%.9g", 25.6 * dt }')" 0.25 1e-6 "limit" # six digits of dt
}

@test "HC-57: a disc wound up and unwound by a vortex (T = 8) on 64^2: sum to 1e-12; area lost: cic, pcs 100 %, m4prime 31 %, m6prime less" {
	# LS-02: the signed distance, carried as a strength and remeshed every step; without reinitialisation
	awk -v n=64 'BEGIN { print "x y level"; for (j = 0; j < n; j++) for (i = 0; i < n; i++) printf "%.17g %.17g %.17g\n", i / n, j / n,
		(0.15 - sqrt((i / n - 0.5)^2 + (j / n - 0.75)^2)) / n / n }' |
		stab - --law passive --box 0,1 -n 64 --faces periodic --particle-faces periodic --strength level --dt 0.0625 > a
	flow="scalc --mesh mesh 'u = -sin(pi*x)^2 * sin(2*pi*y) * cos(pi*time/8), sin(pi*y)^2 * sin(2*pi*x) * cos(pi*time/8)' --role state"
	# area and symmetric difference by the nodes inside, 289 at the start
	while read -r kernel area tolerance difference; do
		sh_ok "cycle -t 8 \"$flow | m2p --kernel m6prime | push rk4 | remesh --kernel $kernel\" < a | stab --plain --set matter > b"
		read -r now off sum < <(awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { l = $c["level"];
			d = 0.15 - sqrt(($c["x"] - 0.5)^2 + ($c["y"] - 0.75)^2)
			a += l > 0; b += d > 0; e += (l > 0) != (d > 0); s += l; t += d / 64 / 64 } END { printf "%.9g %.9g %.17g\n", a / b - 1, e / b,
				s / t - 1 }' b)
		within "$now" "$area" "$tolerance" "$kernel, area"
		[ "$difference" = - ] || below "$off" "$difference" "$kernel, symmetric difference"
		below "$sum" 1e-12 "$kernel, sum"
	done <<-'END'
		cic -1 0 -
		pcs -1 0 -
		m4prime -0.31448 0.02 0.5703
		m6prime -0.038228 0.02 0.2885
	END
	# the reference's areas, which are no counts of nodes and whose velocity is not interpolated: 2 % is 6 nodes of 289. Its differences times 1.5
}
