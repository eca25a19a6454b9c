#!/usr/bin/env bash
# Landau damping: a wave in a Maxwellian plasma loses its energy to the particles that move at its phase speed.
# Law: electrostatic, 1-D, lambda_D = omega_p = 1, k A = 1e-3, 64 cells, tsc, leapfrog, dt = 0.1; 160 beams of 256 particles with the weights of the
# Maxwellian, so there is no noise, and no recurrence before 2 pi/(k dv) = 84/k.
# Window, the same rule for all k: from 5 pi/(2 omega) on, when the second root has decayed (the same fit to the exact linear solution then gives gamma to 1
# %); to pi/sqrt(k A) = 99, half a bounce of trapped electrons, but not beyond ln(1e4)/|gamma|, when 1e-4 of the wave is left.
# Expected (PIC-01): omega and gamma for k = 0.1: 1.01519752554410, 0; 0.3: 1.15984648059191, -0.0126203684211172; 0.5: 1.41566188860454,
# -0.153359466909605; 1.0: 2.04590486569062, -0.851330458692056. Within 0.3 % in omega and 1.5 % in gamma; the mesh (k dx = 0.1), the leapfrog and the
# second root each leave tenths of a per cent.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
# shellcheck source=pipelines/numbers.sh
. "$(dirname "$0")/numbers.sh"
export OMP_NUM_THREADS=1 # small meshes
amplitude=1e-3

# wave K OMEGA GAMMA [SENTENCE]: prints "omega gamma" that are measured.
wave() {
	local from to
	from=$(calc "2.5 * pi / $2")
	to=$(calc "$3 < -1e-3 && log(1e4) / -($3) < pi / sqrt($amplitude) ? log(1e4) / -($3) : pi / sqrt($amplitude)")
	pinit landau --wavenumber "$1" -n 40960 --beams 160 --amplitude $amplitude |
		cycle -t "$to" "${4:-push kick/2 drift | p2m --kernel tsc | poisson-fft | mgrad | m2p | push kick/2} |
			diag --columns time --growth mode:1 --window $from:$to --tee $work/table" >"$work/last"
	sed -n 's/^# .* gamma \([^ ]*\) .* omega \([^,]*\),.*/\2 \1/p' "$work/table"
}

while read -r k want_omega want_gamma; do
	echo "k lambda_D = $k"
	read -r omega gamma <<<"$(wave "$k" "$want_omega" "$want_gamma")"
	is "omega" "$omega" "$want_omega" "$(calc "0.003 * $want_omega")"
	is "gamma" "$gamma" "$want_gamma" "$(calc "$want_gamma < -1e-3 ? -0.015 * $want_gamma : 1e-4")"
done <<-END
	0.1 1.01519752554410 0
	0.3 1.15984648059191 -0.0126203684211172
	0.5 1.41566188860454 -0.153359466909605
	1.0 2.04590486569062 -0.851330458692056
END

echo "k lambda_D = 1, one word swapped"
while IFS=: read -r name sentence; do
	read -r omega gamma <<<"$(wave 1.0 2.04590486569062 -0.851330458692056 "$sentence")"
	is "omega, $name" "$omega" 2.04590486569062 0.0061
	is "gamma, $name" "$gamma" -0.851330458692056 0.0128
done <<-END
	kernel pcs:push kick/2 drift | p2m --kernel pcs | poisson-fft | mgrad | m2p | push kick/2
	poisson-mg:push kick/2 drift | p2m --kernel tsc | poisson-mg | mgrad | m2p | push kick/2
	gradient 4:push kick/2 drift | p2m --kernel tsc | poisson-fft | mgrad --order 4 | m2p | push kick/2
	rk4:p2m --kernel tsc | poisson-fft | mgrad | m2p | push rk4 | p2m --kernel tsc | poisson-fft | mgrad
END
finish
