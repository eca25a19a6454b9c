#!/usr/bin/env bats
# The same bytes for every way of running a sentence: a shell loop, fused, processes on pipes; 1, 2 and 3 threads; even and odd meshes; fresh and
# resumed; words newly shared by ranks with 1, 2, 3, 4 and 7 of them (all other sentences: ranks.bats). SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

steps=4

# loop SENTENCE FIRST < frame: the sentence as processes started anew for every step; FIRST makes the force of the beginning.
loop() {
	cat > now
	if [ -n "$2" ]; then bash -o pipefail -c "cat now | $2 > next" && mv next now || return; fi
	for _ in $(seq "$3"); do bash -o pipefail -c "cat now | $1 > next" && mv next now || return; done
	cat now
}

# quiet SENTENCE: every word with --no-history.
quiet() { [ -z "$1" ] || echo "$1" | sed 's/ *| */ --no-history | /g; s/$/ --no-history/'; }

# all_ways SCENE FORCE SENTENCE PASSES: compares the checksums of every way with the first.
all_ways() {
	local want got ways=0
	$1 --no-history > start
	want=$(OMP_NUM_THREADS=1 loop "$(quiet "$3")" "$(quiet "$2")" $((steps * $4)) < start | cksum)
	loop true "" 0 < start | cksum | grep -qvF "$want" # something was computed
	[ "${want##* }" -gt 1000 ]
	for threads in 1 2 3; do
		for engine in fused pipes; do
			got=$(OMP_NUM_THREADS=$threads cycle --no-history --store all -n $steps --engine $engine "$3" < start | cksum)
			[ "$got" = "$want" ] || { echo "$engine, $threads threads: $got, the shell loop: $want"; return 1; }
			OMP_NUM_THREADS=$threads cycle --no-history -n 2 --checkpoint half --engine $engine "$3" < start > /dev/null
			got=$(OMP_NUM_THREADS=$threads cycle --no-history --store all -n $steps --resume half --engine $engine "$3" | cksum)
			[ "$got" = "$want" ] || { echo "resumed, $engine, $threads threads: $got, want $want"; return 1; }
			ways=$((ways + 2))
		done
	done
	[ $ways -eq 12 ]
	# rehearsed: all numbers of ranks and threads in check-long
	for n in $([ -z "${PM_LONG:-}" ] && echo 3 || echo 1 2 3 4 7); do
		for threads in $([ -z "${PM_LONG:-}" ] && echo 2 || echo 1 2); do
			got=$(OMP_NUM_THREADS=$threads PM_REHEARSE=one-thread timeout -k 1 60 \
				cycle --ranks "$n" --no-history --store all -n $steps "$3" < start | cksum)
			[ "$got" = "$want" ] || { echo "$n ranks, $threads threads: $got, want $want"; return 1; }
		done
	done
}

force() { echo "p2m -n $1 | poisson-fft | mgrad | m2p"; }

@test "equal bytes: gravity in open space, leapfrog, an even mesh" {
	all_ways "pinit plummer -n 500" "$(force 24)" "push kick/2 drift | $(force 24) | push kick/2" 1
}

@test "equal bytes: gravity in open space, leapfrog, an odd mesh with three different sides" {
	all_ways "pinit plummer -n 500" "$(force 27x25x31)" "push kick/2 drift | $(force 27x25x31) | push kick/2" 1
}

@test "equal bytes: gravity in a periodic box, four passes a step (rk4), an odd mesh" {
	all_ways "pinit uniform -n 500" "" "$(force 15) | push rk4" 4
}

@test "equal bytes: gravity by multigrid in a periodic box, lsrk3" {
	all_ways "pinit uniform -n 300" "" "p2m -n 12x16x20 | poisson-mg | mgrad | m2p | push lsrk3" 3
}

@test "equal bytes: gravity on interlaced meshes by relaxation in a periodic box, lsrk3" {
	all_ways "pinit uniform -n 300" "" "p2m -n 9x12x10 --interlace | poisson-relax --method red-black-sor --tolerance 1e-6 | mgrad | m2p | push lsrk3" 3
}

@test "equal bytes: the influence function of least error, leapfrog" {
	f='p2m -n 12 --kernel tsc | poisson-fft --influence optimal --cloud 0.2 | mgrad | m2p'
	all_ways "pinit uniform -n 300" "$f" "push kick/2 drift | $f | push kick/2" 1
}

# masses on some of the nodes of a periodic mesh of 12 cells a side, at rest
masses() {
	awk 'BEGIN { h = (1.9 + 0.3) / 12; print "x y z mass vx vy vz"
		for (k = 0; k < 12; k++) for (j = 0; j < 12; j++) for (i = 0; i < 12; i++) if ((i * j + 3 * k) % 7 < 5)
			printf "%.17g %.17g %.17g %.17g 0 0 0\n", -0.3 + i * h, -0.3 + j * h, -0.3 + k * h, 1 + 0.1 * (k % 3) }' |
		stab - --law gravity --box -0.3,1.9 --faces periodic -n 12 --dt 0.02 "$@"
}

@test "equal bytes: masses that begin on the nodes of a mesh, whose field is copied" {
	f='p2m --kernel m4prime | poisson-fft | mgrad | m2p'
	all_ways masses "$f" "push kick/2 drift | $f | push kick/2" 1
	all_ways masses "" "$f | push kick drift | remesh --by mass" 1
	all_ways masses "" "${f/mgrad/mgrad --order spectral} | push kick drift | remesh --by mass" 1
	all_ways masses "" "${f/ |/ | p2m --kernel m4prime --add |} | push rk2" 2 # where something is added the order is left, as by sums
}

single() { pinit "$@" | smod --no-history --store f32; } # fields that are held as floats between the words

@test "equal bytes: single precision, leapfrog in a periodic box" {
	all_ways "single uniform -n 5000 --dispersion 1" "$(force 15)" "push kick/2 drift | $(force 15) | push kick/2" 1
}

@test "equal bytes: single precision with light, particles near and far from the order of tiles" {
	local step="push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2"
	all_ways "single em-wave --dim 3 --cells 12 -n 5832" "m2p" "$step" 1
	electrons() { pinit em-wave --dim 3 --cells 40x8x8 | smod --constant background=1 --rename electrons=none | species electrons -n 3000 --vth 0.15 |
		smod --no-history --store f32; }
	all_ways "electrons" "m2p" "$step" 1
}

