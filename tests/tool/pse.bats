# pse: diffusion by exchange of strength between particles; inputs, terms, refusals, reports.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# rod N EXPRESSION [stab options]: c(x) at the middles of N cells of 0..1, as strengths called heat.
rod() {
	local n=$1 e=$2
	shift 2
	awk -v n="$n" 'BEGIN { pi = atan2(0, -1); h = 1 / n; print "x heat volume"
		for (i = 0; i < n; i++) { x = (i + 0.5) * h; printf "%.17g %.17g %.17g\n", x, h * ('"$e"'), h } }' |
			stab - --strength heat --box 0,1 --dt 1e-3 "$@"
}
total() { stab --plain | column heat | awk '{ s += $1 } END { printf "%.17g\n", s }'; }
rest="field 'vel = 0'"

@test "pse makes dheat of heat as the term diffusion, with the symbol of its kernel" {
	rod 40 'cos(2*pi*x)' --faces periodic >a
	for order in 2 4; do
		pse --field heat --nu 0.3 --order $order <a | stab --plain >b
		# k eps = pi/20: M0 - transform, over eps^2
		awk -v order=$order 'BEGIN { k = atan2(0, -1) / 20; s = order == 2 ? 1 - exp(-k*k) : 2 - (2 + k*k) * exp(-k*k); want = -0.3 * s * 1600 }
			NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
			{ d = $at["dheat"] - want * $at["heat"]; if (d < 0) d = -d; if (d > m) m = d }
			END { print m; exit !(NR == 41 &&
				m < 0.3 * 39 * 0.025 * 7e-7) }' b # the second moment is right to 4e-8 and 7e-9, the zeroth to as little
	done
	run -0 bash -o pipefail -c 'pse --field heat --nu 0.3 <a | sls'
	[[ $output =~ dheat\ +1\ f64\ change\ strength\ of\ heat\ terms\ diffusion ]]
}

