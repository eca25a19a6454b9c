# m2p: interpolation, terms, refusals.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# given FIELD FACES ROLE X...: a frame in the box 0..4 of one axis whose mesh of 4 cells has the field 0 1 4 9 16, and particles at X, at rest, of mass 2.
given() {
	local field=$1 faces=$2 role=$3
	shift 3
	{
		echo "x vx mass"
		printf '%s 0 2\n' "$@"
	} | stab - --law gravity --box 0,4 --faces "$faces" --particle-faces open -n 4 | p2m | stab |
		sed "1s/\"name\":\"rho\",\"on\":\"mesh\",\"role\":\"derived\"/\"name\":\"$field\",\"on\":\"mesh\",\"role\":\"$role\"/" |
		awk -v f="$field" '/^#end/ { inside = 0 } inside == 2 { print i * i; i++; next } inside == 1 { print f; inside = 2; next } /^#mesh/ {
			inside = 1 } { print }' |
		stab -
}

# of FIELD: that column of the particles, one line.
of() { stab --plain | awk -v n="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == n) c = i; next } { printf "%s%s", (NR > 2 ? " " : ""), $c } END {
	print "" }'; }

@test "m2p needs no options: the law's mesh field is added to its change field as the term self" {
	sh_ok 'pinit uniform -n 50 | p2m -n 8 --kernel tsc | poisson-fft | mgrad | m2p | sls'
	[[ $output =~ acc\ +3\ f64\ change ]]
	[[ $output =~ self ]]
}

@test "m2p interpolates with the kernel the field was made with, or with --kernel" {
	given g open derived 2.25 1.5 >a
	[ "$(m2p <a | of acc)" = "5.25 2.5" ]              # cic: between 4 and 9, between 1 and 4
	[ "$(m2p --kernel tsc <a | of acc)" = "5.3125 2.5" ] # x^2 + 1/4
	[ "$(m2p --kernel ngp <a | of acc)" = "4 4" ]
}

# One particle between the nodes of a periodic box, mass 1: any acceleration is its own.
alone() { printf 'x y z vx vy vz mass\n0.31 0.47 0.52 0 0 0 1\n' | stab - --law gravity --box 0,1 --faces periodic; }

# Round-off of the field of one particle: 7e-15 measured. With another kernel on the way back it is 1 to 3.
@test "m2p: a particle does not accelerate itself through fields that scalc and smod have remade, for any kernel, interlaced or not" {
	local words a
	for words in '' '--kernel tsc' '--kernel pcs' '--kernel m4prime' '--kernel tsc --interlace'; do
		alone | p2m -n 16 $words | scalc --mesh mesh 'src = 2*rho - 1' | smod --rename src=density | poisson-fft --source density | mgrad --target f |
			scalc --mesh mesh 'g = f.x, f.y, f.z' | m2p >a
		for a in $(of acc_0 <a) $(of acc_1 <a) $(of acc_2 <a); do
			below "$a" 1e-12 "p2m $words"
		done
	done
	alone | p2m -n 16 --kernel pcs --interlace | scalc --mesh mesh --type f32 'src = rho' | smod --store src=f64 >a
	sh_ok 'sls <a'
	[[ $output =~ src\ +1\ f64\ derived\ value\ kernel\ pcs\ interlaced ]]
}

@test "m2p refuses a field made of fields with different kernels by its name, and takes it with --kernel" {
	alone | p2m -n 16 --kernel tsc | p2m --kernel cic --field coarse >two
	scalc --mesh mesh 'src = rho + coarse' 'plain = 2*x' 'own = rho + plain' <two >mixed
	sh_ok 'sls <mixed'
	[[ $output =~ src\ .*kernel\ several ]]
	[[ $output =~ own\ .*kernel\ tsc ]] # a field without a kernel does not count
	[[ ! $output =~ plain\ [^$'\n']*kernel ]]
	poisson-fft --source src <mixed | mgrad >force
	run -1 bash -c 'm2p <force >none'
	[ "$output" = "m2p: frame 1: 'g' on 'mesh' comes from fields made with different kernels (choose one: m2p --kernel)" ]
	sh_ok 'm2p --kernel tsc <force >taken'
	run -1 bash -c 'poisson-fft --source src --influence optimal <mixed >none'
	[[ $output =~ "'src' on 'mesh' comes from fields made with different kernels, and --influence optimal corrects for one" ]]
	alone | p2m -n 16 --kernel cic | p2m --kernel cic --interlace --field coarse | scalc --mesh mesh 'src = rho - coarse' >mixed
	sh_ok 'sls <mixed'
	[[ $output =~ src\ .*kernel\ several$'\n' ]]
}

