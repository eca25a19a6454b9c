/* What a chart is drawn on: pixels or SVG. Coordinates in pixels from the upper left corner, y downwards. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CHART_CANVAS_H
#define PM_CHART_CANVAS_H

#include <stdio.h>

#include "picture/picture.h"

enum pm_canvas_anchor { PM_CANVAS_START, PM_CANVAS_MIDDLE, PM_CANVAS_END };

struct pm_canvas {
	void (*line)(struct pm_canvas *c, size_t n, double (*xy)[2], double width, const double dash[2], const unsigned char rgb[3]); /* dash NULL: none */
	void (*shape)(struct pm_canvas *c, size_t n, double (*xy)[2], const unsigned char rgb[3]); /* a filled polygon */
	void (*disc)(struct pm_canvas *c, double x, double y, double radius, const unsigned char rgb[3]);
	/* Text of this height of capitals whose base line starts at, has its middle at, or ends at x, y; turned: upwards. */
	void (*text)(struct pm_canvas *c, const double at[2], double height, enum pm_canvas_anchor anchor, bool turned, const char *text,
		const unsigned char rgb[3]);
	struct pm_picture *picture; /* pixels */
	FILE *out;                  /* SVG */
};

double pm_canvas_width(double height, const char *text); /* of a text, about */
struct pm_canvas pm_canvas_pixels(struct pm_picture *p);
struct pm_canvas pm_canvas_svg(FILE *out, int width, int height); /* writes the beginning */
void pm_canvas_svg_end(struct pm_canvas *c);

#endif
