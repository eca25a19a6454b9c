#!/usr/bin/env bash
# Measures everything of docs/speed.md and ends with a table; `run.sh --markdown` also rewrites the tables of docs/speed.md. Rows are those of bench.h,
# one after the other in build/bench/rows.tsv. First the machine, then overheads (start of a filter, pass-through, cycle), then the kernels. Other codes that
# are not installed are skipped with a message. Names (`run.sh pp mgrad`) select parts. 6 minutes.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
cd "$(dirname "$0")/.."
top=$PWD
b=$top/build/bench
export PATH=$top/bin:$PATH LC_ALL=C OMP_WAIT_POLICY=passive
export PM_MACHINE=$b/machine.tsv PM_PEERS=$b/peers.tsv
markdown=
[ "${1:-}" != --markdown ] || { markdown=1 && shift; }
parts=("$@")
[ $# != 0 ] || parts=(start pass cycle transfer poisson-fft poisson-mg pp pse push mgrad step es1d vortex-step)
rows=$b/rows.tsv
cores=${OMP_NUM_THREADS:-$(nproc)}
busy=$(cut -d' ' -f1 /proc/loadavg)
scratch=$(mktemp -d /dev/shm/pm-bench-XXXXXX)
trap 'rm -rf "$scratch"' EXIT

# keep COMMAND...: runs it, shows its rows and adds them to the file.
keep() { "$@" | tee -a "$rows"; }

# row KERNEL CASE UNIT SIGN TARGET: a row whose value is the median of the seven lines of standard input.
row() {
	sort -g | awk -F'\t' -v OFS='\t' -v k="$1" -v c="$2" -v u="$3" -v sign="$4" -v target="$5" -v threads="$cores" '
		{ v[NR] = $1 }
		END {
			m = v[int((NR + 1) / 2)]
			ok = (sign == "-") ? "-" : ((sign == ">=" && m >= target + 0) || (sign == "<=" && m <= target + 0)) ? "yes" : "no"
			s = (m < 0) ? -m : m
			spread = (s > 0) ? sprintf("%.0f%%", 100 * (v[NR - 1] - v[2]) / s) : "-"
			wanted = (sign == "-") ? "-" : sign " " target
			print k, c, threads, sprintf("%.4g", m), u, spread, "-", "-", "-", "-", "-", "-", "-", wanted, ok
		}' | tee -a "$rows"
}

# seconds COMMAND LINE: wall time.
seconds() {
	local t=$EPOCHREALTIME
	bash -o pipefail -c "$1"
	awk -v a="$t" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.6f\n", b - a }'
}

# poisson-fft reads the density of a small mesh; the particles are only copied.
through() { [ -s through.pm ] || pinit uniform -n 4000000 --cells 8 | p2m >through.pm; }
part_start() {
	through
	keep "$b/start" through.pm
}
part_pass() {
	through
	local size i lines=('poisson-fft <through.pm >/dev/null' 'cat through.pm | poisson-fft | cat >/dev/null' \
		'poisson-fft <through.pm | mgrad | poisson-fft >/dev/null')
	size=$(wc -c <through.pm)
	rm -f pass.*
	for _ in 0 1 2 3 4 5 6 7; do
		for i in 0 1 2; do seconds "${lines[i]}" | awk -v b="$size" '{ print b / $1 / 1e9 }' >>pass.$i; done
	done
	sed 1d pass.0 | row pass-through 'one stage, file to /dev/null' GB/s '>=' 4
	sed 1d pass.1 | row pass-through 'one stage between two pipes' GB/s - 0
	sed 1d pass.2 | row pass-through 'three stages' GB/s - 0
	rm through.pm
}

# run NAME FILE STEPS ENGINE: cycle once; adds to NAME.stages and NAME.wall the seconds of the stages, without their set-up, and of all.
run() {
	rm -f timing.tsv
	cycle -n "$3" --engine "$4" --timing timing.tsv 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' <"$2" >/dev/null
	awk -F'\t' '/^cycle/ { wall = $3; next } { sum += $3 } END { print sum / '"$3"' >>"'"$1"'.stages"; print wall / '"$3"' >>"'"$1"'.wall" }' timing.tsv
}
# Overhead of cycle: time outside the stages. The first round is not counted, because it makes the FFT plans.
part_cycle() {
	pinit uniform -n 1000000 >large.pm
	pinit uniform -n 100 --cells 8 >tiny.pm
	for _ in 0 1 2 3 4 5 6 7; do
		run short large.pm 10 fused
		run large large.pm 60 fused
		OMP_WAIT_POLICY=active run awake large.pm 60 fused
		run tiny tiny.pm 5000 fused
		run piped-large large.pm 5 pipes
		run piped-longer large.pm 35 pipes
		run piped-tiny tiny.pm 100 pipes
	done
	sed -i 1d ./*.stages ./*.wall
	# steps 11 to 60; the first ten include reading and writing 56 MB and the first touch of memory
	paste short.stages short.wall large.stages large.wall | awk '{ print 100 * (1 - (60 * $3 - 10 * $1) / (60 * $4 - 10 * $2)) }' |
		row cycle 'fused, 1e6 particles, steps 11 to 60: overhead' % '<=' 2
	paste short.stages short.wall | awk '{ print 1e4 * ($2 - $1) }' | row cycle 'fused, 1e6 particles: reading, writing, first touch' ms - 0
	paste large.wall | awk '{ print 1e3 * $1 }' | row cycle 'fused, 1e6 particles: a step' ms - 0
	paste awake.wall large.wall | awk '{ print $2 / $1 }' | row cycle 'fused, 1e6 particles: a step over one with OMP_WAIT_POLICY=active' 'times' - 0
	# steps 6 to 35 of pipes; the first five include the start of all processes and the first touch of their memory
	paste piped-large.wall piped-longer.wall short.wall large.wall | awk '{ print (35 * $2 - 5 * $1) / 30 / ((60 * $4 - 10 * $3) / 50) }' |
		row cycle 'piped, 1e6 particles, steps 6 to 35: a step over a fused one' times '<=' 2.5
	paste large.stages piped-large.wall | awk '{ print 1e3 * ($2 - $1) }' |
		row cycle 'piped, 1e6 particles, the first five steps: a step above the fused stages' ms - 0
	paste tiny.stages tiny.wall | awk '{ print 1e6 * ($2 - $1) }' | row cycle 'fused, 100 particles, 5000 steps: overhead per step' us '<=' 20
	paste tiny.wall | awk '{ print 1e6 * $1 }' | row cycle 'fused, 100 particles: a step' us - 0
	paste tiny.stages piped-tiny.wall | awk '{ print 1e6 * ($2 - $1) }' | row cycle 'piped, 100 particles: a step above the fused stages' us - 0
}

part_transfer() {
	python3 "$top/bench/pmesh-painter.py" 160 >>"$PM_PEERS" || true
	keep "$b/transfer" 160 1
	keep "$b/transfer" 96 8 3 cic
	keep "$b/transfer" 1024 1 2 cic pcs
}
part_step() {
	PYTHONPATH=$top/python keep "${PM_PYTHON:-python3}" "$top/bench/python-step.py" 128 || true
	pinit uniform -n 2097152 --cells 128 | OMP_NUM_THREADS=1 keep "$b/step"
	awk '/^MemAvailable/ { exit $2 < 8e6 }' /proc/meminfo || { echo 'bench: skipped the step of 16.8 million particles (it needs 8 GB)' >&2 && return; }
	pinit uniform -n 16777216 --cells 256 | keep "$b/step"
}
# What users would run instead: ZPIC (PM_ZPIC), FINUFFT with FFTW (PM_FINUFFT).
part_es1d() {
	pinit langmuir -n 2097152 --cells 1024 --dim 1 --amplitude 0.5 | OMP_NUM_THREADS=1 keep "$b/es1d" cold
	pinit landau -n 2097152 --cells 1024 | OMP_NUM_THREADS=1 keep "$b/es1d" warm
	pinit langmuir -n 131072 --cells 1024 --dim 1 --dt 0.01 | OMP_NUM_THREADS=1 keep "$b/es1d" 628
}
part_vortex-step() {
	pinit taylor-green-2d --cells 512 --dt 0.0125 | keep "$b/vortex-step"
	pinit taylor-green-2d --cells 1024 --dt 0.00625 | keep "$b/vortex-step"
}

cd "$scratch"
true | tee "$rows" >"$PM_PEERS"
"$b/machine" >"$PM_MACHINE"
keep cat "$PM_MACHINE"
for p in "${parts[@]}"; do
	if [ "$(type -t "part_$p")" = function ]; then "part_$p"; else keep "$b/$p"; fi
done
echo
awk -f "$top/bench/table.awk" "$rows"
[ -z "$markdown" ] || {
	compiler=$("${CC:-gcc}" --version | sed 1q)
	model=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | sed 1q)
	awk -v markdown=1 -v about="$model, up to $cores threads, $compiler, load average $busy before it began" -f "$top/bench/table.awk" "$rows" \
		"$top/docs/speed.md" >speed.md
	cat speed.md >"$top/docs/speed.md"
}
