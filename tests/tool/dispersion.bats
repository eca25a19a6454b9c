# dispersion: frequencies of waves by wave number beside theory; the map; refusals. The dispersion relation itself is tested in tests/unit/dispersion.c.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

step='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'
row() { awk -F'\t' -v m="$1" -v n="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == n) c = i } $1 == m { print $c }' t; }

@test "dispersion: a cold wave stands at omega_p cos(k h/2), of power A^2, beside the theory of cold electrons" {
	pinit langmuir -n 1024 --mode 2 --amplitude 1e-3 | cycle -q -n 2000 --every 5 "$step" | dispersion -n 3 >t
	within "$(row 2 omega)" "$(calc 'cos(pi / 32) * 1.00041')" 0.0006 # the step adds (0.1)^2/24; a twentieth of the resolution, 0.0314
	within "$(row 2 theory_omega)" 1 1e-9
	within "$(row 2 theory_gamma)" 0 1e-9
	within "$(row 2 k)" 2 1e-12
	# E = A/k cos(k x) cos(omega t), half of it in each direction: 2 (A/(2 k))^2 at the nearest frequency, which is within 30 % of the peak
	between "$(row 2 power)" "$(calc '0.5 * (1e-3 / 2) ^ 2 * 0.6')" "$(calc '0.5 * (1e-3 / 2) ^ 2 * 1.02')"
	below "$(row 1 power)" 1e-14
}

@test "dispersion: warm electrons, and ions whose slow wave --highest finds below theirs, are at the roots for their sets" {
	pinit plasma --length 31.41592653589793 --dt 0.2 --background 0 | species electrons -n 10000 --profile '1 + 0.1*cos(0.2*x)' |
		species ions -n 10000 --charge 1 --mass 25 --vth 0.02 --profile '1 + 0.1*cos(0.2*x)' | cycle -q -n 2500 --every 5 "$step" >run
	dispersion -n 1 run >t
	within "$(row 1 theory_omega)" 1.0801 0.0005 # the root by scipy, within the sampling of the width
	within "$(row 1 omega)" "$(row 1 theory_omega)" 0.0126 # the resolution
	dispersion -n 1 --highest 0.1 run >t
	within "$(row 1 theory_omega)" "$(calc '0.2 * 0.2 / sqrt(1.04)')" 0.0015 # k c_s/sqrt(1 + k^2), a little more by hot ions
	within "$(row 1 omega)" "$(row 1 theory_omega)" 0.004 # a third of the resolution
	within "$(row 1 theory_gamma)" -0.0049 0.001 # sqrt(pi m_e/(8 m_i)) omega = 0.125 omega of Landau damping by electrons
}

@test "dispersion --as-mesh: a frame whose largest power is that of the table, at its wave number and frequency" {
	pinit langmuir -n 1024 --mode 2 --amplitude 1e-3 | cycle -q -n 400 --every 4 "$step" >run
	dispersion -n 3 run >t
	dispersion -n 3 --as-mesh run | stab --plain --mesh waves |
		awk -F'\t' 'NR > 1 && $3 > p { p = $3; k = $1; w = $2; l = $4 } END { print k, w, p, l }' >most
	read -r k w p l <most
	within "$k" 2 1e-12
	within "$w" "$(row 2 omega)" "$(calc "0.51 * $(row 2 resolution)")"
	within "$p" "$(row 2 power)" 1e-18
	within "$l" "$(calc "log($p) / log(10)")" 1e-9
	dispersion -n 3 --as-mesh --highest 2 run | sls | grep -q 'set' && return 1
	[ "$(dispersion -n 3 --as-mesh --highest 2 run | sdraw --field power -o m.png)" = m.png ]
}

@test "dispersion: no theory where a set is no Maxwellian or there is a magnetic field; runs that are too short or not even in time are refused" {
	pinit two-stream -n 1000 --vth 0.3 | cycle -q -n 40 --every 2 "$step" >run
	run -0 --separate-stderr dispersion -n 1 run
	[[ $stderr == *"no theory: the velocities of 'electrons' are not Maxwellian"*"make every beam a set"* && $output == *nan ]]
	pinit langmuir -n 256 --velocities 3 | scalc --mesh mesh --role state 'B = 1, 0, 1' >a
	run -0 --separate-stderr bash -c "cycle -q -n 20 --every 1 '${step//kick/boris}' <a | dispersion -n 1"
	[[ $stderr == *"no theory: the magnetic field is neither along x nor across it"* ]]
	scalc --mesh mesh 'B = 0, 0, cos(x)' <a >b
	run -0 --separate-stderr bash -c "cycle -q -n 20 --every 1 '${step//kick/boris}' <b | dispersion -n 1"
	[[ $stderr == *"no theory: the magnetic field is not uniform"* ]]
	run -2 --separate-stderr bash -c "cycle -q -n 20 --every 1 '${step//kick/boris}' <a | dispersion -n 1 --component y"
	[[ $stderr == *"the field 'E' has 1 component (--component x)"* ]]
	run -1 --separate-stderr bash -c "pinit landau -n 500 | cycle -q -n 5 --every 1 '$step' | dispersion"
	[[ $stderr == *"frames are too few for frequencies"* ]]
	run -1 --separate-stderr bash -c "pinit landau -n 500 | p2m | poisson-fft | mgrad | dispersion"
	[[ $stderr == *"1 frame is too few for frequencies: 16 at least (cycle --every 1"* ]]
	pinit landau -n 500 >a
	run -1 --separate-stderr bash -c "(cycle -q -n 20 --every 1 '$step' <a; cycle -q -n 40 --every 20 '$step' <a) | dispersion -n 1"
	[[ $stderr == *"not equally spaced in time"* ]]
	run -2 --separate-stderr bash -c "pinit landau -n 500 --cells 8 | cycle -q -n 20 --every 1 '$step' | dispersion -n 5"
	[[ $stderr == *"a mesh of 8 points has 4 (dispersion -n 4)"* ]]
}

@test "dispersion: across a magnetic field cold electrons oscillate at the upper hybrid frequency" {
	for wc in 0.5 2; do # a kick, not a displacement: that has a part of frequency 0
		pinit langmuir -n 1024 --velocities 3 --amplitude 0 --dt 0.05 | scalc --set electrons 'v = 1e-3*cos(x), 0, 0' |
			cycle -q -n 2000 --every 4 "push boris/2 drift | p2m | poisson-fft | mgrad | m2p | field 'bfield = 0, 0, $wc' | push boris/2" >run
		dispersion -q -n 1 run >t
		# measured 0.0014 to 0.003 below, a twentieth of the resolution: cic lowers omega_p by 1.2e-3
		within "$(row 1 omega)" "$(calc "sqrt(1 + $wc^2)")" 0.006 "$wc"
	done
}

@test "dispersion: thermal electrons across a magnetic field have the upper hybrid wave and Bernstein's modes" {
	pinit plasma --length 20 --cells 64 --dt 0.1 | species electrons -n 10000 --velocities 3 --loading random |
		scalc --mesh mesh --role state 'B = 0, 0, 1' | cycle -q -n 1500 --every 4 "${step//kick/boris}" >run
	run -0 --separate-stderr dispersion -n 5 --lowest 0.5 run
	[[ $stderr == *"theory: electrostatic waves across the magnetic field (Bernstein)" ]]
	tr ' ' '\t' <<<"$output" >t
	# measured 0.002 to 0.011 below, as cic lowers omega_p by cos(k h/2): a third of the resolution of 0.042
	for m in 1 2 3 4 5; do within "$(row $m omega)" "$(row $m theory_omega)" 0.014 "mode $m"; done
	within "$(row 1 theory_omega)" "$(calc 'sqrt(2)')" 0.06 # the upper hybrid wave: at k = 0.31 lowered by 3 %
	dispersion -q -n 5 --lowest 1.7 --highest 2.3 run >t # between harmonics 2 and 3, where the cold plasma has no wave
	for m in 2 3 4; do within "$(row $m omega)" "$(row $m theory_omega)" 0.014 "mode $m" && within "$(row $m theory_omega)" 2.1 0.02 "mode $m"; done
}

@test "dispersion: light in a thermal plasma along and across a magnetic field: right, left, ordinary, extraordinary, and none" {
	local light='push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2'
	pinit plasma --length 20 --cells 64 | species electrons -n 4096 --velocities 3 --vth 0.05 --loading random |
		smod --law electromagnetic --constant c=1 --dt 0.15 | p2m | maxwell --gauss >a
	# B; component; what is looked at; words of the note. Measured within 0.009, cells of 0.3: a third of the resolution of 0.042 is allowed
	while IFS=';' read -r field component range words; do
		run=run.${field//, /-}
		[ -s "$run" ] || scalc --mesh mesh "B = $field" <a | cycle -q -n 1000 --every 4 "$light" >"$run"
		dispersion -n 2 --component $component $range "$run" >t 2>said
		grep -q "$words" said
		for m in 1 2; do within "$(row $m omega)" "$(row $m theory_omega)" 0.014 "$field $component $range $m"; done
	done <<-END
		0.5, 0, 0;y;--lowest 1.1;right and left waves along the magnetic field
		0, 0.5, 0;y;--lowest 0.3;ordinary waves across
		0, 0.5, 0;z;--lowest 1.1;extraordinary waves across
		0, 0.5, 0;z;--highest 1.1;extraordinary waves across
		0, 0, 0;y;--lowest 0.3;waves of light
	END
}
