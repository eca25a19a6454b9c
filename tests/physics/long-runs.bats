# Ten thousand steps of every scene, by the plain sentence of its law and by plan's: none dies. Few particles, coarse meshes; minutes: `make check-long` alone.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

steps=${PM_STEPS:-10000}

# A scene, small: meshes that plan makes eight times finer must stay cheap.
small() {
	case $1 in
	plummer | cold-sphere) echo "$1 -n 200 --cells 16" ;;
	cold-collapse | landau | langmuir) echo "$1 -n 128 --cells 16" ;;
	two-stream) echo "$1 -n 200 --cells 16" ;;
	bernstein | whistler) echo "$1 -n 256 --cells 16" ;;
	uniform) echo "$1 -n 50 --dim 2 --cells 8" ;;
	lattice) echo "$1 -n 64 --dim 2 --cells 8" ;;
	point-vortices) echo "$1 -n 30 --cells 16" ;;
	two-body | kepler | pair) echo "$1 --cells 8" ;;
	exb | gyration) echo "$1" ;;
	sheath) echo "$1" ;;
	tanh-layer) echo "$1 --cells 16x24" ;;
	cylinder) echo "$1 --cells 32x24" ;;
	cavity) echo "$1 --cells 40" ;;
	sphere) echo "$1 --cells 16x12x12" ;;
	zalesak | single-vortex) echo "$1 --cells 32" ;;
	wakefield) echo "$1 --cells 300 --wavenumber 3" ;;
	gem) echo "$1 -n 2000 --cells 32x16" ;;
	vortex-ring | vortex-rings) echo "$1 --cells 20x20x12" ;;
	*) echo "$1 --cells 16" ;;
	esac
}

# plain SCENE: the words of its law without options. Viscosity needs particles where the vorticity goes, and they must stay a lattice: without remesh
# cycle ends these runs at step 26 (ellipse) to 531 (shear-layer), because circulation is lost (docs/check-long.md).
plain() {
	case $1 in
	exb | gyration) echo 'push boris/2 drift | m2p | push boris/2' ;;
	bernstein) echo 'push boris/2 drift | p2m | poisson-fft | mgrad | m2p | push boris/2' ;;
	wakefield) echo 'push boris/2 | p2m --current | maxwell | push drift | window electrons -n 1 | m2p | push boris/2' ;;
	em-wave | gem | weibel | whistler) echo 'push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2' ;;
	lamb-oseen) echo 'p2m | poisson-fft | mgrad | diffuse | m2p | push lsrk3 | remesh --rim 2 --cut-off 1e-4' ;;
	ellipse | shear-layer | taylor-green-2d | tanh-layer | random-vorticity) echo 'p2m | poisson-fft | mgrad | diffuse | m2p | push lsrk3 | remesh' ;;
	# the mesh would grow with what they leave behind
	lamb-dipole | vortex-merger) echo 'p2m | poisson-fft | mgrad | m2p | push lsrk3 | remesh --outside drop' ;;
	cylinder) echo "p2m | poisson-fft | mgrad | penalize --body 'hypot(x, y) - 0.5' --stream '1, 0' | diffuse | m2p | field 'vel = 1, 0' | push lsrk3 |
		remesh --cut-off 1e-3 --outside drop" ;;
	sphere) echo "p2m | poisson-fft | mgrad | stretch | penalize --body 'sqrt(x^2 + y^2 + z^2) - 0.5' --stream '1, 0, 0' | diffuse | m2p |
		field 'vel = 1, 0, 0' | push lsrk3 | remesh --cut-off 1e-2 --outside drop" ;;
	cavity) echo "p2m | poisson-fft | mgrad | penalize --body 'min(min(x, 1 - x), min(y, 1 - y))' --velocity 'y > 0.99 ? 1 : 0, 0' --stream '0.1, 0' |
		diffuse | m2p | field 'vel = 0.1, 0' | push lsrk3 | remesh" ;;
	taylor-green-3d | vortex-tube) echo 'p2m | poisson-fft | mgrad | stretch | diffuse | m2p | push lsrk3 | remesh' ;;
	vortex-ring | vortex-rings) echo 'p2m --outside drop | poisson-fft | mgrad | stretch | m2p | push lsrk3 | remesh --cut-off 1e-2 --outside drop' ;;
	zalesak) echo "field 'vel = -2*pi*(y - 0.5), 2*pi*(x - 0.5)' | push rk4 | remesh --by volume" ;;
	single-vortex) echo "field 'vel = -sin(pi*x)^2*sin(2*pi*y)*cos(pi*time/8), sin(pi*y)^2*sin(2*pi*x)*cos(pi*time/8)' | push rk4 | remesh --by volume" ;;
	sheath) echo 'push kick/2 drift | inject electrons --density 1 -w 0.5 | inject ions --density 1.8 --charge 1 --mass 100 --vth 0.1 -w 0.5 | p2m |
		poisson-fft --x-high charge_x_high/eps0 | mgrad | m2p | push kick/2' ;;
	cone-vortex | point-vortices | polygon | vortex-pair | vortex-sheet) echo 'p2m | poisson-fft | mgrad | m2p | push lsrk3' ;;
	*) echo 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' ;;
	esac
}

