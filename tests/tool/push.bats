# push as a word: its sentences when it refuses, what it leaves in the stream, bytes for any number of threads. The rules one by one are in
# tests/unit/push.c. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# refuses STATUS 'WORDS' COMMAND LINE: the exit status, and the words on stderr.
refuses() {
	run -"$1" bash -o pipefail -c "$3 >/dev/null"
	[[ $output == *"$2"* ]] || { echo "wanted '$2', got: $output"; return 1; }
}

@test "push kick without acc exits 1 and says how to compute it" {
	refuses 1 "push: frame 1: no field 'acc' on 'matter' (compute it first: p2m | poisson-fft | mgrad | m2p, or pp)" "pinit two-body | push kick"
	refuses 1 "no field 'acc' on 'matter' (compute it first" "pinit two-body | push rk4"
	refuses 1 "no field 'acc'" "pinit two-body | pp | push drift | push kick" # drift took it away
}

@test "a misspelt action exits 2 with the nearest name, a part of a scheme and a kick after a drift are refused" {
	refuses 2 "did you mean 'drift'" "pinit two-body | push drfit"
	refuses 2 "schemes have no parts" "pinit two-body | push rk4/2"
	refuses 2 "push drift | force | push kick" "pinit two-body | push drift kick"
}

@test "kick and drift that do not add up to a step exit 1" {
	refuses 1 "kick on 'matter' adds up to 1.5 of a step" "pinit two-body | pp | push kick | push kick/2"
	refuses 1 "drift on 'matter' adds up to 2 of a step" "pinit two-body | pp | push kick/2 drift | pp | push kick/2 drift"
	refuses 1 "rk2 on 'matter' in the middle of a step" "pinit two-body | pp | push kick/2 | push rk2"
	refuses 1 "while rk4 is under way" "pinit two-body | pp | push rk4 | push drift"
	refuses 1 "may change only at substep 0" "pinit two-body | pp | push kick/2 | push drift --dt 0.5"
}

@test "a change on a mesh that m2p has not carried over is refused" {
	pinit two-body --cells 4 | stab > a
	dv='{"components":1,"kind":"value","name":"dv","of":"v","on":"mesh","role":"change","terms":["self"],"type":"f64","uniform":[1.0],"unit":""}'
	sed -e '1s/"fields":\[{/"fields":['"$dv"',{/' a > b
	refuses 1 "the change 'dv' of 'v' is on mesh 'mesh' and not yet on 'matter' (carry it over with m2p)" "stab b | push kick"
}

@test "registers live between the passes of rk4 and are gone after the last" {
	pinit two-body | pp | push rk4 > a
	stab < a | grep -q '"name":"q_x"'
	stab < a | grep -q '"name":"q2_v"'
	[ "$(stab < a | grep -c '"role":"register"')" = 1 ] # all in the one line of the header
	pp < a | push rk4 | pp | push rk4 | pp | push rk4 > b
	run ! grep -aq register b
	sls < b | grep -q 'step 1 substep 0'
}

@test "ab3 takes three passes in its first two steps and one from then on" {
	pinit two-body > a
	local passes=0
	for want in 1 1 1 2 2 2 3 4 5; do # the step under way in each pass
		[ "$(sls < a | grep -o ' step [0-9]*')" = " step $((want - 1))" ]
		pp < a | push ab3 > b
		mv b a
		passes=$((passes + 1))
	done
	sls < a | grep -q 'step 5 substep 0'
	counted $passes
}

@test "the bytes do not depend on the number of threads, for every action and scheme" {
	pinit uniform -n 5001 --dispersion 1 > a
	for words in 'kick/2 drift' euler rk2 midpoint rk4 lsrk3 ab2 ab3; do
		for t in 1 2 3; do
			OMP_NUM_THREADS=$t cycle -n 2 "p2m -n 8 | poisson-fft | mgrad | m2p --replace | push $words$([[ $words == kick* ]] &&
				echo ' | p2m -n 8 | poisson-fft | mgrad | m2p | push kick/2')" < a > "b$t"
		done
		same_as b1 b2
		same_as b1 b3
	done
}

