# Plasmas by the words: frequencies of the step, magnetic and electric fields together, neutrality, species, walls of a background.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

step='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'

# The frequency of a cold wave on 16 cells, cos(pi/16).
cells=0.980785280403230

# swing DT [STEPS]: cos(omega dt) from the velocities at whole steps: v(n+1) + v(n-1) = 2 cos(omega dt) v(n), exact for a linear leapfrog.
swing() {
	pinit langmuir -n 256 --cells 16 --amplitude 1e-7 --dt "$1" | cycle -n "${2:-12}" --every 1 "$step" | stab --plain --set electrons |
		awk '/x/ { for (i = 1; i <= NF; i++) if ($i == "v" || $i == "vx") c = i; frame++; next } NF == 0 { next } { p[frame]++;
			if (p[frame] % 256 == 1) v[frame] = $c }
			END { num = den = 0; for (i = 2; i < frame; i++) { num += (v[i-1] + v[i+1]) * v[i]; den += 2 * v[i] * v[i] } printf "%.17g",
				num / den }'
}

@test "PIC-06: a cold wave oscillates at 2 asin(w dt/2)/dt, for w dt = 0.1 to 1.9" {
	for wdt in 0.1 0.2 0.5 1 1.9; do
		# cos(2 asin(a)) = 1 - 2 a^2; amplitude 1e-7 leaves 1e-7 of nonlinearity and 1e-9 of rounding in the velocities
		within "$(swing "$(awk -v a=$wdt -v c=$cells 'BEGIN { printf "%.17g", a / c }')")" "$(awk -v a=$wdt 'BEGIN { printf "%.17g",
			1 - a * a / 2 }')" 1e-6 "w dt = $wdt"
	done
}

@test "PIC-06: beyond w dt = 2 push refuses (exit 3); with --unsafe it grows at 2 acosh(w dt/2) a step" {
	run -3 bash -o pipefail -c "pinit langmuir -n 256 --cells 16 --amplitude 1e-7 --dt 2.05 | cycle -n 1 '$step' | sls"
	[[ $output == *"dt 2.05 is 1.025 times the limit of a kick: 'acc' of 'electrons' (self) oscillates at up to 1 per time"*"(dt up to 2, or --unsafe)"* ]]
	step=${step//push /push --unsafe }
	for case in "2.01 0.199916760277393" "2.1 0.629849513207696" "2.5 1.38629436111989"; do
		read -r wdt growth <<<"$case"
		# v(n+1) + v(n-1) = -2 cosh(g) v(n); 5 steps, so that the wave stays small
		within "$(swing "$(awk -v a="$wdt" -v c=$cells 'BEGIN { printf "%.17g", a / c }')" 5)" "$(awk -v g="$growth" 'BEGIN { printf "%.17g",
			-(exp(g) + exp(-g)) / 2 }')" 1e-3 "w dt = $wdt"
	done
}

@test "PIC-07: with ngp the frequency tends to cos(k dx/2) as the square of the cell: 0.2 % below it on 16 cells" {
	# 262144 electrons, displaced by up to 800 of their spacings. The alias sum assumes displacements that vary within a cell, but ngp moves all
	# electrons of a cell together, so that those crossing a face all come from one side.
	ngp() { # CELLS: relative difference, corrected for the leapfrog: v(n+1) + v(n-1) = 2 cos(omega dt) v(n), sin(omega dt/2) = w dt/2
		pinit langmuir -n 262144 --cells "$1" --amplitude 0.02 --dt 0.05 | cycle -n 24 --every 1 "${step/p2m/p2m --kernel ngp}" |
			diag --columns energy_kinetic |
			sed 1d | awk -v cells="$1" '{ a[NR] = sqrt($1) } END { for (i = 2; i < NR; i++) { num += (a[i-1] + a[i+1]) * a[i]; den += 2 * a[i]^2 }
				printf "%.9g", 1 - 2 / 0.05 * sqrt((1 - num / den) / 2) / cos(3.14159265358979 / cells) }'
	}
	e8=$(ngp 8) e16=$(ngp 16) e32=$(ngp 32)
	within "$e16" 0.0018 0.0006
	order 1.8 8 "$e32" 16 "$e16" 32 "$e8" # the cells in units of the smallest
}

