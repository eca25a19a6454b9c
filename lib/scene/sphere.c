/* Fluid at rest around a sphere of diameter D that a stream of speed U along x meets suddenly. The scene is space and particles without vorticity on the nodes
 * of the body and beside it, where the layer will be; body and stream are in the sentence (docs/methods/penalize.md):
 *     penalize --body 'sqrt(x^2 + y^2 + z^2) - 0.5' --stream '1, 0, 0'   and   field 'vel = 1, 0, 0'
 * Re = U D/nu. The wake is steady and round to Re = 210; drag coefficient F/(pi D^2 U^2/8) = 1.08 to 1.10 at Re = 100 (Johnson and Patel 1999, J. Fluid Mech.
 * 378, 19; Clift, Grace and Weber 1978). Exact: total of the vorticity 0 at any time. Cost: nodes of the body. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "scene-parts/scene-space.h"
#include "scene-parts/scene-vortex-set.h"
#include "stream/declare.h"

enum { SPEED, DIAMETER, NU };
enum { BESIDE = 4, ACROSS = 12, LONG = 4, WIDE = 3 }; /* cells with particles around the body; of its diameter; diameters of the box */

static const struct pm_scene_parameter rows[] = {
	{.name = "speed", .unit = "length/time", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "speed of the stream, which only sets the step"},
	{.name = "diameter", .unit = "length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "of the sphere"},
	{.name = "nu", .unit = "length^2/time", .otherwise = 0.01, .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

static double cell(const struct pm_scene_choice *c) { return pm_scene_vortex_cell(c, LONG * c->value[DIAMETER], LONG * ACROSS); }

/* A mark of the nodes with particles, whose vorticity is none; small beside the body, so that it counts for nothing at the faces. */
static void beside(const struct pm_scene_choice *c, const double x[3], double w[3])
{
	const double r = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
	w[0] = r < c->value[DIAMETER] / 2 ? 1 : r < c->value[DIAMETER] / 2 + BESIDE * cell(c) ? 1e-6 : 0;
	w[1] = w[2] = 0;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double d = c->value[DIAMETER], side = 0.5 * WIDE * d, lo[3] = {-d, -side, -side}, hi[3] = {(LONG - 1) * d, side, side};
	const size_t cells[3] = {LONG * ACROSS, WIDE * ACROSS, WIDE * ACROSS};
	f->dt = 0.4 * cell(c) / c->value[SPEED];
	pm_frame_constant_set(f, "nu", c->value[NU]);
	if (pm_scene_space(c, f, lo, hi, PM_OPEN, cells) || pm_scene_space_vorticity(f, beside, c, 0))
		return pm_failed();
	if (!pm_frame_set(f, "vortices")->n) /* on all ranks */
		return pm_fail(PM_USAGE, "no node of so few cells is far enough from the faces for particles beside the sphere (--cells 32x24x24)");
	struct pm_field *alpha = pm_frame_field(f, "vortices", "alpha");
	memset(pm_out(alpha, 0), 0, alpha->count * sizeof(double));
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	(void)f, (void)t;
	return !strcmp(quantity, "alpha_x") || !strcmp(quantity, "alpha_y") || !strcmp(quantity, "alpha_z") ? 0 : NAN;
}

static void body(const struct pm_frame *f, struct pm_scene_solid *b)
{
	b->stream[0] = b->speed = pm_frame_parameter(f, "speed", rows[SPEED].otherwise);
	snprintf(b->level, sizeof b->level, "sqrt(x*x + y*y + z*z) - %.10g", 0.5 * pm_frame_parameter(f, "diameter", rows[DIAMETER].otherwise));
}

const struct pm_scene scene_sphere = {
	.name = "sphere",
	.sentence = "fluid at rest around a sphere that a stream meets suddenly",
	.source = "Johnson and Patel 1999",
	.dims = 1u << 3,
	.dim = 3,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
	.body = body,
};
