# diag: its output. The sums themselves are tested in tests/unit/measure.c. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

@test "diag: a table with a header line of words, one row a frame, the same columns all along" {
	sh_ok 'pinit plummer -n 100 > a; cat a a a | diag > t'
	[ "$(wc -l < t)" = 4 ]
	[ "$(awk -F'\t' '{ print NF }' t | sort -u | wc -l)" = 1 ]
	for c in step time energy_kinetic energy_field_mesh energy_field_pair energy momentum_x angular_momentum_z mass; do
		[ -n "$(column $c < t)" ]
	done
	[ "$(head -n1 t | cut -f1-6)" = "$(printf 'step\ttime\tenergy_kinetic\tenergy_field_mesh\tenergy_field_pair\tenergy')" ]
}

@test "diag: the columns follow the dimension" {
	sh_ok 'pinit uniform --dim 1 -n 10 | diag'
	[[ ${lines[0]} != *momentum_y* && ${lines[0]} != *angular* ]]
	sh_ok 'pinit uniform --dim 2 -n 10 | diag'
	[[ ${lines[0]} == *angular_momentum_z* && ${lines[0]} != *angular_momentum_x* ]]
}

@test "diag: quantities that cannot be computed are nan, and null in JSON" {
	sh_ok 'pinit uniform -n 100 > a; diag < a > t'
	[ "$(column energy < t)" = nan ]
	sh_ok 'diag --format json < a'
	[ "$(jq .energy <<<"$output")" = null ]
	[ "$(jq .mass <<<"$output")" != null ]
}

@test "diag: --columns chooses and orders; a column that does not exist is refused, exit 2" {
	sh_ok 'pinit two-body | diag --columns mass,step'
	[ "${lines[0]}" = "$(printf 'mass\tstep')" ]
	[ "${lines[1]}" = "$(printf '1\t0')" ]
	run -2 --separate-stderr diag --columns masss
	[[ $stderr == *mass* ]]
}

@test "diag: --columns takes radius_F and mode_M by the names that --radii and --modes print, in any order and beside them" {
	pinit plummer -n 100 >a
	diag --columns time --radii 0.5,0.1 a >b
	diag --columns time,radius_0.5,radius_0.1 a | same_as - b
	[ "$(diag --columns radius_0.1,time --radii 0.5 a | head -n 1)" = "$(printf 'radius_0.1\ttime\tradius_0.5')" ]
	pinit landau -n 1000 --cells 16 | cycle -n 12 --every 1 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' >a
	diag --columns time --modes 2,1 --growth mode:1 a >b
	diag --columns time,mode_2,mode_1 --growth mode:1 a | same_as - b
	diag --modes 1,10 --growth mode:10 a | tail -n 1 >b
	diag --modes 1,10 --growth mode:1e1 a | tail -n 1 | sed 's/mode:1e1/mode:10/' | cmp - b
	[ "$(diag --columns time,mode_1 --modes 1 a | head -n 1)" = "$(printf 'time\tmode_1')" ]
	run -2 diag --columns mode_1.5 a
	[[ $output == *"mode_1.5 is no wave"* ]]
	run -2 diag --columns radius_2 a
	[[ $output == *"no fraction of the mass"* ]]
	run -2 diag --columns mode_x a
	[[ $output == "diag: --columns 'mode_x' is not one of those that --help lists" ]] # the whole list would not fit
}

@test "PM-09: plummer has the exact energy, Lagrangian radii and virial ratio" {
	# radius_F is a fraction of the mass inside the truncation, so F = 0.1/0.985185 ... is a tenth of the total mass of the reference.
	# with 1e4 particles the energy scatters by 0.7 %, the truncation at 10 a costs 0.5 %: the mean of four seeds is within the case's 1 %
	for s in 1 2 3 4; do
		pinit plummer -n 10000 --seed $s | pp --potential | diag --exact --radii 0.10150373,0.50751869,0.91353358 > $s
	done
	for c in energy virial_ratio radius_0.101504 radius_0.507519 radius_0.913534; do
		eval "$(echo $c | tr . _)=$(for s in 1 2 3 4; do column $c < $s; done | awk '{ s += $1 } END { printf "%.17g", s / NR }')"
	done
	within "$energy" -0.147262155637022 0.00147
	within "$virial_ratio" 1 0.02
	within "$radius_0_101504" 0.524028063612871 0.0157 # 3 %
	within "$radius_0_507519" 1.30476602650411 0.0261  # 2 %
	within "$radius_0_913534" 3.70711279195408 0.111   # 3 %
	within "$(column exact_radius_0.913534 < 1)" 3.70711279195408 1e-5
	within "$energy" "$(column exact_energy < 1)" 0.0015 # three standard deviations of the mean of four
}

@test "diag: the direct sum of --pair is that of pp --potential" {
	sh_ok 'pinit plummer -n 2000 > a; diag --pair < a > b; pp --potential < a | diag > c'
	within "$(column energy_field_pair < b)" "$(column energy_field_pair < c)" 1e-13
}