@test "particles that leave through an absorbing face are removed and counted, and a run with no particle left continues" {
	printf 'x y z vx vy vz id\n1 1 1 -9 0 0 1\n1 1 1 0 0 0 2\n1 1 1 0 9 0 3\n' > t
	stab t --box 0,2 --particle-faces absorb --dt 0.5 | push drift > a
	stab --plain < a | cut -f1 > ids
	[ "$(stab --plain < a | wc -l)" = 2 ]
	grep -aq '"absorbed":2' a
	printf 'x y z vx vy vz\n1 1 1 9 0 0\n' > t
	stab t --box 0,2 --particle-faces absorb --dt 0.5 | push drift | push drift | sls | grep -q 'set matter: 0 particles'
	counted 3 # that left
}

@test "FP-04: -1e-17 is folded to the lower face, never to L" {
	printf 'x y z vx vy vz\n-1e-17 1 2 0 0 0\n' > t
	stab t --box 0,2 --faces periodic --particle-faces periodic --dt 0.5 | push drift | stab --plain > a
	awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { exit !($c["x"] == 0 && $c["y"] == 1 && $c["z"] == 0) }' a
	within "$(awk 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "x") c = i; next } { print $c }' a)" 0 0 x
}

@test "boris/2 refuses what it cannot do: no bfield, whole steps, a kick beside it; and a plain kick refuses a bfield" {
	refuses 1 "no field 'bfield' on 'electrons' (m2p makes it of a B on the mesh" \
		"pinit langmuir -n 16 --velocities 2 | p2m | poisson-fft | mgrad | m2p | push boris/2"
	refuses 1 "turns velocities of 2 or 3 components, and 'electrons' has 1" "pinit langmuir -n 16 | p2m | poisson-fft | mgrad | m2p | push boris/2"
	refuses 2 "push boris/2 drift | force | push boris/2" "pinit gyration | m2p | push boris"
	refuses 2 "no kick stands beside a magnetic one" "pinit gyration | m2p | push kick/2 boris/2"
	refuses 2 "no kick stands beside a magnetic one" "pinit gyration | m2p | push boris/2 kick/2"
	refuses 1 "has a magnetic field, which a plain kick would leave out (use a magnetic scheme: push boris/2)" "pinit gyration | m2p | push kick/2"
	refuses 1 "adds up to 1.5 of a step" "pinit gyration | m2p | push boris/2 | push boris/2 | push boris/2"
	counted 7
}

