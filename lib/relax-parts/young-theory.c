/* Young's formulas (young-theory.h). SPDX-License-Identifier: GPL-3.0-or-later */
#include "relax-parts/young-theory.h"

double pm_young_mu(const struct pm_laplacian *l) { return fmax(l->highest, 0); }

double pm_young_best(const struct pm_laplacian *l)
{
	double mu = pm_young_mu(l);
	return 2 / (1 + sqrt(1 - mu * mu));
}

double pm_young_radius(const struct pm_laplacian *l, double factor)
{
	double mu = pm_young_mu(l), under = factor * factor * mu * mu - 4 * (factor - 1);
	if (under <= 0)
		return factor - 1;
	double root = (factor * mu + sqrt(under)) / 2;
	return fmax(root * root, fabs(factor - 1)); /* |factor - 1|: modes with mu = 0, and under-relaxation */
}
