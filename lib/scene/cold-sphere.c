/* A uniform sphere that collapses from rest, G = M = R = 1, particles at random. Shells do not cross:
 * r(t) = r(0) cos^2 b with b + sin b cos b = (pi/2) t/t_ff and t_ff = (pi/2) sqrt(R^3/(2 G M)) = 1.1107. The step is t_ff/200.
 * Source: Peebles 1980, section 19; PM-08 of the reference cases. Poisson noise grows into fragments: valid to 0.75 t_ff, not beyond.
 * Exact: mass, radius_F, energy_field_pair and energy at t = 0 (-3/5), free_fall. Centre of mass zero. Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-bodies.h"

enum { SOFTENING };

static const struct pm_scene_parameter rows[] = {
	{.name = "softening", .unit = "length", .otherwise = 0.02, .high = 1e6, .text = "softening length of direct sums"},
	{0},
};

static double free_fall(void) { return 0.5 * pm_pi / sqrt(2); }

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	struct pm_scene_body b;
	pm_scene_world(f, -1.5, 1.5, PM_OPEN, c->value[SOFTENING], free_fall() / 200);
	if (pm_scene_mesh(f, 64) || pm_scene_set(f, "matter", c->n, true, c->n ? 1 / (double)c->n : 0, &b))
		return -PM_DATA;
#pragma omp parallel for schedule(static)
	for (uint64_t i = 0; i < c->n; i++) {
		double u[2], w[2];
		pm_random(c->seed, i, 0, u);
		pm_random(c->seed, i, 1, w);
		const double r = cbrt(u[0]), z = 2 * u[1] - 1, s = sqrt(1 - z * z);
		const double x[3] = {r * s * cos(2 * pm_pi * w[0]), r * s * sin(2 * pm_pi * w[0]), r * z};
		for (int d = 0; d < 3; d++)
			b.x[d][i] = x[d], b.v[d][i] = 0;
	}
	for (int d = 0; d < 3; d++)
		pm_scene_centre(c->n, NULL, b.x[d]);
	return 0;
}

/* cos^2 b at time t, by bisection of b + sin b cos b = (pi/2) t/t_ff (monotone). */
static double shrink(double t)
{
	const double want = 0.5 * pm_pi * t / free_fall();
	double low = 0, high = 0.5 * pm_pi;
	for (int i = 0; i < 60; i++) {
		const double b = 0.5 * (low + high);
		if (b + sin(b) * cos(b) < want)
			low = b;
		else
			high = b;
	}
	return cos(low) * cos(low);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	double fraction;
	(void)f;
	if (!strcmp(quantity, "mass"))
		return 1;
	if (!strcmp(quantity, "free_fall"))
		return free_fall();
	if (!strcmp(quantity, "energy"))
		return -0.6;
	if (t > free_fall())
		return NAN;
	if (!strcmp(quantity, "energy_field_pair"))
		return -0.6 / shrink(t);
	if (!strcmp(quantity, "energy_kinetic"))
		return 0.6 / shrink(t) - 0.6;
	if (sscanf(quantity, "radius_%lf", &fraction) == 1)
		return cbrt(fraction) * shrink(t);
	return NAN;
}

const struct pm_scene scene_cold_sphere = {
	.name = "cold-sphere",
	.sentence = "a uniform sphere at rest that falls together, G = M = R = 1",
	.source = "Peebles 1980, section 19",
	.dims = 1u << 3,
	.dim = 3,
	.n = 10000,
	.random = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
