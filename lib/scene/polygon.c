/* N equal point vortices on a circle (Thomson's polygon) in open space: it turns as a solid body at Omega = (N - 1) Gamma/(4 pi R^2). Disturbances
 * of wave number m grow at sqrt(q (q - 2 (N - 1))) Gamma/(4 pi R^2), q = m (N - m), if that is real: never for N < 7; neutral for N = 7; sqrt(32)
 * = 5.65685 for N = 8. --disturbance moves vortex i outwards by that fraction of R times cos(2 pi m i/N), m = N/2.
 * Source: Thomson 1883; Havelock 1931, Phil. Mag. 11, 617; VM-07 of the reference cases. Exact: circulation, angular_impulse, rate, gamma. Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-vortices.h"

enum { GAMMA, RADIUS, DISTURBANCE, SOFTENING };

static const struct pm_scene_parameter rows[] = {
	{.name = "circulation", .unit = "length^2/time", .otherwise = 1, .low = -1e300, .high = 1e300, .text = "circulation of each"},
	{.name = "radius", .unit = "length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "of the circle"},
	{.name = "disturbance", .low = -0.5, .high = 0.5, .text = "outward, as part of the radius"},
	{.name = "softening", .unit = "length", .high = 1e6, .text = "softening length of direct sums"},
	{0},
};

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double gamma = c->value[GAMMA], r = c->value[RADIUS], n = (double)c->n;
	struct pm_scene_vortices v;
	if (c->n < 2)
		return pm_fail(PM_USAGE, "a polygon has at least 2 vortices (-n 2)");
	f->dt = 8 * pm_pi * pm_pi * r * r / ((n - 1) * fmax(fabs(gamma), 1e-300)) / 200;
	pm_frame_constant_set(f, "nu", 0);
	pm_frame_constant_set(f, "softening", c->value[SOFTENING]);
	if (pm_scene_plane(c, f, -2 * r, 2 * r, PM_OPEN, 128) || pm_scene_vortices(f, c->n, pm_pi * r * r / n, &v))
		return -PM_DATA;
	for (uint64_t i = 0; i < c->n; i++) {
		const double angle = 2 * pm_pi * (double)i / n, at = r * (1 + c->value[DISTURBANCE] * cos((double)(c->n / 2) * angle));
		v.x[0][i] = at * cos(angle), v.x[1][i] = at * sin(angle);
		v.circulation[i] = gamma;
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const struct pm_set *set = pm_frame_set(f, "vortices");
	const double n = set ? (double)set->n : NAN, gamma = pm_frame_parameter(f, "circulation", 1), r = pm_frame_parameter(f, "radius", 1);
	const double unit = gamma / (4 * pm_pi * r * r), m = floor(n / 2), q = m * (n - m), s = q * (q - 2 * (n - 1));
	const bool still = pm_frame_parameter(f, "disturbance", 0) == 0;
	(void)t;
	if (!strcmp(quantity, "circulation"))
		return n * gamma;
	if (still && !strcmp(quantity, "angular_impulse"))
		return -0.5 * n * gamma * r * r;
	if (!strcmp(quantity, "rate"))
		return (n - 1) * unit;
	if (!strcmp(quantity, "mode")) /* the wave around the circle that grows fastest, whose rate is gamma */
		return m;
	if (!strcmp(quantity, "gamma"))
		return s > 0 ? sqrt(s) * fabs(unit) : 0;
	return NAN;
}

const struct pm_scene scene_polygon = {
	.name = "polygon",
	.sentence = "equal point vortices on a circle, turning as a solid body",
	.source = "Thomson 1883",
	.dims = 1u << 2,
	.dim = 2,
	.n = 5,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
