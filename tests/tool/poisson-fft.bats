# poisson-fft: options and refusals. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# refused STATUS TEXT COMMAND LINE: exit status and a piece of the message.
refused() {
	run -"$1" --separate-stderr bash -c "$3 > out"
	[[ $stderr == *"$2"* ]] || { echo "message: $stderr" >&2; false; }
}

@test "poisson-fft: makes phi from rho, derived, with the kernel's name" {
	sh_ok "pinit uniform -n 100 | p2m -n 8 --kernel tsc | poisson-fft | sls"
	[[ $output == *"phi "*derived*"kernel tsc"* ]]
}

@test "poisson-fft: --source, --target and --coefficient work without a law's names" {
	sh_ok "pinit uniform -n 100 | p2m -n 8 --field weight | poisson-fft --source weight --target u --coefficient -2 | stab --plain --mesh mesh > a
		pinit uniform -n 100 | p2m -n 8 | poisson-fft --coefficient 1 | stab --plain --mesh mesh > b"
	worst=$(paste a b | awk 'NR > 1 { d = $5 + 2*$10; if (d < 0) d = -d; if (d > m) m = d } END { print m + 0 }')
	below "$worst" 1e-15
}

@test "poisson-fft: unsupported cases are refused, with an alternative" {
	pinit uniform -n 100 > bare
	printf 'x y z mass\n.5 .5 .5 1\n' > bodies
	p2m -n 8 < bare > rho
	refused 1 "no field 'rho' on 'mesh' (p2m makes it" "poisson-fft < bare"
	refused 1 "no mesh named fine" "poisson-fft --mesh fine < rho"
	refused 2 "choose another --target" "poisson-fft --target rho < rho"
	refused 1 "absorbing" "pinit uniform -n 0 --faces absorbing | p2m -n 8 | poisson-fft"
	pinit uniform -n 0 --faces open | p2m -n 8 > open
	refused 1 "choose gauss10, gauss2" "poisson-fft --green cell --screening 2 < open"
	refused 1 "choose plummer, or gauss2" "poisson-fft --green vico --softening 1 < open"
	refused 1 "smod --constant softening=LENGTH" "stab --law gravity --constant G=1 --box 0,1 bodies | p2m | poisson-fft --green plummer"
	refused 1 "leave out one of" "poisson-fft --green plummer --symbol fd4 < rho"
	refused 2 "poisson-fft --green plummer" "poisson-mg --green plummer < rho"
	refused 1 "leave out one of" "poisson-fft --green vico --symbol fd2 < open"
	refused 1 "choose --symbol fd2" "poisson-fft --green lattice --symbol spectral < open"
	refused 1 "there are none (leave it out)" "poisson-fft --green vico < rho"
	refused 2 "" "poisson-fft --green ewald < open"
	refused 2 "" "poisson-fft --screening -1 < rho"
	refused 2 "" "poisson-fft --symbol fd3 < rho"
}

@test "poisson-fft: a cut stream, garbage and an empty input exit 1" {
	pinit uniform -n 100 | p2m -n 8 > rho
	refused 1 "" "head -c 3000 rho | poisson-fft"
	refused 1 "" "echo garbage | poisson-fft"
	refused 1 "" "poisson-fft < /dev/null"
}

@test "poisson-fft: --influence and --cloud refuse unsupported cases, with an alternative" {
	pinit uniform -n 100 | p2m -n 8 > rho
	refused 1 "axis x is open (leave them out: --influence plain)" "pinit plummer -n 50 | p2m -n 16 --outside drop | poisson-fft --influence deconvolved"
	refused 1 "axis x is wall" "pinit uniform -n 50 --faces wall | p2m -n 16 | poisson-fft --cloud 0.2"
	refused 1 "for boxes in 3-D" "pinit uniform -n 50 --dim 2 | p2m -n 16 | poisson-fft --cloud 0.2"
	refused 2 "leave one of them out" "poisson-fft --influence optimal --symbol fd2 < rho"
	refused 1 "the field carries none" \
		"poisson-fft < rho | mgrad --operator lap --target l | stab | sed 's/\"kernel\":\"cic\",//g' | stab - | poisson-fft --influence optimal"
	refused 2 "sharp" "poisson-fft --influence sharp < rho"
}

@test "poisson-fft: the influence function follows the kernel of each frame, and does not depend on the threads" {
	pinit uniform -n 100 --no-history > a
	for k in cic tsc; do p2m -n 10x7x12 --kernel $k --no-history < a > $k; done
	p2m -n 10x7x12 --kernel cic --interlace --no-history < a > both
	options="--influence optimal --order 4 --cloud 0.4 --no-history"
	for k in cic tsc both; do poisson-fft $options < $k | stab --plain --mesh mesh > $k.t; done
	cat cic tsc both cic | poisson-fft $options --threads 3 | stab --plain --mesh mesh | grep . > all
	cat cic.t tsc.t both.t cic.t | diff - all
	run ! cmp -s cic.t both.t
	sh_ok "poisson-fft --influence plain --cloud 0 < tsc > p; poisson-fft < tsc > q; scmp --tolerance 0 p q"
}

