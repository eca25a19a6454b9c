# pinit: scenes from the command line. The scenes themselves are tested in tests/unit/scene.c.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

header() { head -c 8192 "$1" | sed -n 2p; }
field() { header "$1" | tr '\0' ' ' | python3 -c "import json,sys; h=json.loads(sys.stdin.read()); print($2)"; }

scenes="cold-collapse cold-sphere exb gyration kepler landau langmuir lattice pair plummer two-body two-stream uniform"

@test "pinit: every scene makes one frame that names the scene and passes the checks of a reader" {
	for s in $scenes; do
		sh_ok "pinit $s > $s; diag < $s > $s.tsv"
		[ "$(wc -l < "$s.tsv")" = 2 ]
		[ "$(field "$s" "h['scene']['name']")" = "$s" ]
	done
}

@test "pinit: the help lists every scene and every parameter with its defaults" {
	run -0 pinit --help
	for s in $scenes; do
		grep -q "^  $s  " <<<"$output"
	done
	grep -q -- '--truncation X .*plummer 10' <<<"$output"
}

@test "pinit: a scene that does not exist is refused with the nearest name, exit 2" {
	run -2 --separate-stderr pinit plumer
	[[ $stderr == *"no scene 'plumer' (did you mean plummer;"* ]]
}

@test "pinit: a parameter that the scene does not have is refused with the nearest it has, exit 2" {
	run -2 --separate-stderr pinit cold-collapse --mass-spread 3
	[[ $stderr == *"the scene cold-collapse has no --mass-spread"* ]]
	run -2 --separate-stderr pinit kepler --eccentricty 0.5
	[[ $stderr == *"eccentricity"* ]]
	run -2 --separate-stderr pinit ionic-chain --spacing 2
	[[ $stderr == *"the scene ionic-chain has no --spacing, nor any parameter of its own (leave it out)"* ]]
}

@test "pinit: values outside a range, a dimension or a count that the scene does not have are refused, exit 2" {
	run -2 --separate-stderr pinit kepler --eccentricity 1.5
	[[ $stderr == *"--eccentricity 1.5 is not in 0..0.999"* ]]
	run -2 --separate-stderr pinit plummer --dim 2
	[[ $stderr == *"does not exist in 2-D (take --dim 3)"* ]]
	run -2 --separate-stderr pinit two-body -n 3
	run -2 --separate-stderr pinit lattice --dim 3 -n 1000001
	[[ $stderr == *"take -n 1000000 or 1030301"* ]]
	run -2 --separate-stderr pinit lattice -n 27 --spacing 1.5
	[[ $stderr == *"do not fill whole cells"* ]]
	for few in 'cylinder --cells 8x6' 'sphere --cells 8x6x6'; do
		run -2 --separate-stderr pinit $few
		[[ $stderr == "pinit: no node of so few cells is far enough from the faces"* ]]
	done
	for scene in taylor-green-2d vortex-tube tanh-layer landau vortex-sheet; do
		run -2 --separate-stderr pinit $scene --box=-30,90
		[[ $stderr == "pinit: the particles of the scene $scene fill its own periodic box (leave out --box)"* ]]
	done
	run -2 --separate-stderr pinit wakefield --box=0,1
	[[ $stderr == "pinit: the fields of the scene wakefield are made for its own box (leave out --box)"* ]]
	for box in 5,9 0.1,0.2; do
		run -2 --separate-stderr pinit vortex-ring --box=$box
		[[ $stderr == "pinit: no node of this box has vortices of the scene (another --box, or more --cells)"* ]]
	done
	run -2 --separate-stderr pinit lamb-oseen --box=-0.4,0.4
	[[ $stderr == "pinit: open faces cut this scene: "*" of its largest vorticity 4 cells inside of them (take a larger --box, or more --cells)"* ]]
	run -0 --separate-stderr pinit vortex-ring --cells 16
	[[ $stderr == "pinit: open faces leave out 0.087 of the vorticity, what is within 4 cells of them (more --cells, or a larger --box)" ]]
	run -0 --separate-stderr pinit --ranks 3 vortex-ring --cells 16
	[[ $stderr == "pinit: open faces leave out 0.087 of the vorticity, "* ]]
	for scene in vortex-ring 'vortex-merger --cells 48' 'uniform -n 9 --faces wall'; do
		run -0 --separate-stderr pinit $scene
		[ -z "$stderr" ]
	done
	run -0 --separate-stderr pinit lattice -n 64 --faces open
	[[ $stderr == "pinit: the particles of the scene lattice repeat in its periodic box: at other faces they have an edge"* ]]
	run -2 --separate-stderr pinit uniform --box 3,1
	[[ $stderr == *"3 is not below 1"* ]]
	run -2 --separate-stderr pinit uniform --faces wall,wall
	[[ $stderr == *"not 2"* ]]
	run -2 --separate-stderr pinit uniform --dim 2 --faces wall,periodic,open,open
	[[ $stderr == *"periodic at both faces or at none"* ]]
}

