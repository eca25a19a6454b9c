# diffuse: nu lap omega on the mesh, carried to the particles by m2p, advanced by push within the limits of its schemes.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# lattice CELLS EXPRESSION [stab options]: omega(x, y) on the nodes of the periodic box 0..1 of CELLS x CELLS, as particles.
lattice() {
	local n=$1 e=$2
	shift 2
	awk -v n="$n" 'BEGIN { pi = atan2(0, -1); h = 1 / n; print "x y circulation volume"
		for (j = 0; j < n; j++) for (i = 0; i < n; i++) { x = i * h; y = j * h; printf "%.17g %.17g %.17g %.17g\n", x, y, h * h * ('"$e"'), h * h } }' |
		stab - --law vortex --box 0,1 -n "$n" --faces periodic --particle-faces periodic --dt 0.01 "$@"
}
mesh() { stab --plain --mesh mesh; }
step='p2m | poisson-fft | mgrad | diffuse | m2p'

@test "diffuse makes domega = nu lap omega, of the circulation, with each order's eigenvalue of a wave" {
	lattice 16 'cos(2*pi*(x + 2*y))' --constant nu=0.25 | p2m >a
	for order in 2 4 6 spectral; do
		diffuse --order $order <a | mesh >b
		# -lap of exp(i k x): the sum over axes of s(k h)/h^2, k h = pi/8 and pi/4
		awk -v order=$order 'function s(t) { if (order == 2) return 2 - 2 * cos(t); if (order == 4) return 5/2 - 8/3 * cos(t) + cos(2 * t)/6
				if (order == 6) return 49/18 - 3 * cos(t) + 3/10 * cos(2 * t) - cos(3 * t)/45; return t * t }
			BEGIN { pi = atan2(0, -1); want = -0.25 * (s(pi/8) + s(pi/4)) * 256 }
			NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
			{ d = $at["domega"] - want * $at["omega"]; if (d < 0) d = -d; if (d > m) m = d }
			END { print m; exit !(NR == 257 && m < 1e-11) }' b # values of 3e2, 40 roundings
	done
	sh_ok 'diffuse <a | sls'
	[[ $output =~ "domega      1 f64 change value of circulation terms diffusion kernel m6prime" ]]
}

@test "diffuse converges with its order" {
	for order in 2 4 6; do
		points=()
		for n in 40 56 80; do
			lattice $n 'exp(sin(2*pi*x) + cos(2*pi*y))' --constant nu=1 | p2m | diffuse --order $order | mesh >b
			points+=("$(awk -v n=$n 'BEGIN { print 1 / n }')" "$(awk 'BEGIN { k = 2 * atan2(0, -1) } NR == 1 {
				for (i = 1; i <= NF; i++) at[$i] = i; next }
				{ x = k * $at["x"]; y = k * $at["y"]; w = exp(sin(x) + cos(y)) * k * k * (cos(x)^2 - sin(x) + sin(y)^2 - cos(y));
					d = $at["domega"] - w; if (d < 0) d = -d; if (d > m) m = d }
				END { print m }' b)")
		done
		order $order "${points[@]}"
	done
}

@test "if nu is 0 the frame is passed on unchanged, which --verbose reports; a negative one is refused" {
	lattice 8 'sin(2*pi*x)' | p2m --no-history >a
	diffuse --no-history <a | cmp a -
	run -0 bash -o pipefail -c 'diffuse --verbose <a 2>&1 >/dev/null'
	[[ $output =~ "diffuse: the viscosity nu is 0: nothing to do, the frame is passed on unchanged" ]]
	for engine in fused pipes; do # once, whatever the number of steps
		run -0 bash -o pipefail -c \
			"pinit shear-layer --cells 16 --nu 0 |
			cycle -n 3 --verbose --engine $engine 'p2m | poisson-fft | mgrad | diffuse | m2p | push rk2' 2>&1 >/dev/null | grep -c 'nu is 0'"
		[ "$output" = 1 ]
	done
	run -1 bash -o pipefail -c "stab <a | sed '1s/\"nu\":0.0/\"nu\":-1.0/' | stab - | diffuse | sls"
	[[ $output =~ "negative diffusion has no solution" ]]
	run -2 diffuse --nu -1
}