@test "m2p refuses a change on the mesh made with another kernel than the flow, which is gathered with it" {
	pinit lamb-oseen --nu 0.01 --cells 16 | p2m --kernel tsc | diffuse | p2m --kernel m6prime | poisson-fft | mgrad >a
	run -1 bash -c 'm2p <a >none'
	[[ $output =~ "'domega' on 'mesh' was made with the kernel tsc, what is gathered with it with m6prime (choose one: m2p --kernel)" ]]
	sh_ok 'm2p --kernel m6prime <a >b'
}

@test "m2p: a given field is the term external, and the same term twice is refused unless --replace" {
	given g open state 2.25 >a
	m2p <a >b
	[ "$(of acc <b)" = 5.25 ]
	sh_ok 'sls <b'
	[[ $output =~ external ]]
	run -1 bash -c 'm2p <b'
	[[ $output =~ "already holds the term 'external'" ]]
	same_as <(m2p --replace --no-history <b) b
}

@test "m2p without its mesh field names the words that make it" {
	pinit uniform -n 5 | p2m -n 4 >a
	run -1 m2p <a
	[[ $output =~ "m2p: frame 1: no field 'g' on mesh 'mesh' (run poisson-fft | mgrad first)" ]]
	run -1 m2p --field phi <a
	[[ $output =~ "(run poisson-fft first)" ]]
	run -1 bash -c 'pinit uniform -n 5 | m2p'
	[[ $output =~ "no field 'g' on mesh 'mesh' (run p2m | poisson-fft | mgrad first)" ]]
	run -1 bash -c 'pinit uniform -n 5 | m2p --field rho'
	[[ $output =~ "(run p2m first)" ]]
	printf 'x mass\n1.25 2\n' | stab - --law free --box 0,4 -n 8 >b
	run -1 m2p <b
	[[ $output =~ "choose a field with --field" ]]
}

@test "m2p --field gathers any mesh field to a derived particle field, also where nothing moves" {
	given heat open derived 2.25 1.5 >a
	[ "$(m2p --field heat <a | of heat)" = "5.25 2.5" ]
	sh_ok 'm2p --field heat <a | sls'
	[[ $output =~ heat\ +1\ f64\ derived && ! $output =~ acc ]]
}

@test "m2p onto a strength multiplies by the volume and is refused without one" {
	given mass open derived 2.25 1.5 >a
	run -1 m2p --field mass <a
	[[ $output =~ "'mass' on 'matter' is a strength" ]]
	volume='{"components":1,"kind":"value","name":"volume","on":"matter","role":"state","type":"f64","uniform":[0.5],"unit":""}'
	stab <a | sed '1s/{"components":1,"kind":"strength","name":"mass"/'"$volume"',&/' |
		stab - >b
	[ "$(m2p --field mass <b | of mass)" = "2.625 1.25" ]
}

@test "m2p: at a wall the gradient's normal component has an even image, a scalar an odd one" {
	given g wall derived 0.25 3.75 >a
	[ "$(m2p <a | of acc)" = "0.25 14.25" ] # 0 and 1; 9 and 16
	[ "$(m2p --kernel tsc <a | of acc)" = "0.3125 13.8125" ] # 1(0.03125+0.28125) and 9(0.28125+0.03125)+16(0.6875)
	given phi wall derived 0.25 3.75 >b
	[ "$(m2p --field phi --kernel tsc <b | of phi)" = "0.25 2.25" ] # 1(0.28125-0.03125); 9(0.28125-0.03125), the end node is 0
}

