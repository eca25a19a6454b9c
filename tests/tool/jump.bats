# jump: Markov jump processes of particles, beside the master equation; keys, order, what is dropped and refused. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# volumes N DT A B: N well-stirred volumes at rest, of A and B molecules each.
volumes() { pinit lattice --dim 1 -n "$1" --dt "$2" --no-history | scalc --role state "a = $3" "b = $4" --no-history; }
# moments NAME: mean and variance of a field of the last frame.
moments() { stab --plain | column "$1" | awk '{ s += $1; q += $1 * $1 } END { m = s / NR; printf "%.17g %.17g\n", m, q / NR - m * m }'; }

# master N B T: mean and variance of B at T for A + B -> 2 B at the rate a b/N, from B at 0, by the master equation
# dP_b/dt = r(b - 1) P_(b-1) - r(b) P_b in steps of Runge-Kutta of order 4 that are 1/20 of the fastest rate; and what the rate equation gives.
master() {
	awk -v n="$1" -v b0="$2" -v t="$3" '
		function rate(b) { return (n - b) * b / n }
		function slope(p, d,   b) { for (b = b0; b <= n; b++) d[b] = (b > b0 ? rate(b - 1) * p[b - 1] : 0) - rate(b) * p[b] }
		BEGIN { p[b0] = 1; steps = int(20 * n / 4 * t) + 100; h = t / steps
			for (i = 0; i < steps; i++) {
				slope(p, k1); for (b = b0; b <= n; b++) y[b] = p[b] + h / 2 * k1[b]
				slope(y, k2); for (b = b0; b <= n; b++) y[b] = p[b] + h / 2 * k2[b]
				slope(y, k3); for (b = b0; b <= n; b++) y[b] = p[b] + h * k3[b]
				slope(y, k4); for (b = b0; b <= n; b++) p[b] += h / 6 * (k1[b] + 2 * k2[b] + 2 * k3[b] + k4[b])
			}
			for (b = b0; b <= n; b++) { all += p[b]; m += b * p[b]; q += b * b * p[b] }
			if ((all - 1)^2 > 1e-20) exit 1
			print m, q - m * m, n / (1 + (n / b0 - 1) * exp(-t)) }'
}

@test "A + B -> 2 B: mean and variance are those of the master equation, for 5 and 100 molecules; the rate equation fails for 5" {
	for case in "5 1 2" "100 20 1"; do
		read -r n b t <<<"$case"
		read -r mean variance rate <<<"$(master $n $b $t)"
		for dt in 0.1 0.5; do # exact for every step, because the rate depends on nothing that another word changes
			volumes 20000 $dt $((n - b)) $b | cycle -q -t $t "push drift | jump 'a*b/$n: a = a-1; b = b+1'" >end
			read -r got spread <<<"$(moments b <end)"
			echo "$case $dt: $got $spread; master $mean $variance; rate equation $rate"
			# four standard errors: sqrt(variance/N) of the mean, about variance sqrt(2/N) of the variance
			awk -v g="$got" -v s="$spread" -v m="$mean" -v v="$variance" \
				'BEGIN { exit !((g - m)^2 < 16 * v / 20000 && (s / v - 1)^2 < 16 * 2 / 20000) }'
			[ "$(scalc 'sum = a + b' <end | stab --plain | column sum | sort -u)" = "$n" ]
		done
		# how far the rate equation is from the mean, in parts of the mean: 14 % and 0.3 %
		awk -v n=$n -v m="$mean" -v r="$rate" 'BEGIN { off = (r - m) / m; print off
			exit !(n == 5 ? off > 0.13 && off < 0.15 : off > 0.003 && off < 0.004) }'
	done
}

@test "a particle jumps within dt with probability 1 - exp(-rate dt), by a rate of its own" {
	volumes 40000 0.5 0 0 | scalc 'r = mod(id, 2) ? 0.3 : 4' >a
	jump '(1-b)*r: b = 1' <a >b
	for case in '1 0.3' '0 4'; do
		got=$(sel --where "mod(id, 2) == ${case% *}" <b | moments b | cut -d' ' -f1)
		want=$(awk -v r="${case#* }" 'BEGIN { print 1 - exp(-r * 0.5) }')
		within "$got" "$want" 0.0137 # four standard errors of 20000 particles, at 1/2 the largest
	done
	# derived fields are dropped, though the channel has read r
	run -0 bash -c 'sls <b'
	[[ $output != *" r "* && $output == *" b "* ]]
}