@test "boris/2 keeps acc and bfield, counts as half a kick, and two halves about a time turn v by 2 atan(Omega dt/2)" {
	pinit gyration --dt 0.5 | m2p > a
	push boris/2 < a > b
	stab < b | grep -q '"name":"bfield"'
	stab < b | grep -q '"kick":0.5'
	push boris/2 drift < a | m2p | push boris/2 > c
	sls < c | grep -q 'step 1 substep 0'
	stab < c | grep -q '"name":"bfield"'
	angle=$(stab --plain --set electrons < c | awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { printf "%.17g", atan2($c["vy"], $c["vx"]) }')
	within "$angle" 0.489957326253728 1e-15 "PIC-12: angle of a step"
}

@test "a magnetic field in the plane of two velocity components is refused, with three it turns them out of the plane" {
	pinit gyration > a
	edited -e '1,2s/"uniform":\[0.0,0.0,1.0\]/"uniform":[0.0,1.0,0.0]/' a > b # the same length
	refuses 1 "a magnetic field in the plane turns them out of it (give v 3 components)" "m2p < b | push boris/2"
	pinit gyration --velocities 3 | edited -e '1,2s/"uniform":\[0.0,0.0,1.0\]/"uniform":[0.0,1.0,0.0]/' > c
	m2p < c | push boris/2 drift | m2p | push boris/2 | stab --plain --set electrons > t
	within "$(awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { printf "%.17g", atan2($c["vz"], $c["vx"]) }' t)" -0.0999167914438855 1e-15
}

@test "the bytes of boris do not depend on the number of threads, nor on the way of running" {
	pinit langmuir -n 20002 --velocities 3 --no-history | stab > a
	B='{"components":3,"kind":"value","name":"B","on":"mesh","role":"state","type":"f64","uniform":[0.3,-0.2,1.0],"unit":""}'
	sed -e '1s/"fields":\[{/"fields":['"$B"',{/' a > t
	stab t --no-history > b
	local words='push boris/2 drift | p2m | poisson-fft | mgrad | m2p | push boris/2'
	for t in 1 2 3; do
		OMP_NUM_THREADS=$t cycle --no-history -n 3 "$words" < b > "c$t"
		OMP_NUM_THREADS=$t cycle --no-history -n 3 --engine pipes "$words" < b > "d$t"
		same_as c1 "c$t"
		same_as c1 "d$t"
	done
	stab < c1 | grep -q '"name":"bfield"'
}

# limits: those in the tail of a stream's last frame, "KEY DECAY OSCILLATION STRAIN" a line.
limits() {
	stab | sed -n 's/^#limits //p' | tail -n 1 | grep -o '"[^"]*":{[^}]*}' |
		sed 's/"\([^"]*\)":{"decay":\([^,]*\),"oscillation":\([^,]*\),"strain":\([^}]*\)}/\1 \2 \3 \4/'
}

@test "the limits of a change travel with it: m2p takes them to the strength, push and clear drop them, --replace computes them anew" {
	pinit lamb-oseen --cells 32 --dt 1e-3 | p2m | poisson-fft | mgrad | diffuse >a
	rate=$(limits <a | awk '$1 == "mesh/domega" && NF == 4 && $3 == 0 && $4 == 0 { print $2 }') # nu times the largest eigenvalue of the Laplacian
	# what diffuse reports, divided by dt and so to round-off
	within "$rate" "$(sls --report <a | sed -n 's/.*"fastest_dt":\([^},]*\).*/\1/p' | awk '{ printf "%.17g", $1 / 1e-3 }')" 1e-14
	m2p <a >b
	[ "$(limits <b | awk '$1 == "vortices/dcirculation" { print $2 }')" = "$rate" ]
	within "$(limits <b | awk '$1 == "vortices/vel" { print $4 }')" \
		"$(dt --lcfl 1 <a | sls | sed -n 's/.* dt \([0-9.e-]*\) .*/\1/p' | awk '{ printf "%.12g", 1 / $1 }')" 1e-8
	m2p --replace <b >c
	same_as <(limits <b) <(limits <c)
	[ -z "$(push euler <b | limits)" ]
	[ -z "$(push clear <b | limits)" ]
	# as text, as HDF5 and renamed: the same entries
	stab <b | stab - >f
	same_as b f
	sh5 -o b.h5 <b
	sh5 b.h5 >g
	same_as b g
	[ "$(smod --rename vortices=eddies <b | limits | grep -c '^eddies/')" = 2 ]
}

@test "decays of a change add, of oscillations and strains the largest counts" {
	printf 'x vx mass\n1 0 1\n' | stab - --law free --dt 0.1 >a
	field 'acc = -4*x - 3*vx' <a | field --term drag 'acc = -2*vx - x' | limits >t
	read -r key decay oscillation strain <t
	[ "$key $strain" = 'matter/acc 0.0' ]
	within "$decay" 5 1e-9 # differences of a linear expression: round-off over 1e-5
	within "$oscillation" 2 1e-9
	printf 'x y\n1 0\n' | stab - --law free --dt 0.1 | field 'vel = 3*y, -x' | field --term more 'vel = 2*y, 0' | limits >t
	read -r key decay oscillation strain <t
	within "$strain" 3 1e-9
}

@test "pp, m2p and field state the frequency: of an orbit, of a plasma, of a spring, of a charge in a magnetic field" {
	# two bodies of 1/2 at distance 1 turn at 1; from one mass alone and the sum of both, |a|^(3/2)/(G M)^(1/2) = 2^(-3/2), its root
	within "$(pinit two-body | pp --softening 0 | limits | awk '{ print $3 }')" 0.59460355750136051 1e-12
	force='p2m | poisson-fft | mgrad | m2p'
	within "$(pinit langmuir | p2m | poisson-fft | mgrad | m2p | limits | awk '{ print $3 }')" 1 1e-12
	pinit gyration | m2p | limits >t
	within "$(awk '$1 ~ /bfield/ { print $3 }' t)" 1 1e-12 # q B/m of the scene
}

@test "a step beyond the scheme's stable oscillation is refused with the word, the number and the remedy, and --unsafe takes it" {
	for force in 'p2m | poisson-fft | mgrad | m2p' 'pp'; do
		run -3 bash -o pipefail -c "pinit plummer --dt 5 | cycle -n 2 'push kick/2 drift | $force | push kick/2' | sls"
		[[ $output == *"times the limit of a kick: 'acc' of 'matter' (self) oscillates at up to "*"(dt up to "*", or --unsafe)"* ]]
		sh_ok "pinit plummer --dt 0.5 | cycle -n 1 'push kick/2 drift | $force | push kick/2' | sls"
	done
	# a spring: leapfrog to 2, rk4 to 2.83; schemes that are stable for no oscillation to where it doubles within a period
	spring() { printf 'x vx\n1 0\n' | stab - --law free --dt "$1" | cycle -n 9 "$2"; }
	for case in '1.99 2.01 a kick|push kick/2 drift, field acc=-x, push kick/2' '2.82 2.84 rk4|field acc=-x, push rk4' \
		'1.73 1.74 lsrk3|field acc=-x, push lsrk3' '0.99 1 rk2|field acc=-x, push rk2' '0.99 1 midpoint|field acc=-x, push midpoint' \
		'0.226 0.227 euler|field acc=-x, push euler' '0.6 0.602 ab2|field acc=-x, push ab2' '0.72 0.73 ab3|field acc=-x, push ab3'; do
		read -r below beyond name <<<"${case%|*}"
		words=${case#*|} words=${words//,/ |}
		spring "$below" "$words" >a
		run -3 spring "$beyond" "$words"
		[[ $output == *"the limit of $name: 'acc' of 'matter' (external) oscillates"* ]]
		# those that have a limit without growth, with the six digits of the message
		case $name in 'a kick') want=2 ;; rk4) want=2.828427 ;; lsrk3) want=1.732051 ;; ab3) want=0.7236 ;; *) want= ;; esac
		[ -z "$want" ] || within "$(sed -n 's/.*(dt up to \([0-9.]*\),.*/\1/p' <<<"$output" | head -n 1)" "$want" 1e-5 "$name"
		spring "$beyond" "${words//push /push --unsafe }" >a
	done
	# a step of leapfrog in two parts: each of half the length
	spring 3.9 'push kick/4 drift/2 | field acc=-x | push kick/2 drift/2 | field --replace acc=-x | push kick/4' >a
	run -3 spring 4.1 'push kick/4 drift/2 | field acc=-x | push kick/2 drift/2 | field --replace acc=-x | push kick/4'
}

