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
	counted 2
}

@test "a tolerance below rounding is refused by the pairs, and one above is met" {
	spring() { printf 'x vx\n1 0\n' | stab - --law free --dt 0.1 | cycle -q -n 2 "field acc=-x | push $1" 2>&1 >end; }
	for scheme in rk45 rk23 rk4-double midpoint-double; do
		run -2 spring "$scheme --tolerance 1e-30"
		[[ $output == *"--tolerance 1e-30 of the state is below rounding, 2.2e-16, and no step meets it"* ]]
	done
	run -0 spring "rk45 --tolerance 1e-13"
	counted 4
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
	# the polynomial of order 4 has a local error of dt^5, the cubic one of dt^4, at the end of steps of order 5, 3 and 4
	for scheme in rk45:5 rk23:3 rk4-double:4.2; do
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
	[[ $output == *'--dense belongs to an embedded pair (push rk45, rk23, rk4-double, midpoint-double)'* ]]
}

@test "002:N12, 002:OD8: step doubling: the error that is reported is alpha dt^(p+1) (1 - 2^-p), and the step is that of the two halves" {
	# x' = (p + 1) t^p is a quadrature: Simpson's rule for t^4 has the error dt^5/24, the midpoint rule for t^2 dt^3/4, alpha known
	printf 'x\n1000\n' | stab - --law free >a
	for row in 'rk4-double 5*time^4 4 1/24' 'midpoint-double 3*time^2 2 -1/4'; do
		read -r scheme rate p alpha <<<"$row"
		cycle -n 1 "field 'vel=$rate' | push $scheme --tolerance 0 --dt 0.5" <a >b
		got=$(sls --report b | grep -o '"error":[^,}]*' | cut -d: -f2)
		x=$(stab --plain b | tail -1 | cut -d' ' -f1)
		[[ $alpha != -* ]] || got=-$got
		within "$(calc "$got*$x")" "$(calc "($alpha)*0.5^($p+1)*(1-2^-$p)")" 1e-11 # of x = 1000, which has 1e-13
		within "$(calc "$x-1000-0.5^($p+1)")" "$(calc "($alpha)*0.5^($p+1)/2^$p")" 1e-12
	done
}

@test "002:N13: the error of a step is alpha dt^(p+1), that of a run goes as tolerance^(p/(p+1)): a power of dt is lost" {
	printf 'x vx\n1.1 0.4\n' | stab - --law free --dt 0.01 >a
	cycle -q -t 10 --exact "field acc=-sin(x) | push ias15" <a | stab --plain | awk 'END { printf "%.17g", $1 }' >exact
	for row in rk4-double:0.8:1e-6:1e-7:1e-8:1e-9 midpoint-double:0.6667:1e-4:1e-5:1e-6:1e-7; do
		IFS=: read -r scheme power tolerances <<<"$row"
		for tolerance in ${tolerances//:/ }; do
			cycle -q -t 10 --exact "field acc=-sin(x) | push $scheme --tolerance $tolerance" <a >b
			echo "$tolerance $(stab --plain <b | awk 'END { printf "%.17g", $1 }')"
		done | awk -v exact="$(cat exact)" '{ e = $2 - exact; x = log($1); y = log(e < 0 ? -e : e); n++; a += x; b += y; c += x * x; d += x * y }
			END { print (n * d - a * b) / (n * c - a * a) }' >slope
		within "$(cat slope)" "$power" 0.06 "$scheme"
	done
}

@test "a line at the end says how many steps there were and how many were rejected, the same from every engine, and --quiet leaves it out" {
	printf 'x y z vx vy vz mass\n1 3 0 0 0 0 3\n-2 -1 0 0 0 0 4\n1 -1 0.1 0 0 0 5\n' |
		stab - --law gravity --constant G=1,softening=0.01 --dt 3 --no-history >now
	for scheme in rk45 rk4-double ias15; do
		for engine in fused pipes; do
			run -0 --separate-stderr bash -c "cycle --no-history -n 8 --engine $engine 'pp | push $scheme --tolerance 1e-6' <now >$engine"
			echo "$stderr" >said.$engine
		done
		same_as fused pipes
		diff said.fused said.pipes
		rejected=$(sls --report fused | grep -o '"rejected":[0-9]*' | cut -d: -f2)
		grep -qx "push: $scheme: 8 steps of [0-9.e-]* to [0-9.e-]*, $rejected rejected" said.fused
		[ "$rejected" -gt 0 ]
	done
	run -0 --separate-stderr bash -c "cycle -q -n 8 'pp | push rk45' <now >b"
	[ -z "$stderr" ]
}

@test "a state that decays below 1e-160, whose square is 0, is no error" {
	printf 'x y\n1 0\n' | stab - --law free --dt 1 >a
	for row in 'rk4-double 3.5' 'rk23 1.5' 'rk45 2.5'; do # within the region, where each step takes a part of the amplitude
		cycle -q -n 2000 "field vel=-0.4*x-${row#* }*y,${row#* }*x-0.4*y | push ${row% *} --tolerance 0" <a | stab --plain |
			awk 'NR == 2 { print $1 }' >x
		between "$(cat x)" -1e-160 1e-160
	done
}
