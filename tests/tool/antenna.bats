# antenna: light of the form asked for, both ways, with the order of the mesh; in the plane and in space; its energy; refusals.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

step() { echo "push boris/2 | p2m --current | antenna $1 | maxwell | push drift | m2p | push boris/2"; }
# dark CELLS [pinit options]: open faces, no field; c = 1, the box 0..2 pi.
dark() { pinit em-wave --cells "$@" | sel --drop E,B | smod --faces "${faces:-open}" --constant background=0 | p2m | maxwell --gauss; }
# off MESH CONDITION EXACT: largest |E_1 - EXACT| over the nodes, awk expressions in x.
off() {
	awk "BEGIN { pi = atan2(0, -1) } function exp2(s) { return exp(-s * s) } NR == 1 { for (i = 1; i <= NF; i++) at[\$i] = i; next }
		{ x = \$at[\"x\"]; if (!($2)) next; d = \$at[\"E_1\"] - ($3); if (d < 0) d = -d; if (d > m) m = d } END { printf \"%.17g\", m }" "$1"
}

@test "a pulse goes both ways as it was asked for, with an error of order 2, and leaves through the absorbing layers" {
	local points=()
	for n in 160 320 640; do
		dark $n >a
		# by 2.9 the pulse is at pi +- 1.7: a quarter of the box is left on both sides
		cycle -t 2.9 "$(step "--place 3.141592653589793 'Ey = cos(4*time)*exp(-((time-1.2)/0.4)^2)'")" <a >b
		read -r t < <(diag --columns time b | tail -1)
		stab --plain --mesh mesh b >mesh
		e=$(off mesh "x > 0.4 && x < 5.88" "cos(4*($t - (x > pi ? x - pi : pi - x))) * exp2(($t - (x > pi ? x - pi : pi - x) - 1.2) / 0.4)")
		echo "$n: $e"
		points+=("$(calc "1/$n")" "$e")
	done
	order 2 "${points[@]}"
	below "$e" 1.3e-3
	cycle -t 12 "$(step "--place 3.141592653589793 'Ey = cos(4*time)*exp(-((time-1.2)/0.4)^2)'")" <a | diag --columns energy | tail -1 >left
	below "$(<left)" 1e-8 # of 0.5
}

@test "along y in the plane and z in space a plane wave is that of one dimension, its energy is that of the wave, and every way of running has the same bytes" {
	wave="= 0.3*sin(3*time)*exp(-((time-1)/0.4)^2)"
	dark 60 --dt 0.03 >a
	cycle -n 60 "$(step "--place 3 'Ey $wave'")" <a | stab --plain --mesh mesh | column E_1 >line
	faces=periodic,open dark 4x60 --dim 2 --dt 0.03 >a2
	cycle -n 60 "$(step "--axis y --place 3 'Ez $wave'")" <a2 >b2
	stab --plain --mesh mesh b2 | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } $at["x"] == 0 { print $at["E_2"] }' >line2
	faces=periodic,periodic,open dark 3x2x60 --dim 3 --dt 0.03 >a3
	cycle -n 60 "$(step "--axis z --place 3 'Ex $wave'")" <a3 | stab --plain --mesh mesh |
		awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } $at["x"] == 0 && $at["y"] == 0 { print $at["E_0"] }' >line3
	faces=open,periodic dark 60x4 --dim 2 --dt 0.03 | cycle -n 60 "$(step "--place 3 'Ez $wave'")" | stab --plain --mesh mesh |
		awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } $at["y"] > 4 { print $at["E_2"] }' >line4 # the last of four rows
	[ "$(wc -l <line)" = 61 ]
	for k in 2 3 4; do below "$(paste line line$k | awk '{ d = $1 - $2; d = d < 0 ? -d : d; if (d > m) m = d } END { print m + 0 }')" 1e-14 "line $k"; done
	# both ways, 2 c eps0 integral E0^2 = 2 0.09 0.4 sqrt(pi/2)/2 (1 - exp(-(3 0.4)^2/2) cos 6), times 2 pi across
	want=$(calc '2 * pi * 2 * 0.09 * 0.4 * sqrt(pi / 2) / 2 * (1 - exp(-0.72) * cos(6))')
	within "$(diag --columns energy b2 | tail -1)" "$want" 0.006 # 9 cells of 0.1 a wavelength at the frequency 6.5: 3.4 %
	for t in 1 3; do OMP_NUM_THREADS=$t cycle --no-history -n 60 "$(step "--axis y --place 3 'Ez $wave'")" <a2 >t$t; done
	cycle --no-history -n 60 --engine pipes "$(step "--axis y --place 3 'Ez $wave'")" <a2 >pipes
	cycle --no-history -n 25 "$(step "--axis y --place 3 'Ez $wave'")" <a2 | cycle --no-history -n 35 "$(step "--axis y --place 3 'Ez $wave'")" >parts
	same_as t1 t3 && same_as t1 pipes && same_as t1 parts
}

@test "antenna: refusals in one sentence" {
	while IFS=';' read -r code command text; do
		run "-$code" --separate-stderr bash -c "$command"
		[[ ${#stderr_lines[@]} == 1 && $stderr == *"$text"* ]] || { echo "$command: $stderr"; return 1; }
		counted 1
	done <<-'END'
		1;pinit langmuir -n 9 --cells 8 | antenna -q 'Ey = 1';the law 'electrostatic' has no light
		2;pinit em-wave --cells 8 | antenna 'Ex = 1' --place 1;light that goes along x has no Ex (--axis)
		2;pinit em-wave --cells 8 | antenna 'Ey = 1' 'Ey = 2' --place 1;each once
		2;pinit em-wave --cells 8 | antenna 'Ey = 1';the face below along x is not open: give the place of the sheet (--place X)
		2;pinit em-wave --cells 8 | antenna --place 99 'Ey = 1';the sheet at x = 99 is outside the mesh 'mesh' (--place)
		1;pinit em-wave --cells 8 | antenna --axis y --place 1 'Ex = 1';a sheet across y in 1-D (--axis)
		2;pinit em-wave --cells 8 | antenna --place 1 'Ey = q';no coordinate or constant 'q'
		3;pinit em-wave --cells 8 | antenna --place 1 'Ey = 1/0';Ey of the antenna is inf at
		1;pinit em-wave --cells 8 | antenna --place 1 'Ey = 1' | antenna 'Ey = 2' --place 2;already holds the term 'antenna'
	END
}
