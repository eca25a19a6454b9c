# The particle-mesh force of two particles and of a lattice, through the words. Reference numbers: tests/reference/values.csv.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
export PM_PLAN=estimate

# pm KERNEL SYMBOL ORDER: PM-01's pair, its forces (mass times acceleration, two lines) and the potential at node (5, 5, 6).
pm() {
	pinit pair | p2m --kernel "$1" | poisson-fft --symbol "$2" | tee potential | mgrad --order "$3" | m2p | stab --plain --set matter |
		awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { m = $c["mass"]; printf "%.17g %.17g %.17g\n", m*$c["acc_0"], m*$c["acc_1"], m*$c["acc_2"] }'
	stab --plain --mesh mesh < potential | awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } $1 == 5 && $2 == 5 && $3 == 6 { print $c["phi"] }'
}

# pm01 KERNEL SYMBOL ORDER Fx Fy Fz PHI: 1e-12 as the case asks for; F_A + F_B < 1e-15, ngp 2e-15: its potential, 5 at the particle, has steps of 9e-16.
pm01() {
	pm "$1" "$2" "$3" > out
	read -r ax ay az < out
	read -r bx by bz < <(sed -n 2p out)
	within "$ax" "$4" 1e-12 "$* Fx"
	within "$ay" "$5" 1e-12 "$* Fy"
	within "$az" "$6" 1e-12 "$* Fz"
	within "$(sed -n 3p out)" "$7" 1e-12 "$* phi"
	local bound=1e-15
	[ "$1" != ngp ] || bound=2e-15
	for sum in "$ax $bx" "$ay $by" "$az $bz"; do
		awk -v s="$sum" -v b="$bound" 'BEGIN { split(s, v); d = v[1] + v[2]; exit !(d < b && d > -b) }' || { echo "F_A + F_B: $sum" >&2; false; }
	done
}

@test "PM-01: forces and potential of a pair, ngp, spectral" {
	pm01 ngp spectral spectral 0.02661385459838 0.006455857354579 0.02332002097141 -0.389708680057705
}

@test "PM-01: forces and potential of a pair, cic, spectral" {
	pm01 cic spectral spectral 0.02710642673042 0.009499280346298 0.02535614653357 -0.454900894898108
}

@test "PM-01: forces and potential of a pair, tsc, spectral" {
	pm01 tsc spectral spectral 0.02695096096426 0.009461713440117 0.02546983498229 -0.453443995977068
}

@test "PM-01: forces and potential of a pair, cic, differences of order 2 and 2" {
	pm01 cic fd2 2 0.02663957298003 0.009361482740412 0.02494476327532 -0.455536861780015
}

@test "PM-01: forces and potential of a pair, cic, differences of order 2 and 4" {
	pm01 cic fd2 4 0.02690820956069 0.009754634575902 0.02535070183723 -0.455536861780015
}

@test "PM-01: forces and potential of a pair, tsc, differences of order 2 and 4" {
	pm01 tsc fd2 4 0.02676476607225 0.009699232854765 0.02545541272341 -0.454514589530816
}

@test "PM-01: forces and potential of a pair, tsc, differences of order 2 and 2" {
	pm01 tsc fd2 2 0.02648569688906 0.009312482606744 0.02505220970105 -0.454514589530816
}

# force KERNEL SPACING N, on 18^3 cells: the largest acceleration component on PM-13's lattice, G = rho = dx = 1.
force() {
	pinit lattice -n "$3" --spacing "$2" | p2m --kernel "$1" | poisson-fft --symbol fd2 | mgrad --order 4 | m2p | stab --plain --set matter |
		awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { for (d = 0; d < 3; d++) { a = $c["acc_" d]; if (a < 0) a = -a; if (a > m) m = a } } END { print m + 0 }'
}

@test "PM-13: a cold lattice of spacing 2 dx feels no force" {
	below "$(force cic 2 729)" 1e-12 cic # the case's bound for commensurate lattices; its own numbers are 9e-15
	below "$(force tsc 2 729)" 1e-12 tsc
}

@test "PM-13: a cold lattice of spacing 1.5 dx feels the mesh: 0.945 with cic, 0.478 with tsc" {
	within "$(force cic 1.5 1728)" 0.9450 0.04725 cic # 5 % as the case says
	within "$(force tsc 1.5 1728)" 0.4776 0.02388 tsc
}