# In one process rates and half kicks are left to be made, and made for a few particles at a time with their current; step by step they are made at once.
# Particles in the order of tiles, and nearly so; charge and mass of two species; a word that looks at velocities first.
@test "equal bytes: a step with light in one pass over the particles, in 1-D to 3-D, by every relativistic kick" {
	for c in "1 3000 60 cic boris" "2 4096 16 tsc vay" "3 9261 9 cic higuera-cary" "3 8000 8 tsc boris" \
		"1 3000 60 tsc boris --energy-conserving" "2 4096 16 pcs boris --energy-conserving" "3 9261 9 cic boris --energy-conserving"; do
		set -- $c
		local step="push $5/2 | p2m --current --kernel $4 | maxwell | push drift | m2p ${6:-} | push $5/2"
		pinit em-wave --dim "$1" -n "$2" --cells "$3" | smod --constant background=0 |
			species ions -n 700 --charge 1 --mass 3 --vth 0.1 --velocities 3 |
			scalc --set electrons --role state 'v = 0.3*sin(7*x), 0.2*cos(9*x), 0.1' | ssort --no-history > start
		cycle --no-history -n 4 "$step" < start > want
		cycle --no-history -n 1 "$step" < start | cycle --no-history -n 1 "$step" | cycle --no-history -n 2 "$step" | cmp - want
		cycle --no-history --engine pipes -n 4 "$step" < start | cmp - want
		OMP_NUM_THREADS=3 cycle --no-history -n 4 "$step | diag --tee table --species --no-history" < start | cmp - want
		cmp -s start want && return 1
		# what is left to be made when particles are put into another order stays so, and an order far from that of tiles has it made
		for sort in "ssort --every 2" "ssort --by id --every 2" "ssort --by 'v_x'"; do
			cycle --no-history --engine pipes -n 4 "$step | $sort" <start >want
			OMP_NUM_THREADS=2 cycle --no-history -n 4 "$step | $sort" <start | cmp - want
		done
	done
	# E and B in single precision; a density between, whose order has another width
	pinit em-wave --dim 2 -n 4096 --cells 16 | smod --constant background=0 | ssort --no-history >start
	step='push boris/2 | p2m --current --kernel tsc | maxwell | push drift | m2p --kernel cic | push boris/2 | p2m --kernel tsc'
	cycle --no-history --engine pipes -n 3 "$step" <start >want
	cycle --no-history -n 3 "$step" <start | cmp - want
	smod --no-history --store E=f32,B=f32 <start >single
	step='push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2'
	cycle --no-history --engine pipes -n 3 "$step" <single >want
	cycle --no-history -n 3 "$step" <single | cmp - want
	# E and B on the nodes
	sel --drop E -i start | sel --drop B | p2m | maxwell --gauss --method psatd --nodal | sel --drop rho --no-history >nodal
	step='push boris/2 | p2m --current | maxwell --method psatd | push drift | m2p | push boris/2'
	cycle --no-history --engine pipes -n 3 "$step" <nodal >want
	cycle --no-history -n 3 "$step" <nodal | cmp - want
	[ "$(wc -c <want)" -gt 100000 ]
}

# five_steps SENTENCE: from the file start, in one process and on pipes, in one run and in three with three, one and two threads; leaves `want`.
five_steps() {
	cycle --no-history --engine pipes -n 5 "$1" <start >want
	cycle --no-history -n 5 "$1" <start | cmp - want
	OMP_NUM_THREADS=3 cycle --no-history -n 2 "$1" <start | OMP_NUM_THREADS=1 cycle --no-history -n 1 "$1" | cycle --no-history -n 2 "$1" | cmp - want
	! cmp -s start want
}

