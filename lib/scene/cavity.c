/* Fluid at rest in the unit square, whose lid y = 1 starts to move along x with speed U. The box is periodic and a tenth of its cells on every side is solid;
 * the strip above the lid moves. Walls and lid are in the sentence (docs/methods/penalize.md):
 *     penalize --body 'min(min(x, 1 - x), min(y, 1 - y))' --velocity 'y > 0.99 ? 1 : 0, 0' --stream '0.1, 0'   and   field 'vel = 0.1, 0'
 * The stream is the mean velocity of the box: that of the strip, times its tenth of the height. Re = U/nu; velocities on the middle lines at Re 100 to 10000:
 * Ghia, Ghia and Shin 1982, J. Comput. Phys. 48, 387. Exact: circulation 0 at any time. Cost: nodes of the box. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "scene-parts/scene-vortex-set.h"
#include "scene-parts/scene-vortices.h"
#include "stream/declare.h"

enum { SPEED, NU };

static const struct pm_scene_parameter rows[] = {
	{.name = "speed", .unit = "length/time", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "speed of the lid, which only sets the step"},
	{.name = "nu", .unit = "length^2/time", .otherwise = 0.01, .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

static double rest(const struct pm_scene_choice *c, double x, double y)
{
	(void)c, (void)x, (void)y;
	return 0;
}

/* The strength of the walls decays at 1/dt, which leaves (2.51 - 1)/(0.986 2.51) of the step that diffusion alone would take with lsrk3. */
static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double frame = 0.125;
	f->dt = 1e300;
	pm_frame_constant_set(f, "nu", c->value[NU]);
	if (pm_scene_plane(c, f, -frame, 1 + frame, PM_PERIODIC, 40) || pm_scene_vorticity(f, rest, c, -1))
		return -PM_DATA;
	f->dt = fmin(0.6 * f->dt, 0.25 * pm_frame_mesh(f, NULL)->h[0] / c->value[SPEED]);
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	(void)f, (void)t;
	return strcmp(quantity, "circulation") ? NAN : 0;
}

static void body(const struct pm_frame *f, struct pm_scene_solid *b)
{
	b->speed = pm_frame_parameter(f, "speed", rows[SPEED].otherwise);
	b->stream[0] = 0.1 * b->speed;
	snprintf(b->level, sizeof b->level, "min(min(x, 1 - x), min(y, 1 - y))");
	snprintf(b->velocity, sizeof b->velocity, "y > 0.99 ? %.10g : 0, 0", b->speed);
}

const struct pm_scene scene_cavity = {
	.name = "cavity",
	.sentence = "fluid at rest in a square whose lid starts to move",
	.source = "Ghia, Ghia and Shin 1982",
	.dims = 1u << 2,
	.dim = 2,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
	.body = body,
};
