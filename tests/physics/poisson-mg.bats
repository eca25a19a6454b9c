# Poisson's equation by multigrid: exact solutions, and the same differences inverted by transforms. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# source CELLS EXPRESSION [pinit options]: a frame whose rho is the awk expression of i, the number of the mesh point (x fastest)
source_of() {
	local cells=$1 expression=$2
	shift 2
	pinit uniform -n 2 "$@" | p2m -n "$cells" | stab |
		awk "/^#mesh/ { m = 1; print; getline; print; next } /^#end/ { m = 0 } m { printf \"%.17g\\n\", $expression; i++; next } { print }" | stab -
}
phi() { stab --plain --mesh mesh | awk 'NR > 1 { print $NF }'; }
differ() { scmp --norm relative_l2 --field phi "$1" "$2" | tail -1 | cut -f8; }

@test "PS-05: -lap u = 1 in a square with walls: u at the centre and its integral, order 2" {
	c=() s=()
	for n in 16 32 64; do
		source_of $n 1 --dim 2 --faces wall | poisson-mg --coefficient -1 | phi >u
		read -r centre sum < <(awk -v n=$n '{ s += $1 } NR == (n/2)*(n+1) + n/2 + 1 { c = $1 } END { printf "%.17g %.17g\n", c - 0.0736713532815138,
			s/n/n - 0.0351442537387884 }' u)
		c+=("$(awk "BEGIN { print 1/$n }")" "${centre#-}") s+=("$(awk "BEGIN { print 1/$n }")" "${sum#-}")
	done
	order 2 "${c[@]}"
	order 2 "${s[@]}"
	within "${c[5]}" 1.417e-5 0.02e-5 # 0.0580 h^2, tests/unit/poisson-mg
}

@test "PS-06: a sine in a periodic box is amplified by the inverse of the second difference" {
	# 1.0032189644401 and 1.0530292875455 are the ratios for N = 32, m = 1, 4 on [0, 2 pi); on a box of length 1 u = s/(2 pi m)^2
	for row in "1 1.0032189644401" "4 1.0530292875455"; do
		read -r m ratio <<<"$row"
		for dim in 1 2 3; do
			source_of 32 "sin(6.283185307179586*$m*(i%32)/32)" --dim $dim | poisson-mg --coefficient -1 --tolerance 1e-14 | phi >u
			got=$(awk -v m=$m 'NR == 8/m + 1 { printf "%.16g", $1 * (6.283185307179586*m)^2 }' u)
			within "$got" "$ratio" 1e-12 "m = $m, $dim-D"
		done
	done
}

@test "multigrid and the transforms invert the same differences to 1e-9, with every kind of face" {
	for faces in periodic wall neumann periodic,periodic,wall,wall,neumann,neumann; do
		for n in 32 31x20x7 27x33x48; do
			pinit uniform -n 3000 --faces $faces | p2m -n $n >m
			poisson-fft --plan estimate --symbol fd2 <m >f
			for cycle in v w fmg; do
				poisson-mg --cycle $cycle <m >g
				below "$(differ g f)" 1e-9 "$faces $n $cycle"
			done
		done
	done
}

@test "in 1-D and 2-D too" {
	for dim in 1 2; do
		for faces in periodic wall neumann; do
			for n in 64 37; do
				pinit uniform -n 300 --dim $dim --faces $faces | p2m -n $n >m
				poisson-fft --plan estimate --symbol fd2 <m >f
				poisson-mg <m >g
				below "$(differ g f)" 1e-9 "$dim-D $faces $n"
			done
		done
	done
}

@test "PM-01: the forces of two particles, cic, 7-point Laplacian by multigrid, gradients of order 4 and 2" {
	# want from reference/values.csv, by transforms; 1e-11: the tolerance of the residual. exact: Ewald
	f() { pinit pair | p2m | $1 | mgrad --order $2 | m2p | stab --plain | awk 'NR == 2 { print $(NF-2), $(NF-1), $NF }'; }
	read -r x y z < <(f poisson-mg 4)
	within $x 0.02690820956069 1e-11
	within $y 0.009754634575902 1e-11
	within $z 0.02535070183723 1e-11
	mg=$(f poisson-mg 2)
	read -r x y z <<<"$mg"
	within $x 0.02663957298003 1e-11
	within $y 0.009361482740412 1e-11
	within $z 0.02494476327532 1e-11
	# with the same second-order gradient, spectral and multigrid differ by less (3.3e-4) than the error of either (5.9e-4, 6.3e-4)
	echo "$mg $(f 'poisson-fft --plan estimate --symbol spectral' 2) 0.0269507714622 0.00946960886732 0.0254426249975" |
		awk '{ for (i = 1; i <= 3; i++) { d += ($i - $(i+3))^2; a += ($i - $(i+6))^2; b += ($(i+3) - $(i+6))^2 } print sqrt(d), sqrt(a), sqrt(b);
			exit !(d < a && d < b) }'
}

