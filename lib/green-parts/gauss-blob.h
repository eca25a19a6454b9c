/* Green's functions of blobs, Gaussian times a polynomial, of any even order up to 10; used by gauss2 to gauss10 of lib/green.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_GREEN_PARTS_GAUSS_BLOB_H
#define PM_GREEN_PARTS_GAUSS_BLOB_H

#include "green-parts/truncated.h"

double pm_gauss_at(const struct pm_green_case *c, int order, double r2);
double pm_gauss_transform(const struct pm_green_case *c, int order, double k2);
/* The transform has decayed at the Nyquist wave (7e-15 for order 10), so that samples of it are all there is. */
bool pm_gauss_smooth(const struct pm_green_case *c);

/* The entry of order m. */
#define PM_GREEN_GAUSS(m, text) \
	static double at(const struct pm_green_case *c, double r2) { return pm_gauss_at(c, m, r2); } \
	static double transform(const struct pm_green_case *c, double k2) { return pm_gauss_transform(c, m, k2); } \
	const struct pm_green green_gauss##m = {.name = "gauss" #m, .sentence = text, .source = "Hejlesen, Rasmussen, Chatelain and Walther 2013", .order = m, \
		.plain = 1u << 1 | 1u << 2 | 1u << 3, .screened = 1u << 1 | 1u << 2 | 1u << 3, .regular = true, .at = at, .transform = transform, \
		.smooth = pm_gauss_smooth, .prepare = pm_truncated_prepare};

#endif
