/* A view of a frame. A mesh field is a slice or an integral along an axis (3-D), as it is (2-D), or a curve (1-D); particles are points, or, where they are
 * many, their density over the plane of two expressions. Ranks make the density together; points are brought to rank 0, which draws.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "picture/colour.h"
#include "measure/range.h"
#include "picture/view.h"
#include "mesh/grid.h"
#include "stream/declare.h"
#include "world/world.h"

enum { many = 4000 };
static const unsigned char dark[3] = {17, 18, 28}, light[3] = {250, 250, 252};

int pm_view_component(const char *word)
{
	if (strlen(word) == 1 && *word >= 'x' && *word <= 'z')
		return *word - 'x';
	char *end;
	long k = strtol(word, &end, 10);
	return *word && !*end && k >= 0 && k < PM_COMPONENTS ? (int)k : -1;
}

/* ---- what is drawn ---- */

static int plan_mesh(struct pm_view *v, struct pm_frame *f, const char *mesh, const char *field)
{
	struct pm_field *p = pm_reads(f, mesh, field);
	if (!p)
		return -PM_DATA;
	if (v->component >= p->components)
		return pm_fail(PM_DATA, "'%s' on '%s' has %d components, --component is %d", field, mesh, p->components, v->component);
	v->on_mesh = true;
	snprintf(v->on, PM_NAME, "%s", mesh), snprintf(v->drawn, PM_NAME, "%s", field);
	return 0;
}

/* The mesh field asked for, or the last one there is: 1 found, 0 none. */
static int find_mesh(const struct pm_view *v, const struct pm_frame *f, const char **mesh, const char **field)
{
	for (size_t i = f->nfields; i-- > 0;) {
		const struct pm_field *p = f->fields[i];
		if (pm_frame_mesh(f, p->on) && (!v->mesh || !strcmp(v->mesh, p->on)) && (!v->field || !strcmp(v->field, p->name)))
			return *mesh = p->on, *field = p->name, 1;
	}
	return 0;
}

static int plan_set(struct pm_view *v, struct pm_frame *f, const char *set)
{
	const char *x = v->x ? v->x : "x", *y = v->y ? v->y : f->dim > 1 ? "y" : pm_frame_field(f, set, "v") ? "vx" : "x", *colour = v->colour;
	char first[PM_NAME + 2];
	int status;
	v->on_mesh = false;
	snprintf(v->on, PM_NAME, "%s", set);
	if (!colour && v->field) {
		const struct pm_field *p = pm_frame_field(f, set, v->field);
		snprintf(first, sizeof first, "%s%s", v->field, p && p->components > 1 ? "_0" : "");
		colour = first;
	}
	if ((status = pm_expression_compile(&v->ex, f, set, x)) || (status = pm_expression_compile(&v->ey, f, set, y)))
		return status;
	if ((colour && (status = pm_expression_compile(&v->ecolour, f, set, colour))) ||
		(v->weight && (status = pm_expression_compile(&v->eweight, f, set, v->weight))))
		return status;
	snprintf(v->drawn, PM_NAME, "%.63s", colour ? colour : "");
	return 0;
}

int pm_view_plan(struct pm_view *v, struct pm_frame *f)
{
	const char *mesh, *field, *set = v->set ? v->set : f->nsets ? f->sets[0]->name : NULL;
	bool particles = v->set || v->x || v->y || v->colour || v->weight || v->points || v->density;
	if (v->mesh && !pm_frame_mesh(f, v->mesh))
		return pm_fail(PM_DATA, "no mesh '%s' (sls lists what there is)", v->mesh);
	if (v->set && !pm_frame_set(f, v->set))
		return pm_fail(PM_DATA, "no set '%s' (sls lists what there is)", v->set);
	if (!particles && (v->field || v->mesh || !set)) {
		if (find_mesh(v, f, &mesh, &field))
			return plan_mesh(v, f, mesh, field);
		if (v->mesh || !set || !pm_frame_field(f, set, v->field))
			return pm_fail(PM_DATA, "no mesh field%s%s to draw (sls lists what there is; p2m makes rho)", v->field ? " " : "",
				v->field ? v->field : "");
	}
	return set ? plan_set(v, f, set) : pm_fail(PM_DATA, "no particles to draw");
}

/* ---- scales ---- */

