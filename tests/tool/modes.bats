# modes: growth, frequency and shape of the linear modes of a sentence. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

export OMP_NUM_THREADS=1
plasma() { echo "push --unsafe --dt $1 kick/2 drift | p2m | poisson-fft | mgrad | m2p | push --unsafe kick/2"; }
# column NAME [ROW] <table
column() { awk -F'\t' -v n="$1" -v r="${2:-1}" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == n) c = i } NR == r + 1 { print $c }'; }

@test "a leapfrog on a spring beyond its limit grows and decays by arcosh(dt^2/2 - 1) a step; below it the mode turns by 2 asin(dt/2)" {
	spring() { printf 'x vx\n0 0\n' | stab - --law free | modes --table "push --unsafe --dt $1 kick/2 drift | field acc=-x | push --unsafe kick/2"; }
	spring 2.1 >t
	# the table has eight digits: half of the last one; the map is linear, and its differences err by 2^-53/1e-5 = 1e-11
	within "$(column growth 1 <t)" 0.629849513 5e-9 # log(c + sqrt(c^2 - 1)), c = 1.205
	within "$(column growth 2 <t)" -0.629849513 5e-9
	[ "$(column unstable 1 <t)" = yes ]
	spring 1.3 >t
	within "$(column frequency 1 <t)" 1.415168873 5e-8 # 2 asin(0.65)
	within "$(column growth 1 <t)" 0 1e-10
	[ "$(column unstable 1 <t)" = no ]
}

@test "Langmuir waves on a mesh: the frequency below the limit, and the growth beyond it, are those of the discrete dispersion relation" {
	# omega^2 = (sin a/a)^3 cos a with a = pi/32 (docs/margin.md); growth arcosh((omega dt)^2/2 - 1)
	pinit langmuir -n 256 --cells 32 --amplitude 0 | modes --table "$(plasma 2.05)" >t
	want=$(awk 'BEGIN { a = atan2(0, -1) / 32; w2 = (sin(a) / a)^3 * cos(a); c = w2 * 2.05^2 / 2 - 1; print log(c + sqrt(c * c - 1)) }')
	within "$(column growth <t)" "$want" 1e-4 # 3e-5 is due to harmonics
	within "$(column frequency <t)" 3.14159265 6e-8 # exact; eight digits
	pinit langmuir -n 256 --cells 32 --amplitude 0 | modes --table -k 1 "$(plasma 1.99)" >t
	[ "$(column unstable <t)" = no ]
}

@test "the stream goes on with the mode: a plane wave, largest 1, and its growth in the report" {
	pinit langmuir -n 256 --cells 32 --amplitude 0 | modes "$(plasma 2.011)" >m
	# a + b cos and sin of 2 pi i/256 alone: what is left of mode_x is below 1e-3 (the cic kernel adds harmonics of the mesh)
	stab --plain m | awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { k = NR - 2; m[k] = $c["mode_x"]; a += m[k] * cos(k * 0.024543692606)
		b += m[k] * sin(k * 0.024543692606); if (m[k] > top) top = m[k] }
		END { for (k = 0; k < 256; k++) { d = m[k] - a / 128 * cos(k * 0.024543692606) - b / 128 * sin(k * 0.024543692606); s += d * d / 256 }
			print sqrt(s); exit !(sqrt(s) < 5e-3 && top == 1) }'
	sls --report --format json m | grep -q '"unstable":1'
	run -0 sls m
	[[ $output == *mode_v* && $output != *imaginary* ]]
	printf 'x vx\n0 0\n' | stab - --law free | modes 'push --dt 1 kick/2 drift | field acc=-x | push kick/2' | sls | grep -q mode_v_imaginary
}

@test "a state that is periodic: two streams over the time in which they cross the box grow as theory says" {
	pinit two-stream -n 256 --cells 32 --amplitude 0 |
		modes --table -k 1 -n 64 'push --dt 0.16031873 kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' >t
	within "$(column growth_rate <t)" 0.35355 2e-3 # 1/sqrt(8); the mesh takes away 0.4 %
	# a particle that ends on a face, beyond which one of the two runs of a difference folds it: a free one neither grows nor turns
	printf 'x vx\n0 1\n' | stab - --law free --box 0,1 --faces periodic | modes --table -k 1 'push --dt 1 drift | field acc=0 | push kick' >t
	within "$(column growth <t)" 0 1e-3 # a double eigenvalue 1: the root of the error of differences
}

@test "multistep schemes carry their registers: ab3 on the imaginary axis" {
	for w in 0.70 0.75; do
		printf 'x y\n0 0\n' | stab - --law free --dt 1 | modes --table -k 1 "field vel=-$w*y,$w*x | push --unsafe ab3" | column unstable
	done >t
	[ "$(cat t)" = $'no\nyes' ] # the limit is 0.7236
}

@test "a scheme that iterates: ias15 with steps of one length has the modes of rk4 about a circular orbit" {
	for scheme in rk4 'ias15 --tolerance 0'; do
		pinit two-body --eccentricity 0 --dt 0.01 | modes --table -k 1 --moving -n 20 "pp | push $scheme" | column growth_rate
	done | paste -s >t
	awk '{ exit !($1 > 1.41 && $1 < 1.4112 && ($1 - $2) ^ 2 < 1e-10) }' t || { cat t; false; } # 1.4106736 of both
}

@test "a leading mode that is not converged is told, once, and a converged one is not" {
	s='push --unsafe --dt 0.2 kick/2 drift | p2m | poisson-fft | mgrad | m2p | push --unsafe kick/2'
	pinit langmuir -n 256 --cells 32 --amplitude 0 >a
	run -0 --separate-stderr bash -c "modes --table --vectors 8 '$s' <a"
	[[ $stderr == "modes: mode 1 is not converged: after 8 vectors its growth is "*" a step (more --vectors)" && $(wc -l <<<"$stderr") = 1 ]]
	run -0 --separate-stderr bash -c "modes --table '$s' <a"
	[ -z "$stderr" ]
}

@test "what has no modes is refused in one line" {
	run -2 --separate-stderr modes --table --moving -n 20 'pp | push ias15' < <(pinit two-body --eccentricity 0 --dt 0.01)
	[[ $stderr == "modes: frame 1: the sentence chooses its steps"*"--tolerance 0"* && $(wc -l <<<"$stderr") = 1 ]]
	run -2 --separate-stderr modes --table "$(plasma 0.1)" < <(pinit landau -n 100)
	[[ $stderr == "modes: frame 1: the frame is no equilibrium: its state changes by "*"--moving"* && $(wc -l <<<"$stderr") = 1 ]]
	run -2 --separate-stderr modes 'p2m' < <(pinit langmuir -n 64)
	[[ $stderr == "modes: frame 1: "*"no word that completes a step"* ]]
	run -2 --separate-stderr modes --table --mode 2 'p2m' < <(pinit langmuir -n 64)
	[[ $stderr == *"--table writes none"* ]]
	run -2 --separate-stderr modes --mode 9 'push --dt 1 drift' < <(printf 'x vx\n0 0\n' | stab - --law free)
	[[ $stderr == *"--mode 9: there are "*" modes"* ]]
}

@test "the same bytes for any number of threads" {
	pinit langmuir -n 256 --cells 32 --amplitude 0 | modes "$(plasma 2.05)" --threads 1 >a
	pinit langmuir -n 256 --cells 32 --amplitude 0 | modes "$(plasma 2.05)" --threads 3 >b
	cmp a b
}
