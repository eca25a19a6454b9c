# subgrid: eddy viscosities on the mesh: exact values, totals, energy, refusals. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# number NAME: of the report of subgrid.
number() { sls --report --format json | grep -o "\"$1\":[-+.e0-9]*" | tail -1 | cut -d: -f2; }
# wave CELLS 'U': a flow in 0..2 pi, and its omega (for the change) that of Taylor and Green.
wave() { pinit taylor-green-3d --cells "$1" | p2m --kernel m6prime | scalc --mesh mesh "u = $2"; }

@test "a shear of 2.385: smagorinsky has (0.17 D)^2 times it, wale and vreman have 0; a helical wave has one nu_t, and all its omega decays by it" {
	pinit vortex-ring --cells 16x16x8 | p2m | scalc --mesh mesh 'u = 2.385*y, 0, 0' >shear
	square=$(sls --format json <shear | grep -o '"h":\[[^]]*' | head -1 | tr -d '"h:[' | awk -F, '{ printf "%.17g", ($1 * $2 * $3)^(2 / 3) }')
	within "$(subgrid <shear | number nu_largest)" "$(calc "0.0289 * 2.385 * $square")" "$(calc "1e-12 * $square")"
	for m in wale vreman; do below "$(subgrid --model $m <shear | number nu_largest)" "$(calc "1e-9 * $square")"; done
	wave 16 'sin(y), 0, cos(y)' >helix # |S| = 1 everywhere
	nu=$(calc '0.0289 * (2 * pi / 16) ^ 2')
	for form in stress curl; do
		scalc --mesh mesh 'omega = -sin(y), 0, -cos(y)' <helix | subgrid --order spectral --form $form >a
		within "$(number nu_mean <a)" "$nu" 1e-15
		below "$(scalc --mesh mesh "d = hypot(domega.x - $nu*sin(y), domega.z - $nu*cos(y))" <a |
			stab --plain --mesh mesh | column d | sort -g | tail -1)" 1e-15
		within "$(number dissipation <a)" "$(calc "$nu * (2 * pi) ^ 3")" 1e-11
	done
	# hyper: C^2 D^2 (D/pi)^2 k^4, k = 1
	subgrid --order spectral --model hyper <helix >a
	below "$(scalc --mesh mesh "d = domega.x - $nu*sin(y)/64" <a | stab --plain --mesh mesh | column d | sort -g | tail -1)" 1e-15
}

@test "total alpha stays to round-off and the energy taken is at least 0, with every model" {
	pinit taylor-green-3d --cells 12 --nu 0 | cycle -n 8 'p2m | poisson-fft | mgrad | stretch | m2p | push rk2 | remesh' |
		p2m | poisson-fft | mgrad >a
	for m in smagorinsky dynamic wale vreman hyper; do
		subgrid --model $m <a >b
		above "$(number dissipation <b)" 0.01 "$m"
		for c in 0 1 2; do
			below "$(stab --plain --mesh mesh <b | column domega_$c | awk '{ s += $1 } END { printf "%.17g", s }')" 1e-12 # 1728 values of 0.1
		done
	done
}

@test "subgrid refuses its term twice and a coefficient of the dynamic model; threads give the same bytes" {
	wave 12 'sin(y), sin(z), sin(x)' >a
	run -1 bash -o pipefail -c 'subgrid <a | subgrid | sls'
	run -2 subgrid --model dynamic --coefficient 0.1
	[[ $output == *"computes its coefficient"* ]]
	subgrid --model dynamic --threads 1 --no-history <a >b
	subgrid --model dynamic --threads 3 --no-history <a | cmp b -
}
