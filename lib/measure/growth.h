/* Growth rate and frequency of a mode, or of a column of diag, from its values in time: the one fit of exponentials of the project.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_GROWTH_H
#define PM_MEASURE_GROWTH_H

#include "mesh/grid.h"

/* Amplitude and phase of wave m along x of values on a mesh, averaged over the other axes: 2/n sum a exp(-2 pi i m j/n). x must be periodic.
 * Of a component of a field, which ranks may share. 0 or failure (memory). */
int pm_mode(const struct pm_grid *g, const struct pm_field *field, const double *values, int m, double amplitude[2]);

struct pm_series {
	bool column;     /* a real column, which may oscillate about a value that is not 0; else the complex amplitude of a mode */
	size_t n, room;
	double *t;       /* [time] in ascending order */
	double *re, *im; /* complex amplitude */
	double scale;    /* largest value of the field that the amplitudes were taken from; 0 unknown */
};
/* Values that are not finite are left out. 0 or failure (memory). */
int pm_series_add(struct pm_series *s, double t, const double amplitude[2], double scale);
void pm_series_release(struct pm_series *s);

struct pm_growth {
	double gamma, omega; /* [1/time]; NAN: none, and reason says why */
	double error;        /* [1/time] standard error of gamma */
	double from, to;     /* [time] of the first and last point used */
	size_t points;
	double over_noise;   /* the larger of the amplitudes at the ends of the window over the noise */
	char reason[256];    /* empty where there is a gamma */
};
/* Between from and to; NAN: chosen as docs/methods/diag.md says. 0 or failure (memory). */
int pm_growth_of(const struct pm_series *s, double from, double to, struct pm_growth *g);

#endif
