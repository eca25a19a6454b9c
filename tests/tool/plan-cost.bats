# What a plan says about the cost of the whole run, and what planning itself costs.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

@test "planning holds little more than the run planned: no mesh for forces that cancel, no blocks of earlier trials" {
	# Resident sets: lattice 27 MB (833 MB with the mesh that the atlas proposed for a force of round-off), uniform 130 MB as its run (219 MB with the
	# meshes of both forces that smoothing compares). Both plans need 160 MB of addresses; without either mend more than 240 MB.
	for scene in lattice uniform; do
		pinit $scene >start
		(ulimit -v 200000; plan <start >text) || { echo $scene; return 1; }
		grep -q 'a step$' text
	done
	[[ "$(pinit lattice | plan --no-cost --on self-field)" = *"p2m  "*"cic: forces cancel on the mesh of the frame"* ]] || {
		pinit lattice | plan --no-cost --on self-field; return 1; }
}