# The same of forces of a potential: the kick that closes a step is left, and the push that opens the next one makes it, with the rates that m2p leaves.
# Particles in order without and with places, with weights and without, on one tile and several; velocities across; what looks at rates, or changes them.
@test "equal bytes: a step by a potential in one pass over the particles, in 1-D to 3-D" {
	local leapfrog='push kick/2 drift | p2m KERNEL | poisson-fft | mgrad ORDER | m2p | push kick/2' look='diag --tee table --no-history'
	local euler='p2m KERNEL | poisson-fft | mgrad ORDER | m2p | push kick drift' c step
	local halves=${euler/kick drift/kick/2 kick/2 drift/2 drift/2}
	local open='push kick/2 drift | p2m KERNEL | poisson-fft | mgrad ORDER | m2p'
	for c in "landau --dim 1 -n 4000 --cells 64;cic;2;1" "landau --dim 1 -n 4000 --cells 64 --velocities 3;tsc;2;" \
		"langmuir -n 20000 --cells 5000;cic;2;1" "langmuir --dim 1 -n 4001 --cells 60;tsc;2;1" \
		"uniform --dim 2 -n 30000 --cells 70 --dispersion 1;m4prime;4;1, x" "uniform -n 60000 --cells 40x17x10 --dispersion 1;cic;4;1, x, y" \
		"uniform -n 60000 --cells 40x17x10 --dispersion 1;tsc;spectral;1, x, y"; do
		IFS=';' read -r scene kernel order more <<<"$c"
		# shellcheck disable=SC2086 # words
		pinit $scene --dt 1e-3 | ssort --no-history >start
		for step in "$leapfrog" "$euler" "$halves" "$leapfrog | $look" "$open ${more:+| field 'acc = $more'} | push kick/2" \
			"$open | push kick/2 | p2m --kernel pcs | m2p --kernel pcs --replace"; do
			step=${step//KERNEL/--kernel $kernel} step=${step//ORDER/--order $order}
			five_steps "$step"
		done
	done
	[ "$(wc -c <want)" -gt 100000 ]
}

# Particles of a gas that have left the order of tiles by 0.4 cells: gathered where they stand (gather-in-place.c), but for a few; by 2 cells: by tiles. Axes
# of one tile, of tiles with one cell, and of several; the charge over the mass one number for all, or not.
@test "equal bytes: a step by a potential of particles that are nearly in the order of tiles" {
	local step='push kick/2 drift | p2m | poisson-fft | mgrad --order ORDER | m2p | push kick/2' c cells order moved threads
	for c in '33x17x9 2' '64x16x8 4' '40x33x20 6'; do
		read -r cells order <<<"$c"
		for moved in 0.4 2; do
			pinit uniform -n 60000 --cells "$cells" --dispersion 1 --dt 1e-4 | ssort --no-history |
				scalc --set matter --role state "x = x + $moved/40*vx, y + $moved/20*vy, z + $moved/14*vz" |
				smove --no-history --shift 0,0,0 >start
			cycle --no-history --engine pipes -n 2 "${step/ORDER/$order}" <start >want
			for threads in 1 3; do
				OMP_NUM_THREADS=$threads cycle --no-history -n 2 "${step/ORDER/$order}" <start | cmp - want
			done
		done
	done
	pinit plasma --dim 3 --cells 64x32x16 --dt 1e-3 --background 0 | species electrons -n 40000 --no-history | ssort --no-history |
		scalc --set electrons --role state 'x = x + 0.1*vx, y + 0.1*vy, z + 0.2*vz' >one
	scalc --set electrons --role state --extensive 'charge = charge*(1 - 3*(id < 20000))' 'mass = mass*(1 + id/50000)' <one >several
	for c in one several; do
		cycle --no-history --engine pipes -n 2 "${step/ORDER/2}" <$c >want
		cycle --no-history -n 2 "${step/ORDER/2}" <$c | cmp - want
	done
}

@test "equal bytes: a step by a potential of particles in any order, in 2-D and 3-D" {
	local step='push kick/2 drift | p2m KERNEL | poisson-fft | mgrad | m2p | push kick/2' kernel threads
	pinit uniform -n 40000 --cells 70x36x20 --dispersion 1 --dt 1e-3 >space
	pinit uniform --dim 2 -n 40000 --cells 300x170 --dispersion 1 --dt 1e-3 >plane
	pinit plasma --dim 3 --cells 64x32x16 --dt 1e-3 --background 0 | species electrons -n 40000 --no-history >one
	scalc --set electrons --role state --extensive 'charge = charge*(1 - 3*(id < 20000))' 'mass = mass*(1 + id/50000)' <one >several
	for c in space plane one several; do
		for kernel in '--kernel cic' '--kernel pcs'; do
			cycle --no-history --engine pipes -n 3 "${step/KERNEL/$kernel}" <$c >want
			for threads in 1 3; do
				OMP_NUM_THREADS=$threads cycle --no-history -n 3 "${step/KERNEL/$kernel}" <$c | cmp - want
			done
		done
	done
	# accelerations that are asked for before the push, a second gather at these positions, and B beside E
	for c in space several; do
		same "${step/KERNEL/} | dt --oscillation 0.1" 2 <$c
		same "${step/KERNEL | poisson-fft | mgrad | m2p/| poisson-fft | mgrad | m2p | p2m --kernel pcs | poisson-fft | mgrad | m2p --replace}" 2 <$c
	done
	step=${step/KERNEL/}
	scalc --no-history --mesh mesh --role state 'B = 0.1, 0.3*sin(x), 1' <several | same "${step//kick/boris}" 2
}

@test "equal bytes: a stream in the order of tiles, and one that only seems to be, read once or twice" {
	local at threads
	pinit uniform -n 300000 --cells 40x64x24 | ssort --no-history >order
	# one particle elsewhere, which the places that are looked at do not show; the second set is added to the first
	for at in 50001 149998 299999; do
		scalc --no-history --set matter --role state "x = x + 0.45*(id == $at && $at < 9e4), y + 0.5*(id == $at && $at > 9e4 && $at < 2e5), \
			z + 0.5*(id == $at && $at > 2e5)" <order | smove --no-history --shift 0,0,0 >stray$at
	done
	# one in a tile further up each axis, and one of a tile that ends with the box in front of its end, beyond that
	set -- "$(stab --plain <order | awk '$2 < 0.2 && $3 < 0.2 && $4 < 0.2 && NR > 5000 { print $8; exit }')" \
		"$(stab --plain <order | awk '$2 > 0.85 && $2 < 0.95 && NR > 5000 { print $8; exit }')"
	scalc --no-history --set matter --role state "x = x + 0.7*(id == $1), y, z" <order >up0
	scalc --no-history --set matter --role state "x = x, y + 0.3*(id == $1), z" <order >up1
	scalc --no-history --set matter --role state "x = x, y, z + 0.4*(id == $1)" <order >up2
	scalc --no-history --set matter --role state "x = x + 0.2*(id == $2), y, z" <order >beyond
	smod --no-history --rename matter=other <stray299999 >other
	# some of a tile that has few
	pinit uniform -n 202752 --cells 33x64x24 | ssort --no-history >few
	scalc --no-history --set matter --role state 'x = x - 0.2*(x > 32/33 && y > 0.4 && y < 0.41 && z > 0.45 && z < 0.48), y, z' <few >strayfew
	stack --no-history stray149998 other >both
	cycle --no-history --engine pipes -n 2 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' <stray149998 >want
	OMP_NUM_THREADS=3 cycle --no-history -n 2 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' <stray149998 | cmp - want
	pinit uniform -n 300000 --cells 44x64x24 --faces open --particle-faces open |
		scalc --no-history --set matter --role state 'x = 0.05 + 0.9*x, 0.05 + 0.9*y, 0.05 + 0.9*z' | ssort --no-history |
		scalc --no-history --set matter --role state 'x = x + (id == 50001), y, z' >left
	for at in order stray50001 stray149998 stray299999 both few strayfew left up0 up1 up2 beyond; do
		p2m --no-history --kernel cic --add <$at >want # counts first: what it is added to cannot be cleared
		for threads in 1 2 3; do
			OMP_NUM_THREADS=$threads p2m --no-history --kernel cic <$at >have
			[ $at == left ] && grep -aq '"outside":1.0' have || cmp have want
			cmp -n $(($(stat -c %s want) - 400)) have want # the report has the word's options
		done
	done
}

# instead OLD EXPRESSIONS SET: a frame whose field OLD has the values of EXPRESSIONS, as many components as there are.
instead() { scalc --no-history --set "$3" --role state "w_new = $2" | sel --no-history --drop "$1" | smod --no-history --rename "w_new=$1"; }

# same SENTENCE N < FRAME: in one process and on pipes.
same() {
	cat >begin
	cycle --no-history --engine pipes -n "$2" "$1" <begin >want
	cycle --no-history -n "$2" "$1" <begin | cmp - want
}

@test "equal bytes: one pass over particles of other shapes and strengths" {
	local step='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'
	local light='push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2'
	# velocities of four components; positions of more than the box has axes
	pinit landau --dim 1 -n 2000 --cells 64 --dt 1e-2 | ssort --no-history |
		instead v '0.3*sin(7*x), 0.2, 0.1*x, 0.2*x' electrons | same "$step" 3
	pinit uniform --dim 2 -n 3000 --cells 16 --dispersion 1 | ssort --no-history |
		instead x 'x, y, x+y' matter | instead v '0.3, 0.2, 0.1' matter | same "$step" 3
	# one velocity for all, kicked first
	pinit uniform --dim 1 -n 2000 --cells 64 --dt 1e-3 | sel --no-history --drop v | smod --no-history --rename mass=v |
		scalc --no-history --set matter --role state --extensive 'mass = 0.0005 + 0*x' |
		same 'p2m | poisson-fft | mgrad | m2p | push kick | push drift' 3
	# charges and masses that differ, with one quotient
	pinit em-wave --dim 2 -n 4096 --cells 16 | smod --constant background=0 | ssort --no-history |
		scalc --no-history --set electrons --role state --extensive 'charge = -1e-3*(1+(x>0.3))' |
		scalc --no-history --set electrons --role state --extensive 'mass = 1e-3*(1+(x>0.3))' >weights
	cycle --no-history --store all --engine pipes -n 3 "$light" <weights >want
	cycle --no-history --store all -n 3 "$light" <weights | cmp - want
	# a velocity that overflows is told where it is made
	pinit landau --dim 1 -n 1000 --cells 16 --dt 1e-2 | ssort --no-history |
		scalc --no-history --set electrons --role state --extensive 'charge = -1e44+0*x' |
		smod --no-history --constant background=0 --dt 1e230 >begin
	run -3 --separate-stderr cycle -n 1 'p2m | poisson-fft | mgrad | m2p | push kick --unsafe | push drift --unsafe' <begin
	[[ $stderr == *"push kick"*"'v' of 'electrons' is not finite"* ]]
}

# An orbit that a step resolves, or not: told of the rates themselves, not of the largest field on the mesh, which is all that is known of rates that are left.
@test "a step of rates that are left is refused where it is refused word by word" {
	local step='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' dt
	pinit uniform -n 20000 --cells 12 | scalc --set matter --role state 'mass = 1e-7 + (id == 5)' | ssort --no-history >start
	for dt in 0.05 0.062 0.064 0.072 0.1; do # the orbit ends at 0.064 to 0.07, that of the largest field at 0.0607
		smod --no-history --dt $dt -i start >begins
		if cycle --no-history --engine pipes -n 4 "$step" <begins >piped 2>said; then
			cycle --no-history -n 4 "$step" <begins | cmp - piped
			echo $dt >>allowed
		else
			grep -o 'dt .* without bound' said >>refused
			cycle --no-history -n 4 "$step" <begins 2>&1 >fused | grep -o 'dt .* without bound' >>refused_fused
		fi
	done
	cmp refused refused_fused
	[ "$(wc -l <refused)" -gt 1 ] && [ "$(wc -l <allowed)" -gt 1 ]
}

@test "equal bytes: direct sum, leapfrog" {
	all_ways "pinit plummer -n 300" "pp" "push kick/2 drift | pp | push kick/2" 1
}

@test "equal bytes: drifting freely in a periodic box" {
	all_ways "pinit uniform -n 1001 --dispersion 0.3" "" "push drift" 1
}

# vortices FACES: two blobs of circulation on a lattice of 20 x 22.
vortices() {
	awk 'BEGIN { h = 0.1; print "x y circulation volume"; for (j = 0; j < 22; j++) for (i = 0; i < 20; i++) { x = -1 + i * h; y = -1.1 + j * h
		w = exp(-((x - 0.2)^2 + y * y) / 0.08) - 0.5 * exp(-((x + 0.4)^2 + (y - 0.1)^2) / 0.05)
		print x, y, w * h * h, h * h } }' |
			stab - --law vortex --constant nu=1e-3 --dt 0.1 --box -1,-1.1,1,1.1 -n 20x22 --faces periodic --particle-faces periodic "$@"
}

