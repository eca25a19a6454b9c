# Orbits of the scenes against the reference. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# errors TABLE: the energy error of every row against the exact one.
errors() { awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { printf "%.17g\n", $c["energy"] / $c["exact_energy"] - 1 }' "$1"; }

# kepler ORBITS STEPS SENTENCE: the body at the end as "x y" (centre of body and sun, times two).
kepler() {
	export OMP_NUM_THREADS=1
	pinit kepler --dt "$(awk -v n="$2" 'BEGIN { printf "%.17g", 8 * atan2(1, 1) / n }')" |
		cycle -n $(($1 * $2)) "$3" |
		diag --pair --exact > end
	awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { printf "%.17g %.17g\n", 2 * $c["centre_x"], 2 * $c["centre_y"] }' end
}

# 10 orbits and the other schemes: kepler.bats.
@test "PM-10: leapfrog, 1 orbit of 1000 steps, ends where the same scheme ends" {
	read -r x y <<<"$(kepler 1 1000 'push kick/2 drift | pp | push kick/2')"
	within "$x" -1.899890053 1e-8
	within "$y" 0.02043960759 1e-8
	below "$(errors end)" 1e-11 # 7.4e-13, by rounding
}

@test "HC-17: over 100 orbits of e = 0.9 the energy at the apocentre is constant to 1e-8 without a trend, and the pericentre rotates uniformly" {
	orbits=100
	[ -z "${PM_LONG:-}" ] || orbits=1000
	sh_ok "export OMP_NUM_THREADS=1; pinit kepler | cycle -n $((1000 * orbits)) --every 1000 'push kick/2 drift | pp | push kick/2' |
		diag --pair --exact > t"
	[ "$(wc -l < t)" = $((orbits + 2)) ]
	# largest error, and the ratio of its means in the last and first tenth, which a trend would increase
	errors t | awk -v n=$orbits '{ d = $1 < 0 ? -$1 : $1; if (d > m) m = d } NR <= n / 2 { a += $1 } NR > n / 2 { b += $1 } END { d = (b - a) / (n / 2);
		if (d < 0) d = -d; exit !(m < 1e-8 && d < m) }'
	# -1.0773e-2 rad an orbit, 1 %, from the Laplace vector of the last frame
	turn=$(awk -F'\t' -v n=$orbits 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
		{ x = 2 * $c["centre_x"]; y = 2 * $c["centre_y"]; vx = $c["momentum_x"]; vy = $c["momentum_y"]; l = x * vy - y * vx; r = sqrt(x * x + y * y)
		  a = atan2(-vx * l - y / r, vy * l - x / r); if (NR > 2) { d = a - last; pi = atan2(0, -1); d -= d > pi ? 2 * pi : d < -pi ? -2 * pi : 0;
		  	sum += d } last = a }
		END { printf "%.17g", sum / n }' t)
	within "$turn" -1.0773e-2 1.1e-4
}

@test "two bodies return after a period, with an error that falls as dt^2" {
	errors=()
	for k in 200 400 800; do
		sh_ok "pinit two-body --eccentricity 0.3 --ratio 3 --dt $(awk \
			"BEGIN { printf \"%.17g\", 8 * atan2(1, 1) / $k }") | cycle -n $k 'push kick/2 drift | pp | push kick/2' |
			stab --plain > t"
		errors+=("$k" "$(awk 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { x[NR] = $c["x"]; y[NR] = $c["y"] } END { dx = x[3] - x[2] + 1.3;
			dy = y[3] - y[2]; print 1 / sqrt(dx * dx + dy * dy) }' t)")
	done
	order 2 "${errors[@]}" # the inverse of the error against the number of steps
}

@test "a uniform box with a Maxwellian has the temperature given" {
	sh_ok "pinit uniform -n 20000 --dispersion 0.3 | diag --exact > t"
	# variance of the kinetic energy of 60000 components: sqrt(2/60000) = 0.6 %; three of them
	within "$(column energy_kinetic < t)" "$(column exact_energy_kinetic < t)" "$(awk -v e="$(column exact_energy_kinetic < t)" \
		'BEGIN { print 0.018 * e }')"
}

@test "HC-15: a cold lattice is at rest at the start, and every spacing of whole cells fills its box" {
	for o in "--spacing 2 -n 5832" "--spacing 3 -n 512" "--spacing 1.5 -n 5832" "--spacing 2 --dim 1 -n 18" "--spacing 1 --dim 2 -n 49"; do
		sh_ok "pinit lattice $o | diag --exact --columns mass,speed_rms > t"
		within "$(column mass < t)" "$(column exact_mass < t)" 1e-9
		[ "$(column speed_rms < t)" = 0 ]
	done
}

# The laws' plain sentences.
gravity='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' orbit='push kick/2 drift | pp | push kick/2'
magnetic='push boris/2 drift | m2p | push boris/2' across='push boris/2 drift | p2m | poisson-fft | mgrad | m2p | push boris/2'
vorticity='p2m | poisson-fft | mgrad | diffuse | m2p | push lsrk3 | remesh' points='pp | push lsrk3'
space='p2m | poisson-fft | mgrad | stretch | diffuse | m2p | push lsrk3 | remesh'
turn="field 'vel = -2*pi*(y - 0.5), 2*pi*(x - 0.5)' | push rk4 | remesh --by volume"
swirl="field 'vel = -sin(pi*x)^2*sin(2*pi*y), sin(pi*y)^2*sin(2*pi*x)' | push rk4 | remesh --by volume"
light='push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2'

@test "every scene of pinit --help, typed bare, has the exact values of its page after some steps of its law's plain sentence" {
	# scene, steps, sentence, the rest of the line, and columns with the difference allowed, relative to the exact value or 1e-3. Orbits: (omega dt)^2 of
	# the leapfrog. Meshes: (h/scale)^2 of the kernel. plummer: 1/sqrt(n) of its random numbers. Vortices: the cut-off of remesh, and time steps of order 3.
	local row scene steps sentence rest columns name tolerance
	export OMP_NUM_THREADS=1 # small
	while IFS=';' read -r scene steps sentence rest columns; do
		sh_ok "pinit $scene | cycle -n $steps \"${!sentence}\" $rest > t"
		for row in $columns; do
			name=${row%=*} tolerance=${row#*=}
			awk -F'\t' -v name="$name" -v tol="$tolerance" 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
				{ got = $c[name]; want = $c["exact_" name]; d = got - want; d = d < 0 ? -d : d; w = want < 0 ? -want : want
				if (!c["exact_" name] || !(d <= tol * (w > 1e-3 ? w : 1e-3))) { print name " " got ", want " want; exit 1 } }' t ||
				{ echo "$scene"; return 1; }
		done
		echo "${scene%% *}" >> done
	done <<-END
		cold-collapse;40;gravity;| diag --exact;mass=1e-12 speed_rms=2e-3 energy_kinetic=4e-3
		cold-sphere;20;gravity;| diag --exact;mass=1e-12 energy_kinetic=0.01 energy=0.01
		plummer;20;gravity;| diag --exact;mass=1e-12 energy_kinetic=0.02 virial_ratio=0.06
		kepler;100;orbit;| diag --pair --exact;energy=1e-6 energy_kinetic=1e-5 angular_momentum_z=1e-12
		two-body;100;orbit;| diag --pair --exact;energy=1e-6 energy_kinetic=2e-3 angular_momentum_z=1e-12
		lattice;10;gravity;| diag --exact;mass=1e-12 speed_rms=1e-9
		uniform;10;gravity;| diag --exact;mass=1e-12
		pair;1;gravity;| diag --exact;mass=1e-12
		langmuir;10;gravity;| diag --exact;charge=1e-12 speed_rms=4e-3 energy_kinetic=8e-3
		two-stream;10;gravity;| diag --exact;mass=1e-12 charge=1e-12
		ionic-chain;10;gravity;| diag --exact;mass=1e-12 charge=1e-12 speed_rms=1e-9 energy_kinetic=1e-12
		plasma | species electrons -n 100;1;gravity;| diag;
		sheath;1;gravity;| diag;
		landau;10;gravity;| diag --exact;mass=1e-11 charge=1e-11
		bernstein;10;across;| diag --exact;mass=1e-12 charge=1e-12
		gyration;50;magnetic;| diag --exact;energy_kinetic=1e-12 centre_x=2e-3 centre_y=2e-3
		exb;50;magnetic;| diag --exact;energy_kinetic=4e-3 momentum_x=2e-3
		lamb-oseen;5;vorticity;| p2m | diag --exact;circulation=1e-5 angular_impulse=1e-3 enstrophy=1e-3 palinstrophy=2e-3 omega_max=1e-3
		taylor-green-2d;5;vorticity;| p2m | diag --exact;circulation=1e-9 enstrophy=1e-4 palinstrophy=1e-4 omega_max=1e-4
		shear-layer;2;vorticity;| p2m | diag --exact;circulation=1e-9
		ellipse;2;vorticity;| p2m | diag --exact;circulation=1e-6
		cone-vortex;2;vorticity;| p2m | diag --exact;circulation=1e-4 angular_impulse=1e-3 enstrophy=1e-3 omega_max=0.01
		point-vortices;2;points;| diag;
		polygon;10;points;| diag --exact;circulation=1e-12 angular_impulse=1e-9
		vortex-sheet;10;points;| diag --exact;circulation=1e-12
		vortex-pair;10;points;| diag --exact;circulation=1e-12 impulse_x=1e-9 impulse_y=1e-9
		taylor-green-3d;2;space;| p2m | diag --exact;alpha_x=1e-9 alpha_y=1e-9 alpha_z=1e-9
		vortex-tube;2;space;| p2m | diag --exact;alpha_x=1e-9 alpha_y=1e-9 alpha_z=1e-6
		trefoil;1;space;| p2m | diag --exact;alpha_x=0.01 alpha_y=0.01 alpha_z=0.01 impulse_z=1e-4
		vortex-ring;2;space;| p2m | diag --exact;ring_circulation=1e-4 ring_radius=1e-4 ring_position=0.03 impulse_z=1e-4
		lamb-dipole;2;vorticity;| p2m | diag --exact;circulation=1e-9 impulse_x=1e-3 angular_impulse=1e-9 enstrophy=1e-3 omega_max=0.03
		cylinder;2;vorticity;| p2m | diag --exact;circulation=1e-12
		sphere;2;space;| p2m | diag --exact;alpha_x=1e-12 alpha_y=1e-12 alpha_z=1e-12
		cavity;2;vorticity;| p2m | diag --exact;circulation=1e-12
		zalesak;2;turn;| diag --exact;level_inside=0.01
		single-vortex;2;swirl;| diag --exact;level_inside=1e-3
		vortex-rings;2;space;| p2m | diag --exact;alpha_x=1e-9 alpha_y=1e-9 alpha_z=1e-9 impulse_z=1e-4
		tanh-layer;2;vorticity;| p2m | diag --exact;circulation=1e-6
		vortex-merger;2;vorticity;| p2m | diag --exact;circulation=1e-5 impulse_x=1e-9 impulse_y=1e-9 angular_impulse=1e-3
		random-vorticity;2;vorticity;| p2m | diag --exact;circulation=1e-9
		em-wave;10;light;| diag --exact;mass=1e-12 charge=1e-12
		wakefield;2;light;| diag;
		whistler;10;light;| diag --exact;mass=1e-12 charge=1e-12
		weibel;10;light;| diag --exact;mass=1e-12 charge=1e-12
		gem;10;light;| diag --exact;mass=1e-12 charge=1e-12
	END
	pinit --help | awk '/^The scenes:/ { on = 1; next } !NF { on = 0 } on { print $1 }' | sort > all
	sort done | diff all -
}

# growth SCENE STEPS: "gamma +- error omega" of the first mode, as bare as it can be typed; diag's line is left in t.
growth() {
	pinit $1 | cycle -n "$2" --every 2 "$gravity" | diag --columns time --growth mode:1 | tail -n 1 > t
	sed -n 's/^# mode:1 gamma \([^ ]*\) +- \([^ ]*\) omega \([^ ,]*\),.*/\1 \2 \3/p' t
}

@test "PIC-01, 02, 03: landau, two-stream and langmuir meet theory at their defaults: rates within 2 %, frequencies within 0.3 %" {
	local gamma error omega
	export OMP_NUM_THREADS=1
	while read -r want frequency steps scene; do
		read -r gamma error omega <<<"$(growth "$scene" "$steps")"
		within "$gamma" "$want" "$(awk -v w="$want" 'BEGIN { print w ? 0.02 * (w < 0 ? -w : w) : 1e-5 }')" "gamma of $scene"
		within "$omega" "$frequency" "$(awk -v w="$frequency" 'BEGIN { print 0.003 * w }')" "omega of $scene"
		below "$error" 0.005 "error of $scene"
	done <<-END
		-0.153359466909605 1.41566188860454 300 landau
		-0.851330458692056 2.04590486569062 100 landau --wavenumber 1
		0.353553390593274 0 300 two-stream
		0.256405640402469 0 400 two-stream --v0 0.3
		0.16201 0 600 two-stream --v0 2 --vth 1 --wavenumber 0.2
		0.284509686204960 0 400 two-stream --v0 3 --vth 1 --wavenumber 0.2
		0 0.999217 300 langmuir
	END
}

@test "landau of 2000 particles at random has no damping rate, and diag says why; nor has a plasma without a wave" {
	export OMP_NUM_THREADS=1
	for scene in "landau -n 2000 --loading random" "landau -n 2000 --loading random --seed 2" "landau --loading random --amplitude 0"; do
		growth "$scene" 300
		grep -q '^# mode:1 gamma nan +- nan omega nan, none of 151 points: ' t || { echo "$scene: $(cat t)"; return 1; }
	done
}