@test "diag: the orbit of two bodies has its exact energies and angular momentum" {
	for e in 0 0.5 0.9; do
		sh_ok "pinit two-body --eccentricity $e --ratio 3 | diag --pair --exact > t"
		for c in energy energy_kinetic energy_field_pair angular_momentum_z mass; do
			within "$(column $c < t)" "$(column exact_$c < t)" 1e-15
		done
	done
	sh_ok 'pinit kepler | diag --pair --exact > t'
	within "$(column energy < t)" -0.5 1e-15
	within "$(column angular_momentum_z < t)" "$(column exact_angular_momentum_z < t)" 1e-15
}

@test "diag: --pair in a periodic box and --exact without a scene are refused" {
	run -2 --separate-stderr bash -o pipefail -c 'pinit uniform -n 10 | diag --pair'
	[[ $stderr == *"this box is periodic"* ]]
	run -2 --separate-stderr diag --radii 1.5
	[[ $stderr == *"not a fraction"* ]]
}

@test "diag: --set measures one set, and a set that is not there is named" {
	sh_ok 'pinit kepler | diag --set sun --columns mass,particles'
	[ "${lines[1]}" = "$(printf '1\t1')" ]
	run -1 --separate-stderr bash -o pipefail -c 'pinit kepler | diag --set moon'
	[[ $stderr == *"no set 'moon'"* ]]
}

@test "diag: --tee writes the table to a file and passes the frame on unchanged" {
	sh_ok 'pinit plummer -n 1000 > a; diag --tee t --no-history < a > b; diag < a > u'
	same_as a b
	same_as t u
}

@test "diag: inside cycle it writes a row a step, at whole steps only" {
	sh_ok "pinit kepler | cycle -n 5 'push drift | diag --tee t' > b"
	[ "$(column step < t | tr '\n' ' ')" = "1 2 3 4 5 " ]
	sh_ok "pinit kepler | cycle -n 5 'pp | push rk4 | diag --tee t' > b" # four passes a step
	[ "$(column step < t | tr '\n' ' ')" = "1 2 3 4 5 " ]
}

@test "diag: inside cycle too the line of --growth comes after the table, with either engine" {
	for engine in fused pipes; do
		sh_ok "pinit langmuir -n 64 --cells 16 | cycle --engine $engine -n 40 '
			push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2 | diag --growth mode:1 --tee $engine'"
		[ "$(grep -c '^# mode:1 gamma ' $engine)" = 1 ]
	done
	same_as fused pipes
}

@test "HC-58: the table has the same bytes with 1, 2 and 3 threads" {
	pinit plummer -n 50000 > a
	for t in 1 2 3; do
		diag --radii 0.5 --threads $t < a > $t
	done
	same_as 1 2
	same_as 1 3
}

@test "diag: a full disk is an error, a closed reader is not" {
	run -1 --separate-stderr bash -c 'pinit two-body | diag > /dev/full'
	[[ $stderr == *"cannot write"* ]]
	run -1 --separate-stderr bash -o pipefail -c 'pinit two-body | diag --tee /no/such/place/t'
	[[ $stderr == *"/no/such/place/t"* ]]
}

@test "diag: charge, field energy by component and modes of a plasma; --growth prints one line after the table" {
	sh_ok "pinit langmuir -n 1024 --cells 16 --amplitude 1e-3 --dt 0.2 |
		cycle -n 100 --every 1 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' |
		p2m | poisson-fft | mgrad > a; diag --modes 1,2 --growth mode:1 < a > t"
	[ "$(wc -l < t)" = 103 ]
	[[ $(tail -n 1 t) == "# mode:1 gamma "*" +- "*" omega "*", from t = 0 to "*", 101 points, "*" times the noise" ]]
	within "$(sed '$d' t | column charge | tail -n 1)" -6.283185307179586 1e-12
	# a plane wave of amplitude e has the energy L e^2/4, and mode 2 is absent
	e=$(sed '$d' t | column mode_1 | head -n 1)
	within "$(sed '$d' t | column energy_field_x | head -n 1)" "$(awk -v e="$e" 'BEGIN { printf "%.17g", 6.283185307179586 * e * e / 4 }')" 1e-9
	below "$(sed '$d' t | column mode_2 | head -n 1)" 1e-5
	sh_ok "diag --growth mode:1 --window 2.1:14.9 --format json < a | tail -n 1 |
		python3 -c 'import json, sys; d = json.load(sys.stdin); print(d[\"growth\"], d[\"points\"])'"
	[ "$output" = "mode:1 64" ]
	pinit uniform -n 10 | diag > u
	run ! grep -q charge u
}

