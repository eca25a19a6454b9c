#!/usr/bin/env bash
# The table of costs in docs/plan.md: for every scene of pinit what plan says of the whole run, and what the run then takes. The end of the run is chosen so
# that it takes about a second. Prediction and run take turns, three times, and the medians are printed. The start of the program is taken off.
#     bash docs/plan-cost.sh [--time wall|processor] [SCENE...]
# wall (the default): with as many threads as the user's; for a machine that nobody else uses. processor: user and system time of one thread, which other
# users of the machine change least. Expected: all quotients within a factor 1.5. Takes 1 min 40 s. SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
PATH=${PM_BIN:-$top/bin}:$PATH
export LC_ALL=C
time=wall
[ "${1:-}" != --time ] || { time=${2:-}; shift 2; }
case $time in
wall) said=.cost.seconds took=%e ;;
processor) said='.cost.set_up + .cost.steps * .cost.processor_per_step' took='%U %S'; export OMP_NUM_THREADS=1 ;;
*) echo "plan-cost.sh: --time '$time' is neither wall nor processor" >&2; exit 2 ;;
esac
command -v /usr/bin/time >/dev/null || { echo "plan-cost.sh: no /usr/bin/time (apt-get install time)" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

middle() { sort -g | sed -n 2p; }
calc() { awk "BEGIN { printf \"%.6g\", ($1) }"; }

# An end of the run for which plan predicts 0.2 to 3 s; at most ten tries, because a longer run may be planned otherwise.
choose_end() {
	local seconds low= high= i
	span=$(calc "100 * $dt")
	for i in 1 2 3 4 5 6 7 8 9 10; do
		seconds=$(plan -t "$(calc "$begin + $span")" --format json <start | jq .cost.seconds)
		[ "$(calc "$seconds < 0.2 || $seconds > 3")" = 1 ] || return 0
		if [ "$(calc "$seconds < 0.2")" = 1 ]; then low=$span; else high=$span; fi
		if [ "$low" ] && [ "$high" ]; then span=$(calc "sqrt($low * $high)"); else span=$(calc "$span * (1 / $seconds > 20 ? 20 : 1 / $seconds)"); fi
	done
}

# measure ARGUMENTS OF CYCLE...: seconds and bytes.
measure() {
	/usr/bin/time -o clock -f "$took %M" cycle --quiet "$@" <start >end
	awk '{ printf "%.6g %.6g\n", NF == 3 ? $1 + $2 : $1, 1024 * $NF }' clock
}

row() {
	local i
	pinit "$1" >start
	read -r begin dt < <(sls start | awk '/^frame/ { print $4, $10; exit }')
	choose_end
	end=$(calc "$begin + $span")
	rm -f predicted measured
	for i in 1 2 3; do
		plan -t "$end" --format json <start >plan.json
		jq -r "[$said, .cost.memory, .cost.steps] | join(\" \")" plan.json >>predicted
		none=$(measure -n 0 'push drift')
		echo "$(measure -t "$end" "$(jq -r .sentence plan.json)") ${none% *}" >>measured
	done
	seconds=$(awk '{ print $1 }' predicted | middle) memory=$(awk '{ print $2 }' predicted | middle) steps=$(awk '{ print $3 }' predicted | middle)
	seconds_took=$(awk '{ print $1 - $3 }' measured | middle) memory_took=$(awk '{ print $2 }' measured | middle)
	awk -v n="$1" -v k="$steps" -v a="$seconds" -v b="$seconds_took" -v c="$memory" -v d="$memory_took" 'BEGIN {
		printf b < 0.02 ? "| %s | %d | < 0.02 | < 0.02 | - |" : "| %s | %d | %.2f | %.2f | %.2f |", n, k, a, b, b ? a / b : 0
		printf " %.1f | %.1f | %.2f |\n", c / 1e6, d / 1e6, c / d }'
}

echo '| scene | steps | predicted, s | took, s | quotient | predicted, MB | took, MB | quotient |'
echo '|---|---|---|---|---|---|---|---|'
[ $# -gt 0 ] || set -- $(pinit --help | awk '/^The scenes/ { inside = 1; next } NF == 0 { inside = 0 } inside { print $1 }')
for scene; do row "$scene"; done