@test "PIC-08: a Maxwellian whose Debye length is a tenth of a cell grows at the rates of the aliases' dispersion relation, within 10 %" {
	# 64 cells of 1, the wave of the largest rate; 0.001 of the density, for ngp 0.02: a wave that moves no particle to another node makes no force
	while read -r kernel vth mode steps amplitude gamma; do
		[ "$kernel$vth" = cic0.1 ] || [ -n "$PM_LONG" ] || continue
		within "$(pinit landau --mode "$mode" --wavenumber 0.09817477042468103 --vth "$vth" --cells 64 -n 40960 --amplitude "$amplitude" |
			cycle -q -n "$steps" --every 4 "${step/p2m/p2m --kernel $kernel}" | diag --columns time --growth mode:"$mode" |
			sed -n 's/^# .* gamma \([^ ]*\) .*/\1/p')" "$gamma" "$(calc "0.1 * $gamma")" "$kernel, $vth" # measured 0.0131, 0.0253, 0.00079, 0.0906
	done <<-END
		cic 0.1 17 800 0.001 0.013720
		cic 0.05 23 800 0.001 0.024077
		tsc 0.1 15 800 0.001 0.000798
		ngp 0.1 17 400 0.02 0.096181
	END
}

@test "PIC-15: waves of a thermal plasma have 1/(1 + (k lambda_D)^2) of the energy of equipartition" {
	# a(t) of mode m: L a^2/4 for sine and cosine together, so W v^2 in equipartition, W = L/n; 64 electrons in a Debye length, from random places: waves of
	# k = 0.2 and 0.3 keep the 1/k^2 that these give them, because Landau's damping takes 1e4 plasma times; 1e4/omega_p of the others
	pinit plasma --length 62.83185307179586 --cells 128 --dt 0.2 | species electrons -n 4000 --loading random |
		cycle -q -n 10000 --every 10 "$step" | diag --columns time --modes 5,8 |
		awk 'NR > 60 { a += $2^2; b += $3^2; n++ } END { print 1000 * a / n, 1000 * b / n }' >t # L/4 over L/n, n = 4000
	read -r five eight <t
	within "$five" "$(calc "cos(pi * 5 / 128)^2 / 1.25")" 0.12 "k = 0.5" # 300 correlation times
	within "$eight" "$(calc "cos(pi * 8 / 128)^2 / 1.64")" 0.09 "k = 0.8"
}

@test "PIC-15: waves of k lambda_D = 0.2, which Landau's damping renews in 1e4 plasma times, have that energy too once they are partly renewed" {
	[ -n "$PM_LONG" ] || skip "long: make check-long"
	# damping of 5.5e-5 forgets energy as exp(-1.1e-4 t): of the start 52 % is left at t = 6000, 27 % at 12000
	# evenly spaced electrons at random velocities, 5 in a Debye length: 0.84 of it until t = 1000; the power of E is k^2 that of phi, in equipartition
	# v^2 L/n
	pinit plasma --length 6283.185307179586 --cells 8192 --dt 0.2 | species electrons -n 32768 --loading random |
		scalc --set electrons 'x = Lx*(id + 0.5)/32768' |
		cycle -q -n 60000 --every 500 'push kick/2 drift | p2m --kernel pcs | poisson-fft | mgrad | m2p | push kick/2' |
		diag --columns time,energy_kinetic --tee kinetic | spectrum --field phi --shell 0.02 >t
	awk 'FNR == NR { v2[FNR > 1 ? $1 : -1] = 2 * $2 / 6283.185307179586; next }
		$1 > 0.17 && $1 < 0.23 && $5 > 6000 { e += $1^2 * $4 * 32768 / 6283.185307179586 / v2[$5]; w += v2[$5]; n++ }
		END { print e / n * (1 + 0.04 * w / n) }' kinetic t >ratio
	within "$(cat ratio)" 1 0.1 # 60 waves a frame
}

