# Multigrid where it is hard: singular problems, sizes that do not halve, stretched cells, round-off. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

report() { tail -c 2048 "$1" | grep -ao "\"poisson-mg[^}]*}" | tail -1 | grep -o "\"$2\":[^,}]*" | cut -d: -f2 | tr -d '"'; }
# mean of the last column of the mesh of a periodic box (no half weights), relative to its largest value
mean() { stab --plain --mesh mesh | awk 'NR > 1 { s += $NF; v = $NF < 0 ? -$NF : $NF; if (v > m) m = v } END { print s/(NR-1)/m }'; }
differ() { scmp --norm relative_l2 --field phi "$1" "$2" | tail -1 | cut -f8; }

@test "HC-23: with a mean density of 1 in a periodic box the mean is removed and reported, and phi has none" {
	for n in 16 15x9x12; do
		pinit uniform -n 500 | p2m -n $n | poisson-mg >a
		within "$(report a mean_removed)" 1 1e-12
		below "$(mean <a)" 1e-12
	done
	pinit uniform -n 500 --faces neumann | p2m -n 15 | poisson-mg >a
	within "$(report a mean_removed)" 1 1e-12
}

@test "HC-23: no particles at all and a uniform density have phi = 0" {
	pinit uniform -n 0 | p2m -n 8 | poisson-mg >a
	sh_ok 'stab --plain --mesh mesh <a | awk "NR > 1 && \$NF != 0" | wc -l'
	[ "$output" = 0 ]
	within "$(report a cycles)" 0 0
}

@test "HC-24: sizes 1, 2, 3, 5, 7, 97, 127, 2^k + 1 and 96x64x20 converge, and to what the transforms give" {
	for faces in periodic wall; do
		for row in "1 1" "1 2" "1 3" "1 97" "2 1" "2 2" "2 3" "2 5" "2 7" "2 97" "2 127" "2 129" "3 1" "3 2" "3 3" "3 5" "3 7" "3 17" "3 33" "3 1x7x16" "3 96x64x20"; do
			read -r dim n <<<"$row"
			pinit uniform -n 100 --dim $dim --faces $faces | p2m --kernel ngp -n $n >m
			poisson-fft --plan estimate --symbol fd2 <m >f
			poisson-mg --no-history <m >g
			[[ $(report g status) =~ converged|floor ]]
			below "$(report g cycles)" 18 "$faces $row"
			below "$(differ g f)" 1e-9 "$faces $row"
		done
	done
}

@test "HC-25: cells stretched 100 times converge faster than 0.5 per cycle" {
	for row in "6400x64" "64x6400" "97x1"; do
		pinit uniform -n 1000 --dim 2 | p2m -n $row | poisson-mg >a
		[[ $(report a status) =~ converged|floor ]]
		below "$(report a contraction)" 0.5 "$row"
	done
	for row in "40x4x400" "8x80x80"; do
		pinit uniform -n 1000 --faces wall | p2m -n $row | poisson-mg >a
		[ "$(report a status)" = converged ]
		below "$(report a contraction)" 0.5 "$row"
	done
}

@test "HC-28: asked for 1e-18 it stops at round-off in fewer than 50 cycles and says so" {
	for row in "1 64" "2 100" "3 32" "3 21x16x9"; do
		read -r dim n <<<"$row"
		for cycle in v w fmg; do
			pinit uniform -n 1000 --dim $dim | p2m -n $n | poisson-mg --tolerance 1e-18 --cycle $cycle >a
			[ "$(report a status)" = floor ]
			within "$(report a cycles)" 25 24.5 "$row $cycle"
			below "$(report a residual)" 1e-12 "$row $cycle"
		done
	done
}
