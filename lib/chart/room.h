/* What is taken on a chart, so that legends and names find a free place. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CHART_ROOM_H
#define PM_CHART_ROOM_H

#include "base/base.h"

enum { PM_ROOM_LINE = 1, PM_ROOM_MARK = 2, PM_ROOM_TEXT = 4 };

struct pm_room {
	double x0, y0, x1, y1, cell; /* the area in pixels */
	size_t n[2];
	unsigned char *taken;
};

int pm_room_new(struct pm_room *r, double x0, double y0, double x1, double y1, double cell);
void pm_room_free(struct pm_room *r);
void pm_room_take(struct pm_room *r, const double box[4], int what);         /* x0 y0 x1 y1 */
void pm_room_take_line(struct pm_room *r, const double a[2], const double b[2], int what);
int pm_room_in(const struct pm_room *r, const double box[4]);                /* what is taken in the box; TEXT if it leaves the area */
/* The upper left corner of a free place of this size at an edge of the area, corners first. false: none. */
bool pm_room_at_edge(const struct pm_room *r, double width, double height, double gap, double at[2]);
/* A free box of this size beside a point, near first: its upper left corner. lines: it may lie over lines. false: none within reach. */
bool pm_room_beside(const struct pm_room *r, const double point[2], const double size[2], double away, bool lines, double at[2]);

#endif
