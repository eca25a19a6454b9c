# The particle-mesh force where it goes wrong. HC-13 and HC-14 are in tests/unit/pm-force.c. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
export PM_PLAN=estimate OMP_NUM_THREADS=1

@test "HC-15: a cold lattice stays cold for 1000 steps, kinetic energy below 1e-24 G M^2/L" {
	pinit lattice -n 64 --spacing 2 --offset 0.3 --dt 0.002 |
		cycle -n 1000 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' --every 100 | diag > out.tsv
	# Round-off grows as exp(wJ t), wJ = sqrt(4 pi) = 3.5: 1000 steps of 0.002 let it grow by 1e3, of 0.05 by 1e77.
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
