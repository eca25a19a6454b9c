/* The window stands still until `from` and then moves with its speed, by whole cells: between t and t + dt by
 *     floor(V (t + dt - from)/h) - floor(V (t - from)/h)
 * cells, which depends on the header alone. State of the mesh (E, B, the memory of absorbing layers) moves with its points and enters as 0; particles behind
 * the window leave; the cells that are new in front are filled with n^dim particles each, evenly, that stand for the density there: q n(x) V_cell/n^dim.
 * Electrons that come in without ions are neutral with ions that do not move, because E comes in as 0 with them.
 * Source: Decker and Mori 1994, Phys. Rev. Lett. 72, 490. Cost: the state of the mesh, a pass over the particles, and the new ones.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "load/moving-window.h"
#include "load/newcomers.h"
#include "mesh/grid.h"
#include "push/push-set.h"
#include "scene-parts/scene-loading.h"
#include "stream/declare.h"
#include "stream/edit.h"
#include "stream/frame-time.h"
#include "stream/join.h"

static const char *const variable[] = {"x", "y", "z", NULL};

static double speed_of(const struct pm_window *w, const struct pm_frame *f) { return isnan(w->speed) ? pm_frame_constant(f, "c", 1) : w->speed; }

/* Cells that the window has passed when this step begins. 1e-6: a time that is a multiple of h/V but for round-off. */
static double passed(const struct pm_window *w, const struct pm_frame *f, const struct pm_mesh *m, int64_t step)
{
	return floor(fmax(0, speed_of(w, f) * (pm_frame_time_at(f, step) - w->from)) / m->h[w->axis] + 1e-6);
}

static double shift(const struct pm_window *w, const struct pm_frame *f, const struct pm_mesh *m)
{
	return passed(w, f, m, f->step + 1) - passed(w, f, m, f->step);
}

static struct pm_newcomers newcomers(const struct pm_window *w, const struct pm_frame *f, int set)
{
	const struct pm_field *v = pm_frame_field(f, w->set[set], "v");
	return (struct pm_newcomers){.set = w->set[set], .velocities = v ? v->components : f->dim};
}

static int refuse(const struct pm_window *w, const struct pm_frame *f, const struct pm_mesh *m)
{
	const int d = w->axis;
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return -PM_DATA;
	if (!law->evolves)
		return pm_fail(PM_DATA, "the fields of the law '%s' are made anew of all particles, also of those far behind (smod --law electromagnetic)",
			f->law);
	if (!m)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", w->mesh ? " " : "", w->mesh ? w->mesh : "");
	if (d >= f->dim)
		return pm_fail(PM_DATA, "a window along %c in %d-D (--axis)", "xyz"[d], f->dim);
	if (!(f->dt > 0))
		return pm_fail(PM_DATA, "the time step is %g, and the window moves with time (smod --dt)", f->dt);
	if (f->face[d][0] == PM_PERIODIC || f->pface[d][0] == PM_PFOLD)
		return pm_fail(PM_DATA, "the box is periodic along %c, and a window has an end (smod --faces open,... --particle-faces absorb,...)", "xyz"[d]);
	for (int i = 0; i < w->sets; i++) {
		if (!pm_frame_set(f, w->set[i]))
			return pm_fail(PM_DATA, "no set '%s' (species %s -n 0 in front of the steps makes it)", w->set[i], w->set[i]);
		for (int k = 0; k < i; k++)
			if (!strcmp(w->set[i], w->set[k]))
				return pm_fail(PM_USAGE, "'%s' twice", w->set[i]);
	}
	return 0;
}

/* Has every set that moves been drifted? */
static bool drifted(const struct pm_frame *f)
{
	for (size_t i = 0; i < f->nsets; i++)
		if (pm_set_moves(f, f->sets[i]) && !(f->sets[i]->drift > 1 - 1e-9))
			return false;
	return f->substep > 0;
}

static int hold(struct pm_frame *f, const struct pm_mesh *m)
{
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *field = f->fields[i];
		if (!strcmp(field->on, m->name) && !field->uniform && !pm_changes(f, m->name, field->name))
			return -PM_DATA;
		if (pm_frame_mesh(f, field->on) && strcmp(field->on, m->name) && !field->uniform)
			return pm_fail(PM_DATA, "'%s' on mesh '%s' would stay where it is while '%s' moves (sel --drop %s)", field->name, field->on, m->name,
				field->name);
	}
	return 0;
}

