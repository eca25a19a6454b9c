#!/usr/bin/env bash
# A Plummer sphere under particle-mesh gravity: 10000 particles, open space, 64^3 cells of 0.44 a, leapfrog, 200 steps of 1/32.
# Law: gravity, lap phi = 4 pi G rho, x'' = -grad phi, G = M = a = 1. It is an equilibrium except for the smoothing by the mesh: the core is 2 cells wide.
# Expected: mass 0.98519 (the sphere ends at 10 a), momentum zero to rounding, energy conserved to 0.5 %; half-mass radius 1.2875 and 2K/|W| = 1 at the
# start, up to noise and the mesh. The force of the mesh is too weak in the core, so the core widens, to a half-mass radius of 1.495, and 2K/|W| falls to 0.914;
# with 128^3 cells (CELLS=128, eight times the work) it hardly changes. PARTICLES, STEPS, CELLS change the run; the numbers are those of the default.
# Writes pm-plummer.png, the surface density at the end, SIZE pixels wide (320 for docs/gallery/plummer.png). SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
# shellcheck source=pipelines/numbers.sh
. "$(dirname "$0")/numbers.sh"
particles=${PARTICLES:-10000}
steps=${STEPS:-200}
cells=${CELLS:-64}
picture=${PICTURE:-pm-plummer.png}
size=${SIZE:-640}

pinit plummer -n "$particles" --cells "$cells" --seed 1 |
	cycle -n "$steps" --every 10 --checkpoint "$work/end" 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' |
	diag --radii 0.5 --exact >"$work/table"
sdraw --field rho --project --log --area -7,7,-7,7 --size "$size" --title "Plummer sphere, $particles particles, $cells^3 cells, $steps steps" -o "$picture" \
	<"$work/end" >/dev/null

awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i } { printf "%6s %8s %14s %17s %14s %14s\n", $c["step"], $c["time"], substr($c["energy_kinetic"], 1,
	14),
	substr($c["energy_field_mesh"], 1, 17), substr($c["energy"], 1, 14), substr($c["radius_0.5"], 1, 10) }' "$work/table"
scale=$(column momentum_scale last "$work/table")
is "mass" "$(column mass last "$work/table")" "$(column exact_mass 1 "$work/table")" 1e-12
for axis in x y z; do
	is "momentum_$axis over its scale" "$(calc "$(column momentum_$axis last "$work/table") / $scale")" 0 1e-12
done
is "energy at the end over that at the start" "$(calc "$(column energy last "$work/table") / $(column energy 1 "$work/table")")" 1 0.005
is "2K/|W| at the start" "$(column virial_ratio 1 "$work/table")" 1 0.05
is "2K/|W| at the end" "$(column virial_ratio last "$work/table")" 0.914 0.02
is "half-mass radius at the start" "$(column radius_0.5 1 "$work/table")" "$(column exact_radius_0.5 1 "$work/table")" "$(calc "3 / sqrt($particles)")"
is "half-mass radius at the end" "$(column radius_0.5 last "$work/table")" 1.495 0.04
echo "picture: $picture"
finish
