# mgrad: options and refusals. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

refused() {
	run -"$1" --separate-stderr bash -c "$3 > out"
	[[ $stderr == *"$2"* ]] || { echo "message: $stderr" >&2; false; }
}

@test "mgrad: bare it makes g from phi, dim components, with the kernel's name" {
	for dim in 1 2 3; do
		sh_ok "pinit uniform --dim $dim -n 100 | p2m -n 8 --kernel tsc | poisson-fft | mgrad | sls"
		[[ $output =~ g\ +$dim\ f64\ derived.*kernel\ tsc ]]
	done
}

@test "mgrad: lap of order 2 undoes poisson-fft --symbol fd2" {
	sh_ok "pinit uniform -n 100 | p2m -n 8x9x7 | poisson-fft --symbol fd2 --coefficient 1 |
		mgrad --operator lap --order 2 --target back | stab --plain --mesh mesh > a"
	worst=$(awk 'NR > 1 { d = $4 - 1 - $6; if (d < 0) d = -d; if (d > m) m = d } END { print m + 0 }' a) # the mean density is 1
	below "$worst" 1e-11
}

@test "mgrad: spectral lap undoes poisson-fft at walls and neumann faces" {
	sh_ok "pinit uniform -n 100 --faces wall,wall,neumann,neumann,periodic,periodic | p2m -n 8x9x7 | poisson-fft --symbol spectral --coefficient 1 |
		mgrad --operator lap --order spectral --target back | stab --plain --mesh mesh > a"
	worst=$(awk 'NR > 1 { d = $4 - $6; if (d < 0) d = -d; if (d > m) m = d } END { print m + 0 }' a)
	below "$worst" 1e-10
}

@test "mgrad: div of grad and curl of grad" {
	sh_ok "pinit uniform -n 100 | p2m -n 8x9x7 | poisson-fft | mgrad --operator grad --source phi --target a | mgrad --operator curl --source a --target c |
		mgrad --operator div --source a --target d --order spectral | stab --plain --mesh mesh > a"
	head -1 a | grep -q "c_0.*c_1.*c_2"
	worst=$(awk 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^c_/) c[$i] = i; next } { for (k in c) { d = $(c[k]); if (d < 0) d = -d;
		if (d > m) m = d } } END { print m + 0 }' a)
	below "$worst" 1e-11 # second derivatives of size 1e2
}

@test "mgrad: unsupported cases are refused, with an alternative" {
	pinit uniform -n 100 | p2m -n 8 > rho
	pinit plummer -n 50 | p2m -n 16 --outside drop | poisson-fft > free
	refused 1 "no field 'phi' on 'mesh' (poisson-fft, poisson-mg or poisson-relax makes" "mgrad < rho"
	refused 1 "choose --order 2, 4 or 6" "mgrad --order spectral < free"
	refused 2 "needs a --target" "mgrad --operator lap < free"
	refused 1 "grad takes 1" "mgrad < free | mgrad --operator grad --source g --target gg"
	refused 2 "" "mgrad --order 3 < free"
}

@test "mgrad: a given field is not replaced; on a separate mesh it is kept, and m2p adds both" {
	pinit langmuir -n 64 --cells 16 > a
	scalc --mesh mesh 'E = 0.5' --role state < a > b
	remedy='choose another --target; keep the given field on a separate mesh, m2p --mesh adds it'
	refused 1 "'E' on 'mesh' is given, and a derivative must not replace it ($remedy)" \
		"p2m < b | poisson-fft | mgrad"
	p2m < b | poisson-fft | mgrad --target mine | sls > list
	grep -q ' mine  *1 f64 derived' list
	grep -q ' E  *1 f64 state' list
}

@test "mgrad: threads 1, 2, 3 give equal bytes" {
	pinit plummer -n 500 | p2m -n 17 --outside drop | poisson-fft > free
	pinit uniform -n 500 --faces wall | p2m -n 9x14x10 | poisson-fft > walls
	for n in 1 2 3; do
		mgrad --threads $n < free > free.$n
		mgrad --threads $n --order spectral < walls > walls.$n
		same_as free.1 free.$n
		same_as walls.1 walls.$n
	done
}

