/* Scales of a frame against numbers known beforehand: orbits, plasma frequency, Debye length, distances, overlap; and the atlas interpolated between its rows.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "planner/atlas.h"
#include "planner/scales.h"
#include "scene/scene.h"
#include "stream/run.h"

/* A scene with its defaults but n particles (0: its own) and one parameter. */
static struct pm_frame *scene(const char *name, uint64_t n, const char *parameter, double value)
{
	const struct pm_scene *s = pm_scene_find(name);
	struct pm_scene_choice c = {.dim = s->dim, .n = n ? n : s->n, .seed = 1};
	struct pm_frame *f = pm_frame_new(s->dim);
	for (int i = 0; s->parameters && s->parameters[i].name; i++)
		c.value[i] = parameter && !strcmp(s->parameters[i].name, parameter) ? value : s->parameters[i].otherwise;
	return s->make(&c, f) || pm_frame_settle(f) ? pm_frame_free(f) : f;
}

static struct pm_scales scales(const char *name, uint64_t n, const char *parameter, double value)
{
	struct pm_scales s = {0};
	struct pm_frame *f = scene(name, n, parameter, value);
	check(f && !pm_scales_of(f, pm_law_of(f), &s), "%s has scales", name);
	pm_frame_free(f);
	return s;
}

static void orbits(void)
{
	for (double e = 0; e < 0.99; e += 0.45) {
		struct pm_scales s = scales("kepler", 0, "eccentricity", e); /* a = G M = 1 about a sun that does not move */
		check_near(s.orbit, 1, 1e-12, "kepler: mean motion 1");
		check_near(s.eccentricity, e, 1e-7, "kepler: its eccentricity"); /* of 1 - L^2/(mu a), a root near 0 */
	}
	struct pm_scales s = scales("two-body", 0, "eccentricity", 0.5);
	check_near(s.orbit, 1, 1e-12, "two-body: mean motion 1");
	check_near(s.eccentricity, 0.5, 1e-12, "two-body: its eccentricity");
	check_near(s.nearest, 1.5, 1e-12, "two-body: the distance at the apocentre a (1 + e)");
	check_near(s.spread, 0.75, 1e-12, "two-body: half of it from the centre");
}

static void plasmas(void)
{
	struct pm_scales s = scales("landau", 20000, NULL, 0);
	check_near(s.omega, 1, 1e-12, "landau: omega_p = 1");
	check_near(s.debye, 1, 0.02, "landau: the Debye length 1, of 20000 random velocities");  /* 3/sqrt(2 n) = 0.015 */
	check_near(s.volume, 4 * pm_pi, 1e-12, "landau: the length of the box, 2 pi/0.5");
	check(s.kind == PM_CHARGES && s.second && s.periodic && !s.open && !s.walls, "landau: charges with velocities in a periodic box");
	s = scales("gyration", 0, "magnetic-field", 2.385);
	check_near(s.cyclotron, 2.385, 1e-12, "gyration: (q/m) B");
	check_near(s.given, 0, 0, "gyration: a given field of zeros");
	check(s.sources == 1 && s.n == 1, "gyration: one electron");
	s = scales("exb", 0, "electric-field", 0.37);
	check_near(s.given, 0.37, 1e-12, "exb: (q/m) E");
}

static void vortices(void)
{
	struct pm_scales s = scales("taylor-green-2d", 0, NULL, 0);
	check(s.kind == PM_VORTICES && !s.second, "taylor-green-2d: vortices, without velocities");
	check_near(s.overlap, 0, 1e-12, "taylor-green-2d: a lattice covers its mesh");
	check_near(s.width, s.h, 1e-12, "taylor-green-2d: a cell each");
	check_near(s.omega, 2, 0.01, "taylor-green-2d: the largest vorticity 2"); /* nodes beside the top: 1 - (h/2)^2/2 of it twice at most */
	s = scales("point-vortices", 1000, NULL, 0);
	check(s.overlap > 0.3, "point-vortices: random points cover nothing (%g)", s.overlap);
}

static void atlas(void)
{
	for (const struct pm_atlas_step *r = pm_atlas_steps; r->problem; r++)
		if (!strcmp(r->problem, "kepler") && !strcmp(r->scheme, "kdk") && r->error < 0.1)
			check_near(pm_atlas_longest("kepler", "kdk", r->error) / r->dt, 1, 1e-9, "atlas: a row gives its own step");
	const double a = pm_atlas_longest("kepler", "kdk", 1e-6), b = pm_atlas_longest("kepler", "kdk", 1e-8);
	check_near(log(1e-6 / 1e-8) / log(a / b), 2, 0.01, "atlas: beyond its rows leapfrog has order 2");
	check_near(pm_atlas_time("kepler"), 2 * pm_pi, 1e-4, "atlas: kepler lasts one orbit");
	check_near(pm_atlas_time("gyration"), 2 * pm_pi, 1e-4, "atlas: so does gyration");
	check_near(pm_atlas_time("langmuir"), 6.25 * pm_pi, 1e-3, "atlas: langmuir lasts 3.125 periods");
	check_near(pm_atlas_time("vortex-patch"), 20, 1e-3, "atlas: the patch rotates for 20/omega");
	check(isnan(pm_atlas_longest("kepler", "boris", 0.1)) && isnan(pm_atlas_force_error("smooth", "tree", "cic", "2", 1)), "atlas: cases that were not "
		"measured give NaN");
	for (const struct pm_atlas_force *r = pm_atlas_forces; r->scene; r++)
		if (!strcmp(r->scene, "smooth") && !strcmp(r->kernel, "tsc") && !strcmp(r->gradient, "4"))
			check_near(pm_atlas_force_error(r->scene, r->solver, r->kernel, r->gradient, r->h) / r->error, 1, 1e-9,
				"atlas: a row gives its own error");
}

int main(void)
{
	orbits();
	plasmas();
	vortices();
	atlas();
	return check_done();
}