@test "a decay is refused beyond the real axis, of friction as of diffusion; the limit of older streams, fastest, is read" {
	drag() { printf 'x vx\n1 1\n' | stab - --law free --dt 1 | cycle -n 3 "$1"; }
	drag 'push kick/2 drift | field acc=-1.99*vx | push kick/2' >a
	run -3 drag 'push kick/2 drift | field acc=-2.01*vx | push kick/2'
	[[ $output == *"'acc' of 'matter' (external) decays at up to 2.01 per time"* ]]
	pinit lamb-oseen --cells 32 --dt 0.1 | p2m | poisson-fft | mgrad | diffuse | m2p >a
	stab <a | sed '/^#limits/d; s/"name":"dcirculation"/"fastest":21,&/' | stab - >old
	run -3 bash -o pipefail -c 'push euler <old | sls'
	[[ $output == *"'dcirculation' of 'vortices' (diffusion) decays at up to 21 per time"* ]]
	sh_ok 'push euler <a | sls; push euler --unsafe <old | sls'
}

@test "a strain dt above 1 is told once and never refused" {
	for engine in fused pipes; do
		pinit lamb-oseen --cells 64 --nu 1e-4 --dt 0.02 |
			cycle -n 4 --engine $engine 'p2m --outside grow | poisson-fft | mgrad | m2p | push lsrk3' 2>said | sls
		[ "$(grep -c 'push: dt |grad u| is 7.5[0-9]* for .vortices. (dt 0.02)' said)" = 1 ]
		strain=$(grep -o 'is 7.5[0-9]*' said | cut -c 4-)
		above "$strain" 1 "told"
	done
	below "$(awk -v x="$strain" 'BEGIN { print x / 10 }')" 1 "not told" # a tenth of the step
	pinit lamb-oseen --cells 64 --nu 1e-4 --dt 0.002 | cycle -n 1 'p2m --outside grow | poisson-fft | mgrad | m2p | push lsrk3' 2>said | sls
	[ ! -s said ]
}

