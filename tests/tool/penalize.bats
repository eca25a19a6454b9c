# penalize: a body at rest or moving in a flow: the flow inside, its force twice, the early drag of a cylinder, a sphere, refusals.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# fluid CELLS DT NU: fluid at rest in the open square of side 2, particles on the nodes within 0.6 of the centre.
fluid() {
	awk -v n="$1" 'BEGIN { print "x y circulation volume"; h = 2 / n; for (i = 1; i < n; i++) for (j = 1; j < n; j++) { x = -1 + i * h; y = -1 + j * h
		if (x * x + y * y < 0.36) printf "%.17g %.17g 0 %.17g\n", x, y, h * h } }' |
		stab - --law vortex --strength circulation,volume --constant nu="$3" --box=-1,1 -n "$1" --faces open --dt "$2"
}
flow='p2m --kernel m6prime --outside grow | poisson-fft | mgrad'
remeshed='remesh --kernel m6prime --outside grow'
# force COMPONENT: one line a frame that has it.
force() { sls --report | sed -n 's/.*penalize.*"force_'"$1"'":\([^,}]*\).*/\1/p'; }

@test "the drag of a cylinder set into motion is 4 sqrt(pi/(Re T)) within 7 %, by the force and by the impulse; nothing lifts it" {
	# Re = 550, D = U = 1, at T = 0.05: measured +5.4 and +5.0 % on 256^2, +5.1 and +4.9 on 512^2; the formula is the first term of a series
	fluid 256 0.0005 0.00181818182 | cycle -q -n 100 --every 4 "$flow | penalize --edge 0.5 --body 'hypot(x, y) - 0.5' --stream '1, 0' | diffuse |
		m2p | field 'vel = 1, 0' | push lsrk3 | $remeshed" >a
	want=$(calc "4 * sqrt(pi * 0.00181818182 / 0.05)")
	within "$(calc "2 * ($(force x <a | tail -1))")" "$want" "$(calc "0.07 * $want")" "drag"
	diag --columns time,impulse_x,impulse_y,circulation <a >d
	drag=$(awk -F'\t' 'NR > 1 { b = a; s = t; t = $1; a = $2 } END { print -2 * (a - b) / (t - s) }' d)
	within "$drag" "$want" "$(calc "0.08 * $want")" "drag by the impulse" # of the middle of the last two frames, where it is 1 % more
	below "$(column impulse_y <d | tail -1)" 1e-9
	below "$(column circulation <d | tail -1)" 1e-9
}

@test "the force is the rate of the impulse to round-off, and the flow in the body becomes that of the body" {
	body="penalize --body 'hypot(x, y) - 0.4' --velocity '0.7, -0.2'"
	fluid 64 0.01 0 | cycle -q -n 1 "p2m --kernel m4prime | poisson-fft | mgrad | $body | m2p | push euler" >a
	diag --columns impulse_x,impulse_y,circulation <a >d
	for c in x y; do # I = sum x x Gamma has the momentum: dI/dt = -force
		within "$(calc "-0.01 * ($(force $c <a))")" "$(column impulse_$c <d)" 1e-10
	done
	below "$(column circulation <d)" 1e-12
	# the disc moves the fluid around it, so several steps are needed: 20 leave 2 % of the slip at its centre
	fluid 64 0.01 0 | cycle -q -n 20 "p2m --kernel m4prime | poisson-fft | mgrad | $body | m2p | push euler | remesh --kernel m4prime" |
		p2m --kernel m4prime | poisson-fft | mgrad | stab --plain --mesh mesh | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
			$at["x"]^2 + $at["y"]^2 < 0.01 { print $at["u_0"], $at["u_1"] }' >u
	[ "$(wc -l <u)" -gt 20 ]
	within "$(awk '{ s += $1 } END { print s / NR }' u)" 0.7 0.02
	within "$(awk '{ s += $2 } END { print s / NR }' u)" -0.2 0.01
}