@test "equal bytes: viscous vortices, three passes a step (lsrk3), remeshed after every step" {
	all_ways vortices "" "p2m --kernel m6prime | poisson-fft | mgrad | diffuse | m2p | push lsrk3 | remesh --kernel m6prime --cut-off 1e-6" 3
}

vortex() { printf 'x y circulation\n0.9998 0.4 1\n' | stab - --law vortex --box 0,1 --faces periodic -n 37 --dt 1e-4; } # most strain at the end of a row

@test "equal bytes: a flow in the plane that is left to be made, on all nodes and beside them" {
	f='p2m --kernel m6prime | poisson-fft | mgrad | m2p'
	all_ways "pinit taylor-green-2d --cells 37 --dt 0.1" "" "$f | push rk2 | remesh" 2
	all_ways "pinit taylor-green-2d --cells 140 --dt 0.02" "" "${f/mgrad/mgrad --order 2} | push rk2 | remesh --cut-off 0.1" 2
	all_ways "pinit taylor-green-2d --cells 37 --dt 0.1" "$f" "push euler | remesh | $f" 1 # its strain stays with the rate
	all_ways vortex "$f" "push euler | $f" 1
	all_ways "pinit uniform --dim 2 -n 3000 --cells 41" "" "${f/m6prime/tsc} | push kick drift" 1
}

# vortices at any places, in no order
anywhere() {
	awk 'BEGIN { srand(4); print "x y circulation volume"; for (i = 0; i < 9000; i++) print rand(), rand(), rand() - 0.5, 1/9000 }' |
		stab - --no-history --law vortex --box 0,1 --faces periodic -n 70x90 --dt 0.2
}

