#!/usr/bin/env bash
# A cold plasma oscillates at omega_p = 1; on a mesh at a frequency that depends on kernel, solver and gradient, so swapping one word changes it.
# Law: electrostatic, 1-D, 1024 electrons, one wave in the periodic box, k A = 1e-3, leapfrog, dt = 0.2, 300 steps.
# Expected (PIC-07): sin(omega dt/2) = (dt/2) w with w = cos(k dx/2) for cic, the 3-point Laplacian and 2-point differences: 0.980785280403230
# on 16 cells, so 0.982364553517455; 0.995184726672197 on 32, 0.923879532511287 on 8; tsc 0.974543935458231; cic with spectral solver and gradient
# 0.987165314627917; with 4-point differences the alias sum gives cos(k dx/2) sqrt((4 - cos(k dx))/3). Runge-Kutta 4 has the frequency w itself, less (w
# dt)^4/120. (ngp is in tests/physics/pic.bats.)
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
# shellcheck source=pipelines/numbers.sh
. "$(dirname "$0")/numbers.sh"
export OMP_NUM_THREADS=1 # too small for threads
dt=0.2

leap='push kick/2 drift | P2M | POISSON | MGRAD | m2p | push kick/2' whole='P2M | POISSON | MGRAD | m2p | push rk4'

# omega CELLS P2M POISSON MGRAD [SENTENCE]: frequency from the peaks of the first mode of E.
omega() {
	local sentence=${5:-$leap}
	sentence=${sentence/P2M/$2} sentence=${sentence/POISSON/$3} sentence=${sentence/MGRAD/$4}
	pinit langmuir -n 1024 --cells "$1" --amplitude 1e-3 --dt $dt |
		cycle -n 300 --every 1 "$sentence" |
		$2 | $3 | $4 |
		diag --columns time,energy --growth mode:1 |
		sed -n 's/^# .* omega \([^,]*\),.*/\1/p'
}

# leapfrog W: the frequency of the leapfrog for the frequency W of the mesh.
leapfrog() { calc "2 / $dt * atan2($1 * $dt / 2, sqrt(1 - ($1 * $dt / 2)^2))"; }

echo "a cold wave, dt = $dt"
is "omega, 16 cells" "$(omega 16 p2m poisson-fft mgrad)" 0.982364553517455 1e-5
is "omega, 32 cells" "$(omega 32 p2m poisson-fft mgrad)" "$(leapfrog 0.995184726672197)" 1e-5
is "omega, 8 cells" "$(omega 8 p2m poisson-fft mgrad)" "$(leapfrog 0.923879532511287)" 1e-5
is "omega, 16 cells, poisson-mg" "$(omega 16 p2m poisson-mg mgrad)" 0.982364553517455 1e-5
is "omega, 16 cells, tsc" "$(omega 16 'p2m --kernel tsc' poisson-fft mgrad)" "$(leapfrog 0.974543935458231)" 1e-5
is "omega, 16 cells, spectral" "$(omega 16 p2m 'poisson-fft --symbol spectral' 'mgrad --order spectral')" "$(leapfrog 0.987165314627917)" 1e-5
is "omega, 16 cells, gradient 4" "$(omega 16 p2m poisson-fft 'mgrad --order 4')" "$(leapfrog "$(calc "0.980785280403230 * sqrt((4 - cos(pi / 8)) / 3)")")" 1e-5
is "omega, 16 cells, rk4" "$(omega 16 p2m poisson-fft mgrad "$whole")" "$(calc "0.980785280403230 * (1 - (0.980785280403230 * $dt)^4 / 120)")" 1e-5
finish
