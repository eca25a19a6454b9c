# remesh: the new particles, conservation, when it acts, refusals.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

@test "a round vortex in open space runs on the defaults of its scene, past the step at which a mesh that does not grow is too small" {
	words='p2m | poisson-fft | mgrad | m2p | push rk2 | remesh'
	run -1 --separate-stderr cycle -t 0.15 "$words --cut-off 0 --rim 0 --outside error" < <(pinit cone-vortex)
	[[ $stderr == 'cycle: step 11: remesh '*'is too near the open face'* ]]
	pinit cone-vortex | cycle -t 0.15 "$words" | p2m | diag --exact >a
	[ "$(column step <a)" = 30 ]
	# enstrophy falls by 0.48 %: the peak of the cone is below the cells
	for q in circulation:1e-4 enstrophy:0.006; do
		exact=$(column "exact_${q%:*}" <a)
		within "$(column "${q%:*}" <a)" "$exact" "$(awk -v e="$exact" -v r="${q#*:}" 'BEGIN { print e * r }')" "$q"
	done
}

@test "what remeshing takes from sum q^2/volume is reported, added over steps, and said once when it reaches 1 per cent" {
	pinit cone-vortex --cells 32 >a
	square() { stab --plain "$1" | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { s += $at["circulation"]^2 / $at["volume"] }
		END { printf "%.17g", s }'; }
	smove --shift 0.03,0 a | remesh --kernel cic >b 2>said
	[ "$(wc -l <said)" = 1 ]
	grep -q 'remeshing by cic has changed .* by -0\.[01][0-9]* of itself; --kernel m6prime, smaller' said
	within "$(of remesh square_lost <b)" "$(calc "1 - $(square b) / $(square a)")" 1e-13
	scalc 'volume = volume*(1 + 0.5*(x > 0))' <a >c # volumes that are not those of the nodes
	remesh -q --kernel cic <c >b
	within "$(of remesh square_lost <b)" "$(calc "1 - $(square b) / $(square c)")" 1e-13
	cycle -n 5 'p2m | poisson-fft | mgrad | m2p | push rk2 | remesh --kernel cic' <a 2>said >b
	[ "$(grep -c square said || true)$(grep -c 'q^2/volume' said)" = 01 ]
	above "$(of 'remesh' square_lost <b)" 0.05
	cycle -n 5 'p2m | poisson-fft | mgrad | m2p | push rk2 | remesh' <a 2>said >b
	run ! grep remeshing said
	between "$(of 'remesh' square_lost <b)" 1e-6 0.01
}

# total COLUMN < plain table: the sum of a column; moments X^a Y^b with total "c*x*x".
total() { awk -v e="$1" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; n = split(e, f, "*"); next } { p = 1; for (k = 1; k <= n; k++) p *= $at[f[k]];
	s += p } END { printf "%.17g", s }'; }
# of WORD KEY: what a word reported.
of() { sls --format json --report |
	python3 -c 'import json, sys
report = json.loads(sys.stdin.readlines()[-1])["report"]
print([v[sys.argv[2]] for k, v in report.items() if k.startswith(sys.argv[1]) and sys.argv[2] in v][0])' "$@"; }

# A patch of circulation off the nodes, well inside the open box -4..4 of 32 x 32 cells of 1/4.
patch() {
	awk 'BEGIN { print "x y circulation volume"; for (i = 0; i < 9; i++) for (j = 0; j < 7; j++) printf "%.17g %.17g %.17g 0.04\n",
		-0.9 + 0.2137 * i + 0.01 * j * j, -0.7 + 0.231 * j, 0.3 + 0.1 * i - 0.05 * j }' |
		stab - --law vortex --box -4,4 -n 32 --dt 0.1 "$@"
}

@test "remesh makes the nodes that receive something the particles, in the order of the mesh, each with the volume of a cell" {
	printf 'x y circulation volume\n0.25 0 2 7\n-1 0 1 7\n' | stab - --law vortex --box -2,2 -n 4 | remesh --kernel cic | stab --plain >a
	[ "$(column circulation <a | tr '\n' ' ')" = "1 1.5 0.5 " ]
	[ "$(column x <a | tr '\n' ' ')" = "-1 0 1 " ]
	[ "$(column volume <a | tr '\n' ' ')" = "1 1 1 " ]
}

@test "remesh of particles that sit on the nodes changes nothing, for every interpolating kernel" {
	patch | remesh | stab --plain >a
	patch | remesh >b
	for kernel in m4prime lambda-2-1 lambda-2-2 m6prime lambda-4-2 lambda-4-4 lambda-6-4 lambda-6-6; do
		remesh --kernel $kernel <b | stab --plain | cmp a -
	done
}

@test "remesh keeps the total to round-off and the moments that the kernel promises" {
	patch | stab --plain >before
	for kernel in ngp:0 cic:1 tsc:1 lambda-2:2 pcs:1 m4prime:2 lambda-2-2:2 m6prime:4 lambda-4-4:4 lambda-6-4:6 lambda-6-6:6 lambda-8-4:8 star:2; do
		patch | remesh --cut-off 0 --kernel ${kernel%:*} | stab --plain >after
		m=circulation
		for power in 0 1 2 3 4 5 6 7 8; do
			[ $power -gt "${kernel#*:}" ] && break
			# 1e-13: sums of some hundred terms of size 1
			within "$(total $m <after)" "$(total $m <before)" 1e-13 "$kernel moment $power"
			m="$m*x"
		done
	done
	# impulse and angular impulse are first and second moments
	patch | remesh --cut-off 0 | stab --plain >after
	within "$(total 'circulation*y' <after)" "$(total 'circulation*y' <before)" 1e-13
	within "$(total 'circulation*y*y' <after)" "$(total 'circulation*y*y' <before)" 1e-13
}

@test "remesh with pcs widens by h^2/3 a remesh along each axis, as its second moment says" {
	patch | stab --plain >before
	patch | remesh --kernel pcs | stab --plain >after
	within "$(total 'circulation*x*x' <after)" "$(awk -v b="$(total 'circulation*x*x' <before)" -v g="$(total circulation <before)" \
		'BEGIN { printf "%.17g", b + g / 48 }')" 1e-13
}

@test "remesh keeps the total at periodic, wall and neumann faces, particles on the faces included" {
	for faces in periodic wall neumann; do
		awk 'BEGIN { print "x y circulation"; for (i = 0; i < 50; i++) printf "%.17g %.17g %.17g\n", (i % 10) / 10 + (i % 3) / 77, i / 50,
			i - 11.5 }' >table
		[ $faces = periodic ] && pf=periodic || pf=reflect
		for kernel in cic m4prime lambda-6-4; do
			stab table --law vortex --box 0,1 -n 11x9 --faces $faces --particle-faces $pf | remesh --kernel $kernel | stab --plain >after
			within "$(total circulation <after)" 650 1e-10 "$kernel at $faces" # |terms| up to 1e3, 1e-13 of them
		done
	done
}

@test "remesh keeps volumes that add up to the box: end nodes of closed faces have half a cell" {
	awk 'BEGIN { print "x y circulation volume"; for (j = 0; j <= 8; j++) for (i = 0; i <= 8; i++) print i / 8, j / 8, 1, 1 }' |
		stab - --law vortex --box 0,1 -n 8 --faces neumann --particle-faces reflect | remesh | stab --plain >a
	within "$(total volume <a)" 1 1e-15
	[ "$(column volume <a | sort -gu | tr '\n' ' ')" = "0.00390625 0.0078125 0.015625 " ]
}

@test "remesh --cut-off leaves small nodes out, counts them and sums what is lost, frame after frame" {
	patch | stab --plain >before
	patch | remesh --cut-off 0.01 >a
	stab --plain <a >after
	lost=$(of remesh lost_circulation <a)
	within "$(awk -v a="$(total circulation <after)" -v l="$lost" 'BEGIN { printf "%.17g", a + l }')" "$(total circulation <before)" 1e-13
	all=$(patch | remesh --cut-off 0 | stab --plain | wc -l)
	[ $(($(wc -l <after) + $(of remesh cut <a))) -eq "$all" ]
	[ "$(of remesh cut <a)" -gt 0 ]
	# smallest kept over largest
	awk 'NR > 1 { c = $1 < 0 ? -$1 : $1; if (c > m) m = c; if (!l || c < l) l = c } END { exit !(l > 0.01 * m) }' <(cut -f 1 after)
	patch | smove --shift 0.1,0.03 | remesh --cut-off 0.01 >once
	smove --shift 0.1,0.03 <once | remesh --cut-off 0.01 >twice
	[ "$(of remesh remeshings <twice)" = 2 ]
	[ "$(of remesh cut <twice)" -gt "$(of remesh cut <once)" ]
}

@test "remesh --rim makes empty nodes within so many cells of a particle particles too, but near an open face none" {
	printf 'x y circulation volume\n0.5 0 2 7\n' | stab - --law vortex --box -4,4 -n 16 >a
	for rim in 0 1 3; do
		remesh --kernel cic --rim $rim <a | stab --plain >b
		side=$((2 * rim + 1))
		[ "$(column circulation <b | wc -l)" = $((side * side)) ]
		[ "$(total circulation <b)" = 2 ]
		[ "$(column volume <b | sort -u)" = 0.25 ]
	done
	# cic may touch nodes 1 to 15; a rim keeps a cell more away: 2 to 14
	remesh --kernel cic --rim 100 <a | stab --plain >b
	[ "$(column x <b | sort -gu | sed -n '1p;$p' | tr '\n' ' ')" = "-3 3 " ]
	sh_ok 'remesh --kernel cic --rim 100 <a | p2m --kernel cic | sls'
	# round a periodic box, and what is kept is not cut
	printf 'x y circulation\n0 0.5 1\n0.01 0.5 1e-9\n' | stab - --law vortex --box 0,1 -n 8 --faces periodic --particle-faces periodic >a
	remesh --kernel cic --cut-off 1e-3 --rim 1 <a >b
	[ "$(stab --plain <b | column x | sort -gu | tr '\n' ' ')" = "0 0.125 0.875 " ]
	sls --format json --report <b | grep -q '"cut":0[,}]'
	for t in 1 3; do patch | OMP_NUM_THREADS=$t remesh --cut-off 0.01 --rim 2 --no-history >c$t; done
	same_as c1 c3
}

@test "remesh carries values by a strength: momentum is kept; alone they are refused, or dropped" {
	pinit uniform -n 60 --dispersion 1 >a
	run -1 bash -o pipefail -c 'remesh <a | sls'
	[[ $output =~ "'v' on 'matter' is a value, which cannot be distributed to nodes (--by mass remeshes mass times v, --drop v removes it)" ]]
	sh_ok 'remesh -n 5 --drop v <a | sls'
	[[ ! $output =~ " v " ]]
	scalc --set matter --role state 'heat = 1 + id/60' <a >b # behind the mass
	stab --plain <b >before
	for cells in 5x6x4 2; do # some nodes are kept, and all
		remesh -n $cells --by mass --kernel tsc <b | stab --plain >after
		for v in vx vy vz heat; do
			within "$(total "mass*$v" <after)" "$(total "mass*$v" <before)" 1e-14
		done
	done
	within "$(total mass <after)" 1 1e-14
	run -1 bash -o pipefail -c 'remesh --by charge <a | sls'
	[[ $output =~ "no strength of that name" ]]
}

@test "remesh drops id, change fields, derived fields and registers, of the mesh too, keeps uniform values, and refuses letters" {
	sh_ok 'pinit plummer -n 50 | p2m --outside grow | poisson-fft | mgrad | m2p --outside drop | remesh --by mass --outside grow | sls'
	[[ ! $output =~ " acc " && ! $output =~ " rho " && ! $output =~ " id " ]]
	printf 'x y circulation name\n0.3 0 2 a\n-1 0 1 b\n' >named
	run -1 bash -o pipefail -c 'stab named --law vortex --box -4,4 | remesh | sls'
	[[ $output =~ "'name' on 'matter' is of type u8, which cannot be distributed to nodes (--drop name removes it)" ]]
	sh_ok 'stab named --law vortex --box -4,4 | remesh --drop name | sls'
	printf 'x y circulation heat\n0.3 0 2 5\n-1 0 1 5\n' | stab - --law vortex --box -4,4 | stab |
		sed '1s/"name":"heat",/&"uniform":[5],/; s/\theat//; s/\t5$//; s/\t5\t/\t/' >text
	sh_ok 'stab - <text | remesh | sls'
	[[ $output =~ heat\ .*uniform\ 5 ]]
}

@test "remesh acts between steps only: inside a step the frame is passed on" {
	patch | p2m | poisson-fft --plan estimate | mgrad | m2p | push rk2 --no-history >half
	remesh --no-history <half | cmp half -
	patch | cycle -n 3 'p2m | poisson-fft --plan estimate | mgrad | m2p | push rk2 | remesh' >a
	[ "$(of remesh remeshings <a)" = 3 ]
}

@test "remesh --every K acts where the frame's step is a multiple of K" {
	patch | cycle -n 7 'p2m | poisson-fft --plan estimate | mgrad | m2p | push rk2 | remesh --every 3' >a
	[ "$(of remesh remeshings <a)" = 2 ]
}

@test "remesh --when distortion acts where the particles are distorted, not where they only move" {
	# a lattice that fills a periodic box, shifted: H is 1 everywhere
	awk 'BEGIN { print "x y circulation volume"; for (i = 0; i < 8; i++) for (j = 0; j < 8; j++) print i / 8 + 0.03, j / 8 + 0.05, i - j, 1 / 64 }' |
		stab - --law vortex --box 0,1 -n 8 --faces periodic --particle-faces periodic >a
	remesh --when distortion --threshold 1e-10 <a >b
	below "$(of remesh distortion <b)" 1e-14
	same_as <(stab --plain <a) <(stab --plain <b)
	# the change of H is relative: from a quarter to 1
	awk 'BEGIN { print "x y circulation volume overlap"; for (i = 0; i < 8; i++) for (j = 0; j < 8; j++) print i / 8 + 0.03, j / 8 + 0.05, i - j, 1 / 64,
		0.25 }' |
		stab - --law vortex --box 0,1 -n 8 --faces periodic --particle-faces periodic | remesh --when distortion --threshold 10 >b
	within "$(of remesh distortion <b)" 3 1e-13
	# stretched along x, squeezed along y
	awk 'BEGIN { print "x y circulation volume"; for (i = 0; i < 4; i++) for (j = 0; j < 16; j++) print i / 4 + 0.03, j / 16 + 0.05, i - j, 1 / 64 }' |
		stab - --law vortex --box 0,1 -n 8 --faces periodic --particle-faces periodic | remesh --when distortion --threshold 0.02 >c
	[ "$(of remesh remeshings <c)" = 1 ]
	sh_ok 'sls <c'
	[[ $output =~ overlap ]]
	# the overlap after it is the new reference, edges of a patch included
	patch | remesh --when distortion >d
	remesh --when distortion --threshold 1e-12 <d >e
	below "$(of 'remesh --when distortion --threshold' distortion <e)" 1e-14
	same_as <(stab --plain <d) <(stab --plain <e)
}

