/* An empty box for a plasma: the law electrostatic with eps0 = 1, immobile ions of the charge density --background, faces periodic, and no
 * particles. The word species fills it. With electrons of density 1, charge -1 and mass 1, omega_p = 1, and with vth = 1 lambda_D = 1.
 * Exact: mass, charge (0). Cost 1. Source: Birdsall and Langdon 1985, section 2-4. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-plasma.h"

enum { LENGTH, BACKGROUND };

static const struct pm_scene_parameter rows[] = {
	{.name = "length", .unit = "length", .otherwise = 12.566370614359172, .low = 1e-300, .high = 1e300, .text = "side of the box"},
	{.name = "background", .unit = "charge/volume", .otherwise = 1, .low = -1e300, .high = 1e300, .text = "charge density of immobile ions"},
	{0},
};

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	if (c->n)
		return pm_fail(PM_USAGE, "the scene plasma is an empty box (without -n; species fills it)");
	pm_scene_plasma_world(f, c->value[LENGTH], c->value[BACKGROUND], 0.1);
	return pm_scene_mesh(f, c->dim == 1 ? 64 : 32) ? -PM_DATA : 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	(void)f, (void)t;
	return !strcmp(quantity, "mass") || !strcmp(quantity, "charge") ? 0 : NAN;
}

const struct pm_scene scene_plasma = {
	.name = "plasma",
	.sentence = "an empty box with the law electrostatic, which the word species fills",
	.source = "Birdsall and Langdon 1985, section 2-4",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.dim = 1,
	.n = 0,
	.any_box = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
