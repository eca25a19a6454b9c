# The particle-mesh force of two particles and of a lattice, through the words. Reference numbers: tests/reference/values.csv.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# pm KERNEL SYMBOL ORDER: PM-01's pair, its forces (mass times acceleration, two lines) and the potential at node (5, 5, 6).
pm() {
	pinit pair | p2m --kernel "$1" | poisson-fft --symbol "$2" | tee potential | mgrad --order "$3" | m2p | stab --plain --set matter |
		awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { m = $c["mass"]; printf "%.17g %.17g %.17g\n", m*$c["acc_0"], m*$c["acc_1"],
			m*$c["acc_2"] }'
	stab --plain --mesh mesh < potential | awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } $1 == 5 && $2 == 5 && $3 == 6 { print $c["phi"] }'
}

# pm01 KERNEL SYMBOL ORDER Fx Fy Fz PHI: 1e-12 as in the case; F_A + F_B < 1e-15, ngp 2e-15: its potential, 5 at the particle, is rounded to 9e-16.
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
		awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { for (d = 0; d < 3; d++) { a = $c["acc_" d]; if (a < 0) a = -a;
			if (a > m) m = a } } END { print m + 0 }'
}

@test "PM-13: a cold lattice of spacing 2 dx has no force" {
	below "$(force cic 2 729)" 1e-12 cic # the case's bound for commensurate lattices; its own numbers are 9e-15
	below "$(force tsc 2 729)" 1e-12 tsc
}

@test "PM-13: a cold lattice of spacing 1.5 dx has a force from the mesh: 0.945 with cic, 0.478 with tsc" {
	within "$(force cic 1.5 1728)" 0.9450 0.04725 cic # 5 % as the case says
	within "$(force tsc 1.5 1728)" 0.4776 0.02388 tsc
}

# The table of docs/methods/pm-force.md on 32^3 cells with 40 places (320 pairs a distance), once for all tests.
setup_file() { bash "$top/pipelines/pm-force.sh" -n 32 --check 40 > "$BATS_FILE_TMPDIR/table"; }
# error NAME R [COLUMN]: rms error (3, default), mean (1) or transverse force (2) at r = 1, 2, 4 of the row of that name; --cloud rows with "cloud" before.
error() {
	local part='force of points' column=$((2 + ($2 == 2) + 2 * ($2 == 4)))
	[[ $1 != cloud* ]] || part='force of clouds'
	awk -F'|' -v part="$part" -v name=" ${1#cloud } " -v c=$((column + 1)) -v k="${3:-3}" \
		'/force of/ { on = index($0, part) } on && $2 == name { split($c, v, " "); print v[k]; n++ } END { exit n != 1 }' "$BATS_FILE_TMPDIR/table"
}
smaller() { between "$1" 0 "$(awk -v b="$2" -v f="${3:-1}" 'BEGIN { printf "%.9g", f * b }')"; }

