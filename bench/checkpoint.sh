#!/usr/bin/env bash
# Checkpoints of 1 GB against dd, in turn, on the file system of the directory one is in: a line for each turn with the GB/s of dd with zeros, of dd with the
# bytes of the checkpoint (disks of virtual machines are faster with zeros), of one rank, of RANKS (4) rehearsed ranks, and the last over the two of dd
# (target 0.8).
#   cd DIRECTORY; bench/checkpoint.sh [TURNS]
# dd writes as many bytes from memory, as a new file that takes the place of the old one, and waits until they are on the disk (conv=fsync), as a
# checkpoint does.
# The time of a checkpoint is that of four steps with four checkpoints less that of the steps without any, over four. 3 GB of disk, 4 GB of memory.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
export PATH=${PM_BIN:-$top/bin}:$PATH LC_ALL=C
ranks=${RANKS:-4} n=${N:-17900000}
work=$(mktemp -d "$PWD/checkpoint.XXXXXX")
trap 'rm -r "$work"' EXIT
cd "$work"
start=$(mktemp /dev/shm/checkpoint.XXXXXX)
trap 'rm -r "$work" "$start"' EXIT
pinit uniform -n "$n" --dispersion 0.1 >"$start"
bytes=$(stat -c %s "$start")

seconds() { local t=$EPOCHREALTIME; "$@" >&2; awk -v a="$t" -v b="$EPOCHREALTIME" 'BEGIN { print b - a }'; }
steps() { cycle -q --ranks "$1" -n 4 "${@:2}" -i "$start" -o /dev/null 'push drift'; }
checkpoint() { echo "$(seconds steps "$1" --checkpoint saved --checkpoint-every 1) $(seconds steps "$1")" | awk '{ print ($1 - $2)/4 }'; }
four() { for _ in 1 2 3 4; do dd if="$1" of=new bs=1M count=$((bytes >> 20)) conv=fsync status=none && mv new copy; done; }
echo 'bytes dd_zeros_GB/s dd_GB/s one_rank_GB/s ranks_GB/s ranks/dd_zeros ranks/dd'
for _ in $(seq "${1:-3}"); do
	echo "$bytes $(seconds four /dev/zero) $(seconds four "$start") $(checkpoint 1) $(checkpoint "$ranks")"
done | awk '{ b = $1/1e9; printf "%d %.3g %.3g %.3g %.3g %.2f %.2f\n", $1, 4*b/$2, 4*b/$3, b/$4, b/$5, $2/$5/4, $3/$5/4; fflush() }'