@test "pse works on the strength of every law that has one, and on its own field under those that have none" {
	for law in gravity:mass electrostatic:charge vortex:circulation; do
		awk -v s=${law#*:} 'BEGIN { print "x y " s " volume"; for (i = 0; i < 100; i++) print (i % 10)/10, int(i/10)/10, i % 7, 0.01 }' |
			stab - --law ${law%:*} --constant nu=0.1 >a
		run -0 bash -o pipefail -c 'pse <a | sls'
		[[ $output =~ d${law#*:}\ .*of\ ${law#*:}\ terms\ diffusion ]]
	done
	rod 10 1 --constant nu=0.1 --law passive >a
	run -1 bash -o pipefail -c 'pse <a | sls'
	[[ $output == *"the law 'passive' has no strength to diffuse (--field NAME)"* ]]
	sh_ok 'pse --field heat <a | sls'
}

@test "a value diffuses as the strength that is value times volume, divided by volume" {
	rod 30 'exp(x) * (1 + x)' | scalc --role state 'volume = volume * (1 + x)' 'temperature = heat / volume' >a
	pse --field heat --nu 1 <a | pse --field temperature --nu 1 | stab --plain >b
	paste <(column dheat <b) <(column dtemperature <b) <(column volume <b) | awk '{ d = $1 - $2 * $3; if (d < 0) d = -d; if (d > 1e-12) exit 1;
		n++ } END { exit n != 30 }' # rates of 1e2
	run -0 bash -o pipefail -c 'pse --field temperature --nu 1 <a | sls'
	[[ $output =~ dtemperature\ +1\ f64\ change\ value\ of\ temperature ]]
	run -1 bash -o pipefail -c "scalc --role state 'volume = x < 0.5 ? 0 : 1' <a | pse --field temperature --nu 1 | sls"
	[[ $output == *"has the volume 0, and its value is strength over volume"* ]]
}

@test "if nu is 0 the frame is passed on unchanged, which --verbose reports once; a negative one is refused" {
	rod 10 1 --no-history >a
	pse --field heat --no-history <a | cmp a -
	run -0 bash -o pipefail -c 'pse --field heat --verbose <a 2>&1 >/dev/null'
	[[ $output == *"the viscosity nu is 0"* ]]
	run -1 bash -o pipefail -c 'smod --constant nu=-1 <a | pse --field heat | sls'
	[[ $output == *"negative diffusion has no solution"* ]]
	run -2 pse --nu -1
}

@test "pse needs volumes that are not negative, a field that is real state, particles before a wall; each refusal has a remedy" {
	rod 10 1 >a
	refused() { # PATTERN COMMAND LINE
		run -1 bash -o pipefail -c "$2 | sls"
		[[ $output == *"$1"* ]] || { echo "$output"; return 1; }
	}
	refused "no field 'volume' on 'matter', and particles exchange strength by their volumes (remesh gives them volumes" \
		'sel --drop volume <a | pse --field heat --nu 1'
	refused "particle 3 of 'matter' has the volume -0.1" "scalc --role state 'volume = abs(x - 0.35) < 0.01 ? -0.1 : 0.1' <a | pse --field heat --nu 1"
	refused "no field 'warmth' on 'matter'" 'pse --field warmth --nu 1 <a'
	refused "'cold' on 'matter' is not state of real numbers" "scalc 'cold = -heat' <a | pse --field cold --nu 1"
	refused "particle 0 of 'matter' is at x = 0.05, behind a face that mirrors it" "smod --box 0.1,1 --faces wall <a | pse --field heat --nu 1"
	sh_ok "smod --box 0.1,1 --faces wall <a | pse --field heat --nu 1 --wall none | sls"
	refused "more than 14 boxes" "smod --box 0.05,0.06 --faces periodic <a | pse --field heat --nu 1"
	refused "no set 'nothing'" 'pse --set nothing --field heat --nu 1 <a'
	run -2 pse --eps 1 --overlap 1
}

@test "pse refuses to add twice, --replace replaces its term, other terms are kept" {
	rod 12 'x*x' >a
	pse --field heat --nu 0.1 <a >b
	run -1 bash -o pipefail -c 'pse --field heat --nu 0.1 <b | sls'
	[[ $output == *"already holds the term 'diffusion'"* ]]
	same_as <(pse --field heat --nu 0.1 --replace <b | stab --plain) <(stab --plain <b)
	field 'dheat = 1' <a | pse --field heat --nu 0.1 | stab --plain | column dheat >sum
	paste <(stab --plain <b | column dheat) sum | awk '{ d = $2 - $1 - 1; if (d > 1e-14 || d < -1e-14) exit 1; n++ } END { exit n != 12 }'
}

@test "width and cut-off: overlap times the spacing, or a length; reported, with the fastest decay" {
	rod 20 1 >a
	report() { pse --field heat --nu 0.5 "$@" <a | sls --report --format json | grep -o '"report":.*' | tr ',{}' '\n\n\n'; }
	[ "$(report | grep -c '"eps":0.05')" = 1 ]
	[ "$(report | grep -c '"cutoff":8.0')" = 1 ]
	report --order 4 | grep -q '"cutoff":9.0'
	report --overlap 2 --cutoff 6 | grep -q '"eps":0.10*[,0-9]*'
	report --eps 0.025 | grep -q '"eps":0.025'
	within "$(report | sed -n 's/"fastest_dt"://p')" 0.2 1e-7 # 0.5 dt/eps^2, of a lattice
	within "$(report --order 4 | sed -n 's/"fastest_dt"://p')" 0.4 3e-3 # near the ends the negative weights beyond them are missing
	report --overlap 0.1 | grep -q '"alone":20'
	run -0 bash -o pipefail -c 'pse --field heat --nu 1 --overlap 0.1 --verbose <a 2>&1 >/dev/null'
	[[ $output == *"20 particles of 'matter' have no partner within 0.04 (a larger --overlap or --eps)"* ]]
}

@test "S33: the sum is kept to round-off between open, periodic and neumann faces, for unequal volumes at random, over steps of every scheme" {
	awk 'BEGIN { srand(3); print "x y heat volume"; for (i = 0; i < 400; i++) printf "%.17g %.17g %.17g %.17g\n", rand(), rand(),
		rand() * (rand() < 0.3 ? -1 : 1), (0.5 + rand()) / 400 }' >table
	for faces in open periodic neumann; do
		stab table --strength heat --box 0,1 --faces $faces --dt 1e-5 >a
		for order in 2 4; do
			cycle -n 6 "field 'vel = 0, 0' | pse --field heat --nu 0.1 --order $order | push rk4" <a >b
			below "$(echo "$(total <a) $(total <b)" | awk '{ print ($2 - $1) / $1 }')" 4e-15 "$faces, order $order" # 400 strengths, 24 passes
			run ! cmp -s <(stab --plain <a | column heat) <(stab --plain <b | column heat)
		done
	done
}

@test "walls take strength away, neumann faces do not: a rod between cold ends and between insulated ones" {
	for faces in wall neumann; do
		rod 40 1 --faces $faces >a
		cycle -t 0.1 "$rest | pse --field heat --nu 0.5 | push rk2" <a | total >$faces
	done
	# the series of a rod of 1 between ends at 0: sum over odd k of 8/(pi k)^2 exp(-(pi k)^2 nu t); eps = h: decay right to (pi h)^2/2 = 0.3 %
	within "$(cat wall)" "$(awk 'BEGIN { p = atan2(0, -1); for (k = 1; k < 20; k += 2) s += 8 / (p*k)^2 * exp(-(p*k)^2 * 0.05); print s }')" 2e-3
	within "$(cat neumann)" 1 1e-14
	within "$(rod 40 1 --faces wall | cycle -t 0.1 "$rest | pse --field heat --nu 0.5 --wall none | push rk2" | total)" 1 1e-14
}

@test "two sets diffuse each by itself; --set takes one" {
	rod 30 'x < 0.5' >a
	rod 20 'x > 0.4' >b
	stack --as one,two a b >c
	pse --field heat --nu 1 <c >d
	same_as <(stab --plain --set one <d | column dheat) <(pse --field heat --nu 1 <a | stab --plain | column dheat)
	same_as <(stab --plain --set two <d | column dheat) <(pse --field heat --nu 1 <b | stab --plain | column dheat)
	run -0 bash -o pipefail -c 'pse --field heat --nu 1 --set two <c | sls'
	[ "$(grep -c dheat <<<"$output")" = 1 ]
}

@test "push refuses a step beyond the limit, whatever the particles, and names the longest" {
	rod 32 'x' --faces periodic --dt 0.02 >a # nu dt/eps^2 = 2.05
	run -3 bash -o pipefail -c "field 'vel = 0' <a | pse --field heat --nu 0.1 | push euler | sls"
	[[ $output == *"the limit of euler: 'dheat' of 'matter' (diffusion) decays at up to 102.4"* ]]
	sh_ok "smod --dt 0.0195 <a | field 'vel = 0' | pse --field heat --nu 0.1 | push euler | sls"
	# four particles in one place: the weights add up
	awk 'BEGIN { print "x heat volume"; for (i = 0; i < 32; i++) for (j = 0; j < 1 + 3 * (i > 27); j++) print i/32, i, 1/32 }' |
		stab - --strength heat --box 0,1 --faces periodic --dt 0.0195 >b
	run -3 bash -o pipefail -c "field 'vel = 0' <b | pse --field heat --nu 0.1 --eps 0.03125 | push euler | sls"
}

@test "vortices diffuse as on the mesh: pse and diffuse agree to second order" {
	for n in 32 48 64; do
		pinit taylor-green-2d --cells $n --dt 0.01 >a
		p2m <a | poisson-fft | mgrad | m2p | pse | stab --plain | column dcirculation >p
		p2m <a | poisson-fft | mgrad | diffuse --order 6 | m2p | stab --plain | column dcirculation >q
		echo "$n $(paste p q | awk '{ d = $1 - $2; s += d * d; t += $2 * $2 } END { print sqrt(s / t) }')"
	done >errors
	order 2 $(awk '{ print 1 / $1, $2 }' errors)
}

@test "without remesh pse says once that the spacing of the particles is distorted; not where they are a lattice, turned, moved or remeshed" {
	s="p2m | poisson-fft | mgrad | m2p | pse | push lsrk3"
	pinit lamb-oseen --cells 32 >a
	for with in "" "--ranks 2" "--engine pipes"; do
		cycle -n 100 $with "$s" <a 2>said >b
		[ "$(grep -c "pse: the spacing of 'vortices' is distorted (largest overlap 1.00[0-9]*, 1 on a lattice).*(put remesh behind push)" said)" = 1 ]
	done
	for remesh in "remesh" "remesh --every 5"; do
		cycle -n 100 "$s | $remesh" <a 2>said >b
		run -1 grep distorted said
	done
	smod --step 7 a >moved
	# every order, beside edges too, and axes of different nu
	for o in "" "--order 4" "--order 6" "--order 8" "--nu 0.03,0.01"; do
		pse $o <moved >b 2>said
		scalc --set vortices 'x = x*cos(0.3) - y*sin(0.3), x*sin(0.3) + y*cos(0.3)' <moved | pse $o >b 2>>said
		scalc --set vortices 'x = x + 0.03, y' <moved | pse $o >b 2>>said
		[ ! -s said ]
	done
	# a short cut-off, and a width that a lattice does not sum well, neither of which remesh mends
	for o in "--cutoff 3 --order 6" "--cutoff 3 --order 4" "--overlap 0.4" "--overlap 0.4 --order 4"; do
		pse $o <moved >b 2>said
		[ ! -s said ]
	done
	# edges in space
	awk -v n=9 'BEGIN { h = 1 / n; print "x y z heat volume"
		for (i = 0; i < n; i++) for (j = 0; j < n; j++) for (k = 0; k < n; k++) print (i + 0.5) * h, (j + 0.5) * h, (k + 0.5) * h, i * h, h ^ 3 }' |
		stab - --strength heat --box 0,1 --faces open --dt 1e-4 | smod --step 7 >cube
	for o in 2 4 6 8; do
		pse --field heat --nu 0.01 --order $o <cube >b 2>said
		[ ! -s said ]
	done
}

@test "three threads give the same bytes" {
	awk 'BEGIN { srand(5); print "x y z heat volume"; for (i = 0; i < 3000; i++) print rand(), rand(), rand(), rand(), 1 / 3000 }' |
		stab - --strength heat --box 0,1 --faces periodic >a
	for t in 1 2 3; do OMP_NUM_THREADS=$t pse --field heat --nu 1 --cutoff 6 --no-history <a | cksum; done | sort -u >sums
	[ "$(wc -l <sums)" -eq 1 ]
}

@test "--method dc: no volumes needed but for the width, refuses points that do not determine it, reports who looked farther" {
	awk 'BEGIN { srand(4); print "x y heat volume"; for (i = 0; i < 20; i++) for (k = 0; k < 20; k++) print (i + rand() * 0.6) / 20,
		(k + rand() * 0.6) / 20, (i + rand() * 0.6)^2 / 400, 1/400 }' | stab - --strength heat >a
	pse --field heat --nu 1 --method dc <a >b
	run -0 bash -o pipefail -c 'sls --report <b'
	[[ $output =~ \"widened\":[1-9] && $output == *'"cutoff":3.1'* && $output == *'"eps":0.05'* ]]
	pse --field heat --nu 1 --method dc --order 4 <a | sls --report >c
	grep -q '"cutoff":4.0999999' c
	# a field of degree 3 exactly, whatever the volumes
	scalc --role state 'T = x^3 - 2*x*y + y^2' 'volume = 0.001 + x' <a | pse --field T --nu 0.5 --method dc --eps 0.05 | stab --plain |
		awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { e = $at["dT"] - 0.5 * (6 * $at["x"] + 2); if (e * e > 1e-20) exit 1; n++ } END {
			exit n != 400 }'
	run -1 bash -o pipefail -c "scalc --role state 'x = x, 0.5' <a | pse --field heat --nu 1 --method dc | sls"
	[[ $output == *"which do not determine the Laplacian (rank 3 of 9; a larger --cutoff or --overlap, remesh, or --method exchange)"* ]]
	run -1 bash -o pipefail -c "sel --where 'x < 0.2 && y < 0.1' <a | pse --field heat --nu 1 --method dc --cutoff 40 | sls"
	[[ $output == *"particle 0 of 'matter' has 7 partners"* ]]
}

@test "--method dc: the same bytes with three threads; push refuses a step beyond its bound" {
	awk 'BEGIN { srand(4); print "x y heat volume"; for (i = 0; i < 30; i++) for (k = 0; k < 30; k++) print (i + rand() * 0.6) / 30,
		(k + rand() * 0.6) / 30, rand(), 1/900 }' | stab - --strength heat --dt 1e-2 >a
	for t in 1 2 3; do OMP_NUM_THREADS=$t pse --field heat --nu 1 --method dc --no-history <a | cksum; done | sort -u >sums
	[ "$(wc -l <sums)" -eq 1 ]
	run -3 bash -o pipefail -c "field 'vel = 0, 0' <a | pse --field heat --nu 1 --method dc | push euler | sls"
	[[ $output == *"times the limit of euler"* ]]
}

# plane N [NU]: f = 2 + sin(2 pi x) cos(2 pi y) on N x N points, with nu = NU and what the rates shall be: of that nu, and of the tensor 1.5, 1.
plane() {
	awk -v OFMT=%.17g -v n="$1" 'BEGIN { k = 2 * atan2(0, -1); h = 1 / n; print "x y f visc volume varies tensor"
		for (i = 0; i < n; i++) for (j = 0; j < n; j++) { x = (i + 0.5) * h; y = (j + 0.5) * h; s = sin(k*x); c = cos(k*x); C = cos(k*y); v = 1 + c/2
			print x, y, 2 + s*C, v, h*h, -2*k*k*v*s*C - k*k/2*s*c*C, -2.5*k*k*s*C } }' |
		stab - --law passive --box 0,1 --faces periodic --dt 1e-5
}
# off NAME: the largest difference of df from NAME.
off() { stab --plain | awk -v w="$1" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { d = $at["df"] - $at[w]; d = d < 0 ? -d : d
	if (d > m) m = d } END { print m }'; }

@test "pse --nu of a tensor and of a field have the order of the kernel, and the sum stays" {
	for order in 2 4 6; do # farther cut-off than usual, whose error of 1e-7 would hide order 6
		local tensor=() varies=() o="--field f --order $order --cutoff 12"
		for n in 48 64 80; do
			plane $n >a
			tensor+=("$(calc "1/$n")" "$(pse $o --nu 1.5,1 <a | off tensor)")
			varies+=("$(calc "1/$n")" "$(pse $o --nu visc <a | tee b | off varies)")
		done
		order $order "${tensor[@]}"
		order $order "${varies[@]}"
		# a sum of 6400 rates of size 100, with partial sums of 1300, each rounded by 2e-13: times sqrt(6400); measured 1.1e-11
		below "$(stab --plain <b | column df | awk '{ s += $1 } END { print s }')" 3e-11 sum
	done
	within "$(pse --field f --nu '1 + cos(2*pi*x)/2' <a | off varies)" "$(pse --field f --nu visc <a | off varies)" 1e-9
}

@test "pse --nu 0.02,0.01: a Gaussian becomes an ellipse as it must" {
	# exact: exp(-x^2/(1 + 4 nu_x t) - y^2/(1 + 4 nu_y t)) over the root of the product
	local e=()
	for n in 48 64 80; do
		awk -v OFMT=%.17g -v n=$n 'BEGIN { h = 12 / n; print "x y f volume"; for (i = 0; i < n; i++) for (j = 0; j < n; j++) {
			x = -6 + (i + 0.5) * h; y = -6 + (j + 0.5) * h; print x, y, exp(-x*x - y*y), h*h } }' |
			stab - --law passive --box -6,6 --dt 2.5 | cycle -n 10 "field 'vel = 0, 0' | pse --field f --nu 0.02,0.01 | push rk2" >b
		e+=("$(calc "1/$n")" "$(stab --plain <b | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { x = $at["x"]; y = $at["y"]
			d = $at["f"] - exp(-x*x/3 - y*y/2)/sqrt(6); d = d < 0 ? -d : d; if (d > m) m = d } END { print m }')")
	done
	order 2 "${e[@]}"
}