@test "remesh -n gives the mesh other cells; an open one is enlarged; --outside error names a particle outside, drop leaves it out and counts it" {
	sh_ok 'printf "x y circulation\n0.3 0 2\n-1 0 1\n" | stab - --law vortex --box -2,2 -n 4 | remesh -n 16x8 | sls'
	[[ $output =~ "16 x 8 cells" ]]
	printf 'x y circulation\n0.3 0 2\n-3.9 0 1\n' | stab - --law vortex --box -4,4 -n 16 >a
	run -1 bash -o pipefail -c 'remesh --outside error <a | sls'
	[[ $output =~ "particle 1 of 'matter' at (-3.9, 0) is too near the open face x = -4" ]]
	sh_ok 'remesh <a | sls'
	[[ $output =~ "24 x 16 cells" ]]
	remesh --outside drop <a >b
	within "$(stab --plain <b | total circulation)" 2 1e-15
	[ "$(of remesh outside <b)" = 1 ]
	within "$(of remesh outside_circulation <b)" 1 1e-14
}

@test "remesh: no mesh, no strength, no such set, no particles, a threshold without a use" {
	sh_ok 'printf "x y circulation\n" | stab - --law vortex --box -2,2 | remesh | sls'
	[[ $output =~ "0 particles" ]]
	run -1 bash -o pipefail -c 'printf "x y\n0 0\n" | stab - --box -2,2 | remesh | sls'
	[[ $output =~ "no set has positions 'x' and a strength" ]]
	run -1 bash -o pipefail -c 'patch() { printf "x y circulation\n0 0 1\n" | stab - --law vortex; }; patch | remesh --set dust | sls'
	[[ $output =~ "no set 'dust'" ]]
	run -1 bash -o pipefail -c 'patch() { printf "x y circulation\n0 0 1\n" | stab - --law vortex; }; patch | remesh --mesh fine | sls'
	[[ $output =~ "no mesh fine" ]]
	run -2 remesh --threshold 0.1
	run -2 remesh --drop x
	run -2 remesh --rim 1 --by mass
}

