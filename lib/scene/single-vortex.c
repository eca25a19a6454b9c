/* A disk in the periodic unit square that one vortex draws out into a thin spiral and, reversed, brings back at every multiple of `period`. The velocity is
 * in the sentence (docs/methods/redistance.md):
 *     field 'vel = -sin(pi*x)^2*sin(2*pi*y)*cos(pi*time/8), sin(pi*y)^2*sin(2*pi*x)*cos(pi*time/8)' | push rk4 | remesh --by volume
 * level = |x - (1/2, 3/4)| - R, below 0 inside. Source: Bell, Colella and Glaz 1989, J. Comput. Phys. 85, 257; as a test of interfaces Rider and Kothe 1998,
 * J. Comput. Phys. 141, 112. Exact: level_inside at any time (0.0706858 by default); level_interface and the level at multiples of the period, the
 * perimeter of the default disk also at half of it (6.4503365 for 8, 1.8430869 for 2). Cost: nodes. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-level.h"

enum { RADIUS, PERIOD };

static const struct pm_scene_parameter rows[] = {
	{.name = "radius", .unit = "length", .otherwise = 0.15, .low = 1e-3, .high = 0.2, .text = "radius of the disk"},
	{.name = "period", .unit = "time", .otherwise = 8, .low = 1e-6, .high = 1e6, .text = "of the flow: time of a turn, or in which it comes back"},
	{0},
};

static double value(const struct pm_frame *f, int parameter) { return pm_frame_parameter(f, rows[parameter].name, rows[parameter].otherwise); }

/* Is t this far from a multiple of the period? */
static bool at_phase(const struct pm_frame *f, double t, double phase) { return fabs(remainder(t / value(f, PERIOD) - phase, 1)) < 1e-9; }

static double level(const struct pm_frame *f, const double x[], double t)
{
	return at_phase(f, t, 0) ? hypot(x[0] - 0.5, x[1] - 0.75) - value(f, RADIUS) : NAN;
}

/* The speed is at most 1: a turn of the disk takes about as long as one of the vortex, however long the period. */
static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	f->dt = fmin(c->value[PERIOD] / 200, 0.04);
	return pm_scene_level(c, f, 128, level);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double r = value(f, RADIUS), period = value(f, PERIOD);
	if (!strcmp(quantity, "level_inside"))
		return pm_pi * r * r;
	if (strcmp(quantity, "level_interface"))
		return NAN;
	if (at_phase(f, t, 0))
		return 2 * pm_pi * r;
	return at_phase(f, t, 0.5) && r == 0.15 ? period == 8 ? 6.4503365 : period == 2 ? 1.8430869 : NAN : NAN;
}

const struct pm_scene scene_single_vortex = {
	.name = "single-vortex",
	.sentence = "a disk that a vortex draws out and brings back: a level set",
	.source = "Bell, Colella and Glaz 1989",
	.dims = 1u << 2,
	.dim = 2,
	.n_fixed = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
	.level = level,
};
