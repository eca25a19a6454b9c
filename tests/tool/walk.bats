# walk: diffusion by random steps; keys, faces, moments, its place in a step.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# points N DIM [stab options]: N particles at the origin.
points() {
	local n=$1 dim=$2
	shift 2
	awk -v n="$n" -v dim="$dim" 'BEGIN { print substr("x y z", 1, 2 * dim - 1); for (i = 0; i < n; i++) print substr("0 0 0", 1, 2 * dim - 1) }' |
		stab - --dt 0.01 --box -1,1 "$@"
}

@test "the steps are normal: mean 0, variance 2 nu dt, fourth moment 3 of it, components independent, in 1, 2 and 3 dimensions" {
	for dim in 1 2 3; do
		points 40000 $dim --number | walk --nu 0.8 | stab --plain >a
		for c in $(echo x y z | cut -d' ' -f1-$dim); do column $c <a >$c; done
		# standard errors of 40000 numbers: 0.005 of the mean, 0.007 of the variance, 0.024 of 3; four of them
		paste $(echo x y z | cut -d' ' -f1-$dim) | awk '{ for (c = 1; c <= NF; c++) { z = $c / sqrt(0.016); m[c] += z; v[c] += z^2; q[c] += z^4;
			p[c] += z * $(c % NF + 1) / sqrt(0.016) } k = NF }
			END { for (c = 1; c <= k; c++) { print m[c] / NR, v[c] / NR, q[c] / NR, p[c] / NR
				if ((m[c] / NR)^2 > 0.02^2 || (v[c] / NR - 1)^2 > 0.028^2 || (q[c] / NR - 3)^2 > 0.1^2 || (k > 1 &&
					(p[c] / NR)^2 > 0.02^2)) exit 1 } }'
	done
	run -0 bash -o pipefail -c 'pinit uniform -n 10 --dt 0.01 | walk --nu 0.8 | sls --report'
	[[ $output == *'"deviation":0.12649110640673'* ]]
}

@test "a step belongs to seed, set, id and step: not to the order, the other particles or the threads" {
	points 5000 2 --number --no-history >a
	walk --nu 1 <a >b
	step() { stab --plain | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { print $at["id"], $at["x"], $at["y"] }' | sort; }
	same_as <(step <b) <(ssort --by id --reverse <a | walk --nu 1 | step)
	same_as <(step <b | awk '$1 % 7 == 3') <(sel --where 'mod(id, 7) == 3' <a | walk --nu 1 | step)
	for t in 1 2 3; do OMP_NUM_THREADS=$t walk --nu 1 --no-history <a | cksum; done | sort -u >sums
	[ "$(wc -l <sums)" -eq 1 ]
	for other in "smod --seed 2 <a | walk --nu 1" "walk --nu 1 --seed 2 <a" "smod --step 1 <a | walk --nu 1" \
		"smod --rename matter=others <a | walk --nu 1"; do
		bash -o pipefail -c "$other" | step >c
		[ "$(paste <(step <b) c | awk '$2 == $5 || $3 == $6' | wc -l)" = 0 ]
	done
	same_as <(smod --seed 2 <a | walk --nu 1 | step) <(walk --nu 1 --seed 2 <a | step)
	# without id the index stands for it
	same_as <(sel --drop id <a | walk --nu 1 | stab --plain | column x) <(stab --plain <b | column x)
}

@test "walk acts once per step, after the last pass of a scheme, and not when cycle primes" {
	pinit lamb-oseen --cells 24 --dt 0.1 >a
	s='p2m | poisson-fft | mgrad | m2p | push'
	cycle -n 1 "$s rk4 | walk" <a | stab --plain | column x >b
	cycle -n 1 "$s rk4" <a | walk | stab --plain | column x >c
	same_as b c
	cycle -n 1 "$s rk4" <a | stab --plain | column x | cmp -s - b && return 1
	# leapfrog primes at every step, because the walk takes acc away; the walk is not repeated
	points 2000 1 --number | scalc --role state 'v = 0' >a
	cycle -n 50 "push kick/2 drift | field 'acc = 0' | push kick/2 | walk --nu 1" <a | stab --plain | column x | awk '{ v += $1 * $1 } END { print v / NR;
		exit !(v / NR > 0.87 && v / NR < 1.13) }' # 2 nu t = 1, 4 standard errors
}

@test "moving drops fields derived from the positions, and only those" {
	pinit uniform -n 50 --dt 0.1 | p2m -n 8 | poisson-fft | mgrad | m2p >a
	run -0 bash -o pipefail -c 'walk --nu 0.1 <a | sls'
	[[ $output != *acc* && $output != *rho* && $output != *phi* && $output == *mass* && $output == *" v "* ]]
	run -0 bash -o pipefail -c 'walk --nu 0 <a | sls'
	[[ $output == *acc* && $output == *rho* ]]
}

