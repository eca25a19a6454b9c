# inject: what comes in at faces and in the volume: moments, numbers, resumed runs, electrodes, refusals.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

gap() { pinit plasma --background 0 "$@" | smod --faces wall --particle-faces absorb --dt 1e-3; }

@test "the flux, the mean and the mean square of velocities through a face are those of half a Maxwellian, with and without drift, on either side" {
	# integrals of v f, v^2 f, v^3 f over v > 0 for f normal about d: flux, then over the flux the mean and the mean square
	while read -r d flux mean square; do
		for side in low high; do
			sign=$([ $side = low ] || echo -)
			gap --length 100 | inject e --at x-$side --density 1 -n 40000 --drift="$(calc "${sign}1 * $d")" --velocities 2 --no-history >a
			stab --plain --set e <a >t
			column vx <t >vx
			# standard errors of 40000: below 1/200 of a deviation of v (at most 1) and of v^2 (at most 4)
			within "$(awk -v s=$sign'1' '{ n += s * $1 } END { print n / NR }' vx)" "$mean" 0.02
			within "$(awk '{ n += $1^2 } END { print n / NR }' vx)" "$square" 0.08
			within "$(column vy <t | awk '{ n += $1^2 } END { print n / NR }')" 1 0.03
			within "$(calc "$(column mass <t | head -1) * 40000 / 1e-3")" "$flux" 1e-9
			# each has moved on from the face for a part of the step: x/(v dt) is even in 0..1
			paste <(column x <t) vx | awk -v s=$side '{ u = (s == "low" ? $1 : 100 - $1) / 1e-3 / ($2 < 0 ? -$2 : $2)
				n += u; q += u^2; bad += u < 0 || u > 1.0000001 }
				END { exit !(!bad && (n / NR - 0.5)^2 < 0.006^2 && (q / NR - 1/3)^2 < 0.006^2) }'
		done
	done <<-'END'
		0 0.398942280401 1.25331413732 2
		1 1.08331547058 1.77664872520 3.77663872524
		-1 0.0833154705877 0.904271233330 1.09572876667
	END
}

@test "the number in k steps is that of the flux to one particle, whatever the step; a share of it where one is given; each id once" {
	gap --length 8 | species e -n 0 >a
	for n in 1 7 40; do
		# 12.34 a step: density 1 has the flux 1/sqrt(2 pi) for vth 1
		cycle -q -n $n 'push drift | inject e --influx 1234 -w 0.1' <a >b
		within "$(sls b | awk '$2 == "e:" { print $3 }')" "$(calc "int($n * 12.34)")" 1.000001
	done
	stab --plain --set e b | column id | sort -n | uniq -d >twice
	[ ! -s twice ]
	gap --dim 2 | inject e --at y-high --influx 1e6 -w 1 --share 'x < 3' | stab --plain --set e >t
	within "$(column x <t | awk '$1 > 3.05' | wc -l)" 0 0 # vth dt = 1e-3 a step, along the face none
	within "$(column x <t | wc -l)" 3000 220 # 1e6 dt 3; standard error 48
	gap --dim 3 --cells 4 | inject e --at volume --influx 10 -w 1e-3 --vth 0 | stab --plain --set e | column z | awk '{ n += $1 } END { print n / NR }' >z
	within "$(cat z)" 6.2831853 0.1 # 19844 particles: 0.026
}

@test "a run that is interrupted, threads and engines give the same bytes; what faces absorb and emit is on the electrodes, and all charges add up to 0" {
	gap --length 4 | smod --dt 0.1 --constant charge_x_low=0,charge_x_high=0 | species e -n 0 --no-history >a
	s='push kick/2 drift | inject e --density 0.4 -n 40.3 | p2m | poisson-fft --x-high 2 | mgrad | m2p | push kick/2'
	cycle -q --no-history -n 50 "$s" <a >b
	same_as b <(cycle -q --no-history -n 23 "$s" <a | cycle -q --no-history -n 27 "$s")
	same_as b <(cycle -q --no-history -n 50 --threads 1 "$s" <a)
	same_as b <(cycle -q --no-history -n 50 --engine pipes "$s" <a)
	sls b | grep -o 'charge_x_[a-z]* [-0-9.e]*' | cut -d' ' -f2 >on
	[ "$(wc -l <on)" = 2 ]
	above "$(sed -n 2p on)" 0.01 # low emits electrons
	below "$(awk -v inside="$(diag b --columns charge --format tsv | tail -1)" '{ s += $1 } END { print s + inside }' on)" 1e-9 # sls prints 10 digits
	[ "$(sed -n 1p on | cut -c1)" = - ]
	cycle -q -n 50 "${s/e --density/e --seed 7 --density}" --no-history <a | cmp -s - b && return 1
	# on the sides of a square: each counts its own
	pinit plasma --dim 2 --background 0 | smod --faces wall --particle-faces absorb --constant charge_y_high=0,charge_x_low=0 --dt 1 |
		inject e --at volume --influx 1 -n 1000 --vth 0 --drift 0,20 | push drift | sls >c
	charge=$(calc 'int(1000)') && grep -q "charge_x_low 0," c && grep -q 'charge_y_high -157.9136704' c # 4 pi squared
	[ -n "$charge" ]
}

