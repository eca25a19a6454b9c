# p2m: deposition, meshes, sets, refusals.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
load words

# line FACES CELLS: the particles of the table on standard input in the box 0..4 of one axis.
line() { stab - --law gravity --box 0,4 --faces "$1" --particle-faces open -n "$2"; }

# mesh: the values of the first mesh field, one line.
mesh() { stab --plain --mesh mesh | awk 'NR > 1 { printf "%s%s", (NR > 2 ? " " : ""), $NF } END { print "" }'; }

two='x vx mass\n1.25 0 2\n2.75 0 1\n'

@test "particles of two sets on all nodes: the second set is added to the first" {
	awk 'BEGIN { print "x y mass vx vy"; for (j = 0; j < 20; j++) for (i = 0; i < 20; i++) print i / 4, j / 4, 1, 0, 0 }' |
		stab - --law gravity --box 0,5 --faces periodic -n 20 --dt 0.1 >one
	[ "$(stack --as one,other one one | p2m --kernel m4prime | mesh | tr ' ' '\n' | sort | uniq -c | tr -s ' ')" = ' 400 32' ]
}

@test "p2m --add where there is no density yet begins at zero" {
	pinit uniform --cells 8 -n 300 --no-history >in
	p2m --no-history in | mesh >want
	for options in --add '--add --field other'; do
		MALLOC_PERTURB_=165 p2m $options --no-history in | mesh | diff - want
	done
}

@test "p2m needs no options: the law's strength goes to its density on the default mesh with its kernel" {
	sh_ok 'pinit uniform -n 50 | p2m | sls'
	[[ $output =~ rho\ +1\ f64\ derived\ value\ \[mass/length\^3\]\ kernel\ cic ]]
}

@test "p2m divides by the cell volume and counts end nodes of neumann faces twice" {
	# cells of length 1; 0.3 from a neumann face: 0.7 * 2 on the end node at half weight is 2.8
	run -0 bash -c "printf 'x vx mass\n0.3 0 2\n2.75 0 1\n' |
		stab - --law gravity --box 0,4 --faces neumann --particle-faces reflect -n 4 | p2m | stab --plain --mesh mesh"
	[ "$(tail -n +2 <<<"$output" | cut -f 2 | tr '\n' ' ')" = "2.8 0.6 0.25 0.75 0 " ]
	# cells of length 1/2: twice the density
	[ "$(printf "$two" | line open 8 | p2m | mesh)" = "0 0 2 2 0 1 1 0 0" ]
}

@test "p2m: every kernel conserves the total strength, odd and even cells, 1-D to 3-D" {
	for kernel in ngp cic tsc pcs m4prime; do
		for dim in 1 2 3; do
			total=$(pinit uniform -n 99 --dim $dim | p2m --kernel $kernel -n "$(cut -d x -f 1-$dim <<<11x8x9)" | stab --plain --mesh mesh |
				awk 'NR > 1 { s += $NF; n++ } END { printf "%.17g", s / n }')
			within "$total" 1 1e-13 "$kernel in $dim-D" # 792 values, each with a few roundings
		done
	done
}

@test "p2m replaces the density, and adds to it with --add" {
	pinit uniform -n 20 | p2m -n 6 >a
	same_as <(p2m --no-history <a) a
	once=$(stab --plain --mesh mesh <a | awk 'NR > 1 { s += $NF } END { printf "%.15g", s }')
	twice=$(p2m --add <a | stab --plain --mesh mesh | awk 'NR > 1 { s += $NF } END { printf "%.15g", s }')
	within "$twice" "$(awk -v s="$once" 'BEGIN { printf "%.15g", 2 * s }')" 1e-10
	run ! bash -c 'p2m --add --kernel tsc <a'
	[[ $output =~ "kernel 'cic'" ]]
}

