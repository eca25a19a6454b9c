# The house around the code: what is installed, what the directories promise.
# SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

@test "every tool is a program, and every program is a tool" {
	[ "$(cd "$top/tools" && ls -- *.c | sed 's/\.c$//' | sort)" = "$(ls "${PM_BIN:-$top/bin}" | sort)" ]
}
