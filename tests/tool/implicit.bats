# Implicit schemes of push: amplification, order, every way of running, stiff rates, and what they refuse. Their regions: docs/stability.md.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# after SCHEME RATE DT [N]: the second of two particles after N steps, from 2; the first has half of it
after() {
	printf 'x\n1\n2\n' | stab - --law free --dt "$3" | cycle -q -n "${4:-1}" "field 'vel = $2' | push $1" | stab --plain | awk 'END { print $1 }'
}

@test "000:S65: the amplification of a step is 1/(1 + z) of implicit Euler, (1 - z/2)/(1 + z/2) of trapezoid and midpoint, z from 0.3 to 1e8" {
	for z in 0.3 3 1e3 1e8; do # 1e-12: the residual is 1e-13 of the state before the step
		within "$(after implicit-euler "-$z*x" 1)" "$(awk -v z=$z 'BEGIN { printf "%.17g", 2 / (1 + z) }')" 1e-12
		for scheme in trapezoid implicit-midpoint; do
			within "$(after $scheme "-$z*x" 1)" "$(awk -v z=$z 'BEGIN { printf "%.17g", 2 * (1 - z / 2) / (1 + z / 2) }')" 1e-12
		done
	done
	# 001:C5: implicit Euler hides a growth faster than 2/dt
	within "$(after implicit-euler '3*x' 1)" -1 1e-12
}

@test "orders 1, 2, 2 of a rate that depends on place and time, from three steps" {
	# x' = -x^2 cos t: x = 1/(1/2 + sin t)
	for scheme in implicit-euler:1 trapezoid:2 implicit-midpoint:2; do
		for n in 20 40 80; do
			dt=$(awk -v n=$n 'BEGIN { printf "%.17g", 1.5 / n }')
			echo "$dt $(after ${scheme%:*} '-x^2*cos(time)' "$dt" $n)"
		done | awk '{ e = $2 - 1 / (0.5 + sin(1.5)); x = log($1); y = log(e < 0 ? -e : e); n++; a += x; b += y; c += x * x; d += x * y }
			END { print (n * d - a * b) / (n * c - a * a) }' >order
		within "$(cat order)" "${scheme#*:}" 0.1 "${scheme%:*}" # the next term of the error, dt of the first
	done
}

@test "implicit midpoint keeps the radius of a rotation of any speed, implicit Euler damps it by 1/sqrt(1 + z^2) a step" {
	for z in 0.5 50; do
		printf 'x y\n1 0\n0 2\n' | stab - --law free --dt 1 >a
		cycle -q -n 20 "field 'vel = -$z*y, $z*x' | push implicit-midpoint" <a |
			stab --plain | awk 'NR > 1 { printf "%.17g\n", sqrt($1^2 + $2^2) }' >radii
		within "$(sed -n 1p radii)" 1 1e-11 # 20 residuals of 1e-13
		within "$(sed -n 2p radii)" 2 2e-11
		cycle -q -n 3 "field 'vel = -$z*y, $z*x' | push implicit-euler" <a | stab --plain | awk 'NR == 2 { printf "%.17g", sqrt($1^2 + $2^2) }' >radius
		within "$(cat radius)" "$(awk -v z=$z 'BEGIN { printf "%.17g", (1 + z * z)^-1.5 }')" 1e-12
	done
}

@test "a stiff oscillator of van der Pol is followed by implicit Euler in steps 1000 times as long as those of rk4 at its limit" {
	printf 'x vx\n2 0\n' | stab - --law free --dt 0.5 >a
	cycle -q -n 200 "field 'acc = 1000*(1 - x^2)*vx - x' | push implicit-euler" <a | stab --plain | awk 'END { print $1 }' >x
	# on the slow branch ln x - x^2/2 = ln 2 - 2 + t/1000 (Hairer and Wanner 1996, IV.1), to 1/1000^2 and dt/1000
	within "$(awk '{ print log($1) - $1^2 / 2 }' x)" "$(awk 'BEGIN { print log(2) - 2 + 0.1 }')" 1e-3
	run -3 bash -o pipefail -c "cycle -q -n 200 \"field 'acc = 1000*(1 - x^2)*vx - x' | push rk4\" <a >b"
	[[ $output == *'times the limit of rk4'* ]]
}

@test "Robertson's kinetics, rates of 0.04, 1e4 and 3e7: implicit Euler, trapezoid and midpoint come to 0.71582707 at t = 40, and no step finds another root" {
	rates="field 'vel = -0.04*x+1e4*y*z, 0.04*x-1e4*y*z-3e7*y^2, 3e7*y^2'"
	printf 'x y z\n1 0 0\n' | stab - --law free --dt 0.1 >a
	for scheme in implicit-euler:4e-4 trapezoid:2e-3 implicit-midpoint:1e-5; do # the first of order 1; trapezoid lets the first fast decay ring
		cycle -n 400 "$rates | push ${scheme%:*}" <a 2>said >b
		within "$(stab --plain b | awk 'END { print $1 }')" 0.71582707 "${scheme#*:}" "${scheme%:*}" # Hairer and Wanner 1996, IV.10
		run ! grep 'another solution' said
	done
	cycle -q -n 1 "$rates | push implicit-euler" <a | stab --plain | awk 'END { print $2 }' >y
	# y of the first step is the positive root; the other is -7e-5
	below 0 "$(cat y)"
	smod --dt 40 <a | cycle -q -n 1 "$rates | push implicit-euler" | stab --plain | awk 'END { print $1 + $2 + $3 - 1, $2 }' >end
	within "$(cut -d' ' -f1 end)" 0 1e-12 # ten residuals
	below 0 "$(cut -d' ' -f2 end)"
}

