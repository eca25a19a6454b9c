# splot: tables as curves. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# told STATUS PATTERN ARGUMENTS...: one clear line and this exit status; nothing is drawn.
told() {
	run -"$1" --separate-stderr splot "${@:3}" </dev/null
	[[ -z $output && ${#stderr_lines[@]} = 1 && $stderr == "splot: "*$2* ]] || { echo "${*:3}: $stderr"; return 1; }
}
kind() { head -c "$2" "$1"; }
two() { printf 'time\ta\tb\n0\t0\t1\n1\t1\t2\n2\t4\tnan\n3\t9\t4\n'; }

@test "the ending of --output says the kind: PNG, PPM of the same pixels, SVG that is XML; any other is refused" {
	two | splot a b -o p.png
	two | splot a b -o p.PPM
	two | splot a b -o p.svg
	pngtopnm p.png | cmp - p.PPM
	python3 -c 'import sys, xml.dom.minidom as m; print(m.parse(sys.argv[1]).documentElement.tagName)' p.svg | grep -qx svg
	two >t.tsv
	told 2 "the ending says the kind" a t.tsv -o p.jpg
	told 2 "no terminal (-o FILE.png" a t.tsv
	[ ! -e p.jpg ]
	two | splot b a -o p.png # an old picture is replaced
	if pngtopnm p.png | cmp -s - p.PPM; then return 1; fi
	[ "$(ls | grep -v stderr)" = $'p.PPM\np.png\np.svg\nt.tsv' ]
}

@test "the same table gives the same bytes, and tabs, commas and blanks the same picture" {
	two >t.tsv
	tr '\t' , <t.tsv | sed 's/^time/"time"/; s/nan//' >t.csv
	tr '\t' ' ' <t.tsv | sed 's/^0/  0/' >t.txt
	for f in t.tsv t.csv t.txt; do splot a b $f -o $f.svg; done
	cmp t.tsv.svg t.csv.svg
	cmp t.tsv.svg t.txt.svg
	sed '1s/^/# /' t.txt | splot a b -o named.svg # gnuplot's habit
	cmp t.tsv.svg named.svg
	sed 1d t.txt | splot --x 1 2 3 -o numbers.svg
	grep -q '>2</text>' numbers.svg
}

# Points of a 0..3 x 0..9 chart, one letter each: the parabola's corners are where they belong.
@test "text: the points are where they belong, of ASCII letters or braille, without trailing blanks" {
	two | splot a --ascii --style points --width 40 --height 20 >out
	run ! grep -nP '[^\x00-\x7f]| $' out
	[ "$(head -n 1 out)" = a ]
	[ "$(tail -n 1 out | xargs)" = time ]
	[ "$(grep -o '\*' out | wc -l)" = 4 ]
	[ "$(awk '/\*/ { print index($0, "*") }' out | sort -n | xargs)" = "$(awk '/\*/ { print index($0, "*") }' out | tac | xargs)" ] # upwards to the right
	two | LC_ALL=C.UTF-8 splot a --as-text >braille
	grep -q $'[\u2801-\u28ff]' braille
	two | LC_ALL=C.UTF-8 splot a b --as-text >marks # two lines without colours
	grep -q '●' marks
	grep -q '+' marks
	run ! grep -q $'\033' marks
	TERM=xterm script -qec 'bash -c "splot a <<<\"\$(printf \"x a\n1 2\n2 3\n\")\""' /dev/null >screen </dev/null
	grep -q $'\033\[38;5;' screen
}

@test "a column that is not there, a stream, an empty table, a torn row: one line with the remedy" {
	two >t.tsv
	told 1 "has no column 'energi' (it has time, a, b)" energi t.tsv --as-text
	told 1 "has no column 'bb', did you mean b" bb t.tsv --as-text
	echo time c1 c2 c3 c4 c5 c6 c7 >wide.tsv
	told 2 "which column? (splot NAME...; wide.tsv has time, c1, c2" wide.tsv --as-text
	pinit uniform -n 3 >s.pm
	told 1 "is a stream, not a table (... | diag | splot" a s.pm --as-text
	told 1 "no table" --as-text
	printf 'a b\n1 2\n3\n' >torn.txt
	told 1 "torn.txt: line 3 has 1 cells, the first has 2" b torn.txt --as-text
	told 1 "cannot open 'no.tsv'" a no.tsv --as-text
	told 1 "nothing to draw" --column b --x b --as-text <(printf 'b\nnan\n')
	printf 'a b\n1 one\n2 two\n' >words.txt
	told 1 "holds words ('one')" a words.txt --error b --as-text
	told 2 "--x-range takes LO,HI" a t.tsv --x-range 3,1 --as-text
}

@test "an expression over columns, with NAME0 the first number; a theory in x; slopes through the data" {
	two >t.tsv
	splot '(a - a0)/4 + 0*b0' t.tsv -o e.svg --y-label ratio
	awk -F'\t' 'NR == 1 { print "time ratio"; next } { print $1, $2 / 4 }' t.tsv | splot ratio -o r.svg
	cmp e.svg r.svg
	told 2 "no column 'c'" 'a + c' t.tsv --as-text
	# x^2 and a power law are straight lines through the data on logarithmic axes: the guides cover the line.
	sed 2d t.tsv >power.tsv
	splot a power.tsv --log --slope 2 --theory 'square law = x^2' --legend outside -o s.svg
	grep -q '>square law<' s.svg
	grep -q '>slope 2<' s.svg
	python3 - s.svg <<-'PY'
		import re, sys
		lines = [[tuple(map(float, p.split(","))) for p in q.split()] for q in re.findall(r'dasharray[^>]*points="([^"]*)"', open(sys.argv[1]).read())]
		long = [q for q in lines if len(q) > 100]
		assert len(long) == 2, len(long)
		dots = [tuple(map(float, c)) for c in re.findall(r'<circle cx="([\d.]+)" cy="([\d.]+)"', open(sys.argv[1]).read())]
		for line in long:
		    for x, y in dots[:3]:
		        assert min(abs(x - a) + abs(y - b) for a, b in line) < 3, (x, y)
	PY
	told 2 "no name but x: 'y'" a t.tsv --theory 'y^2' --as-text
}

@test "0 on a logarithmic axis has an open mark below a break; numbers below 0 are counted" {
	printf 'x e\n1 1e-3\n2 1e-5\n3 0\n4 -1\n' >t.txt
	run -0 --separate-stderr splot e t.txt --log-y -o z.svg
	[ "$stderr" = "splot: numbers below 0, which a logarithmic axis leaves out: 1" ]
	[ "$(grep -c '<circle' z.svg)" = 4 ] # two marks, and two discs of the open one
	grep -q '>0</text>' z.svg
	printf 'x e\n1 1e-3\n2 1e-5\n' | splot e --log-y -o w.svg
	! grep -q '>0</text>' w.svg
}

@test "error bars reach from low to high, and to the edge where a logarithmic axis cannot hold their end" {
	printf 'x e d\n1 1 0.5\n2 2 3\n3 3 0\n' >t.txt
	splot e t.txt -o plain.svg --y-range 0,6 --style points
	splot e t.txt -o bars.svg --y-range 0,6 --style points --error d
	[ $(($(grep -c polyline bars.svg) - $(grep -c polyline plain.svg))) = 6 ] # two bars of three pieces
	splot e t.txt -o log.svg --log-y --style points --error d
	[ "$(grep -c polyline log.svg)" -gt 6 ]
}

@test "a gap is a gap: no line crosses a nan, an empty cell, an empty line or a second line of names" {
	printf 'x y\n1 1\n2 2\n\n3 3\n4 4\nx y\n5 5\n6 nan\n7 7\n8 8\n' | splot y -s lines -o gaps.svg
	[ "$(grep -c 'stroke-width="1.9"' gaps.svg)" = 3 ] # 1-2, 3-4, 7-8
	printf 'x,y\n1,1\n2,2\n3,\n4,4\n5,5\n' | splot y -s lines -o cell.svg
	[ "$(grep -c 'stroke-width="1.9"' cell.svg)" = 2 ]
}

@test "--by draws a line for each value, --where takes rows, --name writes their words without overlap, and labels are escaped" {
	awk 'BEGIN { print "t,e,m,l"
		for (i = 1; i < 9; i++) for (k = 0; k < 3; k++) printf "%d,%g,%s,p%d\n", i, i * (k + 1), k == 0 ? "a<b>&c" : "k" k, i }' >t.csv
	splot --x t e t.csv --by m -o by.svg
	[ "$(grep -c 'stroke-width="1.9"' by.svg)" = 6 ] # three lines and their samples in the legend
	grep -q '>a&lt;b&gt;&amp;c</text>' by.svg
	splot --x t e t.csv --by m --where m=k1 -o one.svg
	[ "$(grep -c 'stroke-width="1.9"' one.svg)" = 2 ]
	splot --x t e t.csv --by m --name l -o names.svg
	[ "$(grep -cE '>p[1-8]</text>' names.svg)" = 24 ]
	python3 - names.svg <<-'PY'
		import re, sys
		box = [(float(x), float(y), 0.7 * float(s) * len(t), 0.72 * float(s)) for x, y, s, t in
		    re.findall(r'<text x="([\d.]+)" y="([\d.]+)" font-size="([\d.]+)"[^>]*>(p\d)<', open(sys.argv[1]).read())]
		assert len(box) == 24
		for i, (x, y, w, h) in enumerate(box):
		    for X, Y, W, H in box[:i]:
		        assert x >= X + W or X >= x + w or y - h >= Y or Y - H >= y, ((x, y), (X, Y))
	PY
}

# The legend must not lie over data: a chart full of points has no free place of its size inside.
@test "a legend never covers data: beside the picture where there is no room" {
	awk 'BEGIN { print "x y m"; for (i = 0; i < 40; i++) for (j = 0; j < 40; j++) print i, j, "set" j % 2 }' >full.txt
	splot --x x y full.txt --by m --style points -o full.svg
	edge=$(sed -n 's/.*stroke-width="1.2".*points="\([0-9.]*\),[^ ]* \([0-9.]*\),.*/\2/p' full.svg | sort -g | tail -n 1) # right end of the frame
	at=$(sed -n 's/<text x="\([0-9.]*\)".*>set1<.*/\1/p' full.svg)
	awk -v a="$at" -v e="$edge" 'BEGIN { exit !(e > 500 && a > e) }'
}

@test "a line of a million points becomes a picture in seconds, and its extremes stay" {
	awk 'BEGIN { print "x y"; for (i = 0; i < 300000; i++) print i, (i == 123456) ? 50 : i % 7 }' >long.txt
	splot y long.txt -o long.svg
	[ "$(wc -c <long.svg)" -lt 200000 ]
	splot y long.txt --ascii --width 60 --height 20 | sed -n 2,4p | grep -q '\*'
}

@test "diag's table goes straight in, and words of a column become the ticks of an axis" {
	sh_ok "pinit plummer -n 20 | cycle -n 4 --every 1 'push kick/2 drift | pp | push kick/2' | diag | splot energy_kinetic --ascii"
	[[ ${lines[0]} == energy_kinetic && $output == *time* ]]
	printf 'method error\ncic 0.3\ntsc 0.2\npcs 0.1\n' | splot --x error method -o words.svg
	for w in cic tsc pcs; do grep -q ">$w</text>" words.svg; done
}

@test "splot: rows of numbers without names keep their first row, though it reads as the names 1 and 2" {
	printf '1 2\n2 3\n3 5\n' | splot --as-text --width 60 >out
	grep -q '1\.0 .* 3\.0' out
}
