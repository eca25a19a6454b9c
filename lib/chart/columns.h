/* Series of a chart from the columns of tables: by name, or computed by an expression over them. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CHART_COLUMNS_H
#define PM_CHART_COLUMNS_H

#include "chart/chart.h"
#include "chart/number-table.h"

enum { PM_CHART_SERIES = 200 };

struct pm_chart_columns {
	const char *x;                         /* a column or an expression; NULL: time, else the first column */
	int ncolumns, nerrors, nxerrors;
	const char *const *column;             /* of y */
	const char *const *error, *const *xerror; /* half lengths of error bars, one for each column of y; "-" none */
	int nby, nwhere;
	const char *const *by;                 /* a series for each combination of values of these columns */
	const char *const *where;              /* COLUMN=VALUE: these rows alone */
	const char *name;                      /* column of the names beside the points; NULL */
	int nstyles;
	const char *const *styles;             /* LABEL=STYLE: of one series; steps are thick and black as well */
	enum pm_chart_style style;
};

/* The series of one more table; file: its name for the labels, "" if there is only one. The series use the words of the table. 0 or failure. */
int pm_chart_add(struct pm_chart *c, const struct pm_chart_columns *want, const struct pm_number_table *t, const char *file);
/* y = EXPRESSION of x over the range of the x axis (which must be scaled), several with ; between, each perhaps NAME = EXPRESSION. */
int pm_chart_theory(struct pm_chart *c, const char *text);
/* The line of this slope (on logarithmic axes: power) through the middle of this series. */
int pm_chart_slope(struct pm_chart *c, double slope, int which);
struct pm_chart_series *pm_chart_series_new(struct pm_chart *c, size_t room); /* with x and y; NULL: failure */
extern const char *const pm_chart_styles[]; /* the words for enum pm_chart_style */
/* The styles of single series by their labels; 0 or failure. */
int pm_chart_restyle(struct pm_chart *c, const struct pm_chart_columns *want);
void pm_chart_free(struct pm_chart *c);
const char *pm_chart_x_name(const struct pm_chart_columns *want, const struct pm_number_table *t);

#endif
