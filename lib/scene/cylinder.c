/* Fluid at rest around a cylinder of diameter D that a stream of speed U along x meets suddenly. The scene is the plane and particles without circulation on
 * the nodes of the body and beside it, where the layer will be; body and stream are in the sentence (docs/methods/penalize.md):
 *     penalize --body 'hypot(x, y) - 0.5' --stream '1, 0'   and   field 'vel = 1, 0'
 * Re = U D/nu. Drag 4 sqrt(pi/(Re T)) at small T = U t/D (Bar-Lev and Yang 1975, J. Fluid Mech. 72, 625); from Re = 47 on vortices leave in turn, with
 * the Strouhal number f D/U = 0.164 at Re = 100 (Williamson 1996, Annu. Rev. Fluid Mech. 28, 477; VM-13 of the reference cases).
 * Exact: circulation 0 at any time. Cost: nodes of the body. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "scene-parts/scene-vortex-set.h"
#include "scene-parts/scene-vortices.h"
#include "stream/declare.h"

enum { SPEED, DIAMETER, NU };
enum { BESIDE = 4, ACROSS = 40, LONG = 4 }; /* cells with particles around the body; of its diameter; diameters of the box */

static const struct pm_scene_parameter rows[] = {
	{.name = "speed", .unit = "length/time", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "speed of the stream, which only sets the step"},
	{.name = "diameter", .unit = "length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "of the cylinder"},
	{.name = "nu", .unit = "length^2/time", .otherwise = 0.005, .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

static double cell(const struct pm_scene_choice *c) { return pm_scene_vortex_cell(c, LONG * c->value[DIAMETER], LONG * ACROSS); }

/* A mark of the nodes with particles, whose vorticity is none; small beside the body, so that it counts for nothing at the faces. */
static double beside(const struct pm_scene_choice *c, double x, double y)
{
	const double r = hypot(x, y), radius = c->value[DIAMETER] / 2;
	return r < radius ? 1 : r < radius + BESIDE * cell(c) ? 1e-6 : 0;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double d = c->value[DIAMETER], lo[3] = {-d, -1.5 * d}, hi[3] = {(LONG - 1) * d, 1.5 * d};
	const size_t cells[3] = {LONG * ACROSS, 3 * ACROSS, 1};
	f->dt = 0.4 * d / (c->value[SPEED] * (d / cell(c)));
	pm_frame_constant_set(f, "nu", c->value[NU]);
	if (pm_scene_vortex_box(c, f, 2, lo, hi, PM_OPEN, cells) || pm_scene_vorticity(f, beside, c, 0))
		return pm_failed();
	struct pm_field *circulation = pm_frame_field(f, "vortices", "circulation");
	if (!pm_frame_set(f, "vortices")->n) /* on all ranks */
		return pm_fail(PM_USAGE, "no node of so few cells is far enough from the faces for particles beside the cylinder (--cells 64x48)");
	memset(pm_out(circulation, 0), 0, circulation->count * sizeof(double));
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	(void)f, (void)t;
	return strcmp(quantity, "circulation") ? NAN : 0;
}

static void body(const struct pm_frame *f, struct pm_scene_solid *b)
{
	b->stream[0] = b->speed = pm_frame_parameter(f, "speed", rows[SPEED].otherwise);
	snprintf(b->level, sizeof b->level, "hypot(x, y) - %.10g", 0.5 * pm_frame_parameter(f, "diameter", rows[DIAMETER].otherwise));
}

const struct pm_scene scene_cylinder = {
	.name = "cylinder",
	.sentence = "fluid at rest around a cylinder that a stream meets suddenly",
	.source = "Bar-Lev and Yang 1975; Williamson 1996",
	.dims = 1u << 2,
	.dim = 2,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
	.body = body,
};
