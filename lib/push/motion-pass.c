/* The kick that closes a step is left, and the push that opens the next one makes it: for a few particles at a time their rates are gathered from the mesh,
 * velocities kicked twice and positions moved, in one loop (kick-drift.h) or by those of state-advance.c: the same bytes. Only where rates and velocities are
 * so far from overflow that what is left cannot fail. Cost: positions and velocities read and written once, 12 numbers of a particle in space, where m2p and
 * both words of push read and write 30; and a pass over the velocities where their largest is not known. SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "base/largest.h"
#include "push/kick-drift.h"
#include "push/motion-pass.h"
#include "stream/column.h"
#include "stream/later.h"
#include "transfer/rate-later.h"
#include "world/world.h"

struct motion_later {
	struct pm_later later; /* first member */
	struct pm_field *acc;
	struct pm_advance kick;
};

static void let_go(struct pm_later *later) { pm_held_free(((struct motion_later *)later)->acc); }

static int make(const struct pm_later *later, double *to)
{
	const struct motion_later *k = (const struct motion_later *)later;
	const size_t n = later->from->count;
	if (pm_held_bring(k->acc))
		return -PM_DATA;
	for (int c = 0; c < later->from->components; c++) {
		memcpy(to + (size_t)c * n, pm_in(later->from, c), n * sizeof *to);
		if (c < k->acc->components)
			pm_advance_axis(n, &k->kick, 1, &(struct pm_advanced){.y = to + (size_t)c * n, .k = pm_in(k->acc, c)}, NULL, NULL, NULL, NULL);
	}
	return 0;
}

/* A kick alone, or kicks and a drift, of positions and velocities on the axes of the box, and velocities across. */
static bool plain(const struct pm_frame *f, const struct pm_moving *m, const struct pm_push *p)
{
	bool yes = m->v && m->x->components == f->dim && m->v->components >= f->dim && m->v->components <= 3 && m->v->type == PM_F64 && m->x->type == PM_F64;
	yes = yes && p->later && pm_world_alone() && !p->scheme && !p->magnetic && m->n == (p->moves ? 2 : 1) && m->rates[m->n - 1].state == m->v &&
		m->rates[0].state == (p->moves ? m->x : m->v);
	for (int t = 0; t < p->actions.actions; t++)
		yes = yes && (p->actions.action[t].step->kind == PM_KICK || p->actions.action[t].step->kind == PM_DRIFT);
	return yes;
}

void pm_motion_declare(const struct pm_frame *f, struct pm_moving *m, const struct pm_push *p)
{
	bool can = plain(f, m, p);
	for (int d = 0; d < f->dim && p->moves && can; d++)
		can = f->pface[d][0] == PM_PFOLD && f->pface[d][1] == PM_PFOLD;
	if (!can)
		return;
	m->v->use |= PM_USE_LATER, m->rates[m->n - 1].rate->use |= PM_USE_LATER;
	if (p->moves || !(m->v->use & PM_USE_FROM_VALUE))
		(p->moves ? m->x : m->v)->use |= PM_USE_WAITS;
}

static int leave(const struct pm_moving *m, const struct pm_advance *a, const struct pm_field *acc)
{
	const struct pm_rate_left *l = pm_rate_left_of(acc);
	if (!l || pm_field_later_of(m->v))
		return 0;
	double speed = m->v->within > 0 ? m->v->within : 0;
	for (int c = 0; c < m->v->components && !(m->v->within > 0); c++)
		speed = fmax(speed, pm_largest(m->v->count, pm_in(m->v, c)));
	for (int t = 0; t < a->actions; t++)
		speed += fabs(a->action[t].dt) * pm_rate_left_most(l);
	if (!(speed < 1e100))
		return 0;
	struct motion_later *k = calloc(1, sizeof *k);
	if (!k)
		return pm_no_memory();
	*k = (struct motion_later){.later = {.make = make, .free = let_go}, .acc = pm_field_held(acc), .kick = *a};
	if (!k->acc)
		return pm_later_free(&k->later), -PM_DATA;
	const int status = pm_field_later(m->v, &k->later, m->v);
	return status ? status : 1;
}

/* ---- the pass ---- */

/* What a thread has seen: the bits of the largest |v| of each axis that moves. */
struct seen {
	int64_t most[7], bad;
};

struct passing {
	const struct pm_advance *close, *open; /* close: NULL, v has its kick */
	int dim, components, rates;            /* of x, v and acc */
	bool plain; /* they are one or two kicks and a drift: */
	struct pm_kick_drift step;
	struct pm_bounds box[3];
	struct seen *seen; /* [threads] a line of the cache each */
};