@test "implicit Euler of x' = -x^3 finds the one real root for any dt; one beyond the growth is told and counted" {
	for dt in 1 100 1e12; do
		within "$(after implicit-euler '-x^3' $dt | awk -v dt=$dt '{ print $1 + dt * $1^3 }')" 2 1e-12 # ten residuals
	done
	printf 'x\n1\n' | stab - --law free --dt 1 >a
	cycle -n 3 "field 'vel = 3*x' | push implicit-euler" <a 2>said >b
	[ "$(grep -c 'for 1 particles dt 1 is beyond 1/growth' said)" = 1 ]
	sls --report b | grep -qE '"?beyond"?:? *3' || { sls --report b >&2; return 1; }
	cycle -n 3 "field 'vel = 0.9*x' | push implicit-euler" <a 2>said >b
	run ! grep growth said
}

@test "equal bytes by Newton's method: stiff rates of three values, two sets with different numbers of them, any engine, threads, resumed" {
	seq 4200 | awk 'BEGIN { print "x y z vx vy vz" } { print $1 / 4200, 1, 0, 0, 1 / $1, 0 }' | stab - --law free --dt 0.3 --set a --no-history >a
	seq 50 | awk 'BEGIN { print "x y z" } { print 1, $1 / 50, 0 }' | stab - --law free --dt 0.3 --set b --no-history >b
	stack --no-history a b >now
	words="field --set a 'acc = -30*vx - x - 100*x^3, -1e3*vy^3, -vz' | field --set b 'vel = -1e3*x*y, -1e3*y^3 - z, 10*y' | push implicit-euler"
	cycle -q --no-history -n 3 "$words" <now >want
	for way in "1 fused" "3 fused" "3 pipes"; do
		OMP_NUM_THREADS=${way% *} cycle -q --no-history -n 3 --engine ${way#* } "$words" <now >got
		same_as want got
	done
	cycle -q --no-history -n 1 --checkpoint c "$words" <now >got
	cycle -q --no-history -n 3 --resume c "$words" >got
	same_as want got
	cycle -q --no-history -n 3 --ranks 3 "$words" <now >got
	same_as want got
}

@test "equal bytes: implicit midpoint of bodies that attract each other, fused, as processes, with 1 and 3 threads, resumed, and from the middle of a step" {
	pinit plummer -n 30 --softening 0.1 --dt 0.2 --no-history >now
	words='pp | push implicit-midpoint'
	cycle --no-history -n 4 "$words" <now >want
	for threads in 1 3; do
		for engine in fused pipes; do
			OMP_NUM_THREADS=$threads cycle --no-history -n 4 --engine $engine "$words" <now >got
			same_as want got
			OMP_NUM_THREADS=$threads cycle --no-history -n 2 --checkpoint c --engine $engine "$words" <now >got
			OMP_NUM_THREADS=$threads cycle --no-history -n 4 --resume c --engine $engine "$words" >got
			same_as want got
		done
	done
	pp --no-history <now | push implicit-midpoint --no-history | pp --no-history | push implicit-midpoint --no-history >middle
	cycle --no-history -n 4 "$words" <middle >got
	same_as want got
	# momentum to round-off: the iterates are weighted means of states that have it
	below "$(diag --columns momentum_x,momentum_scale want | awk 'END { print $1 / $2 }')" 1e-14
}

@test "diffusion at nu dt/h^2 = 26, far beyond the limit of an explicit step: implicit Euler keeps the sum, creates no new extremes, and nears the mean" {
	awk 'BEGIN { print "x y s volume"; for (i = 0; i < 256; i++) print (i % 16 + 0.5) / 16, (int(i / 16) + 0.5) / 16, i == 37, 1 / 256 }' |
		stab - --law passive --strength s --box 0,1 --faces periodic --particle-faces periodic --dt 0.1 >a
	spread() { stab --plain "$1" | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; low = 1; next }
		{ s = $(at["s"]); sum += s; if (s < low) low = s; if (s > high) high = s } END { print sum - 1, low, high }'; }
	cycle -q -n 1 "pse --field s --nu 1 | field 'vel = 0, 0' | push implicit-euler" <a >b # nu dt/h^2 = 26
	spread b >sums
	below "$(cut -d' ' -f1 sums)" 1e-13 # 256 roundings
	above "$(cut -d' ' -f2 sums)" 0
	below "$(cut -d' ' -f3 sums)" 0.05
	run -3 bash -o pipefail -c "cycle -q -n 1 \"pse --field s --nu 1 | field 'vel = 0, 0' | push rk4\" <a >c"
	[[ $output == *'times the limit of rk4'* ]]
}

@test "a step that does not converge ends the run with exit 3, in one line" {
	printf 'x\n0.3\n' | stab - --law free --dt 1 >a # x1 = 0.3 + 1 + x1^2 has no real solution
	run -3 bash -o pipefail -c "cycle -n 1 \"field 'vel = 1 + x^2' | push implicit-euler\" <a >b"
	[[ $output == *'push implicit-euler: '*'iterations of implicit-euler do not converge with dt 1 (residual '*'a shorter dt)'* ]]
}

@test "implicit schemes say what they cannot do" {
	pinit uniform -n 3 | smod --particle-faces reflect | field 'acc = 0, 0, 0' >a
	run -1 push trapezoid -i a -o b
	[[ $output == *'trapezoid follows a smooth path, and the box has faces that reflect particles'* ]]
	run -2 push trapezoid --tolerance 1e-3 -i a -o b
	[[ $output == *'--tolerance belongs to a scheme that chooses its steps by their error'* ]]
	pinit exb -n 2 | m2p >a
	run -1 push implicit-euler -i a -o b
	[[ $output == *'has a magnetic field, which implicit-euler would leave out'* ]]
}
