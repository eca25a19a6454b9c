# The repository: what is installed, and the rules for its directories.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

tools() { (cd "$top/tools" && ls -- *.c *.sh | sed 's/\.[a-z]*$//' | sort); }

# The files of the repository, one a line; where there is none (an archive, a copy without .git) the test is skipped.
tracked() { git -C "$top" ls-files; }
in_git() { tracked >/dev/null 2>&1 || skip "no git, or no repository of it, here"; }

@test "the root holds what it should, and nothing else" {
	in_git
	diff <(printf '%s\n' .ci .gitignore COPYING Makefile NEWS README.md bench data docs lib packaging pipelines python tests tools) \
		<(tracked | sed 's|/.*||' | sort -u)
}

# `_` only where a language wants it: modules of Python, completions of zsh (_name).
@test "names of files are letters, digits, dots and dashes inside, with a letter among them" {
	in_git
	bad=$(tracked | tr / '\n' | sort -u | grep -vE '^\.?[A-Za-z0-9]([A-Za-z0-9.-]*[A-Za-z0-9])?$|^(__)?[a-z][a-z0-9_]*\.py$|^_[a-z][a-z0-9-]*$' || true
		tracked | tr / '\n' | sort -u | grep -v '[A-Za-z]' || true)
	echo "$bad"
	[ -z "$bad" ]
}

# awk's print x > y writes to a file that is called y (1050 of them once). What follows > must be a name in quotes or in parentheses, and a comparison
# must stand in parentheses. Here S is a string and P a parenthesis; shell's printf has no comma behind its format.
outside_parentheses() {
	awk '{ line = $0; gsub(/\\+"/, "\"", line); gsub(/"([^"\\]|\\.)*"/, "S", line); while (gsub(/\([^()]*\)/, "P", line)); }
		line ~ /(^|[^A-Za-z_])(print[ SP]|printf S,)[^;}|]*>[ >]*[^=SP> ]/ { print FILENAME ":" FNR ": " $0 }' "$@"
}

@test "no awk compares with > inside a print that has no parentheses" {
	printf '%s\n' "awk '{ print \$1 > 0 }'" "awk '{ printf \"%s\", i > n ? 1 : 2 }'" 'print "a" b > c' >wrong
	printf '%s\n' "awk '{ print (\$1 > 0) }'" "awk '{ print x > \"/dev/stderr\" }'" "awk '{ print } x > 0'" "printf 'a' >b" 'printf "%s, " "$a" >b' \
		"print a >= b" >right
	[ "$(outside_parentheses wrong | wc -l)" = 3 ]
	[ -z "$(outside_parentheses right)" ]
	bad=$(cd "$top" && outside_parentheses Makefile .ci/run $(find bench docs lib pipelines tests tools -name '*.sh' -o -name '*.bats' -o -name '*.bash' \
		-o -name '*.awk' -o -name '*.md' | grep -v house.bats))
	echo "$bad"
	[ -z "$bad" ]
}

# A `! command` is exempt from errexit: where it is not the last line of a test, nothing looks at it. `! A || B` is looked at.
idle_lines() {
	awk 'FNR == 1 { on = held = 0 } held && !/^}/ { print at } { held = 0 } /^@test/ { on = 1 } /^}/ { on = 0 }
		on && /^[ \t]*! / && !/\|\|/ { held = 1; at = FILENAME ":" FNR ": " $0 }' "$@"
}

