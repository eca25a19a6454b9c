# window: a box that moves by whole cells: fields and particles keep their place in space, plasma comes in in front; the wake behind a pulse of light.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

step() { echo "push boris/2 | p2m --current | maxwell | push drift | window $1 | m2p | push boris/2"; }

# wake FROM TO: amplitude and wave number of E_x on the axis, between FROM and TO behind the front: of its mean square and its zeros.
wake() {
	stab --plain --mesh mesh | awk -v from="$1" -v to="$2" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
		at["y"] && $at["y"] != 0 { next }
		{ x[++n] = $at["x"]; e[n] = $at["E_0"] }
		END {
			for (i = 2; i <= n; i++) if (x[i] > x[n] - from && x[i] < x[n] - to && e[i - 1] * e[i] <= 0) {
				z = x[i - 1] + (x[i] - x[i - 1]) * e[i - 1] / (e[i - 1] - e[i])
				if (!zeros++) { first = z; start = i }
				last = z; end = i
			}
			for (i = start; i < end; i++) s += e[i] * e[i]
			printf "%.9g %.9g\n", sqrt(2 * s / (end - start)), 3.14159265358979 * (zeros - 1) / (last - first)
		}'
}

@test "the wake of a short pulse has the amplitude and the length of linear theory, in 1-D and on the axis of a beam" {
	want=$(calc 'sqrt(pi) / 4 * 0.01 * exp(-0.25)')
	read -r amplitude k < <(pinit wakefield | cycle -q -t 30 "$(step electrons)" | wake 22 9)
	within "$(calc "$amplitude / $want")" 1 0.01 "amplitude" # measured 0.996; the theory leaves out 1/k^2 = 0.01 and a0^2
	within "$k" "$(calc '1 / sqrt(0.99)')" 0.0015 "wave number" # measured 1.0053
	[ -n "${PM_LONG:-}" ] || return 0
	read -r amplitude k < <(pinit wakefield --dim 2 --wavenumber 5 | cycle -q -t 30 "$(step electrons)" | wake 22 9)
	within "$(calc "$amplitude / $want")" 1 0.035 "amplitude on the axis" # measured 0.976: the beam spreads
	within "$k" "$(calc '1 / sqrt(0.96)')" 0.006 "wave number on the axis"
}

# dark CELLS [pinit options]: open faces, no field; c = 1, the box 0..2 pi.
dark() { pinit em-wave --cells "$@" | sel --drop E,B | smod --faces open --particle-faces absorb --constant background=0 | p2m | maxwell --gauss; }

@test "fields keep their place: with a window of five cells a node has the bytes of the fifth behind it without one, and new nodes have 0" {
	pinit wakefield --length 12 --wavenumber 3 --cells 300 >a1
	pinit wakefield --dim 2 --length 12 --wavenumber 3 --waist 2 --cells 120x24 >a2
	dark 30x24 --dim 2 --dt 0.1 |
		cycle -n 20 "push boris/2 | p2m --current | antenna --place 3 'Ez = sin(5*time)' | maxwell | push drift | m2p | push boris/2" >a3
	while read -r a axis h; do
		dt=$(sls "$a" | sed -n 's/.* dt \([^ ]*\).*/\1/p')
		cycle -n 1 'push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2' <"$a" | stab --mesh mesh --plain >still
		start=$(sls "$a" | sed -n 's/.*: time \([^ ]*\).*/\1/p')
		cycle -n 1 "$(step "--axis $axis --speed $(calc "5.001 * $h / $dt") --start $start")" <"$a" | stab --mesh mesh --plain >moved
		counted "$(wc -l <moved)"
		awk -v axis="$axis" -v h="$h" 'function key() { return sprintf("%.3f %.3f", $1, dim > 1 ? $2 : 0) }
			function values(s) { for (c in name) s = s " " $at[name[c]]; return s }
			BEGIN { split("E_0 E_1 E_2 B_0 B_1 B_2 pml_x_0 pml_x_1 pml_x_2 pml_x_3", name) }
			FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; dim = at["y"] ? 2 : 1; next }
			NR == FNR { was[key()] = values(); if ($at[axis] > top) top = $at[axis]; next }
			$at[axis] > top + h / 2 { new++; bad += values() ~ /[1-9]/; next }
			{ old++; bad += was[key()] != values(); some += values() ~ /[1-9]/ }
			END { print FILENAME, old, new, some, bad + 0; exit bad || !old || !some || new < (dim > 1 ? 100 : 5) }' still moved
	done <<-'END'
		a1 x 0.04
		a2 x 0.1
		a3 y 0.2617993877991494
	END
}

