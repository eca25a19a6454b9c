/* A plot: a picture with axes, ticks, a bar of colours and a title. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PICTURE_PLOT_H
#define PM_PICTURE_PLOT_H

#include "picture/picture.h"
#include "picture/raster.h"

struct pm_scale { /* maps numbers to 0..1 */
	double lo, hi;
	bool log;
	int map;            /* of colours */
	double start;       /* where on the map lo is, 0 to 1 */
	bool centred;       /* the middle of the map is the number 0, even if lo and hi are not symmetric */
	bool below, above;  /* some numbers lie beyond lo or hi: the bar has a triangle at that end */
	const char *label;
};

struct pm_plot {
	struct pm_picture picture;
	int x0, y0, x1, y1;       /* the area of the data in pixels, y downwards */
	double lo[2], hi[2];      /* of the axes */
	double letter;            /* height of a capital, pixels */
};

/* The longer side of the data area has `size` pixels; aspect is its width over its height; bar leaves room for one. */
int pm_plot_new(struct pm_plot *p, int size, double aspect, const double lo[2], const double hi[2], bool bar, const unsigned char ground[3]);
void pm_plot_raster(struct pm_plot *p, const struct pm_raster *r, struct pm_scale *s); /* sets below and above */
/* value NULL: one colour */
void pm_plot_points(struct pm_plot *p, size_t n, const double *x, const double *y, const double *value, struct pm_scale *s, double radius);
void pm_plot_curve(struct pm_plot *p, size_t n, const double *x, const double *y);
void pm_plot_axes(struct pm_plot *p, const char *xlabel, const char *ylabel, const char *title, const char *note);
void pm_plot_bar(struct pm_plot *p, const struct pm_scale *s);
void pm_plot_free(struct pm_plot *p);
/* Round numbers from lo to hi: 1, 2 or 5 times a power of ten apart, at most `most`; their number. *step is the distance. */
int pm_plot_ticks(double lo, double hi, int most, double *at, double *step);
double pm_scale_at(const struct pm_scale *s, double value); /* 0 at lo, 1 at hi, not clamped */

#endif
