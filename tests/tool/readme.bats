# Every code block of the README is run as printed.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# block N: the Nth sh block of the README.
block() {
	awk -v n="$1" '/^```sh$/ { k++; on = 1; next } /^```$/ { on = 0 } on && k == n' "$top/README.md"
}

@test "README: the first result is within 40 lines" {
	first=$(grep -n '^```sh$' "$top/README.md" | head -n 1 | cut -d: -f1)
	[ "$first" -le 40 ]
	[[ $(block 1) == "sh pipelines/demo.sh" && $(block 2) == "sh tests/check.sh" && -z $(block 12) ]]
}

@test "README: the demo ends with numbers and a picture that exists" {
	(cd "$top" && sh pipelines/demo.sh >"$BATS_TEST_TMPDIR/out")
	picture=$(sed -n '$s/^picture: //p' out)
	[ -s "$top/$picture" ]
	[ "$(head -c 4 "$top/$picture" | tail -c 3)" = PNG ]
	[ "$(grep -cE '[0-9]' out)" -gt 3 ]
}

@test "README: the sentence prints a header and the frames at steps 0, 10 and 20" {
	{ echo "cd '$top'"; block 3; } >sentence.sh
	run -0 --separate-stderr bash -euo pipefail sentence.sh
	[ "$(column step <<<"$output" | tr '\n' ' ')" = "0 10 20 " ]
}

@test "README: swapping words: mesh and direct forces of a cluster agree to 5 per cent" {
	block 4 >swap.sh
	run -0 bash -euo pipefail swap.sh
	within "$(column relative_l2 <<<"$output")" 0.046 0.005 "relative_l2" # measured 0.0458
}

@test "README: a stream can be listed, printed and drawn" {
	block 5 >look.sh
	run -0 bash -euo pipefail look.sh
	[ -s cluster.png ]
}

@test "README: the same words make a vortex step and a plasma step" {
	block 6 > laws.sh
	sh_ok 'bash -euo pipefail laws.sh'
	[[ $output == *circulation* && $output == *energy_kinetic* ]]
}

@test "README: the sentence of the two streams prints their growth rate, within 2 per cent of theory and as the line below it says" {
	block 6 > laws.sh
	grep -q "pinit two-stream -n 100000 |" laws.sh
	grep -q "cycle -n 400 'push kick/2 drift | p2m -n 128 | poisson-fft | mgrad | m2p | push kick/2' --every 4 |" laws.sh
	grep -q "diag .*--growth mode:1$" laws.sh
	sh_ok 'sed -n "/^pinit two-stream/,\$p" laws.sh | bash -euo pipefail > table'
	[ "$(grep -c '^[0-9]' table)" = 101 ] # every 4 steps, and the first
	gamma=$(sed -n '$s/^# mode:1 gamma \([^ ]*\) +- .* omega 0, from .*/\1/p' table)
	within "$gamma" 0.353553390593274 0.0071 # 1/sqrt 8
	want=$(sed -n 's/.*`# mode:1 gamma \([0-9.]*\) +- [0-9.]* omega 0, \(.*\)`.*/\1 \2/p' "$top/README.md")
	within "$gamma" "${want%% *}" 5e-5
	[[ "$(tail -n 1 table)" == *"${want#* }" ]]
}

@test "README: the ring goes as far as a thin one, within 2 per cent, and light in a plasma keeps its energy" {
	block 7 >space.sh
	sh_ok 'bash -euo pipefail space.sh > out'
	awk '/^time/ { table++; next } { print > ("table" table) }' out
	within "$(awk 'END { print $2 }' table1)" 0.152970 0.003 "the ring" # (ln 80 - 0.558)/(4 pi) 0.50265, a/R = 0.1; measured 0.1524
	within "$(awk 'NR == 1 { e = $2 } END { print $2 / e - 1 }' table2)" 0 1e-3 "light" # of the current's noise
}

@test "README: what accuracy costs: eight sentences, a front, a page" {
	block 8 | sed 's/ -o report/ --repeat 1&/' >cost.sh # as printed, but for the seconds, which nobody looks at here
	grep -q 'repeat 1 -o report' cost.sh
	sh_ok 'bash -euo pipefail cost.sh'
	[ "$(grep -cE '^[*~ ] +[1-8] ' <<<"$output")" = 8 ]
	[[ $output == *$'\n* '* && -s report/index.html ]]
}

@test "README: the sentence that plan chooses: a sentence with its reasons, and its run" {
	block 9 >plan.sh
	sh_ok 'bash -euo pipefail plan.sh'
	[[ $output == *"diffusion: on, nu dt/h^2 = "* && $output == *circulation* ]]
}

