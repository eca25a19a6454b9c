/* A chart being drawn: what draw.c and series.c share. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CHART_DRAWING_H
#define PM_CHART_DRAWING_H

#include "chart/canvas.h"
#include "chart/chart.h"
#include "chart/room.h"

static const unsigned char pm_chart_ink[3] = {38, 42, 51}, pm_chart_grid[3] = {229, 232, 237}, pm_chart_guide_ink[3] = {112, 118, 130};
static const unsigned char pm_chart_paper[3] = {255, 255, 255};

struct pm_drawing {
	struct pm_chart *c;
	struct pm_canvas *k;
	double letter, x0, y0, x1, y1; /* height of a capital; the area; all in pixels */
	struct pm_chart_ticks tx, ty;
	struct pm_room room;
	double legend[2], size[2];     /* upper left corner, width and height of the legend; size 0: none */
	bool outside;
	int status;                    /* failed, if not 0 */
};

double pm_drawing_x(const struct pm_drawing *d, double v);
double pm_drawing_y(const struct pm_drawing *d, double v);
bool pm_drawing_inside(const struct pm_drawing *d, double x, double y);
void pm_drawing_piece(struct pm_drawing *d, const double ends[4], double width, const double dash[2], const unsigned char rgb[3]); /* x0 y0 x1 y1 */
bool pm_series_has_lines(const struct pm_chart_series *s);
bool pm_series_has_marks(const struct pm_chart_series *s);
void pm_series_mark(struct pm_drawing *d, const struct pm_chart_series *s, double x, double y, bool open);
void pm_series_sample(struct pm_drawing *d, const struct pm_chart_series *s, double x, double y, double length); /* of its line, for the legend */
void pm_series_line(struct pm_drawing *d, const struct pm_chart_series *s);
void pm_series_points(struct pm_drawing *d, const struct pm_chart_series *s); /* with their error bars */
void pm_series_take(struct pm_drawing *d, const struct pm_chart_series *s);   /* marks the room it needs */

#endif
