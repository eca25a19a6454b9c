# Boundary values of poisson-fft, poisson-mg and poisson-relax: Dirichlet values and fluxes on every face (000:S22, S25; 004:S4-8, S4-9, T5, T9).
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

most() { scmp --norm max --field "${3:-phi}" "$1" "$2" | tail -1 | cut -f7; }
solvers=("poisson-fft" "poisson-mg" "poisson-mg --order 4" "poisson-relax")
places=(--x-low --x-high --y-low --y-high --z-low --z-high)

# A smooth function u, its Laplacian and its gradient, which vanish nowhere in particular.
manufactured() {
	case $1 in
	1) u='x^2+exp(x)' lap='2+exp(x)' grad=('2*x+exp(x)') ;;
	2) u='exp(x)*cos(2*y+0.4)+x*y' lap='-3*exp(x)*cos(2*y+0.4)' grad=('exp(x)*cos(2*y+0.4)+y' '-2*exp(x)*sin(2*y+0.4)+x') ;;
	3) u='exp(x)*cos(2*y+0.4)*sin(z+0.3)+z^3' lap='-4*exp(x)*cos(2*y+0.4)*sin(z+0.3)+6*z'
		grad=('exp(x)*cos(2*y+0.4)*sin(z+0.3)' '-2*exp(x)*sin(2*y+0.4)*sin(z+0.3)' 'exp(x)*cos(2*y+0.4)*cos(z+0.3)+3*z^2') ;;
	4) u='cos(2*pi*x)*exp(y)' lap='(1-4*pi^2)*cos(2*pi*x)*exp(y)' grad=(0 'cos(2*pi*x)*exp(y)') ;; # periodic in x
	esac
}

