# The benchmark programs of bench/: their counts, which need no clock, and the tables they make. The results are in docs/speed.md.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

@test "counts.sh: 2 % more instructions pass, 4 % more or fewer do not, nor does a case that is not counted any more" {
	printf '# gcc\nfast\t100\tpoint\nslow\t2000\tparticle\n' >recorded
	export COUNTS=$PWD/recorded
	without valgrind # nothing is run, and nothing is skipped
	printf '# gcc\nfast\t102\tpoint\nslow\t1960\tparticle\n' >now
	run -0 bash "$top/bench/counts.sh" --table "$PWD/now"
	[ "$(grep -c '^ok' <<<"$output")" = 2 ]
	printf '# gcc\nfast\t104\tpoint\nslow\t2000\tparticle\n' >now
	run -1 bash "$top/bench/counts.sh" --table "$PWD/now"
	[[ "$output" == *"not ok - fast: 104 instructions per point, 100 recorded"* ]]
	printf '# gcc\nfast\t100\tpoint\nslow\t1920\tparticle\n' >now
	run -1 bash "$top/bench/counts.sh" --table "$PWD/now"
	printf '# gcc\nfast\t100\tpoint\n' >now
	run -1 bash "$top/bench/counts.sh" --table "$PWD/now"
	[[ "$output" == *"slow was not counted"* ]]
}

@test "make counts: fewer instructions are recorded, up to 3 % more are not, beyond the reason is demanded" {
	printf '# gcc\n# case, instructions per item, item\n' | tee recorded >now
	printf 'a\t100\tpoint\tchecks faces\nb\t100\tpoint\tsince then wider\nc\t100\tpoint\nd\t100\tpoint\n' >>recorded
	printf 'a\t102\tpoint\nb\t90\tpoint\nc\t99\tpoint\nd\t104\tpoint\ne\t7\tpair\n' >>now
	export COUNTS=$PWD/recorded
	run -0 bash "$top/bench/counts.sh" --renew-table "$PWD/now"
	[ "$(sed 1,2d recorded)" = $'a\t100\tpoint\tchecks faces\nb\t90\tpoint\t\nc\t99\tpoint\t\nd\t104\tpoint\t?\ne\t7\tpair\t' ]
	run -1 bash "$top/bench/counts.sh" --table "$PWD/now"
	[[ "$output" == *"not ok - d: more than before without a reason"* ]]
	sed -i 's/?/now finds more/' recorded
	run -0 bash "$top/bench/counts.sh" --table "$PWD/now"
}

@test "the recorded counts name their compiler and have a number for every hot loop" {
	head -n 1 "$top/bench/counts.tsv" | grep -qE '^# (gcc|clang) [0-9.]+ '
	for case in 'p2m cic' 'p2m pcs' 'p2m m6prime' 'm2p cic, vector' 'poisson-fft periodic 32^3' 'poisson-mg V(2,2) 32^3' 'pp half' 'push kick/2 drift' \
		'mgrad order 2'; do
		[ "$(awk -F'\t' -v c="$case" '$1 == c { print ($2 > 1) }' "$top/bench/counts.tsv")" = 1 ]
	done
}

@test "the hot loops take the instructions recorded in bench/counts.tsv, within 3 %" {
	program=$top/build/portable/bench/counts
	[ -n "${PM_LONG:-}" ] || [ -x "$program" ] || skip "long: make counts-check"
	[ -z "${PM_LONG:-}" ] || make -s -C "$top" B=build/portable PORTABLE=1 build/portable/bench/counts
	run -0 bash "$top/bench/counts.sh" --check "$program"
	[[ "$output" != *"not ok"* ]]
	[[ "$output" != counts:\ skipped* ]] || skip "${output#*skipped, }"
}

@test "the tables of docs/speed.md are made from rows: those of a kernel that was measured, and no other line" {
	printf 'pp\tfull\t1\t4.1\tGpair/s\t1%%\t-\t30\t4.4\t0.93\tplain loop\t4.2\t0.98\t>= 0.95\tyes\n' >rows.tsv
	printf 'above\n<!-- rows: pp -->\nold\n<!-- end -->\nbetween\n<!-- rows: push -->\nkept\n<!-- end -->\n' >page.md
	awk -v markdown=1 -f "$top/bench/table.awk" rows.tsv page.md >new.md
	[ "$(grep -c 'pp | full | 1 | 4.1 | Gpair/s' new.md)" = 1 ]
	[ "$(grep -cE '^(above|between|kept)$' new.md)" = 3 ]
	run ! grep -q '^old$' new.md
	# Regenerated from the same rows it does not change.
	awk -v markdown=1 -f "$top/bench/table.awk" rows.tsv new.md | cmp - new.md
	# Every program of bench/ that prints rows has its place on the page.
	for kernel in machine start pass-through cycle p2m m2p poisson-fft poisson-mg pp pse push mgrad diag step; do
		grep -qE "^<!-- rows:.* $kernel( .*)? -->$" "$top/docs/speed.md"
	done
}
