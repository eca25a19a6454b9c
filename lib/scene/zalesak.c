/* Zalesak's disk: a disk with a slot, carried once around the middle of the periodic unit square in the time `period` as a solid body. The velocity is in
 * the sentence (docs/methods/redistance.md):  field 'vel = -2*pi*(y - 0.5), 2*pi*(x - 0.5)' | push rk4 | remesh --by volume
 * level = max(r - R, -max(|x'| - w/2, y' - top)) about the centre of the disk (1/2, 3/4), below 0 inside; not a distance beside the corners.
 * Source: Zalesak 1979, J. Comput. Phys. 31, 335; with a level set Enright et al. 2002, J. Comput. Phys. 183, 83.
 * Exact at any time: level_inside (0.0582207 by default), level_interface (1.438047), the level. Cost: nodes. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-level.h"

enum { RADIUS, WIDTH, DEPTH, PERIOD };

static const struct pm_scene_parameter rows[] = {
	{.name = "radius", .unit = "length", .otherwise = 0.15, .low = 1e-3, .high = 0.2, .text = "radius of the disk"},
	{.name = "slot-width", .unit = "length", .otherwise = 0.05, .low = 1e-3, .high = 0.4, .text = "width of the slot"},
	{.name = "slot-depth", .unit = "length", .otherwise = 0.25, .low = 1e-3, .high = 0.4, .text = "of the slot, from the lowest point of the disk"},
	{.name = "period", .unit = "time", .otherwise = 1, .low = 1e-6, .high = 1e6, .text = "of the flow: time of a turn, or in which it comes back"},
	{0},
};

static double value(const struct pm_frame *f, int parameter) { return pm_frame_parameter(f, rows[parameter].name, rows[parameter].otherwise); }

static double level(const struct pm_frame *f, const double at[], double t)
{
	const double angle = 2 * pm_pi * remainder(t / value(f, PERIOD), 1), c = cos(angle), s = sin(angle), r = value(f, RADIUS);
	const double x = c * (at[0] - 0.5) + s * (at[1] - 0.5), y = c * (at[1] - 0.5) - s * (at[0] - 0.5) - 0.25;
	return fmax(hypot(x, y) - r, -fmax(fabs(x) - 0.5 * value(f, WIDTH), y + r - value(f, DEPTH)));
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double r = c->value[RADIUS];
	if (c->value[WIDTH] >= 2 * r || c->value[DEPTH] >= 2 * r)
		return pm_fail(PM_USAGE, "the slot cuts the disk in two (--slot-width and --slot-depth below twice the --radius %g)", r);
	f->dt = c->value[PERIOD] / 200;
	return pm_scene_level(c, f, 100, level);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	(void)t;
	const double r = value(f, RADIUS), half = 0.5 * value(f, WIDTH), top = value(f, DEPTH) - r, low = sqrt(r * r - half * half);
	if (top > low)
		return NAN; /* the slot's corners are outside the circle */
	if (!strcmp(quantity, "level_inside"))
		return pm_pi * r * r - (2 * half * top + half * low + r * r * asin(half / r));
	if (!strcmp(quantity, "level_interface"))
		return 2 * pm_pi * r - 2 * r * asin(half / r) + 2 * (top + low) + 2 * half;
	return NAN;
}

const struct pm_scene scene_zalesak = {
	.name = "zalesak",
	.sentence = "a disk with a slot, to be turned as a solid body: a level set",
	.source = "Zalesak 1979",
	.dims = 1u << 2,
	.dim = 2,
	.n_fixed = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
	.level = level,
};