@test "a cylinder drawn through fluid at rest has the drag of one at rest in a stream, within 1 % in the mean and 2 % rms" {
	fluid 128 0.001 0.00181818182 >a
	cycle -i a -q -n 80 --every 1 "$flow | penalize --body 'hypot(x, y) - 0.5' --stream '1, 0' | diffuse | m2p | field 'vel = 1, 0' |
		push lsrk3 | $remeshed" | force x >rest
	cycle -i a -q -n 80 --every 1 "$flow | penalize --body 'hypot(x + time, y) - 0.5' --velocity '-1, 0' | diffuse | m2p | push lsrk3 | $remeshed" |
		force x >moved
	read -r mean rms < <(paste rest moved | awk 'NR > 40 { a += $1; b += $2; d += ($2 - $1)^2; n++ } END { print b / a, sqrt(d / n) / (a / n) }')
	within "$mean" 1 0.01 # measured 1.0030
	below "$rms" 0.02     # measured 0.0098; 4 % with half of the edge
}

@test "a street of vortices leaves a cylinder at Re = 100 with the Strouhal number 0.164, within 2 per cent" {
	[ -n "${PM_LONG:-}" ] || skip "long: make check-long"
	# a quarter of the cells and of the step of the scene; measured 0.1631, and 0.1638 with 16 cells of the diameter
	pinit cylinder --nu 0.01 --cells 48x36 --dt 0.02 |
		cycle -q -t 80 --every 5 "p2m | poisson-fft | mgrad | penalize --edge 0.5 --body 'hypot(x, y) - 0.5' --velocity '0, 0.3*(time < 3)' \
			--stream '1, 0' | diffuse | m2p | field 'vel = 1, 0' | push lsrk3 | remesh --cut-off 1e-4 --rim 1" | force y >lift
	# from upward zero to upward zero, frames 0.1 apart, behind t = 40
	awk '{ t += 0.1; if (t > 40 && was < 0 && $1 >= 0) { z = t - 0.1 * $1 / ($1 - was); if (!n++) first = z } was = $1 }
		END { print (n - 1) / (z - first) }' lift >f
	within "$(<f)" 0.164 0.0033 "Strouhal number"
}

@test "the drag of a sphere at Re = 100 after eight diameters, with 8 and 12 cells of the diameter" {
	[ -n "${PM_LONG:-}" ] || skip "long: make check-long"
	for n in 8 12; do
		pinit sphere --cells $((4 * n))x$((3 * n))x$((3 * n)) |
			cycle -q -t 8 --every 10 "p2m | poisson-fft | mgrad | stretch | penalize --edge 0.5 --body 'sqrt(x*x + y*y + z*z) - 0.5' \
				--stream '1, 0, 0' | diffuse | m2p | field 'vel = 1, 0, 0' | push lsrk3 | remesh --cut-off 1e-3 --rim 1" | force x | tail -n 1
	done >drag
	# published 1.08 to 1.10; measured 1.228 and 1.146: too large by the edge, which falls with the cell
	between "$(awk 'NR == 1 { print $1 * 8 / (4 * atan2(1, 1)) }' drag)" 1.16 1.24
	between "$(awk 'END { print $1 * 8 / (4 * atan2(1, 1)) }' drag)" 1.08 1.16
}

# cavity CELLS TIME NU: the driven cavity at this time, then the rms of its u on x = 1/2 less that of the table ghia.
cavity() {
	pinit cavity --cells "$1" --nu "$3" | cycle -q -t "$2" "p2m | poisson-fft | mgrad | penalize --body 'min(min(x, 1 - x), min(y, 1 - y))' \
		--velocity 'y > 0.99 ? 1 : 0, 0' --stream '0.1, 0' | diffuse | m2p | field 'vel = 0.1, 0' | push lsrk3 | remesh" | smod --time 0 >flow || return
	stab ghia --set probe --law vortex --constant nu="$3" --box=-0.125,1.125 --faces periodic >probe
	stack flow probe | p2m | poisson-fft | mgrad | m2p --set probe --field u | stab --plain --set probe |
		awk 'NR > 1 { s += ($4 + 0.1 - $3) ^ 2; if ($4 < low) low = $4 } END { print sqrt(s / (NR - 1)), low + 0.1 }'
}
# ghia U...: table I of Ghia, Ghia and Shin 1982, whose nodes are these, without the walls.
ghia() {
	local y u=("$@") i=0
	echo 'x y ghia'
	for y in 0.9766 0.9688 0.9609 0.9531 0.8516 0.7344 0.6172 0.5 0.4531 0.2813 0.1719 0.1016 0.0703 0.0625 0.0547; do echo "0.5 $y ${u[i++]}"; done
}
re100=(0.84123 0.78871 0.73722 0.68717 0.23151 0.00332 -0.13641 -0.20581 -0.21090 -0.15662 -0.10150 -0.06434 -0.04775 -0.04192 -0.03717)
re400=(0.75837 0.68439 0.61756 0.55892 0.29093 0.16256 0.02135 -0.11477 -0.17119 -0.32726 -0.24299 -0.14612 -0.10338 -0.09266 -0.08186)

