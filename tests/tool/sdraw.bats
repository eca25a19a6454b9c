# sdraw: pictures. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# Frames a: a 3-D mesh field rho, g (vector) and particles; made without other tools than stab and scalc-free text.
mesh() { # DIM: a mesh of 4 cells per axis, open faces, with f = x + 10 y (+ 100 z), w a vector
	local n
	printf '%s' "$1" | awk '{ d = $1; n = 5
		box = d == 1 ? "[0.0]" : d == 2 ? "[0.0,0.0]" : "[0.0,0.0,0.0]"; hi = box; gsub("0.0", "4.0", hi); cells = box; gsub("0.0", "4", cells);
			h = box; gsub("0.0", "1.0", h)
		faces = "[\"open\",\"open\"]"; all = faces; for (i = 1; i < d; i++) all = all "," faces
		printf "#pmpipe {\"byte_order\":\"little\",\"box\":{\"fields\":[%s],\"hi\":%s,\"lo\":%s,\"particles\":[%s]},", all, hi, box, all
		printf "\"dim\":%d,\"dt\":0.1,\"fields\":[", d
		printf "{\"components\":1,\"kind\":\"value\",\"name\":\"f\",\"on\":\"mesh\",\"role\":\"derived\",\"type\":\"f64\",\"unit\":\"\"},"
		printf "{\"components\":2,\"kind\":\"value\",\"name\":\"w\",\"on\":\"mesh\",\"role\":\"derived\",\"type\":\"f64\",\"unit\":\"\"}],"
		printf "\"history\":[],"
		printf "\"law\":{\"constants\":{},\"name\":\"free\"},\"meshes\":[{\"cells\":%s,\"h\":%s,\"lo\":%s,\"name\":\"mesh\"}],", cells, h, box
		printf "\"scene\":{\"name\":\"\",\"parameters\":{}},"
		printf "\"seed\":1,\"sets\":[],\"step\":0,\"substep\":0,\"time\":0.0}\n#mesh mesh\nf w_0 w_1\n"
		for (k = 0; k < (d > 2 ? n : 1); k++) for (j = 0; j < (d > 1 ? n : 1); j++) for (i = 0; i < n; i++) print 1 + i + 10*j + 100*k, i - 2, j
		print "#end 1" }' | stab -
}
# pixel FILE X Y: r g b of a PPM that sdraw made.
pixel() { local w; w=$(sed -n 2p "$1" | cut -d' ' -f1); tail -c +$((1 + $(head -3 "$1" | wc -c) + 3 * ($3 * w + $2))) "$1" | head -c 3 | od -An -tu1 | xargs; }
picture() { [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] && [ "$(tail -c 8 "$1" | head -c 4)" = IEND ]; }

@test "particles become a PNG whose name is printed" {
	sh_ok 'pinit plummer -n 300 | sdraw -o p.png'
	[ "$output" = p.png ]
	picture p.png
}

@test "PNG and PPM are the same picture" {
	pinit plummer -n 300 >a
	sdraw -o p.png <a; sdraw --format ppm <a >p.ppm
	pngtopnm p.png | cmp - p.ppm
}

@test "the picture does not depend on the number of threads" {
	pinit plummer -n 6000 >a
	sdraw --threads 1 --format ppm <a >one
	for n in 2 3; do sdraw --threads $n --format ppm <a | cmp - one; done
}

@test "several frames become a sequence, a name without number is refused at the second" {
	pinit plummer -n 20 >a; cat a a a >aaa
	sh_ok 'sdraw --size 64 <aaa'
	[ "$output" = "$(printf 'frame-0001.png\nframe-0002.png\nframe-0003.png')" ]
	picture frame-0003.png
	sh_ok 'sdraw --size 64 -o p%d.png <aaa | tail -1'
	[ "$output" = p3.png ]
	run -2 --separate-stderr bash -c 'sdraw --size 64 -o p.png <aaa'
	[[ "$stderr" == "sdraw: frame 2: 'p.png' would be overwritten"* ]]
}

