#!/usr/bin/env bash
# Makes the figures of docs/accuracy/README.md: every block of that page is run as printed in an empty directory and leaves NAME.tsv, the numbers,
# and NAME.png, the picture. Then data/atlas/ from the numbers. Names as arguments: those alone. Errors are the same in every run; seconds are this
# machine's, of one thread.
# Needs bin/ and netpbm. SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
top=$(cd "$(dirname "$0")/../.." && pwd)
page=$top/docs/accuracy/README.md
export PATH=${PM_BIN:-$top/bin}:$PATH LC_ALL=C.UTF-8 OMP_NUM_THREADS=1
command -v pnmcat >/dev/null || { echo "atlas: no pnmcat here (apt-get install netpbm)" >&2; exit 1; }

# The name of every picture of the page, in order.
names() { sed -n 's|^!\[.*](\([^)]*\)\.png)$|\1|p' "$page"; }

# block NAME: the commands printed below its picture.
block() {
	awk -v picture="]($1.png)" 'index($0, picture) { there = 1 } /^```$/ { if (on) exit } on { print } /^```sh$/ { on = there }' "$page"
}

make_one() {
	local name=$1 commands began=$SECONDS file
	commands=$(block "$name")
	[ -n "$commands" ] || { echo "atlas: docs/accuracy/README.md has no picture '$name' with commands below it" >&2; return 1; }
	echo "atlas: $name, figure $((++made)) of ${#names[@]}, $SECONDS s so far" >&2
	mkdir "$work/$name"
	ln -s "$top/data" "$top/docs" "$work/$name"
	(cd "$work/$name" && bash -euo pipefail -c "$commands" </dev/null) || { echo "atlas: $name failed" >&2; return 1; }
	for file in "$name.png" "$name.tsv"; do
		[ -s "$work/$name/$file" ] || { echo "atlas: the block of $name left no $file" >&2; return 1; }
		mv "$work/$name/$file" "$out/$file"
	done
	echo "$name: $((SECONDS - began)) s"
}

# data/atlas/: what the word plan chooses from. The forces of one evaluation, on a mesh whose spacing is h_over_scale times the scale of the scene.
force_head() {
	cat <<-END
		# Error of the acceleration and what it costs, p2m to m2p or pp. Made by bash docs/accuracy/atlas.sh (figures force-smooth and
		# force-clustered of docs/accuracy/).
		# smooth: 216000 particles of a periodic plane wave, scale 1/k = 1/(2 pi); clustered: 20000 bodies of a Plummer sphere of scale 1 in open
		# space, against pp; vortex: vortices in space that fill a cube, scale (abs(omega)/abs(lap omega))^(1/2), with a mesh as large as the cube
		# or (vortex-quarter) four times as large; the error of their velocity against the exact one (figure force-vortex).
		# error: relative l2. ns_per_particle: without set-up, one thread of: $(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1);
		# of the mesh's work every particle has its part.
	END
	printf 'scene\tsolver\tkernel\tgradient\th_over_scale\terror\tns_per_particle\n'
}

# force SCENE FILE PARTICLES: error 0 is the reference itself.
force() {
	awk -F'\t' -v OFS='\t' -v scene="$1" -v n="$3" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
		$at["error"] != "-" { print scene, $at["solver"], $at["kernel"], $at["gradient"], $at["h_over_scale"], $at["error"], sprintf("%.4g",
			$at["seconds"] / n * 1e9) }' "$2"
}

# vortex FILE: of the velocity of vortices in space; its numbers have a column of each method and of the part of the mesh that is full.
vortex() {
	awk -F'\t' -v OFS='\t' 'NR > 1 { mesh = $2 == "mesh"; solver = mesh ? "poisson-fft" : $2 == "pp" ? "pp" : "pp --mollifier gaussian-4"
		print $1 == 1 ? "vortex" : "vortex-quarter", solver, mesh ? "m6prime" : "-", mesh ? 6 : "-", $7, $5, $8 }' "$1"
}

step_head() {
	cat <<-'END'
		# Error of the place (langmuir, gyration: of the velocity) after a fixed time against evaluations of the force. Made by
		# bash docs/accuracy/atlas.sh (figure steps of docs/accuracy/).
		# kepler (e = 0.9), kepler-circle (e = 0) and gyration: one turn; langmuir: 3.125 periods; vortex-patch: an elliptic patch of peak
		# vorticity omega, omega t = 20. dt in units of 1/omega
		# (kepler: the mean motion). Relative l2; nan: unstable. kepler-0.5, -0.7, -0.99, -0.999: of that eccentricity, one turn.
		# dt-SCHEME: steps by dt --oscillation; dt in units of the 1/omega of the circle at each distance.
		# ias15: dt is tolerance^(1/7), to which its steps are in proportion.
	END
	printf 'problem\tscheme\tdt\terror\tevaluations\n'
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
out=${OUT:-$top/docs/accuracy} # OUT=DIRECTORY: elsewhere
mkdir -p "$out"
[ $# != 0 ] || mapfile -t all < <(names)
made=0 names=("${@:-${all[@]}}")
for name in "${names[@]}"; do
	make_one "$name"
done
if [ $# = 0 ]; then
	atlas=${OUT:-$top/data/atlas}
	mkdir -p "$atlas"
	{ force_head; force smooth "$out/force-smooth.tsv" 216000; force clustered "$out/force-clustered.tsv" 20000
		vortex "$out/force-vortex.tsv"; } >"$atlas/force.tsv"
	{ step_head; sed 1d "$out/steps.tsv"; } >"$atlas/step.tsv"
fi