@test "m2p: a given field has the same values on both sides of any face, in one dimension and along a wall in two" {
	for faces in wall neumann wall,neumann; do
		given g $faces state 0.25 3.75 >a
		[ "$(m2p --kernel tsc <a | of acc)" = "0.3125 13.8125" ] # as above: 0 at the wall and 1 on both sides; 16, and 9 on both sides
	done
	# a uniform field is itself anywhere, its component along a wall too
	printf 'x y mass charge\n0.1 0.5 1 1\n0.5 0.01 1 1\n0 0.99 1 1\n0.3 0.4 1 1\n' >t
	for case in 'wall 4' 'neumann 4' 'open,wall 2'; do # two of them are too near the open face for pcs
		read -r faces held <<<"$case"
		stab t --law electrostatic --box 0,1 --faces "$faces" --particle-faces open --strength mass,charge -n 8 | scalc 'v = 0, 0' --role state |
			scalc --mesh mesh 'E = 0.5, -0.25' --role state | m2p --kernel pcs --outside drop | stab --plain |
			awk -v held="$held" 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } $c["acc_0"] != 0 { n++
				if (($c["acc_0"] - 0.5)^2 + ($c["acc_1"] + 0.25)^2 > 1e-30) exit 1 } END { exit n != held }'
	done
}

@test "m2p interpolates components that are staggered by half a cell" {
	given g periodic derived 2.25 | stab | sed '1s/"kernel":"cic",/&"half":[[1,0,0]],/' | stab - >a
	[ "$(m2p <a | of acc)" = 3.25 ] # values 0 1 4 9 at 0.5 1.5 2.5 3.5: a quarter below 2.5
}

@test "m2p names a particle outside the mesh of a given field, or leaves it out and counts it" {
	given g open state 2.25 7 >a
	run -1 m2p <a
	[[ $output =~ "particle 1 of 'matter' at (7) is outside mesh 'mesh'" ]]
	[ "$(m2p --outside drop <a | of acc)" = "5.25 0" ]
	sh_ok 'm2p --outside drop <a | sls --report'
	[[ $output =~ dropped.*1 ]]
}

@test "m2p skips sets without the state that the law changes, and reports it if there is no other" {
	given g open derived 2.25 | stab | sed '1s/"name":"v"/"name":"w"/; s/^x\tvx/x\tw/' | stab - >a
	run -1 m2p <a
	[[ $output =~ "no field 'v' on 'matter'" ]]
}

@test "HC-59: m2p of no particles exits 0" {
	printf 'x vx mass\n' | stab - --law gravity --box 0,4 --faces periodic -n 4 | p2m | poisson-fft | mgrad >a
	sh_ok 'm2p <a | sls'
	[[ $output =~ acc ]]
}

@test "m2p gives the same bytes with 1, 2 and 3 threads, and after other frames" {
	pinit uniform -n 30000 --seed 3 | p2m -n 33x20x18 --kernel pcs | poisson-fft | mgrad >a
	pinit uniform -n 500 --seed 4 | p2m -n 7 | poisson-fft | mgrad >b
	for threads in 1 2 3; do
		m2p --threads $threads <a | cksum >sum.$threads
	done
	same_as sum.1 sum.2
	same_as sum.1 sum.3
	cat b a b a | m2p >several
	cat <(m2p <b) <(m2p <a) <(m2p <b) <(m2p <a) >single
	same_as several single
}

