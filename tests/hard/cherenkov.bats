# Numerical Cherenkov radiation: a cold neutral beam of electrons and positrons at gamma = 10 on periodic meshes, whose fields grow from its thermal spread of
# 1e-6 c. docs/methods/maxwell.md has the table of all methods and kernels, made by the function growth of this file. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

v=0.99498743710661997 # gamma = 10
whole=1.0050378152592121 # c dt/h with which the beam moves by a cell a step

# beam DIM CELLS PARTICLES DT: units of the plasma frequency and c; cells of 1.
beam() {
	pinit plasma --dim "$1" --length 32 --cells "$2" | smod --law electromagnetic --constant c=1,background=0 --dt "$4" |
		species electrons -n "$3" --distribution juettner --vth 1e-6 --drift $v |
		species positrons --charge 1 -n "$3" --distribution juettner --vth 1e-7 --drift $v
}

# growth KERNEL DT SMOOTH GAUSS STEP GATHER: rate of growth of B from ln B between -9.5 and -1, or where it stays below from the second half, over 240 times.
growth() {
	beam 2 32 4096 "$2" | p2m --kernel "$1" | maxwell --gauss $4 |
		cycle -t 240 --every 4 "push boris/2 | p2m --current --kernel $1 | $3 maxwell $5 | push drift | m2p $6 | push boris/2" |
		diag --columns time,energy_magnetic |
		awk 'NR > 1 && $2 > 0 { t[++n] = $1; a[n] = log($2) / 2 }
			function fit(from, to,  i, k, sx, sy, sxx, sxy) {
				for (i = from; i <= to; i++) { k++; sx += t[i]; sy += a[i]; sxx += t[i]^2; sxy += t[i] * a[i] }
				return (k * sxy - sx * sy) / (k * sxx - sx * sx) }
			END { lo = 1; while (lo < n && a[lo] < -9.5) { lo++ }
				hi = lo; while (hi < n && a[hi] < -1) { hi++ }
				printf "%.4f\n", (a[n] < -5 || lo == n) ? fit(int(n / 2), n) : fit(lo, hi) }'
}

@test "numerical Cherenkov: a beam on Yee's mesh and by waves grows; by waves on the nodes, a cell a step and with the current's drift, it does not" {
	within "$(growth tsc 0.7 "" "" "")" 0.12 0.02
	within "$(growth tsc $whole "" "--method psatd" "--method psatd")" 0.128 0.02
	cured=$(growth tsc $whole "" "--method psatd --nodal" "--method psatd --current-drift $v")
	below "$cured" 0.002
}

@test "numerical Cherenkov with m2p --energy-conserving: faster with short steps, and slower at c dt = 0.7 h" {
	within "$(growth tsc 0.5 "" "" "" --energy-conserving)" 0.129 0.02
	within "$(growth tsc 0.7 "" "" "" --energy-conserving)" 0.081 0.02
}

@test "a relativistic beam passes 1e4 cells without loss: 1-D, and 2-D with PM_LONG=1" {
	for dim in 1 ${PM_LONG:+2}; do
		sh_ok "$(declare -f beam); v=$v; beam $dim 32 $((256 * dim * dim)) $whole | p2m --kernel pcs |
			maxwell --gauss --method psatd --nodal >start.pm"
		sh_ok "cycle -n 10000 <start.pm >end.pm \
			'push vay/2 | p2m --current --kernel pcs | smooth | maxwell --method psatd --current-drift $v | push drift | m2p | push vay/2'"
		was=$(diag start.pm --columns energy_kinetic | tail -n 1)
		within "$(diag end.pm --columns energy_kinetic | tail -n 1)" "$was" "$(awk -v e="$was" 'BEGIN { print 1e-6 * e }')" "dim $dim"
		below "$(diag end.pm --columns energy_magnetic | tail -n 1)" 0.1
	done
}
