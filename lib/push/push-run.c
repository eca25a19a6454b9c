/* The data part of a push of one set: rotates velocities about a magnetic field, then advances every component (state-advance.h).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "law/law.h"
#include "push/push-set.h"
#include "world/world.h"

/* Component c of a state with its rate and registers, for the loops. */
static struct pm_advanced line(const struct pm_moving *m, const struct pm_rate *r, int c)
{
	struct pm_advanced l = {.y = pm_out(r->state, c), .position = r->state == m->x};
	l.k = r->rate->use & (PM_USE_CHANGE | PM_USE_NEW) ? pm_out(r->rate, c) : pm_in(r->rate, c);
	for (int i = 0; i < PM_REGISTERS; i++)
		l.q[i] = r->q[i] ? pm_out(r->q[i], c) : NULL;
	return l;
}

/* The lines of component c; of: those of x and v (true), or all others. */
static int lines_of(const struct pm_moving *m, int c, bool motion, struct pm_advanced lines[PM_RATES])
{
	int n = 0;
	for (int r = 0; r < m->n; r++) {
		const struct pm_rate *rate = &m->rates[r];
		bool is_motion = rate->state == m->x || rate->state == m->v;
		if (m->turned && rate->state == m->v)
			continue; /* already rotated */
		if (is_motion == motion && c < pm_rate_components(rate))
			lines[n++] = line(m, rate, c);
	}
	return n;
}

static struct pm_bounds bounds_of(const struct pm_frame *f, int axis)
{
	return (struct pm_bounds){.lo = f->lo[axis], .hi = f->hi[axis], .fold = f->pface[axis][0] == PM_PFOLD,
		.mirror = {f->pface[axis][0] == PM_PREFLECT, f->pface[axis][1] == PM_PREFLECT}};
}

static double speed2(const struct pm_magnetic *a, size_t i)
{
	double v2 = 0;
	for (int c = 0; c < 3; c++)
		v2 += a->v[c] ? a->v[c][i] * a->v[c][i] : 0;
	return v2;
}

/* The first of the particles from..to-1 that is not slower than light; to: none. */
static size_t first_fast(const struct pm_magnetic *a, size_t from, size_t to)
{
	int any = 0;
	for (size_t i = from; i < to; i++)
		any |= !(speed2(a, i) < a->c * a->c);
	while (any && from < to && speed2(a, from) < a->c * a->c)
		from++;
	return any ? from : to;
}

/* Rotates the velocities about bfield and kicks them, all components of a particle together. */
static int turn(const struct pm_frame *f, const struct pm_moving *m, const struct pm_step *step)
{
	const struct pm_field *acc = pm_frame_field(f, m->set->name, "acc");
	struct pm_magnetic a = {.c = pm_law_constant(f, "c", NAN), .radiation_time = pm_frame_constant(f, "radiation_time", NAN)};
	size_t n = m->v->count, blocks = (n + PM_ADVANCE_BLOCK - 1) / PM_ADVANCE_BLOCK;
	if (m->b)
		a.charge = pm_in(m->charge, 0), a.mass = pm_in(m->mass, 0);
	for (int r = 0; r < m->n; r++)
		acc = m->rates[r].state == m->v ? m->rates[r].rate : acc;
	for (int c = 0; c < 3; c++) {
		a.v[c] = c < m->v->components ? pm_out(m->v, c) : NULL;
		a.acc[c] = c < acc->components ? pm_in(acc, c) : NULL;
		a.b[c] = m->b ? pm_in(m->b, c) : NULL;
	}
	for (size_t i = 0; i < n && m->b && !a.v[2]; i++)
		if (a.b[0][i] != 0 || a.b[1][i] != 0)
			return pm_world_place(0, 0, 0, m->v->first + i), pm_fail(PM_DATA, "'%s' has velocities of 2 components, and a magnetic field in "
				"the plane turns them out of it (give v 3 components)", m->set->name);
	size_t fast = n;
	int bad = 0;
#pragma omp parallel for schedule(static) reduction(min : fast) reduction(| : bad) if (n > 16384)
	for (size_t block = 0; block < blocks; block++) {
		const size_t i = block * PM_ADVANCE_BLOCK, end = n - i < PM_ADVANCE_BLOCK ? n : i + PM_ADVANCE_BLOCK;
		const size_t found = step->relativistic ? first_fast(&a, i, end) : end;
		if (found < end) {
			fast = found < fast ? found : fast;
			continue;
		}
		step->magnetic(m->closing, f->dt, i, end, &a);
		for (int c = 0; c < 3; c++)
			bad |= a.v[c] && !pm_finite_few(end - i, a.v[c] + i);
	}
	if (fast < n)
		return pm_world_place(1, 0, 0, m->v->first + fast), pm_fail(PM_DATA, "particle %zu of '%s' has the speed %.6g, and c is %.6g",
			(size_t)m->v->first + fast, m->set->name, sqrt(speed2(&a, fast)), a.c);
	m->v->use |= bad ? 0 : PM_USE_SEEN;
	return 0;
}

int pm_moving_run(const struct pm_frame *f, const struct pm_moving *m, const struct pm_push *p, const double *h, double *crossed)
{
	struct pm_advance a = p->actions;
	const size_t here = m->n ? m->rates[0].state->count : m->x->count; /* of a rank, where the frame is divided */
	bool finite = true;
	int status = p->magnetic ? turn(f, m, pm_moving_magnetic(f, p)) : 0;
	for (int t = 0; t < a.actions; t++)
		a.action[t].dt = f->dt * p->part[t];
	if (p->scheme) {
		int own = m->pass.registers - m->pass.step->registers; /* those that the requested scheme keeps come first */
		a.action[0].step = m->pass.step, a.action[0].pass = m->pass.pass;
		a.shift = m->pass.shift ? own : 0;
		a.registers = m->pass.step == p->scheme ? 0 : own;
	}
	for (int c = 0; c < PM_COMPONENTS && !status; c++) {
		struct pm_advanced lines[PM_RATES];
		struct pm_bounds b = bounds_of(f, c < f->dim ? c : 0);
		bool faces = p->moves && c < f->dim && c < m->x->components;
		int n = lines_of(m, c, true, lines);
		double *v = faces && m->v && c < m->v->components && (b.mirror[0] || b.mirror[1]) ? pm_out(m->v, c) : NULL;
		double fastest = 0;
		if (n)
			finite &= pm_advance_axis(here, &a, n, lines, faces ? pm_out(m->x, c) : NULL, v, &b, h && faces ? &fastest : NULL);
		if (h && faces)
			*crossed = fmax(*crossed, fastest * fabs(f->dt) / h[c]);
		n = lines_of(m, c, false, lines);
		if (n)
			finite &= pm_advance_axis(here, &a, n, lines, NULL, NULL, NULL, NULL);
	}
	for (int r = 0; r < m->n && finite; r++) /* if not finite, the library searches for the value */
		if (!m->turned || m->rates[r].state != m->v) {
			m->rates[r].state->use |= PM_USE_SEEN;
			for (int i = 0; i < PM_REGISTERS; i++)
				if (m->rates[r].q[i])
					m->rates[r].q[i]->use |= PM_USE_SEEN;
		}
	return status;
}