@test "equal bytes: a flow in one pass over the particles, by schemes with and without registers, in the plane and in space" {
	local f='p2m --kernel m6prime | poisson-fft | mgrad | m2p' scene step
	for scene in "pinit --no-history taylor-green-2d --cells 600x20 --dt 0.05" "pinit --no-history taylor-green-2d --cells 140 --dt 0.2" anywhere \
		"pinit --no-history taylor-green-3d --cells 16 --dt 0.2"; do
		$scene >start
		for step in "$f | push rk2 | remesh" "$f | push midpoint" "$f | push lsrk3" "${f/m6prime/cic} | push rk4 | remesh --cut-off 0.1" \
			"$f | push rk4" "$f | push ab2" "$f | push ab3" "${f/mgrad/mgrad --order spectral} | push euler" "$f | push drift" \
			"$f | push drift/2 drift/2 | remesh" "$f | diag --tee table --no-history | push drift"; do
			five_steps "$step"
		done
	done
	[ "$(wc -c <want)" -gt 100000 ]
}

@test "equal bytes: nodes of a box so far from 0 that neighbours are rounded to one place" {
	all_ways "pinit uniform --dim 2 --cells 8x40 -n 3000 --box 0,-5.7e13,1,-56999999999999.8" "" \
		'remesh --by mass | p2m --kernel m4prime | poisson-fft | mgrad | m2p | push kick drift --unsafe' 1
}

@test "equal bytes: two gathers at the same positions, which are in order on some ranks alone" {
	all_ways "pinit uniform --cells 11x14x20 -n 3080" "" 'p2m --kernel tsc | poisson-fft | mgrad | m2p | m2p --field g | push kick drift' 1
}

@test "equal bytes: vortices remeshed onto an odd mesh when they are distorted" {
	all_ways vortices "" "p2m -n 21x23 | poisson-fft | mgrad | diffuse --order 2 | m2p | push rk2 | remesh --when distortion --threshold 1e-3" 2
}

@test "equal bytes: point vortices by direct sum, four passes a step (rk4)" {
	all_ways "pinit polygon -n 7 --disturbance 1e-3" "" "pp | push rk4" 4
}

@test "equal bytes: a cluster in a given tide that turns, leapfrog" {
	f="pp | field 'acc = 0.1*cos(time)*x, -0.1*cos(time)*y, -0.2*z'"
	all_ways "pinit plummer -n 300" "$f" "push kick/2 drift | $f | push kick/2" 1
}

@test "equal bytes: point vortices that fade in a given flow, four passes a step (rk4)" {
	all_ways "pinit polygon -n 7 --disturbance 1e-3" "" "pp | field 'vel = -y, x + sin(time)' 'dcirculation = -0.1*circulation' | push rk4" 4
}

@test "equal bytes: vortices that exchange their strength (pse), two passes a step (rk2), remeshed" {
	all_ways vortices "" "p2m | poisson-fft | mgrad | m2p | pse --order 4 | push rk2 | remesh --cut-off 1e-6" 2
	all_ways vortices "" "p2m | poisson-fft | mgrad | m2p | pse --nu 'nu*(2 + y)' | push rk2 | remesh --cut-off 1e-6" 2
	all_ways vortices "" "p2m | poisson-fft | mgrad | diffuse --nu 'nu*(1 + x^2)' | m2p | push rk2 | remesh --cut-off 1e-6" 2
}

@test "equal bytes: vortices that walk at random after the last pass of a step (rk2)" {
	all_ways "vortices --number" "" "p2m | poisson-fft | mgrad | m2p | push rk2 | walk --nu 0.01" 2
}

@test "equal bytes: vortices whose step follows their strain" {
	all_ways vortices "" "p2m | poisson-fft | mgrad | dt --lcfl 0.2 | diffuse | m2p | push lsrk3 | remesh --cut-off 1e-6" 3
}

@test "equal bytes: a scheme with a memory (ab3), over its start" {
	pinit plummer -n 200 --no-history > start
	for engine in fused pipes; do
		for threads in 1 3; do
			OMP_NUM_THREADS=$threads cycle --no-history -n 5 --engine $engine 'pp | push ab3' < start | cksum
			OMP_NUM_THREADS=$threads cycle --no-history -n 3 --checkpoint c --engine $engine 'pp | push ab3' < start > /dev/null
			OMP_NUM_THREADS=$threads cycle --no-history -n 5 --resume c --engine $engine 'pp | push ab3' | cksum
		done
	done | sort -u > sums
	[ "$(wc -l < sums)" -eq 1 ]
}

@test "resume refuses FFTW plans other than the checkpoint's, except with --other-plans" {
	s='p2m -n 257x8 | poisson-fft | mgrad | m2p | push rk2' # 257: FFTW plans it, smaller factors need no plan
	pinit uniform -n 50 --dim 2 | cycle -n 2 --checkpoint c "$s" > b
	cycle -n 4 --resume c "$s" > f
	sed 's/"plan":"fftw ......../"plan":"fftw 0badf00d/' c > other
	run ! cmp -s c other
	export PM_UNSEALED=1 # the tail was edited
	run -1 bash -c "cycle -n 4 --resume other '$s' > d"
	[[ $output == *"uses the FFTW plans 'fftw "*"', but the checkpoint was made with 'fftw 0badf00d'"*"--other-plans continues"* ]]
	[ "$(head -c 64 d | cut -c1-16)" = "PMPIPE/1 abort 1" ]
	cycle -n 4 --resume other --other-plans "$s" > e
	same_as <(stab < e | sed 1d) <(stab < f | sed 1d)
}

@test "equal bytes: a plasma, leapfrog, an odd mesh" {
	all_ways "pinit two-stream -n 2000 --vth 0.1 --amplitude 0.1" "p2m -n 33 | poisson-fft | mgrad | m2p" \
		"push kick/2 drift | p2m -n 33 | poisson-fft | mgrad | m2p | push kick/2" 1
}

@test "equal bytes: electrons in given fields, boris" {
	all_ways "pinit exb -n 7 --speed 1" "m2p" "push boris/2 drift | m2p | push boris/2" 1
}

@test "equal bytes: a plasma, four passes a step (rk4), an odd mesh, smooth kernel, differences of order 4" {
	all_ways "pinit two-stream -n 1000 --vth 0.1 --amplitude 0.1" "" "p2m -n 35 --kernel tsc | poisson-fft | mgrad --order 4 | m2p | push rk4" 4
}

