#!/usr/bin/env bash
# Landau damping: a wave in a Maxwellian plasma gives its energy to the particles that keep pace with it.
# Law: electrostatic, 1-D, lambda_D = omega_p = 1, quiet start, amplitude 0.02, 64 cells, leapfrog, dt = 0.1.
# Expected (PIC-01): k = 0.5: omega 1.41566188860454, gamma -0.153359466909605; k = 0.3: 1.15984648059191, -0.0126203684211172. Peaks of the first mode
# of E; 3 to 4 % in gamma and 1 % in omega are what 1000 particles a cell allow.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
# shellcheck source=pipelines/numbers.sh
. "$(dirname "$0")/numbers.sh"
export OMP_NUM_THREADS=1 # small meshes

# wave K N STEPS WINDOW: "omega gamma".
wave() {
	pinit landau --wavenumber "$1" -n "$2" |
		cycle -n "$3" --every 1 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' |
		p2m |
		poisson-fft |
		mgrad |
		diag --columns time --growth mode:1 --window "$4" |
		sed -n 's/^# .* gamma \([^ ]*\) omega \([^,]*\),.*/\2 \1/p'
}

echo "k lambda_D = 0.5"
read -r omega gamma <<<"$(wave 0.5 100000 160 2:15)"
is "omega" "$omega" 1.41566188860454 0.0142
is "gamma" "$gamma" -0.153359466909605 0.0062

echo "k lambda_D = 0.3"
read -r omega gamma <<<"$(wave 0.3 100000 400 2:40)"
is "omega" "$omega" 1.15984648059191 0.0116
is "gamma" "$gamma" -0.0126203684211172 0.0005
finish