@test "p2m -n gives the mesh other cells, drops what was derived, keeps uniform fields and refuses other state" {
	pinit uniform -n 20 | p2m -n 6 >a
	sh_ok 'p2m -n 5x4x7 <a | sls'
	[[ $output =~ "5 x 4 x 7 cells" ]]
	printf "$two" | line open 8 | p2m | stab | sed '1s/"name":"rho","on":"mesh","role":"derived"/"name":"e","on":"mesh","role":"state"/; s/^rho$/e/' >b
	run -1 bash -o pipefail -c 'stab - <b | p2m -n 16 | sls'
	[[ $output =~ "has the state field 'e'" ]]
	sh_ok 'stab - <b | p2m -n 8 | sls'
	awk '/^#mesh/ { skip = 1 } /^#end/ { skip = 0 } !skip' b | sed '1s/\("name":"e","on":"mesh","role":"state","type":"f64"\)/\1,"uniform":[0.25]/' >c
	sh_ok 'stab - <c | p2m -n 16 | sls'
	[[ $output =~ e\ +1\ f64\ state\ value\ kernel\ cic\ uniform\ 0.25 && $output =~ "16 cells" ]]
}

@test "p2m makes a mesh with -n where there is none, and says so where it needs one" {
	printf "$two" | line open 8 | stab | sed '1s/"meshes":\[.*\],"scene"/"meshes":[],"scene"/; /^#mesh/,/^$/{/^#mesh/d}' >a
	run -1 bash -c 'stab - <a | p2m'
	[[ $output =~ "p2m -n CELLS makes one" ]]
	[ "$(stab - <a | p2m -n 8 | mesh)" = "0 0 2 2 0 1 1 0 0" ]
}

@test "p2m: a density that is not finite is refused, of equal strengths too, whose sums are known without a look" {
	pinit uniform -n 1000 --cells 8 | smove --scale mass=1e306 >large # 1e303 each, 512 cells in the unit box
	for kernel in cic m6prime; do
		p2m --kernel $kernel <large | sls | grep -q rho
		run -3 bash -o pipefail -c "smove --scale mass=1e4 <large | p2m --kernel $kernel >/dev/null"
		[[ $output == *"'rho' of 'mesh' is not finite"* ]]
	done
	run -3 bash -o pipefail -c 'pinit uniform -n 1000 --length 1e-104 --mass 1e-17 --cells 8 | p2m >/dev/null' # 1 / (volume of a cell) is infinite
	[[ $output == *"'rho' of 'mesh' is not finite"* ]]
	# strengths whose largest is known from remesh: 1e307 on 8 nodes, in cells of 1/8 and 1/512
	local words='remesh -n 2 --drop v | p2m -n 8 | poisson-fft | mgrad | m2p | push drift'
	run -3 bash -o pipefail -c "smove --scale mass=10 <large | cycle -n 1 '$words' >/dev/null"
	[[ $output == *"'rho' of 'mesh' is not finite"* ]]
	run -3 bash -o pipefail -c 'smove --scale mass=1e4 <large | scalc --set matter --role state --extensive "mass = mass + 0*id" | p2m >/dev/null'
	[[ $output == *"'rho' of 'mesh' is not finite"* ]]
}

@test "p2m takes every set that has the strength, or the one named" {
	printf "$two" | stab - --law gravity --box 0,4 -n 8 >a
	printf 'x mass\n2.0 8\n' | stab - --set heavy --law gravity --box 0,4 -n 8 >b
	if ! command -v stack >/dev/null; then skip "no stack yet"; fi
	stack a b >c
	[ "$(p2m <c | mesh)" = "0 0 2 2 16 1 1 0 0" ]
	[ "$(p2m --set heavy <c | mesh)" = "0 0 0 0 16 0 0 0 0" ]
	run -1 p2m --set light <c
	[[ $output =~ "no set 'light'" ]]
}

@test "p2m --strength deposits another field; a value is multiplied by volume and refused without one" {
	printf 'x mass heat volume\n1.25 2 8 0.5\n2.75 1 4 0.25\n' | line open 8 >a
	[ "$(p2m --strength heat --field warm <a | mesh)" = "0 0 4 4 0 1 1 0 0" ]
	sh_ok 'p2m --strength heat --field warm <a | sls'
	[[ $output =~ warm && ! $output =~ rho ]]
	printf 'x mass heat\n1.25 2 8\n' | line open 8 >b
	run -1 p2m --strength heat <b
	[[ $output =~ "is a value, not a strength" ]]
}

