/* A cold plane wave that collapses in a static periodic box: x = q + A sin(k q), at rest, q on a lattice (or as --loading says), k = 2 pi mode/length along x.
 * Until the sheets cross (k A = 1) the exact motion is A(t) = A0 cosh(w t), w^2 = 4 pi G rho (the mean of rho is removed); w = 1 by the default
 * density 1/(4 pi). On a mesh with cic and the fd2 Laplacian w becomes w cos(k dx/2), and the leapfrog's growth per step obeys
 * sinh(g dt/2) = w dt/2. Source: Zel'dovich 1970; PM-06 of the reference cases.
 * Exact: mass, kA, speed_rms, energy_kinetic, crossing (the time when k A = 1). Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-bodies.h"
#include "scene-parts/scene-loading.h"

enum { AMPLITUDE, MODE, LENGTH, DENSITY, SOFTENING };

static const struct pm_scene_parameter rows[] = {
	{.name = "amplitude", .otherwise = 0.05, .high = 0.999, .text = "k A at the start"},
	{.name = "mode", .otherwise = 1, .low = 1, .high = 1e6, .text = "waves in the box"},
	{.name = "length", .unit = "length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "side of the box"},
	{.name = "density", .unit = "mass/length^dim", .otherwise = 0.25 / 3.14159265358979323846, .high = 1e300,
		.text = "mean density; 1/(4 pi) makes the growth rate 1"},
	{.name = "softening", .unit = "length", .otherwise = 0.001, .high = 1e6, .text = "softening length of direct sums"},
	{0},
};

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	static const size_t cells[4] = {0, 128, 64, 16};
	const bool lattice = c->loading == PM_LATTICE;
	const size_t side = lattice ? pm_scene_per_axis(c->n ? c->n : 1, c->dim) : 1;
	const double length = c->value[LENGTH], k = 2 * pm_pi * c->value[MODE] / length, volume = pow(length, c->dim);
	struct pm_scene_body b;
	if (!side)
		return -PM_USAGE;
	if (c->value[MODE] != floor(c->value[MODE]))
		return pm_fail(PM_USAGE, "--mode %g is not a whole number of waves", c->value[MODE]);
	/* 1/20 of the growth time 1/sqrt(4 pi G density) */
	const double slow = c->value[DENSITY] > 0 ? sqrt(rows[DENSITY].otherwise / c->value[DENSITY]) : 1;
	pm_scene_world(f, 0, length, PM_PERIODIC, c->value[SOFTENING], 0.05 * slow);
	if (pm_scene_mesh(f, cells[c->dim]) || pm_scene_set(f, "matter", c->n, true, c->n ? c->value[DENSITY] * volume / (double)c->n : 0, &b))
		return -PM_DATA;
	if (!lattice && pm_scene_points(c->loading, c->seed, c->n, c->dim, (double *const[PM_LOAD_AXES]){b.x[0], b.x[1], b.x[2]}))
		return -PM_DATA;
	for (uint64_t i = 0; i < c->n; i++) {
		const size_t at[3] = {i % side, i / side % side, i / side / side};
		for (int d = 0; d < c->dim; d++) {
			const double q = lattice ? ((double)at[d] + 0.5) / (double)side * length : b.x[d][i] * length;
			b.x[d][i] = d ? q : q + c->value[AMPLITUDE] / k * sin(k * q);
			b.v[d][i] = 0;
		}
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double length = pm_frame_parameter(f, "length", 1), k = 2 * pm_pi * pm_frame_parameter(f, "mode", 1) / length;
	const double density = pm_frame_parameter(f, "density", rows[DENSITY].otherwise), w = sqrt(4 * pm_pi * pm_frame_constant(f, "G", 1) * density);
	const double start = pm_frame_parameter(f, "amplitude", 0.05), mass = density * pow(length, f->dim);
	const double crossing = acosh(1 / start) / w, speed = start / k * w * sinh(w * t) / sqrt(2); /* rms over a whole wave */
	if (!strcmp(quantity, "mass"))
		return mass;
	if (!strcmp(quantity, "crossing"))
		return crossing;
	if (t > crossing)
		return NAN;
	if (!strcmp(quantity, "kA"))
		return start * cosh(w * t);
	if (!strcmp(quantity, "speed_rms"))
		return speed;
	if (!strcmp(quantity, "energy_kinetic"))
		return 0.5 * mass * speed * speed;
	return NAN;
}

const struct pm_scene scene_cold_collapse = {
	.name = "cold-collapse",
	.sentence = "a cold plane wave collapsing under its own gravity in a periodic box",
	.source = "Zel'dovich 1970, Astron. Astrophys. 5, 84",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.dim = 1,
	.n = 4096,
	.loads = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
