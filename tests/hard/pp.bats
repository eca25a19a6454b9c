# HC-19: close and coincident pairs under pp. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

pair() { # pair R SOFTENING [options]: acc_x of the second of two unit masses at distance R
	local r=$1 eps=$2
	shift 2
	printf 'x y z mass\n0 0 0 1\n%s 0 0 1\n' "$r" > t
	stab t --law gravity --constant G=1 | pp --softening "$eps" --potential "$@" > a && stab --plain < a |
		awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { a = $c["acc_0"] } END { printf "%.17g\n", a }'
}

@test "HC-19: r = 1e-12, 1e-200 and 0 with softening 0: finite, the force of Newton or none, and the coincident pair is counted and reported" {
	for loop in half full; do
		within "$(pair 1e-12 0 --loop $loop)" -1e24 1e10
		run ! grep -aq coincident a
		for r in 1e-200 0; do
			within "$(pair $r 0 --loop $loop)" 0 0
			grep -aq '"coincident":1' a
			run -0 bash -c "stab t --law gravity | pp --softening 0 --loop $loop --verbose 2>&1 > /dev/null"
			[[ $output == *"1 pairs coincide"* ]]
		done
	done
}

@test "HC-19: the same with softening 0.01: a force that vanishes with r, nothing to report" {
	for loop in half full; do
		within "$(pair 1e-12 0.01 --loop $loop)" -1e-6 1e-20
		within "$(pair 1e-200 0.01 --loop $loop)" 0 1e-190
		within "$(pair 0 0.01 --loop $loop)" 0 0
		run ! grep -aq coincident a
	done
}

@test "a hundred coincident particles exert no force on each other and their sum on a far one" {
	{ echo 'x y z mass'; for i in $(seq 100); do echo '1 1 1 0.01'; done; echo '3 1 1 1'; } > t
	stab t --law gravity --constant G=1 | pp --softening 0 > a
	grep -aq '"coincident":4950' a
	stab --plain < a | awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { last = $c["acc_0"]; print last }' > out
	within "$(tail -n 1 out)" -0.25 1e-15
	within "$(head -n 1 out)" 0.25 1e-15
}

@test "a cluster a million lengths from the origin has the same forces as at the origin, to the last bit for its rounded positions" {
	pinit plummer -n 500 | smove --shift 1048576,-2097152,524288 > far
	smove --shift -1048576,2097152,-524288 < far > near # exact: the positions are already rounded
	for loop in half full; do
		pp --loop $loop < far | stab --plain | awk '{ print $NF, $(NF-1), $(NF-2) }' > a
		pp --loop $loop < near | stab --plain | awk '{ print $NF, $(NF-1), $(NF-2) }' > b
		same_as a b
	done
	# it is the force at the original positions, which were rounded by 2^-32: 1e-10 over a softening of 0.02
	pinit plummer -n 500 | pp > c
	pp < near > d
	below "$(scmp --norm relative_l2 --field acc c d | tail -n 1 | cut -f8)" 1e-7
}

@test "the order of the particles in the stream changes forces by round-off only, on the mesh and directly" {
	pinit uniform -n 3000 --mass-spread 4 --softening 0.01 > a
	ssort --by 'sin(1000*x)+y' < a > b
	run ! cmp a b
	for words in 'p2m | poisson-fft | mgrad | m2p' 'smod --faces open --particle-faces open | pp'; do
		bash -o pipefail -c "$words" < a > c
		bash -o pipefail -c "$words" < b > d # scmp matches particles by id
		below "$(scmp --norm relative_l2 --set matter --field acc c d | tail -n 1 | cut -f8)" 1e-13 "$words" # of 3000 summands
	done
}

# wander N SEEDS: mean of (dE/E)^2 of single stars within a time of 1, in units of ln N/N.
wander() {
	local n=$1 seeds=$2 seed
	for seed in $(seq "$seeds"); do
		pinit plummer -n "$n" --seed "$seed" --softening 0.01 --dt 0.01 | pp --potential >a
		push clear <a | cycle -n 100 'push kick/2 drift | pp | push kick/2' | pp --replace --potential >b
		for frame in a b; do
			scalc 'e = (vx^2 + vy^2 + vz^2)/2 + phi' <$frame >e$frame
		done
		scmp --field e eb ea | cut -f 8 | tail -n 1
	done | awk -v n="$n" '{ sum += $1 ^ 2 } END { printf "%.6g", sum / NR * n / log(n) }'
}

@test "two-body relaxation: energies of stars wander by (dE/E)^2 = 0.25 t ln N/N of 100 and of 1600" {
	# 0.279, 0.264, 0.241, 0.252, 0.232 for 100, 200, 400, 800, 1600 at half the step. Single seeds of 100 scatter by a third (eight of them), the mean
	# of four so by 0.05; those of 1600 by an eighth, two by 0.02
	within "$(wander 100 4)" 0.27 0.06 "100"
	within "$(wander 1600 2)" 0.24 0.05 "1600"
}
