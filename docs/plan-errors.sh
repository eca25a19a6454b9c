#!/usr/bin/env bash
# Tables of docs/plan.md: what plan foresees of the errors of the method and of the sample, and what runs have; errors are the same on every machine, up to
# round-off.
#     bash docs/plan-errors.sh [TABLE...]
# The tables: lattice, encounters, heating, noise, resolution, loss, relaxation, collisions, strain, points, again, region. Three minutes for all.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
PATH=${PM_BIN:-$top/bin}:$PATH
export LC_ALL=C OMP_NUM_THREADS=1 # small meshes, many steps
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

calc() { awk "BEGIN { printf \"%.17g\", ($1) }"; }
title() { printf '\n%s\n' "$1"; sed 's/[^|]\+/---/g' <<<"$1"; }
share() { plan --no-cost --format json "${@:2}" <start | jq -r --arg e "$1" '.effects[] | select(.effect == $e) | .share'; }
# words TIME OPTION...: the sentence of the plan for the frame `start`, with the step of the frame.
words() { plan --sentence -t "$@" <start 2>/dev/null | sed 's/--dt [^ ]* //'; }
force() { tr '|' '\n' | grep -v 'push' | paste -sd'|'; }
# one WORDS: with commas, for a cell of a table.
one() { sed 's/ *| */, /g; s/^ *//; s/ *$//' <<<"$1"; }
# relative SET FIELD A B: the l2 norm of the difference over that of B.
relative() { scmp --set "$1" --field "$2" "$3" "$4" | awk -F'\t' 'NR == 2 { printf "%.1e", $8 }'; }
plasma() { scalc 'charge = -mass' --extensive --role state | smod --law electrostatic --constant eps0=1,background=1; }
# moments FILE: mean squares of the components of v, and the mean of their fourth powers.
moments() {
	stab --plain "$1" | awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
		{ for (k = 1; k <= 3; k++) { v = "v" substr("xyz", k, 1); if (v in c) { s[k] += $c[v]^2; f += $c[v]^4 } } n++ }
		END { print s[1] / n, s[2] / n, s[3] / n, f / n }'
}

# sheets KERNEL A CELLS N TIME...: sheets of a cold wave swing each by itself; the rms of the velocities' error over that of the wave, A/sqrt 2.
sheets() {
	local kernel=$1 A=$2 cells=$3 n=$4 T
	pinit langmuir -n "$n" --cells "$cells" --amplitude "$A" >start
	printf '| %s | %s, %s, %s ' "$kernel" "$A" "$cells" "$(awk "BEGIN { printf \"%.3g\", $n / $cells }")"
	for T in "${@:5}"; do
		cycle -t "$T" "p2m --kernel $kernel | poisson-fft --symbol spectral | mgrad --order spectral | m2p | push --dt 0.1 rk4" <start >end 2>/dev/null
		scalc "v = -$A*sin(2*pi*(id + 0.5)/$n)*sin(time)" <end >right
		printf '| %.1e ' "$(scmp --set electrons --field v end right | awk -F'\t' -v A="$A" 'NR == 2 { print $6 / A * sqrt(2) }')"
	done
	echo '|'
}

# encounter TIME SCENE...: of velocities, l2, with dt = C/sqrt(2 G m/softening^3), against C = 0.02.
encounter() {
	local T=$1 rate C
	shift
	pinit "$@" >start
	rate=$(awk -v n="$3" -v eps="$5" 'BEGIN { printf "%.17g", sqrt(2 / n / eps ^ 3) }')
	printf '| %s, t = %s ' "$*" "$T"
	for C in 0.02 0.06 0.2 0.6 2; do
		cycle -t "$T" "push --dt $(awk "BEGIN { printf \"%.17g\", $C / $rate }") kick/2 drift | pp | push kick/2" <start >end 2>/dev/null
		[ $C != 0.02 ] || { cp end right; continue; }
		printf '| %.1e ' "$(scmp --set matter --field v end right | awk -F'\t' 'NR == 2 { print $8 }')"
	done
	echo '|'
}