@test "mgrad: a body beside an open face is told of the force on itself, which order 4 and 6 have and order 2 has not" {
	for row in 1.05:4:yes 1.05:2:no 2.05:4:no 2.05:6:yes 3.05:6:no; do
		IFS=: read -r x order told <<<"$row"
		sh_ok "printf 'x y z vx vy vz mass\n$x 8.2 7.7 0 0 0 1\n' | stab - --law gravity --box 0,16 --cells 16 --faces open --particle-faces open > a
			p2m --kernel cic < a | poisson-fft | mgrad --order $order 2> said | m2p | stab --plain > b; cat said"
		self=$(awk 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "acc_0") c = i; next } { print $c < 0 ? -$c : $c }' b)
		if [ $told = yes ]; then
			[[ $output == "mgrad: "*" of the density is within $((order / 2)) nodes of an open face, where differences of order $order "* ]]
			awk "BEGIN { exit !($self > 0.1) }"
		else
			[ -z "$output" ]
			below "$self" 1e-14
		fi
	done
	# however light the body is
	printf '%s\n' 'x y z vx vy vz mass' '1.05 8.2 7.7 0 0 0 1' '8.3 8.2 7.7 0 0 0 2e9' >two
	run --separate-stderr bash -o pipefail -c "stab - --law gravity --box 0,16 --cells 16 --faces open --particle-faces open <two |
		p2m | poisson-fft | mgrad --order 4 | sls"
	[[ $stderr == "mgrad: "*"e-10 of the density is within 2 nodes of an open face, "*"(p2m --rim 1 leaves these nodes free; "* ]]
}

# bodies_momentum ORDER RIM < frame: |sum m a| over sum m |a|, the largest component
bodies_momentum() {
	p2m --rim "$2" | poisson-fft | mgrad --order "$1" | m2p | stab --plain | awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
		{ for (d = 0; d < 3; d++) { a = $c["mass"]*$c["acc_" d]; s[d] += a; t += a < 0 ? -a : a } }
		END { for (d = 0; d < 3; d++) { x = s[d] < 0 ? -s[d] : s[d]; if (x > m) m = x } printf "%.3g\n", m/t }'
}

@test "p2m --rim keeps momentum to round-off with orders 4 and 6 beside open faces, and no body acts on itself" {
	for x in 1.05 1.3 2.05 2.3 14.6; do # alone: outside, or inside without a force on itself
		printf 'x y z vx vy vz mass\n%s 8.2 7.7 0 0 0 1\n' $x | stab - --law gravity --box 0,16 --cells 16 --faces open --particle-faces open >one
		for row in 4:1 6:2; do
			sh_ok "p2m --rim ${row#*:} <one | poisson-fft | mgrad --order ${row%:*} | m2p | stab --plain >b" && [[ $output != *mgrad:* ]]
			below "$(awk 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "acc_0") c = i; next } { print $c }' b)" 1e-14
		done
	done
	pinit uniform -n 400 --length 16 --cells 16 --faces open --particle-faces open --softening 0 >all # many of them in the last cells
	for row in 4:1 6:2; do
		below "$(bodies_momentum "${row%:*}" "${row#*:}" <all)" 1e-14
		above "$(bodies_momentum "${row%:*}" 0 <all)" 1e-4 # without
	done
	# the header says so, through every word; other engines and threads give the same bytes
	[ "$(p2m --rim 2 --kernel tsc <all | poisson-fft | mgrad --order 6 | stab | head -n 1 | grep -o '"rim":2' | wc -l)" = 3 ]
	words='push kick/2 drift | p2m --rim 1 | poisson-fft | mgrad | m2p | push kick/2'
	cycle -n 3 "$words" <all | stab >a
	cycle -n 3 --engine pipes --threads 3 "$words" <all | stab >b
	cmp a b
	run -1 --separate-stderr bash -o pipefail -c "p2m --rim 1 <all | p2m --add | sls"
	[[ $stderr == *"was deposited with a rim of 1 cells (--rim 1)"* ]]
	p2m --rim 0 <all | stab >a
	p2m <all | stab >b
	diff <(grep -v '"program"' a | tail -n +2) <(grep -v '"program"' b | tail -n +2)
}
