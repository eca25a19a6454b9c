# Diffusion on particles where it is hard: at the limit of stability, widths far too small and too large, no or few particles, all in one place, on
# faces, in boxes smaller than the reach, unequal volumes. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# noise N [FACES]: N particles on a line, strengths that alternate and random ones on top, 1e-6 large.
noise() {
	awk -v n="$1" 'BEGIN { srand(7); print "x heat volume"; for (i = 0; i < n; i++) printf "%.17g %.17g %.17g\n", i / n,
		1e-6 * (2 * rand() - 1 + (i % 2 ? -0.1 : 0.1)) / n, 1 / n }' |
		stab - --strength heat --box 0,1 --faces ${2:-periodic} --dt 1
}
largest() { stab --plain | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { c = $at["heat"] / $at["volume"]; c = c < 0 ? -c : c;
	if (c > m) m = c } END { print m }'; }
sum() { stab --plain | column heat | awk '{ s += $1 } END { printf "%.17g\n", s }'; }

@test "N47, S41: white noise decays at nu dt/eps^2 = 1.99 in 2e4 steps and grows by 1e5 and more at 2.001, which push refuses" {
	noise 32 >a
	s="field 'vel = 0' | pse --field heat --nu $(awk 'BEGIN { printf "%.17g", 1 / 1024 }') --overlap 1 | push euler"
	cycle -n 3000 "$s --dt 1.99" <a | largest >below # 0.99^3000 of the noise but for its mean
	run -3 bash -o pipefail -c "cycle -n 1 \"$s --dt 2.001\" <a | sls"
	[[ $output == *"times the limit of euler: 'dheat' of 'matter' (diffusion) decays at up to 1 per time"* ]]
	cycle -n 20000 "$s --unsafe --dt 2.001" <a | largest >beyond
	below "$(cat below)" 1e-6 "at 1.99"
	above "$(cat beyond)" 0.02 "at 2.001" # from 1e-7 in that mode, by 1e5 to 1e8
	below "$(cat beyond)" 1e2 "at 2.001"
}

@test "S41, HC-44: every scheme and order decays at 0.98 of its limit and grows at 1.02 of it" {
	noise 24 >a
	for case in euler:2:1:2 rk2:4:2:2 lsrk3:2:1:2.512745326618329 lsrk3:4:2:2.512745326618329 rk4:2:1:2.785293563405282 rk4:4:2:2.785293563405282; do
		IFS=: read -r scheme order total limit <<<"$case"
		at() { awk -v f="$1" "BEGIN { printf \"%.15g\", f * $limit / $total }"; }
		s="field 'vel = 0' | pse --field heat --nu $(awk 'BEGIN { printf "%.17g", 1 / 576 }') --order $order | push $scheme"
		cycle -n 100 "$s --dt $(at 0.98)" <a | largest >below
		run -3 bash -o pipefail -c "cycle -n 30 \"$s --dt $(at 1.02)\" <a | sls"
		[[ $output == *"times the limit of $scheme"* ]]
		cycle -n 400 "$s --unsafe --dt $(at 1.02)" <a | largest >beyond
		below "$(cat below)" 1.2e-6 "$case, at 0.98" # the start's
		above "$(cat beyond)" 1e-5 "$case, at 1.02"
	done
}

@test "the bound holds for random positions: just below it nothing grows" {
	awk 'BEGIN { srand(9); print "x y heat volume"; for (i = 0; i < 300; i++) printf "%.17g %.17g %.17g %.17g\n", rand(), rand(), (2 * rand() - 1) / 300,
		(rand() + 0.1) / 300 }' |
		stab - --strength heat --box 0,1 --faces wall,open,periodic,periodic >a
	fastest=$(pse --field heat --nu 1 <a | stab | grep '^#limits' | grep -o '"decay":[0-9.e+]*' | cut -d: -f2)
	before=$(largest <a)
	# euler at 1.99999 of 2: V-weighted squares cannot grow
	cycle -n 200 "field 'vel = 0, 0' | pse --field heat --nu 1 | push euler --dt $(awk "BEGIN { printf \"%.17g\", 1.99999 / $fastest }")" <a |
		largest >after
	below "$(cat after)" "$before"
	run -3 bash -o pipefail -c "cycle -n 1 \"field 'vel = 0, 0' | pse --field heat --nu 1 | push euler --dt $(awk \
		"BEGIN { printf \"%.17g\", 2.00001 / $fastest }")\" <a | sls"
}