lattice() {
	title '| kernel | A, cells, n | 5 | 20 | 40 | 60 | 100 |'
	local kernel
	for kernel in cic tsc m6prime lambda-6-4; do
		sheets $kernel 0.05 64 4096 5 20 40 60 100
	done
	sheets lambda-6-4 0.05 64 1000 5 20 40 60 100
	sheets lambda-6-4 0.02 64 541 5 20 40 60 100
}
encounters() {
	title '| scene | 0.06 | 0.2 | 0.6 | 2 |'
	encounter 0.421 plummer -n 102 --softening 0.0219 --seed 228
	encounter 3.62 plummer -n 487 --softening 0.00871 --seed 281
	encounter 1.06 plummer -n 677 --softening 0.00341 --seed 224
	encounter 2.5 plummer -n 1040 --softening 0.00589 --seed 288
	encounter 0.464 cold-sphere -n 88 --softening 0.00529 --seed 974
	encounter 0.309 cold-sphere -n 172 --softening 0.00803 --seed 428
	encounter 0.57 cold-sphere -n 968 --softening 0.00518 --seed 400
}

# thermal DIM N CELLS LAMBDA_D/H: electrons at rest on the whole, in 1-D evenly spaced; omega_p = 1, one component of v is 1.
thermal() {
	local l
	l=$(calc "$3 / $4")
	pinit uniform --dim "$1" -n "$2" --length "$l" --mass "$(calc "$l ^ $1")" --dispersion 1 --cells "$3" --softening 0 --dt 0.2 --seed 3 |
		if [ "$1" = 1 ]; then scalc "x = (id + 0.5) * $l / $2" "v = v + ${5:-0}"; else cat; fi | plasma >start
}
# grown TIME NAME: a row: what plan foresees of the energy by its own words, and what a run with them has.
grown() {
	local w solve
	w=$(words "$1" --accuracy 1)
	solve=$(force <<<"${w/| m2p/}")
	cycle -q -t "$1" "$w" <start >end 2>/dev/null
	printf '| %s | %s | %.2g ' "$2" "$(one "$solve")" "$(share grid-heating -t "$1" --accuracy 1)"
	for f in start end; do bash -c "$solve" <$f | diag --columns energy | tail -n 1; done | awk 'NR == 1 { a = $1 } END { printf "| %.2g |\n", $1 / a - 1 }'
}
heating() {
	title '| plasma: lambda_D/h, particles in a cell, T | words of the plan for accuracy 1 | predicted | measured |'
	local l v
	for l in 0.05 0.1 0.2 1; do thermal 1 4096 64 $l; grown 1000 "1-D: $l, 64, 1000"; done
	thermal 1 2048 64 0.6; grown 1000 '1-D: 0.6, 32, 1000'
	thermal 1 512 64 0.6; grown 200 '1-D: 0.6, 8, 200'
	thermal 1 16384 64 0.1; grown 200 '1-D: 0.1, 256, 200'
	for v in 1 3.3; do thermal 1 4096 64 0.2 $v; grown 400 "1-D: 0.2, 64, 400, drift $v v_th"; done
	for v in 0.1 0.2 0.4 0.8; do
		pinit uniform --dim 1 -n 2048 --length 64 --mass 64 --cells 64 --dt 0.1 |
			scalc 'x = (id + 0.5) / 32 + 0.001*sin(2*pi*id*id*0.618034)' "v = $v" | plasma >start
		grown 200 "cold beam: v0 = $v omega_p h, 32, 200"
	done
	for l in 0.1 0.3 1; do thermal 2 8192 32 $l; grown 200 "2-D: $l, 8, 200"; done
	for l in 0.2 1; do thermal 3 16384 16 $l; grown 60 "3-D: $l, 4, 60"; done
}