@test "diffuse refuses to add twice, --replace replaces its term, other terms are kept" {
	lattice 8 'sin(2*pi*x)' --constant nu=0.1 | p2m | diffuse >a
	run -1 bash -o pipefail -c 'diffuse <a | sls'
	[[ $output =~ "already holds the term 'diffusion'" ]]
	same_as <(diffuse --replace <a | mesh) <(mesh <a)
	# another stage's term, then diffusion on top of it
	stab <a | sed '1s/"terms":\["diffusion"\]/"terms":["forcing"]/' | stab - | diffuse | mesh | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i;
		next } { print 2 * $at["domega"] }' >unused
	stab <a | sed '1s/"terms":\["diffusion"\]/"terms":["forcing"]/' | stab - | diffuse | mesh | column domega >twice
	paste <(mesh <a | column domega) twice | awk '{ d = $2 - 2 * $1; if (d > 2e-14 || d < -2e-14) exit 1 }' # sums of terms of 17: 5 roundings
}

@test "diffuse needs the density: the message says p2m" {
	lattice 8 1 --constant nu=0.1 >a
	run -1 bash -o pipefail -c 'diffuse <a | sls'
	[[ $output =~ "no field 'omega' on mesh 'mesh' (run p2m first)" ]]
}

@test "m2p carries domega over as dcirculation, times volume, and is refused without one" {
	lattice 12 'sin(2*pi*x)*cos(4*pi*y)' --constant nu=0.1 >a
	sh_ok "cat a | $step >b"
	sh_ok 'sls <b'
	[[ $output =~ dcirculation\ +1\ f64\ change\ strength\ of\ circulation\ terms\ diffusion ]]
	# particles on the nodes, an interpolating kernel: each has the value of its node
	paste <(stab --plain <b | column dcirculation) <(mesh <b | column domega) | awk '{ d = $1 - $2 / 144; if (d > 1e-15 || d < -1e-15) exit 1; n++ } END {
		exit n != 144 }'
	run -1 bash -o pipefail -c "sel --drop volume <a | $step | sls"
	[[ $output =~ "must be multiplied by a 'volume'" ]]
}

@test "push refuses a change that is still on the mesh, and advances the circulation by one that was carried" {
	lattice 12 'sin(2*pi*x)' --constant nu=0.1 >a
	run -1 bash -o pipefail -c 'p2m <a | poisson-fft | mgrad | m2p | p2m | diffuse | push euler | sls'
	[[ $output =~ "the change 'domega' of 'circulation' is on mesh 'mesh' and not yet on 'matter' (carry it over with m2p)" ]]
	bash -o pipefail -c "cat a | $step | push euler | stab --plain" | column circulation >after
	# order 6: sin(2 pi x) decays by s(pi/6) 144
	paste <(stab --plain <a | column circulation) after | awk 'BEGIN { t = atan2(0, -1) / 6;
		f = 1 - 0.01 * 0.1 * 144 * (49/18 - 3*cos(t) + 0.3*cos(2*t) - cos(3*t)/45) }
		{ d = $2 - f * $1; if (d > 1e-15 || d < -1e-15) exit 1 }'
}

