/* The free-space Green's function sampled at the nodes, with the textbook value at 0 that is computed from one cell: 3-D -1/(4 pi h), h^3 the cell; 2-D the
 * mean of ln r over the cell; 1-D the mean of |x|/2, h/8. For comparison: it leaves an error O(h^2), which hockney.c removes.
 * Source: Hockney and Eastwood 1988, 6-5-4 (1/h); the mean over a rectangle of sides a, b is
 *   (ln((a^2 + b^2)/4) - 3 + (a/b) atan(b/a) + (b/a) atan(a/b))/2. Cost: none.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "green-parts/free-space.h"

static double centre(int dim, const double h[3])
{
	if (dim == 3)
		return -1 / (4 * pm_pi * cbrt(h[0] * h[1] * h[2]));
	if (dim == 1)
		return h[0] / 8;
	double a = h[0], b = h[1];
	return (log(0.25 * (a * a + b * b)) - 3 + a / b * atan(b / a) + b / a * atan(a / b)) / (4 * pm_pi);
}

static double at(const struct pm_green_case *c, double r2)
{
	return r2 > 0 ? pm_green_free(c->dim, 0, r2) : centre(c->dim, c->h);
}

const struct pm_green green_cell = {
	.name = "cell",
	.sentence = "sampled at the nodes, at 0 the textbook value 1/h or the mean over a cell",
	.source = "Hockney and Eastwood 1988",
	.order = 2,
	.plain = 1u << 1 | 1u << 2 | 1u << 3,
	.at = at,
};
