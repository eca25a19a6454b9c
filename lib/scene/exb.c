/* Electrons that drift across a given uniform magnetic field B along z and electric field E along y: v = E x B/B^2 = E/B along x, plus a gyration
 * of `speed` about it; q = -1, m = 1, Omega = B. Both fields are given on the mesh, so `push boris/2 drift | m2p | push boris/2` moves them.
 * With the Boris scheme the drift averaged over a gyration is exactly E/B.
 * Source: Birdsall and Langdon 1985, section 4-3; PIC-12 of the reference cases.
 * Exact: mass, charge, drift (E/B); without gyration energy_kinetic, momentum_x, momentum_y. Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-plasma.h"

enum { SPEED, MAGNETIC, ELECTRIC, LENGTH, VELOCITIES };

static const struct pm_scene_parameter rows[] = {
	{.name = "speed", .unit = "length/time", .high = 1e300, .text = "of the gyration"},
	{.name = "magnetic-field", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "B along z; the gyration frequency"},
	{.name = "electric-field", .otherwise = 0.1, .low = -1e300, .high = 1e300, .text = "E along y; the drift is E/B along x"},
	{.name = "length", .unit = "length", .otherwise = 8, .low = 1e-300, .high = 1e300, .text = "side of the box"},
	{.name = "velocities", .otherwise = 2, .low = 2, .high = 3, .text = "components of v"},
	{0},
};

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double b[3] = {0, 0, c->value[MAGNETIC]}, e[3] = {0, c->value[ELECTRIC], 0}, middle = 0.5 * c->value[LENGTH];
	const double radius = c->value[SPEED] / b[2];
	double *x[3], *v[3];
	if (pm_scene_plasma_whole(1, c->value[VELOCITIES], 2))
		return -PM_USAGE;
	pm_scene_plasma_world(f, c->value[LENGTH], 0, 0.1 / c->value[MAGNETIC]);
	if (pm_scene_mesh(f, 16) || pm_scene_plasma_given(f, "B", "", 3, b) || pm_scene_plasma_given(f, "E", "", f->dim, e) ||
		pm_scene_plasma_set(f, c->n, (int)c->value[VELOCITIES], -1, 1, x, v))
		return -PM_DATA;
	for (uint64_t i = 0; i < c->n; i++) {
		const double angle = 2 * pm_pi * (double)i / (double)c->n;
		const double at[3] = {middle + radius * sin(angle), middle - radius * cos(angle), middle};
		for (int d = 0; d < f->dim; d++)
			x[d][i] = pm_scene_fold(at[d], c->value[LENGTH]);
		v[0][i] = c->value[SPEED] * cos(angle) + e[1] / b[2];
		v[1][i] = c->value[SPEED] * sin(angle);
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const struct pm_set *set = pm_frame_set(f, "electrons");
	const double n = set ? (double)set->n : NAN, drift = pm_frame_parameter(f, "electric-field", 0.1) / pm_frame_parameter(f, "magnetic-field", 1);
	const bool still = pm_frame_parameter(f, "speed", 0) == 0;
	(void)t;
	if (!strcmp(quantity, "mass"))
		return n;
	if (!strcmp(quantity, "charge"))
		return -n;
	if (!strcmp(quantity, "drift"))
		return drift;
	if (!strcmp(quantity, "energy_kinetic") && still)
		return 0.5 * n * drift * drift;
	if (!strcmp(quantity, "momentum_x") && still)
		return n * drift;
	if (!strcmp(quantity, "momentum_y") && still)
		return 0;
	return NAN;
}

const struct pm_scene scene_exb = {
	.name = "exb",
	.sentence = "electrons drifting across uniform electric and magnetic fields",
	.source = "Birdsall and Langdon 1985, 4-3",
	.dims = 1u << 2 | 1u << 3,
	.dim = 2,
	.n = 1,
	.any_box = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
