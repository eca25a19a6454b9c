# phase: distributions on a mesh; sums, values, axes, refusals. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# total AXES: integral of f over a mesh of as many axes from stab's table: end nodes of axes that are not periodic count half.
total() { stab --plain --mesh phase | awk -F'\t' -v c="$1" -v ends="$2" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
	{ w = 1; n = split(ends, e, " "); for (k = 1; k + 2 <= n; k += 3) if ($at[e[k]] == e[k + 1] || $at[e[k]] == e[k + 2]) w /= 2; s += w * $at["f"] }
	END { printf "%.15g", s * c }'; }

@test "phase: f integrates to the sum of the weights, by every kernel, in one, two and three axes" {
	pinit plasma --dim 2 --length 4 | species e -n 3000 --velocities 2 --widths 1,2 --mass 3 --profile '1 + x*y' >a
	mass=$(diag --columns mass <a | column mass)
	for kernel in ngp cic tsc pcs m4prime; do
		within "$(phase x vx --kernel $kernel --box=0,-8,4,8 -n 8x32 <a | total 0.25 'y -8 8')" "$mass" 1e-10 "$kernel"
		within "$(phase vy --kernel $kernel --box=-16,16 -n 64 --weight charge <a | total 0.5 'x -16 16')" "$(calc "-$mass / 3")" 1e-10 "$kernel"
		within "$(phase x y vx --kernel $kernel --box=0,0,-8,4,4,8 -n 4x8x16 <a | total 0.5 'z -8 8')" "$mass" 1e-10 "$kernel, three axes"
	done
	# ends that cut the distribution: all that is inside counts, the rest is reported
	phase vx --box=-1,1 -n 10 --weight 1 <a >b
	out=$(sls --report <b | grep -oE 'outside[^0-9]*[0-9]+' | grep -oE '[0-9]+')
	within "$(total 0.2 'x -1 1' <b)" "$(calc "3000 - $out")" 1e-9
	between "$out" 900 1000 # 31.7 % of a Maxwellian
}

@test "phase: f(v) of a Maxwellian, f(x, v) of a wave, and expressions as axes" {
	pinit plasma | species e -n 100000 --profile '1 + 0.5*cos(x/2)' >a
	phase vx --box=-5,5 -n 50 <a | stab --plain --mesh phase | awk 'NR > 1 {
		d = $2 - 12.566370614 / sqrt(2 * 3.14159265) * exp(-$1 * $1 / 2); d = d < 0 ? -d : d
		if (d > most) most = d } END { print most }' >most
	below "$(cat most)" 0.05 "f(v), of 5.01" # cic widens by h^2/6 = 0.7 % of vth^2, at the top 0.3 %
	# at x = 2 pi the density is half of the mean
	phase x vx --box=0,-5,12.566370614359172,5 -n 32x50 <a | stab --plain --mesh phase >t
	awk -F'\t' '$1 > 6.28 && $1 < 6.29 { s += $3 * 0.2 } END { print s }' t >s
	within "$(cat s)" 0.5 0.02
	phase 'x - 1' 'abs(vx)' -n 8 <a | sls | grep -q 'box \[-2, 13\] neumann x \[-0.1, 4'
	phase x vx <a | sls | grep -q 'box \[0, 12.56637061\] periodic x'
}

@test "phase: one set or all, no particles, threads, films, refusals" {
	pinit plasma | species e -n 1000 | species i -n 500 --mass 2 --vth 0.1 >a
	within "$(phase x --set i -n 4 <a | total 3.141592653589793 '')" "$(calc '2 * 4 * pi')" 1e-9
	within "$(phase x -n 4 <a | total 3.141592653589793 '')" "$(calc '3 * 4 * pi')" 1e-9
	species none -n 0 <a | phase x vx --set none -n 4 | sls | grep -q ' f '
	for t in 1 3; do phase x vx --threads $t --no-history <a >$t; done
	same_as 1 3
	pinit two-stream -n 200 | cycle -n 3 --every 1 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' |
		phase x vx -n 8 | sls | grep -q '4 frames'
	run -1 --separate-stderr bash -c 'phase x vq <a'
	[[ $stderr == *"no field or number 'vq'"* ]]
	run -1 --separate-stderr bash -c 'pinit plasma | phase x'
	[[ $stderr == *"no set has particles (species and pinit make them)"* ]]
	run -2 --separate-stderr bash -c 'phase x vx --box 0,1 <a'
	[[ $stderr == *"2 axes need 4: all low ends, then all high ones"* ]]
	run -3 --separate-stderr bash -c "phase x 'log(vx)' <a"
	[[ $stderr == *"'log(vx)' is not finite"* ]]
}
