/* Tests a plan: each decision about an effect is reversed, both sentences are run for a few steps from the frame, and the difference is compared
 * with the accuracy. Velocities: |v - v'|/|v|, likewise strengths after one step, extrapolated to the time T of the run (times T/(n dt)); without
 * inertia displacements, |x - x'|/|x - x0|; for remeshing, which replaces the particles, the density on the mesh, extrapolated. Each effect
 * chooses one of these.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "measure/norms.h"
#include "planner/scales.h"
#include "planner/plan.h"
#include "stream/run.h"

/* ---- differences ---- */

static double size(const struct pm_field *f)
{
	double s = 0;
	for (int c = 0; c < f->components; c++)
		s += pm_sum_products(f->count, pm_in(f, c), pm_in(f, c));
	return s;
}

/* |a - b|/|b| of a field of every set that moves, in l2; differences up to floor are round-off. */
static double relative(const struct pm_frame *a, const struct pm_frame *b, const char *name, double floor)
{
	double d2 = 0, r2 = 0;
	for (size_t k = 0; k < b->nsets; k++) {
		struct pm_field *p = pm_frame_field(a, b->sets[k]->name, name), *q = pm_frame_field(b, b->sets[k]->name, name);
		if (!p || !q || !pm_set_moves(b, b->sets[k]) || p->count != q->count || !p->buffer || !q->buffer)
			continue;
		const double d = pm_norms_of(a, p, q, NULL, NULL).l2;
		d2 += d > floor ? (double)q->count * d * d : 0;
		r2 += size(q);
	}
	return d2 == 0 ? 0 : sqrt(d2 / r2);
}

/* The shortest distance in a periodic box. */
static double apart(const struct pm_frame *f, int d, double x, double y)
{
	const double side = f->hi[d] - f->lo[d], z = x - y;
	return f->pface[d][0] == PM_PFOLD ? z - side * floor(z / side + 0.5) : z;
}

/* |a - b|/|b - start| of the positions, in l2. */
static double displaced(const struct pm_frame *a, const struct pm_frame *b, const struct pm_frame *start)
{
	struct pm_sum d2 = {0, 0}, r2 = {0, 0};
	for (size_t k = 0; k < b->nsets; k++) {
		const char *set = b->sets[k]->name;
		const struct pm_field *p = pm_frame_field(a, set, "x"), *q = pm_frame_field(b, set, "x"), *o = pm_frame_field(start, set, "x");
		for (int d = 0; pm_set_moves(b, b->sets[k]) && d < b->dim; d++)
			for (size_t i = 0; p->count == q->count && i < q->count; i++) {
				pm_sum_add(&d2, pow(apart(start, d, pm_in(p, d)[i], pm_in(q, d)[i]), 2));
				pm_sum_add(&r2, pow(apart(start, d, pm_in(q, d)[i], pm_in(o, d)[i]), 2));
			}
	}
	return pm_sum_total(d2) == 0 ? 0 : sqrt(pm_sum_total(d2) / pm_sum_total(r2));
}

/* The value of a mesh field at a node of another mesh of the same spacing; NAN outside the field's mesh. */
static double at_node(const struct pm_mesh *m, const size_t points[3], const double *values, const struct pm_mesh *other, const size_t node[3])
{
	size_t place = 0;
	for (int d = 2; d >= 0; d--) {
		const double i = (double)node[d] + (points[d] > 1 ? floor((other->lo[d] - m->lo[d]) / m->h[d] + 0.5) : 0);
		if (i < 0 || i >= (double)points[d])
			return NAN;
		place = place * points[d] + (size_t)i;
	}
	return values[place];
}

