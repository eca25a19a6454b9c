/* Tables as programs write them: columns of numbers and words under a line of names. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CHART_NUMBER_TABLE_H
#define PM_CHART_NUMBER_TABLE_H

#include "stream/table.h"

struct pm_number_table {
	const char *path;
	size_t rows, columns;
	const char **name;    /* [columns] */
	double *number;       /* [columns][rows]: NAN where there is no number */
	const char **word;    /* [columns][rows]: the cell as written, "" in a gap between two blocks of rows */
	bool *text;           /* [columns]: it has words and no number */
	struct pm_text source;
	char *names;          /* what name and word point into, besides the source */
};

/* Separated by tabs, commas (with quotes) or blanks: the first line decides. A first line without words has no names: the columns are called 1, 2, 3. Lines
 * with # are skipped, but one before the first row may hold the names; an empty line and a repeated line of names are gaps. 0 or failure with the line. */
int pm_number_table_read(struct pm_number_table *t, const char *path);
void pm_number_table_free(struct pm_number_table *t);
/* Column of this name, or of a name that goes on with a unit ("energy [J]"); -1: none. */
int pm_number_table_find(const struct pm_number_table *t, const char *name, size_t length);
/* "it has no column 'NAME' (it has a, b, c)" as a failure. */
int pm_number_table_lacks(const struct pm_number_table *t, const char *name);
/* "which column? it has a, b, c" as a failure. */
int pm_number_table_choose(const struct pm_number_table *t);

#endif