@test "the driven cavity at Re = 100 has the velocities of Ghia, Ghia and Shin 1982, within 1.8 % of the lid's with 32 cells of the side" {
	ghia "${re100[@]}" >ghia
	read -r rms low < <(cavity 40 8 0.01) # measured 0.0157 and -0.176, of order 1 in the cell
	below "$rms" 0.018 "rms error"
	within "$low" -0.20581 0.04 "the lowest of the table's nodes near the middle"
	[ -n "$(cavity 80 0.003 0.01)" ] # a step that leaves room for diffusion and for the walls
}

@test "the driven cavity: an error of order 1 in the cell at Re = 100, and Re = 400" {
	[ -n "${PM_LONG:-}" ] || skip "long: make check-long"
	ghia "${re100[@]}" >ghia
	read -r coarse _ < <(cavity 40 12 0.01)
	read -r fine _ < <(cavity 80 12 0.01)
	within "$(calc "$coarse / $fine")" 2 0.3 "errors with 32 and 64 cells of the side" # measured 0.0157 and 0.0076
	ghia "${re400[@]}" >ghia
	read -r rms _ < <(cavity 80 40 0.0025)
	below "$rms" 0.027 "rms error at Re = 400, 64 cells" # measured 0.0243
}

@test "a sphere in space is pushed along the stream alone, a rate slows it down, and bytes do not depend on threads" {
	pinit taylor-green-3d --cells 16 --speed 0 --dt 0.02 >a
	words="p2m | poisson-fft | mgrad | penalize --body 'hypot(hypot(x - pi, y - pi), z - pi) - 1' --stream '0, 0, 1.5'"
	cycle -n 1 "$words | m2p | push euler" <a >b
	above "$(force z <b)" 50 # 4/3 pi 1.5/0.02 = 314 if the whole sphere stopped the fluid in it at once
	below "$(force x <b)" 1e-10
	cycle -n 1 "$words --rate 1 | m2p | push euler" <a >c
	between "$(calc "$(force z <c) / $(force z <b)")" 0.019 0.0205 # chi/(1 + dt chi) over chi/dt: 1/51 where chi is 1
	for t in 1 3; do
		p2m <a | poisson-fft | mgrad | OMP_NUM_THREADS=$t penalize --body 'z - pi' --stream '1, 0, 0' >"t$t"
	done
	same_as t1 t3
}

@test "what is missing or wrong is said in a line" {
	while IFS=';' read -r status command message; do
		run -"$status" bash -o pipefail -c "$command >/dev/null"
		[[ $output == *"$message"* ]] || { echo "wanted '$message', got: $output"; return 1; }
		counted 1
	done <<-'END'
		2;pinit taylor-green-2d --cells 8 | p2m | poisson-fft | mgrad | penalize;--body EXPRESSION is missing (--body 'hypot(x, y) - 0.5')
		1;pinit taylor-green-2d --cells 8 | p2m | poisson-fft | penalize --body x;no field 'u' on mesh 'mesh' (run p2m | poisson-fft | mgrad first)
		1;pinit plummer -n 9 --cells 4 | penalize --body x;the law 'gravity' has no vorticity that a body could change (the law vortex has)
		2;pinit taylor-green-2d --cells 8 | p2m | poisson-fft | mgrad | penalize --body x --velocity 1;--velocity '1' has 1 components, and space has 2
		1;pinit taylor-green-2d --cells 8 | smod --dt 0 | p2m | poisson-fft | mgrad | penalize --body x;the flow in the body ends within one (smod --dt)
		1;pinit taylor-green-2d --cells 8 | p2m | poisson-fft | mgrad | penalize --body x | penalize --body y;already holds the term 'penalization'
	END
}