@test "ppm frames follow one another, in a pipe or in one file" {
	pinit plummer -n 20 >a; cat a a >aa
	sdraw --size 64 --format ppm <a >one
	cat one one >two
	sdraw --size 64 --format ppm <aa | cmp - two
	sh_ok 'sdraw --size 64 --format ppm -o m.ppm <aa'
	[ "$output" = m.ppm ]
	cmp m.ppm two
	sh_ok 'sdraw --size 64 --format ppm -o m%02d.ppm <aa'
	cmp m02.ppm one
}

@test "a mesh field is drawn in one, two and three dimensions" {
	for d in 1 2 3; do
		mesh $d >m
		sh_ok 'sdraw --field f -o f.png <m; sdraw -o g.png <m
			sdraw --mesh mesh --field w --component y -o h.png <m; sdraw --field w --component 0 -o i.png <m'
		for p in f g h i; do picture $p.png; done
	done
}

@test "colours follow the numbers: the map's ends sit at the corners of a field that grows towards them" {
	mesh 2 >m
	sdraw --field f --format ppm --size 400 <m >p
	# data area: letter = 400/56, left 6.2, top 3.4 letters: 44, 24; its corners a few pixels inside
	[ "$(pixel p 47 420)" != "$(pixel p 441 27)" ]
	read -r r g b <<<"$(pixel p 47 420)"; within "$r" 68 6; within "$g" 1 8; within "$b" 85 6   # viridis starts at 68 1 84
	read -r r g b <<<"$(pixel p 441 27)"; within "$r" 253 8; within "$g" 231 8; within "$b" 37 12 # and ends at 253 231 37
}

@test "a slice takes the plane asked for, a projection the integral" {
	mesh 3 >m
	sdraw --field f --format ppm --size 64 <m >middle
	sdraw --field f --format ppm --size 64 --slice 2 <m | cmp - middle
	sdraw --field f --format ppm --size 64 --slice 0.5 --range 0,500 <m >low
	sdraw --field f --format ppm --size 64 --slice 3.5 --range 0,500 <m >high
	run ! cmp -s low high
	for axis in x y z; do sdraw --field f --format ppm --size 64 --axis $axis --project <m >p$axis; done
	run ! cmp -s px py
	run -1 --separate-stderr bash -c 'sdraw --field f --slice 9 <m'
	[[ "$stderr" == *"--slice 9 is outside the box, 0 to 4 along z"* ]]
}

@test "numbers of both signs are drawn about zero in two colours" {
	mesh 2 >m
	sdraw --field w --component x --format ppm --size 400 <m >p
	read -r r g b <<<"$(pixel p 244 224)" # the middle, where w_x = 0
	within "$r" 221 6; within "$g" 221 6; within "$b" 221 6 # Moreland's middle is 221 221 221
}

@test "a range that is not symmetric leaves 0 in the middle of the two colours; a hundredth below 0 is no sign" {
	mesh 2 >m # w_x runs from -2 to 2
	sdraw --field w --component x --range -1,4 --format ppm --size 400 <m >p
	read -r r g b <<<"$(pixel p 244 224)"
	within "$r" 221 6; within "$g" 221 6; within "$b" 221 6
	scalc --mesh mesh 'h = w_0 > 0 ? w_0 : w_0 / 201' <m | sdraw --field h --format ppm --size 400 >q
	read -r r g b <<<"$(pixel q 47 420)"; within "$r" 68 6; within "$g" 1 8; within "$b" 85 6 # viridis
}

@test "every option of particles draws another picture" {
	pinit plummer -n 200 >a
	sdraw --size 64 --format ppm <a >p0
	i=0
	for o in '--x x --y z' '--y vx' '--colour hypot(vx,vy)' '--field v' '--weight mass' '--style density' '--style density --linear' \
		'--style density --log --map grey' \
		'--colour x --range 0,1' '--colour x --map magma' '--area -2,2,-2,2' '--title hello' '--size 70' '--colour abs(x)+1 --log' \
			'--set matter --style points --area -3,3,-3,3'; do
		i=$((i + 1))
		# shellcheck disable=SC2086
		sdraw --size 64 --format ppm $o <a >p$i
		for k in $(seq 0 $((i - 1))); do run ! cmp -s p$k p$i; done
	done
}

