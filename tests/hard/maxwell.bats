# Where electromagnetic particles in cells break: charge over many steps, particles at nearly the speed of light, empty sets, all particles in one cell,
# a relativistic beam on the mesh. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

step='push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2'

# plasma N SPEED CELLS: N charges of both signs in a periodic square, with the field of their charge.
plasma() {
	pinit uniform --dim 2 -n "$1" --dispersion "$2" --faces periodic --particle-faces periodic --cells "$3" --dt 0.02 --seed 4 |
		scalc --extensive 'charge = 0.01*mod(id, 2) - 0.005' | smod --law electromagnetic | p2m "${@:4}" | maxwell --gauss
}

@test "HC-10: Gauss's law after many steps of charges on their way, cic and tsc: no trend (1e5 steps with PM_LONG=1)" {
	steps=${PM_LONG:+100000}
	for kernel in cic tsc; do
		sh_ok "$(declare -f plasma); plasma 200 0.2 12x10 --kernel $kernel | cycle -n ${steps:-1000} '${step/--current/--current --kernel $kernel}' |
			p2m --kernel $kernel | diag >t"
		below "$(column gauss_residual <t)" 1e-11 "$kernel"
	done
}

@test "a set of no particles, all particles in one cell, one in each: the field stays finite and Gauss's law holds" {
	sh_ok "pinit em-wave --cells 8 | cycle -n 20 '$step' | diag >t"
	within "$(column energy <t)" 0.000314159265 2e-6
	sh_ok "$(declare -f plasma); plasma 300 0.1 12x10 | scalc 'x = 0.01*x + 0.4, 0.01*y + 0.4' | p2m | maxwell --gauss |
		cycle -n 20 '$step' | p2m | diag >t"
	below "$(column gauss_residual <t)" 1e-12
	sh_ok "pinit em-wave -n 64 --cells 64 | cycle -n 50 '$step' | diag >t"
	within "$(column energy <t)" "$(pinit em-wave -n 64 --cells 64 | diag | column energy)" 1e-6
}

@test "charges and light on cells of ten Debye lengths for omega_p t = 400: m2p heats them by a tenth, m2p --energy-conserving keeps their energy" {
	pinit em-wave --dim 2 --length 3.2 --cells 16 --wave-field 0 | smod --constant background=1 --rename electrons=none --dt 0.14 |
		species electrons -n 16384 --vth 0.02 --loading random --velocities 3 | p2m | maxwell --gauss >start.pm
	for how in "" --energy-conserving; do
		sh_ok "cycle -q -t 400 --every-time 400 '${step/m2p/m2p $how}' <start.pm | diag --columns energy | sed 1d >t"
		change=$(awk 'NR == 1 { a = $1 } END { print $1 / a - 1 }' t)
		if [ "$how" ]; then below "$change" 0.01; else above "$change" 0.08; fi
	done
}

@test "a charge at gamma = 1e6 stays below c, and one at c is refused" {
	for speed in 0.9999999999995 1; do
		printf 'x vx vy vz charge mass\n0.3 %s 0 0 1e-3 1\n' "$speed" |
			stab - --dim 1 --law electromagnetic --strength charge --strength mass --box 0,1 --faces periodic --dt 0.01 --constant c=1 >one.pm
		if [ "$speed" = 1 ]; then
			run -1 bash -o pipefail -c "p2m -n 32 <one.pm | maxwell --gauss | cycle -n 1 '$step' >/dev/null"
			[[ $output == *"has the speed 1, and c is 1 (slower ones, or smod --constant c=C)"* ]]
		else
			sh_ok "p2m -n 32 <one.pm | maxwell --gauss | cycle -n 100 '$step' | diag >t"
			above "$(column energy_kinetic <t)" 9e5
		fi
	done
}
