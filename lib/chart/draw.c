/* Draws a chart on pixels or as SVG. The legend goes where no data are, else beside the area; names of points go where they cover nothing.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "chart/drawing.h"

/* Okabe and Ito (2008), without yellow, which is too light for lines on white: told apart with any of the three kinds of colour blindness. */
const unsigned char pm_chart_palette[PM_CHART_COLOURS][3] = {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233},
	{30, 33, 40}};
static const double long_dashes[2] = {7, 4}, dots[2] = {3, 3};

/* ---- the legend ---- */

static size_t legend_rows(const struct pm_chart *c)
{
	size_t n = 0;
	for (size_t k = 0; !c->no_legend && k < c->nseries; k++)
		n += *c->series[k].label != 0;
	return n;
}

static void legend_size(struct pm_drawing *d)
{
	double widest = 0;
	for (size_t k = 0; k < d->c->nseries; k++)
		if (*d->c->series[k].label)
			widest = fmax(widest, pm_canvas_width(d->letter, d->c->series[k].label));
	d->size[0] = legend_rows(d->c) ? widest + 5.2 * d->letter : 0;
	d->size[1] = 1.75 * d->letter * (double)legend_rows(d->c) + 0.8 * d->letter;
}

static void legend(struct pm_drawing *d)
{
	double l = d->letter, x = d->legend[0], y = d->legend[1] + 1.55 * l;
	if (!(d->size[0] > 0))
		return;
	if (!d->outside)
		d->k->shape(d->k, 4, (double[4][2]){{x, d->legend[1]}, {x + d->size[0], d->legend[1]}, {x + d->size[0], d->legend[1] + d->size[1]},
			{x, d->legend[1] + d->size[1]}}, pm_chart_paper);
	for (size_t k = 0; k < d->c->nseries; k++) {
		const struct pm_chart_series *s = &d->c->series[k];
		if (!*s->label)
			continue;
		pm_series_sample(d, s, x + 0.7 * l, y - l / 2, 3 * l);
		d->k->text(d->k, (double[2]){x + 4.5 * l, y}, l, PM_CANVAS_START, false, s->label, pm_chart_ink);
		y += 1.75 * l;
	}
}

/* ---- names beside points ---- */

static void names(struct pm_drawing *d)
{
	double l = 0.82 * d->letter, at[2];
	d->c->unplaced = 0;
	for (size_t k = 0; k < d->c->nseries; k++) {
		const struct pm_chart_series *s = &d->c->series[k];
		for (size_t i = 0; s->name && i < s->n; i++) {
			double point[2] = {pm_drawing_x(d, s->x[i]), pm_drawing_y(d, s->y[i])}, near = 0.9 * d->letter;
			double size[2] = {pm_canvas_width(l, s->name[i]) + 0.4 * l, 1.5 * l};
			if (isnan(point[0]) || isnan(point[1]) || !pm_drawing_inside(d, point[0], point[1]) || !*s->name[i])
				continue;
			if (!pm_room_beside(&d->room, point, size, near, false, at) && !pm_room_beside(&d->room, point, size, near, true, at)) {
				d->c->unplaced++;
				continue;
			}
			pm_room_take(&d->room, (double[4]){at[0], at[1], at[0] + size[0], at[1] + size[1]}, PM_ROOM_TEXT);
			/* a thin line to a name that is not beside its point */
			double end[2] = {fmin(fmax(point[0], at[0]), at[0] + size[0]), fmin(fmax(point[1], at[1] + 0.2 * l), at[1] + 1.3 * l)};
			double dx = end[0] - point[0], dy = end[1] - point[1], far = hypot(dx, dy);
			if (far > 1.6 * d->letter) {
				double start[2] = {point[0] + 0.6 * d->letter * dx / far, point[1] + 0.6 * d->letter * dy / far};
				pm_drawing_piece(d, (double[4]){start[0], start[1], end[0], end[1]}, 0.07 * d->letter, NULL, pm_chart_guide_ink);
				pm_room_take_line(&d->room, point, end, PM_ROOM_LINE);
			}
			d->k->text(d->k, (double[2]){at[0] + 0.2 * l, at[1] + 1.25 * l}, l, PM_CANVAS_START, false, s->name[i],
				s->colour < 0 ? pm_chart_guide_ink : pm_chart_ink);
		}
	}
}

/* ---- axes ---- */

static double widest_tick(const struct pm_drawing *d, const struct pm_chart_ticks *t)
{
	double w = 0;
	for (int i = 0; i < t->n; i++)
		w = fmax(w, pm_canvas_width(d->letter, t->text[i]));
	return w;
}

