/* A chart: series of points over two axes, as a picture or as text (docs/methods/splot.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CHART_H
#define PM_CHART_H

#include <stdio.h>

#include "base/base.h"

enum pm_chart_style { PM_CHART_AUTO, PM_CHART_LINES, PM_CHART_POINTS, PM_CHART_BOTH, PM_CHART_STEPS };
enum { PM_CHART_TICKS = 64, PM_CHART_COLOURS = 7, PM_CHART_MARKS = 8 };

struct pm_chart_series {
	char *label;          /* in the legend; "" none */
	size_t n;
	double *x, *y;        /* NAN: a gap */
	double *dx, *dy;      /* half lengths of the error bars, >= 0; NULL none */
	const char **name;    /* beside the points; NULL none, "" none for this one */
	enum pm_chart_style style;
	int colour;           /* index of the palette; -1: grey, for theory and other guides */
	int mark;             /* shape */
	bool dashed, thick;
};

struct pm_chart_axis {
	const char *label;
	bool log;
	double lo, hi;        /* NAN: from the data; then what pm_chart_scale sets */
	bool zero;            /* log: numbers that are 0 are drawn below lo, behind a break */
	size_t names;         /* a word for each of the places 1, 2, ...; 0: numbers */
	const char *const *name;
	bool down;            /* names: the first is at the high end */
	size_t beyond;        /* log: numbers below 0, not drawn */
};

struct pm_chart_guide { double at; const char *label; }; /* a straight line across */

struct pm_chart {
	struct pm_chart_axis x, y;
	struct pm_chart_series *series;
	size_t nseries;
	struct pm_chart_guide *level[2]; /* at places of x (vertical lines), of y */
	size_t nlevels[2];
	const char *title;
	int width, height;    /* pixels, or characters */
	bool legend_outside, no_legend;
	size_t unplaced;      /* set: names beside points for which there was no room */
};

struct pm_chart_ticks {
	int n, nminor;
	double at[PM_CHART_TICKS], minor[9 * PM_CHART_TICKS];
	char text[PM_CHART_TICKS][48];
	char factor[64];      /* "x 10^{-9} + 1": what the texts are multiplied with and added to; "" none */
};

/* The ends of the axes: of the data where they were not given, with a margin. 0 or failure (nothing to draw). */
int pm_chart_scale(struct pm_chart *c);
double pm_chart_at(const struct pm_chart_axis *a, double value); /* 0 at the low end, 1 at the high end; NAN where it cannot be drawn */
double pm_chart_value(const struct pm_chart_axis *a, double t);  /* its inverse (above the break) */
double pm_chart_break(const struct pm_chart_axis *a);            /* where the break of the zero is, 0: none */
/* At most `most` ticks with text; log: powers of ten and between. */
void pm_chart_ticks(const struct pm_chart_axis *a, int most, struct pm_chart_ticks *t);

extern const unsigned char pm_chart_palette[PM_CHART_COLOURS][3]; /* told apart by colour-blind people too (tests/unit/chart.c) */

struct pm_canvas;
int pm_chart_draw(struct pm_chart *c, struct pm_canvas *canvas);
struct pm_chart_print { bool ascii, colours; };
int pm_chart_print(struct pm_chart *c, FILE *out, struct pm_chart_print how);

#endif
