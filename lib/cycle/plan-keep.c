/* Hysteresis of --again. Two plans bracket what is in force: a for the accuracy X, b for X/3. What a demands beyond it is done at once. What a could do without
 * is given up only where b could, too, in three decisions in a row; so a number has to stay below a third of the threshold that it had crossed. A step gets
 * shorter, and an interval of remeshing too, by a factor of at least 1.5, or to what a asks for if that is less; they get longer when b allows a factor of
 * 1.5, to the shortest that it allowed in the three. b is made only where a is cheaper in something. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "cycle/plan-again.h"
#include "planner/force-error.h"

static const double least = 1.5; /* factor by which a step or an interval changes */
enum { enough = 3 };               /* decisions in a row */
static const double slack = 0.9; /* a step is long enough for the accuracy if it is at most 1/0.9 of the one planned, as in plan */

static void copy(char to[32], const char *from) { snprintf(to, 32, "%s", from ? from : ""); }

void pm_replan_way_of(struct pm_replan_way *w, const struct pm_plan *p, const struct pm_frame *f)
{
	const struct pm_method *m = &p->method;
	*w = (struct pm_replan_way){.pairs = m->pairs, .grow = m->grow};
	copy(w->kernel, m->kernel), copy(w->symbol, m->symbol), copy(w->order, m->order), copy(w->scheme, m->scheme);
	for (int d = 0; d < 3 && f->nmeshes; d++)
		w->cells[d] = m->cells[0] && d < f->dim ? m->cells[d] : f->meshes[0]->cells[d];
	for (int i = 0; i < PM_EFFECTS; i++) {
		const struct pm_plan_effect *e = &p->effect[i];
		w->every[i] = i < p->neffects && e->decision.answer == PM_PUT_IN ? e->decision.every : -1;
	}
}

/* How much a force costs and resolves: pairs above every mesh, and then the number of cells. */
static double demand(const struct pm_replan_way *w)
{
	return w->pairs ? HUGE_VAL : fmax(1, (double)w->cells[0]) * fmax(1, (double)w->cells[1]) * fmax(1, (double)w->cells[2]);
}

static bool same_mesh(const struct pm_replan_way *a, const struct pm_replan_way *b)
{
	return a->pairs == b->pairs && (a->pairs || (demand(a) == demand(b) && !strcmp(a->kernel, b->kernel) && !strcmp(a->symbol, b->symbol) &&
		!strcmp(a->order, b->order)));
}

static double step_of(const struct pm_plan *p, const struct pm_frame *f) { return fabs(isnan(p->method.dt) ? f->dt : p->method.dt); }

bool pm_replan_needs_wary(const struct pm_replan_way *now, double dt, const struct pm_plan *a, const struct pm_frame *f)
{
	struct pm_replan_way w;
	pm_replan_way_of(&w, a, f);
	bool cheaper = !same_mesh(&w, now) || strcmp(w.scheme, now->scheme) || step_of(a, f) > least * dt;
	for (int i = 0; i < a->neffects; i++)
		cheaper = cheaper || (w.every[i] < 0 ? now->every[i] >= 0 : w.every[i] > least * now->every[i]);
	return cheaper;
}

/* Something can be given up: it is if that has been so for long enough. */
static bool give_up(struct pm_replan_patience *p)
{
	p->now = true;
	return p->decisions + 1 >= enough;
}

static void take_mesh(struct pm_plan *p, const struct pm_plan *from, const struct pm_replan_way *w)
{
	struct pm_method *m = &p->method;
	p->scales.pairs = m->pairs = w->pairs;
	memcpy(m->cells, w->cells, sizeof m->cells);
	if (from)
		m->kernel = from->method.kernel, m->symbol = from->method.symbol, m->order = from->method.order;
	else /* the words in force */
		m->kernel = w->kernel, m->symbol = *w->symbol ? w->symbol : NULL, m->order = w->order;
}

/* The error of the mesh in force for the force of this frame, by the atlas; NAN: not known. */
static double error_of(const struct pm_replan_way *now, const struct pm_plan *a)
{
	const struct pm_scales *s = &a->scales;
	const char *symbol = *now->symbol ? now->symbol : a->law->symbol, *scene = s->open && !s->periodic && !s->walls ? "clustered" : "smooth";
	const double cells = a->method.cells[0] ? (double)a->method.cells[0] / (double)now->cells[0] : 1;
	char solver[64] = "poisson-fft";
	if (strcmp(symbol, "spectral"))
		snprintf(solver, sizeof solver, "poisson-fft --symbol %s", symbol);
	if (a->method.pairs || now->pairs || isnan(s->mesh_error))
		return NAN;
	struct pm_scales there = *s;
	there.h *= cells, there.points /= pow(cells, s->dim);
	const struct pm_atlas_force row = {.scene = scene, .solver = solver, .kernel = now->kernel, .gradient = now->order};
	return pm_force_error(&there, &row, there.h / s->length, 1);
}

/* The mesh in force stays while it is as accurate as was asked for, or as a can be; and where a is coarser, while b is not, or not for long enough.
 * The length scale that asks for cells means nothing while the force of a wave passes through zero: the mesh stays. */
