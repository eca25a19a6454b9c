# Means and transforms. Lengths with a prime factor above 251 are planned by FFTW, so some meshes here have such. HC-24 and HC-29 are in
# tests/unit/poisson-fft.c. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

@test "HC-23: a mean density of 1 in a periodic box is removed and reported, phi has mean zero" {
	sh_ok "pinit uniform -n 500 | p2m -n 12x8x9 | poisson-fft > out"
	mean=$(tr '\0' '\n' < out | grep -ao '"mean_removed":[0-9.e+-]*' | cut -d: -f2)
	within "$mean" 1 1e-14 # mass 1 in a box of volume 1
	run -0 --separate-stderr bash -c "pinit uniform -n 500 | p2m -n 12x8x9 | poisson-fft --verbose | sls --report"
	[[ $output == *incompatible* && $stderr == *"no solution exists for this 'rho' in this box: its mean 1"* ]]
	phi=$(stab --plain --mesh mesh < out | awk 'NR > 1 { s += $5; n++ } END { print s/n }')
	below "$phi" 1e-12
}

@test "poisson-fft: threads 1, 2, 3 give equal bytes, for lengths that FFTW transforms too" {
	pinit uniform -n 2000 --seed 3 | p2m -n 34x257x4 > rho
	pinit plummer -n 500 --seed 3 | p2m -n 17 --outside drop > free
	pinit uniform -n 500 --seed 3 --faces wall,neumann,neumann,wall,wall,wall | p2m -n 19x17x23 > ends
	for n in 1 2 3; do
		poisson-fft --threads $n < rho > rho.$n
		poisson-fft --threads $n < free > free.$n
		poisson-fft --threads $n --screening 2 < ends > ends.$n
		same_as rho.1 rho.$n
		same_as free.1 free.$n
		same_as ends.1 ends.$n
	done
}

# Plans that were measured depended on what else the machine did, and were kept in a cache: here is an empty one, one with files of any kind, and none.
@test "poisson-fft: FFTW's plans are the same from an empty cache directory, a full one and none, under load, and again" {
	pinit uniform -n 2000 --seed 3 | p2m -n 17x19x23 > three
	pinit uniform -n 2000 --seed 3 --dim 2 | p2m -n 34x38 > two
	mkdir -p empty full/pmpipe
	for f in lock wisdom fftw-00000000-measure-block-forward-34; do echo other > full/pmpipe/$f; done
	mkfifo full/pmpipe/fftw-00000000-measure-block-backward-34
	pinit uniform -n 2000 --seed 3 --dim 2 | p2m -n 257x514 > large
	for mesh in three two large; do
		poisson-fft < $mesh > $mesh.want
		XDG_CACHE_HOME=$PWD/empty poisson-fft < $mesh > $mesh.empty
		XDG_CACHE_HOME=$PWD/full poisson-fft < $mesh > $mesh.full
		env -u XDG_CACHE_HOME -u HOME PM_PLAN=measure "$(command -v poisson-fft)" < $mesh > $mesh.none
		for i in 1 2 3 4; do poisson-fft < $mesh > $mesh.load.$i & done
		wait
		for got in $mesh.{empty,full,none,load.1,load.2,load.3,load.4}; do same_as $mesh.want "$got"; done
	done
	[ -z "$(ls empty)" ] # nothing is kept
	sls --report < large.want | grep -q '"plan":"fftw [0-9a-f]*"'
	sls --report < three.want | grep -q '"plan":"own"'
}

@test "poisson-fft: lengths of factors up to 251 need no plan" {
	for n in 48x34x251 81x125x49 121x169x26; do
		pinit uniform -n 500 | p2m -n $n | poisson-fft > a
		sh_ok 'sls --report < a'
		[[ $output == *'"plan":"own"'* ]]
		counted 3 # lengths
	done
}

@test "poisson-fft: the result does not depend on the frames before" {
	for n in 12 17 16; do
		pinit uniform -n 300 --seed $n | p2m -n $n --no-history > rho.$n
		poisson-fft --no-history < rho.$n > alone.$n
	done
	cat rho.12 rho.17 rho.12 rho.16 rho.17 | poisson-fft --no-history > together
	cat alone.12 alone.17 alone.12 alone.16 alone.17 > want
	same_as together want
}