@test "pse --nu: the limit goes by the largest nu; what cannot be is refused" {
	plane 16 >a
	fastest() { pse --field f "$@" <a | sls --report --format json | grep -o '"fastest_dt":[0-9.e+-]*' | cut -d : -f 2; }
	# the lattice has visc up to 1 + cos(pi/16)/2
	within "$(fastest --nu visc)" "$(fastest --nu "$(calc '1 + cos(3.14159265358979/16)/2')")" 1e-12
	# half the length along x doubles the partners, and half the volume: 1/eps^2 stays that of the least nu
	within "$(fastest --nu 2,0.5)" "$(fastest --nu 0.5)" 1e-7
	run -2 bash -o pipefail -c "pse --field f --nu 1,2,3 <a | sls"
	[[ $output == *"--nu '1,2,3' has 3 components: give one, or one for each of the 2 axes"* ]]
	run -2 bash -o pipefail -c "pse --field f --nu visc,1 <a | sls"
	[[ $output == *"a tensor takes numbers, what varies is one expression for all axes"* ]]
	run -2 bash -o pipefail -c "pse --field f --nu 1,0 <a | sls"
	[[ $output == *"is 0 along an axis, and particles exchange along all (diffuse does it on a mesh)"* ]]
	run -2 bash -o pipefail -c "pse --field f --nu 1,-1 <a | sls"
	[[ $output == *"negative diffusion has no solution"* ]]
	run -1 bash -o pipefail -c "pse --field f --nu 'visc - 1' <a | sls"
	[[ $output == *"somewhere on 'matter': negative diffusion has no solution"* ]]
	run -2 bash -o pipefail -c "pse --field f --nu visc --method dc <a | sls"
	[[ $output == *"where it varies use --method exchange"* ]]
	below "$(pse --field f --nu 1.5,1 --method dc --order 4 <a | off tensor)" 1 # of 99; dc takes a tensor
}