# The amplitude of landau's field at a random start: its spread over 16 seeds, at two times.
noise() {
	title "| landau at random: N, amplitude | predicted | spread at t = 0 | at t = 2 |"
	local c n a seed t
	for c in '20000 0.2' '20000 0.1' '200000 0.1' '200000 0.02'; do
		read -r n a <<<"$c"
		for seed in $(seq 16); do
			pinit landau --loading random -n "$n" --amplitude "$a" --seed "$seed" >start
			for t in 0 2; do
				cycle -q -t $t 'push --dt 0.1 kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' <start 2>/dev/null |
					p2m | poisson-fft | mgrad | diag --modes 1 --columns time | tail -n 1
			done
		done | cut -f 2 >amplitudes
		printf '| %s, %s | %.2g ' "$n" "$a" "$(share sampling-noise -t 2)"
		for t in 1 0; do
			awk -v t=$t 'NR % 2 == t { s += $1; q += $1^2; n++ } END { s /= n; printf "| %.2g ", sqrt(q / n - s * s) / s }' amplitudes
		done
		echo '|'
	done
}

resolution() {
	title '| langmuir on 64 cells, mode | words of the plan for accuracy 1 | predicted error of the force | measured, l2 |'
	local m w
	for m in 2 4 8 16; do
		pinit langmuir --mode $m --amplitude 0.01 >start
		w=$(words 0.01 --accuracy 1 --on self-field | force)
		bash -c "$w" <start | scalc "want = -0.01/$m*sin($m*2*pi*(id + 0.5)/4096)" >end
		printf '| %s | %s ' $m "$(one "$w")"
		stab --plain end | awk -v p="$(share resolution -t 0.01 --accuracy 1 --on self-field)" 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
			{ d += ($c["acc"] - $c["want"])^2; r += $c["want"]^2 } END { printf "| %.2g | %.2g |\n", p, sqrt(d / r) }'
	done
}

# peak TIME WORDS: the relative error of the largest vorticity.
peak() {
	cycle -q -t "$1" "$2" <start 2>/dev/null | p2m --kernel m6prime | diag --exact --columns omega_max |
		awk -F'\t' 'NR == 2 { e = $1 / $2 - 1; printf "%.2g", e < 0 ? -e : e }'
}
loss() {
	title '| scene | h k | predicted | measured by its plan |'
	local T w c scene
	for c in '0.8 shear-layer 128' '0.8 shear-layer 192' '5 taylor-green-2d 16' '5 taylor-green-2d 24' '5 taylor-green-2d 32' '5 taylor-green-2d 48'; do
		read -r T scene c <<<"$c"
		pinit "$scene" --cells $c >start
		w=$(plan --sentence -t "$T" <start 2>/dev/null)
		printf '| %s --cells %s, t = %s | %s | %.2g | %s |\n' "$scene" "$c" "$T" \
			"$(plan -t "$T" --no-cost <start | sed -n 's/^# remeshing loss.*h k = \([0-9.]*\).*/\1/p')" "$(share remeshing-loss -t "$T")" \
			"$(peak "$T" "$w")"
	done
}

# Stars that stand for 1e12: the mean square of their energies' change over v^2. Seeds: as many as given.
relaxation() {
	title '| plummer with bodies=1e12: N, softening, t | predicted | measured |'
	local c n eps T seeds seed f
	for c in '250 0.02 5 8' '500 0.02 5 6' '1000 0.02 5 4' '2000 0.02 5 3' '1000 0.1 5 4' '250 0.005 5 8' '1000 0.02 2.5 4' '1000 0.02 10 4'; do
		read -r n eps T seeds <<<"$c"
		for seed in $(seq "$seeds"); do
			pinit plummer -n "$n" --seed "$seed" --softening "$eps" --dt 0.01 | smod --constant bodies=1e12 >start
			pp --potential <start >a
			push clear <a | cycle -q -t "$T" 'push kick/2 drift | pp | push kick/2' 2>/dev/null | pp --replace --potential >b
			for f in a b; do scalc 'e = (vx^2 + vy^2 + vz^2)/2 + phi' <$f >e$f; done
			echo "$(scmp --field e eb ea | awk -F'\t' 'NR == 2 { print $6 }') $(moments a)"
		done | awk '{ d += ($1 / ($2 + $3 + $4))^2 } END { printf "%.2g", d / NR }' >measured
		printf '| %s, %s, %s | %.2g | %s |\n' "$n" "$eps" "$T" "$(share collisions -t "$T")" "$(<measured)"
	done
}

