/* What splot does: tables and columns into a chart, and the chart into a file or the terminal. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CHART_PLOT_JOB_H
#define PM_CHART_PLOT_JOB_H

#include "chart/columns.h"

struct pm_plot_job {
	const char *input, *output, *title, *label[2], *theory;
	const char *const *list[6]; /* columns, errors, errors along x, by, where, styles of single lines */
	int n[6];
	struct pm_chart_columns columns; /* x, name and style are given */
	bool text, ascii, logx, logy, legend_outside, no_legend;
	const double *numbers[5];   /* ends of the x and of the y axis (none: of the data), slopes, vertical and horizontal lines */
	int count[5];
	int width, height;          /* 0: the usual */
	size_t beyond, unplaced;    /* set: numbers below 0 on logarithmic axes, names without room */
};

/* Arguments that are files are tables, the others columns. 0 or failure. */
int pm_plot_job_run(struct pm_plot_job *job, int nargs, const char *const *args);

#endif
