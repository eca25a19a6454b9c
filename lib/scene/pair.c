/* Two particles at rest anywhere in a periodic box whose default mesh has cells of length 1: for the detailed comparison of a force.
 * The defaults are PM-01 of the reference cases: 16^3 cells, m = 1 at (3.3, 4.7, 5.2) and m = 2 at (7.9, 6.1, 9.4), G = 1, lap phi =
 * 4 pi G (rho - mean); with them the field of the neutralised periodic system at the first particle is acc_x, acc_y, acc_z of `exact`
 * (Ewald sums, two splittings agree to 1e-13). Exact: mass, energy_kinetic = 0 (at t = 0). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-bodies.h"

enum { LENGTH, X1, Y1, Z1, X2, Y2, Z2, M1, M2, SOFTENING };

static const struct pm_scene_parameter rows[] = {
	{.name = "length", .unit = "cells", .otherwise = 16, .low = 1, .high = 4096, .text = "side of the box, and the number of cells on each axis"},
	{.name = "x1", .unit = "length", .otherwise = 3.3, .high = 4096, .text = "first particle, x"},
	{.name = "y1", .unit = "length", .otherwise = 4.7, .high = 4096, .text = "first particle, y"},
	{.name = "z1", .unit = "length", .otherwise = 5.2, .high = 4096, .text = "first particle, z"},
	{.name = "x2", .unit = "length", .otherwise = 7.9, .high = 4096, .text = "second particle, x"},
	{.name = "y2", .unit = "length", .otherwise = 6.1, .high = 4096, .text = "second particle, y"},
	{.name = "z2", .unit = "length", .otherwise = 9.4, .high = 4096, .text = "second particle, z"},
	{.name = "m1", .unit = "mass", .otherwise = 1, .high = 1e300, .text = "first particle, mass"},
	{.name = "m2", .unit = "mass", .otherwise = 2, .high = 1e300, .text = "second particle, mass"},
	{.name = "softening", .unit = "length", .high = 1e6, .text = "softening length of direct sums"},
	{0},
};

/* [time] sqrt((d^2 + softening^2)^(3/2)/(G M)) of two bodies at distance d; standard: of the default parameters. */
static double orbit(const struct pm_scene_choice *c, bool standard)
{
	double value[SOFTENING + 1], square;
	for (int i = 0; i <= SOFTENING; i++)
		value[i] = standard ? rows[i].otherwise : c->value[i];
	square = value[SOFTENING] * value[SOFTENING];
	for (int d = 0; d < c->dim; d++)
		square += (value[X1 + d] - value[X2 + d]) * (value[X1 + d] - value[X2 + d]);
	return sqrt(pow(square, 1.5) / (value[M1] + value[M2]));
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double length = c->value[LENGTH];
	struct pm_scene_body b;
	if (length != floor(length))
		return pm_fail(PM_USAGE, "--length %g is not a whole number of cells", length);
	for (int d = 0; d < c->dim; d++)
		if (c->value[X1 + d] >= length || c->value[X2 + d] >= length)
			return pm_fail(PM_USAGE, "a particle lies outside the box 0..%g (change --length or the positions)", length);
	const double time = orbit(c, false), standard = orbit(c, true);
	pm_scene_world(f, 0, length, PM_PERIODIC, c->value[SOFTENING], time > 0 && isfinite(time) ? 0.1 * (time / standard) : 0.1);
	if (pm_scene_mesh(f, (size_t)length) || pm_scene_set(f, "matter", 2, true, c->value[M1] == c->value[M2] ? c->value[M1] : NAN, &b))
		return -PM_DATA;
	for (int i = 0; i < 2; i++) {
		for (int d = 0; d < c->dim; d++) {
			b.x[d][i] = c->value[(i ? X2 : X1) + d];
			b.v[d][i] = 0;
		}
		if (b.mass)
			b.mass[i] = c->value[M1 + i];
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	static const double force[3] = {0.0269507714622, 0.00946960886732, 0.0254426249975};
	bool standard = f->dim == 3 && t == 0;
	for (int i = LENGTH; i < SOFTENING; i++)
		standard = standard && pm_frame_parameter(f, rows[i].name, rows[i].otherwise) == rows[i].otherwise;
	if (!strcmp(quantity, "mass"))
		return pm_frame_parameter(f, "m1", 1) + pm_frame_parameter(f, "m2", 2);
	if (!strcmp(quantity, "energy_kinetic") && t == 0)
		return 0;
	if (standard && !strncmp(quantity, "acc_", 4) && quantity[4] >= 'x' && quantity[4] <= 'z' && !quantity[5])
		return force[quantity[4] - 'x'];
	return NAN;
}

const struct pm_scene scene_pair = {
	.name = "pair",
	.sentence = "two particles at rest in a periodic box, to look at a force",
	.source = "PM-01 of the reference cases",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.dim = 3,
	.n = 2,
	.n_fixed = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