@test "every new cell gets n particles an axis of the density there, evenly; what is behind leaves; the account adds up; ids are each there once" {
	density='(x>25)*(x-25)*(1+0.5*y)'
	pinit wakefield --dim 2 --cells 240x8 --waist 1 --a0 0 | species ions -n 0 --velocities 3 >a # cells of 0.1 and 0.5, along y from -2 on
	cycle -n 40 "$(step "electrons ions -n 3 --profile '$density' --charges=-1,1 --masses 1,3000 --speed 1.5")" <a >b
	stab --plain --set ions b | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
		{ x = $at["x"]; y = $at["y"]; w = (x - 25) * (1 + 0.5 * y) * 0.05 / 9
			bad += ($at["charge"] - w) ^ 2 > 1e-20 || ($at["mass"] - 3000 * w) ^ 2 > 1e-14 || seen[$at["id"]]++ || x <= 25
			u = (x * 30 - 0.5) - int(x * 30 - 0.5 + 0.5); bad += u * u > 1e-12; lines[sprintf("%.6f", x)]++ }
		END { for (l in lines) bad += lines[l] != 24; print NR - 1, bad; exit bad || NR < 1000 }'
	# the front is where whole cells have brought it: 24 + 0.1 floor(1.5 t/0.1)
	sls b >s
	read -r t front < <(awk '/^frame/ { sub(",", ""); for (i = 1; i < NF; i++) if ($i == "time") t = $(i + 1) }
		/^  box/ { gsub(/[][,]/, ""); print t, $3 }' s)
	within "$front" "$(calc "24 + 0.1 * int(15 * $t + 1e-6)")" 1e-9
	# it falls out behind: 24 of length are left of a plasma that has passed
	cycle -t 40 "$(step 'electrons -n 1 --thermal 0.01')" <a >c
	read -r charge particles < <(diag --columns charge,particles c | tail -1)
	within "$particles" 1920 5 # of the last cells behind some have gone by their own motion
	within "$charge" "$(calc "-0.05 * $particles")" 1e-9
	sls --report c |
		sed -n 's/.*window electrons.*"absorbed_charge":\([^,]*\).*"came":\([0-9]*\).*"given_charge":\([^,]*\).*"left":\([0-9]*\).*/\1 \2 \3 \4/p' >r
	read -r absorbed came given left <r
	within "$given" "$(calc "-0.05 * $came")" 1e-9
	within "$absorbed" "$(calc "-0.05 * $left")" 1e-9
	above "$left" 1000
	stab --plain --set electrons c | column id | sort | uniq -d >twice
	[ ! -s twice ]
	above "$(diag --columns speed_rms c | tail -1)" 0.012
}

@test "the same bytes for any threads, engines, parts of a run and ranks" {
	pinit wakefield --dim 2 --cells 160x8 --wavenumber 3 >a
	w="electrons --thermal 0.01 --profile '1+0.1*sin(y)'"
	for t in 1 3; do OMP_NUM_THREADS=$t cycle --no-history -n 50 "$(step "$w")" <a >t$t; done
	cycle --no-history -n 50 --engine pipes "$(step "$w")" <a >pipes
	cycle --no-history -n 21 "$(step "$w")" <a | cycle --no-history -n 29 "$(step "$w")" >parts
	cycle --no-history -n 50 --ranks 3 "$(step "$w")" <a >ranks
	same_as t1 t3 && same_as t1 pipes && same_as t1 parts && same_as t1 ranks
}

@test "window: refusals in one sentence" {
	pinit wakefield --cells 100 >a
	while IFS=';' read -r code command text; do
		run "-$code" --separate-stderr bash -c "$command"
		[[ $stderr == *"$text"* ]] || { echo "$command: $stderr"; return 1; }
		counted 1
	done <<-END
		1;pinit em-wave --cells 8 | cycle -n 1 '$(step electrons)';the box is periodic along x, and a window has an end (smod --faces open,
		1;pinit landau -n 20 | window;window: frame 1: the fields of the law 'electrostatic' are made anew of all particles
		1;window electrons <a;window: frame 1: a window moves within a step, behind the drift (push drift | window ... | m2p)
		1;cycle -n 9 '$(step "electrons --profile x-30")' <a;the density 'x-30' is -
		1;cycle -n 9 '$(step '--speed 1000')' <a;cells within a step, over all
		1;cycle -n 9 '$(step '--axis y')' <a;a window along y in 1-D (--axis)
		2;cycle -n 9 '$(step 'electrons ions --masses 1,2,3')' <a;--masses has 3 numbers for 2 sets (one for each, or one for all)
		1;cycle -n 9 '$(step ions)' <a;no set 'ions' (species ions -n 0 in front of the steps makes it)
		2;cycle -n 9 '$(step 'electrons electrons')' <a;'electrons' twice
		2;cycle -n 9 '$(step 'electrons -n 1.5')' <a;--per-cell 1.5 is not a whole number
		2;cycle -n 9 '$(step 'electrons --thermal=-1')' <a;--thermal -1 is negative
		1;cycle -n 9 'push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2 | window' <a;behind the drift
		2;pinit wakefield -n 5;the scene wakefield begins empty
		2;pinit wakefield --length 9;does not fit the box of length 9 (--length above 10 times --pulse)
	END
}