@test "PIC-16: a cold wave of any amplitude swings at omega_p: displacements of -A half a period on, 1/(1 - A) of the density at the crest" {
	for A in 0.1 0.5; do
		pinit langmuir -n 4096 --cells 64 --dt 0.031415926535897932 --amplitude $A >s
		cycle -q -n 100 "$step" <s >half
		for f in s half; do
			stab --plain --set electrons <$f | awk '/x/ { for (i = 1; i <= NF; i++) c[$i] = i; next } { print $c["id"], $c["x"] }'
		done >both # the way is twice the displacement, -2 A sin(k q)
		within "$(awk 'NR <= 4096 { x[$1] = $2; next } { d = $2 - x[$1]; if (d > 3) d -= 6.283185307179586; if (d < m) m = d }
			END { print m / 2 }' both)" -$A 1e-3 "A = $A"
		for cells in 64 128 256; do
			n[cells]=$(p2m -n $cells <s | stab --plain --mesh mesh | awk '/rho/ { for (i = 1; i <= NF; i++) c[$i] = i; next }
				NF && 1 - $c["rho"] > m { m = 1 - $c["rho"] } END { print m }') # the ions are 1, electrons -n
		done
		within "${n[256]}" "$(calc "1 / (1 - $A)")" 1e-3 "crest, A = $A"
	done
	order 2 1 "$(calc "2 - ${n[256]}")" 2 "$(calc "2 - ${n[128]}")" 4 "$(calc "2 - ${n[64]}")"
}

# wave DIM AXES: the frequency w of a wave along x or a diagonal on 8 cells an axis, corrected for the leapfrog, from the velocity of one electron.
wave() {
	pinit langmuir --dim "$1" --axes "$2" -n $((32 ** $1)) --cells 8 --amplitude 1e-5 --dt 0.1 | cycle -n 8 --every 1 "$step" |
		stab --plain --set electrons |
		awk '/x/ { for (i = 1; i <= NF; i++) if ($i == "v" || $i == "vx") c = i; frame++; n = 0; next } ++n == 3 { v[frame] = $c }
			END { for (i = 2; i < frame; i++) { num += (v[i-1] + v[i+1]) * v[i]; den += 2 * v[i]^2 } printf "%.9g",
				2 / 0.1 * sqrt((1 - num / den) / 2) }'
}

@test "PIC-07 in two and three dimensions: along x cos(k dx/2), along the diagonals less by the kernel's sums over the other axes" {
	# w^2 = cos(k dx/2)^2 B^(axes - 1) with B, for each other axis, the mean over the electrons of (1-t)^2 + t^2 + 2 t (1-t) cos(k dx), t their place in the
	# cell: 1 - (1/3 + 1/(6 p^2)) (1 - cos(k dx)) for p electrons in the middle of as many parts of a cell (p to infinity: sum of sinc^4). k dx = pi/4,
	# p = 4.
	for case in "1 1" "2 1" "2 2" "3 1" "3 3"; do
		read -r dim axes <<<"$case"
		want=$(awk -v a="$axes" 'BEGIN { printf "%.9g",
			cos(0.39269908169872415) * (1 - (1 / 3 + 1 / 96) * (1 - cos(0.78539816339744831)))^((a - 1) / 2) }')
		within "$(wave "$dim" "$axes")" "$want" 1e-4 "dim $dim axes $axes"
	done
}

@test "momentum of a plasma stays at rounding, whatever the kernel" {
	for kernel in ngp cic tsc; do
		sh_ok "pinit two-stream -n 2000 --cells 32 --vth 0.1 --amplitude 0.1 | cycle -n 50 '${step/p2m/p2m --kernel $kernel}' | diag > t"
		below "$(awk -v p="$(column momentum_x < t)" -v s="$(column momentum_scale < t)" 'BEGIN { printf "%.17g", p / s }')" 1e-13 "$kernel"
	done
}

@test "momentum of a plasma is conserved with the same kernel in p2m and m2p, and not with two different ones" {
	sh_ok "pinit two-stream -n 2000 --cells 32 --vth 0.1 --amplitude 0.1 --loading random | cycle -n 50 '${step/m2p/m2p --kernel tsc}' | diag > t"
	above "$(awk -v p="$(column momentum_x < t)" -v s="$(column momentum_scale < t)" 'BEGIN { printf "%.9g", p < 0 ? -p / s : p / s }')" 1e-8
}

# turning DT: the frequency of the first velocity of one electron, from frames of a stream.
turning() { stab --plain --set electrons | awk -v dt="$1" '/x/ { for (i = 1; i <= NF; i++) if ($i == "v" || $i == "vx" || $i == "v_0") c = i; frame++; n = 0;
	next } ++n == 3 { v[frame] = $c }
	END { for (i = 2; i < frame; i++) { num += (v[i-1] + v[i+1]) * v[i]; den += 2 * v[i]^2 } q = num / den; printf "%.9g", atan2(sqrt(1 - q * q),
		q) / dt }'; }

@test "one to three velocities in one dimension; across a magnetic field the wave oscillates at the upper hybrid frequency (PIC-15)" {
	for n in 1 2 3; do
		within "$(pinit langmuir -n 256 --cells 16 --velocities $n --amplitude 1e-5 --dt 0.02 | cycle -n 40 --every 1 "$step" |
			turning 0.02)" 0.980785 1e-4 "$n velocities"
	done
	# omega^2 = w^2 + Omega^2, w = cos(pi/16): sqrt 2 = 1.41421 less 0.9 %; a B in the plane of the wave front, along y, needs the third velocity
	for case in "2 0,0,1" "3 0,0,1" "3 0,1,0" "3 0,0.6,-0.8"; do
		read -r n b <<<"$case"
		pinit langmuir -n 256 --cells 16 --velocities "$n" --amplitude 1e-5 --dt 0.02 | scalc --mesh mesh "B = $b" --role state |
			cycle -n 40 --every 1 "${step//kick/boris}" > a
		within "$(turning 0.02 < a)" "$(awk 'BEGIN { print sqrt(1 + 0.980785280403230^2) }')" 1e-4 "B = $b, $n velocities" # 1e-5 (omega dt)^2/24
	done
	# a field along the wave has no effect
	within "$(pinit langmuir -n 256 --cells 16 --velocities 3 --amplitude 1e-5 --dt 0.02 | scalc --mesh mesh "B = 1, 0, 0" --role state |
		cycle -n 40 --every 1 "${step//kick/boris}" | turning 0.02)" 0.980785 1e-4
}

