# stretch: (omega . grad) u on the mesh in its forms and orders, beside walls, carried to the particles. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# The Taylor-Green flow, whose (omega . grad) u is (-sin 2y sin 2z, sin 2x sin 2z, 0)/4; u as it is, not from omega. CELLS [pinit options]
flow() {
	local n=$1
	shift
	pinit taylor-green-3d --cells "$n" "$@" | p2m --kernel m6prime | scalc --mesh mesh 'u = sin(x)*cos(y)*cos(z), -cos(x)*sin(y)*cos(z), 0' |
		scalc --mesh mesh 'want = -sin(2*y)*sin(2*z)/4, sin(2*x)*sin(2*z)/4, 0'
}
# The largest difference of two fields of the mesh.
apart() { scalc --mesh mesh "d = max(max(abs($1.x - $2.x), abs($1.y - $2.y)), abs($1.z - $2.z))" | stab --plain --mesh mesh | column d | sort -g | tail -1; }

@test "every form gives (omega . grad) u, with its order, spectrally to round-off" {
	for n in 16 24 36; do flow $n >$n.pm; done
	for form in conservative classical transpose mixed; do
		for order in 2 4 6; do
			points=()
			for n in 16 24 36; do
				points+=("$(awk "BEGIN { print 1 / $n }")" "$(stretch --form $form --order $order <$n.pm | apart domega want)")
			done
			order $order "${points[@]}"
		done
		below "$(stretch --form $form --order spectral <16.pm | apart domega want)" 2e-14 # transforms of 16 values of 1, times wave numbers to 8
	done
	# omega along z, where u has no component: the transpose is 0, (omega . grad) u is not
	scalc --mesh mesh 'omega = 0, 0, 1' <16.pm | scalc --mesh mesh 'want = 0, 0, 0' >up
	below "$(stretch --form transpose <up | apart domega want)" 0
	above "$(stretch --form classical <up | apart domega want)" 0.9
	sh_ok 'stretch <16.pm | sls'
	[[ $output =~ "domega      3 f64 change value of alpha terms stretching kernel m6prime" ]]
}

@test "a box between walls has the stretching, the flow and the motion of the periodic box that it is an eighth of" {
	pinit taylor-green-3d --cells 16 | p2m --kernel m6prime >whole
	h=0.19634954084936207 # pi/16
	awk -v h=$h 'BEGIN { print "x y z alpha_0 alpha_1 alpha_2 volume"
		for (k = 1; k < 5; k++) print h * (k + 0.3), h * 0.4, h * (15.7 - k), 0, 0, 0, 1 }' >some
	stab some --law vortex --box 0,3.141592653589793 --faces wall -n 8 --dt 0.1 | p2m --kernel m6prime --outside drop |
		scalc --mesh mesh 'omega = -cos(x)*sin(y)*sin(z), -sin(x)*cos(y)*sin(z), 2*sin(x)*sin(y)*cos(z)' >eighth
	for order in 2 6 spectral; do
		for form in conservative classical transpose; do
			words="poisson-fft | mgrad --order $order | stretch --form $form --order $order"
			for part in whole eighth; do
				bash -c "$words" <$part | stab --plain --mesh mesh | awk 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
					$at["x"] < 3.2 && $at["y"] < 3.2 && $at["z"] < 3.2 {
						for (c = 0; c < 3; c++) print $at["u_" c], $at["domega_" c] }' >$part.txt
			done
			[ "$(wc -l <whole.txt)" = $((3 * 729)) ]
			# round-off of |u| = 1 in differences
			paste whole.txt eighth.txt | awk '{ a = $1 - $3; b = $2 - $4; if (a * a + b * b > 1e-26) bad = 1 } END { exit bad }'
		done
	done
	# m2p gives a particle beside the wall the velocity, and the change of alpha, that it has in the whole box
	words='poisson-fft | mgrad | stretch | m2p --kernel m6prime'
	stab some --law vortex --box 0,6.283185307179586 --faces periodic -n 16 --dt 0.1 | p2m --kernel m6prime |
		scalc --mesh mesh 'omega = -cos(x)*sin(y)*sin(z), -sin(x)*cos(y)*sin(z), 2*sin(x)*sin(y)*cos(z)' | bash -c "$words" | stab --plain >a
	bash -c "$words" <eighth | stab --plain >b
	paste <(column vel_0 <a) <(column vel_2 <a) <(column vel_0 <b) <(column vel_2 <b) |
		awk '{ a = $1 - $3; b = $2 - $4; if (a * a + b * b > 1e-26 || $1 * $1 < 1e-3) bad = 1 } END { exit bad || NR < 4 }'
}