@test "if nu is 0 the frame is passed on unchanged, which --verbose reports once; a negative nu, a frame without a time step and a missing set are errors" {
	points 10 2 --no-history >a
	walk --no-history <a | cmp a -
	run -0 bash -o pipefail -c 'walk --verbose <a 2>&1 >/dev/null'
	[[ $output == *"the viscosity nu is 0"* ]]
	refused() {
		run -1 bash -o pipefail -c "$2 | sls"
		[[ $output == *"$1"* ]] || { echo "$output"; return 1; }
	}
	refused 'negative diffusion has no solution' 'smod --constant nu=-1 <a | walk'
	refused 'the time step is 0' 'smod --dt 0 <a | walk --nu 1'
	refused 'no set that moves is called nothing' 'walk --nu 1 --set nothing <a'
	refused 'no set that moves' 'smod --fixed matter <a | walk --nu 1'
	refused "'id' on 'matter' is not i64" "scalc --role state 'id = 1.5' <a | walk --nu 1"
}

@test "faces: folded, mirrored, absorbed and counted" {
	points 4000 2 --number --faces periodic,open --particle-faces periodic,reflect >a
	walk --nu 400 <a | stab --plain >b # deviation 2.83, the box is 2 long
	for c in x y; do column $c <b | awk 'NR > 4000 || $1 < -1 || $1 > 1 { exit 1 } { v += $1 * $1 } END { print v / NR; exit !(v / NR > 0.3 &&
		v / NR < 0.37) }'; done # uniform: 1/3
	points 4000 1 --number --particle-faces absorb,reflect >a
	walk --nu 50 <a >b # deviation 1: beyond -1 is 0.1587 of a normal; the other half comes back, as far as -1: 0.1587 + 0.0013
	run -0 bash -o pipefail -c 'sls --report <b'
	gone=$(grep -o '"absorbed":[0-9]*' <<<"$output" | cut -d: -f2)
	within "$gone" 640 95 # 0.1587 + P(3 < z) of 4000 and four standard errors
	[ "$(stab --plain <b | column x | wc -l)" = $((4000 - gone)) ]
	stab --plain <b | column x | awk '$1 < -1 || $1 > 1 { exit 1 }'
	# a mirror does not reverse the velocity: the step is not due to the particle's velocity
	points 100 1 --particle-faces reflect | scalc --role state 'v = 1' | walk --nu 400 | stab --plain | column vx | awk '$1 != 1 { exit 1 }'
}

@test "a set of no particles, and of one" {
	for n in 0 1; do
		points $n 3 >a
		sh_ok 'walk --nu 1 <a | stab --plain'
	done
	stab --plain <a >b
	! cmp -s b <(walk --nu 1 <a | stab --plain)
}

@test "the step of a particle is uncorrelated with its next one, its neighbour's, and those of another seed or set" {
	points 20000 2 --number --no-history >a
	# the steps 0 and 1, seeds 1 and 2, two sets; seven series of which every pair must be uncorrelated, and neighbours too
	walk --nu 0.5 <a | stab --plain >s0
	smod --step 1 <a | walk --nu 0.5 | stab --plain >s1
	walk --nu 0.5 --seed 2 <a | stab --plain >s2
	smod --rename matter=other <a | walk --nu 0.5 | stab --plain >s3
	for f in s0 s1 s2 s3; do paste <(column x <$f) <(column y <$f) >$f.xy; done
	paste s?.xy | awk '{ for (i = 1; i <= 8; i++) { z = $i / 0.1; v[i] += z*z; l[i] += z * old[i]; q[i] += z^4; if (z > 3 || z < -3) far++;
		for (k = 1; k < i; k++) c[i, k] += z * $k / 0.1; now[i] = z } for (i = 1; i <= 8; i++) old[i] = now[i] }
		END { w = 4 / sqrt(NR); for (i = 1; i <= 8; i++) { print v[i] / NR, q[i] / NR, l[i] / NR; if (l[i] / NR > w || l[i] / NR < -w ||
			q[i] / NR > 3 + w * sqrt(96) || q[i] / NR < 3 - w * sqrt(96)) bad++
			for (k = 1; k < i; k++) if (c[i, k] / NR > w || c[i, k] / NR < -w) { print i, k, c[i, k] / NR; bad++ } }
			print far / NR / 8; exit bad || far / NR / 8 > 0.0027 * 1.2 ||
				far / NR / 8 < 0.0027 / 1.2 }' # of a normal distribution 0.0027 lie beyond three deviations
}
