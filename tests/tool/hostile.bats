# Nothing but the sentence is ever parsed by a shell: values of options, names of directories, tables and streams that a stranger made are data.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

export OMP_NUM_THREADS=1

# untouched COMMAND...: runs it, ignoring its output; afterwards there must be no file called `touched`.
untouched() {
	run timeout 60 "$@"
	[ "$status" -lt 124 ] || { echo "$* hangs: $output"; return 1; }
	[ -z "$(find . "$top" -maxdepth 1 -name 'touched*')" ] || { echo "$*: ran a command: $output"; return 1; }
}
attacks=('acc; touch touched' '$(touch touched)' '`touch touched`' "a' | touch touched; '" 'a" | touch touched; "' 'a | touch touched' '>touched' \
	'a&touch touched' $'a\ntouch touched')
# The first four get out of every kind of quoting; the others only look different, and run in check-long and at one place of each test.
few=('$(touch touched)' "a' | touch touched; '" 'a" | touch touched; "' $'a\ntouch touched')
[ -z "${PM_LONG:-}" ] || few=("${attacks[@]}")
spring='printf "x vx\n1 0\n" | stab - --law free | cycle -n 20 "push --dt {dt} kick/2 drift | field acc=-x | push kick/2"'

@test "pareto: --field and --set are names, whatever characters they contain, with --jobs and with exact numbers too" {
	for a in "${attacks[@]}"; do
		untouched pareto 'pinit uniform -n 9 | p2m -n {4,8} | poisson-fft | mgrad | m2p' --against finest --field "$a" --repeat 1 -o d --fresh
	done
	for a in "${few[@]}"; do
		untouched pareto 'pinit uniform -n 9 | p2m -n {4,8} | poisson-fft | mgrad | m2p' --against finest --set "$a" --jobs 2 -o d --fresh
		untouched pareto 'pinit two-body | cycle -n {1,2} "push kick/2 drift | pp | push kick/2"' --against exact --field "$a" --repeat 1 -o d --fresh
	done
}

@test "margin: --column, --unstable-when and --expect are names and arithmetic" {
	for a in "${attacks[@]}"; do
		untouched margin "$spring" --vary dt:0.5:4 --tolerance 0.5 --unstable-when 'distance_max > 100' --column "$a" -o d --fresh
	done
	for a in "${few[@]}"; do
		untouched margin "$spring" --vary dt:0.5:4 --tolerance 0.5 --unstable-when "$a" -o d --fresh
	done
	for a in '1); print 1 > "touched"; (1' '1) > "touched"; (1' '1) | "touch touched"; (1' 'system("touch touched")' '"{dt}" > "touched"'; do
		untouched margin "$spring" --vary dt:0.5:4 --tolerance 0.5 --unstable-when 'distance_max > 100' --expect "$a" -o d --fresh
		[[ $status = 2 ]]
	done
}