@test "a vortex in free space keeps circulation to round-off, and what a cut-off takes is what is missing" {
	patch >a
	total=$(stab --plain <a | total circulation)
	cycle -n 4 'p2m | poisson-fft --plan estimate | mgrad | m2p | push lsrk3 --dt 0.02 | remesh --cut-off 0' <a | stab --plain >after
	within "$(total circulation <after)" "$total" 5e-12 # 1e-13 of the sum of absolute strengths, 43
	# without a cut-off the particles spread by a cell or two a step until they reach the edge
	run -1 bash -o pipefail -c "cycle -n 40 'p2m --outside drop | poisson-fft --plan estimate | mgrad | m2p --outside drop | push lsrk3 --dt 0.02 | "`
		`"remesh --cut-off 0 --outside error' <a | sls"
	[[ $output =~ "too near the open face" ]]
	cycle -n 40 'p2m | poisson-fft --plan estimate | mgrad | m2p | push lsrk3 --dt 0.002 | remesh --cut-off 1e-3' <a >b
	within "$(awk -v a="$(stab --plain <b | total circulation)" -v l="$(of remesh lost_circulation <b)" 'BEGIN { printf "%.17g", a + l }')" "$total" 5e-12
}

# around DIM CELLS FACES: particles at random in a unit box around a ball of radius 0.2.
around() {
	awk -v dim="$1" -v n="$2" 'BEGIN { srand(5); print dim == 3 ? "x y z mass volume" : "x y mass volume"
		for (i = 0; i < n ^ dim; i++) {
			k = i; s = ""; r = 0
			for (d = 0; d < dim; d++) { x = (k % n + rand()) / n; k = int(k / n); s = s sprintf("%.17g ", x); r += (x - 0.5)^2 }
			if (r > 0.04) printf "%s%.17g %.17g\n", s, rand() - 0.3, n ^ -dim } }' |
		stab - --box 0,1 -n "$2" --faces "$3" --particle-faces open
}