@test "diag: the energy of each component of the field: equal along a diagonal, all of it along x in a wave along x; together 1/2 integral rho phi" {
	for case in "2 2" "3 3" "3 1"; do
		read -r dim axes <<<"$case"
		pinit langmuir --dim "$dim" --axes "$axes" -n $((16 ** dim)) --cells 16 --amplitude 0.1 | p2m | poisson-fft --symbol spectral |
			mgrad --order spectral | diag --modes 1 > t
		x=$(column energy_field_x < t) y=$(column energy_field_y < t)
		if [ "$axes" = 1 ]; then
			below "$y" 1e-28
			below "$(column energy_field_z < t)" 1e-28
			e=$(column mode_1 < t) # of x, averaged over y and z: L^3 e^2/4
			within "$(awk -v x="$x" -v e="$e" 'BEGIN { printf "%.17g", x / (248.05021344239853 * e * e / 4) }')" 1 1e-2
		else
			within "$(awk -v x="$x" -v y="$y" 'BEGIN { printf "%.17g", y / x }')" 1 1e-12
		fi
		within "$(awk -v x="$x" -v n="$axes" -v m="$(column energy_field_mesh < t)" 'BEGIN { printf "%.17g", n * x / m }')" 1 1e-9 \
			# nothing at the highest wavenumber
	done
}

@test "diag: the field energies of x and y of a few charges are unequal, and together 1/2 integral rho phi" {
	printf 'x y charge\n0.31 0.52 1\n0.7 0.6 -1\n0.2 0.1 0.5\n0.25 0.3 -0.5\n' |
		stab - --law electrostatic --strength charge --constant eps0=1 --box 0,1 --faces periodic --particle-faces periodic -n 16 |
		p2m --kernel pcs | poisson-fft --symbol spectral | mgrad --order spectral | diag > t
	x=$(column energy_field_x < t) y=$(column energy_field_y < t) all=$(column energy_field_mesh < t)
	# pcs leaves 1e-3 of the energy at the highest wavenumbers, whose derivative is zero
	within "$(awk -v x="$x" -v y="$y" -v m="$all" 'BEGIN { printf "%.17g", (x + y) / m }')" 1 5e-3
	below "$y" "$(awk -v x="$x" 'BEGIN { print 0.9 * x }')"
}

@test "diag: --growth of noise, of rounding and of too few frames prints no rate but the reason" {
	none() { sh_ok "$2 | diag --columns time --growth mode:1 | tail -n 1"; [[ $output == "# mode:1 gamma nan +- nan omega nan, none of "*"$1"* ]] ||
		{ echo "$output"; return 1; }; }
	none "1 points: 1 points are too few" "pinit langmuir -n 64 | p2m | poisson-fft | mgrad"
	# u.y of Taylor's vortices is sin(y) cos(x), and its mean over y 0
	none "is the rounding of a field of 1" "pinit taylor-green-2d --cells 32 |
		cycle -n 12 --every 1 'p2m | poisson-fft | mgrad | diffuse | m2p | push rk2' | p2m | poisson-fft | mgrad"
	# a field that is random anew in every frame
	none "exponential" "for i in {1..40}; do pinit uniform --dim 1 -n 50 --seed \$i | smod --time \$i; done | p2m | poisson-fft | mgrad"
	sh_ok "pinit langmuir -n 64 | p2m | poisson-fft | mgrad | diag --growth mode:1 --format json | tail -n 1 | jq -c '[.gamma, .points, .none]'"
	[ "$output" = '[null,1,"1 points are too few (more frames: cycle --every)"]' ]
}

@test "diag: a mode under law vortex is that of u.y: a viscous shear flow u.y = sin(x) decays at nu, and u.x is 0 for all waves along x" {
	flow='pinit taylor-green-2d --cells 32 --nu 0.05 --dt 0.1 | scalc "circulation = cos(x)*volume"'
	sh_ok "$flow | cycle -n 60 --every 2 'p2m | poisson-fft | mgrad | diffuse | m2p | push rk2' |
		p2m | poisson-fft | mgrad | diag --columns time,energy --modes 1 --growth mode:1 > t"
	within "$(sed '$d' t | column mode_1 | head -n 1)" 1 1e-4 # circulation of the nodes, spread by m4prime
	within "$(sed -n 's/^# mode:1 gamma \([^ ]*\) .*/\1/p' t)" -0.05 5e-4
}

@test "diag: --growth of a column: the energy of a damped wave falls at twice its rate and turns at twice its frequency" {
	sh_ok "pinit landau -n 10240 --beams 80 --amplitude 1e-3 |
		cycle -n 160 --every 2 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' > a"
	sh_ok "diag --growth mode:1 < a > m; diag --growth energy_field_x < a > c"
	rate() { sed -n "s/^# .* $1 \([^ ,]*\)[ ,].*/\1/p" "$2"; }
	within "$(rate gamma c)" "$(awk -v g="$(rate gamma m)" 'BEGIN { print 2 * g }')" 0.01
	within "$(rate omega c)" "$(awk -v w="$(rate omega m)" 'BEGIN { print 2 * w }')" 0.02
}

