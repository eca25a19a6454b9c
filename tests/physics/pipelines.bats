# Every pipeline prints its numbers, and they are what its head says. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

@test "PM-09: pm-plummer keeps momentum to 1e-12 and energy, and leaves a picture" {
	pipeline pm-plummer 9
	[ "$(head -c 8 pm-plummer.png | od -An -tx1 | tr -d ' ')" = 89504e470d0a1a0a ]
	[ "$(ls)" = pm-plummer.png ]
}

@test "pm-two-body: a circle on the mesh, and by direct summation with the exact lag of the leapfrog" {
	pipeline pm-two-body 10
	[ -z "$(ls)" ]
}

@test "PM-06: pm-cold-collapse follows cosh(t) to the crossing, and cos(k dx/2) on every mesh" {
	pipeline pm-cold-collapse 6
}

@test "PM-10: pp-kepler ends where the same schemes end, to 1e-6" {
	pipeline pp-kepler 10
}

@test "solar-system: periods and energy over 1000 years, by leapfrog and with one word swapped" {
	pipeline solar-system 14
}

@test "a pipeline with a wrong number reports it and exits 1" {
	sed 's/-1.889015833 1e-6/-1.889016833 1e-7/' "$top/pipelines/pp-kepler.sh" > pp-kepler.sh
	cp "$top/pipelines/numbers.sh" .
	PM_BIN=${PM_BIN:-$top/bin} run -1 bash pp-kepler.sh
	[[ $output == *OFF* ]]
}

@test "PIC-07: pic-langmuir oscillates at the frequency of its words, one word swapped at another" {
	pipeline pic-langmuir 8
}

@test "PIC-02, PIC-03: pic-two-stream grows within 2 % of theory, not beyond the thresholds, and with one word swapped" {
	pipeline pic-two-stream 10
}

@test "PIC-01: pic-landau is damped as Landau found, to 1.5 %, at four wavenumbers by one rule, and with one word swapped" {
	pipeline pic-landau 16
}

@test "PIC-12: pic-gyration turns by 2 atan(Omega dt/2) on the right circle and keeps its speed" {
	pipeline pic-gyration 18
}

@test "PIC-12: pic-exb drifts at exactly E x B/B^2" {
	pipeline pic-exb 16
}

@test "sweep-steps: GNU parallel runs six orbits, and the errors fall with the order of the scheme" {
	command -v parallel >/dev/null || skip "GNU parallel is not there (apt-get install parallel)"
	pipeline sweep-steps 4
	[ -z "$(ls)" ]
}

@test "study.mk: make runs a study of order 2, does nothing the second time, and after a change what follows from it" {
	unset MAKEFLAGS # make -s check would silence what is read here
	run -0 make -s -f "$top/pipelines/study.mk" DIR=study
	for e in 0.2 0.4; do
		for n in 160 320; do
			within "$(awk -v e=$e -v n=$n '$1 == e && $2 == n { print $4 }' study/table.tsv)" 2 0.05 "order at eccentricity $e, $n steps"
		done
	done
	run -0 make -f "$top/pipelines/study.mk" DIR=study
	[[ $output == *"is up to date"* ]]
	touch study/ellipse-0.4-80.pm
	run -0 make -f "$top/pipelines/study.mk" DIR=study
	[ "$(grep -c '^cycle -n' <<<"$output")" = 1 ]
}