@test "p2m without the strength says how to add it" {
	printf 'x charge\n1.25 2\n' | line open 8 >a
	run -1 p2m <a
	[[ $output =~ "p2m: frame 1: no field 'mass' on 'matter' (add it with stab --strength, or choose another with --strength FIELD)" ]]
	[ "$(p2m --strength charge <a | mesh)" = "0 0 2 2 0 0 0 0 0" ]
	printf 'x mass\n1.25 2\n' | stab - --law free --box 0,4 -n 8 >b
	run -1 p2m <b
	[[ $output =~ "choose a field with --strength" ]]
	[ "$(p2m --strength mass <b | mesh)" = "0 0 2 2 0 0 0 0 0" ]
}

@test "p2m --outside error names a particle outside an open mesh by set, index and position" {
	printf 'x mass\n1.25 2\n4.5 1\n-3 1\n' | line open 8 >a
	run -1 p2m --outside error <a
	[[ $output =~ "p2m: frame 1: particle 1 of 'matter' at (4.5) is outside mesh 'mesh', 0 <= x <= 4" ]]
	printf 'x mass\n4.0000001 2\n' | line open 8 >b # a position of single precision beside a wall
	run -1 p2m --outside error <b
	[[ $output =~ "at (4.0000001) is outside mesh 'mesh', 0 <= x <= 4" ]]
	printf 'x mass\n1.25 2\n3.75 1\n' | line open 8 >b
	run -1 p2m --outside error <b
	[[ $output =~ "particle 1 of 'matter' at (3.75) is too near the open face x = 4" ]]
	printf 'x mass\n1.25 2\n3.5 1\n' | line open 8 >c
	sh_ok 'p2m --outside error <c | sls'
}

@test "p2m --outside drop leaves them out and counts them" {
	printf 'x mass\n1.25 2\n4.5 1\n-3 1\n' | line open 8 >a
	[ "$(p2m --outside drop <a | mesh)" = "0 0 2 2 0 0 0 0 0" ]
	sh_ok 'p2m --outside drop <a | sls --report'
	[[ $output =~ dropped.*2 ]]
}

@test "p2m --outside grow enlarges an open mesh by blocks of 8 cells, and only where it must" {
	printf 'x mass\n1.25 2\n4.5 1\n' | line open 8 >a
	sh_ok 'p2m --outside grow <a | stab --plain --mesh mesh'
	[ "$(awk '$2 != 0' <<<"$output" | tail -n +2 | tr '\n\t' '  ')" = "1 2 1.5 2 4.5 2 " ]
	[ "$(wc -l <<<"$output")" = 18 ]
	printf "$two" | line open 8 >b
	same_as <(p2m --outside grow --no-history <b) <(p2m --no-history <b)
	printf 'x mass\n1.25 2\n1e300 1\n' | line open 8 >c
	run -1 p2m --outside grow <c
	[[ $output =~ "would grow to more than" ]]
	printf 'x mass\n1.25 2\n4.5 1\n' | line wall 8 >d
	run -1 p2m --outside grow <d
	[[ $output =~ "beyond the wall face of axis x" ]]
}

@test "p2m gives the same bytes with 1, 2 and 3 threads, and after other frames" {
	pinit uniform -n 30000 --seed 3 --cells 33x20x18 >a
	pinit plummer -n 500 --seed 4 >b
	for kernel in cic pcs; do
		for threads in 1 2 3; do
			p2m --kernel $kernel --threads $threads --outside drop <a | cksum >sum.$threads
		done
		same_as sum.1 sum.2
		same_as sum.1 sum.3
	done
	cat b a b a | p2m --outside drop >several
	cat <(p2m --outside drop <b) <(p2m --outside drop <a) <(p2m --outside drop <b) <(p2m --outside drop <a) >single
	same_as several single
}

@test "p2m refuses an unknown kernel before it reads, naming the nearest" {
	run -2 bash -c 'p2m --kernel tcs </dev/null'
	[[ $output =~ tsc ]]
}

@test "p2m --interlace: the mark of both meshes goes with the kernel through solver and gradient to m2p, and the total is kept" {
	pinit uniform -n 300 --dim 2 | p2m -n 9x14 --kernel tsc --interlace >a
	sh_ok 'poisson-fft --plan estimate <a | mgrad | sls'
	for field in rho phi g; do [[ $output =~ $field\ .*kernel\ tsc\ interlaced ]]; done
	stab --plain --mesh mesh <a | awk 'NR > 1 { s += $NF } END { printf "%.17g\n", s / 126 }' >sum
	within "$(cat sum)" 1 1e-14 # mass 1 in a unit box
	for solver in poisson-mg poisson-relax 'poisson-fft --plan estimate --symbol fd2'; do
		$solver <a | mgrad | m2p >"out.${solver: -3}"
	done
	scmp --tolerance 1e-8 --field acc out.-mg out.fd2
	scmp --tolerance 1e-8 --field acc out.lax out.fd2
}

