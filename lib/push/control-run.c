/* Error-controlled steps, the data and the decision (step-control.h). Cost per pass: the registers once through memory.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/particle-faces.h"
#include "push/decided-step.h"
#include "stream/declare.h"
#include "stream/frame-time.h"

/* Of all states: the largest error and the largest change in an iteration, over the rate; has rounding hidden an error? */
struct worst {
	double error, change;
	bool rounded;
};

/* One thing done to every component of every state. */
struct work {
	const struct pm_control *scheme;
	enum { BEGIN, CORRECT, PLACE, END, REJECT } what;
	int node;
	double dt, ratio;
	bool known;
};

/* What a set's "scheme" holds between two passes. */
struct memory {
	int known;     /* has an earlier step foretold the series? */
	int iteration; /* the one under way, from 1 */
	double change; /* of the one before: change over rate */
	double dt;     /* [time] the step for which the series was foretold */
	double rest;   /* [time] left out of the frame's time by rounding */
};

static double number(const json_t *scheme, const char *key)
{
	const double x = json_number_value(json_object_get(scheme, key));
	return isfinite(x) ? x : 0;
}

static struct memory recall(const struct pm_moving *m)
{
	const json_t *s = json_object_get(m->set->more, "scheme");
	return (struct memory){.known = number(s, "rates") > 0, .iteration = (int)fmin(fmax(number(s, "iteration"), 0), 100), .change = number(s, "change"),
		.dt = number(s, "dt"), .rest = number(s, "rest")};
}

/* All sets carry the same. */
static void remember(size_t n, struct pm_moving *moving, const struct pm_step *scheme, const struct memory *k, int node)
{
	for (size_t i = 0; i < n; i++) {
		struct pm_set *s = moving[i].set;
		json_t *j = json_pack("{s:s,s:f,s:i,s:f}", "name", scheme->name, "dt", k->dt, "rates", k->known, "rest", k->rest);
		if (node)
			json_object_update_new(j, json_pack("{s:i,s:f}", "iteration", k->iteration, "change", k->change));
		if (!s->more)
			s->more = json_object();
		json_object_set_new(s->more, "scheme", j);
		s->pass = node;
		s->drift = node ? scheme->control->at[node] : 1;
		s->kick = !node;
	}
}

static struct pm_control_line line_of(const struct pm_moving *m, const struct pm_rate *rate, int c)
{
	struct pm_control_line l = {.y = pm_out(rate->state, c), .y_start = pm_out(rate->q[PM_CONTROL_START], c), .y_rest = pm_out(rate->q[PM_CONTROL_REST], c),
		.k = pm_in(rate->rate, c), .k_start = pm_out(rate->q[PM_CONTROL_RATE], c)};
	for (int i = 0; i < PM_CONTROL_TERMS; i++) {
		l.series[i] = pm_out(rate->q[PM_CONTROL_SERIES + i], c);
		l.foretold[i] = pm_out(rate->q[PM_CONTROL_FORETOLD + i], c);
	}
	for (int r = 0; r < m->n && rate->state == m->v; r++)
		if (m->rates[r].state == m->x && c < m->x->components) {
			l.x = pm_out(m->x, c);
			l.x_start = pm_out(m->rates[r].q[PM_CONTROL_START], c);
			l.x_rest = pm_out(m->rates[r].q[PM_CONTROL_REST], c);
		}
	return l;
}

static struct pm_control_line from(const struct pm_control_line *l, size_t i)
{
	struct pm_control_line b = {.y = l->y + i, .y_start = l->y_start + i, .y_rest = l->y_rest + i, .k = l->k + i, .k_start = l->k_start + i};
	if (l->x)
		b.x = l->x + i, b.x_start = l->x_start + i, b.x_rest = l->x_rest + i;
	for (int k = 0; k < PM_CONTROL_TERMS; k++)
		b.series[k] = l->series[k] + i, b.foretold[k] = l->foretold[k] + i;
	return b;
}

static void block(const struct work *w, size_t n, const struct pm_control_line *l, struct pm_control_norms *norms)
{
	const struct pm_control *s = w->scheme;
	switch (w->what) {
	case BEGIN:
		s->begin(w->ratio, n, l);
		break;
	case CORRECT:
		s->correct(w->node, n, l, norms);
		break;
	case PLACE:
		s->place(w->node, w->dt, n, l);
		break;
	case END:
		s->end(w->dt, w->ratio, w->known, n, l);
		break;
	case REJECT:
		s->reject(w->ratio, n, l);
	}
}

