# Plasmas at the edges: near and beyond the limit of the step, no particles, a cell for all, long runs in a magnetic field.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

step='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'

@test "HC-06: at w dt = 1.9 a cold wave keeps its height for 10000 steps" {
	sh_ok "pinit langmuir -n 64 --cells 16 --amplitude 1e-5 --dt 1.9372232 | cycle -n 10000 --every 1 '$step' | p2m | poisson-fft | mgrad | diag --columns time --modes 1 > t"
	# the largest of the first and of the last 100 steps
	first=$(sed 1d t | head -n 100 | cut -f 2 | sort -g | tail -n 1)
	last=$(tail -n 100 t | cut -f 2 | sort -g | tail -n 1)
	within "$(awk -v a="$first" -v b="$last" 'BEGIN { printf "%.9g", b / a }')" 1 0.01
}

@test "HC-06: at w dt = 2.05 it grows by 0.446 a step, and what is not finite is never written" {
	sh_ok "pinit langmuir -n 64 --cells 16 --amplitude 1e-9 --dt 2.0901619 | cycle -n 30 --every 1 '$step' | p2m | poisson-fft | mgrad | diag --columns time --modes 1 > t"
	# 1/2 of the wave is the growing one; the other is gone after 10 steps
	within "$(sed 1d t | cut -f 2 | awk 'NR == 11 { a = $1 } NR == 31 { printf "%.9g", log($1 / a) / 20 }')" 0.4463 0.001
	sh_ok "pinit langmuir -n 64 --cells 16 --dt 2.0901619 | cycle -n 2000 '$step' | stab --plain --set electrons > u"
	run ! grep -qi nan u
}

@test "no electrons at all, and all of them in one place, go through a step" {
	sh_ok "pinit langmuir -n 0 | cycle -n 2 '$step' | sls"
	printf 'x v mass charge\n0.5 0 1 -1\n0.5 0 1 -1\n0.5 0 1 -1\n' > t
	sh_ok "stab t --law electrostatic --box 0,1 --faces periodic --particle-faces periodic --dt 0.1 --strength mass,charge | cycle -n 5 '${step/p2m/p2m -n 7}' | diag > d"
	below "$(column energy_kinetic < d)" 1e-28 # no self-force
}

@test "HC-08: |v| of 20 electrons after 5000 steps of Omega dt = 100 in three dimensions" {
	sh_ok "pinit gyration --dim 3 --velocities 3 -n 20 --magnetic-field 100 --dt 1 | cycle -n 5000 'push boris/2 drift | m2p | push boris/2' | diag --columns energy_kinetic > t"
	within "$(column energy_kinetic < t)" 10 1e-11
}