@test "channels compete, and the values of an effect are those before the jump" {
	volumes 30000 1 0 0 | scalc --role state --type i64 'kind = 0' | jump '(kind == 0)*2: kind = 1' '(kind == 0)*1: kind = 2' >a
	for k in 1 2; do
		got=$(scalc "is = kind == $k" <a | moments is | cut -d' ' -f1)
		within "$got" "$(awk -v k=$k 'BEGIN { print (3 - k) / 3 * (1 - exp(-3)) }')" 0.0115 # four standard errors
	done
	volumes 500 1 3 7 | jump '1e3*(b > a): a = b; b = a' | stab --plain >a
	[ "$(column a <a | sort -u) $(column b <a | sort -u)" = "7 3" ]
	# a vector, and a ?: in the rate; very different rates and an absorbing state
	pinit uniform --dim 2 -n 1000 --dispersion 1 --dt 1 | jump 'vx > 0 ? 1e6 : 0: v = -vx, vy' | stab --plain | column vx | awk '$1 > 0 { exit 1 }'
}

@test "birth and death: a steady state is Poisson's" {
	# births at 6, each dies at 1: mean and variance 6
	read -r mean spread <<<"$(volumes 20000 1 0 6 | cycle -q -n 3 "push drift | jump '6: b = b + 1' 'b: b = b - 1'" | moments b)"
	echo "$mean $spread"
	within "$mean" 6 0.07
	within "$spread" 6 0.25
}

@test "a jump belongs to seed, set, channel, id and step: not to order, other particles, threads, or how a run was cut" {
	volumes 5000 0.2 4 1 | smod --seed 3 >a
	s="push drift | jump 'a*b/5: a = a-1; b = b+1'"
	jump 'a*b/5: a = a-1; b = b+1' <a >b
	list() { ssort --by id | stab --plain | column b; }
	same_as <(list <b) <(ssort --by id --reverse <a | jump 'a*b/5: a = a-1; b = b+1' | list)
	same_as <(sel --where 'mod(id, 7) == 3' <b | list) <(sel --where 'mod(id, 7) == 3' <a | jump 'a*b/5: a = a-1; b = b+1' | list)
	for t in 1 2 3; do OMP_NUM_THREADS=$t cycle -q -n 3 "$s" --no-history <a | cksum; done | sort -u >sums
	for r in 1 2 3; do cycle -q -n 3 --ranks $r "$s" --no-history <a | cksum; done | sort -u >>sums
	cycle -q -n 3 --engine pipes "$s" --no-history <a | cksum >>sums
	cycle -q -n 1 "$s" --no-history <a | cycle -q -n 2 "$s" --no-history | cksum >>sums
	cycle -q -n 2 --no-history --checkpoint c "$s" <a >/dev/null
	cycle -q -n 3 --resume c "$s" --no-history </dev/null | cksum >>sums
	[ "$(sort -u sums | wc -l)" -eq 1 ]
	for other in "smod --seed 4 <a | jump 'a*b/5: a = a-1; b = b+1'" "smod --step 1 <a | jump 'a*b/5: a = a-1; b = b+1'" \
		"jump --seed 9 'a*b/5: a = a-1; b = b+1' <a" "smod --rename matter=other <a | jump 'a*b/5: a = a-1; b = b+1'"; do
		! cmp -s <(list <b) <(bash -o pipefail -c "$other" | list) || { echo "$other"; return 1; }
	done
	same_as <(jump --seed 9 'a*b/5: a = a-1; b = b+1' <a | list) <(smod --seed 9 <a | jump 'a*b/5: a = a-1; b = b+1' | list)
	# two words draw their own numbers: their jumps are uncorrelated, four standard errors of 5000
	scalc 'a = 0' 'b = 0' <a | smod --dt 0.6931471805599453 | jump '1: a = 1' | jump '1: b = 1' | scalc 'ab = (a - 0.5)*(b - 0.5)*4' | moments ab >c
	within "$(cut -d' ' -f1 c)" 0 0.057
}