@test "phase space: x against v is what 1-D particles show by themselves; two streams are two bands; another velocity or a wrong name is refused" {
	pinit two-stream -n 40000 --vth 0.1 --amplitude 0 --loading bit-reversed >a # of one weight: the density is that of the particles
	sdraw --format ppm --size 400 --area 0,6.283185307,-1,1 <a >p
	sdraw --format ppm --size 400 --area 0,6.283185307,-1,1 --x x --y vx --style density <a | cmp - p
	# the brightest row of a column, above and below the middle, is that of v0 = 0.612
	w=$(sed -n 2p p | cut -d' ' -f1) h=$(sed -n 2p p | cut -d' ' -f2)
	tail -c +$((1 + $(head -3 p | wc -c))) p | od -An -v -tu1 -w$((3 * w)) | awk -v c=200 '{ print $(3 * c + 1) + $(3 * c + 2) + $(3 * c + 3) }' >column
	read -r up down between <<<"$(awk 'NR > 30 && NR < 345 { v[NR] = $1 } END { for (i = 31; i < 345; i++) { if (i < 187 && v[i] > v[a]) a = i;
		if (i > 187 && v[i] >= v[b]) b = i }
		for (i = a; i <= b; i++) if (!m || v[i] < v[m]) m = i; print a, b, v[m] }' column)"
	echo "$w x $h: $up $down $between"
	[ "$between" -lt 40 ]
	within "$(awk -v a="$up" -v b="$down" 'BEGIN { print b - a }')" "$(awk -v h=320 'BEGIN { print 0.6124 * h }')" 8
	refuse() { run -1 --separate-stderr bash -c "sdraw $1 <a"; [[ $stderr == *"$2"* ]]; }
	refuse '--x x --y vy' "no field or number 'vy' (on 'electrons' there is"
	refuse '--y vx --colour nothing' "no field or number 'nothing'"
	pinit langmuir -n 4000 --velocities 3 | sdraw --x vx --y vz -o b.png
	picture b.png
}

@test "no particles, one particle and equal numbers make pictures too" {
	printf 'x y z q\n' | stab - | sdraw -o a.png
	printf 'x y z q\n1 1 1 0\n' | stab - | sdraw --colour q -o b.png
	printf 'x y z q\n1 1 1 5\n1 1 1 5\n' | stab - | sdraw --style density --weight q -o c.png
	printf 'x\n0\n1\n' | stab - | sdraw --style points -o d.png
	for p in a b c d; do picture $p.png; done
}

@test "data that cannot be drawn are refused in one line" {
	pinit plummer -n 20 >a; mesh 2 >m
	for o in '--field nothing' '--set nobody' '--mesh nowhere' '--x q' '--x "sqrt(x)"' '--mesh mesh'; do
		run --separate-stderr bash -c "sdraw $o -o p.png <a"
		[ "$status" != 0 ]
		[ "${#stderr_lines[@]}" = 1 ]
	done
	run -1 bash -c 'sdraw --field w --component 2 -o p.png <m'
	run -1 bash -c 'sdraw --set matter -o p.png <m'
	run -1 bash -c 'sdraw --field w --component x --log --range 1,2 -o p.png <m; sdraw --colour "-1-x^2" --log -o p.png <a'
	for o in '-o p%s.png' '-o %d%d.png' '--range 2,1' '--range 1' '--area 1,2,3' '--component q' '--project --slice 0' '--log --linear' '--size 5' \
		'--map rainbow' '--format gif' '--style art' '--axis w' '--log --range 0,1 --colour x'; do
		run -2 bash -c "sdraw $o <a"
	done
	run -1 bash -c 'sdraw -o /nonexistent/p.png <a'
	run -1 bash -c 'sdraw --format png -o /dev/full <a'
	run -1 bash -c 'sdraw --format ppm <a >/dev/full'
}