@test "m2p --mask: polynomials up to the kernel's degree come back exactly beside a body, at walls, neumann and open faces (000:S58)" {
	body='(x-0.5)^2 + (y-0.5)^2 < 0.04'
	awk 'BEGIN { srand(5); print "x y q"; print 0, 0, 1; print 1, 0.3, 1; print 0.02, 1, 1
		for (i = 0; i < 400; i++) { x = rand(); y = rand(); if ((x - 0.5)^2 + (y - 0.5)^2 > 0.04) print x, y, 1 } }' >t
	for faces in wall neumann open; do
		stab t --strength q --box 0,1 -n 24 --faces $faces --particle-faces open >a
		for row in 'm4prime f=1+3*x-2*y+x*x-2*x*y' 'm6prime f=1+x*x*y*y-y^4+x^3' 'cic f=2-x+4*y'; do
			scalc --mesh mesh "${row#* } + 1e6*($body)" <a | m2p --kernel "${row% *}" --field f --mask "$body" | scalc "d=abs(f-(${row#* f=}))" |
				stab --plain | column d | sort -g | tail -1 >most
			below "$(cat most)" 2e-14 "$faces $row"
		done
	done
	run -1 --separate-stderr bash -o pipefail -c "printf 'x y\n0.5 1.1\n' | stab - --box 0,1 -n 24 | scalc --mesh mesh 'f=x' | m2p --field f --mask 0"
	[[ $stderr == *"particle 0 of 'matter' is beyond the mesh, or deeper in a body than 16 cells"* ]]
	run -2 m2p --mask 0 --outside drop <a
}

# energy MOVE: of the field on the mesh, with particle 3 moved along x, y or z.
field_energy() { scalc --set matter "$1" <a | p2m --kernel "$kernel" | poisson-fft | diag --columns energy_field_mesh | sed 1d; }

@test "m2p --energy-conserving: the force is minus the derivative of the mesh's energy, all kernels, faces and dimensions, both laws" {
	while read -r dim faces kernel law; do
		particles=reflect
		[ "$faces" != periodic ] || particles=periodic
		pinit uniform --dim "$dim" -n 20 --cells 8 --faces "$faces" --particle-faces $particles --seed 5 | smod --law "$law" |
			scalc --extensive 'charge = mod(id, 3) - 0.5' --role state >a
		p2m --kernel "$kernel" <a | poisson-fft | m2p --energy-conserving | stab --plain --set matter >t
		for axis in $(seq 0 $((dim - 1))); do
			c=$(cut -c $((axis + 1)) <<<xyz)
			list=$(for k in $(seq 0 $((dim - 1))); do
				[ "$k" != "$axis" ] && echo -n "$(cut -c $((k + 1)) <<<xyz), " || echo -n "$c + SIGN*(id == 3)*1e-5, "
			done)
			up=$(field_energy "x = $(sed 's/SIGN/1/; s/, $//' <<<"$list")")
			down=$(field_energy "x = $(sed 's/SIGN/-1/; s/, $//' <<<"$list")")
			got=$( (column "acc_$axis" <t || column acc <t) | sed -n 4p)
			# a step of 1e-5 leaves rounding 1e-16 E/1e-5 and, with cubic pieces, 1e-10 of the third derivative
			within "$got" "$(calc "-($up - ($down)) / 2e-5 * 20")" "$(calc "1e-6 * (1 + ($got) * ($got))")" "$dim-D $faces $kernel $law $c"
		done
	done <<-'END'
		1 periodic cic electrostatic
		1 wall cic electrostatic
		2 periodic tsc electrostatic
		2 neumann cic gravity
		3 periodic pcs gravity
		3 wall tsc electrostatic
		2 periodic m6prime electrostatic
	END
}

@test "m2p --energy-conserving: energy is kept to an order of dt, ten times better than by mgrad, where the Debye length is a tenth of a cell" {
	hot() { # LENGTH DT STEPS FORCE: relative change of the energy
		pinit plasma --length 640 --dt "$1" | species electrons -n 4096 --loading random |
			cycle -q -n "$2" --every "$2" "push kick/2 drift | p2m | poisson-fft | $3 | push kick/2" | p2m | poisson-fft | diag --columns energy |
			awk 'NR == 2 { a = $1 } NR == 3 { printf "%.9g", $1 / a - 1 }'
	}
	below "$(hot 0.05 2000 'm2p --energy-conserving')" 1e-3 # measured 5e-4; 1.6e-3 and 3e-3 at dt = 0.1 and 0.2
	above "$(hot 0.05 2000 'mgrad | m2p')" 0.01
}

