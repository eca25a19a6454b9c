# diag --average: mean, error and autocorrelation time of the columns. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# wander N DT SEED: a bead of x' = -x with noise, whose every value is 1 - dt of the one before and a normal number more
wander() { printf 'x mass\n0 1\n' | stab - --law free --dt "$2" | smod --seed "$3" | cycle -q -n "$1" --every 1 'field vel=-x | push euler | walk --nu 1'; }

@test "002:MD3, 002:MC2: the mean of a correlated series within its error, the error and the correlation time as known" {
	# variance 2 dt/(1 - r^2), r = 0.9; correlation time dt (1/2 + r/(1 - r)) = 0.95; error sqrt(2 9.5 variance/8001) = 0.05
	wander 8000 0.1 1 | diag -q --columns centre_x --average | tail -1 >line
	read -r _ _ _ mean _ error _ _ time _ <line
	within "$mean" 0 0.15 # three errors
	within "${error%,}" 0.05 0.015 # blocks of 128: 62, known to 1/sqrt(2 62) = 9 % each, the largest of eight lengths
	within "${time%,}" 0.95 0.25 # sqrt(2 (2 6 + 1) 9.5/8001) = 18 % (Sokal 1997)
}

@test "values without correlation have the error sigma/sqrt(n) and half a step of correlation; --window chooses frames; a short series says so" {
	wander 4000 1 2 >a # dt = 1: every value is new, of variance 2
	diag -q --columns centre_x --average a | tail -1 >line
	read -r _ _ _ _ _ error _ _ time _ <line
	within "${error%,}" "$(awk 'BEGIN { print sqrt(2 / 4001) }')" 0.005
	within "${time%,}" 0.5 0.1
	diag -q --columns centre_x --average --window 100:199 a | tail -1 | grep -q 'from t = 100 to 199, 100 frames'
	wander 100 0.1 3 | diag -q --columns centre_x --average | tail -1 | grep -q 'fewer than 50 correlation times: the error is too small'
	diag -q --columns centre_x --average --format json a | tail -1 | grep -q '^{"average":"centre_x","mean":.*,"frames":4001,"brief":false}$'
	wander 10 0.1 3 | diag -q --columns mass,particles --average | tail -1 >line # a constant has an exact mean
	grep -q '^# average particles 1 +- 0, correlation time nan, from t = 0 to 1, 11 frames$' line
	run -2 diag -q --window 1:2 a
	[[ $output == *'belongs to --growth and --average'* ]]
}