@test "diag: --growth without a field or with a wrong word is refused" {
	refused() { run -"$1" --separate-stderr bash -o pipefail -c "$3"; [[ $stderr == *"$2"* ]] || { echo "$stderr"; return 1; }; }
	refused 1 "no field 'E' on a mesh for the modes (p2m | poisson-fft | mgrad makes one)" "pinit langmuir -n 64 | diag --growth mode:1"
	refused 1 "modes need a box that is periodic in x" "pinit plummer -n 64 | diag --growth mode:1"
	refused 2 "mode:1 for waves in the box along x, or a column of diag" "pinit langmuir -n 64 | diag --growth 1"
	refused 2 "it is written T0:T1" "pinit langmuir -n 64 | diag --growth mode:1 --window 3:1"
	refused 2 "not a whole number of waves" "pinit langmuir -n 64 | diag --modes 1.5"
}

@test "--flux-box and --field-errors without a potential print nan, and a line says why" {
	pinit uniform -n 20 --dim 2 | p2m -n 8 >a
	run -0 --separate-stderr diag --flux-box 0.2,0.2,0.8,0.8 --columns time a
	[[ $output == *nan* && $stderr == "diag: flux and flux_enclosed are nan: no mesh has the density and the potential of the law"* ]]
	run -0 --separate-stderr diag --field-errors --columns time a
	[[ $stderr == "diag: field_residual and field_curl are nan: no mesh has "* ]]
	run -0 --separate-stderr bash -o pipefail -c 'poisson-fft a | diag --field-errors --columns time'
	[ -z "$stderr" ]
}

@test "--columns names what --flux-box, --field-errors and --separation add, or says which of them it needs" {
	refused() { run -"$1" --separate-stderr bash -o pipefail -c "$3"; [[ $stderr == *"$2"* ]] || { echo "$stderr"; return 1; }; }
	pinit uniform -n 20 --dim 2 | p2m -n 8 | poisson-fft >a
	[ "$(diag --columns flux,time --flux-box 0.2,0.2,0.8,0.8 a | head -n 1)" = $'flux\ttime' ]
	[ "$(diag --columns time,field_curl a | head -n 1)" = $'time\tfield_curl' ]
	[ "$(diag --columns field_residual a)" = "$(diag --columns time --field-errors a | awk -F'\t' -v OFS='\t' '{ print $2 }')" ]
	refused 2 "--columns flux_enclosed needs the box (--flux-box LOW,HIGH, its corners)" "diag --columns flux_enclosed a"
	refused 2 "--columns separation needs the two sets (--separation SET,SET)" "diag --columns separation a"
}

@test "the energy of a sentence that softens pp is conserved in diag --pair and --until: its softening and mollifier count, not the frame's" {
	pinit plummer -n 50 >a
	for words in 'push kick/2 drift | pp --softening 0.5 | push kick/2' 'pp --softening 0.5 | push rk4' \
		'pp --softening 0.5 --mollifier gaussian | push lsrk3'; do
		for engine in fused pipes; do
			cycle -n 8 --every 4 --engine $engine "$words" <a | diag --pair --columns energy >t
			# the frame's softening of 0.02 gives 30 % more; leapfrog keeps energy to 1e-5
			awk 'NR == 2 { first = $1 } NR > 1 { d = $1 / first - 1; if (d * d > 1e-8) bad = 1 } END { exit bad || NR != 4 }' t
			cycle -n 8 --engine $engine --until 'abs(energy - energy0) > 1e-4*abs(energy0)' "$words" <a | sls | grep -q 'step 8 '
		done
	done
	# what acted before is forgotten in a new run; two softenings have no common sum
	cycle -n 2 'pp --softening 0.5 | push rk4' <a | cycle -n 1 'pp | push rk4' | diag --pair --columns energy | tail -1 >t
	cycle -n 1 'pp | push rk4' <a | diag --pair --columns energy | tail -1 | awk '{ getline x <"t"; exit !($1 < -0.15 && x < -0.15) }'
	stack a <(smod --rename matter=more <a | smove --shift 9,0,0) |
		cycle -n 1 'pp --softening 0.5 --set matter | pp --softening 0.1 --set more | push rk4' >b
	run --separate-stderr diag --pair --columns energy <b
	[ "${lines[1]}" = nan ]
	[[ $stderr == *"energy is nan: the sums over pairs of the sets are softened differently"* ]]
}

@test "where a given force acts, energy is nan and the reason is told once: never the kinetic energy alone" {
	printf 'x y vx vy mass\n1 0 0 1 1\n' | stab - --law free --dt 0.1 >free
	pinit plummer -n 20 | smod --dt 0.01 >gravity
	for law in free gravity; do
		words="field 'acc = -x, -y$([ $law = free ] || echo ', -z')'"
		[ $law = free ] || words="pp --potential | $words"
		for sentence in "push kick/2 drift | $words | push kick/2" "$words | push rk4"; do
			cycle -n 3 --every 1 "$sentence" <$law >b
			run --separate-stderr diag --columns energy,energy_kinetic <b
			[ "$(printf '%s\n' "${lines[@]:1}" | cut -f 1 | sort -u)" = nan ]
			[[ ${lines[4]} != *nan*nan* ]]
			[ "${#stderr_lines[@]}" = 1 ]
			[[ $stderr == "diag: energy is nan: the term 'external' acts on 'matter', and its potential is not known"* ]]
			run -1 cycle -n 3 --until 'energy > 10' "$sentence" <$law
			[[ $output == *"--until: the column 'energy' cannot be computed: the term 'external' acts on 'matter'"* ]]
		done
	done
	# without any force it is the kinetic energy
	[ "$(cycle -n 1 'push drift' <free | diag --columns energy | tail -1)" = 0.5 ]
}