int pm_window_declare(struct pm_window *w, struct pm_frame *f)
{
	const struct pm_mesh *m = pm_frame_mesh(f, w->mesh);
	int status = refuse(w, f, m);
	if (status)
		return status;
	if (!f->substep)
		return pm_fail(PM_DATA, "a window moves within a step, behind the drift (push drift | window ... | m2p)");
	if (!drifted(f) || shift(w, f, m) == 0)
		return PM_WINDOW_WAITS;
	pm_drops_roles(f, NULL, 1u << PM_CHANGE | 1u << PM_DERIVED);
	for (size_t i = 0; i < f->nfields; i++)
		if (f->fields[i]->role == PM_CHANGE || f->fields[i]->role == PM_REGISTER)
			return pm_fail(PM_DATA, "'%s' has '%s' already, which new particles lack (put window behind the drift, in front of m2p)",
				f->fields[i]->on, f->fields[i]->name);
	status = hold(f, m);
	for (size_t i = 0; i < f->nsets && !status; i++) {
		const struct pm_moving all = {.set = f->sets[i]};
		status = f->sets[i]->n ? pm_moving_shrinks(f, &all) : 0;
	}
	for (int i = 0; i < w->sets && !status; i++) {
		const struct pm_newcomers a = newcomers(w, f, i);
		status = pm_newcomers_declare(f, &a);
	}
	return status ? status : PM_WINDOW_ACTS;
}

/* Value i of the axis becomes value i + by; 0 where that is beyond the end. */
static void shift_values(double *a, const size_t n[3], int axis, size_t by)
{
	const size_t inner = axis == 0 ? 1 : axis == 1 ? n[0] : n[0] * n[1], line = inner * n[axis], lines = n[0] * n[1] * n[2] / line, gone = by * inner;
#pragma omp parallel for schedule(static) if (lines * line > 16384)
	for (size_t i = 0; i < lines; i++) {
		double *b = a + i * line;
		memmove(b, b + gone, (line - gone) * sizeof *b);
		memset(b + line - gone, 0, gone * sizeof *b);
	}
}

static int move_box(const struct pm_window *w, struct pm_frame *f, struct pm_mesh *m, size_t by)
{
	const int d = w->axis;
	size_t points[3];
	pm_mesh_points(f, m, points);
	if (by >= points[d])
		return pm_fail(PM_DATA, "the window moves by %zu cells within a step, over all %zu of the mesh '%s' (a smaller --speed)", by, m->cells[d],
			m->name);
	for (size_t i = 0; i < f->nfields; i++) {
		struct pm_field *field = f->fields[i];
		for (int c = 0; !strcmp(field->on, m->name) && !field->uniform && c < field->components; c++)
			shift_values(pm_out(field, c), points, d, by);
	}
	const double far = (double)by * m->h[d];
	m->lo[d] += far, f->lo[d] += far, f->hi[d] += far;
	for (size_t i = 0; i < f->nmeshes; i++)
		if (f->meshes[i] != m)
			f->meshes[i]->lo[d] += far;
	return 0;
}

/* Removes what is behind the window. */
static int leave(const struct pm_window *w, struct pm_frame *f, struct pm_set *set, struct pm_window_report *r)
{
	const struct pm_field *x = pm_frame_field(f, set->name, "x");
	unsigned char *keep = x && set->n ? pm_alloc(set->n, 1) : NULL;
	struct pm_strengths before, after;
	uint64_t n = 0;
	if (!x || !set->n)
		return 0;
	if (!keep)
		return -PM_DATA;
	for (size_t i = 0; i < set->n; i++)
		n += !(keep[i] = pm_in(x, w->axis)[i] >= f->lo[w->axis]);
	r->left += n;
	pm_strengths_of(f, set->name, &before);
	int status = n ? pm_frame_select(f, set, keep) : 0;
	pm_free(keep);
	if (status || !n)
		return status;
	pm_strengths_of(f, set->name, &after);
	for (int i = 0; i < before.n && r->behind.n < PM_STRENGTHS; i++) {
		const struct pm_strength *now = pm_strength_find(&after, set->name, before.of[i].name);
		r->behind.of[r->behind.n] = before.of[i];
		r->behind.of[r->behind.n++].sum -= now ? now->sum : 0;
	}
	return 0;
}