@test "the second moment of a blob grows by 4 nu t and its circulation is conserved, for every order" {
	for order in 2 4 6; do
		lattice 32 'exp(-((x - 0.5)^2 + (y - 0.5)^2) / 0.005)' --constant nu=1e-3 >a
		cycle -n 5 "p2m | poisson-fft | mgrad | diffuse --order $order | m2p | push rk2 | remesh" <a >b
		for f in a b; do
			stab --plain <$f | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
				{ c = $at["circulation"]; s += c; m += c * (($at["x"] - 0.5)^2 + ($at["y"] - 0.5)^2) } END { printf "%.17g %.17g\n", s, m / s }'
		done >moments
		# the blob is .05 wide and reaches the edge with exp(-50); the distortion within a step affects the second moment, not the circulation
		awk 'NR == 1 { s = $1; m = $2 } NR == 2 { g = ($2 - m) / (4 * 1e-3 * 0.05); d = ($1 - s) / s; print g, d; exit !(g > 0.998 && g < 1.002 &&
			d < 1e-13 && d > -1e-13) }' moments
	done
}

@test "circulation is conserved by construction: distorted particles, passes off the nodes, two sets at the same place" {
	lattice 32 '40 * exp(-((x - 0.5)^2 / 0.02 + (y - 0.5)^2 / 0.005))' --constant nu=1e-3 >a
	lattice 32 '10 * exp(-((x - 0.4)^2 / 0.01 + (y - 0.6)^2 / 0.01))' --constant nu=1e-3 >b
	stack --as one,two a b >c
	for s in a c; do
		# four steps without remeshing at 0.2 radians of core turning each
		cycle -n 4 "p2m | poisson-fft | mgrad | diffuse | m2p | push lsrk3" <$s >d
		for set in matter one two; do
			for f in $s d; do
				stab --plain --set $set <$f 2>/dev/null | column circulation | awk '{ s += $1 } END { printf "%.17g ", s }'
			done
		done >sums
		awk '{ d = $2 + $4 + $6 - $1 - $3 - $5; print d; exit !(d < 1e-14 && d > -1e-14 && $1 + $3 + $5 > 0.1) }' sums
	done
}

@test "circulation that diffuses to nodes without particles is reported: its drift in a step of euler, to round-off" {
	# a gap of six cells between the particles
	pinit lamb-oseen --cells 64 | sel --where 'x < 0.1 || x > 0.5' >b
	sh_ok "cat b | $step >c"
	push euler --dt 0.01 --unsafe <c >d
	lost=$(sls --format json --report <c | grep -o '"lost_dcirculation":[-+.e0-9]*' | cut -d: -f2)
	for f in b d; do stab --plain --set vortices <$f | column circulation | awk '{ s += $1 } END { printf "%.17g ", s }'; done |
		awk -v l="$lost" '{ d = ($1 - $2) / 0.01 - l; print $1, $2, l, d; exit !(l > 1e-4 && d < 1e-12 && d > -1e-12) }' # sums of size 1 over 0.01
	# a lattice that fills its box loses nothing
	lattice 12 'sin(2*pi*x)*cos(4*pi*y)' --constant nu=0.1 >a
	sh_ok "cat a | $step | sls --format json --report"
	[[ $output == *'"lost_dcirculation":0'[,}]* || $output == *'"lost_dcirculation":0.0'[,}]* ]]
}

@test "three threads give the same bytes" {
	lattice 40 'sin(2*pi*x)*cos(6*pi*y)' --constant nu=0.1 | p2m --no-history >a
	for order in 4 spectral; do
		OMP_NUM_THREADS=1 diffuse --order $order --no-history <a >b
		OMP_NUM_THREADS=3 diffuse --order $order --no-history <a | cmp b -
	done
}

# heat CELLS [stab options]: heat = sin(2 pi x) as values of particles on the nodes of 0..1.
heat() {
	awk -v n="$1" 'BEGIN { pi = atan2(0, -1); print "x heat volume"
		for (i = 0; i < n; i++) printf "%.17g %.17g %.17g\n", i / n, sin(2 * pi * i / n), 1 / n }' |
		stab - --box 0,1 -n "$1" --faces periodic --particle-faces periodic "${@:2}"
}
heat_step="field 'vel = 0' | p2m --strength heat --field heat --kernel m4prime | diffuse --field heat --nu 0.1 --order 2 | m2p"