# unequal DIM PARTICLES_IN_A_DEBYE_SPHERE LENGTH CELLS TIME: which part of the difference of v^2 along x and the others is lost.
unequal() {
	local dim=$1 n
	n=$(calc "int($3 ^ $1 * $2 / ($1 == 2 ? 3.14159 : 4.18879))")
	pinit uniform --dim "$dim" -n "$n" --length "$3" --mass "$(calc "$3 ^ $1")" --dispersion 1 --cells "$4" --softening 0 --dt 0.1 --seed 1 |
		scalc "v = $([ "$dim" = 2 ] && echo '1.2*vx,0.8*vy' || echo '1.3*vx,0.85*vy,0.85*vz')" | plasma >start
	cycle -q -t "$5" "$(words "$5" --accuracy 1)" <start >end 2>/dev/null
	{ moments start; moments end; } | awk -v p="$(share collisions -t "$5" --accuracy 1)" -v row="| $dim-D: $2, $5" -v d="$dim" '
		{ u = $1 - (d == 2 ? $2 : ($2 + $3) / 2) } NR == 1 { a = u } END { printf "%s | %.2g | %.2g |\n", row, p, log(a / u) }'
}
# waterbag PARTICLES_IN_A_DEBYE_LENGTH TIME: evenly distributed v become Maxwellian: the kurtosis goes from 1.8 to 3. From TIME/4 to TIME, because the noise
# that a quiet start lacks changes it, too, by about 1.5/N_D at once.
waterbag() {
	local n
	n=$(calc "512 * $1")
	pinit uniform --dim 1 -n "$n" --length 512 --mass 512 --dispersion 1 --cells 1024 --softening 0 --dt 0.2 --seed 1 |
		scalc "x = (id + 0.5) * 512 / $n" 'v = 1.7320508*(2*mod(sin(id*12.9898 + 1)*43758.5453, 1) - 1)' | plasma >start
	for T in "$(calc "$2 / 4")" "$2"; do
		cycle -q -t "$T" 'push kick/2 drift | p2m --kernel tsc | poisson-fft | mgrad | m2p | push kick/2' <start 2>/dev/null >end
		moments end
	done | awk -v p="$(share collisions -t "$2" --accuracy 1)" -v row="| 1-D: $1, $2" '
		{ k = $4 / $1^2 } NR == 1 { a = k } END { printf "%s | %.2g | %.2g |\n", row, 0.75 * p, (k - a) / 1.2 }'
}
collisions() {
	title '| plasma: particles in a Debye sphere, omega_p T | predicted | measured |'
	waterbag 5 100; waterbag 10 200; waterbag 20 400
	unequal 2 5 32 128 10; unequal 2 10 32 128 20; unequal 2 40 32 128 100
	unequal 3 10 8 32 20; unequal 3 40 8 32 40; unequal 3 100 8 32 40
}

# A steady flow without viscosity, remeshed after every step of strain e: the error of the vorticity.
strain() {
	title '| taylor-green-2d on 64^2, t = 4: strain of a step, remeshed every step | 1 | 0.5 | 0.25 | 0.125 |'
	local e
	pinit taylor-green-2d --cells 64 --nu 0 >start
	p2m --kernel m6prime <start >first
	printf '| error of omega, l2 '
	for e in 1 0.5 0.25 0.125; do
		cycle -q -t 4 "$(words 4 --accuracy 0.01 | sed "s/ --every [0-9]*//; s/push /push --dt $e /")" <start 2>/dev/null | p2m --kernel m6prime >last
		printf '| %s ' "$(relative mesh omega last first)"
	done
	echo '|'
}

