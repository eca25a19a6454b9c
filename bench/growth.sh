#!/usr/bin/env bash
# What a particle, or a point, costs in meshes of 1e3 to 3e7 cells with a cic particle in each, and the memory of a step at its peak.
#   bench/growth.sh [CELLS...] >>rows   a line for each word: word, particles, nanoseconds of a particle (or point), on the threads there are
#   bench/growth.sh --draw rows         docs/growth.png, or OUT=FILE
#   bench/growth.sh --cores rows1 rows2 a model of up to 64 cores and its picture, docs/cores-model.png (of N particles, N=2097152), from rows of one thread
#                                       and of two: the gain g of the second makes the serial part 2/g - 1 of one thread's time (Amdahl 1967); that memory
#                                       is shared by all cores is in g, as far as two feel it
# The first step, which touches new memory, is taken off: a run of one step is subtracted from a longer one. Of five such differences the middle one, of
# three from 1e7 particles on (a virtual machine gets its memory from the host when it is touched first: of one round alone a difference was negative).
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
export PATH=${PM_BIN:-$top/bin}:$PATH LC_ALL=C
if [ "${1:-}" = --draw ]; then
	{
		echo word particles ns
		grep -v '^bytes' "$2" | sort -k1,1 -s
	} | splot ns -i /dev/stdin -x particles --by word --log -o "${OUT:-$top/docs/growth.png}" --x-label 'particles, as many points' --y-label 'ns of one' \
		--title 'What one particle or point costs as the problem grows'
	exit
fi
if [ "${1:-}" = --cores ]; then
	# shellcheck disable=SC2016 # awk's
	model='NR == FNR { one[$1, $2] = $3; next } ($1, $2) in one && $1 !~ /^bytes/ { g = one[$1, $2] / $3; s = g < 2 ? 2 / g - 1 : 0'
	awk "$model"'
		printf "%s\t%d\tgain of the second thread %.2f\tserial %.3f\tmodel of 64 cores: %.1f times one\n", $1, $2, g, s, 1 / (s + (1 - s) / 64) }' \
		"$2" "$3"
	{
		echo word cores speed
		sort -k1,1 -s "$3" | awk -v n="${N:-2097152}" "$model"'; if ($2 == n) for (c = 1; c <= 64; c *= 2) print $1, c, 1 / (s + (1 - s) / c) }' "$2" -
	} | splot speed -i /dev/stdin -x cores --by word --log -o "${OUT:-$top/docs/cores-model.png}" \
		--x-label 'cores' --y-label 'times the speed of one core' --theory 'ideal = x' \
		--title "A model, not a measurement: 64 cores from the gain of the second, ${N:-2097152} particles"
	exit
fi
[ $# != 0 ] || set -- 10 16 32 64 128 256 320
scratch=$(mktemp -d /dev/shm/pm-growth-XXXXXX)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# works STEPS SENTENCE FILE: `word seconds` of the words of a run and of cycle as a whole; both pushes together, which do what mgrad and m2p leave to
# them.
works() {
	rm -f times
	cycle -q -n "$1" --timing times -i "$3" -o /dev/null "$2"
	awk -F'\t' '{ sub(/ .*/, "", $1); s[$1] += $3 }
		END { s["m2p+push"] = s["push"] + s["m2p"] + s["mgrad"]; delete s["push"]; delete s["m2p"]; delete s["mgrad"]
			for (w in s) print w, s[w] }' times
}
# measures WORD FRAMES FILE: a word alone, of a stream that many frames long.
measures() {
	rm -f times
	for _ in $(seq "$2"); do cat "$3"; done | "$1" --timing times >/dev/null
	awk -F'\t' -v w="$1" '{ print w, $3 }' times
}
# rows N STEPS LESS MORE: of the rounds in the files LESS.* and MORE.*, which differ by so many steps.
rows() {
	for r in $rounds; do paste <(sort "$3.$r") <(sort "$4.$r"); done | awk -v n="$1" -v k="$2" '{ print $1, n, ($4 - $2) / k / n * 1e9 }' |
		sort -k1,1 -k3,3g |
		awk '$1 != w && w { print line[int((m + 1) / 2)] } $1 != w { m = 0; w = $1 } { line[++m] = $0 } END { print line[int((m + 1) / 2)] }'
}
for cells; do
	n=$((cells ** 3))
	steps=$((n < 600000 ? 4000000 / n : 7)) # of fewer the difference drowns in the first touch of memory
	rounds=$([ "$n" -lt 10000000 ] && echo 1 2 3 4 5 || echo 1 2 3)
	pinit uniform -n "$n" --cells "$cells" | ssort | p2m --kernel cic | poisson-fft >start.pm
	step='push kick/2 drift | p2m --kernel cic | poisson-fft | mgrad | m2p | push kick/2'
	for r in $rounds; do
		works 1 "$step" start.pm >"less.$r"
		works $((1 + steps)) "$step" start.pm >"more.$r"
	done
	rows "$n" "$steps" less more
	for r in $rounds; do
		works 1 'push drift | p2m --kernel cic | poisson-mg' start.pm | grep poisson >"less.$r"
		works 3 'push drift | p2m --kernel cic | poisson-mg' start.pm | grep poisson >"more.$r"
	done
	rows "$n" 2 less more
	mgrad -i start.pm -o field.pm
	frames=$((n < 100000 ? 200000 / n : 2))
	for word in 'diag start.pm' 'mgrad start.pm' 'm2p field.pm'; do
		read -r name file <<<"$word"
		for r in $rounds; do
			measures "$name" 1 "$file" >"less.$r"
			measures "$name" $((1 + frames)) "$file" >"more.$r"
		done
		rows "$n" "$frames" less more
	done
	if type -P time >/dev/null; then
		for engine in fused pipes; do
			command time -f %M -o peak cycle -q -n 1 --engine "$engine" -i start.pm -o /dev/null "$step"
			awk -v n="$n" -v e="$engine" '{ print "bytes-" e, n, $1 * 1024 / n }' peak
		done
	fi
done