@test "the Courant number of the particles is in the report where the frame has a field on a mesh" {
	printf 'x y vx vy mass\n1 1 3 0 1\n2 2 -1 -5 1\n' | stab - --law gravity --constant G=1e-30 --box 0,16 --faces periodic -n 8 --dt 0.2 >a
	run -0 bash -o pipefail -c 'push drift <a | sls --report'
	[[ $output != *courant* ]]
	# 5 * 0.2 in cells of 2, at any number of threads and for parts of a step
	for words in drift 'drift/4' 'kick/2 drift'; do
		run -0 bash -o pipefail -c "p2m <a | poisson-fft | mgrad | m2p | push $words | sls --report"
		[[ $output == *'"courant":0.5}'* ]]
	done
}

@test "000:S69, S70, 001:C7: velocity and position Verlet have the positions of the recursion x(t + dt) = 2 x - x(t - dt) + a dt^2" {
	printf 'x vx\n1.1 0.4\n' | stab - --law free --dt 0.1 >a
	cycle -q -n 50 --every 1 'push kick/2 drift | field acc=-sin(x) | push kick/2' <a | stab --plain | awk '$1 + 0 == $1' >velocity # x, acc, vx
	awk 'NR == 1 { print NF }' velocity | grep -qx 3
	awk 'NR > 2 { d = $1 - (2 * x1 - x0 - 0.01 * sin(x1)); d = d < 0 ? -d : d; if (d > m) m = d } { x0 = x1; x1 = $1 } END { print m }' velocity >most
	below "$(cat most)" 1e-15 # rounding of 2 x
	# velocities are (x(t + dt) - x(t - dt))/(2 dt)
	awk 'NR > 2 { d = v1 - ($1 - x0) / 0.2; d = d < 0 ? -d : d; if (d > m) m = d } { x0 = x1; x1 = $1; v1 = $3 } END { print m }' velocity >most
	below "$(cat most)" 2e-14 # rounding over 2 dt
	# position Verlet: the same recursion for the places of the force, half a step on
	cycle -q -n 50 --every 1 'push drift/2 | field acc=-sin(x) | push kick drift/2' <a | stab --plain |
		awk '$1 + 0 == $1 { printf "%.17g\n", $1 + 0.05 * $NF }' >middle
	awk 'NR > 2 { d = $1 - (2 * x1 - x0 - 0.01 * sin(x1)); d = d < 0 ? -d : d; if (d > m) m = d } { x0 = x1; x1 = $1 } END { print m }' middle >most
	below "$(cat most)" 2e-15
}

@test "001:C3, 001:N35: leapfrog of two steps is its recursion; it keeps an oscillation and lets a decay grow by its second root" {
	printf 'x\n1\n' | stab - --law free --dt 0.1 >a
	cycle -q -n 200 'field vel=-x | push leapfrog2 --unsafe' <a | stab --plain | awk 'END { printf "%.17g", $1 }' >x
	awk 'BEGIN { a = 1; b = 0.905; for (i = 2; i <= 200; i++) { c = a - 0.2 * b; a = b; b = c }; printf "%.17g", b }' >want
	above "$(awk '{ print $1 < 0 ? -$1 : $1 }' x)" 1e3 # and e^-20 is 2e-9
	within "$(cat x)" "$(cat want)" "$(awk '{ print 1e-9 * ($1 < 0 ? -$1 : $1) }' want)"
	printf 'x vx\n1 1\n' | stab - --law free --dt 0.1 >a
	run -3 bash -o pipefail -c "cycle -q -n 200 'field acc=-vx | push leapfrog2' <a >b"
	[[ $output == *'leapfrog2 has a second root that grows where there is any decay'* ]]
	# its register goes through the faces: a circle in a periodic box is that in open space, folded
	printf 'x y\n0.3 0.5\n' | stab - --law free --dt 0.1 --box 0,1 --particle-faces periodic >p
	cycle -q -n 40 'field vel=0.7,0.9*cos(time) | push leapfrog2' <p | stab --plain | awk 'END { print $1 }' >fold
	within "$(cat fold)" 0.1 1e-12 # 0.3 + 2.8, folded
}