/* Maxima do not depend on the order, nor on the threads. */
static struct pm_control_norms each(const struct work *w, size_t n, const struct pm_control_line *l)
{
	const size_t blocks = (n + PM_ADVANCE_BLOCK - 1) / PM_ADVANCE_BLOCK;
	double rate = 0, change = 0, term[PM_CONTROL_TERMS] = {0};
#pragma omp parallel for schedule(static) reduction(max : rate, change, term) if (n > 16384)
	for (size_t b = 0; b < blocks; b++) {
		const size_t i = b * PM_ADVANCE_BLOCK, m = n - i < PM_ADVANCE_BLOCK ? n - i : PM_ADVANCE_BLOCK;
		const struct pm_control_line part = from(l, i);
		struct pm_control_norms norms = {0, 0, {0}};
		block(w, m, &part, &norms);
		rate = fmax(rate, norms.rate), change = fmax(change, norms.change);
		for (int k = 0; k < PM_CONTROL_TERMS; k++)
			term[k] = fmax(term[k], norms.term[k]);
	}
	struct pm_control_norms norms = {.rate = rate, .change = change};
	memcpy(norms.term, term, sizeof term);
	return norms;
}

/* The terms of a resolved step fall. A last one that is larger than that before it, and small, is rounding, which no shorter step makes less: then the
 * last two that do fall say what it would be. */
static double error_of(const struct pm_control_norms *norms, double rounding, bool *rounded)
{
	const double *term = norms->term;
	const int last = PM_CONTROL_TERMS - 1;
	int k = last;
	if (!(norms->rate > 0))
		return 0;
	if (term[last] > term[last - 1] && term[last] < rounding * norms->rate)
		while (k > 1 && term[k] > 0.5 * term[k - 1])
			k--;
	*rounded = *rounded || k < last;
	return k < last ? term[k] * pow(term[k] / term[k - 1], last - k) / norms->rate : term[last] / norms->rate;
}

/* Over all states of all sets; the largest of their relative errors and changes. */
static struct worst all(const struct pm_frame *f, size_t n, const struct pm_moving *moving, const struct work *w)
{
	struct worst worst = {0, 0, false};
	for (size_t k = 0; k < n; k++) {
		const struct pm_moving *m = moving + k;
		for (int r = 0; r < m->n; r++) {
			const struct pm_rate *rate = &m->rates[r];
			struct pm_control_norms of = {0, 0, {0}};
			for (int c = 0; c < pm_rate_components(rate) && !(rate->state == m->x && m->v); c++) {
				const struct pm_control_line l = line_of(m, rate, c);
				const struct pm_control_norms one = each(w, rate->state->count, &l);
				of.rate = fmax(of.rate, one.rate), of.change = fmax(of.change, one.change);
				for (int t = 0; t < PM_CONTROL_TERMS; t++)
					of.term[t] = fmax(of.term[t], one.term[t]);
			}
			if (w->what == CORRECT) {
				double most[PM_CONTROL_TERMS + 2] = {of.rate, of.change};
				memcpy(most + 2, of.term, sizeof of.term);
				pm_decided_largest(rate->state, PM_CONTROL_TERMS + 2, most);
				of.rate = most[0], of.change = most[1];
				memcpy(of.term, most + 2, sizeof of.term);
			}
			worst.error = fmax(worst.error, error_of(&of, w->scheme->rounding, &worst.rounded));
			worst.change = of.rate > 0 ? fmax(worst.change, of.change / of.rate) : worst.change;
		}
		for (int a = 0; a < f->dim && a < m->x->components && (w->what == PLACE || w->what == END); a++)
			if (f->pface[a][0] == PM_PFOLD)
				pm_particle_faces_fold(m->x->count, f->lo[a], f->hi[a], pm_out(m->x, a));
	}
	return worst;
}

static void place(const struct pm_frame *f, size_t n, const struct pm_moving *moving, const struct pm_control *scheme, int node)
{
	const struct work w = {.scheme = scheme, .what = PLACE, .node = node, .dt = f->dt};
	all(f, n, moving, &w);
}

/* The step that the error allows: this one, if nothing limits it. */
static double allowed(const struct pm_push *p, double dt, double error, bool *least)
{
	const struct pm_control *c = p->scheme->control;
	if (p->tolerance <= 0 || error <= 0)
		return dt;
	double ratio = isfinite(error) ? pow(p->tolerance / error, 1 / c->power) : c->factor / 2;
	ratio = fmin(ratio, 1 / c->factor);
	*least = fabs(dt * ratio) < p->floor;
	return copysign(fmax(p->floor, fmin(p->most, fabs(dt) * ratio)), dt);
}