points() {
	title '| point-vortices -n 20000: softening/h | 0.64 | 1.28 | 2.56 | 5.12 |'
	local r
	printf '| error of the velocities on the mesh, l2 '
	for r in 128 256 512 1024; do
		pinit point-vortices -n 20000 --cells $r >start
		[ -s pairs ] || pp <start >pairs
		p2m --kernel m6prime <start | poisson-fft --green plummer | mgrad --order 6 | m2p >end
		printf '| %s ' "$(relative vortices vel end pairs)"
	done
	echo '|'
}

# again_row NAME ERROR TIME ACCURACY K: planned once, and again every K steps; ERROR prints the error of the frame `end`.
again_row() {
	printf '| %s, accuracy %s ' "$1" "$4"
	for o in '' "--again $5"; do
		cycle -t "$3" --plan --accuracy "$4" $o <start >end 2>said
		printf '| %s in %d steps ' "$($2)" "$(diag --columns step end | tail -n 1)"
	done
	echo "| $(grep -c instead said) |"
}
places() { relative matter x end exact; }
vorticity() {
	for f in end exact; do p2m --kernel m6prime -n 64x64 <$f >mesh-$f; done
	relative mesh omega mesh-end mesh-exact
}
# The exact v of that electron: u/sqrt(1 + u^2/4), u = (0.1/sqrt(1 - 0.0025), -2).
speed() {
	stab --plain end | awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
		{ printf "%.1e", sqrt(($c["vx"] - 0.0707549137677)^2 + ($c["vy"] + 1.41332829558063)^2) / 1.41509; exit }'
}
again() {
	title '| run | planned once | planned again | changes |'
	local two a
	pinit cold-sphere -n 300 --dt 0.05 --softening 0.1 >start
	cycle -q -t 2 'push --dt 0.0002 kick/2 drift | pp | push kick/2' <start >exact
	for a in 0.1 0.03 0.01; do again_row 'cold sphere, t = 2: places' places 2 $a 20; done
	pinit exb --dt 0.05 | sel --drop B | smod --constant c=2 >start
	again_row 'electron to v/c = 0.7, t = 20: v' speed 20 0.01 10
	two='exp(-((x.x-3.14159-0.8)^2+(x.y-3.14159)^2)/0.1) + exp(-((x.x-3.14159+0.8)^2+(x.y-3.14159)^2)/0.1)'
	for a in 128 64; do # against twice the cells, a fifth of the step
		pinit ellipse --cells $a --nu 0 --dt 0.02 | scalc --extensive "circulation = volume*5*($two)" >start
		[ $a = 64 ] || cycle -q -t 10 'p2m --kernel m6prime | poisson-fft | mgrad | m2p | push --dt 0.03125 lsrk3 | remesh --kernel m6prime --every 4' \
			<start >exact
	done
	again_row 'two vortices that merge, t = 10: omega' vorticity 10 0.05 25
}

# Pairs for the bodies of a core (r < 1), the mesh for the others: the total force over the rms force times N.
region() {
	title '| plummer on 64^3, N | pairs | mesh | pairs in the core, mesh outside |'
	local n
	for n in 1000 10000; do
		pinit plummer -n $n --cells 64 --seed 3 >start
		pp <start | stab --plain >a
		p2m <start | poisson-fft | mgrad | m2p | stab --plain --set matter >b
		paste a b | awk -v n=$n 'NR == 1 { for (i = 1; i <= NF; i++) if ($i in c) d[$i] = i; else c[$i] = i; next }
			{ core = $c["x"]^2 + $c["y"]^2 + $c["z"]^2 < 1
				for (k = 0; k < 3; k++) { p = $c["acc_" k]; m = $d["acc_" k]; P[k] += p; M[k] += m; S[k] += core ? p : m; all += p^2 } }
			END { s = sqrt(all * n); for (k = 0; k < 3; k++) { x += P[k]^2; y += M[k]^2; z += S[k]^2 }
				printf "| %d | %.1e | %.1e | %.1e |\n", n, sqrt(x) / s, sqrt(y) / s, sqrt(z) / s }'
	done
}

[ $# -gt 0 ] || set -- lattice encounters heating noise resolution loss relaxation collisions strain points again region
for table; do $table; done
