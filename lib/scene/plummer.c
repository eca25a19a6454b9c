/* A Plummer sphere in equilibrium, G = M = a = 1: rho = 3/(4 pi) (1 + r^2)^(-5/2), f(E) ~ (-E)^(7/2), sigma^2(r) = 1/(6 sqrt(1 + r^2)).
 * Radii from the mass fraction M(r) = (1 + r^-2)^(-3/2), speeds by rejection from q^2 (1 - q^2)^(7/2), q = v/v_escape.
 * Source: Aarseth, Henon, Wielen 1974, Astron. Astrophys. 37, 183, appendix.
 * The sphere ends at `truncation`; the mass outside is left out, not redistributed (1.5 % at 10 a), so density and potential
 * gradient inside are Plummer's. Centre of mass and momentum are zero. With theta = atan(truncation) the energies are
 * K = 3/32 (theta - sin(4 theta)/4) and W = -3 (theta/16 - sin(4 theta)/64 - sin(2 theta)^3/48); in total -3 pi/64 without truncation.
 * Exact: mass, energy_kinetic, energy_field_pair, energy, virial_ratio, radius_F (fraction F of the mass kept), dispersion_centre. Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-bodies.h"

enum { TRUNCATION, SOFTENING };

static const struct pm_scene_parameter rows[] = {
	{.name = "truncation", .unit = "length", .otherwise = 10, .low = 0.1, .high = 1e6,
		.text = "no particle starts outside this radius (the scale radius is 1)"},
	{.name = "softening", .unit = "length", .otherwise = 0.02, .high = 1e6, .text = "softening length of direct sums"},
	{0},
};

static double mass_within(double r) { return pow(1 + 1 / (r * r), -1.5); }
static double radius_of(double mass) { return 1 / sqrt(pow(mass, -2.0 / 3) - 1); }

/* A vector of length r whose direction is uniform on the sphere, from two uniform numbers. */
static void spread(double r, double cosine, double turn, double x[3])
{
	const double c = 2 * cosine - 1, s = sqrt(1 - c * c);
	x[0] = r * s * cos(2 * pm_pi * turn);
	x[1] = r * s * sin(2 * pm_pi * turn);
	x[2] = r * c;
}

/* Speed in units of the escape velocity: q^2 (1-q^2)^3.5 lies below 0.1 (its maximum is 0.0919 at q^2 = 2/9). */
static double speed(uint64_t seed, uint64_t id)
{
	double u[2];
	for (uint64_t k = 3;; k++) {
		pm_random(seed, id, k, u);
		if (0.1 * u[1] < u[0] * u[0] * pow(1 - u[0] * u[0], 3.5))
			return u[0];
	}
}

static void particle(uint64_t seed, uint64_t id, double kept, double x[3], double v[3])
{
	double u[3][2];
	for (uint64_t k = 0; k < 3; k++)
		pm_random(seed, id, k, u[k]);
	const double r = radius_of(kept * u[0][0]), escape = sqrt(2 / sqrt(1 + r * r));
	spread(r, u[1][0], u[1][1], x);
	spread(escape * speed(seed, id), u[2][0], u[2][1], v);
}

/* Shorter in proportion to the softening below the default: the time in which a body passes another at the softening, or at 1/n, where it is scattered. */
static double pass(const struct pm_scene_choice *c)
{
	return fmin(1, fmax(c->value[SOFTENING], c->n ? 1 / (double)c->n : 1) / rows[SOFTENING].otherwise);
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double kept = mass_within(c->value[TRUNCATION]), side = 14 * fmax(1, c->value[TRUNCATION] / 10);
	struct pm_scene_body b;
	pm_scene_world(f, -side, side, PM_OPEN, c->value[SOFTENING], pass(c) / 32);
	if (pm_scene_mesh(f, 64) || pm_scene_set(f, "matter", c->n, true, c->n ? kept / (double)c->n : 0, &b))
		return -PM_DATA;
#pragma omp parallel for schedule(static)
	for (uint64_t i = 0; i < b.here; i++) {
		double x[3], v[3];
		particle(c->seed, b.first + i, kept, x, v);
		for (int d = 0; d < 3; d++)
			b.x[d][i] = x[d], b.v[d][i] = v[d];
	}
	for (int d = 0; d < 3; d++) {
		pm_scene_centre(b.here, NULL, b.x[d]);
		pm_scene_centre(b.here, NULL, b.v[d]);
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double end = pm_frame_parameter(f, "truncation", rows[TRUNCATION].otherwise), theta = atan(end);
	const double kinetic = 3.0 / 32 * (theta - sin(4 * theta) / 4);
	const double field = -3 * (theta / 16 - sin(4 * theta) / 64 - pow(sin(2 * theta), 3) / 48);
	(void)t; /* an equilibrium */
	if (!strcmp(quantity, "mass"))
		return mass_within(end);
	if (!strcmp(quantity, "energy_kinetic"))
		return kinetic;
	if (!strcmp(quantity, "energy_field_pair"))
		return field;
	if (!strcmp(quantity, "energy"))
		return kinetic + field;
	if (!strcmp(quantity, "virial_ratio"))
		return -2 * kinetic / field;
	if (!strcmp(quantity, "dispersion_centre"))
		return sqrt(1.0 / 6);
	double fraction;
	if (sscanf(quantity, "radius_%lf", &fraction) == 1)
		return radius_of(fraction * mass_within(end));
	return NAN;
}

const struct pm_scene scene_plummer = {
	.name = "plummer",
	.sentence = "a Plummer sphere in equilibrium, G = M = a = 1, open space",
	.source = "Aarseth, Henon, Wielen 1974",
	.dims = 1u << 3,
	.dim = 3,
	.n = 10000,
	.random = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
