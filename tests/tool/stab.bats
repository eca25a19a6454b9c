# stab: text to stream and back. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

table() { printf 'x y z vx vy vz mass id\n0.5 0.25 -1e-17 1 2 3 2.385 7\n1e300 -0 .5 4 5 6 1e-300 -3\n'; }

@test "stream to text to stream gives equal bytes, with a mesh field, a uniform field and a report" {
	pinit uniform -n 137 --seed 3 --mass-spread 0.3 | p2m -n 7x6x5 | poisson-fft >a
	sh_ok 'stab <a | stab - >b; cmp a b'
	sh_ok 'stab <a >t; stab - <t | stab | cmp - t'
}

@test "stream to text to stream gives equal bytes for every scene" {
	for scene in $(pinit --complete | tr ' ' '\n' | grep -xE 'plummer|uniform|lattice|two-body|kepler|pair|cold-collapse'); do
		sh_ok "pinit $scene >a; stab <a | stab - | cmp - a"
	done
	sh_ok 'pinit plummer -n 20 >a; stab <a | stab - | cmp - a'
}

@test "text to stream to text gives the same numbers, the smallest and the largest included" {
	table >t
	sh_ok 'stab t | stab --plain | tr "\t" " " | tail -n +2 >u; stab t | stab | stab - | stab --plain | tr "\t" " " | tail -n +2 | cmp - u; cat u'
	[ "${lines[0]}" = "0.5 0.25 -1e-17 1 2 3 2.385 7" ]
	[ "${lines[1]}" = "1e+300 -0 0.5 4 5 6 1e-300 -3" ]
}

@test "alpha_x alpha_y alpha_z are a vector strength, as alpha_0 alpha_1 alpha_2 are" {
	for names in 'alpha_x alpha_y alpha_z' 'alpha_0 alpha_1 alpha_2'; do
		printf 'x y z %s volume\n0 0 0 1 2 3 1\n' "$names" | stab - --law vortex --no-history | sls | grep -E ' alpha ' >>seen
	done
	[ "$(sort -u seen)" = "    alpha       3 f64 state strength" ]
	run -1 --separate-stderr bash -c "printf 'x alpha_y\n0 1\n' | stab -"
	[[ $stderr == *"the columns of 'alpha' must be all its components in order"* ]]
}

@test "the names of the bodies travel with them" {
	sh_ok "stab $top/data/solar-system.tsv --law gravity --constant G=2.95912208286e-4 | stab --plain | cut -f1 | paste -sd,"
	[ "$output" = "name,sun,jupiter,saturn,uranus,neptune,pluto" ]
}

@test "letters that would break a table travel as % and their number: blanks, #, %, none" {
	printf 'name x y mass\n%%23a%%20b%%25 1 2 3\n%% 4 5 6\nc 7 8 9\n' >t
	sh_ok 'stab --text name t | stab | stab - | stab --plain | cut -f1 | paste -sd,'
	[ "$output" = "name,%23a%20b%25,%,c" ]
}

@test "text that stab wrote is read with rows taken out" {
	sh_ok 'pinit plummer -n 10 | stab | awk -F"\t" "/^#/ || NF != 7 || \$7 != 4" | stab - | stab --plain | cut -f8 | paste -sd,'
	[ "$output" = "id,0,1,2,3,5,6,7,8,9" ]
}

@test "HC-59: empty lines, comments, CRLF, blanks before, tabs and no newline at the end are all legal" {
	printf '# a table\r\n\r\n  x\ty   mass\r\n\n 1 2\t3\r\n# between\n4 5 6' >t
	sh_ok 'stab t | stab --plain | paste -sd" " | tr "\t" " "'
	[ "$output" = "x y mass 1 2 3 4 5 6" ]
	counted 6 # kinds
}

@test "HC-59: no rows make a set of no particles, one row makes one" {
	sh_ok 'printf "x y z mass\n" | stab - | stab --plain'
	[ "$output" = "x	y	z	mass" ]
	sh_ok 'printf "x y z mass\n1 2 3 4" | stab - | stab --plain | tail -1'
	[ "$output" = "1	2	3	4" ]
}

@test "HC-59: what is not finite is refused with its line and column" {
	for bad in nan NaN inf -Inf 1e999; do
		printf 'x y z\n1 2 3\n# one\n4 %s 6\n' "$bad" >t
		run -1 --separate-stderr stab t
		[ "$stderr" = "stab: t: line 4, column 2 'y': '$bad' is not finite" ]
		counted 1
	done
}

