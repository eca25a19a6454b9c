# p2m where positions and numbers of particles are awkward.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# line FACES CELLS: the particles of the table on standard input in the box 0..4 of one axis.
line() { stab - --law gravity --box 0,4 --faces "$1" --particle-faces open -n "$2"; }

# mesh: the values of the first mesh field, one line.
mesh() { stab --plain --mesh mesh | awk 'NR > 1 { printf "%s%s", (NR > 2 ? " " : ""), $NF } END { print "" }'; }

@test "HC-59: no particles give a zero field, one particle a field, exit 0" {
	printf 'x mass\n' | line open 4 >a
	sh_ok 'p2m <a | stab --plain --mesh mesh'
	below "$(tail -n +2 <<<"$output" | cut -f 2 | sort -u)" 0 "the field of nothing"
	printf 'x mass\n2 3\n' | line open 4 >b
	[ "$(p2m <b | mesh)" = "0 0 3 0 0" ]
}

@test "HC-59: x = -1e-17, L, L - ulp and 1e300 fall into a periodic mesh" {
	printf 'x mass\n-1e-17 1\n4 2\n3.9999999999999996 4\n1e300 8\n' | stab - --law gravity --box 0,4 --faces periodic -n 4 >a
	for kernel in ngp cic tsc pcs m4prime; do
		sh_ok "p2m --kernel $kernel <a | stab --plain --mesh mesh"
		within "$(awk 'NR > 1 { s += $2 } END { printf "%.17g", s }' <<<"$output")" 15 1e-14 "$kernel" # four nodes, two roundings each
	done
	run -0 bash -c 'p2m --kernel ngp <a | stab --plain --mesh mesh'
	[ "$(awk 'NR == 2 { print ($2 >= 7) }' <<<"$output")" = 1 ] # all but 1e300, whose position is undefined by rounding, are at lo
}

@test "HC-59: a particle 2^40 periods away, up or down, is wrapped to the right place" {
	# 4 * 2^40 + 1.25 and 1.25 - 4 * 2^40, both exact
	printf 'x mass\n4398046511105.25 1\n-4398046511102.75 2\n1.25 4\n' | stab - --law gravity --box 0,4 --faces periodic -n 4 >a
	printf 'x mass\n1.25 7\n' | stab - --law gravity --box 0,4 --faces periodic -n 4 >b
	for kernel in ngp cic tsc pcs m4prime; do
		paste <(p2m --kernel $kernel <a | stab --plain --mesh mesh | sed 1d) <(p2m --kernel $kernel <b | stab --plain --mesh mesh | sed 1d) >c
		[ "$(wc -l <c)" = 4 ]
		below "$(awk '{ d = $2 - $4; d = d < 0 ? -d : d; m = d > m ? d : m } END { print m + 0 }' c)" 1e-14 "$kernel" # sums of three and of one
	done
}

@test "HC-59: m2p finds a value for the same positions" {
	printf 'x vx mass\n-1e-17 0 1\n4 0 2\n3.9999999999999996 0 4\n1e300 0 8\n' | stab - --law gravity --box 0,4 --faces periodic -n 4 | p2m >a
	sh_ok 'm2p --field rho <a | stab --plain'
	# all four are on the node at 0, the third 4.4e-16 cells beside it, which takes 9e-15 of 15 away; and three roundings
	for want in 15 15 15 15; do
		read -r got
		within "$got" "$want" 2e-14
	done < <(awk 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "rho") c = i; next } { print $c }' <<<"$output")
}

@test "clustered: nine of ten particles in one cell of 32^3, or all in one point: the sum to round-off, the same bytes for 1, 2, 3 threads, m2p the transpose" {
	pinit uniform -n 40000 --cells 32 --box 0,0,0,1,1,1 --seed 4 >all
	scalc 'x = id < 36000 ? 0.503 + x/65 : x, id < 36000 ? 0.503 + y/65 : y, id < 36000 ? 0.503 + z/65 : z' <all >cell
	scalc 'x = 0.503, 0.503, 0.503' <all >point
	for set in cell point; do
		for kernel in cic pcs; do
			for threads in 1 2 3; do
				p2m --kernel $kernel --threads $threads <$set | m2p --kernel $kernel --field rho --threads $threads >$set.$threads
			done
			same_as $set.1 $set.2
			same_as $set.1 $set.3
			# uniform at random, a mass of 1 in all: the sum over the mesh, 32768 nodes of 1/32^3
			stab --plain --mesh mesh <$set.1 >nodes
			within "$(awk 'NR > 1 { s += $4 } END { printf "%.17g", s / 32768 }' nodes)" 1 1e-12 "sum, $kernel, $set" # awk adds 32768 of them
			# sum m rho(x) = sum h^3 rho^2; awk adds 40000 and 32768 terms: at most 72768 2^-53 = 8e-12, measured 2.5e-13 (one point, cic)
			within "$(stab --plain <$set.1 | awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "rho") c = i; next } { s += $c }
				END { printf "%.17g", s / 40000 }')" "$(awk 'NR > 1 { s += $4 * $4 } END { printf "%.17g", s / 32768 }' nodes)" \
				"$(awk 'NR > 1 { s += $4 * $4 } END { printf "%.17g", 8e-12 * s / 32768 }' nodes)" "transpose, $kernel, $set"
		done
	done
}
