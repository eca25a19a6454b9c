# sdraw -o run.html: a page that shows the frames in a browser. What needs one runs in headless Chromium (tests/browser.py), whose console must stay silent.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

need_chromium() { command -v chromium >/dev/null || skip "no chromium here"; }
browser() { python3 -I -S "$top/tests/browser.py" "$@"; }
# pixel FILE X Y: r g b of a PPM.
pixel() { local w; w=$(sed -n 2p "$1" | cut -d' ' -f1); tail -c +$((1 + $(head -3 "$1" | wc -c) + 3 * ($3 * w + $2))) "$1" | head -c 3 | od -An -tu1 | xargs; }
near() { # "R G B" "R G B" TOLERANCE
	local a b
	read -ra a <<<"$1"; read -ra b <<<"$2"
	for k in 0 1 2; do within "${a[k]}" "${b[k]}" "$3" || { echo "got $1, want $2"; return 1; }; done
}

@test "a page is one file that asks for nothing outside; the run that made it is in it; nothing is left of a run that fails" {
	pinit plummer -n 50 >a
	cat a a >aa
	sh_ok 'sdraw -o run.html <aa'
	[ "$output" = run.html ]
	[ "$(ls)" = "$(printf '%s\n' a aa run.html)" ]
	run ! grep -nE 'https?://|<link[^>]*(stylesheet|preload)|<script[^>]* src=|@import|<img|<iframe' run.html
	grep -q "default-src 'none'" run.html
	[ "$(grep -c '^<script type="application/json" class="frame">' run.html)" = 2 ]
	sdraw --format html <aa | cmp - run.html
	sdraw --threads 1 -o one.html <aa
	cmp one.html run.html
	head -c -200 a >cut
	run -1 --separate-stderr bash -c 'cat a cut | sdraw -o cut.html'
	[ ! -e cut.html ]
	[ "${#stderr_lines[@]}" = 1 ]
	run -1 bash -c 'sdraw -o /nonexistent/run.html <a'
	run -1 bash -c 'sdraw --field nothing -o x.html <a'
	run -1 bash -c 'sdraw --set nobody -o x.html <a'
	run -3 bash -c 'sdraw --colour "1/(x-x)" -o x.html <a'
	for o in '--project' '--weight mass' '--style density' '--area 0,1,0,1' '--linear' '--size 300' '-o run%d.html'; do
		run -2 --separate-stderr bash -c "sdraw -o x.html $o <a"
		[ "${#stderr_lines[@]}" = 1 ]
	done
	[ ! -e x.html ]
}

# unpack FILE: the first frame as a table of name, component and numbers.
unpack() {
	python3 -I -S - "$1" <<-'END'
		import base64, json, re, struct, sys
		page = open(sys.argv[1]).read()
		frame = json.loads(re.search(r'class="frame">(.*)</script>', page).group(1))
		blocks = dict(re.findall(r'<script type="text/plain" id="block-(\d+)">(.*)</script>', page))
		for place in frame["sets"] + frame["meshes"]:
		    for field in place["fields"]:
		        for c, data in enumerate(field["data"]):
		            if isinstance(data, dict):
		                raw = base64.b64decode(blocks[str(frame["at"] + data["at"])])
		                form = {"f32": "f", "f16": "e", "u16": "H"}[data["as"]]
		                numbers = [data["lo"] + data["step"] * v for v, in struct.iter_unpack("<" + form, raw)]
		                print(field["name"], c, data["as"], *("%.17g" % v for v in numbers))
	END
}

@test "numbers on the page are those of the stream: few to the 7 digits of f32, many as positions of 1/65535 and values of 3 digits" {
	printf 'x y\n' >t
	for n in 300 5000; do
		pinit plummer -n $n >a
		scalc 'e = 1e-6*exp(9*x)' <a >b
		sdraw -o run.html <b
		unpack run.html >packed
		stab --plain <b | sed 1d >rows
		awk -v few=$((n < 4097)) 'NR == FNR { for (i = 1; i <= NF; i++) row[FNR, i] = $i; rows = FNR; width = NF; next }
			{ column = $1 == "x" ? 1 + $2 : $1 == "v" ? 4 + $2 : $1 == "e" ? width : 0
			if (!column) next
			seen++; want = few ? "f32" : $1 == "x" ? "u16" : "f16"; if ($3 != want || NF != rows + 3) { print $1, $3, NF; exit 1 }
			lo = hi = row[1, column]; for (i = 1; i <= rows; i++) { v = row[i, column] + 0; lo = v < lo ? v : lo; hi = v > hi ? v : hi }
			most = -lo > hi ? -lo : hi
			for (i = 1; i <= rows; i++) { v = row[i, column]; d = $(i + 3) - v; d = d < 0 ? -d : d; a = v < 0 ? -v : v
				# half a step: 2^-24 of f32; of u16; 2^-11 of f16, whose smallest step is 2^-24 of the largest value
				b = few ? a * 6e-8 : $1 == "x" ? 0.501 * (hi - lo) / 65535 : a / 2047 > most * 3e-8 ? a / 2047 : most * 3e-8
				if (d > b) { print $1, $2, i, v, $(i + 3), d, b; exit 1 } } }
			END { if (seen != 7) { print seen, "columns"; exit 1 } }' rows packed
	done
}

