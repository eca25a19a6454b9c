/* Vorticity at random in a periodic box of side 2 pi, in the plane and in space: all waves with | |k| - band | <= 1, of equal amplitude and random phase, in
 * space of random direction across k, so that the vorticity has no divergence:
 *     omega = rms (2/n)^(1/2) sum over the n pairs +-k of e_k cos(k . x + p_k),   e_k . k = 0
 * The flow of decaying turbulence: in the plane vortices gather and merge while the enstrophy falls, in space they are stretched.
 * Source: McWilliams 1984, J. Fluid Mech. 146, 21 (plane); Rogallo 1981, NASA TM 81315 (space).
 * Exact at the start: enstrophy rms^2/2 a volume, energy, the totals 0, which stay. Cost: nodes of the mesh times waves.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-vortex-set.h"

enum { RMS, BAND, NU };

static const struct pm_scene_parameter rows[] = {
	{.name = "rms", .unit = "1/time", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "root mean square of the vorticity"},
	{.name = "band", .otherwise = 4, .low = 1, .high = 64, .text = "wave number k about which the waves are; 2 pi is the side of the box"},
	{.name = "nu", .unit = "length^2/time", .otherwise = 1e-3, .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

/* Steps through the wave vectors of the band, one of each pair +-k; false behind the last. Begins with k[0] = -band - 2. */
static bool next(int k[3], int dim, double band)
{
	const int most = (int)band + 1;
	for (;;) {
		int d = 0;
		if (k[0] < -most) {
			k[0] = k[1] = -most, k[2] = dim == 3 ? -most : 0;
		} else {
			while (d < dim && ++k[d] > most)
				k[d++] = -most;
			if (d == dim)
				return false;
		}
		const int sign = k[2] ? k[2] : k[1] ? k[1] : k[0];
		const double size = sqrt((double)(k[0] * k[0] + k[1] * k[1] + k[2] * k[2]));
		if (sign > 0 && fabs(size - band) <= 1)
			return true;
	}
}

/* The number of waves, and the sum of 1/k^2. */
static size_t waves(int dim, double band, double *over_squares)
{
	int k[3] = {-(int)band - 2};
	size_t n = 0;
	for (*over_squares = 0; next(k, dim, band); n++)
		*over_squares += 1.0 / (k[0] * k[0] + k[1] * k[1] + k[2] * k[2]);
	return n;
}

/* A unit vector across k at the angle a; in the plane it stands on the plane. */
static void across(int dim, const int k[3], double a, double e[3])
{
	const double size = sqrt((double)(k[0] * k[0] + k[1] * k[1] + k[2] * k[2])), flat = hypot(k[0], k[1]);
	const double one[3] = {flat > 0 ? -k[1] / flat : 1, flat > 0 ? k[0] / flat : 0, 0}; /* across k and z */
	const double two[3] = {-k[2] * one[1] / size, k[2] * one[0] / size, (k[0] * one[1] - k[1] * one[0]) / size};
	for (int c = 0; c < 3; c++)
		e[c] = dim == 2 ? 1 : cos(a) * one[c] + sin(a) * two[c];
}

static void fill(const struct pm_scene_choice *c, size_t n, double volume, double *const x[3], double *const strength[3])
{
	double sum;
	const size_t many = waves(c->dim, c->value[BAND], &sum);
	const double amplitude = c->value[RMS] * sqrt(2.0 / (double)many) * volume;
	int k[3] = {-(int)c->value[BAND] - 2};
	for (uint64_t wave = 0; next(k, c->dim, c->value[BAND]); wave++) {
		double u[2], e[3];
		pm_random(c->seed, wave, 0, u);
		across(c->dim, k, 2 * pm_pi * u[1], e);
#pragma omp parallel for schedule(static) if (n > 16384)
		for (size_t i = 0; i < n; i++) {
			const double z = c->dim == 3 ? x[2][i] : 0, wave_here = amplitude * cos(k[0] * x[0][i] + k[1] * x[1][i] + k[2] * z + 2 * pm_pi * u[0]);
			for (int d = 0; d < (c->dim == 3 ? 3 : 1); d++)
				strength[d][i] += e[d] * wave_here;
		}
	}
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double lo[3] = {0}, hi[3] = {2 * pm_pi, 2 * pm_pi, 2 * pm_pi};
	const size_t plane[3] = {128, 128, 1}, space[3] = {32, 32, 32};
	double *x[3] = {NULL}, *strength[3] = {NULL}, volume = 1;
	size_t n = 1;
	f->dt = 0.1 / c->value[RMS];
	pm_frame_constant_set(f, "nu", c->value[NU]);
	if (pm_scene_vortex_box(c, f, c->dim, lo, hi, PM_PERIODIC, c->dim == 2 ? plane : space))
		return -PM_DATA;
	const struct pm_mesh *m = pm_frame_mesh(f, "mesh");
	for (int d = 0; d < c->dim; d++) {
		if ((double)m->cells[d] < 2 * c->value[BAND] + 3)
			return pm_fail(PM_USAGE, "%zu cells along %c do not resolve waves of k = %g (--cells, or a lower --band)", m->cells[d], "xyz"[d],
				c->value[BAND] + 1);
		n *= m->cells[d], volume *= m->h[d];
	}
	pm_scene_vortex_dt(f, m);
	if (pm_scene_vortex_set(f, c->dim, n, volume, x, strength))
		return -PM_DATA;
	for (size_t i = 0; i < n; i++)
		for (int d = 0; d < c->dim; d++) {
			const size_t row = d == 0 ? i % m->cells[0] : d == 1 ? i / m->cells[0] % m->cells[1] : i / m->cells[0] / m->cells[1];
			x[d][i] = m->lo[d] + (double)row * m->h[d];
		}
	fill(c, n, volume, x, strength);
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double rms = pm_frame_parameter(f, "rms", 1), volume = pow(2 * pm_pi, f->dim), now = t == 0 ? 1 : NAN;
	double sum;
	const size_t n = waves(f->dim, pm_frame_parameter(f, "band", 4), &sum);
	const double enstrophy = 0.5 * rms * rms * volume * now, energy = enstrophy * sum / (double)n;
	const struct { const char *name; double value; } known[] = {
		{"circulation", f->dim == 2 ? 0 : NAN}, {"alpha_x", 0}, {"alpha_y", 0}, {"alpha_z", 0}, {"enstrophy", enstrophy}, {"energy", energy},
		{"energy_field_mesh", energy}, {"energy_flow", energy},
	};
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (!strcmp(quantity, known[i].name))
			return known[i].value;
	return NAN;
}

const struct pm_scene scene_random_vorticity = {
	.name = "random-vorticity",
	.sentence = "waves of vorticity at random that decay as turbulence, periodic",
	.source = "McWilliams 1984; Rogallo 1981",
	.dims = 1u << 2 | 1u << 3,
	.dim = 2,
	.n_fixed = true,
	.random = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
