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
	# One light body in two thousand is not worth a line.
	printf '%s\n' 'x y z vx vy vz mass' '1.05 8.2 7.7 0 0 0 1' '8.3 8.2 7.7 0 0 0 2000' >two
	sh_ok "stab two --law gravity --box 0,16 --cells 16 --faces open --particle-faces open |
		 p2m | poisson-fft | mgrad 2>&1 >/dev/null"
	[ -z "$output" ]
}