@test "a value of --vary is one word, or text between the quotes that the sentence has there" {
	values=('acc; touch touched' '$(touch touched)' "'; touch touched; '" '"; touch touched; "')
	[ -z "${PM_LONG:-}" ] || values+=('`touch touched`' 'cat | touch touched' 'a&touch touched' '>touched')
	for a in "${values[@]}"; do
		for s in 'pinit uniform -n 9 | sel --set {k}' 'pinit uniform -n 9 | sel --set "{k}"' "pinit uniform -n 9 | sel --set '{k}'" \
			'pinit uniform -n $(echo {k})' 'pinit uniform -n 9 | cycle -n 1 "{k}"' '{k}' \
			'pinit uniform -n "$(echo "{k}")"'; do
			untouched pareto "$s" --against finest --vary "k=$a,b" --repeat 1 -o d --fresh
			untouched margin "$s | p2m -n {n}" --vary n:1:3 --vary "k=$a,b" -o d --fresh
		done
	done
	[ "$(pareto 'a {k} "x {k}" '"'y {k}'" --against finest --vary 'k=p q,r' --list)" = "a 'p q' \"x p q\" 'y p q'"$'\n'"a r \"x r\" 'y r'" ]
	[ "$(pareto 'a {k}' --against finest --vary "k=it's,{k}" --list)" = "a 'it'\\''s'"$'\n'"a '{k}'" ]
	run -0 pareto 'pinit uniform -n 9 | scalc "a = {k}"' --against finest --vary 'k=x*(y+1),(2 - x)' --field a --repeat 1 --tsv -q
	! grep -q failed <<<"$output"
}

@test "what a sentence with \$( ) runs, it runs where the sentence runs, and not before" {
	untouched pareto 'pinit uniform -n {$(touch touched; echo 8),16}' --against finest --list
	untouched margin 'pinit uniform -n {$(touch touched; echo 8),16} {a}' --vary a:1:2 --list
}

@test "a temporary directory may have any name" {
	for a in "it's" 'a "quote" $(touch touched) b' 'a;touch touched|touch touched|b&c' 'x=1' '-n' 'a\b sp ace'; do
		mkdir -p -- "$PWD/$a"
		TMPDIR=$PWD/$a run -0 pareto 'pinit uniform -n 9 | p2m -n {4,8} | poisson-fft | mgrad | m2p' --against finest --field acc --repeat 1
		[[ $output != *failed* ]] || { echo "$a: $output"; return 1; }
		TMPDIR=$PWD/$a run -0 pareto 'pinit uniform -n 9 | p2m -n {4,8} | poisson-fft | mgrad | m2p' --against finest --field acc --jobs 2
		[[ $output != *failed* ]] || { echo "$a: $output"; return 1; }
		TMPDIR=$PWD/$a run -0 margin "$spring | cycle -n 1 'push drift'" --vary dt:0.5:9 --tolerance 0.5 --unstable-when 'distance_max > 100'
		[ -z "$(find . -name 'touched*')" ]
	done
	for a in 'x=1' '-n' "it's"; do
		run -0 pareto 'pinit uniform -n 9 | p2m -n {4,8} | poisson-fft | mgrad | m2p' --against finest --field acc --repeat 1 -o "$a"
		[ -s "./$a/pareto.tsv" ]
		run -0 margin "$spring" --vary dt:0.5:9 --tolerance 0.5 --unstable-when 'distance_max > 100' -o "$a.margin"
		[ -s "./$a.margin/margin.tsv" ]
	done
}

@test "results kept in a directory are data: invalid lines are reported and left out" {
	margin "$spring" --vary dt:0.5:9 --tolerance 0.5 --unstable-when 'distance_max > 100' -o d --format tsv >want
	cp d/measured/log log
	{
		printf 'trial\ta[$(touch touched)]\t1\t0.5\tstable\t-\t-\ngrowth\t0\t1\tEND\t1\t2\n'
		printf 'growth\t0\t1\t1\tEND;system "touch touched"\t2\ntrial\t0\t1\t`touch touched`\tstable\t-\t-\ntrial\t0'
	} >>d/measured/log
	untouched margin "$spring" --vary dt:0.5:9 --tolerance 0.5 --unstable-when 'distance_max > 100' -o d --format tsv
	[[ $output == "margin: 5 lines of 'd/measured/log' are no results of margin and are left out"* ]]
	[ "$(tail -n +2 <<<"$output")" = "$(cat want)" ]
	cmp log d/measured/log
	pareto 'pinit uniform -n 9 | p2m -n {4,8} | poisson-fft | mgrad | m2p' --against finest --field acc --repeat 1 -o p --tsv >want
	cp p/measured/log log
	printf 'time\ta[$(touch touched)]\t1\t2\t3\t4\nerror\t$(touch touched)\t1\t1\t1\t1\t1\t1\nbad' >>p/measured/log
	untouched pareto 'pinit uniform -n 9 | p2m -n {4,8} | poisson-fft | mgrad | m2p' --against finest --field acc --repeat 1 -o p --tsv
	[[ $output == "pareto: 3 lines of "* ]]
	cmp log p/measured/log
}