@test "pinit: mesh, box, step and faces can be typed over the scene's own" {
	sh_ok 'pinit uniform --dim 3 -n 10 --cells 8x6x4 --box -1,3 --dt 0.125 --faces wall --particle-faces reflect > a'
	[ "$(field a "h['meshes'][0]['cells'], h['meshes'][0]['h'], h['box']['lo'], h['box']['hi'], h['dt']")" = \
		"[8, 6, 4] [0.5, 0.6666666666666666, 1.0] [-1.0, -1.0, -1.0] [3.0, 3.0, 3.0] 0.125" ]
	[ "$(field a "h['box']['fields'][2], h['box']['particles'][2]")" = "['wall', 'wall'] ['reflect', 'reflect']" ]
	sh_ok 'pinit uniform --dim 2 -n 10 --box 0,-2,1,2 --faces wall,open,neumann,neumann --particle-faces absorb > b'
	[ "$(field b "h['box']['lo'], h['box']['hi'], h['box']['fields'], h['box']['particles'][0]")" = \
		"[0.0, -2.0] [1.0, 2.0] [['wall', 'open'], ['neumann', 'neumann']] ['absorb', 'absorb']" ]
}

@test "pinit: vortices on nodes are on those of the box that is typed, and uniform particles fill it" {
	while IFS=';' read -r scene box cells; do # cells of 1/8
		pinit $scene --box="$box" --cells "$cells" >a
		scalc 'off = abs(8*x - floor(8*x + 0.5)) + abs(8*y - floor(8*y + 0.5))' <a | sls --data >text
		awk '$1 == "off" { getline; good = $5 < 1e-9 } END { exit !good }' text || { echo "$scene"; cat text; return 1; }
		[ "$(diag --columns particles <a | tail -1)" -gt 99 ]
	done <<-'END'
		lamb-dipole;-4,-3,4,3;64x48
		cylinder --diameter 2;-4,-3,8,5;96x64
		vortex-ring --radius 1.5 --core 0.2;-5,5;80
		sphere --diameter 2;-3,-3,-4,5,3,4;64x48x64
	END
	pinit uniform --dim 2 -n 1000 --box=-1,2,3,4 | diag --columns centre_x,centre_y >centre
	within "$(column centre_x <centre)" 1 0.15 x # sigma of the mean is 4/sqrt(12 n) = 0.037
	within "$(column centre_y <centre)" 3 0.08 y
}

@test "pinit: the parameters, the seed and equal masses are in the header, not in the data" {
	sh_ok 'pinit plummer -n 100 --seed 12345 --truncation 7.25 > a'
	[ "$(field a "h['scene']['parameters']['truncation'], h['seed'], len([f for f in h['fields'] if f['name']=='mass'][0]['uniform'])")" = "7.25 12345 1" ]
}

@test "pinit: no particles at all is legal" {
	for s in plummer uniform lattice cold-collapse cold-sphere; do
		sh_ok "pinit $s -n 0 | diag --columns particles,mass"
		[ "${lines[1]}" = "0	0" ]
	done
}

@test "HC-56: the same seed gives the same bytes with 1, 2 and 16 threads, another seed gives others" {
	for s in plummer uniform cold-sphere; do
		for t in 1 2 16; do
			pinit $s -n 20000 --seed 3 --threads $t > $t
		done
		same_as 1 2
		same_as 1 16
		pinit $s -n 20000 --seed 4 > other
		run -1 cmp -s 1 other
	done
}

@test "pinit: more particles of the same seed begin with the same ones, up to the shift of the centre" {
	pinit uniform -n 5 --dim 1 --seed 9 > a
	pinit uniform -n 9 --dim 1 --seed 9 > b
	python3 - <<'PY'
import struct
def xs(name, n):
    b = open(name, 'rb').read()
    size = int(b[:64].split()[2])
    return struct.unpack('<%dd' % n, b[64 + size:64 + size + 8 * n])
assert xs('a', 5) == xs('b', 9)[:5]
PY
}