@test "energy is summed over pairs where no mesh and no particle holds the potential, unasked up to 4096 particles: no --potential is needed with pp" {
	pinit plummer -n 300 >a
	cycle -n 4 --every 2 'push kick/2 drift | pp --softening 0.3 | push kick/2' <a >b
	columns=energy,energy_field_pair,virial_ratio
	[ "$(diag --columns $columns <b)" = "$(diag --pair --columns $columns <b)" ]
	run ! grep -q nan <(diag --columns $columns <b)
	# a sum once begun goes on, and one that was not is not begun: a column is one quantity
	p2m <a | poisson-fft >m
	smod --step 1 <a >a1
	smod --step 1 <m >m1
	[ "$(cat m a1 | diag --columns energy 2>err | tail -n 1)" = nan ]
	[ "$(cat a m1 | diag --columns energy | uniq -d | wc -l)" = 1 ]
	run -0 --separate-stderr diag --columns energy < <(pinit plummer -n 4096)
	[ -z "$stderr" ]
	[ "${lines[1]}" != nan ]
	run -0 --separate-stderr diag --columns energy < <(pinit plummer -n 4097)
	[ "${lines[1]}" = nan ]
	[[ $stderr == "diag: energy is nan: no mesh and no particle holds phi, and the pairs of more than 4096 particles are not summed unasked"* ]]
	run -0 --separate-stderr diag --columns energy_kinetic < <(pinit plummer -n 4097)
	[ -z "$stderr" ]
	# images behind walls and periodic boxes are no sum over pairs
	run -0 --separate-stderr bash -c 'pinit plummer -n 30 --faces wall | diag --columns energy'
	[[ ${lines[1]} == nan && $stderr == "diag: energy is nan: no mesh holds rho and phi (p2m | poisson-fft, or poisson-mg, makes them)" ]]
}

@test "diag: the energy of vortices in space is nan for want of omega and psi, not of a velocity" {
	pinit vortex-ring --cells 16 2>/dev/null >a
	diag --columns energy a 2>&1 | grep -qx 'diag: energy is nan: no mesh holds omega and psi (p2m | poisson-fft, or poisson-mg, makes them)'
	diag --format table a 2>&1 | grep -q '^diag: energy cannot be computed: no mesh holds omega and psi'
	[[ $(p2m a | poisson-fft | diag --columns energy 2>&1 | tail -n 1) == 0.* ]]
}

@test "diag decides anew for every run whether pairs are summed, and says where masses have no velocities" {
	pinit langmuir -n 100 --cells 16 | p2m >l.pm
	pinit plummer -n 300 >d.pm
	energy=$(diag --columns energy d.pm | tail -n 1)
	[ "$energy" != nan ]
	[ "$(diag --columns energy l.pm d.pm 2>err | tail -n 1)" = "$energy" ]
	sel --drop v d.pm >e.pm
	diag e.pm 2>err >out
	grep -q "'matter' has no velocities 'v': kinetic energy and momentum are 0" err
}

@test "diag of frames that all lie inside a step says why it has no row" {
	run -0 --separate-stderr bash -c 'pinit two-body | pp | push rk4 | diag'
	[ -z "$output" ]
	[[ $stderr = *'no row: every frame lies inside a step'* ]]
	run -0 --separate-stderr bash -c 'pinit two-body -n 2 | sel --drop id | diag --columns step'
	[ -z "$stderr" ]
}