@test "bernstein: the wave is the sum of Bernstein's modes with the amplitudes of theory, and dispersion finds three of them" {
	pinit bernstein --cells 128 --amplitude 0.1 | cycle -q -n 700 --every 4 "${step//kick/boris}" >run
	# frequencies and amplitudes: scipy's brentq and ive as in tests/unit/dispersion.c, 2 (1 + k^2)/(omega_j eps'(omega_j));
	# what is missing adds up to 0.002; 0.02 from the step, (dt)^2 t/12 of the phase
	diag --columns time --modes 1 run | awk 'function size(y) { return y < 0 ? -y : y } NR == 2 { first = $2 } NR > 1 && $1 < 30 {
		d = size($2/first - size(0.30358 + 0.4385*cos(1.163872*$1) + 0.2112*cos(2.106416*$1) + 0.0415*cos(3.027774*$1) + 0.0048*cos(4.0044*$1)))
		if (d > most) most = d } END { print most }' >t # diag prints the size of the amplitude
	below "$(cat t)" 0.03
	while read -r low high want; do
		within "$(dispersion -q -n 1 --lowest $low --highest $high run | awk 'NR > 1 { print $3 }')" "$want" 0.006 # a tenth of the resolution
	done <<<$'0.5 1.7 1.163872\n1.7 2.6 2.106416\n2.6 3.5 3.027774'
}

