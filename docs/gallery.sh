#!/usr/bin/env bash
# Makes the pictures of docs/gallery.md into docs/gallery/: every block of that page is run as printed and makes the picture above it. Names as arguments:
# those alone.
# Needs bin/, gnuplot for the plots of columns, netpbm for pictures side by side. Equal bytes in every run. SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
page=$top/docs/gallery.md
# Small runs: threads would only wait for each other.
export PATH=${PM_BIN:-$top/bin}:$PATH LC_ALL=C.UTF-8 OMP_NUM_THREADS=1
for program in gnuplot pnmcat; do
	command -v $program >/dev/null || { echo "gallery: no $program here (apt-get install gnuplot-nox netpbm)" >&2; exit 1; }
done

# The name of every picture of the page, in order.
names() { sed -n 's|^!\[.*](gallery/\([^)]*\)\.png)$|\1|p' "$page"; }

# block NAME: the commands printed below its picture.
block() {
	awk -v picture="](gallery/$1.png)" 'index($0, picture) { there = 1 } /^```$/ { if (on) exit } on { print } /^```sh$/ { on = there }' "$page"
}

# make_one NAME: runs its block in an empty directory from which the tree's own files can be seen.
make_one() {
	local name=$1 commands
	commands=$(block "$name")
	[ -n "$commands" ] || { echo "gallery: docs/gallery.md has no picture '$name' with commands below it" >&2; return 1; }
	if grep -q 'tests/browser.py ' <<<"$commands" && ! command -v chromium >/dev/null; then
		echo "gallery: $name left as it is: no chromium here (apt-get install chromium)" >&2
		return
	fi
	if grep -q ' ffmpeg ' <<<" ${commands//$'\n'/ } " && ! command -v ffmpeg >/dev/null; then
		echo "gallery: $name left as it is: no ffmpeg here (apt-get install ffmpeg)" >&2
		return
	fi
	mkdir "$work/$name"
	ln -s "$top/data" "$top/docs" "$top/pipelines" "$top/tests" "$work/$name"
	(cd "$work/$name" && bash -euo pipefail -c "$commands" </dev/null >"$work/log") || { echo "gallery: $name failed" >&2; return 1; }
	[ -s "$work/$name/$name.png" ] || { echo "gallery: the block of $name left no $name.png" >&2; return 1; }
	mv "$work/$name/$name.png" "$out/$name.png"
	echo "$name"
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
out=${OUT:-$top/docs/gallery} # OUT=DIRECTORY: elsewhere
mkdir -p "$out"
[ $# != 0 ] || mapfile -t all < <(names)
for name in "${@:-${all[@]}}"; do
	make_one "$name"
done