/* Range, logarithm and map of the colours for numbers between min and max; least is the smallest positive one. */
static int scale_choose(const struct pm_view *v, struct pm_scale *s, double min, double max, double least, bool log, int map)
{
	bool signed_ = fmin(-min, max) > 0.01 * fmax(-min, max) && !log;
	s->log = log;
	s->map = v->map >= 0 ? v->map : signed_ ? pm_colour_find("coolwarm") : map;
	s->lo = log ? fmax(least, max * 1e-4) : min, s->hi = max;
	s->centred = s->map == pm_colour_find("coolwarm") && !log && (v->nrange ? v->range[0] < 0 && v->range[1] > 0 : min < 0 && max > 0);
	if (s->centred)
		s->hi = fmax(-min, max), s->lo = -s->hi;
	if (log && !(max > 0) && !v->nrange)
		return pm_fail(PM_DATA, "no value of '%s' is above 0, as a logarithm needs (leave --log out, or give --range)", v->drawn);
	if (v->nrange)
		s->lo = v->range[0], s->hi = v->range[1];
	if (log && !(s->lo > 0))
		return pm_fail(PM_USAGE, "--range starts at %g, but a logarithm needs values above 0", s->lo);
	if (!(s->hi > s->lo)) { /* all values are equal, or there are none */
		double half = s->lo != 0 ? fabs(s->lo) / 2 : 0.5;
		s->lo = log ? s->hi / 10 : isfinite(half) ? s->hi - half : 0, s->hi = isfinite(half) ? s->hi + half : 1;
	}
	return 0;
}

static int scale_raster(const struct pm_view *v, const struct pm_raster *r, double floor_, bool log, int map, struct pm_scale *s)
{
	double min = HUGE_VAL, max = -HUGE_VAL, least = HUGE_VAL;
	for (size_t i = 0; i < r->n[0] * r->n[1]; i++) {
		double y = r->value[i];
		min = fmin(min, y), max = fmax(max, y), least = y > 0 ? fmin(least, y) : least;
	}
	return scale_choose(v, s, min, max, fmax(least, floor_), log, map);
}

/* ---- words ---- */

static void title_of(const struct pm_view *v, const struct pm_frame *f, const char *what, char out[256])
{
	if (v->title)
		snprintf(out, 256, "%s", v->title);
	else
		snprintf(out, 256, "%s%s%s   t = %.6g   step %lld", *f->scene ? f->scene : f->law, *what ? "   " : "", what, f->time, (long long)f->step);
}

static void with_unit(const char *name, const char *unit, char out[160])
{
	snprintf(out, 160, "%.80s%s%s%s", name, *unit ? "  [" : "", unit, *unit ? "]" : "");
}

/* The field, if the expression is just one component of a field; else NULL. */
static const struct pm_field *plain(const struct pm_expression *e, const struct pm_frame *f)
{
	return e->nsteps == 1 && e->nvalues == 1 && *e->value[0].field ? pm_frame_field(f, e->on, e->value[0].field) : NULL;
}

static const char *unit_of(const struct pm_expression *e, const struct pm_frame *f)
{
	const struct pm_field *p = plain(e, f);
	return p ? p->unit : "";
}

/* The label of a box axis; its unit is that of the positions, where there are any. */
static void axis_label(const struct pm_frame *f, const char *name, char out[160])
{
	const struct pm_field *x = f->nsets ? pm_frame_field(f, f->sets[0]->name, "x") : NULL;
	with_unit(name, x ? x->unit : "", out);
}

static double aspect_of(const double lo[2], const double hi[2]) { return fmin(fmax((hi[0] - lo[0]) / (hi[1] - lo[1]), 0.2), 5); }

/* ---- meshes ---- */

static int curve(struct pm_view *v, struct pm_frame *f, struct pm_plot *p, const struct pm_mesh *m, const struct pm_field *field, const char *name)
{
	struct pm_range r = pm_range_of(f, field, v->component);
	size_t n = field->count + (f->face[0][0] == PM_PERIODIC); /* the first point again at the end of the box */
	double *x = pm_alloc(2 * n, sizeof *x), *y = x + n, pad = r.max > r.min ? 0.05 * (r.max - r.min) : r.max != 0 ? fabs(r.max) / 2 : 0.5;
	double lo[2] = {f->lo[0], r.min - pad}, hi[2] = {f->hi[0], r.max + pad};
	char title[256], label[160], across[160];
	if (!x)
		return -PM_DATA;
	for (size_t i = 0; i < n; i++) {
		x[i] = m->lo[0] + ((double)i + (v->component >= 0 ? 0.5 * field->staggered[v->component][0] : 0)) * m->h[0];
		y[i] = pm_field_value(field, v->component, i % field->count);
	}
	if (v->nrange)
		lo[1] = v->range[0], hi[1] = v->range[1];
	if (v->nwindow)
		lo[0] = v->window[0], hi[0] = v->window[1], lo[1] = v->window[2], hi[1] = v->window[3];
	int status = pm_plot_new(p, v->size, 1.6, lo, hi, false, light);
	if (!status) {
		title_of(v, f, "", title), with_unit(name, field->unit, label), axis_label(f, "x", across);
		pm_plot_curve(p, n, x, y);
		pm_plot_axes(p, across, label, title, "");
	}
	pm_free(x);
	return status;
}