@test "widths of a thousandth and of a thousand spacings: no exchange, with a message, or complete mixing" {
	noise 64 open >a
	pse --field heat --nu 1 --overlap 1e-3 <a >b
	run -0 bash -o pipefail -c 'sls --report <b'
	[[ $output == *'"alone":64'* ]]
	stab --plain <b | column dheat | awk '$1 != 0 { exit 1 }'
	pse --field heat --nu 1 --overlap 1e3 <a | stab --plain | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { h[NR] = $at["heat"];
		d[NR] = $at["dheat"]; m += $at["heat"] / 64 }
		END { c = 1 / sqrt(16 * atan2(1, 1)) * 64^3 * 1e-9; for (i in h) { e = d[i] - c * (m - h[i]); if (e^2 > w) w = e^2; if (d[i]^2 > v) v = d[i]^2 }
			print sqrt(w / v) }' >off
	below "$(cat off)" 1.1e-3 # eta is 1 to 64^2/(4 1000^2)
	noise 64 >a
	run -1 bash -o pipefail -c 'pse --field heat --nu 1 --overlap 1e3 <a | sls'
	[[ $output == *"boxes of 1, too long to resolve anything"* ]]
}

@test "no particles, one, all in one point, a box of one cell: in 1, 2 and 3 dimensions, every kind of face" {
	for dim in 1 2 3; do
		for faces in open periodic wall neumann; do
			for n in 0 1 7; do
				awk -v n=$n -v d=$dim 'BEGIN { print substr("x y z", 1, 2 * d - 1) " heat volume";
					for (i = 0; i < n; i++) print substr("0 0 0", 1, 2 * d - 1), i + 1, 0.1 + i % 2 }' |
					stab - --strength heat --box 0,1 --faces $faces >a
				for order in 2 4; do
					pse --field heat --nu 1 --order $order --eps 0.3 <a | stab --plain >b
					# in one point with equal weight: sum over q of V_p G_q - V_q G_p; walls through the point double or annul the strengths
					awk -v n=$n -v faces=$faces -v d=$dim 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { g[NR] = $at["heat"];
						v[NR] = $at["volume"]; r[NR] = $at["dheat"]; G += $at["heat"]; V += $at["volume"]; s += $at["dheat"];
							a += $at["dheat"]^2 }
						END { if (NR != n + 1) exit 1; if (faces != "wall" && s^2 > 1e-28 * a) exit 1
							if (faces != "wall" && n > 1) { f = r[2] / (v[2] * G - V * g[2]); if (!(f > 0)) exit 1; for (i in g) {
								e = r[i] - f * (v[i] * G - V * g[i]); if (e^2 > 1e-26 * a) exit 1 } }
							if (n == 1 && faces != "wall" && r[2] != 0) exit 1; if (n == 1 && faces == "wall" &&
								!(r[2] < 0)) exit 1 }' b ||
						{ echo "$dim-D, $faces, $n particles, order $order"; cat b; return 1; }
					[ $faces = wall ] || awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
						{ s += $at["dheat"]; a += $at["dheat"]^2 } END { print (a > 0 ? sqrt(s^2 / a) : 0) }' b >>sums
				done
			done
		done
	done
	below "$(sort -g sums | tail -n 1)" 1e-14 "sum of the rates" # seven rates of up to 7 x 27 images each: sqrt(7 x 189) 2^-53 = 4e-15; measured 1.9e-15
}