@test "the heat equation of a value: du_i/dt = nu (u_{i+1} - 2 u_i + u_{i-1})/h^2 to round-off, order 2 against exp(-4 pi^2 nu t) (000:S55, 002:FV2)" {
	heat 16 --dt 0.01 >a
	cycle -n 3 "$heat_step | push euler" <a >b
	paste <(stab --plain <a | column heat) <(stab --plain <b | column heat) | awk 'BEGIN { f = (1 - 0.01 * 0.1 * 256 * (2 - 2 * cos(atan2(0, -1) / 8)))^3 }
		{ d = $2 - f * $1; n++; if (d > 1e-15 || d < -1e-15) exit 1 } END { exit n != 16 }'
	e=()
	for n in 16 24 32; do
		heat $n --dt 0.005 | cycle -n 20 "$heat_step | push rk4" | stab --plain | column heat >b
		e+=("$(calc "1/$n")" "$(awk -v n=$n 'BEGIN { pi = atan2(0, -1) } { d = $1 - exp(-4 * pi * pi * 0.01) * sin(2 * pi * (NR - 1) / n)
			if (d < 0) d = -d; if (d > m) m = d } END { print m }' b)")
	done
	order 2 "${e[@]}" # the error of rk4 in time is 1e-8
}

@test "explicit Euler needs dt <= h^2/(2 dim nu): push refuses a longer step (002:FV2 as corrected)" {
	# the limit at 16 cells is 1/(256 * 2 * 0.1) = 0.01953
	heat 16 --dt 0.0195 | cycle -n 1 "$heat_step | push euler" >/dev/null
	heat 16 --dt 0.0196 >a
	run -3 bash -o pipefail -c "cycle -n 1 \"$heat_step | push euler\" <a | sls"
	[[ $output =~ "0.0195" ]]
}

@test "diffuse takes the strength of every law: a change of it reaches the particles, and its sum is 0" {
	for law in gravity:mass electrostatic:charge vortex:circulation; do
		awk 'BEGIN { srand(3); print "x y s v0 v1 volume mass"
			for (i = 0; i < 64; i++) print (i % 8 + 0.2 * rand()) / 8, (int(i / 8) + 0.2 * rand()) / 8, rand(), 0, 0, 1/64, 1 }' |
			awk -v s="${law#*:}" 'NR == 1 { print s == "mass" ? "x y mass vx vy volume" : "x y " s " vx vy volume mass"; next }
				s == "mass" { $7 = "" } { print }' |
			stab - --law "${law%:*}" --box 0,1 -n 8 --faces periodic --particle-faces periodic --dt 0.01 >a
		for words in 'poisson-fft | mgrad | diffuse --nu 0.1 | m2p' 'diffuse --nu 0.1 | m2p --changes'; do
			sh_ok "p2m <a | $words | stab --plain >b"
			column "d${law#*:}" <b | awk '{ s += $1; a += $1 < 0 ? -$1 : $1; n++ }
				END { exit !(n == 64 && a > 0.1 && s < 1e-14 * a && s > -1e-14 * a) }'
		done
	done
}

@test "what diffuse --field cannot do is refused by name" {
	heat 8 --dt 0.01 >a
	while IFS='|' read -r text words; do
		run -1 bash -o pipefail -c "$words <a | sls"
		[[ $output == *"$text"* ]] || { echo "$words: $output"; return 1; }
	done <<'ROWS'
the law 'free' has no density on a mesh to diffuse (--field NAME, deposited by p2m --strength NAME --field NAME)|diffuse --nu 0.1
no field 'heat' on mesh 'mesh' (p2m --strength heat --field heat makes it of particles)|diffuse --nu 0.1 --field heat
no change on a mesh names a state of particles (diffuse makes one; m2p --field NAME for another field)|m2p --changes
ROWS
	scalc --mesh mesh 'T = x' <a >b
	run -1 bash -o pipefail -c 'diffuse --field T --nu 0.1 <b | sls'
	[[ $output =~ "no particles have a state 'T' whose rate of change this would be" ]]
	run -2 m2p --changes --field heat <a
}