# mesh DIM FACES CELLS: m with rho = lap u, e with phi = u; given: the options of all faces.
mesh() {
	local faces i dim=$(($1 == 4 ? 2 : $1))
	manufactured "$1"
	IFS=, read -ra faces <<<"$2"
	pinit uniform -n 2 --dim $dim --faces "$2" | p2m -n "$3" | scalc --mesh mesh "rho=$lap" >m
	scalc --mesh mesh "phi=$u" <m >e
	given=(--coefficient 1)
	for ((i = 0; i < 2 * dim; i++)); do
		case ${faces[i % ${#faces[@]}]} in
		wall) given+=("${places[i]}" "$u") ;;
		neumann) given+=("${places[i]}" "$( ((i % 2)) || echo -)(${grad[i / 2]})") ;;
		esac
	done
}

@test "constants and linear functions are exact on all faces, at corners too, in 1-D to 3-D and by every solver (004:S4-T9)" {
	for dim in 1 2 3; do
		linear=$(cut -d+ -f1-$((dim + 1)) <<<'0.7+2*x+-3*y+0.5*z')
		pinit uniform -n 2 --dim $dim --faces wall | p2m -n 9 | scalc --mesh mesh 'rho=0' >m
		for value in 1.25 "$linear"; do
			scalc --mesh mesh "phi=$value" <m >e
			for s in "${solvers[@]}"; do
				$s --dirichlet "$value" --tolerance 1e-14 <m >p 2>/dev/null || $s --dirichlet "$value" <m >p # transforms have no tolerance
				below "$(most p e)" 1e-13 "$s, $dim-D, $value" # values up to 4: round-off of some hundred operations
			done
		done
	done
}

@test "order 2, and order 4 of poisson-mg, with given values and fluxes in every mixture of faces; the three agree" {
	for row in '1 wall,neumann' '2 wall' '2 wall,neumann,neumann,wall' '2 neumann,neumann,neumann,wall' '4 periodic,periodic,wall,neumann' \
		'3 wall,neumann,neumann,wall,neumann,neumann'; do
		read -r dim faces <<<"$row"
		a=() b=()
		for n in 8 12 16; do
			mesh "$dim" "$faces" $n
			poisson-fft "${given[@]}" <m >f
			poisson-mg "${given[@]}" <m >g
			poisson-relax "${given[@]}" <m >r
			poisson-mg --order 4 "${given[@]}" <m >h
			below "$(most g f)" 1e-8 "poisson-mg against poisson-fft, $row" # the tolerance 1e-11 of a residual that has values/h^2
			below "$(most r f)" 1e-8 "poisson-relax against poisson-fft, $row"
			a+=("$(calc "1/$n")" "$(most f e)")
			b+=("$(calc "1/$n")" "$(most h e)")
		done
		order 2 "${a[@]}"
		order 3.9 "${b[@]}" # 3.8 to 4.1 measured on so few cells
	done
}

@test "the separated series of a rectangle: exact with the spectral symbol, which converges beyond every power (000:S22)" {
	u='sin(pi*y)*sinh(pi*(1-x))/sinh(pi)'
	for faces in wall wall,wall,neumann,neumann; do
		v=${u/sin(pi\*y)/$([ $faces = wall ] && echo 'sin(pi*y)' || echo 'cos(pi*y)')}
		pinit uniform -n 2 --dim 2 --faces $faces | p2m -n 12 | scalc --mesh mesh 'rho=0' >m
		scalc --mesh mesh "phi=$v" <m >e
		poisson-fft --symbol spectral --x-low "$v" <m >p
		below "$(most p e)" 3e-15 "$faces" # round-off
	done
	# Re 1/(2 - w), w = exp(2 pi (i y - x)): its waves fall as 2^-k, so the error as 2^(-n/2): 6e-2, 4e-3, 1.5e-5 at 8, 16, 32 cells.
	r='exp(-2*pi*x)' c='cos(2*pi*y)'
	d="(4-4*$r*$c+$r^2)"
	for side in "wall (2-$r*$c)/$d" "neumann 2*pi*(4*$r*$c-4*$r^2+$r^3*$c)/$d^2"; do
		for n in 8 16 32; do
			pinit uniform -n 2 --dim 2 --faces "${side%% *},wall,periodic,periodic" | p2m -n $n | scalc --mesh mesh 'rho=0' >m
			scalc --mesh mesh "phi=(2-$r*$c)/$d" <m >e
			poisson-fft --symbol spectral --x-low "${side#* }" --x-high "(2-$r*$c)/$d" <m >p
			eval "e$n=$(most p e)"
		done
		below "$e32" 1e-5 "32 cells, ${side%% *}"
		above "$(awk -v a="$e8" -v b="$e16" -v c="$e32" 'BEGIN { print log(b / c) / log(a / b) }')" 1.5 "the order grows, ${side%% *}"
	done
	poisson-fft --symbol spectral --dirichlet 1+y <m >p # periodic in y: no walls meet
	mesh 2 wall 8
	run -1 --separate-stderr poisson-fft --symbol spectral "${given[@]}" <m
	[[ $stderr == *"where walls meet"*"leave --symbol out, or poisson-mg --order 4"* ]]
}

@test "fluxes that do not fit the source are told in one line with the numbers, and those that fit are not" {
	pinit uniform -n 2 --dim 2 --faces neumann | p2m -n 16 | scalc --mesh mesh 'rho=1' >m
	for s in "${solvers[@]}"; do
		run -0 --separate-stderr $s --coefficient 1 --x-high 1.5 -o p <m
		[[ $stderr == *"the integral of c*rho is 1, that of the fluxes 1.5; the difference, 0.2 of their sizes, was spread over the box" ]]
		[ "$(wc -l <<<"$stderr")" = 1 ]
		tail -c 600 p | grep -aq '"flux":1.5'
		tail -c 600 p | grep -aq '"mean_removed":-0.5'
		run -0 --separate-stderr $s --coefficient 1 --x-low=-0.5 --x-high 1 -o p <m
		[[ $stderr == *"the integral of c*rho is 1, that of the fluxes 0.5;"* ]] # both are outwards
		run -0 --separate-stderr $s --coefficient 1 --x-high 1 -o p <m
		[ -z "$stderr" ]
		scalc --mesh mesh 'phi=x^2/2-1/6-1/3072' <m >e # the mean of x^2/2 by trapezoids is 1/6 + h^2/12
		below "$(most p e)" 1e-9 "$s"
	done
}

@test "plates at given potentials with a dielectric between them: linear in each layer" {
	pinit uniform -n 2 --dim 2 --faces wall,wall,neumann,neumann | p2m -n 32x4 | scalc --mesh mesh 'rho=0' 'eps=x<0.51?1:3' >m # the layer ends at 33/64
	poisson-mg --permittivity eps --x-low 1 --x-high 2 <m >p
	scalc --mesh mesh 'phi=1+(x<0.51?x:33/64+(x-33/64)/3)/(33/64+31/64/3)' <m >e
	below "$(most p e)" 1e-10
	poisson-mg --permittivity eps --x-low 1 --x-high 2 --y-low x --y-high -x <m | cmp -s p - && return 1
	pinit uniform -n 2 --dim 1 --faces wall,neumann | p2m -n 32 | scalc --mesh mesh 'rho=0' 'eps=x<0.51?1:3' >m
	poisson-mg --permittivity eps --x-low 1 --x-high 2 <m >p # d phi/dx = 2 beside the flux, 6 in the other layer
	scalc --mesh mesh 'phi=x<0.51?1+6*x:1+6*33/64+2*(x-33/64)' <m >e
	below "$(most p e)" 1e-10
}

@test "sums over the particles on the faces of an open box: free space inside, by every solver (004:S4-8, S4-9)" {
	speed() { awk '!/^#/ && !c { for (i = 1; i <= NF; i++) if ($i == "speed") c = i; next } !/^#/ { print $c }'; }
	pinit plummer -n 200 | p2m -n 24 >m
	poisson-fft --symbol fd2 <m >f
	for s in poisson-fft poisson-mg poisson-relax; do
		$s --open-faces sum <m >g
		below "$(scmp --field phi g f | tail -1 | cut -f8)" 2e-3 "$s" # the lattice's Green's function is that of free space to h^2
		mgrad <g | m2p >/dev/null
	done
	# A lone vortex stays at rest, between walls with phi = 0 it moves at Gamma/(4 pi d) along a wall at distance d (004:S4-T5).
	printf 'x y circulation\n0.31 0.13 1\n' | stab - --law vortex --box -1,1 -n 64 >v
	for s in poisson-fft poisson-mg poisson-relax; do
		p2m <v | $s --open-faces sum | mgrad | m2p | scalc 'speed=hypot(velx, vely)' | stab --plain | speed >v1
		below "$(cat v1)" 2e-5 "$s" # 4e-6: a mesh of 64 cells is not free space to every order
	done
	p2m <v | poisson-fft --dirichlet 0 | mgrad | m2p | scalc 'speed=hypot(velx, vely)' | stab --plain | speed >v1
	above "$(cat v1)" 0.05 # 0.0511
}

@test "an open face with values is a wall; mgrad is exact beside given values, and m2p takes cic there alone" {
	for faces in wall,neumann,wall,wall wall,neumann,open,open; do
		printf 'x y vx vy mass\n0.03 0.53 0 0 1\n' | stab - --law gravity --faces $faces --box 0,1 -n 16 | p2m | scalc --mesh mesh 'rho=0' >m
		poisson-fft --x-low 1+2*y --x-high 3 --y-low 1+3*x --y-high 3+3*x <m | mgrad >p
		scalc --mesh mesh 'g=-3,-2' <p >e
		below "$(most p e g)" 1e-11 # differences of order 4 of values up to 6: eps 6/h times some hundred operations
		m2p <p | stab --plain | awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i } NR == 2 { print $c["acc_0"] + 3, $c["acc_1"] + 2 }' >off
		read -r x y <off
		below "$x" 1e-11
		below "$y" 1e-11
		run -1 --separate-stderr m2p --kernel tsc <p
		[[ $stderr == *"values were given on the face x-low of 'g'"*"m2p --kernel cic"* ]]
	done
}

