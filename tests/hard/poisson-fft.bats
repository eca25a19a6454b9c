# Means, plans, caches. Lengths with a prime factor above 13 are planned by FFTW, so the meshes here have such. HC-24 and HC-29 are in
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

@test "poisson-fft: threads 1, 2, 3 give equal bytes, with an empty cache and with a file of another program in it" {
	pinit uniform -n 2000 --seed 3 | p2m -n 34x19x20 > rho
	pinit plummer -n 500 --seed 3 | p2m -n 17 --outside drop > free
	pinit uniform -n 500 --seed 3 --faces wall,neumann,neumann,wall,wall,wall | p2m -n 19x17x23 > ends
	for cache in empty foreign; do
		mkdir -p $cache/pmpipe
		export XDG_CACHE_HOME=$PWD/$cache
		if [ $cache = foreign ]; then # the file there is garbage, truncated, or of another program
			for f in empty/pmpipe/fftw-*; do
				echo garbage > "foreign/pmpipe/${f##*/}"
			done
			f=$(ls empty/pmpipe/fftw-* | head -1)
			head -c 100 "$f" > "foreign/pmpipe/${f##*/}"
		fi
		for n in 1 2 3; do
			poisson-fft --threads $n --verbose < rho > $cache.$n 2>> said
			poisson-fft --threads $n < free > $cache.free.$n
			poisson-fft --threads $n --screening 2 < ends > $cache.ends.$n
			same_as $cache.1 $cache.$n
			same_as $cache.ends.1 $cache.ends.$n
			same_as $cache.free.1 $cache.free.$n
		done
	done
	grep -q "not a plan file of pmpipe" said
	grep -q " 0 measured, 0 estimated" said
}

@test "poisson-fft: lengths of factors up to 13 need no plan and no cache" {
	pinit uniform -n 500 | p2m -n 48x35x26 > rho
	XDG_CACHE_HOME=$PWD/cache run -0 --separate-stderr bash -c 'poisson-fft --verbose < rho > a'
	[[ $stderr == *"0 from the cache, 0 measured, 0 estimated"* ]]
	[ ! -e cache ]
	PM_PLAN=estimate poisson-fft < rho > b
	same_as a b
}

@test "poisson-fft: processes that start together on an empty cache compute with the same plans" {
	pinit uniform -n 2000 --seed 3 | p2m -n 51x38x46 > rho
	mkdir cache
	export XDG_CACHE_HOME=$PWD/cache
	for i in 1 2 3 4 5 6; do
		poisson-fft < rho > out.$i &
	done
	wait
	for i in 2 3 4 5 6; do
		same_as out.1 out.$i
	done
	[ -z "$(find cache -name '*.[0-9]*')" ] # no incomplete file is left
}

@test "poisson-fft: if the cache is not writable, plans are estimated, a message says so, and bytes are equal" {
	pinit uniform -n 500 | p2m -n 19 > rho
	touch file # not a directory: nothing can be made below it, not even by root
	XDG_CACHE_HOME=$PWD/file run -0 --separate-stderr bash -c 'poisson-fft --verbose < rho > a'
	[[ $stderr == *estimated* ]]
	env -u XDG_CACHE_HOME -u HOME bash -c 'poisson-fft < rho > b'
	same_as a b
	poisson-fft --plan estimate --no-history < rho > c
	poisson-fft --no-history < rho > d # HOME's cache: other plans are allowed, the result is not
	stab --plain --mesh mesh < c > c.txt
	stab --plain --mesh mesh < d > d.txt
	worst=$(paste c.txt d.txt | awk 'NR > 1 { d = $5 - $10; if (d < 0) d = -d; if (d > m) m = d } END { print m + 0 }')
	below "$worst" 1e-12 # rounding by another plan: 1e-16 of the largest, times ten thousand operations
}

@test "poisson-fft: a foreign cache file is reported with --verbose, replaced, and the new one is used" {
	pinit uniform -n 500 | p2m -n 19 > rho
	export XDG_CACHE_HOME=$PWD/cache
	poisson-fft < rho > a
	for f in cache/pmpipe/fftw-*; do
		echo foreign > "$f"
	done
	run -0 --separate-stderr bash -c 'poisson-fft --verbose < rho > b'
	[[ $stderr == *"not a plan file of pmpipe"* ]]
	run -0 --separate-stderr bash -c 'poisson-fft --verbose < rho > c'
	[[ $stderr == *" 0 measured, 0 estimated"* ]]
	same_as b c
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
