# Plasmas of several species: growth rates against the dispersion relation. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper
export OMP_NUM_THREADS=1 # small meshes

step='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'
rates() { sed -n 's/^# .* gamma \([^ ]*\) .* omega \([^,]*\),.*/\1 \2/p'; }

@test "PIC-04: a bump on the tail, core and bump as two species, grows at the rate of their dispersion relation" {
	pinit plasma --length 20.943951023931955 --cells 128 | species core -n 60000 --profile '0.9*(1 + 0.001*cos(0.3*x))' |
		species bump -n 40000 --profile '0.1*(1 + 0.001*cos(0.3*x))' --vth 0.5 --drift 4.5 | cycle -q -n 300 --every 3 "$step" |
		diag --columns time --growth mode:1 | rates >r
	read -r gamma omega <r
	within "$gamma" 0.198097975843025 0.006 # 3 %: the noise of a quiet start of 1e5 at 2 % of the wave
	within "$omega" 1.00121789363112 0.01
}

@test "PIC-05: electrons through ions of mass 25, 100 and 1836 grow at Buneman's rate and frequency" {
	while read -r mass k steps gamma omega; do
		pinit plasma --length "$(calc "2 * pi / $k")" --background 0 | species electrons -n 640 --vth 0 --drift 1 |
			species ions -n 640 --vth 0 --charge 1 --mass "$mass" | scalc --set ions 'x = (id - 639.5)*Lx/n' |
			scalc --set electrons 'x = mod((id + 0.5)*Lx/n + 1e-4*sin(2*pi*(id + 0.5)/n), Lx)' |
			cycle -q -n "$steps" --every 4 "$step" | diag --columns time --growth mode:1 | rates >r
		read -r got frequency <r
		within "$got" "$gamma" "$(calc "0.01 * $gamma")" "mass $mass" # cos(k h/2) of the mesh is 0.1 %, the step 0.04 %, the window the rest
		within "$frequency" "$omega" "$(calc "0.02 * $omega")" "frequency, mass $mass" # over a quarter of a turn for ions of 1836
	done <<-'END'
		25 1 600 0.20299309 0.15234704
		100 1 800 0.13539782 0.09237309
		1836.15267343 1.006166 1400 0.05437200 0.03558870
	END
}

@test "docs/methods/electrostatic.md: electrons in two steps of dt/2 to one of the ions are as exact as plain steps of dt/2, with order 2" {
	sed -n "/^    cycle -n 60 'push --set ions/,/^\$/p" "$top/docs/methods/electrostatic.md" | tr -d '\n' | sed "s/^ *cycle -n 60 '//; s/'\$//" >sentence
	pinit plasma --background 0 | species electrons -n 4000 --profile '1 + 0.1*cos(x/2)' | species ions -n 4000 --charge 1 --mass 100 --vth 0.01 >a
	run_with() { smod --dt "$1" <a | cycle -q -n "$(calc "6 / $1")" "${2:-$step}" | sel --set electrons --field x,v >b; }
	run_with 0.0125
	mv b reference
	for dt in 0.4 0.2 0.1; do
		run_with $dt "$(cat sentence)"
		scmp --field v b reference >c || true
		column l2 <c >sub$dt
	done
	run_with 0.1
	scmp --field v b reference >c || true
	order 2 0.4 "$(cat sub0.4)" 0.2 "$(cat sub0.2)" 0.1 "$(cat sub0.1)"
	within "$(cat sub0.2)" "$(column l2 <c)" "$(calc "0.1 * $(column l2 <c)")" # electrons see the same steps
}
