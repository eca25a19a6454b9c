/* Positions and velocities rotated, shifted and wrapped into the box. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "mesh/rigid-motion.h"

int pm_turn_of(const char *text, struct pm_turn *t)
{
	char *end;
	t->axis[0] = t->axis[1] = -1;
	if (!text)
		return 0;
	int axis = *text >= 'x' && *text <= 'z' && text[1] == ',' ? *text - 'x' : -1;
	double degrees = axis < 0 ? 0 : strtod(text + 2, &end);
	if (axis < 0 || end == text + 2 || *end || !isfinite(degrees))
		return pm_fail(PM_USAGE, "--rotate '%s' is not AXIS,DEGREES (z,30)", text);
	double quarter = degrees / 90, whole = floor(quarter + 0.5), rest = (quarter - whole) * pm_pi / 2, s = sin(rest), c = cos(rest);
	int turns = (int)(whole - 4 * floor(whole / 4)); /* quarter turns are exact */
	t->axis[0] = (axis + 1) % 3, t->axis[1] = (axis + 2) % 3;
	t->cosine = turns == 0 ? c : turns == 1 ? 0 - s : turns == 2 ? -c : s; /* 0 - s: not -0 */
	t->sine = turns == 0 ? s : turns == 1 ? c : turns == 2 ? 0 - s : -c;
	return 0;
}

void pm_move_turn(const struct pm_turn *t, struct pm_field *p)
{
	if (t->axis[0] >= p->components || t->axis[1] >= p->components)
		return;
	double *a = pm_out(p, t->axis[0]), *b = pm_out(p, t->axis[1]);
	for (size_t i = 0; i < p->count; i++) {
		double u = a[i], w = b[i];
		a[i] = t->cosine * u - t->sine * w;
		b[i] = t->sine * u + t->cosine * w;
	}
}

/* Wraps into a periodic axis; the upper end becomes the lower. */
static double fold(double x, double lo, double hi)
{
	double y = x - (hi - lo) * floor((x - lo) / (hi - lo));
	return y < lo || y >= hi ? lo : y;
}

void pm_move_add(struct pm_field *p, int n, const double *by)
{
	for (int c = 0; c < n; c++)
		for (size_t i = 0; i < p->count; i++)
			pm_out(p, c)[i] += by[c];
}

void pm_move_fold(const struct pm_frame *f, struct pm_field *x)
{
	for (int c = 0; c < f->dim; c++) {
		double *y = pm_out(x, c);
		for (size_t i = 0; f->pface[c][0] == PM_PFOLD && i < x->count; i++)
			if (!(y[i] >= f->lo[c] && y[i] < f->hi[c]))
				y[i] = fold(y[i], f->lo[c], f->hi[c]);
	}
}
