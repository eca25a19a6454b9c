/* Mean of a series in time with its error. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_TIME_AVERAGE_H
#define PM_MEASURE_TIME_AVERAGE_H

#include "base/base.h"

struct pm_average {
	double mean, error; /* standard error of the mean, by blocks; NAN: fewer than two values */
	double correlation; /* autocorrelation time in units of the spacing of the values: 1/2 + sum over k of the correlation of values k apart; NAN: none */
	size_t n;
	bool brief;         /* fewer than 50 correlation times: the error is too small */
};
/* Of n values at equal distances in time. */
struct pm_average pm_average_of(size_t n, const double *y);

#endif
