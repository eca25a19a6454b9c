# Crossing time, Coulomb logarithm, relaxation time, and the heating by encounters against the number of bodies (002:CL2, CL3, N17, N18).
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

@test "002:N17, CL2: relaxation_time is N/(8 ln Lambda) crossing times of R/v, R = G M^2/|W|; Lambda is N, or R over the softening" {
	pinit plummer -n 1000 --softening 1e-6 --cells 8 >a
	diag --pair --columns energy_kinetic,energy,mass,crossing_time,coulomb_logarithm,relaxation_time a | tail -1 >b
	read -r k e m t l r <b
	within "$t" "$(calc "$m^2/($k-($e))/sqrt(2*$k/$m)")" 1e-12
	within "$l" "$(calc 'log(1000)')" 1e-14
	within "$(calc "$r/$t")" 18.0956 1e-4 # 1000/(8 ln 1000); of 1e5 bodies 1085.7, 1e11 4.9e8
	smod --constant softening=0.2 a | diag --pair --columns energy_kinetic,energy,mass,crossing_time,coulomb_logarithm | tail -1 >b
	read -r k e m t l <b
	within "$l" "$(calc "log($m^2/($k-($e))/0.2)")" 1e-12
	# globular cluster, 1e5 stars, 3 pc and 6 km/s (002:CL3, N18): 0.489 Myr to cross, 0.53 Gyr to relax
	within "$(calc '3*3.0857e13/6/3.1557e13*1e5/(8*log(1e5))')" 531 1
}

@test "002:N17: bodies in equilibrium change their energies by encounters as N/(8 ln N) says, within a factor of two, and as the power -0.85 of N" {
	for n in 200 800; do
		for seed in 1 2 3 4; do
			pinit plummer -n $n --seed $seed --dt 0.02 --softening 0.01 |
				cycle -q -n 1 'pp --potential | push kick/2 drift | pp --potential | push kick/2' >a
			cycle -q -t 6 'push kick/2 drift | pp --potential | push kick/2' <a >b
			for i in a b; do
				stab --plain $i | awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
					{ print $(c["vx"])^2 + $(c["vy"])^2 + $(c["vz"])^2, $(c["phi"]) }' >$i.e
			done
			# (Delta E)^2 = v^2 (Delta v)^2/3 = v^4 T/(3 t_relax)
			paste a.e b.e | awk -v relax="$(diag --columns relaxation_time a | tail -1)" '{ d = ($3 - $1) / 2 + $4 - $2; s += d * d; v += $1; m++ }
				END { print s / m / ((v / m)^2 * 6 / 3), 1 / relax }'
		done | awk '{ s += $1; t += $2 } END { print s / NR, s / t }' >$n
		between "$(cut -d' ' -f2 $n)" 1.3 2.4 # measured 1.6, 1.8, 1.7, 2.0 for 200, 400, 800, 1600, four samples each
	done
	between "$(calc "log($(cut -d' ' -f1 800)/$(cut -d' ' -f1 200))/log(4)")" -1.05 -0.65 # -0.81 by N/ln N
}