@test "no line of a test begins with ! but the last, which is the only one that bash looks at" {
	printf '%s\n' '@test "a" {' $'\t! true' $'\ttrue' '}' >wrong.bats
	printf '%s\n' '@test "a" {' $'\t! true || return 1' $'\trun ! true' $'\t! true' '}' >right.bats
	[ "$(idle_lines wrong.bats right.bats)" = $'wrong.bats:2: \t! true' ]
	bad=$(cd "$top" && idle_lines tests/*/*.bats)
	echo "$bad"
	[ -z "$bad" ]
}

# long_lines FILE...: lines of more than 160 columns, a tab being eight.
long_lines() {
	awk '{ at = 0; n = split($0, part, "\t")
		if (length + 7 * n > 160) { for (i = 1; i <= n; i++) at += length(part[i]) + (i < n ? 8 - (at + length(part[i])) % 8 : 0)
			if (at > 160) print FILENAME ":" FNR ": " at " columns" } }' "$@"
}

@test "no line of C, Python, JavaScript, awk, shell or make has more than 160 columns" {
	printf '\t%0152d\n' 0 | tee a.c b.py >c.awk
	printf '\t%0153d\n' 0 | tee d.c e.py >f.sh
	printf '@test "%0145d" {\n}\n' 0 >g.bats
	[ "$(long_lines ?.*)" = $'d.c:1: 161 columns\ne.py:1: 161 columns\nf.sh:1: 161 columns' ]
	bad=$(cd "$top" && long_lines Makefile .ci/run $(find lib tools tests bench pipelines docs packaging python -type f |
		grep -E '\.([ch]|sh|bats|bash|awk|py|js|css)$'))
	echo "$bad"
	[ -z "$bad" ]
}

# tool_sizes FILE...: the longest and the median of the numbers of lines.
tool_sizes() { for f in "$@"; do wc -l <"$f"; done | sort -n | awk '{ n[NR] = $1 } END { print n[NR], (n[int((NR + 1) / 2)] + n[int(NR / 2) + 1]) / 2 }'; }

# A tool is options, help and what it asks of the library; what grows beyond that is a method, which has a room in lib.
@test "no tool has 180 lines or more, and their median is below 110" {
	seq 179 >a.c && seq 109 >b.sh && seq 3 >c.c && seq 110 >d.c
	[ "$(tool_sizes a.c b.sh c.c)" = "179 109" ]
	[ "$(tool_sizes ?.*)" = "179 109.5" ]
	read -r longest median < <(tool_sizes "$top"/tools/*.c "$top"/tools/*.sh)
	echo "the longest has $longest lines, the median is $median:"
	(cd "$top/tools" && wc -l -- *.c *.sh | sort -n)
	awk "BEGIN { exit !($longest < 180 && $median < 110) }"
}

# many_arguments FILE...: functions whose head, in column 1, has more than eight arguments; what is in brackets inside them is one of them.
many_arguments() {
	awk '/^[a-z][A-Za-z0-9_ *]*\(/ {
		name = $0; sub(/\(.*/, "", name); sub(/.*[ *]/, "", name)
		for (head = $0; gsub(/\(/, "(", head) > gsub(/\)/, ")", head) && (getline line) > 0;) head = head " " line
		sub(/^[^(]*\(/, "", head); gsub(/\/\*[^*]*\*\//, "", head)
		while (gsub(/\([^()]*\)/, "", head));
		sub(/\).*/, "", head)
		if (gsub(/,/, "", head) > 7) print FILENAME ": " name }' "$@"
}

@test "no function has more than 8 arguments: those take a struct" {
	printf '%s\n' 'int nine(int a, int b, int c, int d, int (*e)(int, int),' $'\tint f[2], int g, int h, int i)' '{' '}' >wrong.c
	printf '%s\n' 'int eight(int a, int b, int c, int d, int (*e)(int, int), int f, int g, int h) __attribute__((format(printf, 2, 3)));' >right.h
	[ "$(many_arguments wrong.c right.h)" = "wrong.c: nine" ]
	bad=$(cd "$top" && many_arguments lib/*/*.[ch] tools/*.c tests/unit/*.[ch] bench/*.[ch])
	echo "$bad"
	[ -z "$bad" ]
}

@test "a clang that has no OpenMP is told what to install before anything compiles" {
	printf '#!/bin/sh\necho "ld: cannot find -lomp" >&2\nexit 1\n' >clang
	chmod +x clang
	run -2 --separate-stderr make -s -C "$top" B="$PWD/b" CC="$PWD/clang" all
	[[ ${#stderr_lines[@]} = 1 && $stderr == *"-fopenmp does not link: install libomp-dev"*"or use CC=gcc"* && ! -e b ]]
	make -n -C "$top" B="$PWD/b" CC="$PWD/clang" clean
}

@test "check shows how far it is, names what failed and what was skipped and why, and counts a file that dies or is not there as failed" {
	sed 's/^%/@/' >a.bats <<-'END'
		%test "good" { sleep 0.5; }
		%test "bad" { echo because; false; }
		%test "long" { skip "no time"; }
	END
	printf '%stest "open" {\n' @ >b.bats
	# bats within bats: without what the outer one exports
	run -1 env -i PATH="$(tr : '\n' <<<"$PATH" | grep -v bats-core |
		paste -sd:)" HOME="$HOME" REPORTS="$PWD/reports" EVERY=0.1 bash "$top/tests/run.sh" "$PWD"/{a,b,c}.bats
	echo "$output"
	[[ $output == *"check: "[0-3]" of 3 files, "*" tests, "*" failed, "* && $output == *"--- $PWD/a.bats"*"not ok 2 bad"*"# because"* &&
		$output == *": long: no time"* ]]
	[[ ${lines[-1]} =~ ^[12]\ passed,\ 3\ failed,\ [12]\ skipped$ ]]
}

@test "continuous integration runs the README's test command" {
	command=$(grep -x 'sh tests/check\.sh' "$top/README.md")
	grep -qF " $command" "$top/.ci/run"
}

# Installs into ./root (a test that needs it calls it); what is built already is only copied.
install_here() {
	# One at a time: tests run side by side.
	flock "$top/build" make -s -C "$top" DESTDIR="$PWD/root" PREFIX=/usr "${@:-install}"
}

@test "every tool is a program, and every program is a tool" {
	[ "$(printf '%s\n' pmpipe $(tools) | sort)" = "$(ls "${PM_BIN:-$top/bin}" | sort)" ]
}

@test "no program of ours hides one of the system's" {
	for t in $(tools); do
		[ -z "$(command -p -v "$t")" ] || { echo "$t"; return 1; }
	done
}

@test "make install puts programs, libraries, headers, pages and completion in place; uninstall takes them away" {
	install_here
	for t in $(tools); do
		[ -x "root/usr/libexec/pmpipe/$t" ]
		[ -s "root/usr/share/man/man1/pmpipe-$t.1" ]
	done
	[ "$(ls root/usr/bin root/usr/share/bash-completion/completions)" = "$(printf '%s\n' root/usr/bin: pmpipe '' \
		root/usr/share/bash-completion/completions: pmpipe)" ]
	for f in man/man1/pmpipe.1 bash-completion/completions/pmpipe zsh/site-functions/_pmpipe fish/vendor_completions.d/pmpipe.fish \
		doc/pmpipe/methods/kernels.md; do
		[ -s "root/usr/share/$f" ]
	done
	[ -s root/usr/lib/libpmpipe.a ]
	[ -s root/usr/lib/libpmpipe.so ]
	[ "$( (public; echo pmpipe-read.h) | sort)" = "$(cd root/usr/include/pmpipe && find . -type f | sed 's|^\./||' | sort)" ]
	[ "$(PKG_CONFIG_PATH=root/usr/lib/pkgconfig pkg-config --modversion pmpipe)" = "$(sed -n 's/^#define PM_VERSION "\(.*\)"/\1/p' \
		"$top/lib/base/base.h")" ]
	install_here WITH_WORDS=1 install
	for t in $(tools); do
		[ -x "root/usr/bin/$t" ]
		[ -s "root/usr/share/man/man1/$t.1" ]
		[ -s "root/usr/share/bash-completion/completions/$t" ]
	done
	rm root/usr/bin/cycle
	echo another >root/usr/bin/cycle
	install_here uninstall
	[ "$(find root ! -type d)" = "$(printf '%s\n' root/usr/bin/cycle)" ]
}

# block LANGUAGE N FILE: the N-th block of code in a page.
block() { awk -v fence="\`\`\`$1" -v n="$2" '$0 == fence { on = ++k == n; next } /^```$/ { on = 0 } on' "$3"; }

# The programs and the library under ./root, as if they were installed.
use_library() {
	export PKG_CONFIG_PATH=$PWD/root/usr/lib/pkgconfig PKG_CONFIG_SYSROOT_DIR=$PWD/root LD_LIBRARY_PATH=$PWD/root/usr/lib
	PATH=$PWD/root/usr/libexec/pmpipe:$PATH
}

public() { make -s -C "$top" public | tr ' ' '\n' | sed 's|^lib/||'; }

@test "docs/library.md: the program compiles and runs as printed, gives what the words give to the last bit, and passes a cut stream's message on" {
	install_here
	block c 1 "$top/docs/library.md" >meshforce.c
	block sh 1 "$top/docs/library.md" >program.sh
	use_library
	bash -euo pipefail program.sh >rows
	[ "$(column step <rows)" = 1 ]
	gcc -std=c11 -Wall -Wextra -Werror -o meshforce meshforce.c $(pkg-config --cflags --libs pmpipe)
	pinit uniform -n 300 --cells 9x8x7 --no-history >a.pm
	p2m --kernel tsc <a.pm | poisson-fft --plan estimate | mgrad --order 4 | m2p >words
	./meshforce <a.pm >program
	scmp --field acc --tolerance 0 words program
	head -c 3000 a.pm >cut.pm
	run -1 --separate-stderr bash -c './meshforce <cut.pm >rest'
	[[ $stderr == "meshforce: the input ends in the data"* ]]
	run -1 diag <rest
}

# use_library has -I and -L of the installed tree; the reader needs no -l.
@test "docs/library.md: the reader in one header compiles alone in C99 and C++, and the program gives the centre that diag gives" {
	install_here
	block c 3 "$top/docs/library.md" >centre.c
	block sh 3 "$top/docs/library.md" >reader.sh
	use_library
	run -0 bash -euo pipefail reader.sh
	[ "${#lines[@]}" = 3 ]
	gcc -std=c99 -pedantic -Wall -Wextra -Wshadow -Werror -o centre centre.c $(pkg-config --cflags pmpipe)
	! command -v g++ >/dev/null || g++ -std=c++17 -Wall -Wextra -Werror $(pkg-config --cflags pmpipe) -fsyntax-only -x c++ centre.c
	if ldd centre | grep -E 'pmpipe|jansson|libm\.'; then return 1; fi
	pinit plummer -n 500 | tee a.pm | ./centre >got
	read -r time x rest <got
	within "$x" "$(diag <a.pm | column centre_x)" 1e-15
	head -c 3000 a.pm >cut.pm
	run -1 --separate-stderr bash -c './centre <cut.pm'
	[[ $stderr == "centre: the input ends in the data: it was cut" ]]
	pinit plummer | push kick >aborted.pm 2>said || true
	run -1 --separate-stderr bash -c './centre <aborted.pm'
	[ "$stderr" = "centre: $(cat said)" ]
}

@test "docs/library.md lists every header that is installed" {
	for h in $(public); do
		grep -qE "^\| .*\`($h|$(basename "$h"))\`" "$top/docs/library.md" || { echo "$h"; return 1; }
	done
}

@test "headers that are installed include no other of ours, and compile alone in C and in C++" {
	list=$(public)
	for h in $list; do
		for i in $(sed -n 's/^#include "\(.*\)"/\1/p' "$top/lib/$h"); do
			grep -qx "$i" <<<"$list" || { echo "$h includes $i"; return 1; }
		done
		gcc -std=c11 -Wall -Wextra -Werror -I"$top/lib" -fsyntax-only -x c "$top/lib/$h"
		! command -v g++ >/dev/null || g++ -std=c++17 -Wall -Wextra -Werror -I"$top/lib" -fsyntax-only -x c++ "$top/lib/$h"
		grep -q '^PM_C_BEGIN$' "$top/lib/$h" && grep -q '^PM_C_END$' "$top/lib/$h" || { echo "$h: no PM_C_BEGIN, PM_C_END"; return 1; }
	done
}

@test "the shared library exports lib/exports.txt, which is what the installed headers declare" {
	for h in $(public); do echo "#include \"$h\""; done >all.c
	# ccache forgets the file of -aux-info
	CCACHE_DISABLE=1 gcc -std=c11 -I"$top/lib" -fsyntax-only -aux-info declared all.c
	{
		sed -n 's|^/\* .*/lib/[^ ]* \*/ extern .*[ *(]\(pm_[a-z0-9_]*\) (.*|\1|p' declared
		for h in $(public); do sed -n '/^extern [^(]*\[/p' "$top/lib/$h"; done | grep -oE '[a-z0-9_]+\[' | tr -d '['
	} | sort -u >wanted
	LC_ALL=C sort -c "$top/lib/exports.txt"
	diff "$top/lib/exports.txt" <(LC_ALL=C sort wanted)
	diff "$top/lib/exports.txt" <(nm -D --defined-only "$top/build/libpmpipe.so" | awk '{ print $3 }' | LC_ALL=C sort)
}

@test "the tool printed in docs/stage.md compiles against the installed library, and slows a cloud down" {
	install_here
	sed -n '/^```c$/,/^```$/p' "$top/docs/stage.md" | sed '1d;$d' >drag.c
	block c 2 "$top/docs/library.md" >main.c
	block sh 2 "$top/docs/library.md" >word.sh
	use_library
	bash -euo pipefail word.sh >rows
	[ "$(column step <rows)" = 1 ]
	gcc -std=c11 -Wall -Wextra -Werror -o drag drag.c main.c $(pkg-config --cflags --libs pmpipe)
	PATH=$PWD:$PATH
	sh_ok "pinit plummer -n 10 | drag --rate 0.5 | push kick --dt 0.1 | stab" # v -> 0.95 v
	drag --examples | head -n 1 | bash -o pipefail -s >rows
	[ "$(column step <rows)" = 2 ]
}

@test "threads that wait sleep, and leave the cores to the other stages of a pipe, unless OMP_WAIT_POLICY says otherwise" {
	! ldd "$(command -v p2m)" | grep -qE 'libgomp|libomp' || skip "the library of threads is not part of the program here"
	unset OMP_WAIT_POLICY
	export OMP_DISPLAY_ENV=true
	run -0 p2m --version
	[[ $output == *"OMP_WAIT_POLICY = 'PASSIVE'"* ]]
	OMP_WAIT_POLICY=active run -0 p2m --version
	[[ $output == *"OMP_WAIT_POLICY = 'ACTIVE'"* ]]
}

# The build proves it of those that a source file includes before anything else. The others without -march=native, with which intrinsics take ten times as
# long as all the rest, but those that ask for instructions.
@test "every header of ours compiles alone" {
	hdf5=$(pkg-config --cflags hdf5)
	cd "$top/lib"
	first=$(for c in */*.c ../tools/*.c; do grep -m 1 '^#include' "$c"; done | sed -n 's/^#include "\(.*\)"/\1/p' | sort -u)
	[ "$(wc -w <<<"$first")" -gt 50 ]
	alone=$(comm -13 - <(ls -- */*.h | sort) <<<"$first")
	[ "$(wc -w <<<"$alone")" -gt 50 ]
	for h in $alone; do
		native=
		! grep -qE '__(AVX|FMA|SSE)|immintrin' "$h" || native=-march=native
		gcc -std=c11 -D_GNU_SOURCE -Wall -Wextra -Werror $native -fopenmp -I. $hdf5 -fsyntax-only -x c "$h"
	done
}

# Else a line of the list is dead as soon as its code moves, and only `make mutants` says so.
@test "every error of tests/mutants.tsv has its old text exactly once in its file" {
	bad=$(cd "$top" && awk -F'\t' '!/^#/ && NF { file = ""; while ((getline line <$2) > 0) file = file line "\n"; close($2)
		for (n = 0; i = index(file, $3); n++) file = substr(file, i + length($3))
		if (n != 1) print $1 ": " n " times in " $2 }' tests/mutants.tsv)
	echo "$bad"
	[ -z "$bad" ]
}

# The order of the rooms is the list in docs/architecture.md, from the ground up; a file may include its own room and any below. The header that describes
# a table's entries (kernel/kernel.h) may be included from anywhere; the methods behind it never.
@test "arrows go one way: every room includes only rooms below it in docs/architecture.md" {
	rooms=$(sed -n 's/^| `lib\/\([a-z0-9-]*\)\/`.*/\1/p' "$top/docs/architecture.md")
	[ "$(sort <<<"$rooms")" = "$(cd "$top/lib" && find . -mindepth 1 -maxdepth 1 -type d ! -name shell ! -name command | sed 's|^\./||' | sort)" ]
	bad=$(cd "$top" && grep -HoE '^#include "[a-z0-9-]+/[^"]+"' lib/*/*.[ch] |
		grep -vE '"(collision|distribution|effect|green|kernel|law|maxwell|mollifier|relax|scene|step)/\1.h"' |
		sed -E 's|(lib/([a-z0-9-]+)/[^:]*):#include "([a-z0-9-]+)/.*|\2 \3 \1|' | sort -u | awk -v rooms="$rooms" '
		BEGIN { n = split(rooms, list, "\n"); for (i = 1; i <= n; i++) height[list[i]] = i }
		!($2 in height) || height[$2] > height[$1] { print $3 " includes " $2 }')
	echo "$bad"
	[ -z "$bad" ]
}

# A method or a word that loaded, converted or resized fields itself would leave a frame that differs from its declaration. No header includes
# it, so it cannot be included indirectly.
@test "only the layer that runs stages, and readers and writers of frames, include stream/run.h" {
	bad=$(cd "$top" && grep -l '"stream/run.h"' lib/*/*.[ch] tools/*.c | grep -vE '^lib/(stream|stage|sentence|modes|cycle|planner|h5)/[^/]*\.c$' || true)
	echo "$bad"
	[ -z "$bad" ]
}

# So the directory is the list of choices: what methods share stands in a room beside it. Formulas of up to 50 lines that need nothing but tables may stay.
@test "a table's room holds methods, its header and short formulas alone" {
	for t in $(sed -n 's/^| `lib\/\([a-z0-9-]*\)\/` | table: .*/\1/p' "$top/docs/architecture.md"); do
		for h in "$top/lib/$t"/*.h; do
			[ "${h##*/}" != "$t.h" ] || continue
			if [ "$(wc -l <"$h")" -gt 50 ] || grep '^#include "' "$h" | grep -qvE '"(effect|green|kernel|law|mollifier|relax|scene|step)/'; then
				echo "$h is an engine: it belongs beside lib/$t"
				return 1
			fi
		done
	done
}

@test "every source names its licence in its head" {
	bad=$(cd "$top" && find lib tools tests bench pipelines docs python .ci -type f | grep -E '\.(c|h|sh|bats|bash|py|js|css|html)$|/run$' | xargs awk '
		FNR == 1 { if (NR > 1 && !named) print file; file = FILENAME; named = 0 }
		FNR <= 25 && /SPDX-License-Identifier: GPL-3.0-or-later/ { named = 1 }
		END { if (!named) print file }')
	echo "$bad"
	[ -z "$bad" ]
}
# The tree again, of links, but for the rooms of lib/effect; then the same link as the Makefile's.
@test "a new effect is one file: plan prints its words in their slot with their reasons, and --check tests its decision" {
	mkdir -p tree/lib/effect
	ln -s "$top"/{Makefile,bench,data,tests,tools} tree
	for room in "$top"/lib/*; do [ "${room##*/}" = effect ] || ln -s "$room" tree/lib; done
	cp "$top"/lib/effect/* tree/lib/effect
	cat >tree/lib/effect/drag.c <<'END'
/* Drag: friction acc += -gamma v, gamma the constant drag of the frame; in the time T it changes v by gamma T. Source: Stokes 1851. */
#include <stdio.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "stream/frame.h"

static int measure(const struct pm_effect_case *c, const struct pm_effect_run *run, double own[PM_EFFECT_OWN])
{
	(void)run;
	own[0] = pm_frame_constant(c->frame, "drag", 0);
	return 0;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	pm_effect_by(d, c->scales, c->own[0] * c->scales->time, c->own[0] * c->scales->time);
	snprintf(d->text, sizeof d->text, "gamma T = %.2g", d->number);
}

static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	if (c->decision->answer != PM_PUT_IN)
		return;
	pm_words_add(w, PM_SLOT_FORCES, "field acc=-drag*vx,-drag*vy,-drag*vz", "drag: on, %s", c->decision->text);
	pm_words_amend(w, PM_SLOT_CLOSING, "push", "", ", with drag");
}

static bool reversible(const struct pm_effect_case *c) { return c->own[0] > 0; }

const struct pm_effect effect_drag = {
	.name = "drag",
	.sentence = "friction",
	.source = "Stokes 1851",
	.word = "field",
	.force = true,
	.measure = measure,
	.decide = decide,
	.words = words,
	.reversible = reversible,
};
END
	env -u MAKEFLAGS make -s -C tree B=build build/tables/effect.o build/lib/effect/drag.o
	mapfile -t words < <(cd "$top/build/tools" && ls -- *.o | grep -vx sh5.o)
	gcc -fopenmp -o new-plan tree/build/tables/effect.o tree/build/lib/effect/drag.o "$top/build/mains/plan.o" "${words[@]/#/$top/build/tools/}" \
		"$top/build/tables/tools.o" "$top/build/libpmpipe.a" -lfftw3 -lgsl -lgslcblas -lpng -ljansson -lm
	pinit two-body >free
	smod --constant drag=0.02 <free >dragged
	./new-plan --no-cost <dragged >text
	planned=$(./new-plan --sentence <dragged | sed 's/ --dt [^ ]*//; s/^dt [^|]*| //')
	[ "$planned" = 'push kick/2 drift | pp | field acc=-drag*vx,-drag*vy,-drag*vz | push kick/2' ]
	grep -qE '^field acc=.*# drag: on, gamma T = ' text
	grep -qE '^push kick/2 .*# the second half of the kick, with drag$' text
	grep -qE '^# drag  *on  *gamma T = ' text
	./new-plan --check <dragged >proof
	grep -qE '^drag +on .* right$' proof
	./new-plan --no-cost <free | grep -v '^# drag  *off' >text
	plan --no-cost <free | diff - text
	cycle -n 2 "$(./new-plan --sentence <dragged)" <dragged >/dev/null
}

@test "every effect has its row in docs/plan.md" {
	for f in "$top"/lib/effect/*.c; do
		grep -q "^| $(basename "$f" .c) " "$top/docs/plan.md" || { echo "$f"; return 1; }
	done
}

@test "every method has its page" {
	missing=$(cd "$top" && for f in lib/{collision,green,kernel,law,maxwell,mollifier,relax,scene,step}/*.c; do
		n=$(basename "$f" .c)
		grep -qrw -- "$n" docs/methods || echo "$f"
	done)
	echo "$missing"
	[ -z "$missing" ]
}