@test "the errors of diffuse and pse on the same particles are those of diffuse.md, on a lattice of 20^3 off the nodes (000:N08)" {
	pinit lattice --dim 3 -n 8000 --spacing 1 | scalc --role state 'heat = sin(2*pi*x/Lx)' | scalc --extensive --role state 'volume = Lx*Ly*Lz/n' >a
	scalc 'rate = -(2*pi/Lx)^2*heat' <a >exact
	for row in "2 .00851" "4 .000426"; do
		p2m --strength heat --field heat --kernel m4prime <a | diffuse --field heat --nu 1 --order "${row% *}" | m2p --changes | scalc 'rate = dheat' >b
		within "$(scmp --norm relative_l2 --field rate b exact | tail -1 | cut -f8)" "${row#* }" "$(calc "0.01*${row#* }")" "mesh, order ${row% *}"
	done
	for row in "2 .0478" "4 .00154"; do
		pse --field heat --nu 1 --order "${row% *}" <a | scalc 'rate = dheat' >b
		within "$(scmp --norm relative_l2 --field rate b exact | tail -1 | cut -f8)" "${row#* }" "$(calc "0.01*${row#* }")" "pse, order ${row% *}"
	done
}

@test "LS-03: a Gaussian that turns once and spreads has the peak s^2/(s^2 + 2 nu t), on the mesh and between particles" {
	pinit lamb-oseen --cells 64 --box=-1,1 --nu 0.001 --dt "$(calc '2 * pi / 100')" | scalc 'x = x + 0.5, y' |
		scalc 'circulation = volume*exp(-50*((x-0.5)^2+y^2))' >a
	for rate in 'p2m | diffuse | m2p --changes' 'pse --order 4'; do # measured 0.4425 and 0.4440; pse of order 2 has 0.465
		cycle -q -n 100 "$rate | field 'vel=-y,x' | push lsrk3 | remesh" <a | p2m | diag -q --columns omega_max,circulation >d
		within "$(column omega_max <d | tail -1)" 0.443137275856 0.0044 "$rate" # 1 % of it
	done
}

# varied N [stab options]: f = 2 + sin(2 pi x) cos(2 pi y) on the nodes of N x N cells, nu = visc = 1 + cos(2 pi x)/2; rate, tensor: what df shall be
# with it and with the tensor 2, 0.5.
varied() {
	local n=$1
	shift
	lattice $n 1 "$@" | p2m -n $n | scalc --mesh mesh 'f = 2 + sin(2*pi*x)*cos(2*pi*y)' 'visc = 1 + cos(2*pi*x)/2' \
		'tensor = -10*pi^2*sin(2*pi*x)*cos(2*pi*y)' 'rate = -pi^2*(8*visc + 2*cos(2*pi*x))*sin(2*pi*x)*cos(2*pi*y)' |
		scalc --role state 'f = 0'
}
off() { mesh | awk -v w="$1" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { d = $at["df"] - $at[w]; d = d < 0 ? -d : d; if (d > m) m = d
	s += $at["df"] } END { print m, s }'; }

@test "diffuse --nu of a tensor and of a field converge with their order, and the sum stays" {
	for order in 2 4 6 spectral; do
		local tensor=() rates=() e s
		for n in 32 40 48; do
			varied $n >a
			read -r e s < <(diffuse --field f --order $order --nu 2,0.5 <a | off tensor)
			tensor+=("$(calc "1/$n")" "$e")
			read -r e s < <(diffuse --field f --order $order --nu visc <a | off rate)
			rates+=("$(calc "1/$n")" "$e")
			below "$s" 1e-8 "sum of 2304 rates" # of terms nu f/h^2 up to 1e5: 1e5 * 1.1e-16 * sqrt(2304 * 20) = 2e-9; a lost flux is 100
		done
		if [ $order = spectral ]; then # exact for few waves; round-off of (n/2)^2 pi^2 times 3
			below "${tensor[5]}" 1e-9
			below "${rates[5]}" 1e-9
		else
			order $order "${tensor[@]}"
			order $order "${rates[@]}"
		fi
	done
	# an expression is the field
	within "$(diffuse --field f --order 4 --nu '1 + cos(2*pi*x)/2' <a | off rate | cut -d ' ' -f 1)" \
		"$(diffuse --field f --order 4 --nu visc <a | off rate | cut -d ' ' -f 1)" 1e-12
}

@test "diffuse --nu of a field, order 2: the fluxes of faces with mean nu, between walls and at neumann faces too" {
	for faces in periodic wall neumann; do
		awk 'BEGIN { print "x f volume"; for (i = 0; i <= 8; i++) print i/8, 0, 1/8 }' | stab - --law passive --box 0,1 -n 8 --faces $faces \
			--particle-faces $([ $faces = periodic ] && echo periodic || echo reflect) |
			p2m --strength f --field f | scalc --mesh mesh 'f = (x + 0.1)*(x - 1)^2*x' 'visc = 1 + x^2' |
			diffuse --field f --order 2 --nu visc | mesh | awk -v faces=$faces 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
				{ f[NR-2] = $at["f"]; v[NR-2] = $at["visc"]; d[NR-2] = $at["df"]; n = NR - 1 }
				END { image = faces == "wall" ? -1 : 1; round = faces == "periodic"
					f[-1] = round ? f[n-1] : image * f[1]; v[-1] = round ? v[n-1] : v[1]
					f[n] = round ? f[0] : image * f[n-2]; v[n] = round ? v[0] : v[n-2]
					for (i = 0; i < n; i++) {
						want = 64 * ((v[i] + v[i+1])/2 * (f[i+1] - f[i]) - (v[i] + v[i-1])/2 * (f[i] - f[i-1]))
					e = want - d[i]; e = e < 0 ? -e : e; if (e > m) m = e }
					print m; exit !(n >= 8 && m < 1e-12) }'
	done
}

@test "diffuse --nu: white noise with nu up to 1 is stable below the limit and not above; what cannot be is refused" {
	for order in 2 4 6 spectral; do
		lattice 16 'sin(12.9898*(x*31 + y*977)^2*1e3)' >a
		f=$(p2m <a | diffuse --order $order --nu '1 - 0.5*(x < 0.25)' | sls --report --format json | grep -o '"fastest_dt":[0-9.e+-]*' | cut -d : -f 2)
		for c in 1.98 2.8; do
			smod --dt "$(calc "0.01*$c/$f")" <a | cycle -q -n 300 \
				"p2m | diffuse --order $order --nu '1 - 0.5*(x < 0.25)' | m2p --changes | field 'vel = 0, 0' | push --unsafe euler" |
				stab --plain | column circulation | awk '{ a = $1 < 0 ? -$1 : $1; if (a > m) m = a } END { print m }'
		done >grown
		awk 'NR == 1 { a = $1 } END { print a, $1; exit !(a < 0.004 && $1 > 1) }' grown # 1/256 is the largest strength at first
	done
	varied 16 >a
	run -2 bash -o pipefail -c 'diffuse --field f --nu 1,2,3 <a | sls'
	[[ $output == *"--nu '1,2,3' has 3 components: give one, or one for each of the 2 axes"* ]]
	run -2 bash -o pipefail -c 'diffuse --field f --nu visc,1 <a | sls'
	[[ $output == *"a tensor takes numbers, what varies is one expression for all axes"* ]]
	run -1 bash -o pipefail -c "diffuse --field f --nu 'visc - 1' <a | sls"
	[[ $output == *"somewhere on 'mesh': negative diffusion has no solution"* ]]
	sh_ok 'diffuse --field f --nu 0,1 <a | sls' # along y alone
}
