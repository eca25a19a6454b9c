/* No field of its own: particles move by the rates that stages add to acc or vel (pair forces, external fields), x' = v, v' = acc.
 * Source: none needed (Newton's first law). Assumes nothing; words that need a law's strength or equation refuse this law with a message.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "law/law.h"

static const struct pm_law_constant constants[] = {{0}};

const struct pm_law law_free = {
	.name = "free",
	.sentence = "no field of its own: particles move by the accelerations or velocities that words add",
	.source = "Newton 1687",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.constants = constants,
};
