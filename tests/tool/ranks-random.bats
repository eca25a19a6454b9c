#!/usr/bin/env bats
# Sentences drawn at random, alone and with several ranks and threads (tests/ranks-random.py). SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

@test "120 sentences drawn at random: with any number of ranks and threads the bytes, messages and codes of a run alone; in check-long 1000 others" {
	local what=(120 20261123)
	[ -z "${PM_LONG:-}" ] || what=(1000 "$(date +%Y%m%d)")
	run -0 env PM_BIN="${PM_BIN:-$top/bin}" python3 "$top/tests/ranks-random.py" "${what[@]}"
	[[ $output == *" 0 DIFFERENT or HANGS"* ]]
}