/* Axis c, one action after the other. */
static void by_actions(const struct passing *k, int c, size_t n, double *x, double *v, const double *rate, struct seen *s)
{
	const struct pm_advanced kicked = {.y = v, .k = rate};
	struct pm_advanced lines[2];
	int nlines = 0;
	if (c < k->dim)
		lines[nlines++] = (struct pm_advanced){.y = x, .k = v, .position = true};
	if (c < k->rates) {
		lines[nlines++] = kicked;
		if (k->close)
			s->bad |= !pm_advance_few(n, k->close, 1, &kicked, NULL, NULL, NULL);
	}
	s->bad |= !pm_advance_few(n, k->open, nlines, lines, x, &k->box[c], &s->most[c]);
}

static void few(void *data, size_t m, double *const x[3], double *const v[], const double *const rate[3])
{
	const struct passing *k = data;
	struct seen *s = &k->seen[omp_get_thread_num()];
	for (int c = 0; c < k->components; c++) {
		const bool moves = c < k->dim, kicked = c < k->rates;
		bool finite = true;
		const size_t done = k->plain && moves && kicked ? pm_kick_drift(m, &k->step, &k->box[c], rate[c], v[c], x[c], &s->most[c], &finite) : 0;
		s->bad |= !finite;
		if (done < m)
			by_actions(k, c, m - done, moves ? x[c] + done : NULL, v[c] + done, kicked ? rate[c] + done : NULL, s);
	}
}

static double speed_of(const struct seen *s, int threads, int c)
{
	double most = 0;
	for (int t = 0; t < threads; t++)
		most = fmax(most, pm_of_bits(s[t].most[c]));
	return most;
}

static bool all_finite(const struct seen *s, int threads)
{
	int64_t bad = 0;
	for (int t = 0; t < threads; t++)
		bad |= s[t].bad;
	return !bad;
}

static int pass(const struct pm_frame *f, const struct pm_moving *m, const struct pm_advance *a, const double *h, double *crossed)
{
	struct pm_field *acc = m->rates[1].rate;
	const struct pm_later *later = pm_field_later_of(m->v);
	struct motion_later *left = later ? (struct motion_later *)pm_field_later_alone(m->v) : NULL;
	const struct pm_rate_left *l = pm_rate_left_of(acc);
	if (!l || (later && (!left || left->later.make != make || pm_rate_left_of(left->acc) != l)) || !pm_rate_can_pass(l, f, m->x))
		return 0;
	const int threads = pm_threads();
	struct passing k = {.close = left ? &left->kick : NULL, .open = a, .dim = f->dim, .components = m->v->components, .rates = acc->components,
		.seen = pm_zalloc((size_t)threads, sizeof *k.seen)};
	struct pm_later *taken = k.seen && left ? pm_field_later_take(m->v) : NULL;
	k.plain = pm_kick_drift_is(k.close, k.open, &k.step);
	for (int d = 0; d < f->dim; d++)
		k.box[d] = (struct pm_bounds){.lo = f->lo[d], .hi = f->hi[d], .fold = true};
	struct pm_rate_beside v = {.n = k.components, .back = k.components};
	for (int c = 0; c < k.components && k.seen && (taken || !left); c++)
		v.of[c] = pm_out(m->v, c);
	const int status = k.seen && (taken || !left) ? pm_rate_pass(l, f, m->x, &v, few, &k) : -PM_DATA;
	if (!status) {
		double most = 0;
		for (int d = 0; d < f->dim; d++) {
			const double speed = speed_of(k.seen, threads, d);
			most = fmax(most, speed);
			*crossed = h ? fmax(*crossed, speed * fabs(f->dt) / h[d]) : *crossed;
		}
		m->v->within = f->dim == k.components ? most : 0; /* what does not move was not looked at */
		m->x->use |= all_finite(k.seen, threads) ? PM_USE_SEEN : 0, m->v->use |= all_finite(k.seen, threads) ? PM_USE_SEEN : 0;
	}
	if (taken)
		pm_later_free(taken);
	pm_free(k.seen);
	return status ? status : 1;
}

int pm_motion_pass(const struct pm_frame *f, const struct pm_moving *m, const struct pm_advance *a, const double *h, double *crossed)
{
	if (!m->v || !(m->v->use & PM_USE_LATER) || m->turned)
		return 0;
	struct pm_field *acc = m->rates[m->n - 1].rate;
	const int done = m->n == 1 ? leave(m, a, acc) : pass(f, m, a, h, crossed);
	if (done)
		return done;
	return pm_field_now(m->v) || pm_field_now(acc) || (m->x->use & PM_USE_WAITS && pm_field_now(m->x)) ? -PM_DATA : 0;
}
