/* Growth rate and frequency of a mode from its amplitude in time. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_GROWTH_H
#define PM_MEASURE_GROWTH_H

#include "mesh/grid.h"

/* Amplitude and phase of wave m along x of values on a mesh, averaged over the other axes: 2/n sum a exp(-2 pi i m j/n). x must be periodic. */
void pm_mode(const struct pm_grid *g, const double *values, int m, double amplitude[2]);

struct pm_series {
	size_t n, room;
	double *t;       /* [time] */
	double *re, *im; /* complex amplitude */
};
int pm_series_add(struct pm_series *s, double t, const double amplitude[2]); /* 0 or failure (memory) */
void pm_series_release(struct pm_series *s);

struct pm_growth {
	double gamma, omega; /* [1/time]; NAN if it cannot be determined */
	double from, to;     /* [time] of the first and last point used */
	size_t points;
};
/* Between from and to; NAN: chosen as docs/methods/diag.md says. */
struct pm_growth pm_growth_of(const struct pm_series *s, double from, double to);

#endif
