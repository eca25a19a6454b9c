# The transform solver through the words: different faces at the two ends, screening, vectors. Every mixture of faces is in tests/unit/poisson-faces.c and
# pm-faces.c.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# worst A B < table: the largest |A - B| of two columns over the largest |B|; nan fails.
worst() {
	awk -v a="$1" -v b="$2" 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { d = $c[a] - $c[b]; if (d < 0) d = -d; if (!(d <= m)) m = d
		v = $c[b] < 0 ? -$c[b] : $c[b]; if (v > s) s = v } END { print m/s }'
}

@test "poisson-fft: charges between a grounded plate and a plane of symmetry: E is minus the charge beyond" {
	printf 'x mass charge\n0.31 1 2\n0.77 1 -0.5\n' > table
	for faces in wall,neumann neumann,wall; do
		sh_ok "stab table --law electrostatic --dim 1 --box 0,1 --faces $faces --particle-faces reflect -n 40 |
			p2m --kernel cic | poisson-fft --symbol fd2 |
			mgrad --order 2 | stab --plain --mesh mesh > E"
		grep -q '^x' E
		# eps0 = 1; nodes two cells away from the charges feel all of them: round-off of differences of phi over 2h
		awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { print $1, $c["E"] }' E > at
		for place in 0.1 0.5 0.9; do
			want=$(awk -v x=$place -v f=$faces 'BEGIN { low = (x > 0.31 ? 2 : 0) + (x > 0.77 ? -0.5 : 0);
				print f == "wall,neumann" ? low - 1.5 : low }')
			within "$(awk -v x=$place '{ d = $1 - x } d*d < 1e-12 { print $2 }' at)" "$want" 1e-13 "$faces at $place"
		done
	done
}

@test "poisson-fft --symbol fd2 and poisson-mg agree to 1e-9 if the two faces of each axis differ" {
	pinit uniform -n 2000 --seed 5 --faces wall,neumann,neumann,wall,periodic,periodic | p2m -n 18x21x16 > rho
	sh_ok "poisson-fft --symbol fd2 --target a < rho | poisson-mg --tolerance 1e-11 --target b | stab --plain --mesh mesh > both"
	below "$(worst a b < both)" 1e-9
}

@test "poisson-fft --screening: a sheet of charge in a plasma falls as exp(-K x) from a wall held apart by neumann faces" {
	# rho on one plane of nodes; between neumann faces phi = cosh(K (1 - x)) / (K sinh K), less (K h)^2/8 of it at x = 0 with second differences
	sh_ok "pinit uniform --dim 1 -n 10 --faces neumann | p2m -n 200 |
		scalc --mesh mesh 's = x < 1e-9 ? 400 : 0' 'want = -(exp(5*(1-x)) + exp(-5*(1-x)))/(5*(exp(5) - exp(-5)))' |
		poisson-fft --symbol fd2 --source s --target u --coefficient 1 --screening 5 | stab --plain --mesh mesh > u"
	below "$(worst u want < u)" 7.9e-5 # (5/200)^2/8 = 7.81e-5
	sh_ok "pinit uniform -n 10 | p2m -n 8 | poisson-fft --screening 3 | sls --report"
	[[ $output != *mean_removed* ]] # nothing is singular
}

