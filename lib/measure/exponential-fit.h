/* One exponential fitted to a part of a series. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_EXPONENTIAL_FIT_H
#define PM_MEASURE_EXPONENTIAL_FIT_H

#include "measure/growth.h"

struct pm_exponential {
	double gamma, omega; /* [1/time]; omega 0: it does not oscillate */
	double error;        /* [1/time] of gamma: statistical, and by its drift within the window */
	double residual;     /* rms of the residual over that of the envelope, both divided by exp(gamma t) */
	double first, last;  /* envelope at the ends of the window */
};
/* Fits points a..b-1, starting from the rate gamma; false if that is impossible (too few points for the parameters, zeros). */
bool pm_exponential_fit(const struct pm_series *s, size_t a, size_t b, double gamma, struct pm_exponential *e);

#endif
