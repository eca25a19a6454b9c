#!/usr/bin/env bats
# pipelines/slurm-job.sh with a stand-in for sbatch. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

setup() {
	cd "$BATS_TEST_TMPDIR" || return
	mkdir stand-in
	printf '%s\n' '#!/bin/sh' 'echo "$@" >>submitted' >stand-in/sbatch
	chmod +x stand-in/sbatch
	PATH=$PWD/stand-in:$PATH
	export STEPS=24 SLICE=8 EVERY=4 SCENE="pinit plummer -n 300 --cells 16 --no-history"
	job=$top/pipelines/slurm-job.sh
}

@test "the Slurm job submits itself again when its time ends, goes on from the checkpoint, and its parts are one run to the last bit" {
	printf '%s\n' '#!/usr/bin/env bash' 'kill -TERM "$PPID"' 'exec "'"$(command -v cycle)"'" --no-history "$@"' \
		>stand-in/cycle # Slurm's signal, in every slice
	chmod +x stand-in/cycle
	for k in 1 2; do
		bash "$job" >said
		grep -q "slurm-job: $((8 * k)) of 24 steps" said
		[ "$(cat submitted)" = "$(for i in $(seq $k); do echo "$job"; done)" ]
	done
	echo cut >run/part.tmp # of a job that was killed within a slice
	bash "$job" | grep -q 'all 24 steps'
	[ "$(wc -l <submitted)" = 2 ]
	rm stand-in/cycle
	$SCENE | cycle --no-history -n 24 --every 4 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' | stab >whole
	cat run/part-*.pm | stab | cmp - whole
}

@test "the Slurm job in which a slice fails ends with its status, and is not submitted again" {
	printf '%s\n' '#!/bin/sh' 'exit 3' >stand-in/cycle
	chmod +x stand-in/cycle
	run -3 bash "$job"
	[ ! -e submitted ]
}

@test "the Slurm job of several tasks starts cycle by srun, with the bytes of one task" {
	printf '%s\n' '#!/usr/bin/env bash' 'echo "$1 $2" >>launched' 'word=$3; shift 3' 'exec "$word" --ranks "$SLURM_NTASKS" --no-history "$@"' >stand-in/srun
	chmod +x stand-in/srun
	SLURM_NTASKS=3 SLURM_CPUS_PER_TASK=1 bash "$job" | grep -q 'all 24 steps'
	[ "$(sort -u launched)" = "--mpi=pmix --cpus-per-task=1" ]
	$SCENE | cycle --no-history -n 24 --every 4 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' | stab >whole
	cat run/part-*.pm | stab | cmp - whole
}