static int mesh_raster(struct pm_view *v, struct pm_frame *f, const struct pm_mesh *m, const struct pm_field *field, struct pm_raster *r, char what[160],
	const char *name)
{
	double at = isnan(v->slice) ? (f->lo[v->axis] + f->hi[v->axis]) / 2 : v->slice;
	char axis = "xyz"[v->axis];
	if (f->dim == 3 && !v->project && !(at >= f->lo[v->axis] && at <= f->hi[v->axis]))
		return pm_fail(PM_DATA, "--slice %g is outside the box, %g to %g along %c", at, f->lo[v->axis], f->hi[v->axis], axis);
	if (f->dim < 3)
		snprintf(what, 160, "%.80s", name);
	else if (v->project)
		snprintf(what, 160, "integral of %.80s along %c", name, axis);
	else
		snprintf(what, 160, "%.80s at %c = %.4g", name, axis, at);
	return v->project ? pm_raster_project(r, f, m, field, v->component, v->axis) : pm_raster_slice(r, f, m, field, v->component, v->axis, at);
}

static int draw_mesh(struct pm_view *v, struct pm_frame *f, struct pm_plot *p)
{
	const struct pm_mesh *m = pm_frame_mesh(f, v->on);
	const struct pm_field *field = pm_frame_field(f, v->on, v->drawn);
	struct pm_raster r = {.value = NULL};
	struct pm_scale s = {.label = ""};
	char name[PM_NAME + 8], what[160], label[160], title[256], across[160], upwards[160];
	const char *const axes[] = {"x", "y", "z"};
	int x = f->dim == 3 && v->axis == 0 ? 1 : 0, y = f->dim == 3 && v->axis != 2 ? 2 : 1, status;
	if (field->components == 1)
		v->component = 0;
	snprintf(name, sizeof name, field->components == 1 ? "%s" : v->component < 0 ? "|%s|" : "%s_%.0d%c", v->drawn, 0,
		v->component < 3 ? "xyz"[v->component < 0 ? 0 : v->component] : '0' + v->component % 10);
	if (f->dim == 1)
		return curve(v, f, p, m, field, name);
	double lo[2] = {f->lo[x], f->lo[y]}, hi[2] = {f->hi[x], f->hi[y]};
	if (v->nwindow)
		lo[0] = v->window[0], hi[0] = v->window[1], lo[1] = v->window[2], hi[1] = v->window[3];
	status = mesh_raster(v, f, m, field, &r, what, name);
	if (field->here && pm_world_rank()) { /* rank 0 has the values */
		pm_raster_free(&r);
		return status;
	}
	if (!status && !(status = scale_raster(v, &r, 0, v->log, pm_colour_find("viridis"), &s)) &&
		!(status = pm_plot_new(p, v->size, aspect_of(lo, hi), lo, hi, true, dark))) {
		with_unit(v->project && f->dim == 3 ? what : name, v->project && f->dim == 3 ? "" : field->unit, label);
		s.label = label;
		title_of(v, f, v->project && f->dim == 3 ? name : what, title);
		pm_plot_raster(p, &r, &s);
		axis_label(f, axes[x], across), axis_label(f, axes[y], upwards);
		pm_plot_axes(p, across, upwards, title, "");
		pm_plot_bar(p, &s);
	}
	pm_raster_free(&r);
	return status;
}

/* ---- particles ---- */

/* The particles of a set, or of one that ranks share those here. */
struct drawn {
	size_t n, all;
	bool shared;
	double *x, *y, *extra; /* one block; extra may be NULL */
};