inside() { sel --where "$1" | stab --plain | tail -n +2 | wc -l; }

@test "remesh --mask: no particle in a body, and the kernel's moments up to the fourth are exact beside it and beside faces (000:S58, H18)" {
	for row in 'cic 1' 'm4prime 2' 'lambda-2-2 2' 'm6prime 4' 'lambda-6-4 4'; do
		around 2 20 wall >a
		remesh --kernel "${row% *}" --mask '(x-0.5)^2 + (y-0.5)^2 <= 0.04' <a >b
		stab --plain <a >before
		stab --plain <b >after
		[ "$(inside '(x-0.5)^2 + (y-0.5)^2 <= 0.04' <b)" = 0 ]
		for moment in 1 x x*y y*y x*x*y x*x*y*y x*y*y*y; do
			degree=$(tr -dc xy <<<"$moment" | wc -c)
			[ "$degree" -gt "${row#* }" ] && continue
			within "$(total "mass*$moment" <after)" "$(total "mass*$moment" <before)" 3e-13 "$row $moment" # sums of 400 terms of 1, weights up to 8
		done
	done
	around 3 9 neumann >a
	remesh --mask '(x-0.5)^2 + (y-0.5)^2 + (z-0.5)^2 <= 0.04' <a | stab --plain >after
	stab --plain <a >before
	for moment in 1 x y*z z*z; do
		within "$(total "mass*$moment" <after)" "$(total "mass*$moment" <before)" 1e-12 "space $moment"
	done
}

