# smooth: the binomial filter; what it leaves of every wave, sums, faces, staggered fields, refusals. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# largest FIELD: of its absolute values on the mesh of the stream.
largest() { stab --plain --mesh mesh | column "$1" | awk '{ if ($1 * $1 > m) m = $1 * $1 } END { printf "%.17g", sqrt(m) }'; }
# mesh CELLS EXPRESSION [stab options]: 'rho' on a mesh of an empty frame.
mesh() { printf 'x%s mass\n' "${3:+ $3}" | stab - --box 0,1 -n "$1" --faces "${4:-periodic}" --particle-faces "${5:-periodic}" | scalc --mesh mesh "rho = $2"; }

@test "every wave keeps cos^2n(k h/2) (1 + n sin^2(k h/2)) of itself, along one axis and two" {
	for n in 1 2 5; do
		for k in 0 1 3 8; do
			mesh 16 "sin(2*pi*$k*x + 0.7)" >a
			smooth -n $n --field rho <a | scalc --mesh mesh "off = rho - cos(pi*$k/16)^(2*$n)*(1 + $n*sin(pi*$k/16)^2)*sin(2*pi*$k*x + 0.7)" |
				largest off >got
			below "$(cat got)" 1e-14 "n = $n, k = $k"
			smooth -n $n --no-compensation --field rho <a | scalc --mesh mesh "off = rho - cos(pi*$k/16)^(2*$n)*sin(2*pi*$k*x + 0.7)" |
				largest off >got
			below "$(cat got)" 1e-14 "plain, n = $n, k = $k"
		done
	done
	mesh 8x12 'cos(2*pi*(x - 2*y))' y >a
	smooth --field rho <a |
		scalc --mesh mesh 'off = rho - cos(pi/8)^2*(1 + sin(pi/8)^2)*cos(pi/6)^2*(1 + sin(pi/6)^2)*cos(2*pi*(x - 2*y))' | largest off >got
	below "$(cat got)" 1e-14 "two axes"
}

@test "long waves lose in proportion to h^4, without compensation h^2" {
	for option in '' --no-compensation; do
		for cells in 16 32 64; do
			mesh $cells 'sin(2*pi*x)' | smooth $option --field rho | scalc --mesh mesh 'off = rho - sin(2*pi*x)' | largest off |
				awk -v n=$cells '{ print log(1 / n), log($1) }'
		done | awk '{ x += $1; y += $2; xx += $1 * $1; xy += $1 * $2 } END { print (3 * xy - x * y) / (3 * xx - x * x) }' >order
		within "$(cat order)" "$([ -n "$option" ] && echo 2 || echo 4)" 0.05 "order $option"
	done
}

@test "sums stay, to round-off, at every kind of face and for a current half a cell off the nodes" {
	for faces in 'periodic periodic' 'wall reflect' 'neumann reflect' 'open open'; do
		set -- $faces
		mesh 9x7 'exp(3*x - y) + sin(50*x*y)' y "$1" "$2" >a
		mass() { scalc --mesh mesh "w = rho*(${2:-1})" <"$1" | stab --plain --mesh mesh | column w | awk '{ s += $1 } END { printf "%.17g", s }'; }
		half='(x < 0.001 || x > 0.999 ? 0.5 : 1)*(y < 0.001 || y > 0.999 ? 0.5 : 1)'
		[ "$1" = periodic ] && half=1
		smooth -n 3 --field rho <a >b
		within "$(calc "$(mass b "$half") / $(mass a "$half")")" 1 1e-14 "$faces"
		[ "$(mass b 'x*y')" != "$(mass a 'x*y')" ]
	done
	pinit weibel -n 500 --cells 16 | p2m --current >a
	smooth <a >b
	for c in 0 1 2; do
		total() { scalc --mesh mesh "w = J_$c" <"$1" | stab --plain --mesh mesh | column w |
			awk '{ s += $1; m += $1 < 0 ? -$1 : $1 } END { printf "%.17g %.17g", s, m }'; }
		echo "$(total a) $(total b)" | awk '{ exit !(($1 - $3)^2 <= 1e-28 * $2^2 && ($2 == 0 || $4 < $2)) }'
	done
}

@test "Gauss's law of the smoothed charge holds through electromagnetic steps with the smoothed current" {
	pinit weibel -n 640 --cells 16 --v0 0.3 | p2m | smooth --field rho | maxwell --gauss | sel --drop rho >a
	cycle -q -n 20 'push boris/2 | p2m --current | smooth | maxwell | push drift | m2p | push boris/2' <a | p2m | smooth --field rho >b
	maxwell --gauss <b | sls --report | grep -o '"residual":[0-9.e+-]*' | cut -d: -f2 >residual
	below "$(cat residual)" 1e-13 # of the largest rho; without smooth in either place above 1e-2
	p2m <b | maxwell --gauss | sls --report | grep -o '"residual":[0-9.e+-]*' | cut -d: -f2 >other
	above "$(tail -1 other)" 1e-3
}

@test "the same bytes for any number of threads; what cannot be smoothed is refused; no current, no work" {
	mesh 40x40x40 'sin(20*x*y + z)' 'y z' >a
	for t in 1 2 3; do smooth -n 2 --field rho --threads $t --no-history <a | cksum; done | sort -u >sums
	[ "$(wc -l <sums)" = 1 ]
	refused() { run --separate-stderr bash -o pipefail -c "$2 | sls"; [[ $status = 1 && $stderr == *"$1"* ]] || { echo "$2: $status $stderr"; return 1; }; }
	refused "no field 'rho' on 'mesh' (p2m makes it from particles, or choose --field)" 'pinit plummer -n 10 | smooth'
	refused 'is half a cell off the nodes along an axis that is not periodic' 'pinit uniform -n 9 --dim 1 --dispersion 1 --cells 8 --faces wall \
		--particle-faces reflect | smod --law electromagnetic | scalc --extensive "charge = mass" | p2m --current | smooth'
	run -2 --separate-stderr smooth --field rho,rho a
	[[ $stderr == "smooth: --field names 'rho' twice, but it is smoothed once (--passes 2)" ]]
	pinit em-wave --cells 8 --no-history >e
	smooth --no-history <e | cmp e -
}