@test "equal bytes: a plasma in two dimensions by multigrid, three passes a step (lsrk3)" {
	all_ways "pinit langmuir --dim 2 --axes 2 -n 961 --amplitude 0.3" "" "p2m -n 16x24 | poisson-mg | mgrad | m2p | push lsrk3" 3
}

# magnetised: electrons that circle in a uniform field and repel each other, three velocities.
magnetised() { pinit gyration -n 60 --velocities 3 --speed 2 --no-history | sel --drop E "$@"; }

@test "equal bytes: magnetised electrons in the field of each other, boris, an odd mesh with two different sides" {
	local force="p2m -n 15x17 | poisson-fft | mgrad | m2p"
	all_ways magnetised "$force" "push boris/2 drift | $force | push boris/2" 1
}

@test "equal bytes: electrons and heavy ions, leapfrog" {
	two() { stack "$@" electrons ions; }
	pinit two-stream -n 500 --vth 0.1 --amplitude 0.1 --no-history | smod --constant background=0 --no-history > electrons
	pinit landau -n 300 --wavenumber 1 --vth 0.01 --no-history | smove --scale charge=-1,mass=25 --no-history |
		smod --rename electrons=ions --constant background=0 --no-history |
		sel --drop mesh --no-history > ions
	all_ways two "$(force 33)" "push kick/2 drift | $(force 33) | push kick/2" 1
}

@test "equal bytes: a diode: electrons come in at a face, leave at another, and a circuit holds the voltage" {
	diode() { pinit plasma --background 0 --no-history | smod --faces neumann,wall --particle-faces absorb --constant charge_x_low=0 --no-history |
		species electrons -n 0 "$@"; }
	force="circuit --voltage=-5 -R 10 | p2m -n 33 | poisson-fft --x-low charge_x_low/eps0 | mgrad | m2p"
	all_ways diode "$force" "push kick/2 drift | inject electrons --density 0.1 -n 50 | $force | push kick/2" 1
}

@test "equal bytes: charges and their field in one step (ecsim)" {
	streams() { pinit two-stream -n 1000 --cells 33 --dt 1 --no-history | ecsim --gauss "$@"; }
	all_ways streams "" "push drift/2 | ecsim | push kick drift/2" 1
}

@test "equal bytes: electrons that meet a gas" {
	beam() { pinit plasma --no-history | species electrons -n 1001 --velocities 3 --drift 2 --vth 0.1 "$@"; }
	all_ways beam "" "push drift | neutrals --density 0.1 'elastic: 1/g'" 1
}

@test "equal bytes: atoms that a field takes the electrons of" {
	atoms() { pinit plasma --length 1 --cells 5 --background 0 --dt 4 --no-history | scalc --mesh mesh --role state 'E = 0.08' --no-history |
		species argon -n 1001 --charge 0 --mass 72820 --vth 0.1 --no-history | species electrons -n 0 "$@"; }
	all_ways atoms "" "push drift | ionise argon --element Ar --mass 72820 --time-unit 2.4188843265864e-17 --length-unit 5.29177210544e-11" 1
}

@test "equal bytes: light from an antenna on particles" {
	light() { pinit em-wave --cells 33 --no-history | sel --drop E,B --no-history | smod --faces open --constant background=0 --no-history |
		p2m --no-history | maxwell --gauss "$@"; }
	all_ways light m2p "push boris/2 | p2m --current | antenna 'Ey = sin(8*time)*exp(-(time-1.5)^2)' | maxwell | push drift | m2p | push boris/2" 1
}

@test "equal bytes: a window that moves with light, and lets electrons in" {
	pulse() { pinit wakefield --cells 60 --wavenumber 2 "$@"; }
	all_ways pulse m2p "push boris/2 | p2m --current | maxwell | push drift | window electrons --thermal 0.01 --start=-1 | m2p | push boris/2" 1
}

@test "equal bytes: a derivative on particles that moves a step of density" {
	steps() { awk 'BEGIN { print "x f volume"; for (i = 0; i < 40; i++) print (i + 0.5)/40, (i < 20), 1/40 }' |
		stab - --box 0,1 --faces periodic --dt 0.01 "$@"; }
	all_ways steps "" "field 'vel = 0' | pgrad --field f --method integral --side below | field 'df = -derivative' | push euler" 1
}

@test "equal bytes: particles that are left out behind a plane" {
	all_ways "pinit uniform -n 1001 --dispersion 0.3" "" "push drift | sel --where 'x < 0.6 - 0.02*time'" 1
}

# ranks HOW WORD...: a word as a process; 1, 2, 3, 4 and 7 ranks times 1, 2 threads write the file that it writes alone. HOW: shared, or whole, is what it says.
ranks() {
	local how=$1 word=$2 ran=0
	shift 2
	OMP_NUM_THREADS=1 $word "$@" -o alone
	for n in 1 2 3 4 7; do
		for threads in 1 2; do
			OMP_NUM_THREADS=$threads PM_REHEARSE=one-thread timeout -k 1 60 $word --ranks $n --verbose "$@" -o file 2>said && cmp alone file ||
				{ echo "$n ranks, $threads threads: $word $*"; return 1; }
			case $n,$how in
			1,*) ;;
			*,shared) grep -qx "$word: $n ranks share the work" said ;;
			*) ! grep -q "ranks share the work" said ;;
			esac || { echo "$n ranks: $word $* is not $how"; return 1; }
			ran=$((ran + 1))
		done
	done
	[ $ran -eq 10 ]
}

@test "equal bytes with ranks: scenes that each rank makes a stretch of, and others" {
	for n in 0 1 4096 4097 13000; do ranks shared pinit uniform -n $n --dispersion 0.3 --mass-spread 1; done
	ranks shared pinit plummer -n 8191
	ranks shared pinit lamb-oseen --cells 90x70    # nothing where there is no vorticity
	ranks shared pinit cylinder
	ranks shared pinit sphere --cells 20x15x15
	ranks shared pinit taylor-green-3d --cells 17x9x3
	ranks whole pinit two-stream -n 5000
}

@test "equal bytes with ranks: words outside cycle, from file to file" {
	pinit uniform -n 9000 --dispersion 0.3 >box
	p2m -n 12x10x9 -i box -o mesh
	ranks shared push drift -i box
	ranks shared p2m -n 12x10x9 -i box
	ranks shared poisson-fft -i mesh
	ranks shared ssort -i box
	ranks shared sel --where 'x < 0.3' -i box
	ranks whole smod --dt 0.3 -i box
}

