# spectrum: Parseval, transforms that are known, slopes, what is refused (000:S104, N42; 002:FT4, N27, N57). Sums of the definition: tests/unit/spectrum.c.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# wave CELLS EXPRESSION [stab options]: a field called f on a mesh of the box 0..1, or that of --box.
wave() { printf 'x q\n0 1\n' | stab - --strength q --box 0,1 --faces periodic "${@:3}" -n "$1" | scalc --mesh mesh "f=$2"; }
# parseval FILE: the largest part by which sum energy width, and the sum over waves, differ from half of the mean square.
parseval() {
	spectrum --format json "$@" >json
	python3 -I -S -c 'import json, sys
worst = 0
for line in open("json"):
    s = json.loads(line)
    sum = 2 * s["width"] * __import__("math").fsum(s["energy"]) + __import__("math").fsum(m * m for m in s["mean"])
    worst = max(worst, abs(sum / s["mean_square"] - 1), abs(s["waves_square"] / s["mean_square"] - 1))
print(worst)'
}

@test "002:N27, 000:N42: Parseval: the shells hold the mean square to rounding; scalars and vectors, all faces, meshes that are no cubes" {
	pinit taylor-green-3d --cells 8x12x10 | p2m | poisson-fft | mgrad >a
	below "$(parseval --field u a)" 1e-14 # a few roundings for each of 17 shells
	below "$(parseval --field omega a)" 1e-14
	pinit plummer -n 300 --cells 11x6x7 | p2m | poisson-fft | mgrad >b
	below "$(parseval b)" 1e-14
	below "$(parseval --field g b)" 1e-14
	pinit uniform --dim 2 -n 300 --faces periodic,wall | p2m -n 9x16 >c
	below "$(parseval --shell 1 c)" 1e-14
	below "$(parseval --shell 100 c)" 1e-14
	spectrum c | tail -1 | grep -q '^# rho at time 0: mean 0.94[0-9]*, mean square .*, by its waves that times 1 [-+][0-9.e-]*, shells '
}

@test "000:S104: exp(-x^2/2), exp(-a|x|) and a box have the squares of their transforms, a single point that of a delta" {
	# power is |f^(k)|^2/L with f^ the integral of f exp(-i k x); the sum over nodes adds that of k + 2 pi/h (aliases), for the Gaussian below 1e-16
	wave 256 'exp(-x^2/2)' --box -20,20 >a
	spectrum a | awk '$1 < 4 && $1 + 0 { e = $4 * 40 / (2 * atan2(0, -1) * exp(-$1^2)) - 1; if (e^2 > m) m = e^2 } END { print sqrt(m) }' >off
	below "$(cat off)" 1e-9 # at k = 4 the square is 1e-7 of the largest, with rounding of 1e-16 of that in the amplitude
	wave 4096 'exp(-2*abs(x))' --box -20,20 >a
	# a kink: aliases are (k h)^2/(2 pi)^2 2 zeta(2) of it, h = 40/4096, k < 4: 1.3e-4 in the amplitude
	spectrum a | awk '$1 < 4 && $1 + 0 { e = $4 * 40 / (4 / (4 + $1^2))^2 - 1; if (e^2 > m) m = e^2 } END { print sqrt(m) }' >off
	below "$(cat off)" 3e-4
	wave 4096 'abs(x) < 2 ? -1 : abs(x) == 2 ? -0.5 : 0' --box -20,20 >a # its edges are nodes: 4 h^-1 = 409.6 is none, so the length is 408/4096*40
	spectrum a | awk -v l="$(calc '408/4096*20')" 'function off(k,  s) { s = 2 * sin(k * l) / k; return s }
		$1 < 2 && $1 + 0 { s = ($4 * 40) - off($1)^2; if (s^2 > m) m = s^2 } END { print sqrt(m) / (4 * l * l) }' >off
	below "$(cat off)" 0.003 # the sum over 409 nodes is that of a box 409 wide: 1/408 of the amplitude at its largest
	printf 'x y q\n0.3 0.7 3\n' | stab - --strength q --box 0,2 --faces periodic -n 12x9 | p2m --kernel ngp --strength q >p
	spectrum p | awk '$1 + 0 { e = $4 / (9 / 4) - 1; if (e^2 > m) m = e^2 } END { print sqrt(m) }' >off
	below "$(cat off)" 1e-13 # 3/V in every wave, times the volume 4
}

@test "002:N57: the slope of waves with amplitude k^(-5/6) is -5/3, with no error; particles at random have slope 0 of power, within its error" {
	f=$(for k in $(seq 1 12); do printf '+%s^(-5/6)*cos(2*pi*%s*x+%s)' "$k" "$k" "$((k * k))"; done)
	printf 'x q\n0 1\n' | stab - --strength q --box 0,1 --faces periodic -n 128 | scalc --mesh mesh "f=${f:1}" >a
	spectrum --field f --fit 6:76 --format json a >json
	within "$(grep -o '"slope_energy":[^,]*' json | cut -d: -f2)" -1.6666666667 1e-8 # printed with 9 digits
	below "$(grep -o '"slope_error":[^,]*' json | cut -d: -f2)" 1e-12
	pinit uniform -n 4000 --seed 5 --dim 3 --faces periodic | p2m --kernel m6prime -n 32 >b # m6prime is flat to a quarter of the mesh's waves
	spectrum --contrast --fit 6:50 b >table
	awk '$1 + 0 && $1 < 50 { s += $4 * $2; n += $2 } END { print s / n * 4000, 3 * sqrt(2 / n) }' >mean <table
	within "$(cut -d' ' -f1 mean)" 1 "$(cut -d' ' -f2 mean)" # 1/n for each wave; half of the waves are independent: 3 standard deviations
	read -r slope error < <(sed -n 's/^# slope .* +- \(.*\) of energy, \([^ ]*\) of power.*/\2 \1/p' table)
	within "$slope" 0 "$(calc "3*$error")"
}

@test "spectrum: a frame after another, the law's velocity made again from its potential, and the same bytes for any number of threads" {
	pinit taylor-green-2d --cells 16 | cycle -n 2 --every 1 'p2m | poisson-fft | mgrad | m2p | push rk2' >a
	run -1 grep -aq '"name":"u"' a # cycle leaves it out
	p2m a | poisson-fft >b
	spectrum b >want
	[ "$(grep -c '^# u at time' want)" = 3 ]
	[ "$(grep -c '^k' want)" = 1 ]
	mgrad b | spectrum >got
	diff want got
	OMP_NUM_THREADS=3 spectrum b >got
	diff want got
}

@test "spectrum: what it cannot measure is refused by name" {
	pinit uniform --dim 1 -n 10 >a
	run -1 --separate-stderr spectrum a
	[[ $stderr == *"no field 'rho' on a mesh (sls lists them; p2m, the solvers and mgrad make them)"* ]]
	p2m -n 8 a >c
	run -2 --separate-stderr spectrum --fit 3 c
	[[ $stderr == *"--fit '3' (it is written K0:K1, 0 < K0 < K1)"* ]]
	run -2 --separate-stderr spectrum --shell 1e-30 c
	[[ $stderr == *'shells of width 1e-30'* ]]
	spectrum --fit 1:2 c | grep -q '^# no slope: 0 shells'
	wave 8 '0*x' >d
	run -1 --separate-stderr spectrum --contrast --field f d
	[[ $stderr == *"--contrast divides by the mean, and 'f' has the mean 0"* ]]
}