@test "two species oscillate together: electrons and ions of mass 4, omega^2 = 1 + 1/4 times that of the mesh; the same ions as a background, 1" {
	pinit langmuir -n 256 --cells 16 --amplitude 1e-5 --dt 0.02 | smod --constant background=0 > electrons
	pinit langmuir -n 256 --cells 16 --amplitude 0 --dt 0.02 | smove --scale charge=-1,mass=4 | smod --rename electrons=ions --constant background=0 |
		sel --drop mesh > ions
	for order in 'electrons ions' 'ions electrons'; do
		# shellcheck disable=SC2086 # two files
		stack $order | cycle -n 40 --every 1 "${step/p2m/p2m -n 16}" > a
		within "$(turning 0.02 < a)" "$(awk 'BEGIN { print 0.980785280403230 * sqrt(1.25) }')" 1e-4
	done
	below "$(sel --last < a | diag | column charge)" 1e-13
	# the solver reports no mean: the ions are the background
	below "$(sel --last < a | p2m | poisson-fft | grep -ao '"mean[^:]*":[-0-9.e+]*' | tail -n 1 | cut -d: -f2)" 1e-12
}

@test "PIC-01: a quiet start of 1e4 particles a cell has the right damping to 4 % and frequency to 0.3 % (k = 0.3 and 0.5)" {
	[ -n "$PM_LONG" ] || skip "long: make check-long"
	# k A = 0.02 and 64 cells, as the case has it. Window: from 5 pi/(2 omega), when the second root is gone, to pi/sqrt(k A), half a bounce of the trapped
	# electrons. The run of the case: 4 % at 0.3 and 1.5 % at 0.5.
	for case in "0.3 1.15984648059191 -0.0126203684211172" "0.5 1.41566188860454 -0.153359466909605"; do
		read -r k omega gamma <<<"$case"
		pinit landau --wavenumber "$k" -n 640000 --loading bit-reversed |
			cycle -t 22.3 "$step | diag --columns time --growth mode:1 --tee t --window $(awk -v w="$omega" 'BEGIN { printf "%g:22.2",
				7.853981634 / w }')" > last
		within "$(sed -n 's/^# .* omega \([^,]*\),.*/\1/p' t)" "$omega" "$(awk -v w="$omega" 'BEGIN { print 0.003 * w }')" "omega, k = $k"
		within "$(sed -n 's/^# .* gamma \([^ ]*\) .*/\1/p' t)" "$gamma" "$(awk -v g="$gamma" 'BEGIN { print -0.04 * g }')" "gamma, k = $k"
	done
}

@test "a neutral plasma with its background has no mean density; without it the force is the same, because the solver removes the mean" {
	sh_ok "pinit langmuir -n 500 | p2m | poisson-fft > a"
	below "$(grep -ao '"mean[^:]*":[-0-9.e+]*' a | tail -n 1 | cut -d: -f2)" 1e-12
	sh_ok "pinit langmuir -n 500 --no-history | stab > h; sed 's/\"background\":1.0/\"background\":0.0/' h > g
		for k in h g; do stab \$k | p2m | poisson-fft | mgrad | m2p | stab --plain --set electrons > \$k.t; done"
	paste h.t g.t | awk 'NR == 1 { n = NF / 2; for (i = 1; i <= n; i++) if ($i == "acc") c = i; next } { d = $c - $(c + n);
		if (d * d > most) most = d * d } END { exit !(c && most < 1e-26) }'
}