@test "particles on faces and beyond periodic ones are treated correctly: at 0, at the box's length, outside" {
	for at in 0 1 -1 2; do
		printf 'x heat volume\n%s 1 0.1\n0.1 2 0.1\n0.9 4 0.2\n' $at | stab - --strength heat --box 0,1 --faces periodic |
			pse --field heat --nu 1 --eps 0.1 | stab --plain | column dheat >$at
	done
	for at in 1 -1 2; do # three terms of a kernel that feels 2^-53 of the position ten times, 1/eps: 4e-15; measured 0
		below "$(paste 0 ./$at | awk '{ d = ($1 - $2)^2 / $1^2; worst = d > worst ? d : worst; n++ }
			END { print (n == 3 ? sqrt(worst) : "nan") }')" 1e-14 "at $at"
	done
	# on a wall the image cancels, and only half of the cell is inside
	awk 'BEGIN { print "x heat volume"; for (i = 0; i <= 20; i++) print i / 20, i / 20, i ? 0.05 : 0.025 }' |
		stab - --strength heat --box 0,1 --faces wall,open | pse --field heat --nu 1 | stab --plain | column dheat | head -n 9 |
		awk '{ if ($1^2 > 1e-20) exit 1; n++ } END { exit n != 9 }' # linear: no diffusion, but near the open end
}

@test "a box much smaller than the cut-off gives the same as many boxes side by side" {
	cell() { # COPIES: three particles a box of 0.3
		awk -v c=$1 'BEGIN { print "x y heat volume"; for (i = 0; i < c; i++) for (j = 0; j < c; j++) { print 0.3 * i, 0.3 * j, 1, 0.03;
			print 0.3 * i + 0.1, 0.3 * j + 0.2, 2, 0.05; print 0.3 * i + 0.25, 0.3 * j + 0.1, -1, 0.01 } }' |
			stab - --strength heat --box 0,$(awk "BEGIN { print 0.3 * $1 }") --faces periodic | pse --field heat --nu 1 --eps 0.15 |
				stab --plain | column dheat | head -n 3
	}
	for copies in 2 9; do # positions up to 2.7, rounded by 2.2e-16: 1.5e-15 eps, which is felt 3 times as strongly; measured 1.3e-15
		below "$(paste <(cell 1) <(cell $copies) | awk '{ d = ($1 - $2)^2 / $1^2; worst = d > worst ? d : worst; n++ }
			END { print (n == 3 ? sqrt(worst) : "nan") }')" 2e-14 "$copies boxes"
	done
}

@test "a wall is the odd field on both sides of it, in the plane too, with a wall and a neumann face in a corner" {
	awk 'BEGIN { srand(2); for (i = 0; i < 60; i++) print rand(), rand(), rand(), 0.01 + rand() / 60 }' >some
	awk 'BEGIN { print "x y heat volume" } { print }' some | stab - --strength heat --box 0,1 --faces wall,open,neumann,open |
		pse --field heat --nu 1 --eps 0.1 | stab --plain | column dheat >corner
	awk 'BEGIN { print "x y heat volume" } { print; a[NR] = $0 } END { for (i = 1; i <= NR; i++) { split(a[i], c); print -c[1], c[2], -c[3], c[4] }
		for (i = 1; i <= NR; i++) { split(a[i], c); print c[1], -c[2], c[3], c[4]; print -c[1], -c[2], -c[3], c[4] } }' some |
			stab - --strength heat --box -1,1 | pse --field heat --nu 1 --eps 0.1 | stab --plain | column dheat | head -n 60 >both
	# 240 terms in another order, 240 2^-53 = 3e-14; measured 8e-16
	below "$(paste corner both |
		awk '{ d = ($1 - $2)^2 / $1^2; worst = d > worst ? d : worst; n++ } END { print (n == 60 ? sqrt(worst) : "nan") }')" 3e-14
}

@test "volumes over six decades: the sum is conserved, and a constant value stays constant" {
	awk 'BEGIN { srand(6); print "x y heat volume"; for (i = 0; i < 200; i++) { v = exp(-13.8 * rand()) / 50; printf "%.17g %.17g %.17g %.17g\n", rand(),
		rand(), 3 * v, v } }' | stab - --strength heat --box 0,1 --faces periodic >a
	pse --field heat --nu 1 --eps 0.1 <a | stab --plain | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { s += $at["dheat"];
		d = $at["dheat"] / $at["heat"]; if (d > m) m = d; if (-d > m) m = -d } END { print m, s }' >off
	# nu/eps^2 = 100 times the 2^-53 that is left of V_p G_q - V_q G_p, of 200 neighbours: sqrt(200) 1e-14; measured 8e-15
	below "$(cut -d' ' -f1 off)" 1e-13 "the value"
	below "$(cut -d' ' -f2 off)" 1e-27 "the sum" # each pair's two rates, of up to 1e-15, are opposite: 200 roundings of 1e-31; measured 1.3e-31
}

