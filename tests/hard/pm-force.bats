# The particle-mesh force where it goes wrong. HC-13 and HC-14 are in tests/unit/pm-force.c. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
export OMP_NUM_THREADS=1

@test "HC-15: a cold lattice stays cold for 1000 steps, kinetic energy below 1e-24 G M^2/L" {
	pinit lattice -n 64 --spacing 2 --offset 0.3 --dt 0.002 |
		cycle -n 1000 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' --every 100 | diag > out.tsv
	# Round-off grows as exp(wJ t), wJ = sqrt(4 pi) = 3.5: by 1e3 in 1000 steps of 0.002, by 1e77 in steps of 0.05.
	# M = 512, L = 8: G M^2/L = 32768
	energy=$(column energy_kinetic < out.tsv | sort -g | tail -1)
	[ "$(wc -l < out.tsv)" -ge 11 ]
	below "$energy" 3.2768e-20
}

@test "HC-13: a single particle at the end of the box feels no force, whatever the kernel" {
	for kernel in ngp cic tsc; do
		for x in 0 15.999999999999998 8 7.5; do
			a=$(pinit pair --m2 0 --x1 $x --y1 $x --z1 3.3 | p2m --kernel $kernel | poisson-fft | mgrad | m2p | stab --plain --set matter |
				awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } NR == 2 { print $c["acc_0"] }')
			below "$a" 1e-13 "$kernel at $x"
		done
	done
}

@test "the force on a particle that crosses a cell face jumps with ngp, has a kink with cic and is smooth with tsc" {
	# pull X: on the second of two, 7 to X
	pull() {
		pinit pair --x1 7 --y1 8 --z1 8 --x2 "$1" --y2 8 --z2 8 | p2m --kernel "$kernel" | poisson-fft | mgrad | m2p | stab --plain --set matter |
			awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } NR == 3 { printf "%.15g", -$c["acc_0"] }'
	}
	# jump X: the force just below X over that just above, less 1; kink X: the same of the slopes, over 0.001 on both sides
	jump() { awk -v a="$(pull "$(awk "BEGIN { printf \"%.12g\", $1 - 1e-6 }")")" -v b="$(pull "$(awk "BEGIN { printf \"%.12g\", $1 + 1e-6 }")")" 'BEGIN {
		printf "%.9g", a / b - 1 }'; }
	kink() { awk -v a="$(pull "$(awk "BEGIN { printf \"%.12g\", $1 - 1e-3 }")")" -v o="$(pull "$1")" -v b="$(pull "$(awk \
		"BEGIN { printf \"%.12g\", $1 + 1e-3 }")")" 'BEGIN { printf "%.9g", (a - o) / (o - b) - 1 }'; }
	# weights of ngp change at 9.5, of cic at 10, of tsc at 9.5
	kernel=ngp
	above "$(jump 9.5)" 1 "ngp"
	kernel=cic
	below "$(jump 10)" 1e-5 "cic" # 2e-6 times its slope, 0.2, over its value, 0.08
	above "$(kink 10)" 1 "cic, slope"
	kernel=tsc
	for x in 9.5 10; do
		below "$(jump $x)" 1e-5 "tsc at $x"
		below "$(kink $x)" 0.01 "tsc at $x, slope" # 1e-3 times its curvature, 0.2, over its slope, 0.1, and as much again where the curvature jumps
	done
}

@test "a cold sphere that collapses into a few cells: cic loses 7 % of the energy, and diag says so with what to swap; tsc and pcs keep it" {
	for row in 'cic 0.05 0.1' 'tsc 0 0.01' 'pcs 0 0.006'; do # measured at t = 1.5: 0.072, 0.0047, 0.0028; 64^3 cells, 10000 bodies: 0.10, 0.02, 0.0003
		read -r kernel low high <<<"$row"
		pinit cold-sphere -n 1000 --cells 24 --dt 0.01 |
			cycle -t 1.5 --every 50 "push kick/2 drift | p2m --kernel $kernel | poisson-fft | mgrad | m2p | push kick/2" |
			diag --columns energy >t 2>told
		between "$(awk 'NR == 2 { e = $1 } END { x = ($1 - e) / e; print x < 0 ? -x : x }' t)" "$low" "$high" "$kernel"
		[ $kernel = cic ] || [ ! -s told ]
		[ $kernel != cic ] || grep -qx "diag: step 150: |dE/E| is 0.07.* since step 0: the mesh force of cic .*(p2m --kernel tsc or pcs, .*" told
	done
	# not where another force acts: friction takes energy, as it should
	pinit cold-sphere -n 200 --cells 16 --dt 0.02 |
		cycle -t 1.5 --every 25 "push kick/2 drift | p2m | poisson-fft | mgrad | m2p | field 'acc = -5*v.x, -5*v.y, -5*v.z' | push kick/2" |
		diag --columns energy >t 2>told
	[ "$(wc -l <t)" = 5 ]
	run ! grep -q 'dE/E' told
}
