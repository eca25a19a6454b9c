#!/usr/bin/env bats
# Sentences drawn at random, alone and with several ranks and threads (tests/ranks-random.py). SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

@test "two hundred sentences drawn at random: with any number of ranks and threads the bytes, messages and codes of a run alone; in check-long 1000 others" {
	run -0 env PM_BIN="${PM_BIN:-$top/bin}" python3 "$top/tests/ranks-random.py" "$([ -z "${PM_LONG:-}" ] && echo 200 || echo 1000)" "${PM_SEED:-$([ -z "${PM_LONG:-}" ] &&
		echo 20261123 || date +%Y%m%d)}"
	[[ $output == *" 0 DIFFERENT or HANGS"* ]]
}