# A charge q at 0.05, 0.1 of a box of 24 cells; the notes' 4 pi q (000:N09) is that of Gaussian units, here q/eps0.
@test "the flux of a charge through any box around it is q/eps0 to round-off, and 0 through one beside it; field has no curl and the equation no residual" {
	printf 'x y z charge mass\n0.1 0.05 0 2.5 1\n' | stab - --law electrostatic --constant eps0=0.5 --box -1,-1,-1,1,1,1 --faces open -n 24 | p2m >a
	for solver in poisson-fft poisson-mg; do
		$solver <a | mgrad >b
		for box in -0.5,-0.5,-0.5,0.5,0.6,0.4 -0.9,-0.2,-0.7,0.3,0.9,0.1 0,0,-0.05,0.2,0.1,0.05; do
			diag --flux-box=$box --field-errors <b >c
			within "$(column flux <c)" 5 1e-8 # the tolerance of poisson-mg
			within "$(column flux_enclosed <c)" 5 1e-12
			below "$(column field_residual <c)" 1e-10
			below "$(column field_curl <c)" 1e-14
		done
		within "$(diag --flux-box=0.4,-0.5,-0.5,0.8,0.6,0.4 <b | column flux)" 0 1e-8
	done
	poisson-fft --symbol fd4 <a | diag --flux-box=-0.5,-0.5,-0.5,0.5,0.6,0.4 --field-errors >c
	within "$(column flux <c)" 5 0.05 # of order h^2 where the solver's differences are others
	above "$(column field_residual <c)" 0.05
	pinit uniform -n 500 --dim 2 | p2m -n 32 | poisson-fft --symbol fd2 | mgrad | diag --flux-box 0.2,0.2,0.7,0.7 --field-errors >c
	within "$(column flux <c)" "$(column flux_enclosed <c)" 1e-12 # without the mean, which has no field
	below "$(column field_residual <c)" 1e-13
	pinit uniform -n 500 --dim 2 --faces wall | p2m -n 32 | poisson-fft --dirichlet x | mgrad --order 2 >d
	below "$(diag --field-errors <d | column field_curl)" 1e-13
	within "$(scalc --mesh mesh 'g = y, -x' <d | diag --field-errors | column field_curl)" 0.0625 1e-12 # curl -2, h 1/32, largest component 1
	run -1 --separate-stderr diag --flux-box 0,0.2,0.7,0.7 <d
	[[ $stderr == *"nodes of the mesh inside and around it, but along x it goes from 0 to 0.7 in a mesh from 0 to 1" ]]
	run -2 --separate-stderr diag --flux-box 0,1 <d
	[[ $stderr == *"--flux-box needs 4 numbers"* ]]
}

@test "diag --species: mean and covariance of a set's velocities, weighted by mass, to round-off beside a large drift; kinetic energies add up" {
	# masses 1, 2, 3; velocities 1e6 + (0, 3, 1), (1, 0, -1): mean 1e6 + 1.5, -1/3
	printf 'x y vx vy mass charge\n0 0 1000000 1 1 1\n1 0 1000003 0 2 1\n1 1 1000001 -1 3 1\n' |
		stab - --box 0,2 --law electrostatic --dt 0.1 --strength mass,charge --set beam >a
	printf 'x y vx vy mass charge\n0 0 5 0 4 1\n' | stab - --box 0,2 --law electrostatic --dt 0.1 --strength mass,charge --set ions >b
	stack a b | diag --species >t
	within "$(column drift_x_beam <t)" 1000001.5 1e-9
	within "$(column drift_y_beam <t)" "$(calc '-1 / 3')" 1e-14
	within "$(column covariance_xx_beam <t)" "$(calc '(2.25 + 2 * 2.25 + 3 * 0.25) / 6')" 1e-14
	within "$(column covariance_yy_beam <t)" "$(calc '(16 / 9 + 2 / 9 + 3 * 4 / 9) / 6')" 1e-14
	within "$(column covariance_xy_beam <t)" "$(calc '(-1.5 * 4 / 3 + 2 * 1.5 / 3 + 3 * 0.5 * 2 / 3) / 6')" 1e-14
	[ "$(column particles_beam <t) $(column particles_ions <t) $(column covariance_xx_ions <t)" = "3 1 0" ]
	within "$(calc "$(column kinetic_beam <t) + $(column kinetic_ions <t)")" "$(column energy_kinetic <t)" 0.001 # of 3e12
	run ! grep -q covariance_zz t
	pinit plasma | species hot -n 50000 --velocities 3 --widths 1,2,3 | diag --species >t
	for c in xx:1 yy:4 zz:9 xy:0; do
		within "$(column "covariance_${c%:*}_hot" <t)" "${c#*:}" 0.02
	done
	run -2 --separate-stderr bash -c "pinit landau -n 100 | diag --species --set electrons"
	[[ $stderr == *"--species measures every set"* ]]
}

@test "docs/methods/diag.md: density, mean velocity and temperature on the mesh, by the words" {
	pinit plasma --length 16 --cells 16 | species e -n 200000 --profile '1 + 0.5*sin(2*pi*x/16)' --drift 2 |
		scalc --set e 'v = 2 + (1 + 0.5*cos(2*pi*x/16))*(vx - 2)' >a
	sed -n '/^    scalc --set e --extensive/,/^$/p' "$top/docs/methods/diag.md" >sentence
	bash -o pipefail -c "cat a | $(cat sentence)" | stab --plain --mesh mesh >t
	# cic smooths: 1 - (2 pi/16)^2/6 = 0.974 of a wave; noise of the sequence 1 %
	awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { x = (NR - 2) * 2 * 3.14159265 / 16
		n = $at["n_e"] - 1 - 0.974 * 0.5 * sin(x); u = $at["u_e"] - 2; T = $at["T_e"] - (1 + 0.5 * cos(x))^2
		if (n * n > 0.0001 || u * u > 0.0009 || T * T > 0.01) { print; bad = 1 } } END { exit bad || NR != 17 }' t
}

