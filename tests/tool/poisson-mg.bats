# poisson-mg as a word: fields, options, reports, refusals. The numbers are in tests/physics and tests/unit. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

mesh() { pinit uniform -n 200 "$@" | p2m -n 12x8x10; }
report() { tail -c 2048 "$1" | grep -ao "\"poisson-mg[^}]*}" | tail -1 | grep -o "\"$2\":[^,}]*" | cut -d: -f2 | tr -d '"'; }

@test "phi is derived, carries the kernel of rho and replaces an older phi" {
	mesh | poisson-mg >a
	sh_ok 'sls <a | grep " phi "'
	[[ $output =~ phi\ +1\ f64\ derived\ value\ kernel\ cic ]]
	poisson-mg <a --no-history >b
	sh_ok 'sls <b | grep -c " phi "'
	[ "$output" = 1 ]
	run -0 scmp --tolerance 0 --field phi a b
}

@test "coefficient, source and target replace the law's" {
	mesh >m
	poisson-mg <m >a
	poisson-mg --coefficient 1 --target chi <m | poisson-mg --source chi --target psi --coefficient -2 >b
	sh_ok 'sls <b | grep -c "  chi \|  psi "'
	[ "$output" = 2 ]
	poisson-mg --coefficient -12.566370614359172 <m | stab --plain --mesh mesh | awk 'NR > 1 { print $NF }' >minus
	stab --plain --mesh mesh <a | awk 'NR > 1 { print $NF }' | paste - minus | awk '{ d = $1 + $2; if (d*d > m) m = d*d } END { print sqrt(m) }' >sum
	below "$(cat sum)" 1e-15 # the coefficient is 4 pi to the last digit
}

@test "cycles, residual, contraction, the part removed and the outcome are reported in the tail" {
	mesh >m
	poisson-mg <m >a
	within "$(report a cycles)" 8 4
	below "$(report a residual)" 1e-11
	within "$(report a contraction)" 0.1 0.1
	within "$(report a mean_removed)" 1 1e-12
	[ "$(report a status)" = converged ]
	mesh --faces wall | poisson-mg >b
	[ -z "$(report b mean_removed)" ]
	sh_ok 'sls --report <a | grep -c "poisson-mg.*cycles"'
}

@test "wrong options end before the input is read: exit 2, and what to type" {
	for wrong in "--smooth 2" "--smooth 1.5,2" "--smooth 2,2,2" "--smooth 0,0" "--cycle x" "--tolerance -1" "--max-cycles 0" "--symbol fd2"; do
		run -2 --separate-stderr poisson-mg $wrong </dev/null
		[[ $stderr == poisson-mg:*--* ]]
	done
}

@test "absorbing faces, open ones on some axes, and open ones around a permittivity are refused in a sentence that names poisson-fft" {
	source_of() { stab | sed 's/"wall","wall"/"'$1'","'$1'"/g' | stab -; } # the faces of the header, whatever p2m thinks of them
	mesh --faces wall | source_of absorbing >m
	run -1 --separate-stderr poisson-mg <m
	[[ $stderr == *"axis x has absorbing ones (use poisson-fft"* ]]
	pinit uniform -n 10 --faces wall,wall,open,open,wall,wall | p2m --outside drop -n 8 >m
	run -1 --separate-stderr poisson-mg <m
	[[ $stderr == *"poisson-mg: frame 1: multigrid needs open faces on all axes or on none, but axis x has wall ones (use poisson-fft)"* ]]
	pinit plummer -n 10 | p2m -n 16 | scalc --mesh mesh 'eps = 2' >m
	run -1 --separate-stderr poisson-mg --permittivity eps <m
	[[ $stderr == *"but these are open"*"poisson-fft"* ]]
}

@test "a missing field or mesh is exit 1 and says how to make it" {
	run -1 --separate-stderr bash -c 'pinit uniform -n 10 | poisson-mg'
	[[ $stderr == "poisson-mg: frame 1: no field 'rho' on 'mesh' (p2m makes it"* ]]
	mesh >m
	run -1 --separate-stderr poisson-mg --mesh other <m
	[[ $stderr == *"no mesh named other"* ]]
	run -2 --separate-stderr poisson-mg --target rho <m
	[[ $stderr == *"source and target are both 'rho'"* ]]
}