static void mesh(const struct pm_replan_way *now, struct pm_plan *a, const struct pm_replan_way *wa, const struct pm_plan *b, const struct pm_replan_way *wb,
	struct pm_replan_patience *patience)
{
	const struct pm_scales *s = &a->scales;
	const bool coarser = demand(wa) < demand(now), fits = error_of(now, a) <= fmax(s->mesh_error, pm_force_allowed(s));
	if (patience->weak || (fits && !coarser) || same_mesh(wa, now) || same_mesh(wb, now) || (coarser && (demand(wb) > demand(now) || !give_up(patience))))
		take_mesh(a, NULL, now);
	else
		take_mesh(a, coarser ? b : a, coarser ? wb : wa);
	a->method.grow |= now->grow;
}

/* The length of the step that is to be, and the scheme. */
static double step(const struct pm_replan_way *now, double dt, struct pm_plan *a, const struct pm_plan *b, const struct pm_frame *f,
	struct pm_replan_patience *patience)
{
	const bool own = !strcmp(a->method.scheme, now->scheme), wary = !strcmp(b->method.scheme, now->scheme);
	const double da = step_of(a, f), db = step_of(b, f);
	if (!own && !(wary && slack * dt <= db))
		return da;
	a->method.scheme = now->scheme;
	if (own && da < slack * dt)
		return fmin(da, dt / least);
	if (!own || !wary || da <= least * dt || db < least * dt)
		return dt;
	patience->dt = patience->dt > 0 ? fmin(patience->dt, db) : db;
	return give_up(patience) ? patience->dt : dt;
}

/* The interval of an effect; -1: out. */
static int interval(int now, int a, int b, struct pm_replan_patience *patience)
{
	if (a < 0)
		return now < 0 || (b < 0 && give_up(patience)) ? -1 : now;
	if (now <= 0 || a == 0)
		return a;
	if (a < now)
		return (int)fmax(1, fmin(a, floor(now / least)));
	return a > least * now && b >= least * now && give_up(patience) ? b : now;
}

static void add(char what[PM_REPLAN_WHY], const char *format, ...)
{
	size_t n = strlen(what);
	va_list list;
	n += n < PM_REPLAN_WHY ? (size_t)snprintf(what + n, PM_REPLAN_WHY - n, "%s", n ? "; " : "") : 0;
	va_start(list, format);
	if (n < PM_REPLAN_WHY)
		vsnprintf(what + n, PM_REPLAN_WHY - n, format, list);
	va_end(list);
}

static void effects(const struct pm_replan_way *now, struct pm_plan *a, const struct pm_replan_way *wb, char what[PM_REPLAN_WHY],
	struct pm_replan_patience *patience)
{
	for (int i = 0; i < a->neffects; i++) {
		struct pm_plan_effect *e = &a->effect[i];
		const int before = now->every[i], own = e->decision.answer == PM_PUT_IN ? e->decision.every : -1;
		const int to = interval(before, own, wb->every[i], patience);
		e->decision.answer = to >= 0 ? PM_PUT_IN : PM_LEFT_OUT;
		e->decision.every = to > 0 ? to : 0;
		e->lacking = to >= 0 && e->effect->word && !e->effect->words && !e->decision.error;
		if (to == before)
			continue;
		if (before < 0)
			add(what, "%s %s, %s", e->effect->name, e->lacking ? "is needed, but has no word yet" : e->effect->numerical || e->decision.error
				? "is above the accuracy" : "comes in", e->decision.text);
		else if (to < 0)
			add(what, "%s goes out, %s", e->effect->name, e->decision.text);
		else
			add(what, "%s every %d instead of %d steps", e->effect->name, to, before);
	}
}

static void name_mesh(const struct pm_replan_way *w, int dim, char text[128])
{
	int n = snprintf(text, 128, w->pairs ? "pairs" : "a mesh of %zu", w->cells[0]);
	for (int d = 1; d < dim && !w->pairs; d++)
		n += snprintf(text + n, 128 - (size_t)n, "x%zu", w->cells[d]);
	if (!w->pairs)
		snprintf(text + n, 128 - (size_t)n, " (%s, %s)", w->kernel, w->order);
}

bool pm_replan_keep(const struct pm_replan_way *now, double dt, struct pm_plan *a, const struct pm_plan *b, const struct pm_frame *f,
	struct pm_replan_patience *patience, char what[PM_REPLAN_WHY])
{
	struct pm_replan_way wa, wb, to;
	char old[128], new[128];
	what[0] = 0;
	patience->now = false;
	pm_replan_way_of(&wa, a, f);
	pm_replan_way_of(&wb, b ? b : a, f);
	if (!a->method.cells[0])
		memcpy(a->method.cells, wa.cells, sizeof wa.cells);
	mesh(now, a, &wa, b ? b : a, &wb, patience);
	const double length = step(now, dt, a, b ? b : a, f, patience);
	effects(now, a, &wb, what, patience);
	a->method.dt = a->scales.dt = length;
	patience->decisions = patience->now && patience->decisions + 1 < enough ? patience->decisions + 1 : 0;
	patience->dt = patience->decisions ? patience->dt : 0;
	pm_replan_way_of(&to, a, f);
	if (!same_mesh(now, &to)) {
		name_mesh(now, f->dim, old), name_mesh(&to, f->dim, new);
		add(what, "%s instead of %s", new, old);
	}
	if (strcmp(now->scheme, to.scheme))
		add(what, "%s instead of %s", to.scheme, now->scheme);
	if (length != dt)
		add(what, "dt %.3g instead of %.3g", length, dt);
	return *what;
}
