# Collapse of cold matter: a plane wave (PM-06), and a sphere (PM-08). SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# kA CELLS DT T [options of pinit]: k A after every step, one a line, on a mesh with the 2-point gradient and its Laplacian.
kA() {
	local cells=$1 dt=$2 t=$3
	shift 3
	pinit cold-collapse -n 1024 --cells "$cells" --dt "$dt" "$@" |
		cycle -t "$t" --every 1 'push kick/2 drift | p2m | poisson-fft --symbol fd2 | mgrad --order 2 | m2p | push kick/2' |
		stab --plain |
		awk -v n=1024 -f "$BATS_TEST_DIRNAME/amplitude.awk"
}

# rate DT: from three successive amplitudes in the middle of the list, w with sinh(g dt/2) = w dt/2.
rate() {
	awk -v dt="$1" '{ a[NR] = $1 } END { i = int(NR / 2); c = (a[i+1] + a[i-1]) / (2 * a[i]); g = log(c + sqrt(c*c - 1)); printf "%.17g\n",
		(exp(g/2) - exp(-g/2)) / dt }'
}

@test "PM-06: a cold wave grows as cosh(w t): k A after one and two Jeans times to 1e-3" {
	kA 128 0.05 2 > a
	[ "$(wc -l < a)" = 41 ]
	within "$(sed -n 1p a)" 0.05 1e-15
	within "$(sed -n 21p a)" 0.0771540317407622 7.7e-5
	within "$(sed -n 41p a)" 0.188109784554182 1.88e-4
}

@test "PM-06: the sheets cross (k A = 1) at 3.68825 Jeans times to 1 %" {
	kA 128 0.05 3.75 > a
	within "$(awk 'NR > 1 && $1 >= 1 && a < 1 { printf "%.17g", 0.05 * (NR - 2 + (1 - a) / ($1 - a)); exit } { a = $1 }' a)" 3.6882538673613 0.037
}

@test "PM-06: on a mesh the growth rate is cos(k dx/2), on 16, 24 and 48 cells a wave" {
	for c in 16 24 48; do
		kA "$c" 0.1 2 --amplitude 1e-4 > a
		within "$(rate 0.1 < a)" "$(awk -v c=$c 'BEGIN { print cos(atan2(0, -1) / c) }' OFMT=%.15g)" 1e-4 "$c cells"
	done
	# and the number of the case
	kA 16 0.1 2 --amplitude 1e-4 > a
	within "$(rate 0.1 < a)" 0.98078528040323 1e-4
}

@test "PM-06: the leapfrog's growth obeys sinh(g dt/2) = w dt/2: 0.999584 of w at w dt = 0.1" {
	# w of this mesh from a step ten times smaller; both at the same time, when the growing mode dominates
	kA 64 0.1 2 --amplitude 1e-4 > a
	kA 64 0.01 1.1 --amplitude 1e-4 | awk 'NR >= 92' > b
	w=$(rate 0.01 < b)
	g=$(awk '{ a[NR] = $1 } END { i = 11; c = (a[i+1] + a[i-1]) / (2 * a[i]); printf "%.17g", log(c + sqrt(c*c - 1)) / 0.1 }' a)
	within "$(awk -v g="$g" -v w="$w" 'BEGIN { printf "%.17g", g / w }')" 0.999583801386973 2e-6 # 1e-6 of the case, and 1e-6 of w
}

@test "PM-06: the same wave in 2-D and 3-D" {
	# cic smooths most for one particle in the middle of a cell: 1/64 and 1/32 of a wave reduce the growth by 0.2 % and 0.7 %
	for d in "2 4096 64 0.002" "3 32768 32 0.01"; do
		read -r dim n cells most <<<"$d"
		sh_ok "pinit cold-collapse --dim $dim -n $n --cells $cells --dt 0.1 |
			cycle -t 1 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' | diag --exact > t"
		within "$(awk -v g="$(column speed_rms < t)" -v w="$(column exact_speed_rms < t)" 'BEGIN { printf "%.17g", g / w }')" 1 "$most"
	done
}

@test "PM-08: a cold sphere falls to 0.837 of its radius in half a free-fall time" {
	sh_ok "pinit cold-sphere -n 20000 --cells 48 --dt 0.0138840091817449 |
		cycle -n 40 --every 20 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' |
		diag --exact --radii 0.5,0.9 > t"
	within "$(sed -n 4p t | cut -f 2)" 0.5553603672697958 1e-9
	for r in radius_0.5 radius_0.9; do
		# 20000 particles determine the radii to 0.3 %, the mesh of 1/16 R adds as much; the case allows 1 %
		within "$(column $r < t | tail -n1)" "$(column exact_$r < t | tail -n1)" 0.01
	done
}
