# digits and perturb: what the last bit of the input and the rounding leave of a result. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# found QUANTITY COLUMN: the number in that column of digits' table (out) in the last line of the quantity.
found() { awk -F'\t' -v q="$1" -v c="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == c) k = i } $2 == q { x = $k } END { print x }' out; }

@test "perturb moves every number of the state by one unit in the last place, up or down, and nothing else" {
	pinit plummer -n 500 >a
	perturb <a >b
	same_as <(perturb <a | stab) <(perturb --threads 1 <a | stab)
	# one unit in the last place is 1.1e-16 to 2.2e-16 of a number
	between "$(scmp --field x a b | column relative_l2)" 1.1e-16 2.3e-16
	[ "$(scmp --field mass,id a b | awk -F'\t' 'NR > 1 && $7 != 0' | wc -l)" = 0 ]
	sel --field x <a | stab --plain | tail -n +2 >xa
	sel --field x <b | stab --plain | tail -n +2 >xb
	between "$(paste xa xb | awk '$4 > $1 { up++ } END { print up }')" 200 300 # 250 +- 4.5 deviations
	[ "$(paste xa xb | awk '$4 == $1 || $5 == $2' | wc -l)" = 0 ]
	run -1 cmp -s <(perturb --seed 2 <a) b
	within "$(perturb --relative 1e-3 <a | scmp --field v - a | column relative_l2)" 1e-3 1e-15
}

@test "perturb keeps a periodic box, f32 as f32, and refuses where there is nothing to move or a step is under way" {
	pinit uniform -n 1000 --box 0,0,0,1,1,1 | smod --store f32 >a
	between "$(perturb <a | scmp --field x - a | column relative_l2)" 3e-8 1.3e-7 # a unit of f32 is 6e-8 to 1.2e-7 of a number
	run -1 bash -c 'pinit lattice -n 8 | perturb --field mass'
	[[ $output = *'no field of role state'* ]]
	run -1 bash -c 'pinit two-body | push drift/2 | perturb'
	[[ $output = *'in the middle of a step'* ]]
}

@test "the rounding is PM_ROUNDING's in every thread, and other words are refused" {
	pinit plummer -n 20000 >a
	for m in up down zero; do
		PM_ROUNDING=$m p2m --threads 1 <a | PM_ROUNDING=$m poisson-fft --threads 2 >"$m.1"
		PM_ROUNDING=$m p2m --threads 2 <a | PM_ROUNDING=$m poisson-fft --threads 1 >"$m.2"
		same_as "$m.1" "$m.2"
	done
	run -1 cmp -s up.1 down.1
	PM_ROUNDING=sideways run -2 sls a
	[[ $output = *"PM_ROUNDING is 'sideways' (nearest, up, down or zero)"* ]]
}

@test "digits are those of Vignes: log10(sqrt(n) |mean| / (t s)) of the run as it is and the four with moved input, t = 2.776 for 95 %" {
	printf 'x a\n1 2.5\n' >t
	digits --format tsv --relative 1e-3 'stab t | stab --plain' >out
	for s in 1 2 3 4; do stab t | perturb --seed $s --relative 1e-3 | stab --plain | tail -n 1; done | awk '
		{ v[NR] = $1 } END { # x: 1 and four numbers 1 +- 1e-3
			v[5] = 1; for (i = 1; i <= 5; i++) m += v[i] / 5
			for (i = 1; i <= 5; i++) s += (v[i] - m) ^ 2 / 4
			print log(sqrt(5) * m / (2.776 * sqrt(s))) / log(10) }' >wanted
	within "$(found x input)" "$(cat wanted)" 0.051 # the table has one decimal
	above "$(found x rounding)" 15
}

@test "digits: cancellation leaves none of the variance of 1e8 + {1, 2, 3}, and all of its two-pass form" {
	digits --runs 12 --format tsv 'printf "x a b c\n1 100000001 100000002 100000003\n" | stab - |
		scalc "m = (a+b+c)/3" | scalc "w = (a^2+b^2+c^2)/3 - m^2" "u = ((a-m)^2+(b-m)^2+(c-m)^2)/3" | stab --plain' >out
	below "$(found w digits)" 0
	above "$(found a digits)" 15
	# the input moved by 1.5e-8 in differences of 1: 7 to 8 digits, but by the same in all three it is all: twelve runs
	between "$(found u digits)" 6.5 9
	above "$(found u rounding)" 15
}

@test "digits: the runs of Muller's recurrence agree on 100, which is wrong; worst remembers that they had lost all" {
	# u = 108 - (815 - 1500/u'')/u' from 4, 4.25 tends to 5; an error grows twentyfold each step, and leads to 100
	digits --format tsv --all --columns time --fields b 'printf "x vx a b\n0 0 4 4.25\n" | stab - --law free --dt 1 |
		cycle -n 30 --every 1 "scalc --role state \"c = 108 - (815 - 1500/a)/b\" | scalc \"a = b\" \"b = c\" | push drift"' >out
	above "$(found matter.b digits)" 15
	below "$(found matter.b worst)" 0
	# log10 20 = 1.30 digits are lost each step
	within "$(awk -F'\t' '$2 == "matter.b" { d[$1] = $4 } END { print (d[3] - d[11]) / 8 }' out)" 1.301 0.03 # the table has one decimal
}

@test "digits: a cluster loses digits with time, f32 has seven, --least ends in exit 3" {
	digits --f32 --format tsv --all --columns time --fields x 'pinit plummer -n 40 |
		cycle -n 400 --every 100 "push kick/2 drift | pp | push kick/2"' >out
	between "$(awk '$2 == "matter.x" && $1 == 2 { print $4 }' out)" 12 15.5
	below "$(found matter.x worst)" "$(awk '$2 == "matter.x" && $1 == 2 { print $4 - 1 }' out)"
	between "$(awk '$2 == "matter.x" && $1 == 1 { print $6 }' out)" 7 8
	run -3 digits --least 12 --columns momentum_x --fields none 'pinit plummer -n 40 | pp'
	[[ $output = *'fewer than 12 digits: momentum_x'* ]]
}

@test "digits refuses what it cannot move, and hands on the reason of a run that fails" {
	run -2 digits 'diag -i a'
	[[ $output = *"the sentence begins with 'diag', whose input cannot be moved (cat FILE | diag ...)"* ]]
	run -1 digits 'pinit plummer -n 3 | mgrad'
	[[ $output = *"fails: mgrad: frame 1"* ]]
	run -2 digits --runs 1 'pinit plummer'
	touch there.is.a.file
	run -1 digits --columns '$(rm there*)' --fields '; rm there*' 'pinit plummer -n 3'
	[ -e there.is.a.file ]
	mkdir 'a b*'
	TMPDIR=$PWD/'a b*' digits --runs 2 --columns mass --fields x 'pinit plummer -n 3 | pp' >out
	[ -z "$(ls 'a b*')" ]
	run -2 digits --f32 'pinit plummer -n 3 | cycle "push drift" -n 1'
	[[ $output = *'the sentence of cycle is not the last argument'* && $output != *fails* ]]
}

@test "digits that is stopped ends its runs and leaves nothing behind" {
	mkdir there
	TMPDIR=$PWD/there setsid digits 'pinit plummer -n 3000 | cycle -n 100000 "push kick/2 drift | pp | push kick/2"' >out 2>err &
	digits=$!
	for _ in {1..50}; do [ -z "$(ls there)" ] && sleep 0.1 || break; done
	sleep 0.3
	kill -TERM $digits
	wait $digits && status=0 || status=$?
	[ $status = 130 ]
	grep -q '^digits: stopped; ' err
	[ -z "$(ls there)" ]
	for _ in {1..50}; do # a process takes its time to end
		run pgrep -f 'cycle -n 100000 push kick/2 drift . pp'
		[ "$status" = 0 ] || break
		sleep 0.1
	done
	[ "$status" = 1 ]
}