@test "README: how far from the edge: the limit of the leapfrog, 2, and a page" {
	block 10 >edge.sh
	sh_ok 'bash -euo pipefail edge.sh'
	[[ $output == *" yes "* && -s edge/index.html ]]
}

@test "README: the table of swapped words is what its command prints" {
	bash "$top/pipelines/swaps.sh" > table
	grep '^| ' "$top/README.md" > want
	grep '^| ' table | diff - want
}

# commands PAGE: its indented lines that begin with a program, without the words that explain them at the right.
commands() { sed -nE 's/^    ((pinit|p2m|sh5|h5ls) .*)/\1/p' "$top/docs/$1" | sed 's/   .*//'; }

@test "docs: the commands of the pages on the stream and on HDF5 run as printed" {
	ln -s "$top/docs" .
	commands stream.md >stream
	commands methods/hdf5.md | grep -v snapshot_ >hdf5 # a file that is not here
	[ "$(cat stream hdf5 | wc -l)" = 7 ]
	while read -r line; do
		run -0 bash -c "$line 2>&1" # without pipefail: head closes its pipe early
		[[ $line == *-o* || ${#lines[@]} -ge 2 ]] || { echo "$line: $output"; return 1; }
	done < <(cat stream hdf5 | sed 's/; h5diff.*//')
	run -1 h5diff cloud.h5 mesh.h5 # they differ, and that is found
	[[ $output == *"differences found"* ]]
}

@test "README: the pictures are there and small" {
	sed -n 's/^!\[.*](\(.*\))$/\1/p' "$top/README.md" >pictures
	[ "$(wc -l <pictures)" = 3 ]
	while read -r picture; do
		[ -s "$top/$picture" ]
		[ "$(wc -c <"$top/$picture")" -le 60000 ]
	done <pictures
}

@test "README and the pages of docs/: every link leads somewhere" {
	for page in "$top"/README.md "$top"/docs/*.md "$top"/docs/methods/*.md; do
		grep -o '](\([^)]*\))' "$page" | tr -d '()]' | while read -r f; do [[ $f == http* || -e ${page%/*}/$f ]] || { echo "$page: $f"; exit 1; }; done
	done
}

@test "the files that pages and heads name by their paths are there" {
	missing=$(cd "$top" &&
		grep -rhoE '\b(tests|pipelines|lib|tools|bench|docs|data)/[A-Za-z0-9_./-]+\.(sh|bats|c|h|py|md|awk|bash)\b' README.md docs lib tools pipelines \
			tests/*.sh bench | sort -u | while read -r f; do [ -e "$f" ] || echo "$f"; done)
	echo "$missing"
	[ -z "$missing" ]
}

@test "the .c and .h files that comments name are there" {
	cd "$top"
	grep -rhE '/\*|^ \*|# ' --include=*.[ch] --include=*.sh --include=*.bats lib tools tests bench | grep -v '#include <' |
		grep -oE '(^|[^A-Za-z0-9_.-])[A-Za-z0-9_-]{2,}\.[ch]\b' | tr -cd 'A-Za-z0-9_.\n-' | sort -u >"$BATS_TEST_TMPDIR/named" # {2,}: k.h is a product
	find lib tools tests bench -name '*.[ch]' -printf '%f\n' | sort -u >"$BATS_TEST_TMPDIR/there"
	run -0 comm -23 "$BATS_TEST_TMPDIR/named" "$BATS_TEST_TMPDIR/there"
	echo "$output"
	[ -z "$output" ]
}

@test "every option that the README or a page names is one of a tool" {
	for t in "${PM_BIN:-$top/bin}"/*; do "$t" --complete | tr ' \t' '\n\n'; done | grep '^--' >there
	grep -ohE -- '--[a-z][a-z0-9-]+' "$top"/bench/*.sh >>there # of our scripts
	sed -nE 's/.*\.name = "([a-z-]+)", .*\.kind = PM_.*/--\1/p' "$top"/docs/*.md >>there # of the words that the pages print
	printf -- '--%s\n' bind-to map-by nodes ntasks-per-node cpus-per-task >>there # of launchers of MPI, and of Slurm
	sort -u -o there there
	sed 's/pkg-config [^)`]*//' "$top"/README.md "$top"/docs/*.md "$top"/docs/methods/*.md | grep -oE -- '--[a-z][a-z0-9-]+' | sort -u >named
	comm -23 named there >wrong
	cat wrong
	[ ! -s wrong ]
}
