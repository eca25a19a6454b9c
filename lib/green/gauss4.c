/* The Green's function of a blob of order 4, Gaussian times a polynomial (gauss.h): smooth, so nothing needs correcting at 0; the potential is that of the
 * source smoothed over sigma = 2 h (or softening/sqrt(2)), in error by O(sigma^4). Source: Hejlesen, Rasmussen, Chatelain and Walther 2013.
 * Cost: an exponential and an error function or exponential integral per node, once.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "green/gauss.h"

static void prepare(struct pm_green_case *c)
{
	pm_truncated_prepare(c);
}

static double at(const struct pm_green_case *c, double r2)
{
	return pm_gauss_at(c, 4, r2);
}

static double transform(const struct pm_green_case *c, double k2)
{
	return pm_gauss_transform(c, 4, k2);
}

const struct pm_green green_gauss4 = {
	.name = "gauss4",
	.sentence = "regularised by a blob of order 4, Gaussian times a polynomial",
	.source = "Hejlesen, Rasmussen, Chatelain and Walther 2013",
	.order = 4,
	.plain = 1u << 1 | 1u << 2 | 1u << 3,
	.screened = 1u << 1 | 1u << 2 | 1u << 3,
	.regular = true,
	.at = at,
	.transform = transform,
	.prepare = prepare,
};
