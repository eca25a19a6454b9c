#!/usr/bin/env bash
# sh5 against HDF5's own H5Dwrite and H5Dread of as many contiguous datasets of as many doubles, from and to memory, in turn (h5-datasets.c): a line for each
# way with the ratio of processor times, medians of ROUNDS (7) rounds. sh5.sh [N]: particles (default 2e6: 112 MB), in /dev/shm.
# Files are in memory, so that no disk has a part; sh5 also reads or writes the stream, verifies its checksums and makes those of the datasets.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
export PATH=${PM_BIN:-$top/bin}:${PM_BENCH:-$top/build/bench}:$PATH LC_ALL=C OMP_NUM_THREADS=1
n=${1:-2000000}
work=$(mktemp -d /dev/shm/pm-sh5-XXXXXX)
trap 'rm -r "$work"' EXIT
cd "$work"
pinit uniform -n "$n" --dispersion 0.1 >stream.pm
sh5 -o there.h5 <stream.pm
h5-datasets write plain.h5 "$n" >/dev/null

seconds() { local TIMEFORMAT='%U %S'; { time "$@" >"$work/said"; } 2>&1 | awk '{ print $1 + $2 }'; }
# shellcheck disable=SC2317 # called by seconds
sh5_write() { rm -f new.h5 && sh5 -o new.h5 <stream.pm; }
# shellcheck disable=SC2317
sh5_read() { sh5 there.h5 >/dev/null; }
# shellcheck disable=SC2317
plain_write() { rm -f new.h5 && h5-datasets write new.h5 "$n"; }
# shellcheck disable=SC2317
plain_read() { h5-datasets read plain.h5 "$n"; }
median() { sort -g "$1" | awk '{ v[NR] = $1 } END { printf "%.2f", v[int((NR + 1) / 2)] }'; }
for _ in $(seq "${ROUNDS:-7}"); do
	for way in write read; do
		ours=$(seconds "sh5_$way")
		whole=$(seconds "plain_$way")
		awk -v o="$ours" -v w="$whole" -v f=$way '{ print w / o >>(f ".whole"); print $1 / o >>(f ".calls") }' said
	done
done
for way in write read; do
	echo "$way: $(median $way.whole) of a program that does nothing else, fresh memory included (aim 0.5); $(median $way.calls) of the calls alone"
done
