# reproject: the divergence of the vorticity, removed from the strengths. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# The flow of Taylor and Green plus a gradient: of -cos x, and of a wave across the axes.
mixed() {
	pinit taylor-green-3d --cells "${1:-12}" | scalc 'alpha = volume*(-cos(x)*sin(y)*sin(z) + sin(x) + cos(x + 2*y)),
		volume*(-sin(x)*cos(y)*sin(z) + 2*cos(x + 2*y)), 2*volume*sin(x)*sin(y)*cos(z)'
}
# The largest difference of alpha/volume and the Taylor-Green vorticity.
error() {
	scalc 'e = hypot(hypot(alpha_0/volume + cos(x)*sin(y)*sin(z), alpha_1/volume + sin(x)*cos(y)*sin(z)), alpha_2/volume - 2*sin(x)*sin(y)*cos(z))' |
		stab --plain | column e | sort -g | tail -1
}

@test "a gradient is removed and a vorticity without divergence stays, to round-off; the total stays" {
	for kernel in m4prime m6prime; do
		mixed | reproject --kernel $kernel >a
		below "$(error <a)" 2e-14 # of values of 3, through transforms
		below "$(p2m --kernel $kernel <a | mgrad --operator div --order spectral --source omega --target d | stab --plain --mesh mesh | column d |
			awk '{ x = $1 < 0 ? -$1 : $1; if (x > m) m = x } END { print m }')" 1e-13
		for c in x y z; do below "$(diag --columns alpha_$c <a | tail -1)" 1e-12; done # round-off of a sum of absolute values of 600
	done
	pinit taylor-green-3d --cells 12 | reproject >a
	below "$(error <a)" 1e-14
	sh_ok 'sls --report <a'
	[[ $output =~ '"reprojections":1' ]]
}

@test "with differences it converges with their order" {
	for order in 2 4 6; do
		points=()
		for n in 20 28 40; do points+=("$(awk "BEGIN { print 1 / $n }")" "$(mixed $n | reproject --order $order | error)"); done
		order $order "${points[@]}"
	done
}

@test "passes with differences leave less and less divergence, as the chain of words does" {
	mixed 16 >a
	divergence() { p2m | diag --columns divergence | tail -1; }
	for order in 2 6; do
		reproject --order $order --passes 3 <a >three
		reproject --order $order <a | reproject --order $order | reproject --order $order >chain
		sh_ok "scmp --field alpha --tolerance 1e-13 chain three"
	done
	# the wave (1, 2, 0) at 16 cells: 1 - k'^2/k^2 of order 6 is 1e-3
	one=$(reproject --order 6 <a | divergence)
	below "$(reproject --order 6 --passes 2 <a | divergence)" "$(calc "0.01 * $one")"
	below "$(reproject --order 6 --passes 8 <a | divergence)" 1e-14
	same_as <(reproject --order 6 --passes 1 <a | stab --plain) <(reproject --order 6 <a | stab --plain)
	for t in 1 2 7; do reproject --order 6 --passes 3 --threads $t <a >$t.pm; done
	same_as 1.pm 2.pm && same_as 1.pm 7.pm
}

@test "it acts between steps, at multiples of --every, above --above; in the plane and under other laws there is nothing to do" {
	mixed >a
	run -0 bash -o pipefail -c 'reproject --above 10 <a | sls --report'
	[[ $output =~ '"divergence":' && ! $output =~ reprojections ]]
	same_as <(reproject --above 10 <a | stab --plain) <(stab --plain <a)
	below "$(reproject --above 0.1 <a | error)" 2e-14
	smod --step 3 <a | reproject --every 2 --no-history | cmp - <(smod --step 3 <a)
	pinit lamb-oseen --cells 16 | reproject --no-history | cmp - <(pinit lamb-oseen --cells 16)
	run -1 bash -o pipefail -c 'pinit plummer -n 10 | reproject | sls'
	[[ $output =~ "has no vorticity in space" ]]
	for t in 1 2 7; do reproject --threads $t <a >$t.pm; done
	same_as 1.pm 2.pm && same_as 1.pm 7.pm
}

@test "in a run, and beside open faces, the divergence is less with it than without" {
	step='p2m --kernel m6prime | poisson-fft | mgrad | stretch | m2p | push lsrk3 | remesh --kernel m6prime'
	pinit vortex-ring --cells 32x32x16 >a
	without=$(cycle -n 4 "$step" <a 2>/dev/null | p2m --kernel m6prime | diag --columns divergence | tail -1)
	with=$(cycle -n 4 "$step | reproject --kernel m6prime" <a 2>/dev/null | p2m --kernel m6prime | diag --columns divergence | tail -1)
	below "$with" "$(awk "BEGIN { print 0.8 * $without }")"
}
