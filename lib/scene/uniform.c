/* Uniformly distributed random particles in a periodic box, at rest or with a Maxwellian of 1-D dispersion `dispersion`.
 * Poisson noise: the number in a cell of the box has the variance of its mean. Masses are equal, or log-uniform over
 * `mass-spread` decades (m = mass/n 10^(spread (u - 1/2))). Total momentum is zero.
 * Source: Hockney, Eastwood 1988, section 9; HC-14 of the reference cases for the spread of masses.
 * Exact: mass (equal masses), energy_kinetic (mean over seeds; dim/2 M sigma^2 (1 - 1/n)). Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-bodies.h"

enum { MASS, LENGTH, DISPERSION, SPREAD, SOFTENING };

static const struct pm_scene_parameter rows[] = {
	{.name = "mass", .unit = "mass", .otherwise = 1, .high = 1e300, .text = "total mass"},
	{.name = "length", .unit = "length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "side of the box"},
	{.name = "dispersion", .unit = "velocity", .high = 1e300, .text = "standard deviation of each velocity component"},
	{.name = "mass-spread", .unit = "decades", .high = 100, .text = "masses log-uniform over so many decades"},
	{.name = "softening", .unit = "length", .otherwise = 0.001, .high = 1e6, .text = "softening length of direct sums"},
	{0},
};

static void particle(const struct pm_scene_choice *c, uint64_t id, const struct pm_scene_body *b)
{
	const uint64_t i = id - b->first;
	double u[2], w[2], z[2], z2[2];
	pm_random(c->seed, id, 0, u);
	pm_random(c->seed, id, 1, w);
	pm_random_normal(c->seed, id, 2, z);
	pm_random_normal(c->seed, id, 3, z2);
	const double place[3] = {u[0], u[1], w[0]}, velocity[3] = {z[0], z[1], z2[0]};
	for (int d = 0; d < c->dim; d++) {
		const double lo = c->box ? c->lo[d] : 0, hi = c->box ? c->hi[d] : c->value[LENGTH];
		b->x[d][i] = lo + (hi - lo) * place[d];
		b->v[d][i] = c->value[DISPERSION] * velocity[d];
		if (b->x[d][i] >= hi) /* rounding */
			b->x[d][i] = lo;
	}
	if (b->mass)
		b->mass[i] = c->value[MASS] / (double)c->n * pow(10, c->value[SPREAD] * (w[1] - 0.5));
}

/* [time] sqrt(L^dim/(G M)), or the time to cross the box at the dispersion where that is shorter. */
static double slowest(const struct pm_scene_choice *c)
{
	const double length = c->value[LENGTH], fall = c->value[MASS] > 0 ? sqrt(pow(length, c->dim) / c->value[MASS]) : HUGE_VAL;
	const double time = fmin(fall, c->value[DISPERSION] > 0 ? length / c->value[DISPERSION] : HUGE_VAL);
	return isfinite(time) ? time : 1;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	static const size_t cells[4] = {0, 128, 64, 32};
	const double mass = c->n ? c->value[MASS] / (double)c->n : 0;
	struct pm_scene_body b;
	pm_scene_world(f, 0, c->value[LENGTH], PM_PERIODIC, c->value[SOFTENING], 0.01 * slowest(c));
	if (pm_scene_mesh(f, cells[c->dim]) || pm_scene_set(f, "matter", c->n, true, c->value[SPREAD] > 0 ? NAN : mass, &b))
		return -PM_DATA;
#pragma omp parallel for schedule(static)
	for (uint64_t i = 0; i < b.here; i++)
		particle(c, b.first + i, &b);
	for (int d = 0; d < c->dim && c->value[DISPERSION] > 0; d++)
		pm_scene_centre(b.here, b.mass, b.v[d]);
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double sigma = pm_frame_parameter(f, "dispersion", 0), mass = pm_frame_parameter(f, "mass", 1);
	const struct pm_set *set = pm_frame_set(f, "matter");
	if (pm_frame_parameter(f, "mass-spread", 0) > 0)
		return NAN;
	if (!strcmp(quantity, "mass"))
		return mass;
	if (!strcmp(quantity, "energy_kinetic") && t == 0 && set && set->n)
		return 0.5 * f->dim * mass * sigma * sigma * (1 - 1 / (double)set->n);
	return NAN;
}

const struct pm_scene scene_uniform = {
	.name = "uniform",
	.sentence = "particles at random in a periodic box",
	.source = "Hockney, Eastwood 1988",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.dim = 3,
	.n = 10000,
	.random = true,
	.any_box = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