@test "what cannot come in is refused by name" {
	refused() {
		run --separate-stderr bash -o pipefail -c "$2 | sls"
		[[ $status = "$3" && $stderr == *"$1"* ]] || { echo "$2: $status $stderr"; return 1; }
	}
	refused 'the low face along x is periodic: nothing is beyond it' 'pinit plasma | inject e --influx 1 -n 1' 1
	refused "shows for how many of these real ones it stands (-w, or -n particles a step)" \
		'pinit plasma | smod --faces wall --particle-faces absorb | inject e --influx 1' 1
	refused "new particles have no 'k', which 'e' has (sel --drop k)" "pinit plasma | species e -n 9 | scalc --set e --role state 'k = x' |
		inject e --at volume --influx 1" 1
	refused 'is not between 0 and 1 everywhere' "pinit plasma | inject e --at volume --influx 1 -n 5 --share '2*x'" 1
	refused "a charge that appears in the volume breaks Gauss's law" 'pinit em-wave | inject e --at volume --influx 1 -n 1' 1
	refused 'crosses the whole box within a step' 'pinit plasma | smod --faces wall --particle-faces absorb | inject e --influx 1 -n 9 --drift 1e6' 1
	refused '--density of the plasma beyond the face, or --influx' 'pinit plasma | inject e' 2
	# those that are there say for how many they stand
	pinit plasma | species e -n 100 | inject e --at volume --influx 10 >a
	sls a | grep -q 'set e: 199 particles' # 0.1 of 12.566 comes as 10 x 12.566 x 0.1 / 0.12566 = 100 less the rounding down
}

@test "under the law electromagnetic charges come in with their current: Gauss's law holds to round-off; its place, light and the volume are kept" {
	light() {
		pinit plasma --dim "$1" --cells 16 --length 8 --background 0 | smod --law electromagnetic --constant c=1 --faces wall |
			smod --particle-faces absorb --dt 0.2 | species electrons -n 0 --velocities 3 | p2m | maxwell --gauss
	}
	come='inject electrons --density 0.1 --vth 0.1 --drift 0.3 -n 100.3'
	for dim in 1 2 3; do
		light $dim >start
		for kernel in cic tsc; do # some have crossed the box and left it; largest rho about 0.05
			step="push boris/2 | $come | p2m --current --kernel $kernel | maxwell | push drift | m2p | push boris/2"
			cycle -q -n 150 "$step" <start >end
			p2m --kernel $kernel <end | diag --columns particles,gauss_residual >told
			read -r n rest < <(tail -1 told)
			above "$n" 2000
			below "$n" 15000
			below "$rest" 1e-12 # measured 2e-15 after 40 steps
		done
	done
	same_as <(cycle -q --no-history -n 20 "$step" <start) <(cycle -q --no-history -n 9 "$step" <start | cycle -q --no-history -n 11 "$step")
	same_as <(cycle -q --no-history -n 9 "$step" <start) <(cycle -q --no-history --engine pipes --threads 1 -n 9 "$step" <start)
	same_as <(cycle -q --no-history -n 9 "$step" <start) <(cycle -q --no-history --ranks 2 -n 9 "$step" <start)
	run -1 --separate-stderr cycle -q -n 2 "push boris/2 | p2m --current | maxwell | push drift | $come | m2p | push boris/2" <start
	[[ $stderr == *"inject stands in front of the current (push boris/2 | inject | p2m --current"* ]]
	run -1 --separate-stderr cycle -q -n 2 "${step/--drift 0.3/--drift 0.99}" <start
	[[ $stderr == *"a particle comes in faster than light, c = 1"* ]]
}