/* Sums over the nodes of a of a^2 and of (a - b)^2; outside: only over nodes outside the mesh of b. */
static void node_sums(const struct pm_frame *x, const struct pm_frame *y, const char *density, struct pm_sum *square, struct pm_sum *difference, bool outside)
{
	const struct pm_mesh *m = x->meshes[0], *n = y->meshes[0];
	const double *a = pm_in(pm_frame_field(x, m->name, density), 0), *b = pm_in(pm_frame_field(y, n->name, density), 0);
	size_t mp[3], np[3], node[3];
	const size_t all = pm_mesh_points(x, m, mp);
	pm_mesh_points(y, n, np);
	for (size_t i = 0; i < all; i++) {
		node[0] = i % mp[0], node[1] = i / mp[0] % mp[1], node[2] = i / mp[0] / mp[1];
		const double other = at_node(n, np, b, m, node);
		pm_sum_add(square, a[i] * a[i]);
		if (!outside || isnan(other))
			pm_sum_add(difference, pow(a[i] - (isnan(other) ? 0 : other), 2));
	}
}

/* |a - b|/|b| of the densities on the mesh, which may have grown in one of the two runs. */
static double densities(const struct pm_frame *a, const struct pm_frame *b, const struct pm_plan *p)
{
	char words[80];
	snprintf(words, sizeof words, "p2m --kernel %s%s", p->method.kernel, p->method.grow ? " --outside grow" : "");
	struct pm_frame *x = pm_plan_prime(a, words), *y = x ? pm_plan_prime(b, words) : NULL;
	struct pm_sum square = {0, 0}, difference = {0, 0}, rest = {0, 0};
	if (y) {
		node_sums(y, x, p->law->density, &square, &difference, false);
		node_sums(x, y, p->law->density, &rest, &difference, true);
	}
	pm_frame_free(x), pm_frame_free(y);
	return y ? sqrt(pm_sum_total(difference) / pm_sum_total(square)) : NAN;
}

/* ---- the reversed decision ---- */

static void put(struct pm_plan *p, int i, bool in)
{
	struct pm_decision *d = &p->effect[i].decision;
	d->answer = in ? PM_PUT_IN : PM_LEFT_OUT;
	d->every = in && !d->every ? 1 : d->every;
}

/* Both runs compared must have the same particles. */
static void keep_particles(struct pm_plan *p)
{
	for (int i = 0; i < p->neffects; i++)
		if (p->effect[i].effect->replaces)
			put(p, i, false);
}

static bool is_in(const struct pm_plan *p, int i) { return p->effect[i].decision.answer == PM_PUT_IN && !p->effect[i].lacking; }

/* Can the reversed decision be written as a sentence? */
static bool reversible(const struct pm_frame *f, const struct pm_plan *p, int i)
{
	struct pm_effect_case c;
	if (!p->effect[i].effect->reversible)
		return false;
	pm_plan_case(f, p, i, &c);
	return p->effect[i].effect->reversible(&c);
}

/* Frame and sentence with the decision on one effect reversed. */
static int other(const struct pm_plan *p, int i, struct pm_frame *f, struct pm_plan *q)
{
	const struct pm_effect *e = p->effect[i].effect;
	struct pm_effect_case c;
	int status = 0;
	pm_plan_case(f, q, i, &c);
	if (e->reverse)
		status = e->reverse(&c, is_in(q, i), f, &q->method);
	status = status ? status : pm_frame_settle(f);
	return status ? status : pm_plan_compose(f, q);
}

static struct pm_frame *run_other(const struct pm_frame *f, const struct pm_plan *p, int i, int steps, struct pm_plan_timing *t)
{
	struct pm_frame *g = pm_plan_bare(f), *end = NULL;
	struct pm_plan q = *p;
	if (!g)
		return NULL;
	if (!t) /* the timed run is left unchanged */
		keep_particles(&q);
	put(&q, i, !is_in(p, i));
	if (!q.scales.second && !pm_plan_forced(&q))
		return g; /* without it nothing moves */
	if (!other(p, i, g, &q))
		end = t ? pm_plan_time(g, q.sentence, pm_plan_period(&q), steps, t) : pm_plan_run(g, q.sentence, steps);
	pm_frame_free(g);
	return end;
}

