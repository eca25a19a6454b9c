#!/usr/bin/env bash
# Transfers with the registers of other processors of this kind: lib/transfer is built for SSE2 and for AVX2 and linked in front of the library as it was built
# for this one (make unit), and its unit tests must pass as they do here. Elsewhere than on x86-64, and where AVX2 is not there, it is skipped. Ends with
# `N passed, N failed, N skipped`. One minute. SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$0")/.."
export CC=${CC:-gcc}
passed=0 failed=0 skipped=0
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# build LEVEL FILE TO
build() {
	"$CC" -std=c11 -D_GNU_SOURCE -O2 -march="$1" -ffp-contract=off -fno-math-errno -fno-trapping-math -fopenmp -Wno-psabi -Ilib -Ibuild -c "$2" -o "$3"
}
export -f build

for level in x86-64 x86-64-v3; do
	if ! "$CC" -march=$level -E - </dev/null >/dev/null 2>&1 || { [ $level = x86-64-v3 ] && ! grep -qw avx2 /proc/cpuinfo; }; then
		echo "widths: $level: skipped" && skipped=$((skipped + 1))
		continue
	fi
	mkdir "$scratch/$level"
	for file in lib/transfer/*.c; do
		printf '%s\n' "$level $file $scratch/$level/$(basename "$file" .c).o"
	done | xargs -P "$(nproc)" -L 1 bash -c 'build "$@"' bash
	for unit in transfer tile-runs; do
		"$CC" -fopenmp build/tests/unit/$unit.o "$scratch/$level"/*.o build/libwhole.so -Wl,-rpath,"$PWD/build" -lm -o "$scratch/$unit"
		said=$("$scratch/$unit" 2>&1) || true
		grep '^not ok' <<<"$said" || true
		last=$(tail -n 1 <<<"$said")
		echo "widths: $level: $unit: $last"
		if [[ $last =~ ^#\ ([0-9]+)\ passed,\ ([0-9]+)\ failed$ ]]; then
			passed=$((passed + BASH_REMATCH[1])) failed=$((failed + BASH_REMATCH[2]))
		else
			failed=$((failed + 1))
		fi
	done
done
echo "$passed passed, $failed failed, $skipped skipped"
[ $failed = 0 ]
