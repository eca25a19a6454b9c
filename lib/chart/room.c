/* A grid of what is taken on a chart. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "chart/room.h"

int pm_room_new(struct pm_room *r, double x0, double y0, double x1, double y1, double cell)
{
	*r = (struct pm_room){x0, y0, x1, y1, cell, {(size_t)ceil((x1 - x0) / cell) + 1, (size_t)ceil((y1 - y0) / cell) + 1}, NULL};
	r->taken = pm_zalloc(r->n[0] * r->n[1], 1);
	return r->taken ? 0 : -PM_DATA;
}

void pm_room_free(struct pm_room *r) { r->taken = pm_free(r->taken); }

static bool cells(const struct pm_room *r, const double box[4], size_t from[2], size_t to[2])
{
	const double lo[2] = {r->x0, r->y0};
	for (int d = 0; d < 2; d++) {
		double a = fmax(0, floor((box[d] - lo[d]) / r->cell)), b = fmin((double)r->n[d] - 1, floor((box[d + 2] - lo[d]) / r->cell));
		if (!(a <= b))
			return false;
		from[d] = (size_t)a, to[d] = (size_t)b;
	}
	return true;
}

void pm_room_take(struct pm_room *r, const double box[4], int what)
{
	size_t from[2], to[2];
	if (!cells(r, box, from, to))
		return;
	for (size_t j = from[1]; j <= to[1]; j++)
		for (size_t i = from[0]; i <= to[0]; i++)
			r->taken[j * r->n[0] + i] |= (unsigned char)what;
}

void pm_room_take_line(struct pm_room *r, const double a[2], const double b[2], int what)
{
	double length = hypot(b[0] - a[0], b[1] - a[1]);
	int pieces = (int)fmin(ceil(2 * length / r->cell) + 1, 1e5);
	for (int k = 0; k <= pieces; k++) {
		double t = (double)k / pieces, x = a[0] + t * (b[0] - a[0]), y = a[1] + t * (b[1] - a[1]);
		pm_room_take(r, (double[4]){x, y, x, y}, what);
	}
}

int pm_room_in(const struct pm_room *r, const double box[4])
{
	size_t from[2], to[2];
	int found = box[0] < r->x0 || box[1] < r->y0 || box[2] > r->x1 || box[3] > r->y1 ? PM_ROOM_TEXT : 0;
	if (!cells(r, box, from, to))
		return PM_ROOM_TEXT;
	for (size_t j = from[1]; j <= to[1]; j++)
		for (size_t i = from[0]; i <= to[0]; i++)
			found |= r->taken[j * r->n[0] + i];
	return found;
}

static bool is_free(const struct pm_room *r, double x, double y, double w, double h) { return !pm_room_in(r, (double[4]){x, y, x + w, y + h}); }

bool pm_room_at_edge(const struct pm_room *r, double w, double h, double gap, double at[2])
{
	double left = r->x0 + gap, right = r->x1 - gap - w, top = r->y0 + gap, bottom = r->y1 - gap - h;
	const double corner[4][2] = {{right, top}, {left, top}, {right, bottom}, {left, bottom}};
	if (right < left || bottom < top)
		return false;
	for (int k = 0; k < 4; k++)
		if (is_free(r, corner[k][0], corner[k][1], w, h))
			return at[0] = corner[k][0], at[1] = corner[k][1], true;
	for (int k = 1; k < 16; k++) {
		double x = right + k / 16.0 * (left - right), y = top + k / 16.0 * (bottom - top);
		const double edge[4][2] = {{x, top}, {right, y}, {x, bottom}, {left, y}};
		for (int e = 0; e < 4; e++)
			if (is_free(r, edge[e][0], edge[e][1], w, h))
				return at[0] = edge[e][0], at[1] = edge[e][1], true;
	}
	return false;
}

bool pm_room_beside(const struct pm_room *r, const double point[2], const double size[2], double away, bool lines, double at[2])
{
	/* right, left, above, below and between: where the box is, from its point, in halves of its size */
	static const double side[8][2] = {{1, 0}, {1, -1}, {1, 1}, {-1, 0}, {-1, -1}, {-1, 1}, {0, -1}, {0, 1}};
	const double near = away;
	for (int ring = 0; ring < 7; ring++, away += 0.6 * size[1] + 0.5 * near)
		for (int k = 0; k < 8; k++) {
			double d = side[k][0] != 0 && side[k][1] != 0 ? 0.7 * away : away;
			double x = point[0] + side[k][0] * (d + size[0] / 2) - size[0] / 2, y = point[1] + side[k][1] * (d + size[1] / 2) - size[1] / 2;
			int found = pm_room_in(r, (double[4]){x, y, x + size[0], y + size[1]});
			if (!(found & ~(lines ? PM_ROOM_LINE : 0)))
				return at[0] = x, at[1] = y, true;
		}
	return false;
}