@test "remesh --mask: far from bodies and faces it is the kernel, and what has drifted into a body comes back to its nearest nodes" {
	pinit cone-vortex --cells 32 >a
	remesh --no-history <a | stab --plain >plain
	remesh --no-history --mask 'x > 1e9' <a | stab --plain | same_as - plain
	printf 'x y mass volume\n0.5 0.62 1.5 1\n' | stab - --box 0,1 -n 20 --faces periodic >a
	remesh --mask '(x-0.5)^2 + (y-0.5)^2 < 0.04' <a >b
	within "$(stab --plain <b | total mass)" 1.5 1e-15
	[ "$(inside '(x-0.5)^2 + (y-0.5)^2 < 0.04' <b)" = 0 ]
	run -1 --separate-stderr remesh --mask 'x > 0.9 || 1' <a
	[[ $stderr == *"particle 0 of 'matter' is beyond the mesh, or deeper in a body than 16 cells"* ]]
	run -2 --separate-stderr remesh --mask '1, 0' <a
}

@test "remesh --mask: circulation around a cylinder is kept by 8 steps, and three threads give the same bytes (000:H18)" {
	pinit cone-vortex --cells 32 >a
	s="p2m | poisson-fft | mgrad | m2p | push rk2 | remesh --cut-off 0 --mask '(x-0.6)^2 + (y-0.5)^2 < 0.01'"
	OMP_NUM_THREADS=1 cycle --no-history -n 8 "$s" <a >b
	OMP_NUM_THREADS=3 cycle --no-history -n 8 "$s" <a | cmp b -
	g=$(stab --plain <a | total circulation)
	within "$(stab --plain <b | total circulation)" "$g" 1e-11 # of 26
}
