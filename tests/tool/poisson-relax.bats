# poisson-relax as a word: fields, options, reports, refusals, and the same answers as the other solvers of the same differences. The radii are in tests/unit.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

methods="cg gauss-seidel jacobi red-black red-black-sor sor ssor-cg weighted-jacobi"
mesh() { pinit uniform -n 200 "$@" | p2m -n 12x8x10; }
report() { tail -c 2048 "$1" | grep -ao "\"poisson-relax[^}]*}" | tail -1 | grep -o "\"$2\":[^,}]*" | cut -d: -f2 | tr -d '"'; }
differ() { scmp --norm relative_l2 --field phi "$1" "$2" | tail -1 | cut -f8; }

@test "every method in lib/relax can be chosen, and no other" {
	[ "$(cd "$top/lib/relax" && ls -- *.c | sed 's/\.c$//' | sort | tr '\n' ' ')" = "$methods " ]
	for m in $methods; do poisson-relax --help | grep -cw -- "$m" >/dev/null; done
	run -2 --separate-stderr poisson-relax --method chebyshev </dev/null
	[[ $stderr == *chebyshev* ]]
}

@test "relaxation, multigrid and the transforms invert the same differences to 1e-9, with every kind of face" {
	for faces in periodic wall neumann periodic,periodic,wall,wall,neumann,neumann; do
		for n in 16 15x10x7; do
			pinit uniform -n 3000 --faces $faces | p2m -n $n >m
			poisson-fft --symbol fd2 <m >f
			poisson-mg <m >g
			for method in $methods; do
				[[ $method != jacobi || $faces == *wall* ]] || continue # refused: see below
				poisson-relax --method $method <m >r
				below "$(differ r f)" 1e-9 "$method $faces $n, transforms" # the tolerance 1e-11 times ten for the lowest mode, times ten
				below "$(differ r g)" 1e-9 "$method $faces $n, multigrid"
			done
		done
	done
}

@test "in 1-D and 2-D, and with a wall on one side and neumann on the other" {
	for row in "1 periodic" "1 wall" "2 neumann" "2 wall,neumann,periodic,periodic" "3 wall,neumann,neumann,wall,wall,wall"; do
		read -r dim faces <<<"$row"
		pinit uniform -n 300 --dim $dim --faces $faces | p2m -n 19 >m
		poisson-mg <m >g
		for method in cg ssor-cg sor red-black-sor; do
			poisson-relax --method $method <m >r
			below "$(differ r g)" 1e-9 "$dim-D $faces $method"
		done
	done
}

@test "Jacobi is refused if its error does not decrease, with the names of methods that converge" {
	mesh >m
	run -1 --separate-stderr poisson-relax --method jacobi <m
	[[ $stderr == *"jacobi does not converge where no face fixes phi"*"use weighted-jacobi, red-black or cg, or poisson-fft --symbol fd2"* ]]
	mesh --faces wall >w
	run -2 --separate-stderr poisson-relax --method jacobi --relaxation 1.2 <w
	[[ $stderr == *"makes the error grow"*"take 1 or less"* ]]
	poisson-relax --method jacobi <w >r
	poisson-relax --method weighted-jacobi --relaxation 0.5 <m >r
	within "$(report r relaxation)" 0.5 0
}

@test "absorbing faces, and open ones beside others, are refused in a sentence that names poisson-fft" {
	mesh --faces wall | stab | sed 's/"wall","wall"/"absorbing","absorbing"/g' | stab - >m
	run -1 --separate-stderr poisson-relax <m
	[[ $stderr == *"axis x has absorbing faces, which belong to Maxwell's equations"* ]]
	run -1 --separate-stderr bash -c 'pinit uniform -n 0 --faces open,open,wall,wall,periodic,periodic | p2m -n 8 | poisson-relax >out'
	says="James' method needs open faces on all axes or on none, but axis y has wall ones (poisson-fft --free-space doubled mixes them)"
	[[ $stderr == *"poisson-relax: frame 1: $says"* ]]
}

@test "open faces: the inverse of the differences on the infinite lattice, as poisson-mg and poisson-fft have it" {
	for row in "plummer -n 500|20x17x24" "lamb-oseen|33x40" "plummer -n 300|13"; do
		pinit ${row%|*} | p2m -n "${row#*|}" --outside drop >m
		poisson-mg <m >g
		poisson-fft --symbol fd2 --green lattice <m >f
		field=phi
		[[ $row != lamb* ]] || field=psi
		for method in cg sor jacobi; do
			poisson-relax --method $method <m >r
			below "$(scmp --norm relative_l2 --field $field r g | tail -1 | cut -f8)" 1e-9 "$row $method, multigrid"
			below "$(scmp --norm relative_l2 --field $field r f | tail -1 |
				cut -f8)" 1e-7 "$row $method, transforms" # their table of the lattice's function, 1e-8
		done
	done
}

@test "phi is derived, carries the kernel of rho and replaces an older phi" {
	mesh | poisson-relax >a
	sh_ok 'sls <a | grep " phi "'
	[[ $output =~ phi\ +1\ f64\ derived\ value\ kernel\ cic ]]
	poisson-relax <a --no-history >b
	sh_ok 'sls <b | grep -c " phi "'
	[ "$output" = 1 ]
	run -0 scmp --tolerance 0 --field phi a b
}