@test "000:S70, 000:N33: position and velocity of Verlet's three forms are of order 2, also the velocity corrected by the accelerations beside it" {
	for n in 20 40 80; do
		printf 'x vx\n1 0.3\n' | stab - --law free --dt "$(calc "1/$n")" >a
		# one step more, because the corrected velocity is known a step late; a = -x
		cycle -q -n $((n + 1)) --every 1 'push kick/2 drift | field acc=-x | push kick/2' <a | stab --plain | awk '$1 + 0 == $1 { print $1, $NF }' >v
		cycle -q -n $n 'push drift/2 | field acc=-x | push kick drift/2' <a | stab --plain | awk '$1 + 0 == $1 { print $1, $NF }' >p
		awk -v n=$n 'FILENAME == "p" { px = $1; pv = $2; next } { x[FNR - 1] = $1; v[FNR - 1] = $2 }
			function off(a, b) { return a > b ? a - b : b - a }
			END { want = cos(1) + 0.3 * sin(1); rate = 0.3 * cos(1) - sin(1)
				corrected = (x[n + 1] - x[n - 1]) * n / 2 + (x[n + 1] - x[n - 1]) / (12 * n) # dt/12 (a(t - dt) - a(t + dt))
				print 1 / n, off(x[n], want), off(v[n], rate), off(corrected, rate), off(px, want), off(pv, rate) }' p v >>errors
	done
	for k in 2 3 4 5 6; do
		awk -v k=$k '{ x = log($1); y = log($k); n++; a += x; b += y; c += x * x; d += x * y }
			END { print (n * d - a * b) / (n * c - a * a) }' errors >order
		within "$(cat order)" 2 0.05 "column $k" # the next term is dt^2 of it, 1/400 to 1/6400
	done
}

@test "landau-lifshitz: a gyrating electron loses energy as the exact solution, order 2 there and in crossed fields; without radiation_time it is refused" {
	# radiating N VELOCITIES FIELDS COMPONENTS: a charge of c = 1 to t = 20 in N steps; prints gamma and vx
	radiating() {
		printf 'x y z vx vy vz mass charge\n0 0 0 %s 1 -1\n' "$2" | stab - --law electrostatic --box=-100,100 --dt "$(calc 20/$1)" |
			smod --constant c=1,radiation_time=2e-3 | cycle -q -n $1 "push landau-lifshitz/2 drift | field $3 | push landau-lifshitz/2" >a
		stab --plain a | awk '/vx/ { for (k = 1; k <= NF; k++) c[$k] = k; next }
			{ v = $c["vx"]^2 + $c["vy"]^2 + $c["vz"]^2; printf "%.15g %.15g\n", 1 / sqrt(1 - v), $c["vx"] }'
	}
	circle= crossed=
	for n in 100 200 400; do
		read -r gamma _ < <(radiating $n "0 $(calc 'sqrt(0.99)') 0" "'acc = 0, 0, 0' 'bfield = 0, 0, 1'")
		circle="$circle $(calc 20/$n) $(calc "$gamma - 7.172505597275912")" # coth(0.04 + arcoth 10)
		read -r _ v < <(radiating $n "0.9 0.1 0.2" "'acc = 0.3, 0.2, -0.1' 'bfield = 0.2, -0.4, 1'")
		crossed="$crossed $(calc 20/$n) $(calc "$v - 0.49289967")" # scipy's solve_ivp to 1e-11
	done
	order 2 $circle
	order 2 $crossed
	within "$gamma" 7.172505597275912 1e-6
	read -r gamma _ < <(radiating 50 "0.6 0 0" "'acc = 0.5, 0, 0'  'bfield = 0, 0, 0'") # along a field that is even nothing is lost
	within "$gamma" "$(calc 'sqrt(1 + 10.75^2)')" 1e-9
	run -1 --separate-stderr bash -o pipefail -c "printf 'x y vx vy mass charge\n0 0 0 0 1 1\n' | stab - --law electrostatic --dt 1 | smod --constant c=1 |
		field 'acc = 0, 0' 'bfield = 0, 0, 1' | push landau-lifshitz/2 | sls"
	[[ $stderr == *'the frame has no radiation_time'* ]]
}