@test "HC-60: a row with too few or too many columns is refused with its line" {
	printf 'x y z\n1 2 3\n\n1 2\n1 2 3 4\n' >t
	run -1 --separate-stderr stab t
	[ "$stderr" = "stab: t: line 4: 2 columns, but the line of names has 3" ]
	printf 'x y z\n1 2 3\n1 2 3 4\n' >t
	run -1 --separate-stderr stab t
	[ "$stderr" = "stab: t: line 3: 4 columns, but the line of names has 3" ]
	counted 2
}

@test "HC-59: the first wrong line is named in a text of many pieces, whatever the number of threads" {
	awk 'BEGIN { print "x y z"; for (i = 0; i < 200000; i++) print i * 0.37, -i, i == 150000 ? "1.2.3" : i == 150007 ? "nan" : 0.5 }' >t
	for n in 1 2 3; do
		run -1 --separate-stderr stab --threads $n t
		[ "$stderr" = "stab: t: line 150002, column 3 'z': '1.2.3' is not a number" ]
	done
}

@test "what is not a number, not whole or too long is refused" {
	printf 'x label\n1 sun\n' >t
	run -1 --separate-stderr stab t
	[ "$stderr" = "stab: t: line 2, column 2 'label': 'sun' is not a number" ]
	printf 'x id\n1 1.5\n' >t
	run -1 --separate-stderr stab t
	[ "$stderr" = "stab: t: line 2, column 2 'id': '1.5' is not an integer of 64 bits" ]
	printf 'x name\n1 abcdefghijklmnopq\n' >t
	run -1 --separate-stderr stab t
	[ "$stderr" = "stab: t: line 2, column 2 'name': 'abcdefghijklmnopq' has too many letters" ]
}

@test "--text keeps a column of letters and --skip leaves one out" {
	printf 'x label junk\n1 s%%un 0\n2 a#b ?\n' >t
	sh_ok 'stab t --text label --skip junk | stab --plain | tail -n +2 | paste -sd" " | tr "\t" " "'
	[ "$output" = "1 s%25un 2 a%23b" ]
	sh_ok 'stab t --text label --skip junk >a; stab <a | stab - | cmp - a'
}

@test "a table without columns, without x, with one twice or with a gap is refused" {
	run -1 --separate-stderr bash -c ': | stab -'
	[ "$stderr" = "stab: standard input: line 1: the text ends before a line of column names" ]
	for head in 'mass' 'x z' 'x x' 'x q_0 q_2' 'x y z vx vz' 'x q q_0'; do
		run -1 --separate-stderr bash -c "printf '$head\n' | stab -"
		[ "${#stderr_lines[@]}" = 1 ]
	done
	printf '1 2 3 0 0 0 1\n4 5 6 0 0 0 1\n' >a # no line of names
	run -1 stab a
	[[ $output == *"no column 'x' (the first line of the table names its columns"* ]]
}

@test "columns NAME_0 NAME_1 are one field in any order of columns, a lone NAME_3 is refused" {
	sh_ok 'printf "q_1 x q_0\n2 0 1\n" | stab - | stab --plain | tail -1'
	[ "$output" = "2	1	0" ] || [ "$output" = "1	2	0" ]
	run -1 bash -o pipefail -c 'printf "x q_3\n0 1\n" | stab -'
}

@test "the options of a table become attributes of the frame" {
	printf 'x y mass w\n0 0 1 1\n' >t
	sh_ok 'stab t --law free --constant a=2.5,b=3 --dt 0.125 --time 2 --dim 2 --box -1,2 --faces periodic --cells 4x5 --strength w \
		--unit mass=kg --number --set stars | stab | head -1 | cut -c9-'
	echo "$output" | jq -e '.law.constants.a == 2.5 and .law.constants.b == 3 and .dt == 0.125 and .time == 2 and .box.lo == [-1,-1] and .box.hi == [2,2]
		and .box.fields[1] == ["periodic","periodic"] and .box.particles[0] == ["periodic","periodic"] and .meshes[0].cells == [4,5]
		and .sets[0].name == "stars"
		and ([.fields[] | select(.name == "w" or .name == "mass") | .kind] == ["strength","strength"])
		and ([.fields[] | select(.name == "mass").unit] == ["kg"])
		and ([.fields[] | select(.name == "id").type] == ["i64"])'
	sh_ok 'stab t --faces open,wall --particle-faces absorb,open,reflect,open | stab | head -1 | cut -c9-'
	echo "$output" | jq -e '.box.fields == [["open","open"],["wall","wall"]] and .box.particles == [["absorb","open"],["reflect","open"]]'
}