@test "stretch adds to what is there, refuses its term twice, and --replace replaces it" {
	flow 12 --nu 0.1 >a
	stretch <a | diffuse >both
	diffuse <a | stretch >other
	for c in 0 1 2; do
		paste <(stretch <a | stab --plain --mesh mesh | column domega_$c) <(diffuse <a | stab --plain --mesh mesh | column domega_$c) \
			<(stab --plain --mesh mesh <both | column domega_$c) <(stab --plain --mesh mesh <other | column domega_$c) |
			awk '{ a = $1 + $2 - $3; b = $4 - $3; if (a * a + b * b > 1e-28) bad = 1 } END { exit bad }' # round-off of values of 1
	done
	run -1 bash -o pipefail -c 'stretch <both | sls'
	[[ $output =~ "already holds the term 'stretching'" ]]
	same_as <(stretch <a | stretch --form classical --replace | stab --plain --mesh mesh) <(stretch --form classical <a | stab --plain --mesh mesh)
}

@test "in the plane there is nothing to stretch; other laws and missing fields are refused with the words that help" {
	pinit lamb-oseen --cells 16 | p2m | poisson-fft | mgrad --no-history >a
	stretch --no-history <a | cmp a -
	run -0 bash -o pipefail -c 'stretch --verbose <a 2>&1 >/dev/null'
	[[ $output =~ "nothing to do, the frame is passed on unchanged" ]]
	run -1 bash -o pipefail -c 'pinit plummer -n 10 --cells 16 | p2m | stretch | sls'
	[[ $output =~ "the law 'gravity' has no vorticity to stretch" ]]
	run -1 bash -o pipefail -c 'pinit taylor-green-3d --cells 8 | p2m | stretch | sls'
	[[ $output =~ "run p2m | poisson-fft | mgrad first" ]]
	run -2 stretch --form skew
}

@test "a step in space has the same bytes for 1, 2 and 7 threads, in every form" {
	pinit taylor-green-3d --cells 15 >a
	for form in conservative classical transpose mixed; do
		for t in 1 2 7; do
			cycle --threads $t -n 1 "p2m | poisson-fft | mgrad | stretch --form $form | diffuse | m2p | push lsrk3 | remesh" <a >$t.pm
		done
		same_as 1.pm 2.pm && same_as 1.pm 7.pm
	done
}

@test "plan puts stretch in, and cycle names it where a sentence forgets it" {
	pinit taylor-green-3d --cells 12 --nu 0 >a
	plan --no-cost -t 1 <a >text
	grep -qE '^stretch +\|  # stretching: on, \|grad u\| T = ' text
	[ "$(plan --sentence -t 1 <a | sed 's/ --dt [^ ]*//')" = \
		'p2m | poisson-fft | mgrad | stretch | m2p | push lsrk3 | remesh' ]
	[[ $(pinit vortex-ring --cells 32x32x16 | plan --sentence -t 1) == *' | stretch | '*' --outside grow' ]]
	run --separate-stderr cycle -n 1 'p2m | poisson-fft | mgrad | m2p | push lsrk3' <a
	[[ $stderr == "cycle: the frame has vorticity in space, but no word of the sentence acts by it (stretch, pp): "* ]]
}
