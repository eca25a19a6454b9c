/* A plane wave of light in a periodic box, in vacuum or, with particles, in a cold plasma of density 1: electrons on a lattice, ions a background.
 * E = A cos(k.x - omega t), omega^2 = omega_p^2 + c^2 k^2, c = 1, omega_p = 1 with particles, else 0. --axes 2 and 3 are diagonals; --standing 1 is E alone,
 * a wave each way. The electrons move as the wave wants at the start, v = (A/omega) sin(k.x) across it, so they must be slow: A/omega well below 1.
 * Source: Birdsall and Langdon 1985, sections 15-3 and 15-4; PIC-10 of the reference cases. Exact: mass, charge, omega. Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-electromagnetic.h"

enum { AMPLITUDE, MODE, LENGTH, AXES, STANDING };

static const struct pm_scene_parameter rows[] = {
	{.name = "wave-field", .otherwise = 0.01, .low = -1e300, .high = 1e300, .text = "largest E of the wave"},
	{.name = "mode", .otherwise = 1, .low = 1, .high = 1e6, .text = "waves in the box"},
	{.name = "length", .unit = "length", .otherwise = 6.283185307179586, .low = 1e-300, .high = 1e300, .text = "side of the box"},
	{.name = "axes", .otherwise = 1, .low = 1, .high = 3, .text = "axes along which the wave goes: 1, or more for a diagonal"},
	{.name = "standing", .otherwise = 0, .low = 0, .high = 1, .text = "1: E alone at the start, a standing wave"},
	{0},
};

struct wave {
	double k, amplitude, omega, across[3], third[3];
	int axes;
	bool standing;
};

static double phase(const struct wave *w, const double x[3])
{
	double sum = 0;
	for (int d = 0; d < w->axes; d++)
		sum += w->k * x[d];
	return sum;
}

static double electric(int c, const double x[3], const void *data)
{
	const struct wave *w = data;
	return w->amplitude * w->across[c] * cos(phase(w, x));
}

static double magnetic(int c, const double x[3], const void *data)
{
	const struct wave *w = data;
	return w->standing ? 0 : w->amplitude * w->k * sqrt(w->axes) / w->omega * w->third[c] * cos(phase(w, x));
}

static double omega_of(double k, double axes, bool plasma) { return sqrt(plasma + axes * k * k); }

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	static const size_t cells[4] = {0, 64, 64, 32};
	const double length = c->value[LENGTH], volume = pow(length, c->dim), n = (double)c->n;
	const size_t side = c->n ? pm_scene_per_axis(c->n, c->dim) : 1;
	struct wave w = {.k = 2 * pm_pi * c->value[MODE] / length, .amplitude = c->value[AMPLITUDE], .axes = (int)c->value[AXES],
		.standing = c->value[STANDING] != 0};
	double *x[3], *v[3];
	if (!side || pm_scene_plasma_whole(c->value[MODE], 3, 1))
		return -PM_USAGE;
	if (c->value[AXES] != w.axes || w.axes > c->dim)
		return pm_fail(PM_USAGE, "--axes %g is not a number of axes from 1 to %d", c->value[AXES], c->dim);
	w.omega = omega_of(w.k, w.axes, c->n > 0);
	pm_scene_em_polarisation(w.axes, w.across, w.third);
	if (pm_scene_em_world(c, f, length, cells[c->dim], c->n > 0) || pm_scene_em_fields(f, electric, magnetic, &w) ||
		pm_scene_plasma_set(f, c->n, 3, c->n ? -volume / n : 0, c->n ? volume / n : 0, x, v))
		return -PM_DATA;
	for (uint64_t i = 0; i < c->n; i++) {
		const size_t at[3] = {i % side, i / side % side, i / side / side};
		double place[3] = {0};
		for (int d = 0; d < c->dim; d++)
			x[d][i] = place[d] = ((double)at[d] + 0.5) / (double)side * length;
		for (int d = 0; d < 3; d++)
			v[d][i] = w.standing ? 0 : w.amplitude / w.omega * w.across[d] * sin(phase(&w, place));
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const struct pm_set *set = pm_frame_set(f, "electrons");
	const double k = 2 * pm_pi * pm_frame_parameter(f, "mode", 1) / pm_frame_parameter(f, "length", 1);
	(void)t;
	if (!strcmp(quantity, "mass") || !strcmp(quantity, "charge"))
		return !set || !set->n ? 0 : (*quantity == 'm' ? 1 : -1) * pow(pm_frame_parameter(f, "length", 1), f->dim);
	if (!strcmp(quantity, "gamma"))
		return 0;
	return !strcmp(quantity, "omega") ? omega_of(k, pm_frame_parameter(f, "axes", 1), set && set->n) : NAN;
}

const struct pm_scene scene_em_wave = {
	.name = "em-wave",
	.sentence = "a wave of light in vacuum, or with -n in a cold plasma",
	.source = "Birdsall and Langdon 1985, 15-3",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.dim = 1,
	.n = 0,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