@test "pinit: mass-spread draws the masses over so many decades" {
	sh_ok 'pinit uniform -n 20000 --mass-spread 12 --dispersion 1 | diag --columns momentum_x,momentum_y,momentum_z,momentum_scale'
	read -r x y z scale <<<"${lines[1]}"
	for p in $x $y $z; do
		below "$p" "$(awk -v s="$scale" 'BEGIN { print 1e-15 * s }')" # one subtraction of the weighted mean, compensated sums
	done
}

@test "pinit: --loading: a lattice without a word, reversed digits and Sobol's points without the seed, random numbers with it; other scenes refuse it" {
	for scene in landau two-stream langmuir "langmuir --dim 2" cold-collapse; do
		pinit $scene -n 64 > bare
		for how in lattice bit-reversed sobol random; do
			pinit $scene -n 64 --loading $how > $how
			pinit $scene -n 64 --loading $how --seed 2 | smod --seed 1 > other
			stab --plain < $how > a; stab --plain < other > b
			[ "$(cmp -s a b && echo same)" = "$([ $how = random ] || echo same)" ]
			stab --plain < bare > b
			# cold and in one dimension, reversed digits are the lattice
			[ "$(cmp -s a b && echo same)" = "$([ $how = lattice ] && echo same)" ] || [[ $how = bit-reversed && $scene != landau ]]
		done
	done
	refused() { run -2 --separate-stderr pinit "${@:2}"; [[ $stderr == *"$1"* ]] || { echo "$stderr"; return 1; }; }
	refused "the scene plummer has no --loading: its particles are at random" plummer --loading sobol
	refused "the scene two-body has no --loading: its particles are given" two-body --loading random
	refused "did you mean sobol" landau --loading sobl
	refused "--beams is for --loading lattice" landau --loading random --beams 10
	refused "10 particles do not make 20 beams" landau -n 10 --beams 20
	refused "take an even -n" landau -n 11 --loading sobol
}

@test "the default step follows the parameters as the time scale of the scene" {
	step() { pinit "$@" | sls --format json | sed 's/.*"dt":\([^,]*\),.*/\1/'; }
	# what is given | the factor of the default step
	while IFS='|' read -r given factor; do
		read -r -a words <<<"$given"
		within "$(step "${words[@]}")" "$(awk -v a="$(step "${words[0]}")" -v f="$factor" "BEGIN { printf \"%.17g\", a * $factor }")" 1e-12 "$given"
	done <<-'END'
		plummer --softening 0.005 -n 1000|1/4
		plummer --softening 0.05|1
		cold-collapse --density 7.957747154594767|1/10
		lattice --density 100|1/10
		uniform --mass 100|1/10
		uniform --length 4|8
		uniform --dispersion 20|1/20
		pair --m1 10 --m2 2|1/2
		kepler --semi-major 4|8
		two-body --mass 100|1/10
		two-stream --v0 10 --vth 10|1/20
		two-stream --vth 0.1|1
		landau --vth 20|1/10
		landau --wavenumber 20|1/20
		langmuir --wavenumber 20|1
		gyration --magnetic-field 100|1/100
		exb --magnetic-field 100|1/100
		ellipse --peak 100|1/10
		cone-vortex --peak 1000|1/10
		shear-layer --rho 160|1/2
		shear-layer --rho 20|4
		point-vortices --circulation 10|1/10
		polygon --circulation 10|1/10
		vortex-pair --distance 3|9
		taylor-green-2d --speed 10|1/10
		lamb-oseen --start 10|10
		lamb-oseen --nu 1e-4|3.14159265358979324/50
	END
	# 200 steps of an eccentric orbit would not follow its pericentre, nor 20 steps of spreading a mesh of twice the cells
	within "$(step two-body --eccentricity 0.99)" \
		"$(awk 'BEGIN { printf "%.17g", 3.14159265358979324e-2 * sqrt(0.01^3 / 1.99) / sqrt(0.25^3 / 1.75) }')" 1e-12
	for scene in 'lamb-oseen --cells 256' 'shear-layer --nu 0.01 --cells 128' 'ellipse --nu 0.5' 'cone-vortex --nu 1' 'taylor-green-2d --nu 3'; do
		sh_ok "pinit $scene | cycle -n 1 'p2m | poisson-fft | mgrad | diffuse | m2p | push lsrk3' | sls" "$scene"
	done
}