@test "diag --growth mode:1 --exact ends with the scene's theory for its own wave: Landau damping, cold and warm streams" {
	step='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'
	theory() { cycle -q -n 250 --every 2 "$step" | diag --columns time --growth "$1" --exact | tail -n 1; }
	[[ $(pinit landau --wavenumber 0.3 -n 2000 | theory mode:1) == *"; theory: gamma -0.0126203684 omega 1.15984648, of a small wave: this one traps "\
"particles before it is damped (bounce frequency 0.141)" ]]
	[[ $(pinit landau --wavenumber 0.3 --amplitude 1e-4 -n 2000 | theory mode:1) == *"; theory: gamma -0.0126203684 omega 1.15984648" ]]
	[[ $(pinit two-stream -n 2000 | theory mode:1) == *"; theory: gamma 0.353553391 omega 0" ]]
	[[ $(pinit two-stream --v0 3 --vth 1 --wavenumber 0.2 -n 8000 | theory mode:1) == *"; theory: gamma 0.284509686 omega 0" ]]
	# twice the scene's wave, of two beams in one set
	[[ $(pinit two-stream -n 2000 | theory mode:2) == \
		"# mode:2 gamma "*"; theory of the species: none (the velocities of 'electrons' are not Maxwellian"* ]]
	[[ $(pinit landau -n 2000 --mode 2 --wavenumber 0.25 | theory mode:2) == *"; theory: gamma -0.153359467 omega 1.41566189" ]]
	[[ $(pinit landau -n 2000 | cycle -q -n 100 --every 2 "$step" | diag --columns time --growth mode:1 --exact --format json | tail -n 1) == \
		*'"theory_gamma":-0.153359467,"theory_omega":1.41566189,"theory_of":"scene"}' ]]
}

@test "diag --growth mode:1 --exact: where the scene states no rate, that of the dispersion relation of the species, or none" {
	line() { diag --columns time --growth mode:1 --exact | tail -n 1; }
	theory() { line | sed -n 's/.* gamma \([^ ]*\) .* omega \([^ ,]*\),.*theory of the species: gamma \([^ ]*\) omega \(.*\)/\1 \2 \3 \4/p'; }
	step='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'
	# Buneman, M = 25, k v = 1: the root of the quartic is 0.152347043 + 0.202993092 i; measured within 1 % of its modulus
	pinit plasma --length 6.283185307179586 | smod --constant background=0 | species e -n 512 --vth 0 --drift 1 --profile '1 + 1e-4*cos(x)' |
		species i -n 512 --charge 1 --mass 25 --vth 0 >buneman
	cycle -q -t 45 --every 4 "$step" <buneman >run
	read -r gamma omega g w <<<"$(theory <run)"
	within "$g" 0.202993092 1e-6
	within "$w" 0.152347043 1e-6
	within "$gamma" "$g" 0.0025
	within "$omega" "$w" 0.0025
	cmp <(diag --growth mode:1 --exact --ranks 2 <run) <(diag --growth mode:1 --exact <run)
	# the same beam in a magnetic field across it: no theory, and why
	[[ $(scalc --mesh mesh 'B = 0, 0, 1' --role state <run | line) == \
		"# mode:1 gamma 0.2"*"; theory of the species: none (a species drifts across the magnetic field)" ]]
	# cold electrons across B: sqrt(1 + B^2), of which cic on 64 cells takes 6e-4
	pinit langmuir -n 1024 --velocities 3 --amplitude 0 --dt 0.05 | scalc --set electrons 'v = 1e-3*cos(x), 0, 0' |
		scalc --mesh mesh 'B = 0, 0, 2' --role state | cycle -q -n 400 --every 4 "${step//kick/boris}" >run
	read -r gamma omega g w <<<"$(theory <run)"
	within "$w" 2.2360679775 1e-6
	within "$omega" "$w" 0.005
}