@test "of more than a million particles every k-th is on the page, and that is said there and on standard error" {
	pinit uniform --dim 1 -n 1000001 >a
	run -0 --separate-stderr bash -c 'sdraw --field nothing -o run.html <a || sdraw --field mass -o run.html <a'
	[[ $stderr == *"sdraw: the page has one particle of 2 (the limit is 1000000 of a set)"* ]]
	grep -q '"n":1000001,"kept":500000,' run.html
	grep -q '"leftOut":"one particle of 2 ' run.html
}

@test "names, units, titles and a history full of markup stay text" {
	bad='<\/script><script>document.body.dataset.bad=1<\/script>' worse='"><img src=x onerror=document.body.dataset.bad=1>'
	printf 'x y q\n0.25 0.75 3\n' | stab - --law free --box 0,0,1,1 | stab |
		sed "s/\"unit\":\"\"/\"unit\":\"$bad\"/g; s/\"scene\":{\"name\":\"\"/\"scene\":{\"name\":\"$bad\"/
			s/\"program\":\"stab\"/\"program\":\"$bad \\\\$worse\"/
			s/\"name\":\"q\"/\"name\":\"$bad\"/; s/\"matter\"/\"a$bad\"/g; s/^#set matter/#set a$bad/; s/	q\$/	$bad/" >text
	[ "$(grep -o 'script>document' text | wc -l)" -ge 8 ]
	stab text >bad
	sdraw --colour "x + 1" -o run.html <bad
	sdraw --title "</title><script>document.body.dataset.bad=1</script>" -o title.html <bad
	for p in run title; do
		[ "$(grep -o '<script' $p.html | wc -l)" = "$(($(grep -c '"text/plain"' $p.html) + 4))" ] # run, a frame, curves, and the page's own
		run ! grep '<img\|<script>document' $p.html
	done
	need_chromium
	browser 'open run.html' 'eval document.title' 'eval document.body.dataset.bad' \
		'eval [...byId("colour").options].map(o => o.text).find(text => text.includes("script"))' 'eval byId("history").textContent' \
		'move 300 300' 'open title.html' 'eval document.body.dataset.bad' >out
	[ "$(grep -c '^null$' out)" = 2 ]
	[ "$(grep -c '^"[a-z]*</script><script>document' out)" = 3 ] # title, a field, the history
	grep -q 'img src=x onerror' out
}

@test "a particle is drawn where it is, and the ground is dark elsewhere, on a light and on a dark page" {
	need_chromium
	printf 'x y\n0.25 0.75\n0.5 0.125\n' | stab - --law free --box 0,0,1,1 >a
	sdraw -o run.html <a
	browser 'size 900 600' 'open run.html' \
		'eval project([0.25, 0.75, 0]).concat(project([0.5, 0.125, 0]), project([0.75, 0.5, 0])).map(Math.round).join(" ")' \
		'eval document.getElementById("view").getBoundingClientRect().top' 'shot light.png' dark 'shot dark.png' 'key t' 'shot again.png' >out
	read -r x0 y0 _ x1 y1 _ x2 y2 _ <<<"$(sed -n 1p out | tr -d '"')"
	top_=$(sed -n 2p out | cut -d. -f1)
	for page in light dark again; do
		pngtopnm $page.png >$page.ppm
		near "$(pixel $page.ppm "$x0" $((y0 + top_)))" "255 214 150" 12
		near "$(pixel $page.ppm "$x1" $((y1 + top_)))" "255 214 150" 12
	done
	near "$(pixel light.ppm "$x2" $((y2 + top_)))" "17 18 28" 3
	near "$(pixel light.ppm 450 5)" "255 255 255" 3
	near "$(pixel dark.ppm 450 5)" "22 24 31" 3
	near "$(pixel again.ppm 450 5)" "255 255 255" 3
}

@test "a mesh has the colours of the PNG that sdraw makes, in 2-D and on a slice in 3-D" {
	need_chromium
	pinit uniform --dim 2 -n 1 --cells 16 | scalc --mesh mesh 'f = sin(2*pi*x/Lx) + y/Ly' >two
	pinit uniform -n 1 --cells 16 | scalc --mesh mesh 'f = 2 + sin(2*pi*x/Lx) + y/Ly + z/Lz' >three
	places='eval [[0.2, 0.3], [0.5, 0.6], [0.8, 0.45]].map(p => project([p[0], p[1], 0.98].map((t, d) => t * frames[0].box[d < 2 ? d : 0].hi))).flat()
		.concat(byId("view").getBoundingClientRect().top).map(Math.round).join(" ")'
	for d in two three; do
		sdraw --field f --range 0,5 --slice 0.98 -o $d.html <$d
		sdraw --field f --range 0,5 --slice 0.98 --size 400 --format ppm <$d >$d.ppm
	done
	browser 'size 1000 700' 'open two.html' 'shot two.png' "$places" 'open three.html' 'shot three.png' "$places" >out
	for d in two three; do
		pngtopnm $d.png >shot.ppm
		read -ra p <<<"$(tr -d '"' <out | sed -n "$([ $d = two ] && echo 1 || echo 2)p")"
		# the data area of sdraw begins at 44, 24; a pixel is 1/400 of the map's way in its 5 units: 6 of 255
		near "$(pixel shot.ppm "${p[0]}" $((p[1] + p[9])))" "$(pixel $d.ppm $((44 + 80)) $((24 + 280)))" 6
		near "$(pixel shot.ppm "${p[3]}" $((p[4] + p[9])))" "$(pixel $d.ppm $((44 + 200)) $((24 + 160)))" 6
		near "$(pixel shot.ppm "${p[6]}" $((p[7] + p[9])))" "$(pixel $d.ppm $((44 + 320)) $((24 + 220)))" 6
	done
}

@test "mouse, wheel, fingers, keys, sliders and the curves: each does what the page's table says, and hover tells the numbers" {
	need_chromium
	pinit two-body --eccentricity 0.3 | cycle -n 40 --every 10 'push kick/2 drift | pp | push kick/2' >a
	sdraw -o run.html <a
	diag <a >rows
	browser 'size 1000 700' 'open run.html' 'eval frames.length' 'key ArrowRight' 'eval state.frame' 'key End' 'eval state.frame' 'key Home' \
		'eval chosen("time")' 'eval panel.groups.length > 3' 'eval choose("depth", "x 2"), camera.deep && camera.turn[0]' \
		'drag 300 300 400 330' 'eval camera.turn[0].toFixed(3)' \
		'key z' 'eval JSON.stringify(flatAxes())' 'wheel 300 300 -200' 'eval camera.zoom > 1.3' 'key r' 'eval camera.zoom' \
		'pinch 300 300 1.5' 'eval camera.zoom.toFixed(2)' 'key r' 'key z' \
		'key Space' 'wait state.frame == 2' 'key Space' 'eval state.playing' \
		'size 600 900' 'wait byId("scene").width == byId("view").clientWidth' \
		'size 1000 700' 'key Home' 'eval [...project([0, 1, 2].map(d => state.drawn.numbers[d][1])).slice(0, 2),
			byId("view").getBoundingClientRect().top,
			byId("curves-ink").getBoundingClientRect().left + panel.r.x1 * 0.76 + panel.r.x0 * 0.24,
			byId("curves-ink").getBoundingClientRect().top + 60]
			.map(Math.round).join(" ")' >out
	read -r x y below cx cy <<<"$(tail -n 1 out | tr -d '"')"
	sed '$d' out | diff - <(sed 's/^	*//' <<-'END'
		5
		1
		4
		"0"
		true
		0.8775825618903728
		"0.921"
		"[0,1]"
		true
		1
		"1.50"
		false
	END
	)
	browser 'size 1000 700' 'open run.html#depth=x%202' 'key z' "move $x $((y + below))" 'eval byId("tip").hidden' 'eval byId("tip").textContent' \
		"drag $cx $cy $cx $cy" 'eval state.frame' 'eval curves.rows[3][curves.columns.indexOf("energy_kinetic")]' >out
	[ "$(sed -n 1p out)" = false ]
	[[ $(sed -n 2p out) == *"particle 1\\nx = \\u22120.65 length\\n"*"vx = "* ]]
	# three quarters of the curves' time are the fourth frame of five; its number is that of diag but for the decimals written (17 digits)
	[ "$(sed -n 3p out)" = 3 ]
	within "$(tail -n 1 out)" "$(column energy_kinetic <rows | sed -n 4p)" 1e-15
}

@test "without WebGL the page says so in words, and shows the curves" {
	need_chromium
	pinit plummer -n 20 | cycle -n 2 --every 1 'push kick/2 drift | pp | push kick/2' | sdraw -o run.html
	NO_WEBGL=1 browser 'open run.html' 'eval document.getElementById("trouble").hidden' 'eval document.getElementById("trouble").textContent' \
		'eval panel.r.x1 > 100' 'key ArrowRight' 'eval document.getElementById("when").textContent' >out
	[ "$(sed -n 1p out)" = false ]
	[[ $(sed -n 2p out) == *"has no WebGL 2"* ]]
	[ "$(sed -n 3p out)" = true ]
	[[ $(sed -n 4p out) == *"frame 2 of 3"* ]]
}
