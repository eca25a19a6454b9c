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

@test "cycles, residual, contraction, what was removed and how it ended travel in the tail" {
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

@test "open and absorbing faces are refused in a sentence that names poisson-fft" {
	source_of() { stab | sed 's/"wall","wall"/"'$1'","'$1'"/g' | stab -; } # the faces of the header, whatever p2m thinks of them
	mesh --faces wall | source_of absorbing >m
	run -1 --separate-stderr poisson-mg <m
	[[ $stderr == *"axis x has absorbing ones (use poisson-fft"* ]]
	run -1 --separate-stderr bash -c 'pinit plummer -n 10 | p2m -n 16 | poisson-mg'
	[[ $stderr == *"poisson-mg: frame 1: multigrid knows periodic, wall and neumann faces, and axis x has open ones (use poisson-fft, which has open faces)"* ]]
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

@test "too few cycles are exit 3 with the history of the residual, and every later stage says so too" {
	mesh >m
	run -3 --separate-stderr poisson-mg --max-cycles 2 <m
	[[ $stderr == *"did not converge: 2 cycles left a relative residual of"*"--max-cycles"* ]]
	run -3 --separate-stderr bash -o pipefail -c 'poisson-mg --max-cycles 2 <m | mgrad | sls'
	[[ $stderr == *"sls: stopped by poisson-mg: frame 1: multigrid did not converge"* ]]
}

@test "what came before leaves no trace: after 1 and after 10 other frames" {
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
