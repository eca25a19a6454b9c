# scmp: norms of the difference of two streams. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

a() { printf 'x y z q_0 q_1 id\n0 0 0 3 4 1\n1 0 0 0 0 2\n' | stab - --no-history; }
b() { printf 'x y z q_0 q_1 id\n0 0 0 0 0 1\n1 0 0 0 2 2\n' | stab - --no-history; }
row() { awk -F'\t' -v f="$1" '$3 == f'; }

@test "the norms are those of the vector difference, the second stream is the reference" {
	a >a; b >b
	sh_ok 'scmp --field q a b | tail -1'
	# |d| = 5 and 2: l1 = 3.5, l2 = sqrt(29/2), max 5; |b| = 0 and 2
	IFS=$'\t' read -r frame on field n l1 l2 max rl2 rmax worst <<<"$output"
	[ "$frame $on $field $n $worst" = "1 matter q 2 1" ]
	within "$l1" 3.5 1e-9
	within "$l2" 3.8078865529 1e-9
	within "$max" 5 1e-9
	within "$rl2" 2.6925824036 1e-9 # sqrt(29)/2
	within "$rmax" 2.5 1e-9
}

@test "equal streams differ by nothing and pass a tolerance of 0" {
	pinit plummer -n 333 >a
	sh_ok 'scmp --tolerance 0 a a | awk "NR > 1 && (\$5 + \$6 + \$7 + \$8 + \$9 != 0)"'
	[ -z "$output" ]
	sh_ok 'scmp --tolerance 0 - a <a | tail -n +2 | cut -f3 | paste -sd,'
	[ "$output" = "time,x,v,mass,id" ]
}

@test "a tolerance that is exceeded is exit 1 and one line" {
	a >a; b >b
	run -1 --separate-stderr scmp --tolerance 1 --field q a b
	[ "$stderr" = "scmp: frame 1: 'q' on 'matter': relative_l2 is 2.693, above 1" ]
	run -0 scmp --tolerance 3 --field q a b
	for norm in l1 l2 max relative_max; do run -1 scmp --norm $norm -t 2.4 --field q a b; done
	run -0 scmp --norm l1 -t 3.5 --field q a b
}

@test "a tolerance is exceeded where only the reference is zero" {
	printf 'x q\n0 1e-200\n' | stab - >a
	printf 'x q\n0 0\n' | stab - >b
	run -1 scmp -t 1e9 --field q a b
	run -0 scmp -t 0 --field q b b
}

@test "differences of 1e-200 and 1e200 neither vanish nor overflow" {
	for e in 200 -200; do
		printf "x q\n0 1e$e\n0 3e$e\n" | stab - >a
		printf "x q\n0 2e$e\n0 2e$e\n" | stab - >b
		sh_ok 'scmp --field q a b | tail -1 | cut -f8'
		within "$output" 0.5 1e-12
	done
}

@test "integers beyond 2^53 are distinguished" {
	printf 'x k id\n0 1 9007199254740993\n' | stab - >a
	printf 'x k id\n0 1 9007199254740992\n' | stab - >b
	run -1 --separate-stderr scmp a b
	[[ "$stderr" == *"occurs only in the second"* ]]
	sh_ok 'scmp --by-index --field id a b | tail -1 | cut -f7'
	[ "$output" = 1 ]
}

@test "particles are matched by id, and by index with --by-index" {
	printf 'x mass id\n1 5 10\n2 6 -4\n3 7 12\n' | stab - >a
	printf 'x mass id\n3 7 12\n1 5 10\n2 6 -4\n' | stab - --box -1,7 --cells 32 >b
	run -0 scmp --set matter -t 0 a b
	run -1 scmp --set matter --by-index -t 0 a b
	printf 'x mass id\n3 7 12\n1 5 12\n2 6 -4\n' | stab - >b
	run -1 --separate-stderr scmp b b
	[[ "$stderr" == *"the id 12 occurs twice"* ]]
	run -1 --separate-stderr scmp a b
	[[ "$stderr" == *"the id 10 occurs only in the first"* ]]
}

@test "a mesh is compared with end points at half weight" {
	pinit lattice -n 27 | p2m -n 3 >a
	run -0 scmp --field rho -t 0 a a
}

@test "different shapes are refused in words" {
	pinit plummer -n 10 >a; pinit plummer -n 11 >b
	run -1 --separate-stderr scmp a b
	[ "$stderr" = "scmp: frame 1: 'matter' has 10 values in the first stream and 11 in the second" ]
	printf 'x q_0\n0 1\n' | stab - >a; printf 'x q_0 q_1\n0 1 1\n' | stab - >b
	run -1 --separate-stderr scmp a b
	[ "$stderr" = "scmp: frame 1: 'q' on 'matter' has 1 components in the first stream and 2 in the second" ]
	printf 'x y\n0 1\n' | stab - >b
	run -1 --separate-stderr scmp a b
	[ "$stderr" = "scmp: frame 1: the first stream has 1 dimensions, the second 2" ]
}

@test "a field that only one of them has is refused, or passed over with --common" {
	printf 'x q\n0 1\n' | stab - >a; printf 'x\n0\n' | stab - >b
	run -1 --separate-stderr scmp a b
	[ "$stderr" = "scmp: frame 1: 'q' on 'matter' is in the first stream only (--common skips it, --field chooses)" ]
	run -1 --separate-stderr scmp b a
	[[ "$stderr" == *"second stream only"* ]]
	run -0 scmp --common -t 0 a b
	run -1 --separate-stderr scmp --field acc a b
	[[ "$stderr" == *"no field 'acc'"* ]]
	run -1 scmp --set nobody a b
}

@test "a stream that is shorter than the other is exit 1" {
	pinit plummer -n 10 >a; cat a a >aa
	run -1 --separate-stderr scmp aa a
	[ "$stderr" = "scmp: 'a' ends after 1 frames, 'aa' has more" ]
	run -1 scmp a aa
	run -0 scmp -t 0 aa aa
}

@test "a set of no particles is equal to itself" {
	printf 'x mass\n' | stab - >a
	run -0 scmp -t 0 a a
}

@test "the result does not depend on the number of threads" {
	pinit plummer -n 20011 --seed 1 >a; pinit plummer -n 20011 --seed 2 >b
	scmp --threads 1 a b >one
	for n in 2 3; do scmp --threads $n a b | cmp - one; done
}

@test "a truncated, empty or missing input is exit 1; - given twice is exit 2" {
	pinit plummer -n 100 >a; head -c 3000 a >cut; : >empty
	for bad in cut empty /nonexistent; do run -1 scmp a $bad; run -1 scmp $bad a; done
	run -1 --separate-stderr scmp cut a
	[[ "$stderr" = "scmp: frame 1 of cut: the input ends in the data: "* ]]
	run -1 --separate-stderr scmp a cut
	[[ "$stderr" = "scmp: frame 1 of cut: the input ends in the data: "* ]]
	run -2 scmp - - <a
	run -2 scmp a
	run -1 bash -c 'scmp a a >/dev/full'
}
