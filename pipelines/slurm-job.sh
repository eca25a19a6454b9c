#!/usr/bin/env bash
#SBATCH --job-name=plummer --nodes=1 --ntasks=1 --cpus-per-task=8 --time=01:00:00 --signal=B:TERM@300
# A long run as a chain of Slurm jobs: sbatch pipelines/slurm-job.sh. It is made in slices of so many steps, each a file of whole frames (part-0001.pm ...).
# 300 s before the end of its time Slurm sends TERM to this script, which ends the slice under way and submits itself again; the next job goes on from the
# checkpoint behind the last slice. A slice must take less than these 300 s. A job that is killed within a slice loses that slice alone: submit it again.
# With several tasks (sbatch --nodes=4 --ntasks-per-node=2 ...) srun starts cycle as so many ranks, with the bytes of one; docs/distributed.md says how many.
# All parts together are the frames of one run, to the last bit: diag run/part-*.pm. Expected: 10000 bodies, 3000 steps, 31 frames.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
run=${RUN:-run} # directory of the results
steps=${STEPS:-3000} slice=${SLICE:-500} every=${EVERY:-100} # slice: a multiple of every
scene=${SCENE:-pinit plummer -n 10000}
words='push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2'
export OMP_NUM_THREADS=${SLURM_CPUS_PER_TASK:-$(nproc)}
launch=()
[ "${SLURM_NTASKS:-1}" -le 1 ] || launch=(srun "--mpi=${MPI:-pmix}" "--cpus-per-task=$OMP_NUM_THREADS") # MPI=pmi2 for MPICH; srun --mpi=list

stop=
trap 'stop=1' TERM # bash waits for the end of the slice
mkdir -p "$run"
[ -e "$run/start.pm" ] || { $scene >"$run/start.tmp" && mv "$run/start.tmp" "$run/start.pm"; }
shopt -s nullglob
parts=("$run"/part-*.pm)
made=${#parts[@]}

while [ $((made * slice)) -lt "$steps" ] && [ ! "$stop" ]; do
	part=$(printf 'part-%04d.pm' $((made + 1))) from=(-i "$run/start.pm")
	[ "$made" = 0 ] || from=(--resume "$run/state-$made.pm")
	end=$(((made + 1) * slice))
	"${launch[@]}" cycle -n $((end < steps ? end : steps)) --every "$every" "${from[@]}" --checkpoint "$run/state-$((made + 1)).pm" -o "$run/part.tmp" \
		"$words"
	mv "$run/part.tmp" "$run/$part" # only now the slice counts
	rm -f "$run/state-$made.pm"
	made=$((made + 1))
done

if [ $((made * slice)) -lt "$steps" ]; then
	echo "slurm-job: $((made * slice)) of $steps steps; the next job goes on"
	sbatch "$0"
else
	echo "slurm-job: all $steps steps are made: $run/part-*.pm"
fi