# edge X: 1 inside the cube, half on its faces.
edge() { echo "($1 < 0.499 ? 1 : $1 < 0.501 ? 0.5 : 0)"; }
@test "PS-03: the potential of a unit cube in open space, at its centre and its corner; the mesh is 1.5 times as wide" {
	# rho = 1 in the cube, 1/2, 1/4, 1/8 on its faces, edges and corners; phi = 1/(4 pi) int 1/r with coefficient -1
	pinit plummer -n 10 | p2m -n 48 --outside drop | scalc --mesh mesh 'X = abs(x)/Lx*1.5, abs(y)/Ly*1.5, abs(z)/Lz*1.5' |
		scalc --mesh mesh "rho = $(edge X_0)*$(edge X_1)*$(edge X_2)" >m
	side=$(sls <m | awk '/mesh: / { for (i = 1; i <= NF; i++) if ($i == "h") print 32*$(i+1) }')
	poisson-mg --coefficient -12.566370614359172 <m | phi >u
	read -r centre corner < <(awk -v l="$side" 'NR == 24*(1 + 49 + 49*49) + 1 { a = $1 } NR == 40*(1 + 49 + 49*49) + 1 { b = $1 } END {
		printf "%.10g %.10g\n", a/l/l, b/l/l }' u)
	within "$centre" 2.38007736397955 1e-3
	within "$corner" 1.19003868198978 1e-3
}

@test "open space: multigrid is the transforms with the lattice's Green's function, in 2-D with the logarithm and in 3-D; order 4 is close to it" {
	for row in "2 64x80 1e-8" "3 32x28x30 1e-7"; do # the far form of the lattice's function where multigrid begins to use it, at 128 and 32 cells
		read -r dim n tolerance <<<"$row"
		pinit uniform -n 200 --dim $dim --faces open | p2m --kernel m4prime --outside drop -n $n >m
		poisson-fft --plan estimate --symbol fd2 --green lattice <m >f
		poisson-mg <m >g
		below "$(differ g f)" "$tolerance" "$row"
		poisson-mg --order 4 <m >g
		below "$(differ g f)" 0.01 "$row, order 4" # h^2 of the blobs of m4prime
		run ! below "$(differ g f)" 1e-4
	done
}

# phi at the middle is the mean of |x|/2, ln(r)/(2 pi), -1/(4 pi r) over the Gaussian: sqrt(2/pi)/2, (ln 2 - gamma)/(4 pi), -sqrt(2/pi)/(4 pi).
@test "James' method: a Gaussian in open space, order 2 at its middle in 1-D to 3-D, by multigrid, relaxation and sines; the transforms' table agrees" {
	for row in "1 x 0.398942280401433" "2 hypot(x,y) 0.0092255368885859" "3 sqrt(x^2+y^2+z^2) -0.0634936359342410"; do
		read -r dim r want <<<"$row"
		for solver in poisson-mg poisson-relax "poisson-fft --symbol fd2" "poisson-fft --free-space james"; do
			e=()
			for n in 16 24 32; do
				pinit uniform --dim $dim -n 1 --faces open --particle-faces open | smod --box=-7,7 | p2m --outside drop -n $n |
					scalc --mesh mesh "rho = exp(-($r)^2/2)/(2*pi)^($dim/2)" | $solver --coefficient 1 | phi >u
				got=$(sed -n "$((n / 2 * (1 + (dim > 1) * (n + 1) + (dim > 2) * (n + 1) * (n + 1)) + 1))p" u)
				e+=("$(calc "14/$n")" "$(calc "sqrt(($got - $want)^2)")")
			done
				order 2 "${e[@]}" # 2.03 to 2.08; h is at most 0.9 of the width
		done
	done
}

@test "PS-06: Mehrstellen with the compact right-hand side: a product of sines in a periodic square" {
	# on a box of length 1 the ratio is u (2 pi m)^2 2 / s; at x = y = 1/(4m), where the sines are 1
	for row in "1 0.999995880816087" "4 0.998986994425862"; do
		read -r m ratio <<<"$row"
		source_of 32 "sin(6.283185307179586*$m*(i%32)/32)*sin(6.283185307179586*$m*int(i/32)/32)" --dim 2 |
			poisson-mg --order 4 --coefficient -1 --tolerance 1e-14 | phi >u
		got=$(awk -v m=$m 'NR == 33*8/m + 1 { printf "%.16g", 2 * $1 * (6.283185307179586*m)^2 }' u)
		within "$got" "$ratio" 1e-12 "m = $m"
	done
}
