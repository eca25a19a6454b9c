# scalc: new fields from expressions. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

t() { printf 'x y vx vy mass id\n1 2 3 4 5 6\n-1 0.5 0 0 1 7\n' | stab - --constant G=2.5 --faces periodic --box -4,4 --cells 2 --dt 0.5 --time 3; }
col() { stab --plain | awk -F'\t' -v n="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == n) c = i; next } { print $c }' | paste -sd' '; }

@test "expressions need little of the stack: a limit of 100 kB is enough" {
	[ -z "$PM_SANITIZED" ] || skip "a sanitizer needs more"
	pinit uniform -n 3000 >in
	for ranks in 1 2; do
		(ulimit -s 100 && scalc --ranks $ranks --threads 2 'q = x + y*z, max(x, y)' <in >small$ranks)
		scalc 'q = x + y*z, max(x, y)' <in >free
		scmp --tolerance 0 small$ranks free
	done
}

@test "a field is computed from others, several in the order given" {
	[ "$(t | scalc 'speed = hypot(vx, vy)' 'e = mass * speed^2 / 2 + G' | col e)" = "65 2.5" ]
}

@test "commas make the components of a vector" {
	sh_ok 'true'
	[ "$(t | scalc 'w = -y, x' | col w_0)" = "-2 -0.5" ]
	[ "$(t | scalc 'w = -y, x' | col w_1)" = "1 -1" ]
}

@test "numbers of the frame are names" {
	[ "$(t | scalc 'a = time + 10*dt + 100*n + 1000*dim + Lx + step' | col a)" = "2216 2216" ]
}

@test "a field that is there is rewritten, from its own values too, and keeps type and role" {
	sh_ok 't() { printf "x y id\n1 2 6\n"; }; t | stab - | scalc "x = y, x" "id = id + 1" | stab --plain | tail -1 | tr "\t" " "'
	[ "$output" = "2 1 7" ]
}

@test "what was derived is dropped when state changes, and kept when it does not" {
	pinit plummer -n 50 | pp >a || skip "pp is not there"
	sh_ok 'scalc "speed = hypot(vx,vy,vz)" <a | sls | grep -c " acc "'
	sh_ok 'scalc "mass = 2 * mass" <a | sls | grep -cE " acc | phi " || true'
	[ "$output" = 0 ]
	run -1 --separate-stderr bash -c 'scalc "e = phi" "mass = 2 * mass" <a >/dev/null; pm=$?; scalc "acc = x,y,z" <a >/dev/null; exit $pm'
}

@test "--role, --extensive, --unit and --type describe the new field" {
	sh_ok 't() { printf "x\n1.75\n"; }
		t | stab - | scalc --extensive --unit C "charge = -x" | scalc --type i64 --role state "k = x" | scalc --type f32 "r = x / 3" | sls'
	[[ "$output" == *"charge      1 f64 state strength [C]"* ]]
	[[ "$output" == *"k           1 i64 state value"* ]]
	[[ "$output" == *"r           1 f32 derived value"* ]]
	sh_ok 'printf "x\n1.75\n-0.5\n" | stab - | scalc --type i64 "k = x" | stab --plain | tail -n +2 | cut -f2 | paste -sd" "'
	[ "$output" = "1 -1" ]
}

@test "a mesh field is computed with the coordinates of its points" {
	sh_ok 'printf "x\n0\n" | stab - --box 0,1 --cells 4 | scalc --mesh mesh "f = x^2" | stab --plain --mesh mesh | tail -n +2 | cut -f2 | paste -sd" "'
	[ "$output" = "0 0.0625 0.25 0.5625 1" ]
}

@test "--set chooses among sets, all are computed without" {
	printf 'x\n1\n' | stab - --set a >a; printf 'x\n1\n' | stab - --set b >b
	sh_ok 'stack a b | scalc "q = x" | sls | grep -c " q "'
	[ "$output" = 2 ]
	sh_ok 'stack a b | scalc --set b "q = x" | sls | grep -c " q "'
	[ "$output" = 1 ]
}

@test "--total: a field is the sum over the particles, or over those with the same value of --per; the same bytes for any ranks and threads" {
	[ "$(t | scalc --total 'm = mass*x' 'two = 2*m' | col m)" = "4 4" ]
	[ "$(t | scalc --total 'm = mass*x' 'two = 2*m' | col two)" = "16 16" ]
	pinit uniform -n 9000 >a
	scalc --total 's = x' <a | col s | tr ' ' '\n' | sort -u >b
	[ "$(wc -l <b)" = 1 ]
	within "$(cat b)" "$(stab --plain <a | column x | awk '{ s += $1 } END { printf "%.17g", s }')" 1e-8
	scalc --role state 'g = mod(id, 3)' <a | scalc --total --per g 'k = 1' 's = id' >c
	[ "$(paste -d' ' <(stab --plain c | column g) <(stab --plain c | column k) <(stab --plain c | column s) | sort -u | paste -sd' ')" = \
		"0 3000 13495500 1 3000 13498500 2 3000 13501500" ]
	for n in 1 2 3; do
		cycle -q -n 2 --ranks $n "push drift | scalc --total 'k = x + y'" --no-history <a | cksum
		OMP_NUM_THREADS=$n cycle -q -n 2 "push drift | scalc --total 'k = x + y'" --no-history <a | cksum
	done | sort -u >sums
	[ "$(wc -l <sums)" = 1 ]
	run -2 scalc --per id 'k = 1' <a
	run -1 --separate-stderr bash -c "scalc --total --per x 'k = 1' <a | sls"
	[[ $stderr == *"'x' on 'matter' is a vector, but --per needs one number a particle"* ]]
	run -1 --separate-stderr bash -c "scalc --total --per none 'k = 1' <a | sls"
	[[ $stderr == *"no field 'none' on 'matter' for --per (sls lists the fields)"* ]]
	run -1 --separate-stderr bash -c "scalc --total 'id = 1' <a | sls"
	[[ $stderr == *"holds whole numbers, but --total needs a real field"* ]]
}

@test "a set of no particles is valid" { sh_ok 'printf "x\n" | stab - | scalc "q = 1/x" | sls | grep " q "'; }

@test "errors are one line that names the column; syntax exits 2, unknown names 1, what is not finite 3" {
	t >a
	check() { run "-$1" --separate-stderr bash -c "scalc '$2' <a >/dev/null"; [ "${#stderr_lines[@]}" = 1 ]; [[ "$stderr" == *"$3"* ]]; }
	check 2 'q = 1 +' 'column 5: the expression stops here'
	check 2 'q = (x' "expected ')'"
	check 2 'q = sqr(x)' "no function 'sqr'"
	check 1 'q = nothing' "no field or number 'nothing'"
	check 2 'q' "is not NAME = EXPRESSION"
	check 2 'q == 1' "is not NAME = EXPRESSION"
	check 1 'x = 1' "has 2 components, here are 1"
	check 3 'q = 1 / (x - 1)' "'q' of 'matter' is not finite"
	run -1 bash -c "scalc --set nobody 'q = 1' <a >/dev/null"
	run -1 bash -c "scalc --mesh nowhere 'q = 1' <a >/dev/null"
	run -3 bash -c "scalc --type i64 'q = 1e300' <a >/dev/null"
	run -2 bash -c "scalc <a >/dev/null"
}

@test "the result does not depend on the number of threads" {
	pinit plummer -n 5000 >a
	scalc --no-history --threads 1 'q = sin(x)*exp(-y^2)' <a >one
	for n in 2 3; do scalc --no-history --threads $n 'q = sin(x)*exp(-y^2)' <a | cmp - one; done
	head -c 5000 a >cut
	run -1 bash -c "scalc 'q = 1' <cut >/dev/null"
}

@test "names may have letters of any alphabet, and the column of an error counts letters" {
	printf 'x y größe\n0 0 2\n' | stab - >a
	sh_ok "scalc 'ö = größe + 1' 'π2 = 2 * ö' <a | stab --plain"
	[ "${lines[0]}" = $'x\ty\tgröße\tö\tπ2' ]
	[ "${lines[1]}" = $'0\t0\t2\t3\t6' ]
	run -1 --separate-stderr bash -c "scalc 'a = größe + ü' <a"
	[[ $stderr == "scalc: frame 1: column 10: no field or number 'ü' "* ]]
}
