# Sentences of the README in which one word was forgotten: what the message names. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

# forgets N PATTERN SOURCE WORDS: cycle runs the words, joined by |, without the N-th; the last line on stderr matches PATTERN.
forgets() {
	local n=$1 pattern=$2 source=$3 line
	line=$($source | cycle -q -n 2 "$(awk -F' [|] ' -v n="$n" '{ for (i = 1; i <= NF; i++) if (i != n) { printf "%s%s", s, $i; s = " | " } }' \
		<<<"$4")" 2>&1 >/dev/null | tail -n 1) || true
	[[ $line == cycle:*$pattern* ]] || { echo "$4 without word $n: '$line', wanted '$pattern'"; return 1; }
}

# Which word was left out, and what is named. A drift: not --replace alone. A periodic box: not pp. Nothing: the run is well without it.
@test "a sentence of the README without one of its words is refused with the word that is missing" {
	mesh='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'
	apart='push kick/2 | push drift | p2m | poisson-fft | mgrad | m2p | push kick/2'
	pairs='push kick/2 drift | pp | push kick/2'
	vortex='p2m | poisson-fft | mgrad | diffuse | m2p | push lsrk3 | remesh'
	while IFS=';' read -r n pattern scene words; do
		forgets "$n" "$pattern" "pinit $scene" "${!words}"
	done <<-TABLE
		1;push drift is missing before this word;plummer -n 60 --cells 8;mesh
		2;no field 'rho' on 'mesh' (p2m makes it;plummer -n 60 --cells 8;mesh
		3;no field 'phi' on 'mesh' (poisson-fft, poisson-mg or poisson-relax makes;plummer -n 60 --cells 8;mesh
		4;no field 'g' on mesh 'mesh' (run mgrad first);plummer -n 60 --cells 8;mesh
		5;no field 'acc' on 'matter' (compute it first: m2p, or pp);plummer -n 60 --cells 8;mesh
		6;the other part of the kick is missing: push kick/2 behind the force;plummer -n 60 --cells 8;mesh
		1;begin with push kick/2 drift;plummer -n 60 --cells 8;apart
		2;push drift is missing before this word;plummer -n 60 --cells 8;apart
		7;push kick/2 drift | ... | push kick/2);plummer -n 60 --cells 8;apart
		1;push drift is missing before this word;plummer -n 60;pairs
		2;no field 'acc' on 'matter' (compute it first: p2m | poisson-fft | mgrad | m2p, or pp);plummer -n 60;pairs
		3;push kick/2 behind the force;plummer -n 60;pairs
		1;push drift is missing before this word;two-stream -n 100 --cells 8;mesh
		4;no field 'E' on mesh 'mesh' (run mgrad first);two-stream -n 100 --cells 8;mesh
		5;no field 'acc' on 'electrons' (compute it first: m2p);two-stream -n 100 --cells 8;mesh
		6;push kick/2 behind the force;two-stream -n 100 --cells 8;mesh
		1;no field 'omega' on 'mesh' (p2m makes it;shear-layer --cells 16 --nu 1e-3;vortex
		2;no field 'psi' on 'mesh' (poisson-fft,;shear-layer --cells 16 --nu 1e-3;vortex
		3;no field 'u' on mesh 'mesh' (run mgrad first);shear-layer --cells 16 --nu 1e-3;vortex
		5;carry it over with m2p;shear-layer --cells 16 --nu 1e-3;vortex
		6;the sentence has no word that completes a step (add push);shear-layer --cells 16 --nu 1e-3;vortex
	TABLE
	run --separate-stderr cycle -n 2 "${vortex/ | diffuse/}" < <(pinit shear-layer --cells 16 --nu 1e-3)
	[[ $stderr == *'no word of the sentence acts by it (diffuse, pse, walk)'* ]]
}

@test "outside cycle too the words are named that the frame still needs, and pp only in open space" {
	refuses() { run -1 --separate-stderr bash -o pipefail -c "$2"; [[ ${stderr_lines[0]} == *"$1"* ]] || { echo "$2: $stderr"; return 1; }; }
	refuses "(p2m | poisson-fft makes it" 'pinit uniform -n 9 | mgrad >a'
	refuses "(poisson-fft, poisson-mg or poisson-relax makes" 'pinit uniform -n 9 | p2m -n 4 | mgrad >a'
	refuses "(run p2m | poisson-fft | mgrad first)" 'pinit uniform -n 9 | m2p >a'
	refuses "(compute it first: p2m | poisson-fft | mgrad | m2p)" 'pinit uniform -n 9 | push kick >a'
	refuses "(compute it first: mgrad | m2p)" 'pinit uniform -n 9 | p2m -n 4 | poisson-fft | push kick >a'
	refuses "(compute it first: field 'acc = ...')" 'printf "x vx\n0 1\n" | stab - --dt 1 | push kick >a'
	refuses "push drift is missing" 'pinit plummer -n 9 | pp | push kick/2 | pp >a'
	refuses "--replace computes it again, push clear drops it" 'pinit plummer -n 9 | pp | pp >a'
	refuses "a push drift is missing before it" 'pinit plummer -n 9 | pp | push kick | push kick/2 >a'
}
