# pareto: the alternatives of a sentence, their errors and seconds, the front, continuing from earlier results.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

list() { pareto "$@" --against pp --list; }
# sweep ARGUMENTS...: three meshes of a small box against the finest.
sentence='pinit uniform -n 500 | p2m --kernel tsc -n {8,16,32} | poisson-fft | mgrad | m2p'
sweep() { pareto "$sentence" --against finest --field acc "$@"; }
# told PATTERN ARGUMENTS...: one clear line and exit 2.
told() {
	run -2 --separate-stderr pareto "${@:2}"
	[[ -z $output && $stderr == "pareto: "*$1* && $(wc -l <<<"$stderr") = 1 ]] || { echo "${*:2}: $stderr"; return 1; }
}

@test "braces: every combination, the last choice fastest" {
	[ "$(list 'a --k {x,y} -n {1,2} | b')" = $'a --k x -n 1 | b\na --k x -n 2 | b\na --k y -n 1 | b\na --k y -n 2 | b' ]
}

@test "braces: nest, may be empty, may hold |, and the commas inside an inner pair are the inner pair's" {
	[ "$(list 'a | {p2m | poisson-fft | mgrad --order {2,4} | m2p, tree, pp}')" = \
		$'a | p2m | poisson-fft | mgrad --order 2 | m2p\na | p2m | poisson-fft | mgrad --order 4 | m2p\na | tree\na | pp' ]
	[ "$(list 'a{1{x,y},,2}')" = $'a1x\na1y\na\na2' ]
	[ "$(list 'a {x, y} --k={1, -2} b{, --o,-p, -q {3, 4}}' |
		sed -n '1,4p;15,16p')" = $'a x --k=1 b\na x --k=1 b --o\na x --k=1 b-p\na x --k=1 b -q 3\na y --k=1 b -q 4\na y --k=-2 b' ]
	[ "$(list "cycle -n {5,10} 'push {kick,drift}/2 | pp'")" = "cycle -n 5 'push kick/2 | pp'
cycle -n 5 'push drift/2 | pp'
cycle -n 10 'push kick/2 | pp'
cycle -n 10 'push drift/2 | pp'" ]
}

@test "braces: \\{ \\} \\, are the literal characters" {
	[ "$(list "awk '\\{ print \$1, \$2 \\}' {x\\,y,z}")" = "awk '{ print \$1, \$2 }' x,y
awk '{ print \$1, \$2 }' z" ]
}

@test "finest is the last of all alternatives, where a name makes it the same sentence twice, too" {
	pareto 'pinit plummer -n 50 | {p2m --kernel {k} -n 8 | poisson-fft | mgrad | m2p,pp}' --vary k=cic,tsc --against finest --field acc --repeat 1 --tsv \
		>table
	[ "$(awk -F'\t' '$2 == "reference" { print $(NF - 1) }' table)" = "pinit plummer -n 50 | pp" ]
}

@test "--vary: one choice in several places, whose values may have braces of their own; equal sentences count once" {
	[ "$(list 'p2m --kernel {k} | m2p --kernel {k} -n {1,2}' --vary k=cic,tsc)" = \
		"$(for k in cic tsc; do for n in 1 2; do echo "p2m --kernel $k | m2p --kernel $k -n $n"; done; done)" ]
	[ "$(list 'a -n {1,2} | b {k}{k}' --vary k=x,y)" = $'a -n 1 | b xx\na -n 1 | b yy\na -n 2 | b xx\na -n 2 | b yy' ]
	[ "$(list 'a | {p2m --kernel {k} | m2p --kernel {k}, pp}' --vary 'k=m{4,6}prime,cic' | grep -c .)" = 4 ] # pp once
}

@test "an invalid sentence: one clear line, exit 2" {
	told 'not closed' 'a {b,c' --against pp
	told 'neither alternatives' 'a {b}' --against pp
	told 'without its {' 'a {b,c} d}' --against pp
	told 'nothing to choose' 'a | b' --against pp
	told 'nowhere in the sentence' 'a {b,c}' --against pp --vary k=1,2
	told 'name=value' 'a {b,c}' --against pp --vary 1,2
	told 'a quote is not closed' "a {b,c} 'd" --against pp
	told 'an empty word' 'a {b,c} | | d' --against pp
	told "without ';'" 'a {b,c}; d' --against pp
	told 'against is missing' 'a {b,c}'
	told 'alternatives of its own' 'a {b,c}' --against 'p{p,q}'
	told 'wants --field' 'a {b,c}' --against exact
	told 'is not a time' 'a {b,c}' --against pp --within soon
	told 'not a number' 'a {b,c}' --against pp --until-error small
	told 'did you mean relative_l2' 'a {b,c}' --against pp --norm relative_l
	told 'SENTENCE is missing' --against pp
	told 'one SENTENCE' a b --against pp
}

@test "a sweep: finer meshes have smaller errors and larger costs, and the TSV has the norms of scmp" {
	sweep --repeat 1 --tsv >table
	e8=$(awk -F'\t' '$1 == 1 { print $5 }' table) e16=$(awk -F'\t' '$1 == 2 { print $5 }' table)
	awk -v a="$e8" -v b="$e16" 'BEGIN { exit !(b > 0 && a > 1.1 * b) }'
	[ "$(awk -F'\t' '$1 == 3 { print $2 }' table)" = reference ]
	# The same by hand.
	pinit uniform -n 500 | p2m --kernel tsc -n 8 | poisson-fft | mgrad | m2p >a
	pinit uniform -n 500 | p2m --kernel tsc -n 32 | poisson-fft | mgrad | m2p >b
	scmp --field acc a b >norms
	[ "$(column relative_l2 <norms)" = "$e8" ]
	[ "$(column l1 <norms)" = "$(awk -F'\t' '$1 == 1 { print $6 }' table)" ]
	awk -F'\t' 'NR > 1 && !($11 > 0 && $13 > 0 && ($14 == "-" || $14 > 0)) { exit 1 }' table
}

@test "exact: a leapfrog's error falls by four when the step is halved; a column without an exact value is reported" {
	run -0 pareto "pinit two-body --eccentricity 0.5 --dt {0.1,0.05,0.025} | cycle -t 1 'push kick/2 drift | pp | push kick/2'" --against exact --field \
		energy_kinetic --repeat 1 --tsv -q
	mapfile -t e < <(column error <<<"$output" | sort -rg)
	order 2 0.1 "${e[0]}" 0.05 "${e[1]}" 0.025 "${e[2]}"
	run -1 pareto "pinit two-body --dt {0.1,0.05} | cycle -n 1 'push drift'" --against exact --field distance_max --repeat 1
	[[ $output == *"nothing to compare"* ]]
}

@test "the error is the largest over several frames" {
	run -0 pareto "pinit two-body | cycle -n 3 --every 1 'push drift --dt {0.1,0.2}'" --against "cycle -n 3 --every 1 'push drift --dt 0.15'" --field x \
		--norm max --repeat 1 --tsv -q
	# |v| = 1/2, three steps, 0.05 off in each.
	while read -r e; do within "$e" 0.075 1e-9; done < <(column error <<<"$output")
}

@test "a reference of its own for every value of a name" {
	pareto 'pinit plummer -n {n} | {pp,pp --softening 1}' --vary n=20,30 --against 'pinit plummer -n {n} | pp' --field acc --repeat 1 --tsv >table
	[ "$(awk -F'\t' 'NR > 1 { print $21, $22, ($5 == "0" ? "same" : $5 > 0.01 ? "other" : "near") }' table | sort)" = "20 pp --softening 1 other
20 pp same
30 pp --softening 1 other
30 pp same" ]
}

@test "a combination that fails is reported with its reason, and the others go on" {
	run -0 pareto 'pinit plummer -n 100 | p2m -n 8 | poisson-fft | mgrad --order {2,spectral} | m2p' --against pp --field acc --repeat 1
	[[ $output == *"failed: 2: mgrad: frame 1: --order spectral needs periodic"* ]]
	[[ $output =~ \*[[:space:]]+1[[:space:]] ]]
	run -1 pareto 'pinit plummer -n 100 | p2m -n {8,8x8} --kernel nosuch' --against pp --repeat 1
	[[ $output == *"every sentence failed"* ]]
}

# The seconds and errors of a log written by hand: 1 is dominated by 2, 2 and 4 are on the front, 3 by 4.
by_hand() {
	pareto "pinit uniform -n 20 | m2p -{a,b} {1,2}" --against 'p2m -n 4' --field x --repeat 3 -o d >/dev/null 2>&1 || true
	{
		for n in 0 1 2 3; do
			for r in 1 2 3; do printf 'time\t%d\t%d\t0.5\t%s\t2048\n' $n $r "$(awk -v n=$n -v r=$r 'BEGIN { s[0] = 2; s[1] = 1; s[2] = 5;
				s[3] = 4; print s[n] + (r - 2) * 0.1 }')"; done
		done
		printf 'error\t0\t20\t1\t1\t1\t0.02\t1\nerror\t1\t20\t1\t1\t1\t0.01\t1\nerror\t2\t20\t1\t1\t1\t2e-5\t1\nerror\t3\t20\t1\t1\t1\t1e-5\t1\n'
	} >d/measured/log
	pareto "pinit uniform -n 20 | m2p -{a,b} {1,2}" --against 'p2m -n 4' --field x --repeat 3 -o d "$@"
}

@test "the front, who beats whom, medians and spreads, and the choices that never are on the front" {
	by_hand --tsv >table
	[ "$(awk -F'\t' 'NR > 1 { print $1, $3, $4, $11, $12, $13, $14 }' table)" = "2 yes - 1 0.1 0.5 2.0
1 no 2 2 0.1 0.5 2.0
4 yes - 4 0.1 0.5 2.0
3 no 4 5 0.1 0.5 2.0" ]
	by_hand >text
	grep -q 'never on the front: choice2 1' text
}

@test "--format json: the table with numbers as numbers and null for what there is not, also as pareto.json and from a finished directory" {
	by_hand --format json >j
	[ "$(jq -c '.members[0] | [.member, .error, .seconds, .dominated_by, .choice, .choice2, .ties]' <j)" = '[2,0.01,1,null,"a",2,null]' ]
	[ "$(jq -r '.sentence, .against, .norm, .field' <j)" = $'pinit uniform -n 20 | m2p -{a,b} {1,2}\np2m -n 4\nrelative_l2\nx' ]
	by_hand --tsv >t
	[ "$(jq '.members | length' <j)" = "$(($(wc -l <t) - 1))" ]
	[ "$(jq -r '.members[].sentence' <j)" = "$(awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "sentence") c = i; next } { print $c }' t)" ]
	same_as j d/pareto.json
	pareto -o d --format json >again
	same_as j again
	told 'leave one of them out' 'a {b,c}' --against pp --tsv --format json
}

@test "--until-error prints the cheapest sentence within it, --within the most accurate; none is exit 1" {
	[ "$(by_hand --until-error 1e-2)" = "pinit uniform -n 20 | m2p -a 2" ]
	[ "$(by_hand --until-error 1e-4)" = "pinit uniform -n 20 | m2p -b 2" ]
	[ "$(by_hand --within 4500ms)" = "pinit uniform -n 20 | m2p -b 2" ]
	[ "$(by_hand --within 2.5s)" = "pinit uniform -n 20 | m2p -a 2" ]
	run -1 by_hand --until-error 1e-9
	[[ $output == *"the smallest error is 1e-05"* ]]
	run -1 by_hand --until-error 1e-4 --within 2s
}

@test "--jobs: the same errors side by side, without seconds; a failing sentence is reported" {
	sweep --repeat 1 --tsv >alone
	sweep --jobs 2 --tsv >together
	[ "$(cut -f1,5-10 alone | sort)" = "$(cut -f1,5-10 together | sort)" ]
	[ "$(column seconds <together | sort -u)" = - ]
	run -0 pareto 'pinit plummer -n 100 | p2m -n 8 | poisson-fft | mgrad --order {2,spectral} | m2p' --against pp --field acc --jobs 2
	[[ $output == *"failed: 2: mgrad: frame 1: --order spectral needs periodic"* ]]
}

@test "the common beginning of several sentences is measured once per round and charged to each" {
	pareto 'pinit uniform -n 50 | p2m -n 8 --kernel tsc{,} | poisson-fft | mgrad --order {2,4} | m2p' --against finest --field acc --repeat 2 -o d \
		>/dev/null
	# p2m and poisson-fft once, mgrad and m2p twice, in each of two rounds: empty alternatives are the same sentence.
	[ "$(grep -c ^time d/measured/log)" = 12 ]
	awk -F'\t' '$1 == "time" { s[$2] += $5 / 2 } END { printf "%.6g %.6g\n", s[0] + s[1] + s[2] + s[3],
		s[0] + s[1] + s[4] + s[5] }' d/measured/log >want
	pareto 'pinit uniform -n 50 | p2m -n 8 --kernel tsc{,} | poisson-fft | mgrad --order {2,4} | m2p' --against finest --field acc --repeat 1 -o d --tsv \
		>table
	# both are sums of the same numbers, printed with six digits: the last may differ by one
	paste <(sort -n table | column seconds) <(tr ' ' '\n' <want) |
		awk '{ d = $1 - $2; if ((d < 0 ? -d : d) > 1.01e-5 * $2) bad = 1 } END { exit bad || NR != 2 }'
}

@test "with -o: TSV, both pictures, and one self-contained page" {
	sweep --repeat 1 -o d | tail -n 1 >last
	[ "$(cat last)" = "page: d/index.html" ]
	[ "$(head -c 4 d/pareto.png | tail -c 3)" = PNG ]
	grep -q '</svg>' d/pareto.svg
	[ "$(wc -l <d/pareto.tsv)" = 4 ]
	run -1 grep -oiE "(src|href)=['\"]?[^#'\"]|<link|<script[^>]@import|url\((https?|file)" d/index.html
	for what in '<svg' 'pinit uniform -n 500 | p2m --kernel tsc -n {8,16,32}' 'processors' 'pmpipe ' 'poisson-fft --timing' 'scmp --field acc' \
		'p2m --kernel tsc -n 16 --timing'; do
		grep -qF -- "$what" d/index.html || { echo "page lacks $what"; return 1; }
	done
}

# pasted DIRECTORY: the relative_l2 of all members, by the commands of its page, in an empty directory.
pasted() {
	sed -n '/Every command as run/,/<\/pre>/p' "$1/index.html" |
		sed -e '1d; s/<button.*<\/button>//; s/<[^>]*>//g; s/&lt;/</g; s/&gt;/>/g; s/&quot;/"/g; s/&amp;/\&/g' >commands
	mkdir "$1.again"
	(cd "$1.again" && bash ../commands 2>/dev/null) | awk -F'\t' '$3 == "acc" { print $8 }' | sort -g
}
errors() { column error <"$1/pareto.tsv" | grep -v '^-' | sort -g; }

@test "every command of the page runs as pasted, and gives the errors of the table: from words, from whole sentences, from a file" {
	sweep --repeat 1 -o words >/dev/null
	pasted words >got
	[ "$(wc -l <got)" = 3 ]
	errors words | diff - got
	pareto "$sentence" --against 'p2m -n 32 | poisson-fft | mgrad --order 4 | m2p' --field acc --jobs 2 -o whole >/dev/null
	errors whole | diff - <(pasted whole)
	[[ $(head -n 1 commands) == "# run in $PWD" ]]
	pinit uniform -n 500 | p2m -n 64 | poisson-fft | mgrad | m2p >"the file"
	pareto "$sentence" --against 'the file' --field acc --threads 1 --repeat 1 -o file >/dev/null
	errors file | diff - <(pasted file)
	grep -q '^export OMP_NUM_THREADS=1$' commands
}

@test "the picture: a line per method with error bars, the front with names that do not overlap; an error of 0 has its place" {
	echo 'member status front dominated_by error l1 l2 max relative_l2 relative_max seconds spread setup memory_mb kernel n sentence reason' |
		tr ' ' '\t' >t
	i=0
	for kernel in cic tsc; do for n in 8 16 32; do
		i=$((i + 1))
		printf '%d\tok\t%s\t-\t%s\t-\t-\t-\t-\t-\t%s\t0.02\t0\t1\t%s\t%s\ts\t-\n' $i "$([ $kernel = cic ] && echo yes || echo no)" \
			"$([ $n = 32 ] && echo 0 || echo 0.$((40 / n)))" "0.$((n / 8))1" $kernel $n
	done; done >>t
	mkdir d work
	cp t d/pareto.tsv
	(me=pareto work=work jobs='' size_choice='' clock=wall norm=relative_l2 field=acc choice_name=(kernel n)
		tell() { echo "$me: $*" >&2; }
		for f in run page front-picture; do . "$top/lib/shell/$f.sh"; done
		plot d) 2>said
	[ ! -s said ]
	for what in 'Pareto front' cic tsc '1 cic 8' '2 cic 16' '3 cic 32' 0 'relative_l2 of acc'; do
		[ "$(grep -c ">$what</text>" d/pareto.svg)" = 1 ] || { echo "$what"; return 1; }
	done
	[ "$(head -c 4 d/pareto.png | tail -c 3)" = PNG ]
	[ "$(grep -c 'stroke-width="1.1"' d/pareto.svg)" -ge 18 ] # six bars of three pieces
}

@test "the page works in a browser without a network: a click sorts the table by numbers, nothing is on the console, text is escaped" {
	command -v chromium >/dev/null || skip "no chromium here"
	pareto 'pinit uniform -n 50 | p2m --kernel {k} -n {8,16} | poisson-fft | mgrad | m2p' --vary 'k=<b>&,tsc,cic' --against finest --field acc \
		--repeat 1 -o d >/dev/null
	# What a reader would do, at the end of the page; the state is then printed.
	sed 's|</body>|<script>const heads = [...document.querySelectorAll("th")], click = n => heads.find(h => h.textContent === n).click();\
		const column = () => [...document.querySelectorAll("tbody tr")].map(r => r.cells[4].textContent).join(" ");\
		const out = document.createElement("div"); click("error"); out.append("UP " + column()); click("error"); out.append(" DOWN " + column());\
		document.querySelector("button.copy").click(); document.body.append(out);</script></body>|' d/index.html >page.html
	chromium --headless --no-sandbox --disable-gpu --host-resolver-rules='MAP * ~NOTFOUND' --enable-logging=stderr --dump-dom \
		"file://$PWD/page.html" >dom 2>log
	if grep CONSOLE log; then return 1; fi
	up=$(sed -n 's/.*<div>UP \(.*\) DOWN .*/\1/p' dom)
	down=$(sed -n 's/.*<div>UP .* DOWN \([^<]*\)<.*/\1/p' dom)
	[ "$(tr ' ' '\n' <<<"$up" | grep -c '[0-9]')" = 4 ] # and two that failed
	[ "$(tr ' ' '\n' <<<"$up" | grep -v '^-$' | sort -g | xargs)" = "$(tr ' ' '\n' <<<"$up" | grep -v '^-$' | xargs)" ]
	[ "$(tr ' ' '\n' <<<"$down" | grep -v '^-$' | sort -gr | xargs)" = "$(tr ' ' '\n' <<<"$down" | grep -v '^-$' | xargs)" ]
	grep -q '&lt;b&gt;&amp;' d/index.html
	! grep -q '<b>&' d/index.html
}

@test "a finished directory answers --until-error, --within and --tsv without the sentence; a directory whose sentences all failed takes the corrected one" {
	run -2 --separate-stderr pareto -o d --until-error 0.1
	[[ $stderr == *"SENTENCE is missing"*", and 'd' holds no finished sweep"* ]]
	pinit uniform -n 50 | p2m | poisson-fft | mgrad | m2p >one.pm
	run -1 pareto 'pinit uniform -n 50 | p2m -n {8,16} | poisson-fft | mgrad --source nothing | m2p' --against one.pm --field acc --repeat 1 -o d
	[[ $output == *"every sentence failed"* ]]
	sweep --repeat 1 -o d >/dev/null
	sweep --repeat 1 -o d --until-error 0.9 >want
	run -0 pareto -o d --until-error 0.9
	[[ -s want && $output == "$(cat want)" ]]
	run -0 pareto -o d --within 1h
	[[ $output == *" -n "* ]]
	pareto -o d/ --tsv | cmp - d/pareto.tsv
	run -2 pareto "$sentence | cat" --against finest --field acc --repeat 1 -o d
	[[ $output == *"holds another sweep"* ]]
	run -2 pareto -o d
	[[ $output == *"SENTENCE is missing"* ]]
}

@test "--jobs -o: a picture of the errors alone, and the same command measures nothing twice" {
	sweep --jobs 2 -o d >/dev/null
	cp d/measured/log before
	sweep --jobs 2 -o d >/dev/null
	cmp before d/measured/log
	[ "$(head -c 4 d/pareto.png | tail -c 3)" = PNG ]
	[ "$(grep -c '>[12] [0-9]*</text>' d/index.html)" = 2 ] # the two that are no reference, by their mesh
	! grep -q 'median seconds' d/index.html
}

@test "stopped by SIGINT it reports its progress, and the same command continues and measures nothing twice" {
	mkdir bin
	# The first time it comes to the mesh of 16 cells, it stops pareto and waits.
	cat >bin/mesh <<-'SH'
		#!/bin/sh
		[ "$1" != 16 ] || [ -e stopped ] || { touch stopped; kill -INT "$(cat pid)"; sleep 20; }
		exec p2m -n "$1"
	SH
	chmod +x bin/mesh
	PATH=$PWD/bin:$PATH
	s='pinit uniform -n 50 | mesh {8,16,4} | poisson-fft | mgrad | m2p'
	# Under GNU parallel signals may come in ignored.
	run -130 timeout 15 env --default-signal=INT bash -c \
		'echo $$ >pid; exec pareto "$1" --against "p2m -n 32 | poisson-fft | mgrad | m2p" --field acc --repeat 1 -o d' - "$s"
	[[ ${lines[-1]} == "pareto: stopped; 0"* || ${lines[-1]} == "pareto: stopped; "[12]" of 3"* ]] # in the order of the round
	[[ ${lines[-1]} == *"the same command goes on from here" ]]
	cp d/measured/log before
	[ "$(grep -c ^error before)" -lt 3 ]
	pareto "$s" --against 'p2m -n 32 | poisson-fft | mgrad | m2p' --field acc --repeat 1 -o d >/dev/null
	cmp -n "$(wc -c <before)" before d/measured/log
	[ "$(grep -c ^error d/measured/log)" = 3 ]
	[ "$(grep -c ^time d/measured/log)" = 12 ]
	run -2 pareto "$s" --against 'p2m -n 16' --field acc -o d
	[[ $output == *"holds another sweep"* ]]
}

# Words whose seconds and errors are known: fake -c COST -e ERROR multiplies the masses by 1 + ERROR and records the seconds COST, an expression of awk in r,
# how often a word of this COST has run (from 1); the processor's seconds are a tenth of them.
fakes() {
	mkdir bin
	ln -s "$top"/bin/* bin/
	rm bin/pareto
	cp "$top/bin/pareto" bin/
	cat >bin/fake <<-'SH'
		#!/bin/bash
		echo >>"ran.${2//[^a-z0-9.]/_}"
		awk -v r="$(wc -l <"ran.${2//[^a-z0-9.]/_}")" 'BEGIN { t = '"$2"'; printf "fake\t0\t%.9f\t%.9f\n", t, t / 10 }' >>"$6"
		exec scalc "mass = mass*(1 + $4)"
	SH
	chmod +x bin/fake
	PATH=$PWD/bin:$PATH
}
fronts() { awk -F'\t' '$3 == "yes" { print $5 }' "$1" | sort -g | xargs; }

@test "times that differ by no more than noise are a tie, both on the front; clear differences are not, in any order of the braces" {
	fakes
	# b is faster than a by less than the spread of both, c clearly slower and less accurate, d clearly faster.
	a='fake -c "1+0.1*(r%3)" -e 1e-3' b='fake -c "0.95+0.1*(r%3)" -e 1e-4' c='fake -c "2+0.1*(r%3)" -e 2e-4' d='fake -c "0.1+0.01*(r%3)" -e 1e-2'
	for braces in "$a,$b,$c,$d" "$d,$c,$b,$a" "$b,$d,$a,$c"; do
		pareto "pinit uniform -n 20 | {$braces}" --against 'scalc mass=mass' --field mass --repeat 3 --tsv >table
		[ "$(fronts table)" = "0.0001 0.001 0.01" ]
		[ "$(awk -F'\t' 'NR > 1 && $15 != "-" { print $5 }' table)" = 0.001 ] # may be beaten within noise
		rm ran.*
	done
	pareto "pinit uniform -n 20 | {$a,$b,$c,$d}" --against 'scalc mass=mass' --field mass --repeat 3 >text
	[ "$(grep -c '^~' text)" = 1 ]
	[ "$(grep -c '^[*]' text)" = 2 ]
}

@test "a loaded machine is said, with all its processors, however many threads are asked for" {
	mkdir bin
	printf '#!/bin/sh\nsleep 0.4\necho "cpu 100000 0 0 0 0 0 0 0 0" >stat\nexec cat\n' >bin/others
	chmod +x bin/others
	echo "cpu 0 0 0 0 0 0 0 0 0" >stat
	PATH=$PWD/bin:$PATH PROC_STAT=$PWD/stat run -0 pareto 'pinit uniform -n 9 | {others,cat} | p2m -n 4' --against finest --field rho --repeat 1 --threads 1
	[[ $output == *"the machine was loaded: others kept "[0-9]*" of $(env -u OMP_NUM_THREADS nproc) processors busy"* ]]
	run -0 pareto 'pinit uniform -n 9 | {cat,tee /dev/null} | p2m -n 4' --against finest --field rho --repeat 1 --threads 1 -o d
	grep -qF " $(env -u OMP_NUM_THREADS nproc) processors," d/index.html
}

@test "the rounds go on until the times of the front are known to --spread, and no longer for what is beaten" {
	fakes
	# The first two of 'a' are twice as long; the interval of 10 % is reached when they are outside the ranks: with 11 rounds.
	pareto "pinit uniform -n 20 | {fake -c '1+(r<3)' -e 1e-3,fake -c 4 -e 1e-2,fake -c 0.5 -e 1e-1}" --against 'scalc mass=mass' --field mass --spread 0.1 \
		--tsv >table
	[ "$(awk -F'\t' 'NR > 1 { print $5, $16, $11, $12 }' table | sort)" = "0.001 11 1 0
0.01 5 4 0
0.1 5 0.5 0" ]
	rm ran.*
	run -0 --separate-stderr pareto "pinit uniform -n 20 | {fake -c '1+(r%2)' -e 1e-3,fake -c 0.5 -e 1e-1}" --against 'scalc mass=mass' --field mass \
		--budget 0s --tsv
	[[ $stderr == *"after 3 rounds and 0 s the time of 1 sentences that may be on the front is not known to 5 %"* ]]
}

@test "--time processor makes the front of processor time, --axes of memory too" {
	fakes
	pareto "pinit uniform -n 20 | {fake -c 1 -e 1e-3,fake -c 0.5 -e 1e-2}" --against 'scalc mass=mass' --field mass --repeat 1 --tsv --time processor >table
	[ "$(column processor <table | xargs)" = "0.05 0.1" ]
	pareto "pinit uniform -n 20 | {fake -c 1 -e 1e-3,fake -c 0.5 -e 1e-2}" --against 'scalc mass=mass' --field mass --repeat 1 --time processor \
		--within 0.06s | grep -q -- '-e 1e-2'
	# By hand, with processor times that go the other way: 1 is beaten by 2 and 3 by 4 no more, but 2 is by 4.
	by_hand --tsv >/dev/null
	awk -F'\t' -v OFS='\t' '$1 == "time" { $7 = ($2 == 0 ? 1 : $2 == 1 ? 4 : $2 == 2 ? 2 : 3) + 0.01 * $3 } { print }' d/measured/log >log
	cp log d/measured/log
	pareto "pinit uniform -n 20 | m2p -{a,b} {1,2}" --against 'p2m -n 4' --field x --repeat 3 -o d --time processor --tsv >table
	[ "$(fronts table)" = "1e-5 2e-5 0.02" ]
	[ "$(column processor_spread <table | sort -u)" = 0.01 ] # of rounds that are 0.01 apart; 0.1 in wall time
	[[ "$(pareto -o d --time processor --until-error 3e-5 2>&1)" == "pinit uniform -n 20 | m2p -b 1" ]] # 2 s, not 3
	# 2 and 3 s, each +- 0.6: a tie, which wall times (5 and 4, +- 0.1) are not
	awk -F'\t' -v OFS='\t' '$1 == "time" { $7 += 0.6 * ($3 - 2) } { print }' log >d/measured/log
	pareto "pinit uniform -n 20 | m2p -{a,b} {1,2}" --against 'p2m -n 4' --field x --repeat 3 -o d --time processor --tsv >table
	[[ "$(pareto -o d --time processor --until-error 3e-5 2>&1)" == *"pareto: within noise members 4 cost as much"* ]]
	[[ "$(pareto -o d --until-error 3e-5 2>&1)" == "pinit uniform -n 20 | m2p -b 2" ]]
	# By hand: 1 is beaten by 2 and 3 by 4, but 3 is smaller.
	type -P time >/dev/null || skip "no program time here" # bash has a word of this name
	by_hand --tsv >/dev/null
	sed -i 's/^\(time\t2\t.*\t\)2048$/\1512/' d/measured/log
	pareto "pinit uniform -n 20 | m2p -{a,b} {1,2}" --against 'p2m -n 4' --field x --repeat 3 -o d --axes error,time,memory --tsv >table
	[ "$(fronts table)" = "1e-5 2e-5 0.01" ]
}

# Three sizes x = ln 10, 2 ln 10, 3 ln 10 with residuals d, -2 d, d: b is exact, s^2 = 6 d^2, its standard error is s/sqrt(2 ln(10)^2) = 0.0075 for d = 0.01;
# at the crossing in the middle the line is known to s/sqrt(3) = 0.0141, which over a difference of slopes of 1 is the error of ln N.
@test "--size: a front and a reference for each size, power laws and the crossover with their errors, an extrapolated size that is labelled and not run" {
	fakes
	steep="fake -c '{N}^1.5*exp(0.01*({N} == 100 ? -2 : 1))' -e 1e-3" flat="fake -c '100*{N}^0.5' -e 0.1/{N}"
	sizes() { pareto "pinit uniform -n {N} | scalc mass=mass | {$steep,$flat}" --vary N=10,100,1000 --against 'scalc mass=mass' --field mass \
		--repeat 1 "$@"; }
	sizes --size N --extrapolate 1e4 -o d >text
	grep -q "N^1.50 +- 0.0075, error ~ N^0.00" text
	grep -qE "N\^0.50 \+- [0-9.e-]+, error ~ N\^-1.00" text
	grep -q "crossover at N = 100 (98.6 to 101): fake -c '{N}^1.5" text
	grep -qE '^[*] .*1e4 \(extrapolated\)' text
	# At 10 the first is cheaper and more accurate, at 1000 the second; at 100 they cross, and the errors are equal.
	[ "$(awk -F'\t' '$2 == "ok" && $3 == "yes" { printf "%s %.3g\n", $21, $5 }' d/pareto.tsv | sort | head -n 1)" = "10 0.001" ]
	[ "$(awk -F'\t' '$2 == "extrapolated" { printf "%.3g %.3g %s\n", $5, $11, $16 }' d/pareto.tsv | sort)" = "0.001 1e+06 0
1e-05 1e+04 0" ]
	grep -q 'Pareto front N 1e4 (extrapolated)' d/pareto.svg
	grep -q 'extrapolated' d/index.html
	[ "$(grep -c ^time d/measured/log)" = 6 ] # the two words before the alternatives are not charged
	# What is not run is no answer.
	[[ $(pareto -o d --until-error 2e-5 2>&1) == *"smallest error is 0.0001"* ]]
	run -2 pareto 'a -n {N} {b,c}' --vary N=1,x --size N --against pp
	[[ $output == *"'x' is not a number above 0"* ]]
	run -2 pareto 'a -n {N} {b,c}' --vary N=1,2 --size M --against pp
	[[ $output == *"--size M is no name of --vary"* ]]
	run -2 pareto 'a -n {N} {b,c}' --vary N=1,2 --extrapolate 4 --against pp
	[[ $output == *"--extrapolate wants --size"* ]]
}

@test "--size: finest is the finest of each size" {
	pareto 'pinit uniform -n {N} | p2m -n {4,8,16} | poisson-fft | mgrad | m2p' --vary N=30,40 --size N --against finest --field acc --repeat 1 --tsv >table
	[ "$(awk -F'\t' '$2 == "reference" { print $21, $22 }' table | sort)" = "30 16
40 16" ]
	[ "$(grep -c '\bok\b' table)" = 4 ]
}

# Errors 1/n^2 and dt, costs n^3 and 1/dt: n = 100 and dt = 1e-4 meet 1e-4, for 10 s each; the model is exact, so each step but the last is what was predicted.
@test "--refine: numbers are continued along their measured convergence until the error is met, the cheapest method wins, and a floor is said" {
	fakes
	two() { pareto "pinit uniform -n 20 | {fake -c '1e-5*{n}^3' -e '(1/{n}^2)',fake -c '2e-3/{dt}' -e '{dt}'}" --vary n=8,16,32 --vary dt=0.1,0.05 \
		--against 'scalc mass=mass' --field mass --repeat 1 --until-error 1e-4 -o d "$@"; }
	run -1 --separate-stderr two
	[[ $stderr == *"the smallest error is 0.000977"*"(--refine searches finer numbers)" ]]
	run -0 --separate-stderr two --refine
	[[ $output == "pinit uniform -n 20 | fake -c '1e-5*108^3' -e '(1/108^2)'" ]]
	[[ $stderr == *"n 32 -> 108 (order 2.00): error 8.573388203e-05, 12.5971 s, predicted 8.57e-05, 12.6 s"*"met after"*"error 8.573388203e-05, 12.5971"* ]]
	awk -F'\t' 'NR > 1 && ($7 / $8 - 1) ^ 2 > 1e-4 { print; exit 1 }' d/refine.tsv
	n=$(grep -c '^error' d/measured/log)
	two --refine >again 2>/dev/null
	[ "$(cat again)" = "$output" ]
	[ "$(grep -c '^error' d/measured/log)" = "$n" ]
	# Two numbers of one method, raised one at a time, whichever lowers the error most for its time.
	both() { pareto "pinit uniform -n 20 | fake -c '1e-7*{n}^3/{dt}' -e '($1 + 1/{n}^2 + {dt})'" --vary n=8,16,32 --vary dt=0.1,0.05 \
		--against 'scalc mass=mass' --field mass --repeat 1 --until-error 1e-3 --refine "${@:2}"; }
	run -0 --separate-stderr both 0 --budget 1h
	[[ $stderr == *"dt 0.05 -> "*"n 32 -> "* ]]
	run -1 --separate-stderr both 0.02
	[[ $stderr == *"floor: member "*" stays at error 0.02"*"finer"* ]]
	run -1 --separate-stderr both 0 --budget 2s
	[[ $stderr == *"more than what is left of the budget"* ]]
}

@test "--refine: a leapfrog of second order finds the step for an error, and what does not go together is refused" {
	s="pinit two-body --eccentricity 0.5 --dt {0.1,0.05} | cycle -t 1 'push kick/2 drift | pp | push kick/2'"
	run -0 --separate-stderr pareto "$s" --against exact --field energy_kinetic --repeat 1 --until-error 2e-5 --refine --tsv
	[[ $output == "pinit two-body --eccentricity 0.5 --dt 0.02"* && $stderr == *"(order 2.00)"*"met after"* ]]
	told 'finest does not' "$s" --against finest --until-error 1 --refine
	told 'wants --until-error' "$s" --against pp --refine
	told 'finds no numbers' 'a {b,c}' --against pp --until-error 1 --refine
	told 'neither with --size' "$s" --against pp --until-error 1 --refine --jobs 2
}