/* The range of an axis: the box for a position, else the range of the numbers and a small margin. */
static int window(int status, const struct pm_expression *e, const struct pm_frame *f, const struct drawn *d, const double *y, double *lo, double *hi)
{
	const struct pm_field *p = plain(e, f);
	if (p && !strcmp(p->name, "x") && e->value[0].component < f->dim) {
		*lo = f->lo[e->value[0].component], *hi = f->hi[e->value[0].component];
		return status;
	}
	double most[2] = {-HUGE_VAL, -HUGE_VAL}; /* of -y and y */
	for (size_t i = 0; i < d->n; i++)
		most[0] = fmax(most[0], -y[i]), most[1] = fmax(most[1], y[i]);
	status = d->shared ? pm_world_largest(status, 2, most) : status;
	*lo = d->all ? -most[0] : 0, *hi = d->all ? most[1] : 1;
	double pad = *hi > *lo ? 0.04 * (*hi - *lo) : *lo != 0 ? fabs(*lo) / 2 : 0.5;
	*lo -= pad, *hi += pad;
	return status;
}

/* All of them on rank 0; what it had here is freed. */
static int bring(int status, struct drawn *d)
{
	double *const own[] = {d->x, d->y, d->extra}, *all = NULL;
	for (int k = 0; k < (d->extra ? 3 : 2); k++) {
		void *came = NULL;
		size_t bytes = 0;
		status = pm_world_gather(status, own[k], d->n * sizeof *all, &came, &bytes);
		if (!status && came && !all && !(all = pm_alloc(3 * d->all + 1, sizeof *all)))
			status = pm_failed();
		if (all && came)
			memcpy(all + (size_t)k * d->all, came, bytes);
		pm_free(came);
	}
	status = pm_world_agree(status);
	if (!status && all) {
		pm_free(d->x);
		*d = (struct drawn){.n = d->all, .all = d->all, .x = all, .y = all + d->all, .extra = d->extra ? all + 2 * d->all : NULL};
	} else
		pm_free(all);
	return status;
}

/* Is this a rank that has counted its points, and leaves the drawing to rank 0? */
static bool others(const struct drawn *d) { return d->shared && pm_world_rank(); }

static int draw_density(int status, struct pm_view *v, struct pm_plot *p, const struct drawn *d, struct pm_scale *s, size_t *outside)
{
	struct pm_raster r = {.value = NULL};
	const size_t n = d->all;
	const struct pm_raster_points points = {.n = d->n, .all = n, .x = d->x, .y = d->y, .w = d->extra, .shared = d->shared};
	double longer = fmin(fmax(2 * sqrt((double)n), 64), v->size), aspect = (double)(p->x1 - p->x0) / (p->y1 - p->y0), total = 0;
	const size_t bins[2] = {(size_t)fmax(longer * fmin(aspect, 1), 8), (size_t)fmax(longer / fmax(aspect, 1), 8)};
	status = d->shared ? pm_world_agree(status) : status;
	status = status ? status : pm_raster_density(&r, bins, p->lo, p->hi, &points, outside);
	if (others(d)) {
		pm_raster_free(&r);
		return status;
	}
	for (size_t i = 0; !status && i < bins[0] * bins[1]; i++)
		total += r.value[i];
	double one = n > *outside ? total / (double)(n - *outside) : 1; /* the density of one particle in one bin */
	for (int k = 0; k < 2 && !status; k++)
		status = pm_raster_smooth(&r); /* a particle becomes a small round spot */
	if (!status && !(status = scale_raster(v, &r, one / 12, v->log || !v->linear, pm_colour_find("inferno"), s))) {
		pm_plot_raster(p, &r, s);
		s->below = s->below && v->nrange;
	}
	pm_raster_free(&r);
	return status;
}

/* Radius of a point: a seventh of the mean distance of the points, within limits. */
static double point_radius(int size, size_t n)
{
	double unit = size / 640.0;
	return fmin(fmax(0.14 * size / sqrt((double)n + 1), fmax(0.9, unit)), 4 * fmax(unit, 0.5));
}

static bool is_density(const struct pm_view *v, size_t n) { return v->density || (!v->points && !*v->drawn && (n > many || v->weight)); }