@test "p2m --interlace: streams that name the kernel interlaced-tsc, as they once did, read as tsc, interlaced" {
	pinit uniform -n 300 | p2m -n 9 --kernel tsc --interlace | poisson-fft | mgrad >new
	wire edit new '
for f in h["fields"]:
    if f.pop("interlaced", False): f["kernel"] = "interlaced-" + f["kernel"]' >old
	[ "$(wire header old | grep -c 'interlaced-tsc')" = 3 ]
	m2p <new >a
	m2p <old >b
	same_as a b
	wire header b | python3 -c '
import json, sys
f = {k["name"]: k for k in json.load(sys.stdin)["fields"]}
assert all((f[n]["kernel"], f[n]["interlaced"]) == ("tsc", True) for n in ("rho", "phi", "g")), f'
	wire edit new 'h["fields"][-1]["interlaced"] = 1' >bad
	run -1 --separate-stderr m2p <bad
	[[ $stderr == *"'interlaced' is neither true nor false"* ]]
	wire edit new 'h["fields"][-1]["kernel"] = ""' >bad
	run -1 --separate-stderr m2p <bad
	[[ $stderr == *"'interlaced' has no kernel"* ]]
}

@test "p2m --interlace: the same bytes for 1, 2 and 3 threads, and after other frames" {
	pinit uniform -n 5000 >a
	pinit uniform -n 50 --dim 1 >b
	for t in 1 2 3; do p2m -n 31x34x28 --interlace --threads $t <a | poisson-fft | mgrad | m2p --threads $t >out.$t; done
	same_as out.1 out.2
	same_as out.1 out.3
	p2m -n 12 --interlace --no-history <a | poisson-fft --no-history | mgrad --no-history | m2p --no-history | stab | grep -v '^#' >alone
	cat b a | p2m -n 12 --interlace --no-history | poisson-fft --no-history | mgrad --no-history | m2p --no-history | stab | awk '/^#pmpipe/ {
		n++ } n == 2 && !/^#/' >second
	same_as alone second
}

@test "p2m --interlace: faces that are not periodic, a density of another kind and changes to interpolate are refused, with an alternative" {
	run -1 --separate-stderr bash -c 'pinit plummer -n 50 | p2m --interlace >out'
	[[ $stderr == *"axis x is open (leave out --interlace"* ]]
	run -1 --separate-stderr bash -c 'pinit uniform -n 50 | p2m -n 8 | p2m --interlace --add >out'
	[[ $stderr == *"leave out --add"* ]]
	run -1 --separate-stderr bash -c \
		'pinit taylor-green-2d --cells 16 | p2m --kernel tsc --interlace | poisson-fft --plan estimate | mgrad | diffuse | m2p >out'
	[[ $stderr == *"carried over with one mesh (p2m without --interlace)"* ]]
	pinit uniform -n 50 | p2m -n 8 --interlace | poisson-fft --plan estimate | mgrad >g
	m2p --kernel tsc <g >one # as it is, from one mesh
	run -2 --separate-stderr m2p --kernel interlaced-tsc <g
}

@test "--outside grow holds particles on the last places of a mesh, where places and spacing are rounded" {
	for row in "1.344 1.68 50 --rim 2" "1.4166666666666667 1.7 36" "1.848 2.1 100 --rim 3" "1.4784 1.68 50 --rim 1"; do
		read -r y side cells rim <<<"$row"
		printf 'x y circulation\n0 %s 1\n0 -%s 1\n' "$y" "$y" | stab - --law vortex --box=-$side,$side -n "$cells" |
			p2m --kernel m6prime $rim --outside grow >a || { echo "$row"; return 1; }
		total=$(stab --plain --mesh mesh <a | column omega | awk '{ s += $1 } END { printf "%.17g", s }')
		within "$(calc "$total * (2 * $side / $cells) ^ 2")" 2 1e-12 "$row" # two charges of 1, on points of 300 times as much
	done
}