@test "coefficient, source, target and mesh are those of the other solvers" {
	mesh >m
	poisson-relax --coefficient 1 --target chi <m | poisson-relax --source chi --target psi --coefficient -2 --mesh mesh >b
	poisson-mg --coefficient 1 --target chi <m | poisson-mg --source chi --target psi --coefficient -2 >c
	below "$(scmp --norm relative_l2 --field psi b c | tail -1 | cut -f8)" 1e-9
	run -1 --separate-stderr bash -c 'pinit uniform -n 10 | poisson-relax'
	[[ $stderr == "poisson-relax: frame 1: no field 'rho' on 'mesh' (p2m makes it"* ]]
	run -1 --separate-stderr poisson-relax --mesh other <m
	[[ $stderr == *"no mesh named other"* ]]
	run -2 --separate-stderr poisson-relax --target rho <m
	[[ $stderr == *"source and target are both 'rho'"* ]]
}

@test "sweeps, radius, its formula and the part removed are reported in the tail" {
	pinit uniform -n 200 --dim 2 --faces wall | p2m -n 32 | poisson-relax --method gauss-seidel >a
	within "$(report a radius_expected)" 0.990392640201615 1e-14 # cos^2(pi/32)
	within "$(report a radius)" 0.990392640201615 1e-6           # the next mode is 1e-10 of the first by then
	[ "$(report a status)" = converged ]
	[ -z "$(report a mean_removed)" ]
	mesh | poisson-relax >b
	within "$(report b mean_removed)" 1 1e-12
	mesh | poisson-fft >fft
	within "$(report b incompatible)" "$(tail -c 2048 fft | grep -ao '"incompatible":[^,}]*' | cut -d: -f2)" 1e-14
	[ -z "$(report b relaxation)" ] # conjugate gradients have none
	poisson-relax --method sor <a >c
	within "$(report c relaxation)" 1.82146519078902 1e-13       # 2/(1 + sin(pi/32))
	poisson-relax --tolerance 1e-18 <a >d
	[ "$(report d status)" = floor ]
}

@test "wrong options end before the input is read: exit 2, and what to type" {
	for wrong in "--method cg --relaxation 1.2" "--method x" "--tolerance -1" "--max-sweeps 0" "--relaxation 2" "--symbol fd2"; do
		run -2 --separate-stderr poisson-relax $wrong </dev/null
		[[ $stderr == poisson-relax:*--* ]]
	done
}

@test "too few sweeps are exit 3 with the history of the residual, and every later stage repeats it" {
	mesh >m
	run -3 --separate-stderr poisson-relax --method red-black --max-sweeps 20 <m
	[[ $stderr == *"red-black did not converge: 20 sweeps left a relative residual of"*"residual by sweep: 1: "*" 16: "*"--max-sweeps"*"poisson-fft"* ]]
	run -3 --separate-stderr bash -o pipefail -c 'poisson-relax --max-sweeps 2 <m | mgrad | sls'
	[[ $stderr == *"sls: stopped by poisson-relax: frame 1: cg did not converge"* ]]
}

@test "the result does not depend on earlier frames: after 1 and after 10 others" {
	mesh >a
	pinit uniform -n 50 --seed 3 --faces wall | p2m -n 9 >b
	pinit uniform -n 50 --seed 4 --dim 2 | p2m -n 16x12 >c
	for method in cg weighted-jacobi; do
		poisson-relax --method $method --no-history <a | stab | tail -n +2 | grep -v '^#' >alone
		cat b a | poisson-relax --method $method --no-history | stab | awk '/^#pmpipe/ { n++ } n == 2 && !/^#/' >second
		cat b c a b c b b c a c a | poisson-relax --method $method --no-history | stab | awk '/^#pmpipe/ { n++ } n == 11 && !/^#/' >eleventh
		[ -s alone ]
		same_as alone second
		same_as alone eleventh
	done
}

@test "the same bytes for 1, 2 and 3 threads, odd and even, in 2-D and 3-D" {
	for n in "-n 28" "-n 27x29x31" "--dim 2 -n 150" "--dim 2 -n 131x141"; do
		dim=${n%-n *}
		pinit uniform $dim | p2m ${n#"$dim"} >m
		for method in cg red-black-sor ssor-cg; do
			for t in 1 2 3; do poisson-relax --threads $t --tolerance 1e-3 --method $method <m >out.$t; done
			same_as out.1 out.2
			same_as out.1 out.3
		done
	done
}

@test "swapping the solver's word changes nothing else: a collapse, a cluster, two flows, a plasma" {
	local row words word other
	for row in "cold-collapse --dim 1 -n 128 --cells 32|push kick/2 drift, SOLVER, push kick/2" "shear-layer --cells 32|SOLVER, push rk2" \
		"plummer -n 500 --cells 20|push kick/2 drift, SOLVER, push kick/2" "lamb-oseen --cells 24|SOLVER, push lsrk3" \
		"langmuir -n 128 --cells 32|push kick/2 drift, SOLVER, push kick/2"; do
		words=${row#*|} words=${words//SOLVER/p2m | WORD | mgrad | m2p} words=${words//,/ |}
		for word in 'poisson-fft --symbol fd2' poisson-relax 'poisson-relax --method red-black-sor'; do
			pinit ${row%%|*} | cycle --no-history -n 3 "${words//WORD/$word}" >"out.${word: -3}"
		done
		for other in lax sor; do
			run -0 --separate-stderr scmp --tolerance 1e-7 --field x out.fd2 out.$other
		done
	done
}