# round_trip LINE ORDER: the vector A of a stream, zero where the rule says and free elsewhere, through lap of mgrad and poisson-fft ("$@") and back.
round_trip() {
	local scene=$1 order=$2
	shift 2
	sh_ok "$scene | mgrad --operator lap --order $order --source A --target J |
		poisson-fft $* --symbol ${order/#[246]/fd$order} --source J --target B --coefficient 1 |
		stab --plain --mesh mesh > AB"
	for c in $(head -1 AB | tr ' \t' '\n\n' | grep -o '^A_[0-9]' | grep -o '[0-9]'); do
		below "$(worst "B_$c" "A_$c" < AB)" 1e-12 "order $order, component $c" # as the unit test of scalars
	done
}

@test "poisson-fft: of a vector between walls the tangential components are zero there, the normal one has no gradient; mgrad agrees, every order" {
	local scene="pinit uniform -n 10 --faces wall,wall,neumann,wall,wall,neumann | p2m -n 9x8x10 |
		scalc --mesh mesh 'A = (1+x^2)*(1-y)*z*exp(y), x*(1-x)*y*z*(1+y*z), x*(1-x)*(1-y)*(1-z)*(2+z)'"
	for order in 2 4 6 spectral; do
		round_trip "$scene" $order
	done
}

@test "poisson-fft --wall normal: free slip at a wall; mgrad agrees for vortices" {
	printf 'x y circulation\n0.3 0.4 1\n' > table
	for order in 2 4 6 spectral; do
		round_trip "stab table --law vortex --box 0,1 --faces wall,wall,wall,neumann --particle-faces reflect -n 12 |
			scalc --mesh mesh 'A = x*(1-x)*(1-y)*(2+y), y*(1+x)'" $order --wall normal
	done
}

@test "p2m | poisson-fft | mgrad --operator curl: the field of currents between walls is that of their images" {
	# in the plane currents of two components; their images in a box of twice the length: tangential components change sign
	printf 'x y J_0 J_1\n0.3 0.4 1 2\n0.81 0.02 -0.5 0.7\n' > table
	awk 'NR == 1 { print; next } { print; print -$1, $2, $3, -$4; print $1, -$2, -$3, $4; print -$1, -$2, -$3, -$4 }' table > images
	sh_ok "stab table --law gravity --strength J --box 0,1 --faces wall --particle-faces reflect -n 12 | p2m --strength J --kernel tsc --field j |
		poisson-fft --source j --target A --symbol fd4 | mgrad --operator curl --source A --target B --order 4 | stab --plain --mesh mesh > wall"
	sh_ok "stab images --law gravity --strength J --box -1,1 --faces periodic --particle-faces periodic -n 24 | p2m --strength J --kernel tsc --field j |
		poisson-fft --source j --target A --symbol fd4 | mgrad --operator curl --source A --target B --order 4 | stab --plain --mesh mesh > box"
	awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i } { x = sprintf("%.4f %.4f", $1, $2) } FNR == 1 { f++ } f == 1 { b[x] = $c["B"]; next }
		FNR == 1 { print "a b" } FNR > 1 && (x in b) { print $c["B"], b[x] }' box wall > both
	[ "$(wc -l < both)" -gt 100 ]
	below "$(worst a b < both)" 1e-13
}

@test "poisson-fft: psi from a vector omega has the faces that mgrad gives psi" {
	printf 'x y circulation\n0.3 0.4 1\n' > table
	sh_ok "stab table --law vortex --box 0,1 --faces wall,wall,wall,neumann --particle-faces reflect -n 12 |
		scalc --mesh mesh 'omega = (1+x)*y, x*(1-x)*(1-y)' | poisson-fft --symbol fd4 --coefficient 1 |
		mgrad --operator lap --order 4 --source psi --target back |
		stab --plain --mesh mesh > ob"
	# omega on nodes where psi is zero has no effect
	below "$(awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; print; next } $1 > 0.01 && $1 < 0.99 && $2 > 0.01 && $2 < 0.99' ob > in
	worst back_0 omega_0 < in)" 1e-12
	below "$(worst back_1 omega_1 < in)" 1e-12
}

@test "poisson-relax and poisson-mg take the components of a vector between walls as poisson-fft does" {
	pinit uniform -n 10 --faces wall,wall,neumann,wall,wall,neumann | p2m -n 9x8x10 | scalc --mesh mesh 'J = 1+x, x*y-1, z^2' > J
	for wall in tangential normal all; do
		sh_ok "poisson-fft --wall $wall --symbol fd2 --source J --target A < J | poisson-relax --wall $wall --source J --target B |
			poisson-mg --wall $wall --source J --target C | stab --plain --mesh mesh > AB"
		for c in 0 1 2; do
			below "$(worst B_$c A_$c < AB)" 1e-9 "relax, $wall, component $c"
			below "$(worst C_$c A_$c < AB)" 1e-9 "mg, $wall, component $c"
		done
	done
}

@test "poisson-fft --wall all: each component of a vector is a scalar" {
	sh_ok "pinit uniform -n 10 --faces wall,neumann,neumann,wall,wall,wall | p2m -n 9x8x10 | scalc --mesh mesh 'J = 1+x, x*y, z' 's = z' |
		poisson-fft --source J --target B --wall all | poisson-fft --source s --target b | stab --plain --mesh mesh > B"
	[ "$(worst B_2 b < B)" = 0 ]
	sh_ok "pinit uniform -n 10 --dim 2 | p2m -n 9x8 | scalc --mesh mesh 'J = 1+x, 2.5, y' | poisson-fft --source J --target B | sls --report"
	[[ $output == *mean_removed_0*mean_removed_1*mean_removed_2* ]] # a periodic box: every component is singular
}