struct filling {
	const struct pm_window *w;
	const struct pm_frame *f;
	const struct pm_mesh *m;
	size_t cells[3], by;
	uint64_t column; /* of the first new cells, counted from where the window set out */
	struct pm_expression density;
	struct pm_density_names names;
};

/* Place k of those in the new cells, along the axes in turn. Its number among all that ever come in does not depend on how many cells come in at once. */
static uint64_t place(const struct filling *l, uint64_t k, double x[3])
{
	const int each = l->w->each;
	uint64_t number = 0, times = (uint64_t)each, front = 0;
	for (int d = 0; d < l->f->dim; d++) {
		const uint64_t along = l->cells[d] * (uint64_t)each, j = k % along;
		const double lo = d == l->w->axis ? l->f->hi[d] - (double)l->by * l->m->h[d] : l->m->lo[d];
		k /= along;
		x[d] = fmin(lo + ((double)j + 0.5) / each * l->m->h[d], nextafter(l->f->hi[d], l->f->lo[d]));
		if (d == l->w->axis) {
			front = l->column + j / (uint64_t)each;
			number += j % (uint64_t)each;
		} else {
			number += times * j;
			times *= along;
		}
	}
	return number + times * front;
}

static int fill(const struct filling *l, struct pm_frame *f, int set, struct pm_window_report *r)
{
	const struct pm_window *w = l->w;
	struct pm_newcomers a = newcomers(w, f, set);
	double cell = 1;
	uint64_t room = 1;
	for (int d = 0; d < f->dim; d++) {
		room *= l->cells[d] * (uint64_t)w->each;
		cell *= l->m->h[d] / w->each;
	}
	const uint64_t key = w->seed ^ (uint64_t)pm_crc32c(0, a.set, strlen(a.set)) << 20;
	int status = pm_newcomers_room(f, &a, room);
	for (uint64_t k = 0; k < room && !status; k++) {
		double number[64], u[2], x[3] = {0};
		const uint64_t which = place(l, k, x);
		memcpy(number, l->names.number, sizeof number);
		memcpy(number, x, sizeof x);
		const double density = w->density ? pm_expression_number(&l->density, number) : 1;
		if (!(density >= 0 && density < HUGE_VAL))
			status = pm_fail(PM_DATA, "the density '%s' is %g at (%g, %g, %g)", w->density, density, x[0], x[1], x[2]);
		if (status || density == 0)
			continue;
		for (int d = 0; d < f->dim; d++)
			a.x[d][a.n] = x[d];
		for (int d = 0; d < a.velocities; d++) {
			pm_random(key, which, (uint64_t)d, u);
			a.v[d][a.n] = w->vth[set] > 0 ? w->vth[set] * pm_scene_normal_of(u[0]) : 0;
		}
		a.m[a.n] = w->mass[set] * density * cell;
		a.q[a.n] = w->charge[set] * density * cell;
		r->given[0] += a.m[a.n], r->given[1] += a.q[a.n++];
	}
	r->came += a.n;
	status = status || !a.n ? status : pm_newcomers_append(&a, f);
	pm_newcomers_free(&a);
	return status;
}

int pm_window_step(const struct pm_window *w, struct pm_frame *f, struct pm_window_report *r)
{
	struct pm_mesh *m = pm_frame_mesh(f, w->mesh);
	struct filling l = {.w = w, .f = f, .m = m, .by = (size_t)shift(w, f, m), .column = (uint64_t)passed(w, f, m, f->step),
		.names = {.f = f, .variable = variable, .n = 3}};
	*r = (struct pm_window_report){.shifted = (double)l.by};
	memcpy(l.cells, m->cells, sizeof l.cells);
	l.cells[w->axis] = l.by;
	int status = w->density ? pm_expression_compile_numbers(&l.density, pm_density_name, &l.names, "number (of a place: x y z)", w->density) : 0;
	status = status ? status : move_box(w, f, m, l.by);
	for (size_t i = 0; i < f->nsets && !status; i++)
		status = leave(w, f, f->sets[i], r);
	for (int i = 0; i < w->sets && !status; i++)
		status = fill(&l, f, i, r);
	return status;
}