@test "between walls the background acts: a density of 2 alone makes the parabola phi = 1/4 - (x - 1/2)^2" {
	printf 'x v mass charge\n0.5 0 1 0\n' > t
	sh_ok "stab t --law electrostatic --box 0,1 --faces wall --particle-faces reflect --dt 0.1 --strength charge > a"
	stab < a | sed 's/"constants":{[^}]*}/"constants":{"background":2.0,"eps0":1.0}/' > b
	sh_ok "stab b | p2m -n 16 | poisson-fft | m2p --field phi | stab --plain --set matter > c"
	within "$(awk 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "phi") c = i; next } { print $c }' c)" 0.25 1e-12
}

@test "two species of opposite charge and unequal mass: equal and opposite momentum" {
	printf 'x v mass charge id\n0.3 0 1 -1 0\n' > e
	printf 'x v mass charge id\n0.55 0 25 1 1\n' > i
	for s in e i; do sh_ok \
		"stab $s --law electrostatic --box 0,1 --faces periodic --particle-faces periodic --dt 0.01 --strength mass,charge --set $s > $s.f"; done
	sh_ok "stack e.f i.f | cycle -n 20 '${step/p2m/p2m -n 16}' | diag > t"
	below "$(column momentum_x < t)" 1e-15
	[ "$(column charge < t)" = 0 ]
	awk -v s="$(column momentum_scale < t)" 'BEGIN { exit !(s > 1e-3) }'
}

@test "passive particles move with a given velocity, in any scheme" {
	printf 'x y\n0.25 0.5\n0.9 0.1\n' > t
	sh_ok "stab t --law passive --box 0,1 --faces periodic --particle-faces periodic --dt 0.1 --cells 8 > a"
	field='{"components":2,"kind":"value","name":"u","on":"mesh","role":"state","type":"f64","uniform":[0.5,-0.25],"unit":""}'
	stab < a | sed '1s/"fields":\[{/"fields":['"$field"',{/' > b
	for words in rk4 euler; do
		sh_ok "stab b | cycle -n 4 'm2p | push $words' | stab --plain > c"
		within "$(awk 'NR == 2 { print $1 }' c)" 0.45 1e-14
		within "$(awk 'NR == 3 { print $2 }' c)" 0 1e-14
	done
	run -1 --separate-stderr m2p -i a
	[[ $stderr == *"no field 'u'"* ]]
}

@test "a magnetic field that varies is interpolated to the particles, with the kernel of the transfer" {
	sh_ok "pinit gyration -n 5 --length 4 --velocities 3 > a; scalc --mesh mesh 'B = 0, 0, 1 + x / 4' < a > b"
	sh_ok "m2p < b | stab --plain --set electrons > c"
	awk 'NR == 1 { for (i = 1; i <= NF; i++) { if ($i == "x") x = i; if ($i ~ /^bfield/) b = i } next } NF { d = $b - 1 - $x / 4;
		if (d * d > 1e-28) exit 1; n++ } END { exit n != 5 }' c
}

@test "a given E on another mesh is added to the computed one, as a separate term" {
	sh_ok "pinit langmuir -n 64 --cells 16 | p2m | poisson-fft | mgrad | m2p > a; stab --plain --set electrons < a > a.t"
	field='{"components":1,"kind":"value","name":"E","on":"external","role":"state","type":"f64","uniform":[0.5],"unit":""}'
	mesh='{"cells":[4],"h":[1.5707963267948966],"lo":[0.0],"name":"external"}'
	stab < a | sed '1s/"fields":\[{/"fields":['"$field"',{/; 1s/"meshes":\[/&'"$mesh"',/' > b
	sh_ok "stab b | m2p --mesh external > c; stab --plain --set electrons < c > c.t; stab < c | grep '\"terms\":\[\"self\",\"external\"\]' >/dev/null"
	# q/m = -1
	paste a.t c.t | awk 'NR == 1 { n = NF / 2; for (i = 1; i <= n; i++) if ($i ~ /^acc/) c = i; next } { d = $(c + n) - $c + 0.5;
		if (d * d > 1e-28) exit 1 } END { exit !c }'
}