@test "diag --growth mode:1 --exact: the rate that a scene states holds for the plasma that it made; a changed one has that of its species" {
	line() { cycle -q -n 200 --every 4 "$step" | diag --columns time --growth mode:1 --exact --window "$1" | tail -n 1; }
	# rate WINDOW "OF OMEGA": the theory's name and omega, and the omega that was measured beside it, within 1.5 %
	rate() {
		line "$1" | sed -n 's/^# mode:1 gamma .* omega \([^ ,]*\),.*; theory\( of the species\|\): gamma [^ ]* omega \([^ ]*\)$/\1 \3\2/p' >found
		read -r omega w of <found
		[ "$of" = "$2" ]
		within "$w" "$3" 1e-4
		within "$omega" "$w" "$(calc "0.015 * $w")"
	}
	step='push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2'
	pinit em-wave -n 512 --cells 32 >wave
	rate 0:20 "" 1.414213562 <wave
	# B = 3 along k: a linear wave has left and right ones, of several frequencies, and is no exponential
	scalc --mesh mesh 'B = 3, B_1, B_2' <wave | line 0:20 >found
	run ! grep -q 'theory: gamma' found
	grep -q '^# mode:1 gamma .*theory of the species: ' found
	# electrons of a tenth of the mass
	scalc --set electrons 'mass = 0.1*mass' <wave | rate 0:5 "of the species" 3.31662479
	pinit weibel -n 4096 >hot
	[[ $(line 0:10 <hot) == "# mode:1 gamma "*"; theory: gamma 0.0806303"* ]]
	scalc 'v = vx, 0.3*vy, 0.3*vz' <hot | rate 0:10 "of the species" 1.41461182
	step='push boris/2 drift | p2m | poisson-fft | mgrad | m2p | push boris/2'
	pinit bernstein -n 4000 >bernstein
	[[ $(line 0:10 <bernstein) == "# mode:1 gamma "*"; theory: gamma 0 omega 1.16387241" ]]
	scalc --mesh mesh 'B = 0, 0, 2*B_2' <bernstein | line 0:10 >found
	run ! grep -q 'theory: gamma' found
	step='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'
	while IFS=';' read -r change w; do # colder, of the density 1.21, lighter
		pinit landau -n 2000 | scalc --set electrons "$change" | rate 0:10 "of the species" "$w"
	done <<-END
		v = 0.6*v;1.15984647
		charge = 1.1*charge;1.49181591
		mass = 0.8*mass;1.50555148
	END
	# rank 0 needs the species of the first frame alone
	pinit landau -n 10000 >landau
	cycle -n 20 "$step | diag --growth mode:1 --exact --tee alone" <landau >end
	cycle -n 20 -v --ranks 2 "$step | diag --growth mode:1 --exact --tee shared" <landau 2>said >end
	cmp alone shared
	grep -q '2 ranks share: .*, diag .*; on rank 0 alone: no word' said
	pinit landau -n 2000 | scalc 'v = v + 0.2' | line 0:10 | grep -q '^# mode:1 .*theory of the species: ' # both waves shifted: no rate
	pinit landau -n 2000 | species ions -n 2000 --charge 1 --mass 4 --vth 0.1 | line 0:10 | grep -q 'theory of the species: '
}

@test "diag --modes in the open plane: the amplitude of a wave around a ring of vortices, and its growth; dissipation and energy_loss in the plane" {
	# 360 vortices at r = 1 + 0.01 cos(3 phi) about (0.2, -0.1): mode_3 is 0.01, the others are of second order
	awk 'BEGIN { OFMT = CONVFMT = "%.17g"; print "x y circulation"; for (i = 0; i < 360; i++) { p = i * atan2(0, -1) / 180; r = 1 + 0.01 * cos(3 * p)
		print 0.2 + r * cos(p), -0.1 + r * sin(p), 1 } }' | stab - --law vortex | diag --columns time --modes 2,3,4 >d
	within "$(column mode_3 <d)" 0.01 1e-8
	below "$(column mode_2 <d)" 1e-4
	# the octagon's alternating wave grows at sqrt(32) Gamma/(4 pi R^2) (VM-07); measured to 1e-6
	pinit polygon -n 8 --disturbance 1e-6 | cycle -q -n 300 --every 10 'pp | push rk4' | diag --columns time --modes 4 --growth mode:4 | tail -1 >line
	within "$(sed 's/.*gamma \([^ ]*\) .*/\1/' line)" "$(calc 'sqrt(32) / (4 * pi)')" 1e-3
	# and the scenes' own numbers stand beside what is measured, for the wave that they belong to
	pinit polygon -n 8 --disturbance 1e-6 | cycle -q -n 60 --every 2 'pp | push rk4' >frames
	for m in 3 4; do diag --columns time --growth mode:$m --exact <frames | tail -1; done >line
	[[ $(tail -1 line) == *"; theory: gamma 0.450158158 "* ]]
	[[ $(head -1 line) != *theory* ]]
	for scene in "tanh-layer --cells 32x48;0.189702026" "vortex-sheet -n 64 --cells 32;1.81379936"; do
		pinit ${scene%;*} | cycle -q -n 30 --every 1 'p2m | poisson-fft | mgrad | m2p | push rk4' | p2m | poisson-fft | mgrad >frames
		diag -q --columns time --growth mode:1 --exact <frames | tail -1 >line
		[[ $(cat line) == *"; theory: gamma ${scene#*;} "* ]]
	done
	pinit lamb-oseen --cells 64 --dt 0.05 | cycle -q -n 4 --every 1 'p2m | poisson-fft | mgrad | diffuse | m2p | push lsrk3 | remesh' |
		p2m | poisson-fft | diag -q --columns time,enstrophy,dissipation,energy_loss >d
	within "$(calc "$(column dissipation <d | head -1) / $(column enstrophy <d | head -1)")" 0.02 1e-15 # 2 nu
	# in free space the energy of a vortex is known up to a constant, and falls by 2 nu Z
	within "$(awk 'NR > 3 { print 2 * $4 / ($3 + z) } { z = $3 }' d | tail -1)" 1 2e-3
	[ "$(column energy_loss <d | head -1)" = nan ]
}
