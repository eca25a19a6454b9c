/* Positions that move by a flow, x' = vel, where m2p has left vel to be made (transfer/rate-later.h): of a few particles at a time it is gathered from the
 * mesh, and a scheme, or a drift, advances their registers and positions at once by the loops of state-advance.c: the same bytes. In a periodic box, and
 * with no more registers than go together with positions: not rk4 in space.
 * Cost: positions and registers read and written once, in the plane 2 + 2 numbers of a particle for each register, where m2p and push read and write 6 more.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>

#include "base/largest.h"
#include "push/flow-pass.h"
#include "transfer/rate-later.h"
#include "world/world.h"

static int registers_of(const struct pm_rate *r)
{
	int n = 0;
	while (n < PM_REGISTERS && r->q[n])
		n++;
	return n;
}

void pm_flow_declare(const struct pm_frame *f, struct pm_moving *m, const struct pm_push *p)
{
	const struct pm_rate *r = &m->rates[0];
	bool can = p->later && p->moves && !p->magnetic && pm_world_alone() && m->n == 1 && r->state == m->x && r->rate->role == PM_CHANGE;
	can = can && m->x->type == PM_F64 && r->rate->type == PM_F64 && m->x->components == f->dim && r->rate->components == f->dim;
	can = can && !(p->scheme && pm_step_decides(p->scheme));
	for (int d = 0; d < f->dim && can; d++)
		can = f->pface[d][0] == PM_PFOLD && f->pface[d][1] == PM_PFOLD;
	if (can)
		r->rate->use |= PM_USE_LATER, m->x->use |= PM_USE_WAITS;
}

/* What a thread has seen: the bits of the largest |vel| of each axis. */
struct seen {
	int64_t most[7], bad;
};

struct passing {
	const struct pm_advance *advance;
	int dim, registers;
	struct pm_bounds box[3];
	struct seen *seen; /* [threads] a line of the cache each */
};

_Static_assert((int)PM_RATE_FEW <= (int)PM_ADVANCE_BLOCK, "pm_advance_few");

static void few(void *data, size_t m, double *const x[3], double *const q[], const double *const rate[3])
{
	const struct passing *k = data;
	struct seen *s = &k->seen[omp_get_thread_num()];
	for (int d = 0; d < k->dim; d++) {
		struct pm_advanced line = {.y = x[d], .k = rate[d], .position = true};
		for (int i = 0; i < k->registers; i++)
			line.q[i] = q[i * k->dim + d];
		s->bad |= !pm_advance_few(m, k->advance, 1, &line, x[d], &k->box[d], &s->most[d]);
	}
}

static int pass(const struct pm_frame *f, const struct pm_moving *m, const struct pm_rate_left *l, const struct pm_advance *a, const double *h, double *crossed)
{
	const struct pm_rate *r = &m->rates[0];
	const int threads = pm_threads();
	struct passing k = {.advance = a, .dim = f->dim, .registers = registers_of(r), .seen = pm_zalloc((size_t)threads, sizeof *k.seen)};
	struct pm_rate_beside beside = {.n = k.dim * k.registers, .back = k.dim * (m->pass.kept < k.registers ? m->pass.kept : k.registers)};
	for (int d = 0; d < k.dim; d++)
		k.box[d] = (struct pm_bounds){.lo = f->lo[d], .hi = f->hi[d], .fold = true};
	for (int c = 0; c < beside.n; c++)
		beside.of[c] = pm_out(r->q[c / k.dim], c % k.dim);
	const int status = k.seen ? pm_rate_pass(l, f, m->x, &beside, few, &k) : -PM_DATA;
	int64_t bad = 0;
	for (int t = 0; t < threads && !status; t++) {
		bad |= k.seen[t].bad;
		for (int d = 0; d < k.dim && h; d++)
			*crossed = fmax(*crossed, pm_of_bits(k.seen[t].most[d]) * fabs(f->dt) / h[d]);
	}
	m->x->use |= status || bad ? 0 : PM_USE_SEEN;
	for (int i = 0; i < k.registers && !status && !bad; i++)
		r->q[i]->use |= PM_USE_SEEN;
	pm_free(k.seen);
	return status ? status : 1;
}

int pm_flow_pass(const struct pm_frame *f, const struct pm_moving *m, const struct pm_advance *a, const double *h, double *crossed)
{
	if (m->n != 1 || m->rates[0].state != m->x || !(m->x->use & PM_USE_WAITS))
		return 0;
	const struct pm_rate_left *l = pm_rate_left_of(m->rates[0].rate);
	if (l && f->dim * (1 + registers_of(&m->rates[0])) <= PM_TILE_RUNS_MOST && pm_rate_can_pass(l, f, m->x))
		return pass(f, m, l, a, h, crossed);
	return pm_field_now(m->rates[0].rate) || pm_field_now(m->x) ? -PM_DATA : 0; /* who holds x is given up first */
}
