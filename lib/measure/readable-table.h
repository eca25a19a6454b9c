/* diag's table for a terminal: the columns that fit the law and the width, six digits, units, and why others are missing.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_READABLE_TABLE_H
#define PM_MEASURE_READABLE_TABLE_H

#include <stdio.h>

#include "measure/diag-column.h"

enum { PM_READABLE_MOST = 64, PM_READABLE_NOTES = 3 };

struct pm_readable {
	int width;      /* [characters] of a line */
	bool asked;     /* the columns were chosen (--columns): all of them, also those that are nan */
	bool live;      /* progress of other words may stand in the line that is written to: it is wiped */
	int n, shown[PM_READABLE_MOST]; /* indices of the columns; n 0: not decided yet */
	unsigned absent; /* of the law's columns, a bit each: nan when they were chosen */
	int left;       /* columns that have values and do not fit */
	char note[PM_READABLE_NOTES][400]; /* about the first row: what is left out and why; "" */
};

/* Of the terminal behind a file, else COLUMNS, else 80. */
int pm_readable_width(int file);
/* Writes a row, and before the first one the units and names. A column that becomes finite later starts the table anew. lacks: why there is no energy. */
void pm_readable_row(struct pm_readable *r, FILE *out, int n, const struct pm_diag_column *column, const double *value, const struct pm_measure *how,
	const struct pm_frame *f, const char *lacks);

#endif