static void take_step(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_push *p, struct memory *k, const struct pm_controlled *done)
{
	const struct work w = {.scheme = p->scheme->control, .what = END, .dt = f->dt, .ratio = done->next / f->dt, .known = k->known};
	const double began = f->start, step = f->dt + k->rest;
	all(f, n, moving, &w);
	for (size_t i = 0; i < n; i++)
		for (int r = 0; r < moving[i].n; r++)
			for (int q = PM_CONTROL_KEPT; q < PM_REGISTERS; q++)
				pm_drops(f, moving[i].rates[r].q[q]);
	k->known = 1;
	k->dt = done->next;
	k->rest = p->tolerance > 0 ? step - ((began + step) - began) : 0;
	remember(n, moving, p->scheme, k, 0);
	pm_clock_close(f);
	if (p->tolerance <= 0) /* the time of steps of one length is exact */
		return;
	f->time = f->start = began + step;
	f->dt = done->next;
	pm_frame_since_renew(f);
}

/* At the last node. */
static int decide(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_push *p, struct memory *k, const struct worst *worst,
	struct pm_controlled *done)
{
	const struct pm_control *c = p->scheme->control;
	const bool stays = k->iteration > 2 && worst->change >= k->change && worst->change < c->rounding, most = k->iteration >= c->most_iterations;
	bool least = false; /* an error that is known to 10 % gives the step to 1.4 %: where that is far too short there is no need of more digits */
	const bool hopeless = worst->change < 0.1 * worst->error && fabs(allowed(p, f->dt, worst->error, &least)) < 0.9 * c->factor * fabs(f->dt);
	if (!(worst->change < c->converged || stays || most || hopeless)) {
		k->iteration++;
		k->change = worst->change;
		place(f, n, moving, c, 1);
		remember(n, moving, p->scheme, k, 1);
		pm_clock_close(f);
		return 0;
	}
	*done = (struct pm_controlled){.iterations = k->iteration, .dt = f->dt, .error = worst->error, .rounded = worst->rounded};
	done->next = allowed(p, f->dt, worst->error, &done->least);
	if (p->tolerance <= 0 && most && worst->change > 1e-6)
		return pm_fail(PM_NUMERICS, "%d iterations of %s do not converge with dt %g (a shorter dt, or --tolerance above 0)", k->iteration,
			p->scheme->name, f->dt);
	if (!(fabs(f->start + done->next - f->start) > 0))
		return pm_fail(PM_NUMERICS, "%s would need steps of %g at time %.9g: the rates are not smooth there (bodies that meet, a coarse mesh; a "
			"softening, push rk4, a larger --tolerance, or --min)", p->scheme->name, done->next, f->start);
	done->rejected = fabs(done->next) < c->factor * fabs(f->dt);
	done->completed = !done->rejected;
	done->unconverged = done->completed && most && worst->change > 1e3 * c->converged;
	if (done->completed) {
		take_step(f, n, moving, p, k, done);
		return 0;
	}
	const struct work w = {.scheme = c, .what = REJECT, .ratio = done->next / f->dt};
	all(f, n, moving, &w);
	pm_frame_dt_set(f, done->next);
	k->iteration = 1;
	k->change = 0;
	k->dt = f->dt;
	place(f, n, moving, c, 1);
	remember(n, moving, p->scheme, k, 1);
	pm_clock_close(f);
	return 0;
}

int pm_control_run(struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_push *p, struct pm_controlled *done)
{
	if (!p->scheme->control)
		return p->scheme->implicit ? pm_implicit_run(f, n, moving, p, done) : pm_embedded_run(f, n, moving, p, done);
	const struct pm_control *c = p->scheme->control;
	const int node = moving[0].pass.pass;
	struct memory k = recall(moving);
	struct work w = {.scheme = c, .what = node ? CORRECT : BEGIN, .node = node, .dt = f->dt, .ratio = 1};
	*done = (struct pm_controlled){0};
	if (!node) {
		bool whole = true;
		for (size_t i = 0; i < n; i++)
			whole = whole && moving[i].pass.known;
		k.known = k.known && whole && k.dt != 0 && fabs(f->dt / k.dt) <= 20; /* the choice of dt may be another's */
		w.ratio = k.known ? f->dt / k.dt : 0;
		k.iteration = 1, k.change = 0;
		k.dt = f->dt;
	}
	const struct worst worst = all(f, n, moving, &w);
	if (node == c->nodes - 1)
		return decide(f, n, moving, p, &k, &worst, done);
	place(f, n, moving, c, node + 1);
	remember(n, moving, p->scheme, &k, node + 1);
	pm_clock_close(f);
	return 0;
}
