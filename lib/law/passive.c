/* Particles carried by a velocity that is given on a mesh: vel += u, x' = vel. They make no field.
 * Source: none needed (the definition of a passive tracer). Assumes that the mesh has the field u (role state where the input prescribes it).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "law/law.h"

static const struct pm_law_constant constants[] = {{0}};

const struct pm_law law_passive = {
	.name = "passive",
	.sentence = "particles are carried by a given velocity u",
	.source = "Cottet and Koumoutsakos 2000",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.field = "u",
	.change = "vel",
	.of = "x",
	.kernel = "cic",
	.constants = constants,
};
