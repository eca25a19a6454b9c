/* A chain of ions, charges (-1)^i at x = i, at rest, periodic along x and alone in space: Madelung's chain. With q = eps0 = 1 the
 * potential of the whole chain is
 *   4 pi phi(x, y) = sum_n (-1)^n/sqrt((x-n)^2 + y^2) = 4 sum over odd m of K0(m pi y) cos(m pi x)
 * which is 1.3985527798610 at (1/4, 1/4), and of all but an ion at that ion -2 ln 2, Madelung's constant: each ion has the energy -ln 2/(4 pi).
 * No force acts on any of them, but along y, z ions repel and attract: the chain is an equilibrium, not a stable one. Source: Madelung 1918, Phys. Z. 19, 524;
 * Hockney and Eastwood 1988, section 8-7 for the split. Exact: mass, charge, speed_rms, energy_kinetic; in the head potential (4 pi phi at a quarter cell off
 * an ion along x and y) and madelung. Cost N. SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_sf_bessel.h>
#include <stdio.h>
#include <string.h>

#include "scene-parts/scene-plasma.h"
#include "stream/declare.h"

enum { CELLS = 16 }; /* between neighbours */

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	struct pm_scene_body b;
	if (c->n < 2 || c->n % 2)
		return pm_fail(PM_USAGE, "a chain of ions that repeats has an even number of them (-n %llu)", (unsigned long long)(c->n + 1 + (c->n == 0)));
	pm_scene_plasma_world(f, (double)c->n, 0, 0.1);
	for (int d = 1; d < 3; d++) {
		f->lo[d] = -1, f->hi[d] = 1;
		for (int side = 0; side < 2; side++)
			f->face[d][side] = PM_OPEN, f->pface[d][side] = PM_POPEN;
	}
	const size_t cells[3] = {CELLS * (size_t)c->n, 2 * CELLS, 2 * CELLS};
	if (!pm_frame_mesh_new(f, "mesh", cells) || pm_scene_set(f, "ions", c->n, true, 1, &b))
		return -PM_DATA;
	struct pm_field *q = pm_makes(f, "ions", "charge", 1, PM_STATE);
	if (!q || pm_field_ready(q))
		return -PM_DATA;
	snprintf(q->unit, sizeof q->unit, "charge");
	q->extensive = true;
	for (uint64_t i = 0; i < c->n; i++) {
		for (int d = 0; d < 3; d++)
			b.x[d][i] = d ? 0 : (double)i, b.v[d][i] = 0;
		pm_out(q, 0)[i] = i % 2 ? -1 : 1;
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const struct pm_set *set = pm_frame_set(f, "ions");
	double sum = 0;
	(void)t;
	for (int m = 1; m < 60; m += 2) /* K0(59 pi/4) < 1e-20 */
		sum += 4 * gsl_sf_bessel_K0(m * pm_pi / 4) * cos(m * pm_pi / 4);
	const struct { const char *name; double value; } known[] = {{"mass", set ? (double)set->n : NAN}, {"charge", 0}, {"speed_rms", 0},
		{"energy_kinetic", 0}, {"potential", sum}, {"madelung", 2 * log(2)}};
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (!strcmp(quantity, known[i].name))
			return known[i].value;
	return NAN;
}

static const struct pm_scene_parameter rows[] = {{0}};

const struct pm_scene scene_ionic_chain = {
	.name = "ionic-chain",
	.sentence = "ions of alternating charge on a line, at rest: Madelung's chain",
	.source = "Madelung 1918, Phys. Z. 19, 524",
	.dims = 1u << 3,
	.dim = 3,
	.n = 2,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
