# smove: scales, turns, shifts and boosts particles. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

t() { printf 'x y z vx vy vz mass id\n1 2 3 4 5 6 7 8\n' | stab - --box -8,8 --cells 2 --law free --constant G=1; }
row() { stab --plain | awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) n[i] = $i; next } { for (i = 1; i <= NF; i++) print n[i], $i }' | sort | awk '{
	printf "%s%s", (NR > 1 ? " " : ""), $2 }'; }
# id mass vx vy vz x y z

@test "--shift, --boost and --scale change the fields that they name" {
	[ "$(t | smove --shift 10,20,30 | row)" = "8 7 4 5 6 11 22 33" ]
	[ "$(t | smove --boost -1,0,1 | row)" = "8 7 3 5 7 1 2 3" ]
	[ "$(t | smove --scale x=2,mass=0.5 | row)" = "8 3.5 4 5 6 2 4 6" ]
	[ "$(t | smove --scale x=2,v=3 --shift 1,1,1 --boost 1,1,1 | row)" = "8 7 13 16 19 3 5 7" ]
}

@test "--rotate turns x and v to the right about an axis, quarter turns exactly" {
	[ "$(t | smove --rotate z,90 | row)" = "8 7 -5 4 6 -2 1 3" ]
	[ "$(t | smove --rotate x,90 | row)" = "8 7 4 -6 5 1 -3 2" ]
	[ "$(t | smove --rotate y,-90 | row)" = "8 7 -6 5 4 -3 2 1" ]
	[ "$(t | smove --rotate z,180 | row)" = "8 7 -4 -5 6 -1 -2 3" ]
	pinit plummer -n 50 >a
	sh_ok 'smove --rotate z,30 <a | smove --rotate z,60 | smove --rotate z,-90 | scmp --set matter --tolerance 1e-15 - a' # a few roundings
	[ "$(printf 'x y\n1 0\n' | stab - | smove --rotate z,90 | row)" = "0 1" ]
}

@test "a periodic axis takes particles back, its upper end is its lower" {
	sh_ok 'printf "x\n0.5\n3.5\n" | stab - --box 0,4 --faces periodic | smove --shift 0.5 | stab --plain | tail -n +2 | paste -sd" "'
	[ "$output" = "1 0" ]
	sh_ok 'printf "x\n0\n" | stab - --box 0,4 --faces periodic | smove --shift -1e-17 | stab --plain | tail -1'
	[ "$output" = 0 ]
}

@test "a uniform field that is scaled within a cycle is read anew by the words behind it" {
	pinit plasma --length 1 | species electrons -n 1000 --vth 0.1 | smod --dt 0.001 >start
	for engine in fused pipes; do
		sh_ok "cycle --engine $engine --moves smove -q -n 3 'push kick drift | dt --plasma 0.2 | smove --scale charge=2 |
			p2m -n 64 | poisson-fft | mgrad | m2p' <start | sls | head -1 | grep -o 'dt [^ ]*'"
		[ "$output" = "dt 0.05" ] # the charge is twice as large after each of the two steps before
	done
}

@test "a uniform field stays uniform when it is scaled" {
	sh_ok 'pinit plummer -n 10 | smove --scale mass=2 | sls | grep mass'
	[[ "$output" == *"uniform 0.19"* ]]
}

@test "--set chooses among sets" {
	printf 'x v\n1 1\n' >t
	stab t --set a >a; stab t --set b >b
	sh_ok 'stack a b | smove --set b --shift 5 >c; stab --plain --set a <c | tail -1 | cut -f1; stab --plain --set b <c | tail -1'
	[ "${lines[0]}" = 1 ]
	[[ "${lines[1]}" == *6* ]]
}

@test "what was derived is dropped when particles move" {
	pinit plummer -n 50 | pp >a
	sh_ok 'smove --shift 1,0,0 <a | sls | grep -c " acc " || true'
	[ "$output" = 0 ]
}

@test "particles move between steps only" {
	pinit kepler | pp | push kick/2 drift >a
	run -1 --separate-stderr bash -c 'smove --shift 1,0,0 <a >/dev/null'
	[[ $stderr == *"particles, box and law can change only between steps (substep 1 here)"* ]]
}

@test "smod takes the same options, gives the same frames, and names in one line the word that replaces them" {
	t >a
	for o in '--shift 10,20,30' '--boost -1,0,1' '--rotate x,30' '--scale x=2,mass=0.5,box=2' \
		'--set matter --scale v=3 --rotate z,90 --shift 1,1,1 --boost 1,1,1'; do
		run -0 --separate-stderr bash -c "smod --no-history $o <a >old"
		[ "${#stderr_lines[@]}" = 1 ]
		[[ $stderr == *"smove"* ]]
		run -0 --separate-stderr bash -c "smove --no-history $o <a >new"
		[ -z "$stderr" ]
		cmp old new
	done
	run -0 --separate-stderr bash -c 'smod --shift 1,1,1 <a | sls --history'
	[[ $output == *'"shift":"1,1,1"'* && $output == *smod* ]]
}

@test "one set scaled leaves the other alone, also where both are stored anew" {
	printf 'x y mass\n1 1 1\n1 1 2\n' >t
	stab t --set a >a; stab t --set b >b
	sh_ok 'stack a b | smod --set b --scale mass=3 --store f32 | stab --plain --set a | tail -2 | cut -f3 | paste -sd" "'
	[[ ${lines[-1]} == "1 2" ]]
}

@test "wrong options are usage errors, missing things data errors, in one line" {
	t >a
	for o in '' '--set matter' '--shift 1,2' '--boost 1' '--rotate q,3' '--rotate z' '--scale x' '--scale x=q' '--scale box=-1'; do
		run -2 --separate-stderr bash -c "smove $o <a >/dev/null"
		[ "${#stderr_lines[@]}" = 1 ]
	done
	for o in '--set nobody --shift 1,1,1' '--scale q=2' '--scale id=2'; do
		run -1 --separate-stderr bash -c "smove $o <a >/dev/null"
		[ "${#stderr_lines[@]}" = 1 ]
	done
	run -2 bash -c 'printf "x y\n1 1\n" | stab - | smove --rotate x,3 >/dev/null'
	run -1 bash -c 'printf "x y\n1 1\n" | stab - | smove --boost 1,1 >/dev/null'
	run -3 bash -c 'smove --scale x=1e308 <a | smove --scale x=1e308 >/dev/null'
	head -c -200 a >cut
	run -1 bash -c 'smove --shift 1,1,1 <cut >/dev/null'
}

@test "a set of no particles is valid" { sh_ok 'printf "x y z\n" | stab - | smove --shift 1,1,1 --rotate z,5 | sls'; }