@test "m2p --energy-conserving: what it cannot do is refused, and bytes do not depend on threads" {
	run -2 --separate-stderr bash -c "pinit uniform --dim 2 -n 9 --cells 8 | p2m --kernel ngp | poisson-fft | m2p --energy-conserving"
	[[ $stderr == *"ngp has no gradient"* ]]
	run -1 --separate-stderr bash -c "pinit uniform -n 9 --cells 8 | p2m | m2p --energy-conserving"
	[[ $stderr == *"no potential 'phi' on the mesh (run "*"poisson-fft first"* ]]
	run -1 --separate-stderr bash -c "pinit lamb-oseen --cells 16 | p2m --kernel cic | poisson-fft | m2p --energy-conserving"
	[[ $stderr == *"the law 'vortex' has no potential whose gradient is a force"* ]]
	run -2 --separate-stderr m2p --energy-conserving --changes
	for t in 1 3; do
		pinit uniform -n 9000 --cells 8 | smod --faces periodic --particle-faces periodic | p2m | poisson-fft |
			m2p --energy-conserving --threads $t --no-history >$t
	done
	same_as 1 3
}

# light DT KERNEL FORCE UNTIL CELLS: the energy of electrons at random places and of their light, whose Debye length is a tenth of a cell, over that at first.
light() {
	pinit em-wave --dim 2 --length "$(calc "0.2 * $5")" --cells "$5" --wave-field 0 | smod --constant background=1 --rename electrons=none --dt "$1" |
		species electrons -n $(($5 * $5 * 64)) --vth 0.02 --loading random --velocities 3 | p2m --kernel "$2" | maxwell --gauss |
		cycle -q -t "$4" --every-time "$4" "push boris/2 | p2m --current --kernel $2 | maxwell | push drift | $3 --kernel $2 | push boris/2" |
		diag --columns energy | awk 'NR == 2 { a = $1 } END { printf "%.9g", $1 / a }'
}

@test "m2p --energy-conserving of E and B: the energy of charges and light is kept to second order of the step, where the Debye length is a tenth of a cell" {
	local errors=() dt
	for dt in 0.1 0.05 0.025; do errors+=("$dt" "$(calc "1 - $(light $dt tsc 'm2p --energy-conserving' 10 16)")"); done
	order 2 "${errors[@]}"
	above "$(calc "1 - $(light 0.025 tsc m2p 10 16)")" 0.002 # does not fall with the step
	below "$(calc "sqrt(($(light 0.1 cic 'm2p --energy-conserving' 10 16) - 1)^2)")" 2e-3
}

@test "m2p --energy-conserving of E and B: refused on the nodes and for kernels that are no splines; by pipes, ranks and threads the same bytes" {
	pinit em-wave --dim 2 --cells 16 -n 2916 | p2m | maxwell --gauss >a
	run -2 --separate-stderr m2p --kernel m6prime --energy-conserving a
	[[ $stderr == *"m6prime (of E and B: cic, tsc, pcs)"* ]]
	run -1 --separate-stderr bash -c "sel --drop E,B <a | p2m | maxwell --gauss --method psatd --nodal | m2p --energy-conserving"
	[[ $stderr == *"'E' is on the nodes of 'mesh'"* ]]
	for how in "--threads 1" "--threads 3" "--ranks 2"; do m2p --no-history $how --energy-conserving a >"m$how"; done
	same_as "m--threads 1" "m--threads 3" "m--ranks 2"
	m2p --no-history a >plain
	above "$(scmp --tolerance 1 --field acc plain "m--threads 1" | tail -n 1 | cut -f 5)" 1e-6
}

@test "m2p: no sum of zeros is -0, few particles or many, one component or several" {
	local n what
	for n in 3 9000; do
		for what in "q = -(0*rho)" "q = -(0*rho), -(0*rho), -(0*rho)"; do
			for dim in 1 2 3; do
				pinit uniform --dim $dim -n $n --cells 8 | p2m --kernel cic | scalc --mesh mesh "$what" | m2p --kernel cic --field q |
					stab --plain >table
				[ "$(wc -l <table)" = $((n + 1)) ]
				run -1 grep -q -- '-0$' table
			done
		done
	done
}
