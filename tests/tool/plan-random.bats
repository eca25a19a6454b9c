# plan on frames drawn at random, and on those of them that it once got wrong. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

random() { PM_BIN=${PM_BIN:-$top/bin} python3 "$top/tests/plan-random.py" "$@"; }

@test "ten frames drawn at random, run by their plans: within the accuracy, refused or warned of; two hundred in check-long" {
	run -0 random "$([ -z "${PM_LONG:-}" ] && echo 10 || echo 200)" 20261122
	[[ $output == *"0 WRONG"* ]]
}

@test "a cold lattice on a mesh: its folded waves are foreseen, and a mesh with fewer than ten particles in a cell is not taken for finer" {
	pinit langmuir -n 343 --cells 32 --amplitude 0.00219 >wave # at 128 cells, 2.7 in each, the error is 0.08
	[[ "$(plan -t 79.9 --accuracy 0.0003 --sentence <wave 2>/dev/null)" != *"-n 128"* ]]
	pinit langmuir -n 362 --cells 64 --amplitude 0.232 | plan -t 88.8 --accuracy 0.003 --format json >answer # error 0.3
	[ "$(jq -c .warnings answer)" != '[]' ]
}
