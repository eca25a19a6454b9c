# The gallery and the pages of the methods show the same pictures, and one command makes them.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

listed() { sed -n 's|^!\[.*](gallery/\([^)]*\)\.png)$|\1|p' "$top/docs/gallery.md" | sort; }

@test "every page of a method shows its picture, which is there, small, and made by docs/gallery.md" {
	listed >list
	for page in "$top"/docs/methods/*.md; do
		name=$(basename "$page" .md)
		[ "$(sed -n 's|^!\[.\+](\.\./gallery/\([^)]*\)\.png)$|\1|p' "$page")" = "$name" ] || { echo "$page: no line ![...](../gallery/$name.png)"
		return 1; }
		grep -qx "$name" list || { echo "docs/gallery.md: no ![...](gallery/$name.png) with the commands that make it below (then: make gallery)"
		return 1; }
		picture=$top/docs/gallery/$name.png
		[ "$(head -c 4 "$picture" | tail -c 3)" = PNG ] || { echo "$picture: not there (make gallery)"; return 1; }
		[ "$(wc -c <"$picture")" -le 60000 ] || { echo "$picture: $(wc -c <"$picture") bytes, at most 60000"; return 1; }
	done
}

@test "every page of a method names a source and says where the method ends" {
	for page in "$top"/docs/methods/*.md; do
		grep -qiE 'sources?\b' "$page" || { echo "$page: no source"; return 1; }
		grep -qiE 'limits?\b|weak\b' "$page" || { echo "$page: no limits"; return 1; }
	done
}

@test "the pictures are those of the gallery's list, and each has commands that make it" {
	diff <(listed) <(cd "$top/docs/gallery" && ls -- *.png | sed 's/\.png$//' | sort)
	for name in $(listed); do
		awk -v picture="](gallery/$name.png)" 'index($0, picture) { there = 1 } /^```$/ { if (on) exit } on { print } /^```sh$/ {
			on = there }' "$top/docs/gallery.md" >block
		grep -q "$name\.png" block || { echo "$name: the block below it does not write $name.png"; return 1; }
	done
	grep -q '^!\[.*](docs/gallery/plummer.png)$' "$top/README.md"
}

@test "a picture of the gallery has the same bytes in every run, whatever the directory" {
	command -v gnuplot >/dev/null && command -v pnmcat >/dev/null || skip "no gnuplot or no netpbm here"
	mkdir one two
	OUT=$PWD/one bash "$top/docs/gallery.sh" kernels hdf5 transfer
	(cd two && OUT=$PWD bash "$top/docs/gallery.sh" kernels hdf5 transfer)
	for name in kernels hdf5 transfer; do cmp one/$name.png two/$name.png; done
}

@test "a name that the gallery does not have is refused in one line" {
	command -v gnuplot >/dev/null && command -v pnmcat >/dev/null || skip "no gnuplot or no netpbm here"
	OUT=$PWD run -1 --separate-stderr bash "$top/docs/gallery.sh" nothing
	[[ ${#stderr_lines[@]} = 1 && $stderr == "gallery: docs/gallery.md has no picture 'nothing'"* ]]
}

@test "README, glossary and gallery name every word, glossary and gallery every scene" {
	{
		for name in $(cd "$top/tools" && ls -- *.c *.sh | sed 's/\.[a-z]*$//'); do
			printf '%s\n' "README.md $name" "docs/glossary.md $name" "docs/gallery.md $name"
		done
		for name in $(cd "$top/lib/scene" && ls -- *.c | sed 's/\.c$//'); do printf '%s\n' "docs/glossary.md $name" "docs/gallery.md $name"; done
	} >wanted
	while read -r page name; do
		grep -qE "(^|[^a-z0-9-])$name([^a-z0-9-]|$)" "$top/$page" || { echo "$page does not name $name"; return 1; }
	done <wanted
}

@test "the sentences at the heads of dispersion, phase and filament run as typed" {
	for page in dispersion phase filament; do # lines set off that begin with a program, and not with a formula
		sed -n 's/^    //p' "$top/docs/methods/$page.md" | grep -E '^( *cycle|pinit|awk|stab|dispersion) ' >sentence.sh
		[ "$(wc -l <sentence.sh)" -ge 2 ]
		run -0 bash -euo pipefail sentence.sh
	done
	[[ -s waves.png && -s phase.png && $output == *'"filament"'* ]]
}
