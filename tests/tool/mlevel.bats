# mlevel: the pieces of a two-grid cycle (000:S32 to S35). SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

relax() { poisson-relax --method weighted-jacobi --sweeps "${1-1}" ${2-}; }
coarse() { poisson-fft --symbol fd2 --mesh coarse --coefficient 1 --source residual --target error; }
two() { relax "${1-1}" | mlevel restrict | coarse | mlevel prolong; }
size() { stab --plain --mesh mesh | awk 'NR > 1 { s += $3^2 } END { printf "%.15g\n", sqrt(s / 32) }'; }
left() { sls --report | sed -n 's/.*mlevel residual.*"residual":\([^,}]*\).*/\1/p'; }

@test "a sweep and a two-grid cycle leave of every sine what they must by formula" {
	pinit uniform --dim 1 --faces wall -n 2 | p2m -n 64 >a
	for k in 1 16 31 33 48 63; do
		scalc --mesh mesh 'rho = 0' "phi = sin($k*pi*x)" <a >b
		s=$(calc "sin($k*atan2(0,-1)/128)^2") w=$(calc "1-4/3*sin($k*atan2(0,-1)/128)^2")
		within "$(relax <b | size)" "${w#-}" 1e-13
		within "$(two <b | size)" "$(calc "${w#-}*sqrt(2)*$s")" 1e-13
	done
}

@test "cycles converge to the solution of the differences by the factor of two grids, in 1-D to 3-D, at walls, neumann and periodic faces" {
	# V(1,1) of weighted Jacobi: (1/3)^2 = 0.11, 0.36 and 0.51 at most: the squares of the best factors 1/3, 3/5, 5/7
	for m in "1 wall 64 0.12" "1 neumann,wall 64 0.12" "2 periodic 32 0.37" "2 wall,neumann,periodic,periodic 32 0.37" "3 neumann 12 0.52"; do
		set -- $m
		pinit uniform --dim $1 -n 100 --faces $2 | p2m -n $3 >a
		cp a b
		r=()
		for i in 1 2 3 4 5; do
			two <b | relax | mlevel residual >c
			r+=("$(left <c)")
			mv c b
		done
		below "$(calc "${r[4]}/${r[3]}")" $4 "$m"
		poisson-fft --symbol fd2 <a >exact
		below "$(scmp --tolerance 1 --field phi b exact | column relative_l2)" 0.05 "$m"
	done
}

@test "a solved potential has no residual, also with boundary values, which every piece on the mesh is given" {
	pinit uniform --dim 2 -n 100 --faces wall,neumann,neumann,wall | p2m -n 16x20 >a
	for g in "" "--dirichlet 1+x --flux y"; do
		below "$(poisson-fft --symbol fd2 $g <a | mlevel residual $g | left)" 1e-13
		relax 2 "$g" <a | mlevel restrict $g | coarse | mlevel prolong $g | relax 2 "$g" | mlevel residual $g >b
		above "$(relax 4 "$g" <a | mlevel residual $g | left)" "$(left <b)"
	done
	within "$(mlevel residual <a | left)" 1 1e-15 # no phi yet: all of c s
}

@test "three levels typed: the coarse equation relaxed and corrected on a coarser mesh" {
	pinit uniform --dim 1 -n 100 --faces wall | p2m -n 64 >a
	on="--mesh coarse --source residual --target error --coefficient 1"
	relax <a | mlevel restrict | poisson-relax --method weighted-jacobi --sweeps 1 $on | mlevel restrict $on --coarse coarser --residual r2 |
		poisson-fft --symbol fd2 --mesh coarser --coefficient 1 --source r2 --target e2 | mlevel prolong $on --coarse coarser --error e2 |
		poisson-relax --method weighted-jacobi --sweeps 1 $on | mlevel prolong | relax | mlevel residual | left >three
	two <a | relax | mlevel residual | left >two
	within "$(cat three)" "$(cat two)" "$(calc "0.5*$(cat two)")" # as good as an exact coarse solution, but for a part
}

@test "what it cannot do is refused in one line: open faces, odd cells, pieces that are not there" {
	run -1 --separate-stderr bash -c 'pinit plummer -n 9 | p2m -n 8 | mlevel residual'
	[[ ${#stderr_lines[@]} = 1 && $stderr == *"axis x has open faces"*"poisson-mg"* ]]
	run -1 --separate-stderr bash -c 'pinit plummer -n 9 | p2m -n 8 | poisson-relax --sweeps 2'
	[[ ${#stderr_lines[@]} = 1 && $stderr == *"--sweeps needs faces that give values"* ]]
	run -1 --separate-stderr bash -c 'pinit uniform -n 9 --faces wall | p2m -n 8x9x8 | mlevel restrict'
	[[ $stderr == *"axis y has 9 cells"* ]]
	pinit uniform -n 9 --faces wall | p2m -n 8 >a
	run -1 --separate-stderr mlevel prolong <a
	[[ $stderr == *"no mesh named coarse (mlevel restrict makes it)" ]]
	mlevel restrict <a >b
	run -1 --separate-stderr mlevel prolong <b
	[[ $stderr == *"no field 'phi' on 'mesh' to correct"* ]]
	relax <b >c
	run -1 --separate-stderr mlevel prolong <c
	[[ $stderr == *"no field 'error' on 'coarse' (poisson-fft"* ]]
	run -2 mlevel smooth
}