# shared WORDS... < frame: a step in which ranks share every word; 1, 2, 3, 4 and 7 ranks times 1, 2 threads write what a run alone does.
shared() {
	cat >start
	ran=0
	OMP_NUM_THREADS=1 cycle -q -n 2 -i start -o alone "$1"
	[ "$(wc -c <alone)" -gt 1000 ]
	for n in 1 2 3 4 7; do
		for threads in 1 2; do
			OMP_NUM_THREADS=$threads PM_REHEARSE=one-thread timeout -k 1 60 \
				cycle --ranks $n --verbose -n 2 -i start -o file "$1" 2>said && cmp alone file ||
				{ echo "$n ranks, $threads threads: $1"; return 1; }
			[ $n -eq 1 ] || grep -q "^cycle: $n ranks share:.*on rank 0 alone: no word$" said || { grep share: said; return 1; }
			ran=$((ran + 1))
		done
	done
	[ $ran -eq 10 ]
}

@test "equal bytes with ranks: spectral derivatives, whose lines cross the planes of ranks" {
	for n in 16 15x17x18 6x33x5; do
		pinit uniform -n 2000 --dispersion 0.3 | shared "push kick/2 drift | p2m -n $n | poisson-fft | mgrad --order spectral | m2p | push kick/2"
	done
	pinit uniform -n 2000 --dim 2 --faces wall,neumann --particle-faces reflect |
		shared "push kick/2 drift | p2m -n 33x47 | poisson-fft | mgrad --order spectral | m2p | push kick/2"
	pinit uniform -n 500 --dim 1 | shared "push kick/2 drift | p2m -n 35 | poisson-fft | mgrad --order spectral | m2p | push kick/2"
	pinit shear-layer --cells 48 | shared "p2m | poisson-fft | mgrad --order spectral | diffuse --order spectral | m2p | push rk2"
	pinit taylor-green-3d --cells 12 |
		shared "p2m | poisson-fft | mgrad --order spectral | stretch --order spectral | diffuse --order spectral | m2p | push rk2 | remesh"
	pinit taylor-green-3d --cells 9x8x7 | shared "p2m | poisson-fft | mgrad | stretch --form mixed --order spectral | m2p | push rk2"
}

@test "equal bytes with ranks: vortices and a value that are exchanged between particles (pse)" {
	vortices --no-history | shared "p2m | poisson-fft | mgrad | m2p | pse --order 4 | push rk2 | remesh --cut-off 1e-6"
	pinit shear-layer --cells 96 | shared "p2m | poisson-fft | mgrad | m2p | pse | push rk2" # 9 pieces, periodic
	pinit taylor-green-3d --cells 17 | shared "p2m | poisson-fft | mgrad | m2p | pse | push euler"
	pinit shear-layer --cells 64 | shared "p2m | poisson-fft | mgrad | m2p | pse --nu 'nu*(1 + x)' | push rk2"
	pinit shear-layer --cells 64 | shared "p2m | poisson-fft | mgrad | m2p | pse --nu 1e-4,2e-4 | push rk2"
	pinit shear-layer --cells 48 | shared "p2m | poisson-fft | mgrad | diffuse --nu 'nu*(1 + x)' | m2p | push rk2"
	pinit taylor-green-3d --cells 12 | shared "p2m | poisson-fft | mgrad | diffuse --order spectral --nu 'nu*(2 + cos(z))' | m2p | push rk2"
	awk 'BEGIN { print "x y f volume"; for (i = 0; i < 4900; i++) print (i % 70 + 0.5)/70, (int(i/70) + 0.5)/70, (i < 2000), 1/4900 }' |
		stab - --box 0,0,1,1 --faces wall,neumann --particle-faces reflect --dt 1e-5 | shared "field 'vel = 0, 0' | pse --field f --nu 0.1 | push rk2"
}

@test "equal bytes with ranks: a step with light (p2m --current), faces that absorb until a rank has no particles left" {
	awk 'BEGIN { print "x y z vx vy vz mass charge"; for (i = 0; i < 9000; i++)
		print i*0.618%1, 1.1*(i*0.324%1), i*0.7548%1, 0.2*(i%5) - 0.4, 0.2*(i%7) - 0.5, 0.1*(i%3), 1, (i%2)*2 - 1 }' >rows
	stab rows --law electromagnetic --dt 0.01 --box 0,0,0,1,1.1,1 --faces neumann,wall,periodic --particle-faces reflect,absorb,periodic -n 7x12x9 |
		p2m | maxwell --gauss | sel --drop rho | shared "push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2"
	pinit uniform -n 13000 --dispersion 1 --dt 0.2 | smod --faces open --particle-faces absorb | shared "push drift"
	pinit uniform -n 9000 --dispersion 0.1 --dt 20 | smod --faces open --particle-faces absorb | shared "push drift" # 97 are left, on one rank
}

@test "equal bytes with ranks: a body in a flow (penalize), in the plane and in space" {
	pinit taylor-green-2d --cells 48 --speed 0 --dt 0.05 | shared "p2m | poisson-fft | mgrad | penalize --body 'hypot(x - pi, y - pi) - 1' \
		--velocity '1, 0.1*y' | diffuse | m2p | push lsrk3 | remesh"
	pinit taylor-green-2d --cells 37 --dt 0.05 |
		shared "p2m | poisson-fft | mgrad --order spectral | penalize --body 'x - 2' --stream '1, 0' --order spectral | m2p | push rk2"
	pinit taylor-green-3d --cells 9x8x7 | shared "p2m | poisson-fft | mgrad | penalize --body 'z - 1' --rate 2 --velocity 'u_y, 0, 1' | m2p | push rk2"
}

