# dt: the rules, the limits, substep 0 only. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

step_of() { stab | grep -o '"dt":[-+.e0-9]*' | cut -d: -f2; }

@test "the rule of acceleration gives sqrt(eta softening/|a|) of the fastest change" {
	printf 'x y z vx vy vz mass\n0 0 0 0 0 0 2\n2 0 0 0 0 0 3\n' > t
	# a = 3/4 on the first, 1/2 on the second
	within "$(stab t --law gravity --constant G=1 --dt 1 | pp --softening 0 | dt --acceleration 0.02 --softening 0.5 | step_of)" \
		"$(awk 'BEGIN { printf "%.17g", sqrt(0.02 * 0.5 / 0.75) }')" 1e-16
}

@test "the rule of Courant counts cells of the mesh along each axis" {
	printf 'x y z vx vy vz\n1 1 1 2 -0.5 0\n1 1 1 0 1 -3\n' > t
	# h = 2/4, 2/8, 2/2: |v|/h is at most 4 along x, 4 along y, 3 along z
	within "$(stab t --box 0,2 --cells 4x8x2 --dt 1 | dt --courant 0.3 | step_of)" 0.075 1e-16
}

@test "--max and --min hold, and what --min overrules is counted; nothing to limit leaves dt alone" {
	printf 'x y z vx vy vz\n1 1 1 2 -0.5 0\n1 1 1 0 1 -3\n' > t
	stab t --box 0,2 --cells 4 --dt 1 > a
	[ "$(dt --courant 1 --max 0.125 < a | step_of)" = 0.125 ]
	dt --courant 1e-3 --min 0.125 < a > b
	[ "$(step_of < b)" = 0.125 ]
	grep -aq '"below_min":1' b
	printf 'x y z vx vy vz\n1 1 1 0 0 0\n' > t
	[ "$(stab t --box 0,2 --cells 4 --dt 0.75 | dt --courant 1 | step_of)" = 0.75 ]
	[ "$(stab t --box 0,2 --cells 4 --dt 0.75 | dt --courant 1 --max 0.5 | step_of)" = 0.5 ]
}

@test "in the middle of a step the frame passes" {
	pinit two-body | pp | push kick/2 --no-history > a
	dt --acceleration 1e-6 --softening 1 --no-history < a > b
	same_as a b
}

@test "a missing rate and a missing softening are errors, no rule is a usage error" {
	run -1 bash -o pipefail -c 'pinit two-body | dt --acceleration 0.1 --softening 1 > /dev/null'
	[[ $output == *"no field 'acc' on 'matter' (compute it first"* ]]
	run -1 bash -o pipefail -c 'pinit two-body | pp | dt --acceleration 0.1 > /dev/null'
	[[ $output == *"needs a softening length (--softening LENGTH)"* ]]
	run -2 bash -o pipefail -c 'pinit two-body | dt > /dev/null'
	[[ $output == *"no rule (--courant C, --acceleration ETA)"* ]]
	run -2 bash -o pipefail -c 'pinit two-body | dt --courant 1 --min 2 --max 1 > /dev/null'
	[[ $output == *"--min 2 is above --max 1"* ]]
}

@test "inside cycle dt primes, and the steps add up to the time" {
	pinit two-body --eccentricity 0.5 | cycle -n 20 --every 1 'dt --acceleration 0.01 --softening 0.1 | push kick/2 drift | pp | push kick/2' > a
	[ "$(stab < a | grep -o '"dt":[-+.e0-9]*' | sort -u | wc -l)" -gt 10 ]
	# time of the last frame = sum of the steps recorded in those after the first
	stab < a | grep -o '"dt":[-+.e0-9]*\|"time":[-+.e0-9]*' | awk -F: '/dt/ { d = $2 } /time/ { if (n++) s += d; t = $2 } END { exit !(s > 0 && s - t < 1e-13 && t - s < 1e-13) }'
}
