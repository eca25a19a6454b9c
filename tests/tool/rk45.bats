# push rk45 and rk23: the step by its error, every way of running, what they refuse. The tables of coefficients: tests/unit/step.c.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

words='pp | push rk45 --tolerance 1e-6'

@test "equal bytes: rk45 of bodies that meet, fused, as processes, with 1 and 3 threads, resumed, and in a shell loop through a rejected step" {
	printf 'x y z vx vy vz mass\n1 3 0 0 0 0 3\n-2 -1 0 0 0 0 4\n1 -1 0.1 0 0 0 5\n' |
		stab - --law gravity --constant G=1,softening=0.01 --dt 3 --no-history >now
	cycle --no-history -n 8 "$words" <now >want
	sls --report want | grep -q '"rejected":[1-9].*"steps":8'
	for threads in 1 3; do
		for engine in fused pipes; do
			OMP_NUM_THREADS=$threads cycle --no-history -n 8 --engine $engine "$words" <now >got
			same_as want got
			OMP_NUM_THREADS=$threads cycle --no-history -n 3 --checkpoint c --engine $engine "$words" <now >got
			OMP_NUM_THREADS=$threads cycle --no-history -n 8 --resume c --engine $engine "$words" >got
			same_as want got
		done
	done
	cp now here
	for i in $(seq 10); do
		pp --no-history <here | push rk45 --tolerance 1e-6 --no-history >next
		mv next here
	done
	sls --report here | grep -q '"rejected":1'
	cycle --no-history -n 8 "$words" <here >got
	same_as want got
}

@test "002:N13, 002:H14: the error of a run is in proportion to the tolerance of a step, as the member of higher order takes it" {
	# the error of the lower member, of order p, is tolerance: dt goes as tolerance^(1/(p + 1)), and the error of the other at the end as dt^(p + 1)
	printf 'x vx\n1.1 0.4\n' | stab - --law free --dt 0.01 >a
	cycle -q -t 10 --exact "field acc=-sin(x) | push ias15" <a | stab --plain | awk 'END { printf "%.17g", $1 }' >exact
	for scheme in rk45:1 rk23:1; do
		for tolerance in 1e-5 1e-6 1e-7 1e-8; do
			cycle -q -t 10 --exact "field acc=-sin(x) | push ${scheme%:*} --tolerance $tolerance" <a >b
			echo "$tolerance $(stab --plain <b | awk 'END { printf "%.17g", $1 }')"
		done | awk -v exact="$(cat exact)" '{ e = $2 - exact; x = log($1); y = log(e < 0 ? -e : e); n++; a += x; b += y; c += x * x; d += x * y }
			END { print (n * d - a * b) / (n * c - a * a) }' >slope
		within "$(cat slope)" "${scheme#*:}" 0.2 "$scheme" # four tolerances over three powers of ten: steps change by factors, not at will
	done
}

@test "002:H13: rates that no step is short enough for end the run with exit 3, or are passed by --min, whose steps are counted" {
	printf 'x v mass\n-1 0 1\n' | stab - --law free --dt 0.3 >a
	run -3 bash -o pipefail -c "cycle -t 3 \"field 'acc = -1/x^3/abs(x)' | push rk45\" <a | sls"
	[[ $output == *'rk45 would need steps of '*'the rates are not smooth there'* ]]
	cycle -q -t 3 "field 'acc = x > 0 ? -1 : 1' | push rk45 --min 1e-3" <a | sls --report >report
	grep -q '"below_min":[1-9]' report
}

@test "rk45 and the end of a run: --exact ends there; a step is at most --max; with --tolerance 0 all are dt" {
	pinit kepler --dt 50 >a
	cycle -t 2 --exact 'pp | push rk45' <a | sls >text
	grep -q '^frame 1: time 2 ' text
	pinit kepler >a
	cycle -t 2 --exact --every 1 'pp | push rk45 --max 0.02' <a | diag --columns time |
		awk 'NR > 2 { d = $1 - last; if (d > m) m = d } { last = $1 } END { print m, last }' >steps
	below "$(cut -d' ' -f1 steps)" 0.0200000001
	[ "$(cut -d' ' -f2 steps)" = 2 ]
	cycle -n 7 'pp | push rk23 --tolerance 0 --dt 0.125' <a | sls >text
	grep -q '^frame 1: time 0.875 step 7 substep 0 dt 0.125 ' text
}

@test "cycle --every-time writes rk45 --dense and rk23 --dense within steps, with the order of the steps" {
	printf 'x vx\n1 0\n' | stab - --law free >a
	for scheme in rk45:5 rk23:3; do # the polynomial of order 4 has a local error of dt^5, the cubic one of dt^4, at the end of steps of order 5 and 3
		for dt in 0.4 0.2 0.1; do
			cycle -q -t 4 --every-time 0.77 "field acc=-x | push ${scheme%:*} --dense --tolerance 0 --dt $dt" <a >d
			diag --columns time d | sed 1d >b
			stab --plain <d | awk '$1 + 0 == $1' >c
			[ "$(wc -l <c)" = 7 ] # 0, 0.77, ... 3.85, 4
			paste b c | awk -v dt=$dt '{ e = $2 - cos($1); e = e < 0 ? -e : e; if (e > m) m = e } END { printf "%.17g %.17g\n", dt, m }'
		done | awk '{ x = log($1); y = log($2); n++; a += x; b += y; c += x * x; d += x * y } END { print (n * d - a * b) / (n * c - a * a) }' >order
		within "$(cat order)" "${scheme#*:}" 0.25 "$scheme"
	done
}

@test "equal bytes of --every-time: fused, as processes, resumed; frames have no rates of the step, and those at its end are of the run without --dense" {
	pinit plummer -n 20 --softening 0.1 --dt 0.5 --no-history >now
	words='pp | push rk45 --dense --tolerance 1e-4'
	cycle -q --no-history -t 2 --every-time 0.3 "$words" <now >want
	run -1 grep -aq '"name":"q' want
	cycle -q --no-history -t 2 --every-time 0.3 --engine pipes --threads 1 "$words" <now >got
	same_as want got
	cycle -q --no-history -t 1 --checkpoint c "$words" <now >first
	cycle -q --no-history -t 2 --every-time 0.3 --resume c "$words" >rest
	[ "$(sls rest | grep -c '^frame')" -lt "$(sls want | grep -c '^frame')" ]
	sel --last --no-history <want >a
	cycle -q --no-history -t 2 'pp | push rk45 --tolerance 1e-4' <now >b
	run -0 scmp --tolerance 0 a b
	# with other schemes the nearest steps
	pinit two-body --dt 0.07 | cycle -q -t 1 --every-time 0.3 'push kick/2 drift | pp | push kick/2' | diag --columns time | sed 1d | tr '\n' ' ' >times
	[ "$(cat times)" = '0 0.28000000000000003 0.63000000000000012 0.91000000000000014 0.98000000000000009 ' ]
	run -2 cycle -n 1 --every 1 --every-time 1 "$words" -i now -o b
	[[ $output == *'--every counts steps and --every-time counts time'* ]]
	run -2 push rk4 --dense -i now -o b
	[[ $output == *'--dense belongs to an embedded pair (push rk45, rk23)'* ]]
}
