#!/usr/bin/env bats
# Fields of type f32 are held as floats between the words, and push, p2m and m2p take them as such (docs/stage.md): half the memory of a run. That the bytes are
# the same for every way of running: ways.bats. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# peak FILE SENTENCE: [kB] the largest memory of three steps on one thread.
peak() {
	OMP_NUM_THREADS=1 python3 -c 'import resource, subprocess, sys
subprocess.run(["cycle", "-q", "-n", "3", sys.argv[2], "-i", sys.argv[1]], stdout=subprocess.DEVNULL, check=True)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)' "$1" "$2"
}

# halves SCENE... SENTENCE (SCENE -n N): what 350000 particles add in f32 is at most 0.58 of what they add in f64, their ids, 8 bytes in both, apart. With light
# 56 of 104 bytes are 0.54, 8 of both the order of particles; a column widened to doubles for a word would be 0.08 more. Memory comes in pieces of 2 MB, which
# vectors of 170000 and 520000 particles nearly fill; the fewer need more than python3, whose memory is counted until cycle begins.
halves() {
	local sentence=${*: -1} few many ids part
	set -- "${@:1:$#-1}"
	"$@" 170000 >few
	"$@" 520000 >many
	smod --store f32 few >few32
	smod --store f32 many >many32
	few=$(peak few "$sentence") many=$(peak many "$sentence")
	ids=$((($(sel --field id many | wc -c) - $(sel --field id few | wc -c)) / 1024))
	part=$(echo "$(peak many32 "$sentence") $(peak few32 "$sentence") $many $few $ids" | awk '{ print ($1 - $2 - $5)/($3 - $4 - $5) }')
	[ $((many - few - ids)) -gt 20000 ]
	awk -v p="$part" 'BEGIN { exit !(p < 0.58) }' || { echo "f32 needs $part of the memory of f64: $sentence"; return 1; }
}

box() { pinit uniform --dispersion 1 --dt 0.001 --cells 32 -n "$1"; }
wave() { pinit landau --loading bit-reversed --cells 64 -n $((3 * $1)); }
light() { pinit em-wave --dim 3 --cells 16 | smod --constant background=1 --rename electrons=none | species electrons -n "$1" --vth 0.1 --loading random; }
sorted_light() { light "$1" | ssort; }

@test "an electrostatic or gravitational step in f32 needs half the memory of one in f64" {
	[ -z "$PM_SANITIZED" ] || skip "the memory of a sanitized program says nothing"
	halves box "push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2"
	halves wave "push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2"
}

@test "so does a step with light, whatever the order of the particles" {
	[ -z "$PM_SANITIZED" ] || skip "the memory of a sanitized program says nothing"
	halves light "push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2"
	halves sorted_light "push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2"
}

@test "a word that knows nothing of floats reads and changes f32 fields as it did: the numbers are those of f64 fields rounded after each word" {
	local words="smove --shift 0.3,0,0.1 | scalc --role state 'k = x*vx' | smove --shift=-0.1,0.2,0"
	pinit uniform -n 6000 --dispersion 1 | smod --store f32 >start # 72 kB of places, which are handed over as memory
	for engine in fused pipes; do
		cycle -q --engine $engine --no-history -n 2 "push drift | scalc --role state --type f32 'k = 0.99*vx' | ssort" -i start -o "$engine"
	done
	cmp fused pipes
	bash -c "cat start | $words" >ours
	smod --store f64 start | smove --shift 0.3,0,0.1 | smod --store f32 | smod --store f64 | scalc --role state 'k = x*vx' |
		smove --shift=-0.1,0.2,0 | smod --store f32 >theirs
	for f in ours theirs; do sel --field x,v $f | stab --plain >$f.txt; done
	[ "$(wc -l <ours.txt)" -gt 5900 ]
	cmp ours.txt theirs.txt
}

@test "a rate that m2p makes has the type of the state it changes" {
	pinit uniform -n 100 --cells 8 | smod --store v=f32 | p2m | poisson-fft | mgrad | m2p | sls | grep -q 'acc *3 f32 change'
	pinit uniform -n 100 --cells 8 | smod --store x=f32 | p2m | poisson-fft | mgrad | m2p | sls | grep -q 'acc *3 f64 change'
}

@test "one number for all particles is rounded to f32 by a word that changes it, and is the same for every word after that" {
	pinit landau --loading bit-reversed -n 500 | smod --no-history --store f32 | smove --no-history --scale charge=1.1,mass=1.1 >scaled
	sls scaled | grep -q 'charge .* f32 .* uniform'
	smod --no-history --store f64 scaled | smod --no-history --store f32 | cmp - scaled
	for engine in fused pipes; do
		cycle -q --engine $engine --no-history -n 2 "scalc --role state 'k = x*charge' | p2m | poisson-fft | mgrad | m2p | push kick drift" \
			-i scaled -o "$engine"
	done
	cmp fused pipes
}

@test "what is beyond the range of f32 is refused, with the word that stores f64" {
	pinit uniform -n 10 | scalc 'q = 1e30*x' >wide
	run -3 --separate-stderr smod --store f32 < <(scalc 'q = 1e30*q' <wide)
	[[ "$stderr" = "smod: frame 1: 'q' of 'matter' is not finite: component 0, index 0 (f32 ends at 3.4e38: smod --store f64"* ]]
	run -3 --separate-stderr scalc 'q = 1e30*q' < <(smod --store f32 wide)
	[[ "$stderr" = *"(f32 ends at 3.4e38: smod --store f64"* ]]
	run -3 --separate-stderr scalc 'q = 1e300*q' <wide
	[[ "$stderr" = *"index 0 (a smaller dt, or a larger softening)"* ]]
}