@test "poisson-fft: spectral deconvolution of a wave in a box gives the wave of the particles back" {
	# One particle a node, masses 1 + 0.1 cos(2 pi 3 x): rho has the wave times W, phi of it divided by W^2 is read by m2p times W.
	awk 'BEGIN { print "x mass"; for (i = 0; i < 4096; i++) printf "%.17g %.17g\n", (i + .5) / 4096,
		(1 + .1 * cos(6.283185307179586 * 3 * (i + .5) / 4096)) / 4096 }' > t
	for k in ngp cic tsc pcs; do
		stab t --law gravity --box 0,1 --faces periodic -n 16 | p2m --kernel $k | poisson-fft --coefficient -1 --influence deconvolved |
			m2p --field phi | stab --plain |
			awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { x = $c["x"];
				s += $c["phi"] * cos(6.283185307179586 * 3 * x) / 2048 } END { printf "%.12g\n", s }' > got
		within "$(cat got)" "$(awk 'BEGIN { printf "%.15g",
			.1 / (6.283185307179586 * 3)^2 }')" 1e-9 "$k" # 4096 particles, 16 cells: 256 a cell, the sums are exact to 256^-2 of an alias at most
	done
}

# relative FILE REFERENCE: largest difference of phi over the largest phi.
relative() { scmp --norm relative_max --field phi "$1" "$2" | tail -1 | cut -f9; }

@test "Helmholtz: --wave-number has + a^2, with every symbol and face, and with given values (000:S23)" {
	for row in '2 wall sin(pi*x)*sin(2*pi*y) 5*pi^2' '3 periodic,periodic,neumann,neumann,wall,neumann cos(2*pi*x)*cos(pi*y)*sin(pi/2*z) 5.25*pi^2' \
		'3 periodic cos(2*pi*(x+y+z)) 12*pi^2'; do
		read -r dim faces u k2 <<<"$row"
		e=()
		for n in 8 12 16; do
			pinit uniform -n 2 --dim "$dim" --faces "$faces" | p2m -n $n | scalc --mesh mesh "rho=(2.385^2-$k2)*($u)" >m
			scalc --mesh mesh "phi=$u" <m >e
			poisson-fft --coefficient 1 --symbol spectral --wave-number 2.385 <m >p
			below "$(relative p e)" 1e-14 "$row"
			poisson-fft --coefficient 1 --symbol fd2 --wave-number 2.385 <m >p
			e+=("$(calc "1/$n")" "$(relative p e)")
		done
		order 2 "${e[@]}"
	done
	pinit uniform -n 2 --dim 1 --faces wall | p2m -n 16 | scalc --mesh mesh 'rho=0' >m
	scalc --mesh mesh 'phi=sin(9.1*(1-x))/sin(9.1)' <m >e
	poisson-fft --symbol spectral --wave-number 9.1 --x-low 1 <m >p
	below "$(relative p e)" 1e-13 # round-off over the distance to 3 pi, 0.07
	tail -c 300 p | grep -aq '"resonance_distance":0.07'
}

@test "Helmholtz at a resonance is refused with the distance, and open faces by name" {
	pinit uniform -n 9 --dim 2 --faces wall | p2m -n 16 >m
	run -3 --separate-stderr poisson-fft --symbol spectral --wave-number 4.442882938158366 <m # pi sqrt 2
	[[ $stderr == *"at a resonance of this box: the wave number 4.44288293815836"*"at a distance of "*"(at least 1e-08 is needed)"* ]]
	poisson-fft --symbol spectral --wave-number 4.4429 <m >p
	pinit uniform -n 9 --dim 2 --faces open --box=-1,2 | p2m -n 16 --outside drop >m
	run -1 --separate-stderr poisson-fft --wave-number 1 <m
	[[ $stderr == *"--wave-number is for standing waves in a box"* ]]
}

@test "open space by James' method: the infinite lattice's potential; what it does not solve is refused" {
	for row in "1 1e-14" "2 1e-10" "3 1e-7"; do # 2-D, 3-D: the far form of the lattice's function at 128 and 32 cells
		read -r dim tolerance <<<"$row"
		pinit uniform -n 99 --dim "$dim" --faces open | p2m -n 24 >m
		poisson-fft --symbol fd2 <m >f
		poisson-fft --free-space james <m >g
		below "$(relative g f)" "$tolerance" "$dim-D"
	done
	[ "$(OMP_NUM_THREADS=2 poisson-fft --free-space james <m | cksum)" = "$(PM_THREADS=1 poisson-fft --free-space james <m | cksum)" ]
	run -2 --separate-stderr poisson-fft --free-space james --symbol fd4 <m
	[[ $stderr == *"solves the differences of order 2 (leave out --symbol"* ]]
	pinit uniform -n 9 --dim 2 --faces open,open,wall,wall | p2m -n 9 >m
	run -1 --separate-stderr poisson-fft --free-space james <m
	[[ $stderr == *"open faces on all axes or on none, but axis y has wall ones (poisson-fft --free-space doubled mixes them)"* ]]
	pinit uniform -n 9 --dim 2 | p2m -n 9 >m
	run -1 --separate-stderr poisson-fft --free-space james <m
	[[ $stderr == *"is for open faces, and this box has none"* ]]
}