@test "the ending of --output says the kind of picture; another ending, none, or one that contradicts --format is refused with the list" {
	pinit plummer -n 20 >a
	sh_ok 'sdraw --size 64 -o p.PNG <a; sdraw --size 64 -o p.ppm <a; sdraw --size 64 --format ppm -o bare <a'
	picture p.PNG
	[ "$(head -c 2 p.ppm)" = P6 ]
	cmp p.ppm bare
	for o in '-o x.jpg' '-o x.d/p' '-o x' '--format png -o x.jpg' '-o x.jpg --format ppm' '--format ppm -o x.png' '--format png -o x.ppm'; do
		run -2 --separate-stderr bash -c "sdraw $o <a"
		[ "${#stderr_lines[@]}" = 1 ]
		[[ $stderr == "sdraw: --output "* && ( $stderr == *"(.png"* || $stderr == *"--format is "* ) ]]
	done
	[ -z "$(ls -d x* 2>/dev/null)" ]
}

need_ffmpeg() { command -v ffmpeg >/dev/null && command -v ffprobe >/dev/null || skip "no ffmpeg here"; }

@test "a movie has a picture per frame with the colours of the PPM, --fps says how fast, and the name is printed at the end" {
	need_ffmpeg
	mesh 2 >m; cat m m m >mmm
	sh_ok 'sdraw --field w --component x --size 200 --fps 12.5 -o run.mp4 <mmm'
	[ "$output" = run.mp4 ]
	[ "$(ls -A)" = "$(printf '%s\n' m mmm run.mp4)" ]
	[ "$(ffprobe -v error -count_frames -select_streams v -show_entries stream=nb_read_frames,r_frame_rate -of csv=p=0 run.mp4)" = 25/2,3 ]
	sdraw --field w --component x --size 200 --format ppm <m >p
	ffmpeg -v error -i run.mp4 -frames:v 1 q.ppm
	[ "$(sed -n 2p p)" = "$(sed -n 2p q.ppm)" ]
	for x in 60 144 230; do # blue, grey, red of the field; 10 of 255: what H.264 at its default quality keeps of a smooth area
		read -r r g b <<<"$(pixel p $x 120)"; read -r R G B <<<"$(pixel q.ppm $x 120)"
		within "$R" "$r" 10; within "$G" "$g" 10; within "$B" "$b" 10
	done
}

@test "a movie that fails is one line with the reason, and leaves no file" {
	pinit plummer -n 20 >a; mesh 2 >m; cat a m >am; head -c -200 a >cut; cat a cut >aacut
	none() { [ ! -e run.mp4 ] && [ "${#stderr_lines[@]}" = 1 ] && [ -z "$(find . -name '.*' -type f)" ]; }
	PATH="$(without ffmpeg; echo "$PATH")" run -1 --separate-stderr bash -c 'sdraw -o run.mp4 <a'
	[[ $stderr == "sdraw: no program ffmpeg"*"apt-get install ffmpeg"* ]]
	none
	need_ffmpeg
	run -1 --separate-stderr bash -c 'sdraw --size 64 -o run.mp4 <am'
	[[ $stderr == "sdraw: frame 2: this picture has "*" a movie has one size"* ]]
	none
	run -1 --separate-stderr bash -c 'sdraw --size 64 -o run.mp4 <aacut'
	none
	mkdir broken; printf '#!/bin/sh\nread -r line\necho "no encoder here" >&2\nexit 1\n' >broken/ffmpeg; chmod +x broken/ffmpeg
	PATH=$PWD/broken:$PATH run -1 --separate-stderr bash -c 'cat a a a | sdraw -o run.mp4'
	[[ $stderr == "sdraw: "*"ffmpeg: no encoder here" ]]
	none
	for o in '-o run%d.mp4' '--format mp4 -o -' '--format mp4'; do run -2 bash -c "sdraw $o <a"; done
	run -1 bash -c 'sdraw -o /nonexistent/run.mp4 <a'
}

@test "nothing is drawn from a truncated stream" {
	pinit plummer -n 100 >a; head -c 3000 a >cut
	run -1 bash -c 'sdraw -o p.png <cut'
	[ ! -e p.png ]
	run -1 bash -c ': | sdraw -o p.png'
}
