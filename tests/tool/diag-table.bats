# How diag writes its rows: for people on a terminal, else as TSV, CSV or JSON. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# screen COLUMNS COMMAND: what a terminal of that width shows on standard output; notes go to the file err. Wiping of progress lines is left out.
screen() { script -qec "stty cols $1; $2 2>err" /dev/null </dev/null | tr -d '\r' | sed 's/\x1b\[K//g'; }

@test "on a terminal diag shows few columns in six digits and the units the frame states; into a pipe and a file all columns as ever" {
	pinit plummer -n 100 | cycle -n 2 --every 1 'push kick/2 drift | pp | push kick/2' >a
	screen 80 'diag -i a' >t
	[ "$(head -n 1 t)" = 'units: energy, energy_kinetic [mass (length/time)^2]' ]
	[[ $(grep step t) =~ ^\ +step\ +time\ +energy\ +virial_ratio\ +energy_kinetic ]]
	[ "$(awk '$1 == 2 { print (NF > 4), $3 }' t)" = "1 $(printf %.6g "$(diag --columns energy -i a | tail -n 1)")" ]
	grep -q 'more columns are not shown (--columns chooses; all: --format tsv, or into a pipe)' err
	diag -i a >all
	[ "$(head -n 1 all | wc -w)" -gt 15 ]
	diag -i a | same_as - all
	screen 80 'diag -i a -o file'
	same_as file all
	screen 80 'diag -q -i a >file'
	same_as file all
	screen 80 'diag --format tsv -i a' | same_as - all
	# units that a table states
	printf 'x y vx vy mass\n0 0 1 0 2\n' | stab - --law free --unit x=km,v=km/s,mass=kg >b
	[ "$(screen 90 'diag -i b' | head -n 1)" = 'units: time [s]; distance_max [km]; speed_rms [km/s]; energy_kinetic [kg (km/s)^2]' ]
	printf 'x y vx vy mass\n0 0 1 0 2\n' | stab - --law free >b
	run ! grep -q units <(screen 90 'diag -i b')
}

@test "the readable table keeps the width of the terminal" {
	pinit plummer -n 100 --softening 0.1 | p2m | poisson-fft >a
	for width in 40 61 80 133 300; do
		for more in '' '--radii 0.1,0.5 --exact' '--columns time,energy,momentum_x,angular_momentum_z,centre_x,centre_y,mass'; do
			screen $width "diag $more -i a" >t
			[ "$(awk 'length > n { n = length } END { print n }' t)" -le $width ] || { echo "$width $more"; cat t; return 1; }
		done
	done
	[ "$(screen 300 'diag -i a' | grep step | wc -w)" -gt "$(screen 80 'diag -i a' | grep step | wc -w)" ]
}

@test "columns that are nan are left out on a terminal and a note says why; one that was asked for stays; one that gets a value appears" {
	pinit taylor-green-2d --cells 16 >a
	p2m <a >m
	poisson-fft <m >p
	[[ $(screen 120 'diag -i a' | grep step) != *omega* ]]
	[ "$(head -n 2 err)" = "$(printf 'diag: %s\n' 'energy cannot be computed: no mesh holds omega and psi (p2m | poisson-fft, or poisson-mg, makes them)' \
		'enstrophy, omega_max cannot be computed: no mesh holds omega (p2m makes it)')" ]
	[[ $(screen 120 'diag -i m' | grep step) == *enstrophy*omega_max* ]]
	screen 80 'diag --columns time,energy -i a' >t
	[ "$(tail -n 1 t | tr -s ' ')" = ' 0 nan' ]
	grep -q '^diag: energy cannot be computed' err
	cat a p a >many
	screen 120 'diag -i many' >t
	[ "$(grep -c step t)" = 2 ]
	[[ $(grep step t | tail -n 1) == *energy*enstrophy* ]]
	[ "$(tail -n 1 t | grep -o nan | wc -l)" -ge 2 ]
	pinit uniform -n 5 | field 'acc = -x, -y, -z' >f
	screen 80 'diag -i f' >t
	[[ $(head -n 1 err) == "diag: energy is nan: the term 'external' acts on 'matter'"* ]]
}

@test "diag --format csv: a header line and rows with commas, as Python's csv reads them" {
	pinit plummer -n 50 --softening 0.1 >a
	cat a a | diag --exact --radii 0.5 >t
	cat a a | diag --exact --radii 0.5 --format csv >c
	python3 -I -S -c 'import csv; a = list(csv.reader(open("t"), delimiter="\t")); b = list(csv.reader(open("c"))); assert a == b and len(a) == 3, b'
}