static void verdict(const struct pm_plan *p, const struct pm_plan_effect *e, struct pm_plan_proof *o)
{
	const bool in = e->decision.answer == PM_PUT_IN, matters = o->difference > p->scales.accuracy;
	o->wrong = isnan(o->difference) || (!in && matters) || (in && !e->decision.kept && o->difference < 0.1 * p->scales.accuracy);
	if (isnan(o->difference))
		o->verdict = "wrong: it cannot be compared";
	else if (o->wrong)
		o->verdict = matters ? "wrong: it matters" : "wrong: it is negligible";
	else
		o->verdict = matters ? "right" : !in ? "right: negligible" : e->decision.kept ? "small, and kept" : "small";
}

/* The difference between the reversed run, a, and the planned one, b; on: steps of the whole run over the steps tested. */
static double difference(const struct pm_frame *a, const struct pm_frame *b, const struct pm_frame *start, const struct pm_plan *p,
	const struct pm_effect_test *t, double on, const char *of)
{
	if (t->of == PM_TEST_DENSITY)
		return densities(a, b, p) * on;
	if (t->of == PM_TEST_STRENGTH || p->scales.second)
		return relative(a, b, of, t->of == PM_TEST_STRENGTH ? 0 : 1e-12 * p->scales.omega * p->scales.spacing) * on;
	return displaced(a, b, start) / (t->of == PM_TEST_WALK ? sqrt(on) : 1); /* a walk grows as the square root of time, the flow linearly */
}

static int prove(const struct pm_frame *f, const struct pm_plan *p, int i, int steps, struct pm_plan_proof *o)
{
	const struct pm_effect *e = p->effect[i].effect;
	struct pm_effect_test t = {.of = PM_TEST_MOTION, .steps = steps};
	struct pm_effect_case c;
	struct pm_plan base = *p;
	pm_plan_case(f, p, i, &c);
	if (e->test)
		e->test(&c, &t);
	if (!e->replaces)
		keep_particles(&base);
	const double on = p->scales.time / (t.steps * fabs(p->scales.dt)); /* the step of the plan */
	if (pm_plan_compose(f, &base))
		return -PM_DATA;
	struct pm_frame *b = pm_plan_run(f, base.sentence, t.steps), *a = b ? run_other(f, p, i, t.steps, NULL) : NULL;
	int status = a ? 0 : pm_failed();
	o->tried = true;
	o->of = t.of == PM_TEST_DENSITY ? p->law->density : t.of == PM_TEST_STRENGTH ? p->law->strength : p->scales.second ? "v" : "x";
	if (a)
		o->difference = difference(a, b, f, p, &t, on, o->of);
	pm_frame_free(a), pm_frame_free(b);
	if (!status)
		verdict(p, &p->effect[i], o);
	return status;
}

int pm_plan_check(const struct pm_frame *f, const struct pm_plan *p, int steps, struct pm_plan_proof proof[PM_EFFECTS])
{
	int status = 0;
	for (int i = 0; i < p->neffects && !status; i++) {
		proof[i] = (struct pm_plan_proof){.difference = NAN};
		if (reversible(f, p, i))
			status = prove(f, p, i, steps, &proof[i]);
	}
	return status;
}

int pm_plan_savings(const struct pm_frame *f, struct pm_plan *p)
{
	const int most = (int)fmin(1e4, pm_plan_steps(f, p));
	for (int i = 0; i < p->neffects; i++) {
		struct pm_plan_effect *e = &p->effect[i];
		struct pm_plan_timing t = {.blocks = 0};
		if (e->decision.answer == PM_PUT_IN || !reversible(f, p, i))
			continue;
		struct pm_frame *g = run_other(f, p, i, most, &t);
		if (!g)
			return pm_failed();
		pm_frame_free(g);
		if (t.blocks)
			e->saves = fmax(0, pm_plan_dearer(p, &t, &e->noise));
	}
	return 0;
}