@test "a column m is no mass, which a law that needs one says; not where the mass is there, or the law has no strength" {
	printf 'x v m\n0 0 1\n1 0 2\n' >t
	run -0 --separate-stderr bash -o pipefail -c 'stab t --law gravity | sls'
	[ "$stderr" = "stab: the law gravity takes the column 'mass', and there is 'm' (call it mass, if it is meant so)" ]
	sed 's/x v m/x v Charge/' t >u
	run -0 --separate-stderr bash -o pipefail -c 'stab u --law electrostatic | sls'
	[[ $stderr == *"takes the column 'charge', and there is 'Charge'"* ]]
	printf 'x v m mass\n0 0 1 1\n' >u
	run -0 --separate-stderr bash -o pipefail -c 'stab u --law gravity | sls; stab t | sls; stab t --law electrostatic | sls'
	[ -z "$stderr" ]
}

@test "without --box the box is a cube of twice the extent about the particles" {
	sh_ok 'printf "x y z\n1 0 0\n3 1 0\n" | stab - | stab | head -1 | cut -c9-'
	echo "$output" | jq -e '.box.lo == [0,-1.5,-2] and .box.hi == [4,2.5,2]'
	sh_ok 'printf "x\n1e300\n" | stab - | stab | head -1 | cut -c9-'
	echo "$output" | jq -e '.box.lo[0] < 1e300 and .box.hi[0] > 1e300'
}

@test "wrong options are usage errors" {
	printf 'x\n0\n' >t
	for o in '--dim 2' '--box 1' '--box 2,1' '--faces soft' '--faces periodic,open,open' '--constant G' '--constant G=x' '--law gravity2' '--plain' \
		'--mesh m' '--dt -1'; do
		run bash -c "stab t $o >/dev/null"
		[[ $status = 2 || ( $o = "--dim 2" && $status = 1 ) ]]
	done
	run -2 bash -c 'pinit plummer -n 5 | stab --law free'
	run -2 bash -o pipefail -c 'pinit plummer -n 5 | stab | stab - --law free'
	run -2 bash -c 'pinit plummer -n 5 | stab --mesh mesh'
}

@test "--plain writes the points of a mesh with their coordinates" {
	sh_ok 'pinit lattice -n 8 | p2m -n 2 | stab --plain --mesh mesh'
	[ "${lines[0]}" = "x	y	z	rho" ]
	[ "${#lines[@]}" -ge 9 ]
	run -1 bash -c 'pinit plummer -n 5 | stab --plain --set nobody'
	run -1 bash -c 'pinit plummer -n 5 | stab --plain --mesh nowhere'
}

@test "text that was cut, or whose header lies, is refused" {
	pinit plummer -n 5 | stab >t
	head -n -1 t >u
	run -1 --separate-stderr stab u
	[[ "$stderr" == *"stops before its end line"* ]]
	sed 's/^#end 1/#end 2/' t >u
	run -1 --separate-stderr stab u
	[[ "$stderr" == *"does not count the 1 frames"* ]]
	sed 's/"dim":3/"dim":7/' t >u
	run -1 stab u
	sed 's/"n":5/"n":-5/' t >u
	run -1 stab u
	sed '1s/{/{{/' t >u
	run -1 --separate-stderr stab u
	[[ "$stderr" == *"line 1: the JSON"* ]]
	sed 's/^x\ty/x\tq/' t >u
	run -1 --separate-stderr stab u
	[[ "$stderr" == *"column 'q'"* ]]
	pinit uniform -n 5 --dim 1 | p2m -n 4 | stab >m
	sed '/^#mesh/{n;n;p;}' m >u
	run -1 --separate-stderr stab u
	[[ "$stderr" == *"5 rows, but the mesh 'mesh' has 4 points"* ]]
	sed '/^#mesh/{n;n;d;}' m >u
	run -1 --separate-stderr stab u
	[[ "$stderr" == *"3 rows, but the mesh 'mesh' has 4 points"* ]]
	sed '/^#set/d' t >u
	run -1 --separate-stderr stab u
	[[ "$stderr" == *"no table of set 'matter'"* ]]
}

@test "several frames and a stream of none come back" {
	pinit plummer -n 5 >a
	sh_ok 'stab <a >t; cat t t | stab - | stab | grep -c "^#pmpipe"'
	[ "$output" = 2 ]
	printf '#end 0\n' >t
	sh_ok 'stab t | stab | cmp - t'
	run -1 stab /nonexistent
}

