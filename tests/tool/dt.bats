# dt: the rules, the limits, substep 0 only. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

step_of() { stab | grep -o '"dt":[-+.e0-9]*' | cut -d: -f2; }

@test "the acceleration rule gives sqrt(eta softening/|a|) of the fastest change" {
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

@test "the strain rule gives C/|grad u| of the flow on the mesh, and counts the steps in which particles may cross" {
	awk 'BEGIN { OFMT = "%.17g"; print "x y circulation"; for (j = 0; j < 16; j++) for (i = 0; i < 24; i++) print i / 24, j / 16, cos(2 * atan2(0,
		-1) * i / 24) / 384 }' > t
	# omega = cos(2 pi x): v = sin(2 pi x)/(2 pi), by differences of order 2 dv/dx = cos(2 pi x) sin(a)/a, a = 2 pi/24
	stab t --law vortex --box 0,1 -n 24x16 --faces periodic --particle-faces periodic --dt 1 | p2m | poisson-fft | mgrad --order spectral > a
	want=$(awk 'BEGIN { a = 2 * atan2(0, -1) / 24; printf "%.17g", sin(a) / a }')
	within "$(dt --lcfl 0.3 < a | step_of)" "$(awk -v w="$want" 'BEGIN { printf "%.17g", 0.3 / w }')" 1e-13
	for c in 0.5:0 0.999:0 1:0 1.01:1 2:1; do
		dt --lcfl ${c%:*} < a > b
		sls --format json --report < b | grep -q "\"crossing\":${c#*:}[,}]"
	done
	# a step held by --min is counted too, and --verbose prints the step that would suffice
	run -0 bash -o pipefail -c 'dt --lcfl 0.5 --min 3 --max 3 --verbose < a 2>&1 >b'
	[[ $output == *"above 1: particles may cross (--lcfl 1, or --max 1.0"* ]]
	sls --format json --report < b | grep -q '"crossing":1'
	run -1 bash -o pipefail -c 'stab t --law vortex --box 0,1 -n 24x16 | dt --lcfl 1 | sls'
	[[ $output == *"no field 'u' on a mesh (put dt after p2m | poisson-fft | mgrad)"* ]]
	run -1 bash -o pipefail -c 'pinit two-body | dt --lcfl 1 | sls'
	[[ $output == *"needs a flow, but the law 'gravity' has none"* ]]
}

@test "the plasma frequency rule gives C/omega_p: several species, weights, eps0" {
	within "$(pinit two-stream -n 1000 | dt --plasma 0.2 | step_of)" 0.2 1e-12
	# sum q^2/m = 2 * 9/0.5 + 1/4 = 36.25 in a box of 6, eps0 = 2
	printf 'x charge mass\n1 3 0.5\n2 -3 0.5\n4 1 4\n' > t
	within "$(stab t --law electrostatic --constant eps0=2 --box 0,6 --dt 1 | dt --plasma 0.5 --set matter | step_of)" "$(awk 'BEGIN { printf "%.17g",
		0.5 / sqrt(36.25 / 12) }')" 1e-15
	run -1 bash -o pipefail -c 'pinit plummer -n 10 | dt --plasma 0.2 | sls'
	[[ $output == *"no set with charge and mass under the law 'gravity'"* ]]
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

@test "in the middle of a step the frame is passed on unchanged" {
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
	[[ $output == *"no rule (--courant C, --acceleration ETA, --lcfl C, --plasma C, --oscillation C, or --until T alone)"* ]]
	run -2 bash -o pipefail -c 'pinit two-body | dt --courant 1 --min 2 --max 1 > /dev/null'
	[[ $output == *"--min 2 is above --max 1"* ]]
}

@test "inside cycle dt primes, and the steps add up to the time" {
	pinit two-body --eccentricity 0.5 | cycle -n 20 --every 1 'dt --acceleration 0.01 --softening 0.1 | push kick/2 drift | pp | push kick/2' > a
	[ "$(stab < a | grep -o '"dt":[-+.e0-9]*' | sort -u | wc -l)" -gt 10 ]
	# time of the last frame = sum of the steps recorded in those after the first
	sls --format json < a | jq -r '"\(.dt) \(.time)"' | awk '{ if (n++) s += $1; t = $2 } END { exit !(s > 0 && s - t < 1e-13 && t - s < 1e-13) }'
}

@test "the oscillation rule gives C/omega of the orbit of the largest acceleration, so that an ellipse has short steps at its pericentre alone" {
	printf 'x y z vx vy vz mass\n0 0 0 0 0 0 2\n2 0 0 0 0 0 3\n' > t
	# a = 3/4, G M = 5: omega = a^(3/4) (G M)^(-1/4)
	within "$(stab t --law gravity --constant G=1 --dt 1 | pp --softening 0 | dt --oscillation 0.3 | step_of)" \
		"$(awk 'BEGIN { printf "%.17g", 0.3 / (0.75 ^ 0.75 * 5 ^ -0.25) }')" 1e-15
	run -1 bash -o pipefail -c 'pinit two-body | dt --oscillation 0.1 > /dev/null'
	[[ $output == *"no field 'acc' on 'matter' (compute it first"* ]]
	# e = 0.999, one turn in 123 steps; those of the pericentre alone would be 2e6
	pinit kepler --eccentricity 0.999 > start
	cycle -t 6.283185307179586 'pp | dt --oscillation 0.1 --until 6.283185307179586 | push blanes-moan6' < start > end
	below "$(scmp --set matter --field x end start | column relative_l2)" 1e-6 "place after a turn" # 4.2e-7
	[ "$(sls < end | sed -n 's/^frame 1: .* step \([0-9]*\) .*/\1/p')" -lt 200 ]
}

@test "--until: the last steps are made so long that a run by -t ends at that time, forwards and backwards" {
	words='pp | dt --oscillation 0.1 --until 1.234 | push rk4'
	pinit two-body --eccentricity 0.5 > start
	cycle -t 1.234 "$words" < start | sls | grep -q '^frame 1: time 1.234 '
	pinit two-body --eccentricity 0.5 | cycle -n 1 'pp | push --dt=-0.01 rk4' > start
	cycle -t -1.234 "${words/--until /--until=-}" < start | sls | grep -q '^frame 1: time -1.234 '
	# beyond it the rule alone counts
	cycle -t 1.234 "$words" < <(pinit two-body --eccentricity 0.5) | cycle -n 3 "$words" | sls | grep -qE '^frame 1: time 1.[3-9]'
}

@test "--until alone leaves the steps to the scheme, and ends them at that time" {
	pinit kepler --eccentricity 0.9 >start
	cycle -t 3.3 'pp | push ias15 --tolerance 1e-5 | dt --until 3.3' <start | sls >end
	grep -q '^frame 1: time 3.3 ' end
	steps=$(sed -n 's/^frame 1: .* step \([0-9]*\) .*/\1/p' end)
	[ "$steps" -gt 5 ] && [ "$steps" -lt 100 ] # 45; with the dt of the frame 525
	pinit two-body --dt 0.1 | cycle -t 1.234 'pp | dt --until 1.234 | push rk4' | sls | grep -q '^frame 1: time 1.234 step 13 '
}