@test "too few cycles are exit 3 with the history of the residual, and every later stage repeats it" {
	mesh >m
	run -3 --separate-stderr poisson-mg --max-cycles 2 <m
	[[ $stderr == *"did not converge: 2 cycles left a relative residual of"*"--max-cycles"* ]]
	run -3 --separate-stderr bash -o pipefail -c 'poisson-mg --max-cycles 2 <m | mgrad | sls'
	[[ $stderr == *"sls: stopped by poisson-mg: frame 1: multigrid did not converge"* ]]
}

@test "the result does not depend on earlier frames: after 1 and after 10 others" {
	mesh >a
	pinit uniform -n 50 --seed 3 --faces wall | p2m -n 9 >b
	pinit uniform -n 50 --seed 4 --dim 2 | p2m -n 16x12 >c
	poisson-mg --no-history <a | stab | tail -n +2 | grep -v '^#' >alone
	cat b a | poisson-mg --no-history | stab | awk '/^#pmpipe/ { n++ } n == 2 && !/^#/' >second
	cat b c a b c b b c a c a | poisson-mg --no-history | stab | awk '/^#pmpipe/ { n++ } n == 11 && !/^#/' >eleventh
	[ -s alone ]
	same_as alone second
	same_as alone eleventh
}

@test "the same bytes for 1, 2 and 3 threads, odd and even, in 2-D and 3-D" {
	for n in "-n 60" "-n 55x57x61" "--dim 2 -n 400" "--dim 2 -n 395x401"; do
		dim=${n%-n *}
		pinit uniform $dim | p2m ${n#"$dim"} >m
		for t in 1 2 3; do poisson-mg --threads $t <m >out.$t; done
		same_as out.1 out.2
		same_as out.1 out.3
	done
}

@test "a cut stream, an empty one and a full disk are errors" {
	mesh >m
	run -1 --separate-stderr bash -c 'head -c 9000 m | poisson-mg >/dev/null'
	[[ $stderr == poisson-mg:* ]]
	run -1 --separate-stderr bash -c 'poisson-mg </dev/null >/dev/null'
	[[ $stderr == poisson-mg:* ]]
	run -1 --separate-stderr bash -c 'poisson-mg <m >/dev/full'
	[[ $stderr == poisson-mg:* ]]
}

@test "the residual after every cycle travels in the tail, and how far the data of a singular problem are from fitting" {
	mesh >m
	poisson-mg <m >a
	tail -c 2048 a | grep -ao '"residuals":"[^"]*"' | cut -d'"' -f4 | tr ' ' '\n' >history
	[ "$(wc -l <history)" = $(($(report a cycles | cut -d. -f1) + 1)) ]
	awk 'NR > 1 && !($1 < before) { exit 1 } { before = $1 } END { exit !($1 <= 1e-11) }' history
	below "$(report a incompatible)" 1
	run ! below "$(report a incompatible)" 1e-3 # rho has a mean of 1
	run -0 --separate-stderr bash -c 'poisson-mg --verbose <m >/dev/null'
	[[ $stderr == *"no solution exists for this 'rho' in this box: its mean 1"* ]]
}

@test "smoothers, cycles and both restrictions end at the same phi; order 4 at another" {
	differ() { scmp --norm relative_l2 --field phi "$1" "$2" | tail -1 | cut -f8; }
	mesh >m
	poisson-mg --no-history <m >a
	for o in "--smoother red-black" "--smoother jacobi" "--smoother four-colour" "--smoother sor --relaxation 1.2" "--restriction half" \
		"--cycle w --smooth 1,2"; do
		poisson-mg $o <m >b
		below "$(differ a b)" 1e-9 "$o"
	done
	poisson-mg --order 4 <m >b
	poisson-mg --order 4 --smoother jacobi --smooth 3,3 <m >c
	below "$(differ b c)" 1e-9
	run ! below "$(differ a b)" 1e-3
}

@test "options that exclude each other are exit 2, with those that can be combined" {
	for row in "--order 4 --smoother red-black:four-colour" "--order 4 --permittivity eps:leave out" "--order 3:2, 4" \
		"--permittivity eps --restriction half:leave out" "--smoother gs:sor"; do
		run -2 --separate-stderr poisson-mg ${row%%:*} </dev/null
		[[ $stderr == poisson-mg:*"${row#*:}"* ]]
	done
}

@test "a permittivity of 2 halves phi; one that is missing, not positive or a vector is refused with a remedy" {
	mesh --faces wall | scalc --mesh mesh 'eps = 2' >m
	poisson-mg --no-history <m | stab --plain --mesh mesh | awk 'NR > 1 { print $NF }' >whole
	poisson-mg --permittivity eps <m | stab --plain --mesh mesh | awk 'NR > 1 { print $NF }' | paste - whole >both
	awk '{ d = 2*$1 - $2; if (d*d > m) m = d*d; if ($2*$2 > b) b = $2*$2 } END { exit !(m < 1e-18*b && b > 0) }' both
	run -1 --separate-stderr poisson-mg --permittivity kappa <m
	[[ $stderr == *"no field 'kappa' on 'mesh' (scalc --mesh makes one"* ]]
	scalc --mesh mesh 'eps = x - 0.5' <m >n
	run -1 --separate-stderr poisson-mg --permittivity eps <n
	[[ $stderr == *"the permittivity must be positive everywhere, and at node 0,0,0 it is -0.5"* ]]
	scalc --mesh mesh 'w = 1, 2, 3' <m >n
	run -1 --separate-stderr poisson-mg --permittivity w <n
	[[ $stderr == *"'w' must have one component"* ]]
}

@test "with a permittivity and with order 4: the same bytes for 1, 2 and 3 threads, and after other frames" {
	pinit uniform --dim 2 | p2m -n 301x290 | scalc --mesh mesh 'eps = exp(6*sin(9*x)*cos(7*y))' >m
	pinit uniform --dim 2 --seed 4 | p2m -n 301x290 | scalc --mesh mesh 'eps = 1 + x' >other
	for o in "--permittivity eps --tolerance 1e-8" "--order 4" "--smoother jacobi --cycle v"; do
		for t in 1 2 3; do poisson-mg $o --threads $t --no-history <m >out.$t; done
		same_as out.1 out.2
		same_as out.1 out.3
		cat other m | poisson-mg $o --no-history | sel --frames 2 --no-history >second
		run -0 scmp --tolerance 0 --field phi out.1 second
	done
}

@test "a vector is solved component by component, with the faces each has" {
	pinit uniform -n 300 --faces wall | p2m -n 12x8x10 | scalc --mesh mesh 'A = rho, 2*rho, rho*x' >m
	poisson-mg --source A --target B <m >a
	poisson-fft --symbol fd2 --plan estimate --source A --target B <m >b
	below "$(scmp --norm relative_l2 --field B a b | tail -1 | cut -f8)" 1e-9
	tail -c 2048 a | grep -aq '"residuals_2"'
}

@test "Galerkin operators on the coarse grids: the same solution; in 1-D they are the direct ones, in the plane they reduce the residual further a cycle" {
	last() { sls --report | grep -o 'residuals":"[^"]*' | tr -d '"' | awk '{ print $NF / $(NF - 1) }'; }
	v() { poisson-mg --cycle v --tolerance 1e-10 "$@"; }
	for m in "--dim 1 --faces wall;96" "--dim 2 --faces wall,neumann,periodic,periodic;24x20" "--faces neumann,wall,periodic,periodic,wall,wall;12x8x10"; do
		pinit uniform -n 200 ${m%;*} | p2m -n "${m#*;}" >a
		poisson-mg --coarse galerkin <a >b
		poisson-mg <a | scmp --tolerance 1e-9 --field phi - b # both stop at 1e-11 of the residual
	done
	pinit uniform -n 200 --dim 1 --faces wall | p2m -n 64 >a
	for c in direct galerkin; do v --smoother jacobi --smooth 0,1 --coarse $c <a | sls --report | grep -o 'residuals":"[^"]*' >$c; done
	cmp <(cut -c 1-150 direct) <(cut -c 1-150 galerkin) # one matrix, of 3 points: the same to 4 digits of the first 12 cycles
	pinit uniform -n 200 --dim 2 --faces wall | p2m -n 64 >a
	within "$(v --smoother red-black --smooth 1,1 <a | last)" 0.115 0.01
	within "$(v --smoother red-black --smooth 1,1 --coarse galerkin <a | last)" 0.06 0.01
	run -1 --separate-stderr bash -c 'pinit plummer -n 9 | p2m -n 8 | poisson-mg --coarse galerkin'
	[[ $stderr == *"these are open (leave out --coarse galerkin)" ]]
	run -2 poisson-mg --coarse galerkin --order 4
	run -2 poisson-mg --coarse direct --permittivity eps
}