@test "equal bytes with ranks: interlaced meshes, a mesh that grows, a field of a file, changes carried alone" {
	pinit uniform -n 4500 --dispersion 0.3 >box
	shared "push kick/2 drift | p2m -n 6x5x3 --interlace --kernel tsc | poisson-fft | mgrad | m2p | push kick/2" <box
	pinit uniform -n 4500 --dim 2 --dispersion 0.3 | shared "push kick/2 drift | p2m -n 33x40 --interlace | poisson-fft | mgrad | m2p | push kick/2"
	pinit plummer -n 4500 --cells 8 | scalc 'v = 3*x, 3*y, 3*z' | shared "push kick/2 drift | p2m --outside grow | poisson-fft | mgrad | m2p | push kick/2"
	pinit uniform -n 500 --seed 3 | p2m -n 12x13x14 | poisson-fft | mgrad >given
	shared "field --file given | push kick drift" <box
	vortices --no-history | shared "field 'vel = y, -x' | p2m | diffuse | m2p --changes | push rk2"
}

@test "equal bytes with ranks: remeshed when distorted, without a strength or the volume" {
	local flow="p2m | poisson-fft | mgrad | m2p | push rk2"
	pinit taylor-green-2d --cells 70 | scalc --role state --extensive 's = x' >plane
	for how in "--when distortion --threshold 1e-5" "--drop s,volume"; do
		shared "field 'vel = y, -x' | push rk2 | remesh $how" <plane
	done
	pinit taylor-green-3d --cells 9 | shared "$flow | remesh --when distortion --threshold 1e-6"
}

@test "equal bytes with ranks: steps that are chosen by their error, or solved for" {
	pinit plummer -n 5000 >cluster
	smod --rename matter=b <cluster | sel --where 'id < 300' | stack - cluster >two
	for scheme in rk45 ias15 implicit-midpoint; do
		shared "field 'acc = -x, -2*y, -z + 0.1*vx' | push $scheme" <two
	done
	pinit uniform -n 4500 --dispersion 0.3 >box
	shared "p2m -n 6 | poisson-fft | mgrad | m2p | push implicit-midpoint" <box
}

@test "equal bytes with ranks: derivatives whose weights are solved for at every particle (pse --method dc, pgrad)" {
	awk 'BEGIN { print "x y f volume"; for (i = 0; i < 4900; i++) print (i % 70 + 0.5)/70, (int(i/70) + 0.5)/70, (i < 2000), 1/4900 }' |
		stab - --box 0,0,1,1 --faces wall,neumann --particle-faces reflect --dt 1e-5 >set
	shared "field 'vel = 0, 0' | pse --method dc --field f --nu 0.1 | push rk2" <set
	shared "field 'vel = 0, 0' | pgrad --field f | field 'df = -derivative_0' | push euler" <set
	shared "field 'vel = 0, 0' | pgrad --field f --method integral --derivative 1,0 | field 'df = -derivative' | push euler" <set
	# of two particles that have no partners in reach the first is named, whoever holds it
	local alone="field 'vel = 0, 0' | pgrad --field f --cutoff 1 --eps 1e-3 | push euler"
	cycle -q -n 1 "$alone" <set 2>want >/dev/null && return 1
	grep -q 'particle 0 has' want
	PM_REHEARSE=one-thread timeout -k 1 60 cycle --ranks 3 -q -n 1 "$alone" <set 2>got >/dev/null && return 1
	cmp want got
}

# tables WORDS < frame: as shared, and the table of diag is equal.
tables() {
	cat >begin
	cycle -q -n 2 -i begin "$1" >/dev/null && cp table want
	[ "$(wc -l <want)" -eq 3 ]
	for n in 2 3 7; do
		PM_REHEARSE=one-thread timeout -k 1 60 cycle --ranks $n --verbose -n 2 -i begin "$1" 2>said >/dev/null && cmp want table ||
			{ echo "$n ranks: $1"; return 1; }
		grep -q "^cycle: $n ranks share:.*on rank 0 alone: no word$" said || { grep share: said; return 1; }
	done
}

# Threads that stay awake, so that any of them may have the job.
@test "equal bytes of two threads where all particles are one job" {
	local step="push kick/2 drift | p2m --kernel pcs | poisson-fft | mgrad | m2p --kernel pcs | push kick/2 | diag --tee table"
	pinit langmuir -n 16384 --cells 32 --dim 2 --axes 2 --amplitude 0.3 >begin
	OMP_NUM_THREADS=1 cycle -q -n 60 -i begin "$step" >one
	for i in 1 2 3 4 5 6; do
		OMP_NUM_THREADS=2 OMP_WAIT_POLICY=active timeout -k 1 60 cycle -q -n 60 -i begin "$step" >two
		cmp one two
	done
}

@test "equal tables of diag with ranks: vortices on meshes, modes, species, pairs, separations, light" {
	local flow="p2m | poisson-fft | mgrad | m2p" leap="push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2"
	pinit taylor-green-2d --cells 70 | tables "$flow | diag --tee table | push rk2"
	pinit taylor-green-3d --cells 9 | tables "$flow | diag --tee table | push rk2"
	pinit vortex-ring --cells 12 | tables "$flow | diag --tee table --modes 3 | push rk2"
	pinit langmuir -n 4900 --dim 2 --axes 2 --amplitude 0.3 | tables "$leap | diag --tee table --modes 1,2"
	pinit uniform -n 4200 --dim 2 --dispersion 0.1 --faces periodic,neumann --particle-faces periodic,reflect |
		tables "push kick/2 drift | p2m -n 16x33 | poisson-fft | mgrad | m2p | push kick/2 | diag --tee table --modes 1" # rows of half weight
	pinit two-stream -n 9000 --vth 0.1 --amplitude 0.1 | tables "$leap | diag --tee table --modes 1 --species"
	pinit plummer -n 4200 >one
	smod --rename matter=shadow <one | scalc 'x = x + 0.001*id, y, z' | stack one - |
		tables "push drift | diag --tee table --separation matter,shadow --pair"
	awk 'BEGIN { print "x y z vx vy vz mass charge"; for (i = 0; i < 4500; i++)
		print i*0.618%1, 1.1*(i*0.324%1), i*0.7548%1, 0.2*(i%5) - 0.4, 0.2*(i%7) - 0.5, 0.1*(i%3), 1, (i%2)*2 - 1 }' |
		stab - --law electromagnetic --dt 0.01 --box 0,0,0,1,1.1,1 --faces neumann,wall,periodic --particle-faces reflect,absorb,periodic -n 7x6x9 |
		p2m | maxwell --gauss | sel --drop rho | tables "push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2 | diag --tee table"
}
