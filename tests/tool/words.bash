# For the tests of the contract: on what every tool works, and by which command line. `input TOOL` writes a stream the tool reads well;
# `words TOOL` prints a command line that reads standard input. A tool that is not here fails the test that looks for it.
# SPDX-License-Identifier: GPL-3.0-or-later

wire() { python3 -I -S "$top/tests/wire.py" "$@"; }
tools() { (cd "$top/tools" && ls -- *.c *.sh | sed 's/\.[a-z]*$//' | sort); }
# Tools in shell and again run sentences, and splot reads tables; streams do not pass through them.
readers() { (cd "$top/tools" && ls -- *.c | sed 's/\.c$//' | grep -vxE 'again|pinit|splot' | sort); }

words() {
	case $1 in
	again) echo "again in.pm" ;;
	cycle) echo "cycle -n 1 'push kick/2 drift | pp | push kick/2'" ;;
	diag) echo "diag --quiet" ;;
	plan) echo "plan --no-cost" ;;
	dt) echo "dt --courant 0.5" ;;
	maxwell) echo "maxwell --layers 1" ;;
	antenna) echo "antenna --place 1 'Ey = sin(3*time+1)*x'" ;;
	window) echo "window electrons --speed 9" ;;
	collide) echo "collide --statistical-weight 0.01 --quiet" ;;
	smooth) echo "smooth --passes 2" ;;
	diffuse) echo "diffuse --nu 0.1" ;;
	species) echo "species ions -n 7 --charge 1 --quiet" ;;
	inject) echo "inject matter --at volume --influx 100 --charge 1 -n 5" ;;
	neutrals) echo "neutrals --set matter --density 1 'elastic: 1'" ;;
	ionise) echo "ionise matter --element H --mass 1 --electron-mass 1e-3 --time-unit 1e-9 --length-unit 1e-9" ;;
	ecsim) echo "ecsim --gauss" ;;
	circuit) echo "circuit --at x-high --current-source 0.1" ;;
	dispersion) echo "dispersion -n 1" ;;
	phase) echo "phase x vx -n 4" ;;
	mlevel) echo "mlevel residual" ;;
	modes) echo "modes --moving 'push kick/2 drift | pp | push kick/2'" ;;
	field) echo "field 'acc = -x, -2*y, vx'" ;;
	stretch) echo "stretch --order 2" ;;
	subgrid) echo "subgrid --order 2" ;;
	reproject) echo "reproject --kernel cic --order 2" ;;
	pse) echo "pse --nu 0.1" ;;
	pgrad) echo "pgrad --method integral" ;;
	penalize) echo "penalize --body 'x - 1'" ;;
	panels) echo "panels --curve '9+cos(2*pi*s), sin(2*pi*s)' -n 12 --stream '1, 0'" ;;
	noslip) echo "noslip --curve '0.5*cos(2*pi*s), 0.5*sin(2*pi*s)' -n 8 --stream '1, 0'" ;;
	sample) echo "sample --eps 0.5" ;;
	redistance) echo "redistance" ;;
	beale) echo "beale --eps 0.1 --iterations 2 --quiet" ;;
	filament) echo "filament" ;;
	walk) echo "walk --nu 0.1" ;;
	jump) echo "jump '9: v = -vx, -vy, -vz'" ;;
	remesh) echo "remesh --by mass" ;;
	push) echo "push drift" ;;
	remesh) echo "remesh --by mass" ;;
	scalc) echo "scalc 'kinetic = (vx^2 + vy^2 + vz^2) / 2'" ;;
	scmp) echo "scmp - same.pm" ;;
	sdraw) echo "sdraw -o picture.png" ;;
	sh5) echo "sh5 -o file.h5" ;;
	svtk) echo "svtk -o file.pvd" ;;
	smod) echo "smod --dt 0.5" ;;
	smove) echo "smove --shift 1,0,0" ;;
	stack) echo "stack - same.pm" ;;
	*) echo "$1" ;;
	esac
}

