/* A spectrum as a table. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_SPECTRUM_TABLE_H
#define PM_MEASURE_SPECTRUM_TABLE_H

#include <stdio.h>

#include "measure/mesh-spectrum.h"

struct pm_spectrum_print {
	FILE *out;
	bool json, head;  /* an object per frame; the names of the columns come first */
	double from, to;  /* [1/length] of the slope; NAN: none */
	double scale;     /* the field is divided by it */
	int dim;
	double time;
};
/* Rows of shells that have waves: k, how many, energy = sum of |u^|^2/2 over the width, power = volume times the mean of |u^|^2; then lines that begin with #:
 * mean, mean square by nodes and by waves, slope. 0 or failure. */
int pm_spectrum_write(const struct pm_spectrum *s, const char *field, int components, const struct pm_spectrum_print *p);

#endif