static int draw_on(struct pm_view *v, struct pm_frame *f, struct pm_plot *p, const struct drawn *d)
{
	const size_t n = d->all;
	const double *x = d->x, *y = d->y, *extra = d->extra;
	struct pm_scale s = {.label = v->drawn};
	char note[96], title[256], labels[3][160];
	size_t outside = 0;
	const bool density = is_density(v, n);
	double aspect = plain(&v->ex, f) && plain(&v->ex, f) == plain(&v->ey, f) ? aspect_of(p->lo, p->hi) : 1.25;
	double lo[2] = {p->lo[0], p->lo[1]}, hi[2] = {p->hi[0], p->hi[1]};
	int status = pm_plot_new(p, v->size, aspect, lo, hi, density || *v->drawn, dark);
	for (size_t i = 0; !density && i < n; i++)
		outside += !(x[i] >= lo[0] && x[i] <= hi[0] && y[i] >= lo[1] && y[i] <= hi[1]);
	if (density && n)
		status = draw_density(status, v, p, d, &s, &outside);
	else if (!status) {
		double min = HUGE_VAL, max = -HUGE_VAL, least = HUGE_VAL;
		for (size_t i = 0; extra && i < n; i++)
			min = fmin(min, extra[i]), max = fmax(max, extra[i]), least = extra[i] > 0 ? fmin(least, extra[i]) : least;
		if (extra && n)
			status = scale_choose(v, &s, min, max, least, v->log, pm_colour_find("viridis"));
		s.start = s.map == pm_colour_find("coolwarm") ? 0 : 0.25; /* points must not be as dark as the background */
		if (!status)
			pm_plot_points(p, n, x, y, n ? extra : NULL, &s, point_radius(v->size, n));
	}
	if (status || (density && others(d)))
		return status;
	snprintf(note, sizeof note, outside ? "n = %zu, %zu outside" : "n = %zu", n - outside, outside);
	title_of(v, f, "", title);
	with_unit(v->x ? v->x : "x", unit_of(&v->ex, f), labels[0]);
	with_unit(v->y ? v->y : f->dim > 1 ? "y" : "vx", unit_of(&v->ey, f), labels[1]);
	snprintf(labels[2], 160, "%.120s per area", v->weight ? v->weight : "particles");
	pm_plot_axes(p, labels[0], labels[1], title, note);
	if (density && n)
		s.label = labels[2], pm_plot_bar(p, &s);
	else if (extra && n)
		with_unit(v->drawn, unit_of(&v->ecolour, f), labels[2]), s.label = labels[2], pm_plot_bar(p, &s);
	return 0;
}

static struct drawn particles_of(const struct pm_frame *f, const char *set)
{
	struct drawn d = {.all = pm_frame_set(f, set)->n};
	d.n = d.all;
	for (size_t i = 0; i < f->nfields; i++)
		if (f->fields[i]->here && !strcmp(f->fields[i]->on, set))
			d.n = f->fields[i]->count, d.shared = true;
	return d;
}

static int draw_set(struct pm_view *v, struct pm_frame *f, struct pm_plot *p)
{
	struct drawn d = particles_of(f, v->on);
	const struct pm_expression *third = *v->drawn ? &v->ecolour : v->weight ? &v->eweight : NULL;
	const size_t n = d.n;
	int status = (d.x = pm_alloc(3 * n + 1, sizeof *d.x)) ? 0 : -PM_DATA;
	d.y = d.x + n, d.extra = third ? d.y + n : NULL;
	if (!status) {
		pm_expression_eval(&v->ex, f, 0, n, d.x);
		pm_expression_eval(&v->ey, f, 0, n, d.y);
		if (third)
			pm_expression_eval(third, f, 0, n, d.extra);
		if (!pm_finite(n, d.x) || !pm_finite(n, d.y) || (third && !pm_finite(n, d.extra)))
			status = pm_fail(PM_NUMERICS, "an expression to draw is not finite everywhere (choose particles with sel --where)");
	}
	status = d.shared ? pm_world_agree(status) : status;
	status = window(status, &v->ex, f, &d, d.x, &p->lo[0], &p->hi[0]);
	status = window(status, &v->ey, f, &d, d.y, &p->lo[1], &p->hi[1]);
	if (v->nwindow)
		p->lo[0] = v->window[0], p->hi[0] = v->window[1], p->lo[1] = v->window[2], p->hi[1] = v->window[3];
	const bool points = d.shared && !is_density(v, d.all);
	if (points)
		status = bring(status, &d);
	if (!status && !(points && pm_world_rank()))
		status = draw_on(v, f, p, &d);
	pm_free(d.x);
	return status;
}

int pm_view_draw(struct pm_view *v, struct pm_frame *f, struct pm_plot *p)
{
	memset(p, 0, sizeof *p);
	return v->on_mesh ? draw_mesh(v, f, p) : draw_set(v, f, p);
}
