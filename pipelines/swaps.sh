#!/usr/bin/env bash
# One word swapped at a time, in three laws: gravity (cold-collapse in 1-D, mean speed at t = 2), vortices in the plane (taylor-green-2d, enstrophy
# at t = 1), plasma (langmuir, kinetic energy at t = 1). Prints a table (markdown): relative error against the scene's exact solution.
# The same sentence, the same table: it is in the README, and a test runs this again. SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
. "$(dirname "$0")/numbers.sh"
export OMP_NUM_THREADS=1 # small meshes: threads would only wait for each other

leap='push kick/2 drift | p2m --kernel KERNEL | SOLVER | mgrad --order ORDER | m2p | push kick/2'
whole='p2m --kernel KERNEL | SOLVER | mgrad --order ORDER | m2p | push SCHEME'
vortex='p2m --kernel KERNEL | SOLVER | mgrad --order ORDER | diffuse | m2p | push SCHEME | remesh --kernel m6prime'

# error SCENE TIME COLUMN KERNEL SOLVER ORDER SCHEME: |column / exact - 1| at the end.
error() {
	local sentence=$whole
	[ "$7" != leapfrog ] || sentence=$leap
	[[ $1 != taylor-green* ]] || sentence=$vortex
	sentence=${sentence//KERNEL/$4} sentence=${sentence//SOLVER/$5} sentence=${sentence//ORDER/$6} sentence=${sentence//SCHEME/$7}
	# shellcheck disable=SC2086 # a scene and its options
	pinit $1 | cycle -t "$2" "$sentence" | p2m --kernel "$4" | poisson-fft | mgrad | diag --exact |
		awk -F'\t' -v c="$3" 'NR == 1 { for (i = 1; i <= NF; i++) { if ($i == c) a = i; if ($i == "exact_" c) b = i }; next }
			{ e = $a / $b - 1; printf "%.1e", e < 0 ? -e : e }'
}

gravity() { error 'cold-collapse --dim 1 -n 512 --cells 64 --dt 0.05' 2 speed_rms "$@"; }
plane() { error 'taylor-green-2d --cells 32 --dt 0.1' 1 enstrophy "$@"; }
plasma() { error 'langmuir -n 512 --cells 64 --dt 0.1' 1 energy_kinetic "$@"; }

row() { # NAME, then KERNEL SOLVER ORDER SCHEME of a particle law, then the scheme of the vortices
	printf '| %s | %s | %s | %s |\n' "$1" "$(gravity "$2" "$3" "$4" "$5")" "$(plane "${7:-$2}" "$3" "$4" "$6")" "$(plasma "$2" "$3" "$4" "$5")"
}

fft=poisson-fft fd2='poisson-fft --symbol fd2'
echo '| word swapped | gravity | vortices | plasma |'
echo '|---|---|---|---|'
row 'none: cic (m6prime), spectral solver, order 4, leapfrog (lsrk3)' cic "$fft" 4 leapfrog lsrk3 m6prime
row 'kernel: tsc (m4prime)' tsc "$fft" 4 leapfrog lsrk3 m4prime
row 'solver: poisson-fft --symbol fd2' cic "$fd2" 4 leapfrog lsrk3 m6prime
row 'solver: poisson-mg' cic poisson-mg 4 leapfrog lsrk3 m6prime
row 'solver: poisson-relax' cic poisson-relax 4 leapfrog lsrk3 m6prime
row 'gradient: order 2' cic "$fft" 2 leapfrog lsrk3 m6prime
row 'gradient: spectral' cic "$fft" spectral leapfrog lsrk3 m6prime
row 'scheme: rk4' cic "$fft" 4 rk4 rk4 m6prime
row 'scheme: euler' cic "$fft" 4 euler euler m6prime