# input TOOL: made once a file.
input() {
	[ -s "$BATS_FILE_TMPDIR/input-$1" ] || { made "$1" >"$BATS_FILE_TMPDIR/part" && mv "$BATS_FILE_TMPDIR/part" "$BATS_FILE_TMPDIR/input-$1"; } || return
	cat "$BATS_FILE_TMPDIR/input-$1"
}
# Inputs are small, so that Python can sum them: a dozen bodies, and where a mesh is needed one of 4 cells an axis.
made() {
	case $1 in
	cycle | modes | pp) pinit plummer -n 12 --seed 3 --cells 4 ;;
	m2p) cloud | p2m | poisson-fft | mgrad ;;
	dispersion) pinit landau -n 12 --cells 4 | cycle -q -n 15 --every 1 "push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2" ;;
	mgrad | mlevel) cloud | p2m | poisson-fft ;;
	poisson-* | diffuse | spectrum | smooth) cloud | p2m ;;
	antenna | maxwell) pinit em-wave -n 4 --cells 4 | p2m --current ;;
	window) pinit wakefield --cells 8 --wavenumber 2 --dt 0.5 | species electrons -n 12 --velocities 3 --vth 0.01 |
		m2p | push boris/2 | p2m --current | maxwell --layers 1 | push drift ;;
	reproject) pinit taylor-green-3d --cells 4 | scalc 'alpha = volume*sin(x), 0, 0' ;;
	stretch | subgrid) pinit taylor-green-3d --cells 4 | p2m --kernel cic | poisson-fft | mgrad --order 2 ;;
	penalize) pinit taylor-green-2d --cells 4 | p2m --kernel cic | poisson-fft | mgrad --order 2 ;;
	panels) pinit point-vortices -n 12 --cells 4 ;;
	noslip) pinit cylinder --cells 64x48 | sel --where 'hypot(x, y) > 0.5001 && (y > -0.66 || abs(x) < 0.03)' ;; # the first is alone in its row
	pse | pgrad) cloud | scalc --extensive 'volume = 1 / 12' ;;
	filament) cloud | smod --faces open | scalc --role state 'core = 0.1' 'circulation = 1' | scalc --role state --type i64 'node = id' 'curve = 0' ;;
	beale) cloud | scalc --extensive 'volume = 1 / 12' ;;
	redistance) pinit lattice -n 64 --cells 4 --spacing 1 | scalc --extensive 'volume = 1' | scalc --role state 'level = x - 1.2' ;;
	inject) cloud | smod --law electrostatic --dt 0.1 | scalc --extensive 'charge = mass' | scalc --role state 'v = 0, 0, 0' ;;
	neutrals) pinit uniform -n 12 --seed 3 --cells 4 --dispersion 1 ;;
	ionise) pinit uniform -n 12 --seed 3 --cells 4 --dispersion 1 | smod --law electrostatic --constant background=0 --dt 0.1 |
		scalc --extensive --role state 'charge = 0' 'mass = 1' | scalc --mesh mesh --role state 'E = 1e4, x, 0' |
		species electrons -n 3 --velocities 3 ;;
	ecsim) pinit langmuir -n 12 --cells 4 ;;
	circuit) pinit sheath --cells 4 | sel --set electrons | species electrons -n 12 --profile 1 ;;
	walk | jump) cloud | smod --dt 0.01 ;;
	collide) pinit uniform -n 12 --seed 3 --cells 4 --dispersion 1 | smod --law electrostatic | scalc --extensive 'charge = mass' ;;
	*) cloud ;;
	esac
}
cloud() {
	[ -s "$BATS_FILE_TMPDIR/cloud" ] || pinit uniform -n 12 --seed 3 --cells 4 >"$BATS_FILE_TMPDIR/cloud" || return
	cat "$BATS_FILE_TMPDIR/cloud"
}
