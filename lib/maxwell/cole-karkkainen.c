/* Cole and Karkkainen's scheme: Yee's, but curl E takes each two-point difference as a mean over neighbours across it, with weights for which c dt may be the
 * smallest spacing, where waves along that axis move at exactly c. curl B and the charge are Yee's, so Gauss's law stays as it is. With r = (least h/h)^2 of
 * each axis, S = r_y r_z + r_z r_x + r_x r_y, b = (1 - r_x r_y r_z/S)/8: along x side weights r_y b, r_z b, corner r_y r_z (1/16 - r_y r_z/(8 S)), and
 * the middle what is missing from 1; in the plane b = 1/8 and no corner.
 * Source: Karkkainen et al. 2006, ICAP, 35; Cowan et al. 2013, Physical Review ST Accelerators and Beams 16, 041303.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "maxwell/maxwell.h"

static double least(const struct pm_grid *g)
{
	double h = INFINITY;
	for (int d = 0; d < g->dim; d++)
		h = pm_yee_varies(g, d) ? fmin(h, g->h[d]) : h;
	return h;
}

static struct pm_yee_stencil stencil_of(const struct pm_grid *g)
{
	struct pm_yee_stencil s = {.near = 1};
	double r[3] = {0};
	int axes = 0;
	for (int d = 0; d < 3; d++)
		if (pm_yee_varies(g, d))
			r[d] = pow(least(g) / g->h[d], 2), axes++;
	const double pairs = r[1] * r[2] + r[2] * r[0] + r[0] * r[1], b = axes == 3 ? 0.125 * (1 - r[0] * r[1] * r[2] / pairs) : 0.125;
	for (int a = 0; a < 3; a++) {
		const double e = r[(a + 1) % 3], f = r[(a + 2) % 3];
		s.side[a][0] = e * b;
		s.side[a][1] = f * b;
		s.corner[a] = axes == 3 ? e * f * (1. / 16 - e * f / (8 * pairs)) : 0;
		s.middle[a] = 1 - 2 * (s.side[a][0] + s.side[a][1]) - 4 * s.corner[a];
	}
	return s;
}

static void magnetic(const struct pm_yee *y, double dt)
{
	const struct pm_yee_stencil s = stencil_of(&y->grid);
	pm_yee_wide(y, &s, false, dt);
}

const struct pm_maxwell maxwell_cole_karkkainen = {
	.name = "cole-karkkainen",
	.sentence = "two-point differences, those of E averaged across, without dispersion along the axes at c dt = h; periodic boxes",
	.source = "Cowan et al. 2013",
	.order = 2,
	.limit = least,
	.beside = 1,
	.magnetic = magnetic,
	.electric = pm_yee_electric,
};
