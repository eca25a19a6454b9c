/* A Maxwellian plasma across a uniform magnetic field B along z with a small wave along x, f = (1 + A cos k x) M(v): it is not damped as landau's, but has
 * a wave between every two harmonics of the gyration, Bernstein's modes, and a part that stands still. vth = 1, omega_p = 1, ions a background:
 *     E(t)/E(0) = A_0 + sum A_j cos(omega_j t),  A_j = 2 (1 + k^2)/(omega_j eps'(omega_j))        (lib/plasma/bernstein.c)
 * k = B = 1: omega 1.163872, 2.106416, 3.027774, A 0.4385, 0.2112, 0.0415, A_0 = 0.3036. Quiet start: Hammersley's points, in pairs at one place with
 * opposite velocities.
 * Source: Bernstein 1958, Physical Review 109, 10; Baldwin and Rowlands 1966, Physics of Fluids 9, 2444. Exact: mass, charge, omega of the strongest mode.
 * Cost N. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "plasma/bernstein.h"
#include "scene-parts/scene-loading.h"
#include "scene-parts/scene-plasma.h"

enum { AMPLITUDE, MODE, WAVENUMBER, VTH, MAGNETIC, VELOCITIES };

static const struct pm_scene_parameter rows[] = {
	{.name = "amplitude", .otherwise = 0.02, .high = 0.999, .text = "k A at the start"},
	{.name = "mode", .otherwise = 1, .low = 1, .high = 1e6, .text = "waves in the box"},
	{.name = "wavenumber", .unit = "1/length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "k of mode 1; the box is 2 pi/k long"},
	{.name = "vth", .unit = "length/time", .otherwise = 1, .high = 1e300, .text = "thermal speed, the standard deviation of the velocity"},
	{.name = "magnetic-field", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "B along z; the gyration frequency"},
	{.name = "velocities", .otherwise = 2, .low = 2, .high = 3, .text = "components of v"},
	{0},
};

static int fill(const struct pm_scene_choice *c, double length, double *x, double *const v[3])
{
	const uint64_t pairs = c->n / 2;
	const double k = c->value[WAVENUMBER] * c->value[MODE], a = c->value[AMPLITUDE];
	double *room = pm_alloc(4 * pairs + 1, sizeof *room);
	double *const u[PM_LOAD_AXES] = {room, room + pairs, room + 2 * pairs, room + 3 * pairs};
	int status = room ? pm_scene_points(PM_BIT_REVERSED, c->seed, pairs, 1 + (int)c->value[VELOCITIES], u) : -PM_DATA;
	for (uint64_t i = 0; i < c->n && !status; i++) {
		const double q = u[(int)c->value[VELOCITIES]][i / 2] * length; /* the evenly spaced axis */
		double place = q;
		for (int step = 0; step < 50; step++) /* place + (a/k) sin(k place) = q */
			place -= (place + a / k * sin(k * place) - q) / (1 + a * cos(k * place));
		x[i] = pm_scene_fold(place, length);
		for (int d = 0; d < (int)c->value[VELOCITIES]; d++)
			v[d][i] = (i & 1 ? -1 : 1) * c->value[VTH] * pm_scene_normal_of(u[d][i / 2]);
	}
	pm_free(room);
	return status;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double length = 2 * pm_pi / c->value[WAVENUMBER], share = c->n ? length / (double)c->n : 0, b[3] = {0, 0, c->value[MAGNETIC]};
	double *x[3], *v[3];
	if (pm_scene_plasma_whole(c->value[MODE], c->value[VELOCITIES], 2))
		return -PM_USAGE;
	if (c->n % 2)
		return pm_fail(PM_USAGE, "%llu electrons do not make pairs (take an even -n)", (unsigned long long)c->n);
	pm_scene_plasma_world(f, length, 1, 0.1 / fmax(fmax(1, c->value[MAGNETIC]), c->value[WAVENUMBER] * c->value[MODE] * c->value[VTH]));
	if (pm_scene_mesh(f, 64) || pm_scene_plasma_given(f, "B", "", 3, b) ||
		pm_scene_plasma_set(f, c->n, (int)c->value[VELOCITIES], -share, share, x, v))
		return -PM_DATA;
	return fill(c, length, x[0], v);
}

static double strongest(double k, double vth, double field)
{
	const struct pm_gyrating s = {1, 0, vth, -field, 1};
	struct pm_bernstein b;
	if (pm_bernstein_init(&b, &s, 1, k))
		return NAN;
	const double omega = pm_bernstein_strongest(&b);
	pm_bernstein_free(&b);
	return omega;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double k1 = pm_frame_parameter(f, "wavenumber", 1);
	(void)t;
	if (!strcmp(quantity, "gamma"))
		return 0;
	if (!strcmp(quantity, "omega"))
		return strongest(k1 * pm_frame_parameter(f, "mode", 1), pm_frame_parameter(f, "vth", 1), pm_frame_parameter(f, "magnetic-field", 1));
	if (!strcmp(quantity, "field_across"))
		return pm_frame_parameter(f, "magnetic-field", 1);
	if (!strcmp(quantity, "spread_along") || !strcmp(quantity, "spread_across"))
		return pm_frame_parameter(f, "vth", 1);
	return !strcmp(quantity, "mass") ? 2 * pm_pi / k1 : !strcmp(quantity, "charge") ? -2 * pm_pi / k1 : NAN;
}

const struct pm_scene scene_bernstein = {
	.name = "bernstein",
	.sentence = "a wave in a Maxwellian plasma across a magnetic field",
	.source = "Bernstein 1958",
	.dims = 1u << 1,
	.dim = 1,
	.n = 20000,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