@test "PM-02: the plain rows are the reference's, mean force to a fifth of the error, errors to 20 %" {
	# tests/reference/values.csv, 64^3 cells, 600 placements; cic and spec at r = 4 is heavy-tailed: 50 % as it says
	for row in "cic, fd2, 2|1 .4629 .5479|2 .9889 .1699|4 .9987 .0485" "tsc, spectral, spectral|1 .4090 .5910|2 .9578 .0739|4 .9931 .0376"; do
		for r in 2 3 4; do
			read -r r mean want < <(cut -d'|' -f$r <<< "$row")
			within "$(error "${row%%|*}" "$r" 1)" "$mean" "$(awk "BEGIN { print .2 * $want }")" "${row%%|*} r = $r, mean"
			within "$(error "${row%%|*}" "$r")" "$want" "$(awk "BEGIN { print ($r == 4 && \"$row\" ~ /spectral/ ? .5 : .2) * $want }")" \
				"${row%%|*} r = $r, error"
		done
	done
}

@test "PM-02: interlacing removes the oscillation of spectral gradients: cic's error at r = 2 below two fifths, at 4 half; scatter at 1 three tenths" {
	smaller "$(error 'cic --interlace, spectral, spectral' 2)" "$(error 'cic, spectral, spectral' 2)" 0.4
	smaller "$(error 'cic --interlace, spectral, spectral' 4)" "$(error 'cic, spectral, spectral' 4)" 0.5
	smaller "$(error 'cic --interlace, spectral, spectral' 1 2)" "$(error 'cic, spectral, spectral' 1 2)" 0.3
	smaller "$(error 'tsc --interlace, spectral, spectral' 1 2)" "$(error 'tsc, spectral, spectral' 1 2)" 0.3
}

@test "PM-02: with deconvolution or the optimal influence the mean force at r = 1 is right within 20 % instead of half; larger error at r = 2" {
	for kernel in cic tsc; do
		for influence in deconvolved optimal; do
			within "$(error "$kernel, --influence $influence, 4" 1 1)" 1 0.2 "$kernel $influence"
			smaller "$(error "$kernel, spectral, 4" 2)" "$(error "$kernel, --influence $influence, 4" 2)" 0.6 \
				# a mesh cannot represent point particles
		done
		smaller "$(error "$kernel, spectral, 4" 1 1)" 0.5
		smaller "$(error "$kernel, --influence optimal, 4" 1)" "$(error "$kernel, spectral, 4" 1)" 0.8
	done
}

@test "PM-02: clouds of 4 cells: deconvolved is better than plain, optimal also corrects the gradient, interlacing removes the rest, down to 0.2 %" {
	for kernel in cic tsc; do
		for r in 1 2; do
			smaller "$(error "cloud $kernel, deconvolved, 4" $r)" "$(error "cloud $kernel, plain, 4" $r)" 0.4
			smaller "$(error "cloud $kernel, optimal, 2" $r)" "$(error "cloud $kernel, deconvolved, 2" $r)" 0.6
			smaller "$(error "cloud $kernel --interlace, deconvolved, spectral" $r)" "$(error "cloud $kernel, deconvolved, spectral" $r)" 0.3
			smaller "$(error "cloud $kernel --interlace, optimal, 4" $r)" "$(error "cloud $kernel, optimal, 4" $r)" 0.7
		done
	done
	smaller "$(error 'cloud tsc, optimal, 4' 1)" "$(error 'cloud tsc, deconvolved, 4' 1)" 0.5
	below "$(error 'cloud tsc --interlace, deconvolved, spectral' 1)" 0.003 # measured 0.0020, and 0.0011 at r = 2
	below "$(error 'cloud tsc --interlace, deconvolved, spectral' 2)" 0.0015
}

@test "PM-02: ngp at r = 2: the error of 600 pairs scatters by more than a fifth, and the reference's 0.6106 is one of them" {
	for seed in 2 3 4 5 6 7 8 9; do
		bash "$top/pipelines/pm-force.sh" -n 32 --check 75 --only 'ngp, fd2' --seed $seed | awk -F'|' '/ngp/ { split($4, v, " "); print v[3] }'
	done | sort -g > errors
	read -r low < errors
	high=$(tail -1 errors)
	awk -v l="$low" -v h="$high" 'BEGIN { exit !(l < 0.6106 && 0.6106 < h && h - l > 0.2 * (h + l) / 2) }' || { cat errors; false; }
}

@test "PM-01: interlaced meshes keep momentum: no self force, and the two forces are opposite" {
	for kernel in ngp cic tsc pcs; do
		pinit pair | p2m --kernel $kernel --interlace | poisson-fft --influence optimal --cloud 3 | mgrad | m2p | stab --plain --set matter |
			awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { for (d = 0; d < 3; d++) s[d] += $c["mass"] * $c["acc_" d] } END {
				print s[0], s[1], s[2] }' > sum
		read -r x y z < sum
		for s in "$x" "$y" "$z"; do below "$s" 2e-15 "$kernel"; done
		pinit pair --m2 0 | p2m --kernel $kernel --interlace | poisson-fft | mgrad --order spectral | m2p | stab --plain --set matter |
			awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } NR == 2 { print $c["acc_0"], $c["acc_1"], $c["acc_2"] }' > self
		read -r x y z < self
		for s in "$x" "$y" "$z"; do below "$s" 1e-15 "$kernel alone"; done
	done
}