@test "walk: a step of a thousand boxes ends inside, on faces too; the seed does not affect the other fields" {
	printf 'x y\n0 0\n1 1\n0.5 0\n' | stab - --box 0,1 --dt 1 --faces periodic,wall --particle-faces periodic,reflect >a
	for seed in 1 2 3; do
		walk --nu 1e6 --seed $seed <a | stab --plain | awk 'NR > 1 && !($1 >= 0 && $1 < 1 && $2 >= 0 && $2 <= 1) { exit 1 } END { exit NR != 4 }'
		counted 3 # positions
	done
	run -3 bash -o pipefail -c 'printf "x\n1e308\n" | stab - --box -1,1 --dt 1e300 | walk --nu 1e300 | sls'
	[[ $output == *"not finite"* ]]
}

@test "S36, HC-45: --method dc on lines, coincident and few points: refused with a message, never NaN" {
	scatter() { awk -v how="$1" 'BEGIN { srand(5); print "x y heat volume"; for (i = 0; i < 60; i++) { x = rand();
		y = how == "line" ? 2 * x - 0.3 : how == "almost" ? x + 1e-12 * rand() : rand()
		for (k = 0; k < (how == "twins" ? 2 : 1); k++) printf "%.17g %.17g %.17g %.17g\n", x, y, rand(), 1/60 } }' |
			stab - --strength heat --box -1,2; }
	for how in line almost; do
		scatter $how >a
		run -1 bash -o pipefail -c 'pse --field heat --nu 1 --method dc <a | sls'
		[[ $output == *"which do not determine the Laplacian (rank 3 of 9"* ]] || { echo "$output"; return 1; }
	done
	scatter twins | pse --field heat --nu 1 --method dc | stab --plain >b
	[ "$(wc -l <b)" = 121 ]
	for n in 0 1 2 8; do
		printf 'x heat volume\n' >c
		for i in $(seq $n); do echo "0.$i $i 0.1" >>c; done
		run bash -o pipefail -c 'stab c --strength heat --box 0,1 | pse --field heat --nu 1 --method dc --eps 0.1 | sls'
		[ "$status" = $((n == 1 || n == 2)) ]
	done
	counted 4 # refused: two kinds of lines, one point, two points
}

@test "--method dc on a lattice and on distorted points: noise does not grow just below the bound, and push refuses steps beyond it" {
	for jitter in 0 0.5; do
		awk -v j=$jitter 'BEGIN { srand(7); print "x y heat volume";
			for (i = 0; i < 16; i++) for (k = 0; k < 16; k++) printf "%.17g %.17g %.17g %.17g\n", (i + j * rand()) / 16, (k + j * rand()) / 16,
				(2 * rand() - 1) / 256, 1/256 }' |
			stab - --strength heat --box 0,1 --faces periodic >a
		fastest=$(pse --field heat --nu 1 --method dc <a | stab | grep '^#limits' | grep -o '"decay":[0-9.e+]*' | cut -d: -f2)
		before=$(largest <a)
		cycle --moves pse -n 200 "field 'vel = 0, 0' | pse --field heat --nu 1 --method dc | push euler --dt $(awk \
			"BEGIN { printf \"%.17g\", 1.999 / $fastest }")" <a | largest >after
		below "$(cat after)" "$before" "jitter $jitter, just below the bound"
		run -3 bash -o pipefail -c "cycle -n 1 \"field 'vel = 0, 0' | pse --field heat --nu 1 --method dc | push euler --dt $(awk \
			"BEGIN { printf \"%.17g\", 2.001 / $fastest }")\" <a | sls"
	done
}