scenes() { pinit --help | awk '/^The scenes/ { inside = 1; next } NF == 0 { inside = 0 } inside && $1 != "plasma" { print $1 }'; } # plasma is an empty box

# lives SCENE OPTION...: cycle with these options ends at the last step; else says why.
lives() {
	local scene=$1
	shift
	# shellcheck disable=SC2046 # options
	pinit $(small "$scene") | cycle -n "$steps" "$@" >out 2>err && [ "$(diag --columns step <out | tail -n 1)" = "$steps" ] ||
		{ echo "$scene, ${*: -1}: $(tail -n 1 err)" >&2; return 1; }
}

@test "no scene dies in 10 000 steps of its law's plain sentence" {
	[ -n "${PM_LONG:-}" ] || skip "long: make check-long"
	local scene dead=0
	# a trefoil that is small enough for 10 000 steps is not resolved: its strengths do not add up, and cycle ends the run
	for scene in $(scenes | grep -vx trefoil); do lives "$scene" "$(plain "$scene")" || dead=$((dead + 1)); done
	[ $dead = 0 ]
}

@test "no scene dies in 10 000 steps of plan's sentence" {
	[ -n "${PM_LONG:-}" ] || skip "long: make check-long"
	local scene dead=0
	for scene in $(scenes | grep -vxE 'cavity|cylinder|sphere|sheath|zalesak|single-vortex'); do lives "$scene" --plan || dead=$((dead + 1)); done
	[ $dead = 0 ]
}

@test "a star cluster loses bodies in 10 000 steps and keeps its energy to 3 % once relaxed, momentum to round-off" {
	[ -n "${PM_LONG:-}" ] || skip "long: make check-long"
	# gradients of order 2 keep the momentum near open faces too; bodies leave from step 500 on. Measured after that: 1.4 % in 4000 steps
	pinit plummer -n 1000 --cells 32 |
		cycle -n "$steps" --every 500 'push kick/2 drift | p2m --kernel tsc | poisson-fft | mgrad --order 2 | m2p | push kick/2' |
		diag --columns energy,momentum_x,momentum_scale,outside >d
	above "$(tail -n 1 d | cut -f 4)" 5
	below "$(awk 'NR == 3 { e = $1 } NR > 3 { x = ($1 - e) / e; x = x < 0 ? -x : x; if (x > m) m = x } END { print m }' d)" 0.03
	below "$(awk 'NR == 2 { p = $2 } NR > 1 { x = ($2 - p) / $3; x = x < 0 ? -x : x; if (x > m) m = x } END { print m }' d)" 1e-14
}