@test "a stream that was cut, garbage or empty is an error for stab" {
	pinit plummer -n 50 >a
	head -c 2000 a >cut
	run -1 stab -i cut
	run -1 bash -c ': | stab'
	run -1 bash -c 'head -c 500 /dev/zero | stab'
	run -1 bash -c 'stab <a >/dev/full'
}

@test "a byte order mark and UTF-16 are refused in one line that says what takes them off, and that does" {
	printf '\xef\xbb\xbfx y mass\n0 0 1\n' >bom
	run -1 --separate-stderr stab bom
	[ "$stderr" = "stab: bom: it begins with a byte order mark, three bytes that do not belong to the table (remove them: tail -c +4)" ]
	sh_ok 'tail -c +4 bom | stab - | stab --plain'
	[ "${lines[1]}" = $'0\t0\t1' ]
	printf 'x\n0\n' | iconv -t UTF-16 >wide
	run -1 --separate-stderr bash -c 'stab - <wide'
	[ "$stderr" = "stab: standard input: it is UTF-16 (convert it to UTF-8: iconv -f UTF-16 -t UTF-8)" ]
}

@test "--plain writes the set matter, or where there is none the first that has particles; a name that is given must be there" {
	cmp <(pinit two-stream -n 10 | stab --plain) <(pinit two-stream -n 10 | stab --plain --set electrons)
	cmp <(pinit kepler | stab --plain) <(pinit kepler | stab --plain --set matter)
	cmp <(pinit plasma | species ions -n 5 | stab --plain) <(pinit plasma | species ions -n 5 | stab --plain --set ions) # electrons has none
	run -1 --separate-stderr bash -c 'pinit two-stream -n 10 | stab --plain --set matter'
	[[ $stderr == *"no set 'matter'"* ]]
}

@test "a table with commas is read as one with blanks: quotes, blanks, comments, empty lines and CRLF; --format csv writes it as RFC 4180 has it" {
	printf '# made elsewhere\n"x", y ,name,mass\r\n\n0,1,"a, ""b""",2\r\n# here\n 3 ,-4e-1,c d,"5"\r\n-0,7,,1' >c
	printf 'x\ty\tname\tmass\n0\t1\ta,%%20"b"\t2\n3\t-0.4\tc%%20d\t5\n-0\t7\t%%\t1\n' >t
	stab c | stab --plain | diff t -
	stab t | stab --format csv >d
	printf 'x,y,name,mass\n0,1,"a, ""b""",2\n3,-0.4,c d,5\n-0,7,,1\n' | diff - d
	stab d | stab --plain | diff t -
	python3 -I -S -c 'import csv; a = list(csv.reader(open("d"))); assert a[1][2] == "a, \"b\"" and a[3][2] == "", a'
	pinit plummer -n 3000 | stab --format csv >p
	[ "$(tr , '\t' <p | tail -n 1)" = "$(pinit plummer -n 3000 | stab --plain | tail -n 1)" ]
	stab p | OMP_NUM_THREADS=1 stab --format csv | same_as - p
	p2m -n 4 < <(pinit uniform -n 9) | stab --format csv --mesh mesh | head -n 1 | grep -qx 'x,y,z,rho'
}

@test "what is wrong in a table with commas is refused with line and column, and semicolons in words that help" {
	refused() { run -1 --separate-stderr stab - < <(printf "$2"); [[ $stderr == "stab: standard input: $1"* ]] || { echo "$stderr"; return 1; }; }
	refused "line 2, column 2 'y': '' is not a number" 'x,y\n1,\n'
	refused "line 3: 3 columns, but the line of names has 2" 'x,y\n\n1,2,\n'
	refused "line 2, column 2 'y': '2' has quotes that do not end before a comma" 'x,y\n1,"2\n'
	refused "line 2, column 1 'x': '1' has quotes that do not end before a comma" 'x,y\n"1"2,3\n'
	refused "line 2, column 1 'x': '1 2' is not a number" 'x,y\n1 2,3\n'
	refused "line 1: column 2 has no name" 'x,,z\n1,2,3\n'
	refused "semicolons separate its columns, but a table has commas, tabs or blanks there (tr ';' ',' where 0.5 has a point" 'x;y\n1;2\n'
	[ "$(printf 'x;y\n0,5;2\n' | tr ',;' '.,' | stab - | stab --plain | tail -n 1)" = "$(printf '0.5\t2')" ]
	# a comma in a name of a table with tabs is no separator
	[ "$(printf 'x\ta,b\n1\t2\n' | stab - | stab --plain | tail -n 1)" = "$(printf '1\t2')" ]
}
