/* A cold simple lattice in a periodic box: x = (i + offset/spacing) * spacing, in cells of the default mesh, whose spacing is 1.
 * In the continuum no particle feels a force. On a mesh this holds (to rounding) only if the spacing is a whole number of cells:
 * spacing 1.5 has a largest force component of 0.945 G rho dx with cic and 0.478 with tsc (fd2 Laplacian, 4-point gradient).
 * Source: PM-13 and HC-15 of the reference cases. Exact: mass, speed_rms = 0, energy_kinetic = 0. Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-bodies.h"

enum { SPACING, OFFSET, DENSITY, SOFTENING };

static const struct pm_scene_parameter rows[] = {
	{.name = "spacing", .unit = "cells", .otherwise = 2, .low = 0.01, .high = 1e6,
		.text = "distance of neighbours in cells of the default mesh (the cell is 1 long)"},
	{.name = "offset", .unit = "cells", .otherwise = 0.3, .high = 1e6, .text = "distance of the first particle from the first mesh point, on every axis"},
	{.name = "density", .unit = "mass/length^dim", .otherwise = 1, .high = 1e300, .text = "mean density"},
	{.name = "softening", .unit = "length", .otherwise = 0.1, .high = 1e6, .text = "softening length of direct sums"},
	{0},
};

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const size_t side = pm_scene_per_axis(c->n ? c->n : 1, c->dim);
	const double spacing = c->value[SPACING], length = spacing * (double)side;
	struct pm_scene_body b;
	if (!side)
		return -PM_USAGE;
	if (length != floor(length) || c->value[OFFSET] >= spacing)
		return pm_fail(PM_USAGE, "%zu particles per axis, %g cells apart, %g from the edge, do not fill whole cells (change --spacing, --offset or -n)",
			side, spacing, c->value[OFFSET]);
	pm_scene_world(f, 0, length, PM_PERIODIC, c->value[SOFTENING], 0.05 / (c->value[DENSITY] > 0 ? sqrt(c->value[DENSITY]) : 1));
	if (pm_scene_mesh(f, (size_t)length) || pm_scene_set(f, "matter", c->n, true, c->value[DENSITY] * pow(spacing, c->dim), &b))
		return -PM_DATA;
	for (uint64_t i = 0; i < c->n; i++) {
		const size_t at[3] = {i % side, i / side % side, i / side / side};
		for (int d = 0; d < c->dim; d++) {
			b.x[d][i] = c->value[OFFSET] + spacing * (double)at[d];
			b.v[d][i] = 0;
		}
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const struct pm_set *set = pm_frame_set(f, "matter");
	(void)t;
	if (!strcmp(quantity, "mass") && set)
		return (double)set->n * pm_frame_parameter(f, "density", 1) * pow(pm_frame_parameter(f, "spacing", 2), f->dim);
	if (!strcmp(quantity, "speed_rms") || !strcmp(quantity, "energy_kinetic"))
		return 0;
	return NAN;
}

const struct pm_scene scene_lattice = {
	.name = "lattice",
	.sentence = "a cold lattice of particles in a periodic box, without force",
	.source = "PM-13 of the reference cases",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.dim = 3,
	.n = 4096,
	.any_box = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