/* As many ticks along x as their texts have room. */
static void ticks_x(struct pm_drawing *d)
{
	for (int most = 10; most >= 2; most--) {
		pm_chart_ticks(&d->c->x, most, &d->tx);
		bool apart = true;
		for (int i = 1; i < d->tx.n; i++)
			apart &= fabs(pm_drawing_x(d, d->tx.at[i]) - pm_drawing_x(d, d->tx.at[i - 1])) > 1.2 * d->letter +
				(pm_canvas_width(d->letter, d->tx.text[i]) + pm_canvas_width(d->letter, d->tx.text[i - 1])) / 2;
		if (apart)
			return;
	}
}

static void label_of(const struct pm_chart_axis *a, const struct pm_chart_ticks *t, char out[512])
{
	snprintf(out, 512, "%s%s%s%s", a->label ? a->label : "", *t->factor ? a->label && *a->label ? "   (" : "(" : "", t->factor, *t->factor ? ")" : "");
}

/* The area: what is left beside the texts. */
static void lay_out(struct pm_drawing *d)
{
	struct pm_chart *c = d->c;
	double l = d->letter;
	char text[512];
	d->y0 = (c->title && *c->title ? 3.4 : 1.4) * l;
	d->y1 = c->height - 4.4 * l; /* the label may have a factor that is not known yet */
	pm_chart_ticks(&c->y, c->y.names ? (int)c->y.names : (int)fmax(2, (d->y1 - d->y0) / (4 * l)), &d->ty);
	label_of(&c->y, &d->ty, text);
	d->x0 = (*text ? 3.4 : 0.8) * l + widest_tick(d, &d->ty) + 0.9 * l;
	d->x1 = c->width - 1.8 * l - (d->outside ? d->size[0] + 0.4 * l : 0);
	d->x0 = fmin(d->x0, 0.6 * d->x1);
	ticks_x(d);
	if (d->tx.n) /* half of the last text may stand out */
		d->x1 = fmin(d->x1, c->width - 0.6 * l - (d->outside ? d->size[0] + 0.4 * l : 0) - pm_canvas_width(l, d->tx.text[d->tx.n - 1]) *
			fmax(0, 0.5 - (1 - pm_chart_at(&c->x, d->tx.at[d->tx.n - 1])) * 10));
	label_of(&c->x, &d->tx, text);
	if (!*text)
		d->y1 = c->height - 2.6 * l;
}

static void frame_lines(struct pm_drawing *d)
{
	for (int i = 0; i < d->tx.n; i++) {
		double x = pm_drawing_x(d, d->tx.at[i]);
		if (x > d->x0 + 1 && x < d->x1 - 1)
			pm_drawing_piece(d, (double[4]){x, d->y0, x, d->y1}, 0.08 * d->letter, NULL, pm_chart_grid);
	}
	for (int i = 0; i < d->ty.n; i++) {
		double y = pm_drawing_y(d, d->ty.at[i]);
		if (y > d->y0 + 1 && y < d->y1 - 1)
			pm_drawing_piece(d, (double[4]){d->x0, y, d->x1, y}, 0.08 * d->letter, NULL, pm_chart_grid);
	}
	double bx = d->x0 + 0.8 * pm_chart_break(&d->c->x) * (d->x1 - d->x0), by = d->y1 - 0.8 * pm_chart_break(&d->c->y) * (d->y1 - d->y0);
	if (bx > d->x0)
		pm_drawing_piece(d, (double[4]){bx, d->y0, bx, d->y1}, 0.1 * d->letter, dots, pm_chart_guide_ink);
	if (by < d->y1)
		pm_drawing_piece(d, (double[4]){d->x0, by, d->x1, by}, 0.1 * d->letter, dots, pm_chart_guide_ink);
	for (int axis = 0; axis < 2; axis++)
		for (size_t i = 0; i < d->c->nlevels[axis]; i++) {
			double x = pm_drawing_x(d, d->c->level[axis][i].at), y = pm_drawing_y(d, d->c->level[axis][i].at);
			if (axis ? y >= d->y0 && y <= d->y1 : x >= d->x0 && x <= d->x1)
				pm_drawing_piece(d, (double[4]){axis ? d->x0 : x, axis ? y : d->y0, axis ? d->x1 : x, axis ? y : d->y1}, 0.13 * d->letter,
					long_dashes, pm_chart_guide_ink);
		}
}

