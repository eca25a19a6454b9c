# Divergence of neighbouring paths, phase-space volume, reversibility, and steps in part by chance.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# lambda RUN SHADOW [--window T0:T1]: slope and error
lambda() { stack --as matter,shadow "$1" "$2" | diag --columns time --separation matter,shadow --growth separation "${@:3}" | awk 'END { print $4, $6 + 0 }'; }

@test "000:S80, 000:N34: diag --separation has the exact slope of a linear flow, and the exponent of Lorenz's attractor" {
	printf 'x y\n1 2\n3 1\n' | stab - --law free --dt 0.01 --no-history >a
	smove --shift 1e-9,0 a >b
	for i in a b; do cycle -q -t 5 --every 5 "field 'vel = x, -y' | push rk4" <$i >r$i; done
	lambda ra rb --window 0:5 >slope
	within "$(cut -d' ' -f1 slope)" 1 1e-6 # 1e-9 in a place of 150 is known to 1e-5 at the end, and to more on the way
	printf 'x y z\n1 1 20\n' | stab - --law free --dt 0.01 >c
	lorenz="field 'vel = 10*(y - x), x*(28 - z) - y, x*y - 8/3*z' | push rk4"
	cycle -q -t 20 "$lorenz" <c | smod --time 0 >a
	perturb --relative 1e-14 a >b
	for i in a b; do cycle -q -t 40 --every 10 "$lorenz" <$i >r$i; done
	lambda ra rb >slope
	within "$(cut -d' ' -f1 slope)" 0.9056 0.2 # Sprott 2003, table 4.1; the error of one path of 31 times is 0.18
	between "$(cut -d' ' -f2 slope)" 0.05 0.4
}

@test "000:H28: two clusters that differ by 1e-10 separate as exp(lambda t), and have the same energy" {
	pinit plummer -n 100 --softening 0.05 >a
	perturb --relative 1e-10 a >b
	for i in a b; do cycle -q -t 20 --every 10 'push kick/2 drift | pp | push kick/2' <$i >r$i; done
	lambda ra rb >slope
	between "$(cut -d' ' -f1 slope)" 0.3 1 # of the order of one crossing time; measured 0.59 +- 0.08
	stack --as matter,shadow ra rb | diag --columns time --separation matter,shadow | awk 'END { print $2 }' >last
	above "$(cat last)" 1e-6
	for i in a b; do diag --columns energy --pair r$i | tail -1; done >energies
	below "$(paste -sd' ' energies | awk '{ print $1 / $2 - 1 }')" 1e-7
}

@test "002:H16: a step of a symplectic scheme keeps areas of phase space; those of Euler and implicit Euler do not" {
	printf 'x vx\n1.1 0.4\n1.1000001 0.4\n1.1 0.4000001\n' | stab - --law free --dt 0.1 >a
	force='field acc=-sin(x)'
	area() { cycle -q -n 20 "$1" <a | stab --plain | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
		{ n++; x[n] = $(at["x"]); v[n] = $(at["vx"]) } 
		END { printf "%.9g", ((x[2] - x[1]) * (v[3] - v[1]) - (x[3] - x[1]) * (v[2] - v[1])) / 1e-14 }'; }
	for words in "push kick/2 drift | $force | push kick/2" "$force | push yoshida4" "$force | push implicit-midpoint"; do
		within "$(area "$words")" 1 3e-6 "$words" # triangles of 1e-7: the curvature within them, and residuals of 1e-13
	done
	above "$(area "$force | push euler --unsafe")" 1.05 # each step by 1 + dt^2 cos x
	below "$(area "$force | push implicit-euler")" 0.95
}

@test "000:S67: the same number of steps backwards leads back with kicks and drifts, yoshida4, implicit midpoint and trapezoid; not with rk2" {
	printf 'x vx\n1.1 0.4\n' | stab - --law free --dt 0.1 >a
	force='field acc=-sin(x)'
	back() { cycle -q -n 50 "$1" <a | push clear | cycle -q -n 50 "${1/push /push --dt -0.1 }" | stab --plain |
		awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i } END { x = $(at["x"]) - 1.1; v = $(at["vx"]) - 0.4; print sqrt(x * x + v * v) }'; }
	for words in "push kick/2 drift | $force | push kick/2" "$force | push yoshida4"; do
		below "$(back "$words")" 2e-14 "$words" # a hundred roundings
	done
	for scheme in implicit-midpoint trapezoid; do
		below "$(back "$force | push $scheme")" 1e-11 "$scheme" # a hundred residuals of 1e-13
	done
	above "$(back "$force | push rk2 --unsafe")" 1e-4
}

@test "000:H36: drift by a rate and steps by chance in one sentence: the means of a linear rate are those of the equation, of another they are not" {
	awk 'BEGIN { print "x"; for (i = 0; i < 20000; i++) print 1 }' | stab - --law free --dt 0.02 --number >a
	# mean e^-t, variance nu (1 - e^-2t) of Ornstein and Uhlenbeck; 20000 walks know them to 0.7 % and 1 % of the deviation and the variance
	cycle -q -n 50 'field vel=-x | push rk4 | walk --nu 0.2' <a | stab --plain |
		awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { x = $(at["x"]); n++; s += x; q += x * x }
		END { print s / n, q / n - (s / n)^2 }' >moments
	within "$(cut -d' ' -f1 moments)" 0.36788 0.012
	within "$(cut -d' ' -f2 moments)" 0.17293 0.008 # and dt of the splitting
	# x' = x - x^3 stays at 1; with chance the mean is lower by some 3 nu/(2 2) of it
	cycle -q -n 50 'field vel=x-x^3 | push rk4 | walk --nu 0.1' <a | stab --plain | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
		{ n++; s += $(at["x"]) } END { print s / n }' >mean
	between "$(cat mean)" 0.8 0.96
}
