#!/usr/bin/env bash
# A step with light in 3-D: 2097152 thermal electrons, 64 in a cell of 32^3, cic, in double, sorted every 10 steps, one thread; with
# m2p --energy-conserving and with m2p as bare. In turn with them VPIC, if PM_VPIC names a program (its whole path) that makes N steps of the same plasma
# when it is called with N (single precision, sorted every 20 steps), and other builds of cycle: `light-step.sh [ROUNDS [CYCLE...]]`, 7 rounds, for what a
# change of the code does. TSV: user time of the later steps less that of the first ones, in nanoseconds a particle and step, median and least, and the
# speed as a part of VPIC's. Needs 0.3 GB in /dev/shm, 20 seconds a round. SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$0")/.."
export PATH=$PWD/bin:$PATH LC_ALL=C OMP_NUM_THREADS=1
rounds=${1:-7} programs=("$PWD/bin/cycle" "${@:2}") particles=2097152
scratch=$(mktemp -d /dev/shm/pm-light-XXXXXX)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# user COMMAND...: its user time [s].
user() {
	local TIMEFORMAT=%U
	{ time "$@" >/dev/null 2>&1; } 2>&1
}

# ours CYCLE GATHER STEPS: so many steps of a sentence.
ours() { user "$1" -q -i start -n "$3" "push boris/2 | p2m --current | maxwell | push drift | $2 | push boris/2 | ssort --every 10"; }
vpic() { (cd "$(dirname "$PM_VPIC")" && user "./$(basename "$PM_VPIC")" "$1" --tpp 1); }

# less NAME FROM TO COMMAND...: a line of the time of a particle and step between FROM and TO steps.
less() {
	local first last
	first=$("${@:4}" "$2") last=$("${@:4}" "$3")
	awk -v name="$1" -v a="$first" -v b="$last" -v n=$((($3 - $2) * particles)) 'BEGIN { printf "%s\t%.2f\n", name, (b - a) / n * 1e9 }'
}

pinit em-wave --dim 3 --cells 32 --no-history | smod --no-history --constant background=1 --rename electrons=none |
	species electrons -n $particles --vth 0.1 --loading random --no-history | ssort --no-history >start
for ((r = 0; r < rounds; r++)); do
	[ -z "${PM_VPIC:-}" ] || less 'VPIC, steps 20 to 60' 20 60 vpic
	for p in "${programs[@]}"; do
		less "$p, m2p --energy-conserving, steps 2 to 42" 2 42 ours "$p" 'm2p --energy-conserving'
		less "$p, m2p --energy-conserving, steps 2 to 19" 2 19 ours "$p" 'm2p --energy-conserving'
		less "$p, m2p, steps 2 to 42" 2 42 ours "$p" m2p
	done
done | sort -t $'\t' -k1,1 -k2,2g | awk -F'\t' -v OFS='\t' '
	{ if (!($1 in n)) order[++m] = $1; v[$1, ++n[$1]] = $2 }
	END {
		print "step", "ns", "least", "of_vpic"
		for (i = 1; i <= m; i++) {
			k = order[i]
			mid[k] = v[k, int((n[k] + 1) / 2)]
			if (k ~ /^VPIC/) peer = mid[k]
		}
		for (i = 1; i <= m; i++)
			print order[i], mid[order[i]], v[order[i], 1], peer ? sprintf("%.2f", peer / mid[order[i]]) : "-"
	}'