@test "values are refused where they cannot be, by name" {
	pinit uniform -n 9 --dim 2 --faces periodic,periodic,wall,wall | p2m -n 8 >m
	while IFS='|' read -r code options text; do
		eval "run -$code --separate-stderr poisson-relax $options <m"
		[[ $stderr == *"$text"* ]] || { echo "$options: $stderr"; return 1; }
	done <<'ROWS'
2|--x-low 1|--x-low: this face is periodic
2|--z-high 1|--z-high: this mesh has no such face
2|--flux 1|--flux: no face of the box is neumann
1|--y-low q|no field or number 'q'
2|--y-low 'x +'|column
3|--y-low '1/x'|'1/x' is not finite at a node of the face y-low
2|--y-low '1, 2'|has 2 parts for a field of 1 components
1|--open-faces sum|--open-faces sum needs a box that is open on all faces
ROWS
	run -2 --separate-stderr poisson-fft --influence optimal --y-low 1 <m
	[[ $stderr == *"boundary values belong to the Laplacian"* ]]
	pinit uniform -n 9 --dim 2 | p2m -n 8 >m
	run -2 --separate-stderr poisson-mg --dirichlet 1 <m
	[[ $stderr == *"--dirichlet: no face of the box is a wall or open"* ]]
}

@test "particles beside a face with given values get the same force in one process, through pipes and from a file" {
	s='p2m | poisson-fft --x-low 0.3 | mgrad | m2p'
	pinit plasma --background 0 | smod --faces neumann,wall --particle-faces absorb | species electrons -n 2000 --no-history >a
	cycle -q --no-history -n 2 "push kick/2 drift | $s | push kick/2" <a >b
	same_as b <(cycle -q --no-history -n 2 --engine pipes "push kick/2 drift | $s | push kick/2" <a)
	same_as <(sel --field acc b | stab --plain --set electrons) <(sel --drop acc b | bash -o pipefail -c "${s}" | sel --field acc |
		stab --plain --set electrons)
}
