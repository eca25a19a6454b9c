/* The data part of a push of one set: rotates velocities about a magnetic field, then advances every component (state-advance.h).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "law/law.h"
#include "push/flow-pass.h"
#include "push/kick-later.h"
#include "push/motion-pass.h"
#include "push/push-set.h"
#include "stream/column.h"
#include "world/world.h"

/* Component c of a state with its rate and registers, for the loops. */
static struct pm_advanced line(const struct pm_moving *m, const struct pm_rate *r, int c)
{
	struct pm_advanced l = {.position = r->state == m->x, .y_floats = pm_column_floats(r->state, c), .k_floats = pm_column_floats(r->rate, c)};
	l.y = l.y_floats ? NULL : pm_out(r->state, c);
	l.k = l.k_floats ? NULL : r->rate->use & (PM_USE_CHANGE | PM_USE_NEW) ? pm_out(r->rate, c) : pm_in(r->rate, c);
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

/* Where the positions, and the velocities that a mirror changes, of an axis are. */
static void moved_of(const struct pm_moving *m, int c, struct pm_bounds *b, double **x, double **v)
{
	const bool turns = m->v && c < m->v->components && (b->mirror[0] || b->mirror[1]);
	b->x_floats = pm_column_floats(m->x, c);
	b->v_floats = turns ? pm_column_floats(m->v, c) : NULL;
	*x = b->x_floats ? NULL : pm_out(m->x, c);
	*v = turns && !b->v_floats ? pm_out(m->v, c) : NULL;
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

static double speed2_of(const struct pm_field *v, size_t i)
{
	double v2 = 0;
	for (int c = 0; c < v->components; c++)
		v2 += pm_in(v, c)[i] * pm_in(v, c)[i];
	return v2;
}

/* Velocities that are held as floats, and what turns them. */
struct columns {
	float *v[3];
	bool acc[3], b;
	struct pm_column of[8]; /* acc, B, charge, mass */
};

static struct columns columns_of(const struct pm_moving *m, const struct pm_field *acc)
{
	struct columns w = {.b = m->b};
	for (int c = 0; c < 3; c++) {
		w.v[c] = c < m->v->components ? pm_column_floats(m->v, c) : NULL;
		if ((w.acc[c] = c < acc->components))
			w.of[c] = pm_column_of(acc, c);
		if (m->b)
			w.of[3 + c] = pm_column_of(m->b, c);
	}
	if (m->b)
		w.of[6] = pm_column_of(m->charge, 0), w.of[7] = pm_column_of(m->mass, 0);
	return w;
}

/* Particles from..end-1, a few at a time as doubles; the first that is not slower than light, and end: none. */
static size_t turn_floats(const struct columns *w, size_t from, size_t end, bool closing, double dt, const struct pm_step *step, const struct pm_magnetic *as)
{
	enum { few = 256 }; /* 11 arrays of them stay in the first cache */
	for (size_t p = from; p < end; p += few) {
		const size_t m = end - p < few ? end - p : few;
		double v[3][few], room[8][few];
		struct pm_magnetic a = *as;
		for (int c = 0; c < 3; c++) {
			for (size_t i = 0; i < m && w->v[c]; i++)
				v[c][i] = w->v[c][p + i];
			a.v[c] = w->v[c] ? v[c] : NULL;
			a.acc[c] = w->acc[c] ? pm_column_take(&w->of[c], p, m, room[c]) : NULL;
			a.b[c] = w->b ? pm_column_take(&w->of[3 + c], p, m, room[3 + c]) : NULL;
		}
		a.charge = w->b ? pm_column_take(&w->of[6], p, m, room[6]) : NULL;
		a.mass = w->b ? pm_column_take(&w->of[7], p, m, room[7]) : NULL;
		const size_t fast = step->relativistic ? first_fast(&a, 0, m) : m;
		if (fast < m)
			return p + fast;
		step->magnetic(closing, dt, 0, m, &a);
		for (int c = 0; c < 3; c++)
			for (size_t i = 0; i < m && w->v[c]; i++)
				w->v[c][p + i] = (float)v[c][i];
	}
	return end;
}

/* Charge and mass as columns, one[] holding those that are one number for all, block after block. */
static void strengths_of(const struct pm_moving *m, double one[2][PM_ADVANCE_BLOCK], struct pm_column strength[2])
{
	strength[0] = pm_column_of(m->charge, 0), strength[1] = pm_column_of(m->mass, 0);
	for (int k = 0; k < 2; k++)
		for (size_t i = 0; i < PM_ADVANCE_BLOCK && !strength[k].doubles; i++)
			one[k][i] = strength[k].value;
}

/* The particles from p on, at most a block; strength: NULL or charge and mass. */
static struct pm_magnetic piece_of(const struct pm_magnetic *all, size_t p, const struct pm_column *strength, double one[2][PM_ADVANCE_BLOCK])
{
	struct pm_magnetic a = *all;
	for (int c = 0; c < 3; c++) {
		a.v[c] = all->v[c] ? all->v[c] + p : NULL;
		a.acc[c] = all->acc[c] ? all->acc[c] + p : NULL;
		a.b[c] = all->b[c] ? all->b[c] + p : NULL;
	}
	if (strength) {
		a.charge = strength[0].doubles ? strength[0].doubles + p : one[0];
		a.mass = strength[1].doubles ? strength[1].doubles + p : one[1];
		a.alike = !strength[0].doubles && !strength[1].doubles;
	}
	return a;
}

/* Rotates the velocities about bfield and kicks them, all components of a particle together. */
static int turn(const struct pm_frame *f, const struct pm_moving *m, const struct pm_step *step)
{
	struct pm_field *acc = pm_frame_field(f, m->set->name, "acc");
	struct columns w = {.v = {NULL}};
	double one[2][PM_ADVANCE_BLOCK];
	struct pm_column strength[2] = {{.value = 0}, {.value = 0}};
	struct pm_magnetic a = {.c = pm_law_constant(f, "c", NAN), .radiation_time = pm_frame_constant(f, "radiation_time", NAN)};
	size_t n = m->v->count, blocks = (n + PM_ADVANCE_BLOCK - 1) / PM_ADVANCE_BLOCK;
	const bool floats = pm_column_floats(m->v, 0), plane = m->b && m->v->components < 3;
	const double *across[2] = {plane ? pm_in(m->b, 0) : NULL, plane ? pm_in(m->b, 1) : NULL};
	for (int r = 0; r < m->n; r++)
		acc = m->rates[r].state == m->v ? m->rates[r].rate : acc;
	const int left = pm_kick_leave(f, m, step, acc);
	if (left)
		return left < 0 ? left : 0;
	if (floats)
		w = columns_of(m, acc);
	else if (m->b)
		strengths_of(m, one, strength);
	for (int c = 0; c < 3 && !floats; c++) {
		a.v[c] = c < m->v->components ? pm_out(m->v, c) : NULL;
		a.acc[c] = c < acc->components ? pm_in(acc, c) : NULL;
		a.b[c] = m->b ? pm_in(m->b, c) : NULL;
	}
	for (size_t i = 0; i < n && plane; i++)
		if (across[0][i] != 0 || across[1][i] != 0)
			return pm_world_place(0, 0, 0, m->v->first + i), pm_fail(PM_DATA, "'%s' has velocities of 2 components, and a magnetic field in "
				"the plane turns them out of it (give v 3 components)", m->set->name);
	size_t fast = n;
	int bad = floats; /* what is stored is checked later, rounded */
#pragma omp parallel for schedule(static) reduction(min : fast) reduction(| : bad) if (n > pm_many_turns() / 4)
	for (size_t block = 0; block < blocks; block++) {
		const size_t i = block * PM_ADVANCE_BLOCK, end = n - i < PM_ADVANCE_BLOCK ? n : i + PM_ADVANCE_BLOCK;
		if (floats) {
			const size_t found = turn_floats(&w, i, end, m->closing, f->dt, step, &a);
			fast = found < end && found < fast ? found : fast;
			continue;
		}
		const size_t found = step->relativistic ? first_fast(&a, i, end) : end;
		if (found < end) {
			fast = found < fast ? found : fast;
			continue;
		}
		const struct pm_magnetic here = piece_of(&a, i, m->b ? strength : NULL, one);
		step->magnetic(m->closing, f->dt, 0, end - i, &here);
		for (int c = 0; c < 3 && m->v->type == PM_F32; c++) /* before a drift uses it, as where it is held as floats */
			for (size_t p = i; p < end && a.v[c]; p++)
				a.v[c][p] = (float)a.v[c][p];
		for (int c = 0; c < 3; c++)
			bad |= a.v[c] && !pm_finite_few(end - i, a.v[c] + i);
	}
	if (fast < n)
		return pm_world_place(1, 0, 0, m->v->first + fast), pm_fail(PM_DATA, "particle %zu of '%s' has the speed %.6g, and c is %.6g "
			"(slower ones, or smod --constant c=C)", (size_t)m->v->first + fast, m->set->name,
			sqrt(floats ? speed2_of(m->v, fast) : speed2(&a, fast)), a.c);
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
	int passed = status || p->scheme ? 0 : pm_motion_pass(f, m, &a, h, crossed);
	passed = status || passed ? passed : pm_flow_pass(f, m, &a, h, crossed);
	if (passed)
		return passed < 0 ? passed : 0;
	for (int c = 0; c < PM_COMPONENTS && !status; c++) {
		struct pm_advanced lines[PM_RATES];
		struct pm_bounds b = bounds_of(f, c < f->dim ? c : 0);
		bool faces = p->moves && c < f->dim && c < m->x->components;
		int n = lines_of(m, c, true, lines);
		double *x = NULL, *v = NULL, fastest = 0;
		if (faces)
			moved_of(m, c, &b, &x, &v);
		if (n)
			finite &= pm_advance_axis(here, &a, n, lines, x, v, &b, h && faces ? &fastest : NULL);
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