static void axes(struct pm_drawing *d)
{
	double l = d->letter, w = 0.12 * l;
	char text[512];
	for (int i = 0; i < d->tx.nminor; i++) {
		double x = pm_drawing_x(d, d->tx.minor[i]);
		if (x >= d->x0 && x <= d->x1)
			pm_drawing_piece(d, (double[4]){x, d->y1, x, d->y1 + 0.3 * l}, 0.75 * w, NULL, pm_chart_ink);
	}
	for (int i = 0; i < d->ty.nminor; i++) {
		double y = pm_drawing_y(d, d->ty.minor[i]);
		if (y >= d->y0 && y <= d->y1)
			pm_drawing_piece(d, (double[4]){d->x0 - 0.3 * l, y, d->x0, y}, 0.75 * w, NULL, pm_chart_ink);
	}
	for (int i = 0; i < d->tx.n; i++) {
		double x = pm_drawing_x(d, d->tx.at[i]);
		pm_drawing_piece(d, (double[4]){x, d->y1, x, d->y1 + 0.5 * l}, w, NULL, pm_chart_ink);
		d->k->text(d->k, (double[2]){x, d->y1 + 1.9 * l}, l, PM_CANVAS_MIDDLE, false, d->tx.text[i], pm_chart_ink);
	}
	for (int i = 0; i < d->ty.n; i++) {
		double y = pm_drawing_y(d, d->ty.at[i]);
		pm_drawing_piece(d, (double[4]){d->x0 - 0.5 * l, y, d->x0, y}, w, NULL, pm_chart_ink);
		d->k->text(d->k, (double[2]){d->x0 - 0.9 * l, y + l / 2}, l, PM_CANVAS_END, false, d->ty.text[i], pm_chart_ink);
	}
	d->k->line(d->k, 5, (double[5][2]){{d->x0, d->y0}, {d->x1, d->y0}, {d->x1, d->y1}, {d->x0, d->y1}, {d->x0, d->y0}}, w, NULL, pm_chart_ink);
	label_of(&d->c->x, &d->tx, text);
	d->k->text(d->k, (double[2]){(d->x0 + d->x1) / 2, d->c->height - 0.7 * l}, l, PM_CANVAS_MIDDLE, false, text, pm_chart_ink);
	label_of(&d->c->y, &d->ty, text);
	d->k->text(d->k, (double[2]){1.7 * l, (d->y0 + d->y1) / 2}, l, PM_CANVAS_MIDDLE, true, text, pm_chart_ink);
	if (d->c->title)
		d->k->text(d->k, (double[2]){d->x0, d->y0 - 1.1 * l}, 1.1 * l, PM_CANVAS_START, false, d->c->title, pm_chart_ink);
}

/* What is taken, and the place of the legend; false: there is none inside. d->status is set where nothing can be drawn. */
static bool find_rooms(struct pm_drawing *d)
{
	const double least = 4 * d->letter;
	pm_room_free(&d->room);
	if (!(d->x1 - d->x0 >= least))
		d->status = pm_fail(PM_DATA, "the texts leave no room for the data (--legend none, or a larger --width)");
	else if (!(d->y1 - d->y0 >= least))
		d->status = pm_fail(PM_DATA, "the texts leave no room for the data (a larger --height, or a smaller --width)");
	else
		d->status = pm_room_new(&d->room, d->x0, d->y0, d->x1, d->y1, 0.5 * d->letter);
	if (d->status)
		return true;
	for (size_t k = 0; k < d->c->nseries; k++)
		pm_series_take(d, &d->c->series[k]);
	if (!(d->size[0] > 0))
		return true;
	if (d->outside)
		d->legend[0] = d->c->width - d->size[0] - 0.6 * d->letter, d->legend[1] = d->y0 - 0.4 * d->letter;
	else if (d->size[0] > 0.6 * (d->x1 - d->x0) || !pm_room_at_edge(&d->room, d->size[0], d->size[1], 0.5 * d->letter, d->legend))
		return false;
	else
		pm_room_take(&d->room, (double[4]){d->legend[0], d->legend[1], d->legend[0] + d->size[0], d->legend[1] + d->size[1]}, PM_ROOM_TEXT);
	return true;
}

int pm_chart_draw(struct pm_chart *c, struct pm_canvas *canvas)
{
	const double size = fmax(6, sqrt((double)c->width * c->height) / 72), flat = fmin(c->width / 90.0, c->height / 14.0);
	struct pm_drawing d = {.c = c, .k = canvas, .letter = fmax(size, flat), .outside = c->legend_outside};
	legend_size(&d);
	lay_out(&d);
	if (!find_rooms(&d)) {
		d.outside = true;
		lay_out(&d);
		find_rooms(&d);
	}
	if (!d.status) {
		frame_lines(&d);
		for (int guides = 1; guides >= 0; guides--) /* under the data */
			for (size_t k = c->nseries; k-- > 0;)
				if ((c->series[k].colour < 0) == guides)
					pm_series_line(&d, &c->series[k]);
		for (size_t k = c->nseries; k-- > 0;)
			pm_series_points(&d, &c->series[k]);
		axes(&d);
		legend(&d);
		names(&d);
	}
	pm_room_free(&d.room);
	return d.status;
}