@test "mixed with deterministic steps: the rate is that of the state behind the step, and in its middle where it is written so" {
	# x = t, rate x: exp(-1/2) are left at 1; with steps of 1/2 exp(-(0.5 + 1)/2), and with the middle of the step exact
	pinit uniform --dim 1 -n 40000 --dt 0.5 --faces open --particle-faces open | scalc 'x = 0' 'v = 1' | scalc --role state 'gone = 0' >a
	for case in 'x 0.4723666' 'x-vx*dt/2 0.6065307'; do
		got=$(cycle -q -n 2 "push drift | jump '(1-gone)*(${case% *}): gone = 1'" <a | moments gone | cut -d' ' -f1)
		within "$got" "$(awk -v s="${case#* }" 'BEGIN { print 1 - s }')" 0.01 # four standard errors
	done
	# inside a step (rk4 has four passes) the frame is passed on, and jumps are not repeated when cycle primes; four standard errors of sqrt(0.2/4000)
	volumes 4000 0.1 0 0 | smod --law free >a
	for s in "push kick/2 drift | field 'acc = 0' | push kick/2" "field 'acc = -x' | push rk4"; do
		cycle -q -n 2 "$s | jump '1: b = b+1'" <a | moments b | cut -d' ' -f1 >c
		within "$(cat c)" 0.2 0.03
	done
}

@test "molecules as particles: a rate by the number of a kind in the volume, from scalc --total --per" {
	# 4000 volumes of 5 molecules; the number is that of the beginning of the step, an error of first order in dt: 0.5 % of the mean here
	pinit lattice --dim 1 -n 20000 --dt 0.02 | scalc --role state 'cell = floor(id/5)' 'b = mod(id, 5) == 0' >m
	read -r mean variance rate <<<"$(master 5 1 2)"
	cycle -q -t 2 "push drift | scalc --total --per cell 'nb = b' | jump '(1-b)*nb/5: b = 1'" <m >end
	read -r got spread <<<"$(scalc --total --per cell 'nb = b' <end | moments nb)"
	echo "$got $spread; master $mean $variance; rate equation $rate"
	within "$got" "$mean" 0.1 # four standard errors of 4000 volumes, 0.084, and the error of the step
	within "$spread" "$variance" 0.17
}

@test "a strength that jumps is accounted for; positions that jump stay in a periodic box" {
	pinit uniform -n 100 --dt 1 >a
	run -0 bash -o pipefail -c "cycle -q -n 2 \"push drift | jump '1: mass = 2*mass'\" <a | sls --report"
	[[ $output == *'"given_mass":'* && $output == *'"jumps":'* ]]
	jump '3: x = x + 0.7, y, z' <a | p2m | sls >/dev/null
}

@test "refused: what is no channel, a negative rate, one that runs away, states that are not there, a step of 0" {
	volumes 10 0.1 4 1 >a
	refused() {
		run -"$1" bash -o pipefail -c "$3 | sls"
		[[ $output == *"$2"* ]] || { echo "$output"; return 1; }
	}
	refused 2 "is not RATE: NAME = EXPRESSION" "jump 'a*b' <a"
	refused 2 "is not NAME = EXPRESSION" "jump 'a: b' <a"
	refused 2 "the rate 'a, b' has 2 parts" "jump 'a, b: b = 1' <a"
	refused 3 "the rate of channel 1 is -4 at index 0" "jump -- '-a: b = 1' <a"
	refused 3 "the rate of channel 1 is -1 at index 0" "jump '-1: b = 1' <a" # a number, not an option
	refused 2 "behind -- an argument may begin with -" "jump '-a: b = 1' <a"
	refused 3 "a particle jumps more than 16777216 times in a step (a shorter dt" "timeout 5 jump '1e30: b = 1' <a"
	jump '1e30*b: b = b-1' <a | sls --data | grep -qE ' 0( |$)' # an instant reaction that ends
	refused 3 "the rate of channel 1 is nan at index 0" "jump '0/0: b = 1' <a"
	refused 3 "'b' would jump to inf at index 0" "jump '9e9: b = 1/(a-4)' <a"
	refused 1 "no set has the state 'c' (scalc --role state 'c = 0' makes one)" "jump '1: c = 1' <a"
	refused 1 "no set 'nothing'" "jump --set nothing '1: b = 1' <a"
	refused 1 "which cannot jump" "jump '1: id = 1' <a"
	refused 1 "the time step is 0" "smod --dt 0 <a | jump '1: b = 1'"
	refused 1 "no field or number 'q'" "jump 'q: b = 1' <a"
	volumes 0 0.1 4 1 | jump 'a: b = 1' | sls >/dev/null
}
