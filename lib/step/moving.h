/* One set in one push: the fields it reads, changes, makes and drops (header), and the run through the data.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STEP_MOVING_H
#define PM_STEP_MOVING_H

#include <stdlib.h>

#include "step/advance.h"
#include "step/done.h"
#include "stream/declare.h"

/* What is asked of every set. */
struct pm_push {
	struct pm_advance actions;
	double part[PM_ADVANCE_ACTIONS]; /* of dt, for each action */
	double kick, drift;              /* sums of the parts */
	const struct pm_step *scheme;    /* NULL: kicks and drifts */
	const struct pm_step *magnetic;  /* the kick that turns v about bfield; NULL none */
	bool open, moves, unsafe;        /* a kick is still to come after the drift; positions change; any step length */
};

struct pm_moving {
	struct pm_set *set;
	struct pm_field *x, *v; /* v NULL: none, or nobody changes it */
	struct pm_field *b, *charge, *mass; /* of a magnetic kick */
	bool closing;           /* the drift is done */
	int n;
	struct pm_rate rates[PM_RATES];
	struct pm_pass pass;
};

static inline bool pm_moving_face(const struct pm_frame *f, enum pm_particle_face face)
{
	for (int a = 0; a < f->dim; a++)
		if (f->pface[a][0] == face || f->pface[a][1] == face)
			return true;
	return false;
}

static inline int pm_moving_components(const struct pm_rate *r)
{
	return r->rate->components < r->state->components ? r->rate->components : r->state->components;
}

static inline int pm_moving_register(struct pm_frame *f, struct pm_moving *m, struct pm_rate *rate, int i)
{
	char name[PM_NAME];
	pm_register_name(name, i, rate->state->name);
	const struct pm_field *there = pm_frame_field(f, m->set->name, name);
	bool known = i < m->pass.known;
	if (known && !there)
		return pm_fail(PM_DATA, "no register '%s' on '%s' after %d passes of %s (it is lost; start the step anew from a frame at substep 0)",
			name, m->set->name, m->pass.pass, m->pass.step->name);
	if (there && there->role != PM_REGISTER)
		return pm_fail(PM_DATA, "'%s' on '%s' is in the way of the register of %s (rename it)", name, m->set->name, m->pass.step->name);
	rate->q[i] = known ? pm_changes(f, m->set->name, name) : pm_makes(f, m->set->name, name, pm_moving_components(rate), PM_REGISTER);
	if (rate->q[i] && rate->q[i]->components != pm_moving_components(rate))
		return pm_fail(PM_DATA, "the register '%s' on '%s' has %d components, its rate %d", name, m->set->name, rate->q[i]->components,
			pm_moving_components(rate));
	return rate->q[i] ? 0 : -PM_DATA;
}

/* Registers of the set that this pass leaves behind: all but the first `kept` of each rate. */
static inline void pm_moving_forget(struct pm_frame *f, const struct pm_moving *m, int kept)
{
	for (size_t i = f->nfields; i-- > 0;) {
		struct pm_field *q = f->fields[i];
		bool keep = q->role != PM_REGISTER || strcmp(q->on, m->set->name);
		for (int r = 0; r < m->n && !keep; r++)
			for (int k = 0; k < kept && !keep; k++)
				keep = m->rates[r].q[k] == q;
		if (!keep)
			pm_drops(f, q);
	}
}

/* Where particles may be absorbed every field that stays is rewritten, shorter. */
static inline int pm_moving_shrinks(struct pm_frame *f, const struct pm_moving *m)
{
	for (size_t i = 0, n = f->nfields; i < n; i++) {
		struct pm_field *field = f->fields[i]; /* pm_changes moves a field to the end: look at the same place again */
		if (strcmp(field->on, m->set->name) || field->uniform || field->use & (PM_USE_CHANGE | PM_USE_NEW))
			continue;
		if (!pm_changes(f, field->on, field->name))
			return -PM_DATA;
		i--, n--;
	}
	return 0;
}

static inline int pm_moving_fields(struct pm_frame *f, struct pm_moving *m, const struct pm_push *p)
{
	for (int r = 0; r < m->n; r++) {
		if (!pm_changes(f, m->set->name, m->rates[r].state->name))
			return -PM_DATA;
		m->rates[r].rate->use |= PM_USE_READ;
	}
	if (m->v && p->moves && pm_moving_face(f, PM_PREFLECT) && !pm_changes(f, m->set->name, "v"))
		return -PM_DATA;
	for (int r = 0; r < m->n && p->scheme; r++)
		for (int i = 0; i < m->pass.registers; i++)
			if (pm_moving_register(f, m, &m->rates[r], i))
				return -PM_DATA;
	pm_moving_forget(f, m, p->scheme ? m->pass.kept : 0);
	if (p->moves)
		pm_drops_roles(f, m->set->name, 1u << PM_CHANGE | 1u << PM_DERIVED);
	return p->moves && pm_moving_face(f, PM_PABSORB) ? pm_moving_shrinks(f, m) : 0;
}

/* What a magnetic kick reads besides acc. */
static inline int pm_moving_magnetic(struct pm_frame *f, struct pm_moving *m)
{
	const char *on = m->set->name;
	m->closing = m->set->drift > 0;
	if (!m->v || m->v->components < 2 || m->v->components > 3)
		return pm_fail(PM_DATA, "boris turns velocities of 2 or 3 components, and '%s' has %d (pinit --velocities 3, or push kick/2 without a magnetic "
			"field)", on, m->v ? m->v->components : 0);
	if (!pm_frame_field(f, on, "bfield"))
		return pm_fail(PM_MISSING, "no field 'bfield' on '%s' (m2p makes it of a B on the mesh; without a magnetic field: push kick/2)", on);
	if (pm_frame_field(f, on, "bfield")->components != 3)
		return pm_fail(PM_DATA, "'bfield' on '%s' has %d components, not 3", on, pm_frame_field(f, on, "bfield")->components);
	if (!pm_frame_field(f, on, "charge") || !pm_frame_field(f, on, "mass"))
		return pm_fail(PM_DATA, "no field '%s' on '%s', which the magnetic force needs (add it with stab --strength)",
			pm_frame_field(f, on, "charge") ? "mass" : "charge", on);
	m->b = pm_reads(f, on, "bfield");
	m->charge = m->b ? pm_reads(f, on, "charge") : NULL;
	m->mass = m->charge ? pm_reads(f, on, "mass") : NULL;
	return m->mass ? 0 : -PM_DATA;
}

/* The header's part: refuses what cannot be, moves the set's clock on, declares the fields. */
static inline int pm_moving_plan(struct pm_frame *f, struct pm_set *set, const struct pm_push *p, struct pm_moving *m)
{
	enum pm_step_kind kind = p->scheme || (p->kick > 0 && p->drift > 0) ? PM_SCHEME : p->kick > 0 ? PM_KICK : PM_DRIFT;
	int status = pm_done_allows(set, p->scheme, p->kick, p->drift);
	*m = (struct pm_moving){.set = set, .x = pm_frame_field(f, set->name, "x"), .v = pm_frame_field(f, set->name, "v")};
	if (!pm_rate_is_state(m->v))
		m->v = NULL;
	if (!status && p->magnetic)
		status = pm_moving_magnetic(f, m);
	if (!status && kind != PM_DRIFT)
		status = pm_rates_allowed(f, set, p->magnetic ? NULL : p->scheme ? p->scheme->name : "a plain kick");
	if (!status)
		status = pm_rates_complete(f, set);
	if (!status)
		status = m->n = pm_rates(f, set, kind, m->rates);
	if (status >= 0 && kind != PM_DRIFT && !p->unsafe)
		status = pm_rates_stable(f, m->rates, m->n, p->scheme);
	if (status >= 0)
		status = p->scheme ? pm_done_pass(f, set, p->scheme, m->n, m->rates, &m->pass) : pm_done_add(set, p->kick, p->drift, p->open);
	return status < 0 ? status : pm_moving_fields(f, m, p);
}

/* Component c of a rate as a line of the loops. */
static inline struct pm_advanced pm_moving_line(const struct pm_moving *m, const struct pm_rate *r, int c)
{
	struct pm_advanced l = {.y = pm_out(r->state, c), .position = r->state == m->x};
	l.k = r->rate->use & (PM_USE_CHANGE | PM_USE_NEW) ? pm_out(r->rate, c) : pm_in(r->rate, c);
	for (int i = 0; i < PM_REGISTERS; i++)
		l.q[i] = r->q[i] ? pm_out(r->q[i], c) : NULL;
	return l;
}

/* The lines of component c; of: those of x and v (true), or all others. */
static inline int pm_moving_lines(const struct pm_moving *m, int c, bool motion, struct pm_advanced lines[PM_RATES])
{
	int n = 0;
	for (int r = 0; r < m->n; r++) {
		const struct pm_rate *rate = &m->rates[r];
		bool is_motion = rate->state == m->x || rate->state == m->v;
		if (m->b && rate->state == m->v)
			continue; /* turned before */
		if (is_motion == motion && c < pm_moving_components(rate))
			lines[n++] = pm_moving_line(m, rate, c);
	}
	return n;
}

static inline struct pm_bounds pm_moving_bounds(const struct pm_frame *f, int axis)
{
	return (struct pm_bounds){.lo = f->lo[axis], .hi = f->hi[axis], .fold = f->pface[axis][0] == PM_PFOLD,
		.mirror = {f->pface[axis][0] == PM_PREFLECT, f->pface[axis][1] == PM_PREFLECT}};
}

/* Turns and kicks the velocities about bfield, all components of a particle together. */
static inline int pm_moving_turn(const struct pm_frame *f, const struct pm_moving *m, const struct pm_step *step)
{
	const struct pm_field *acc = pm_frame_field(f, m->set->name, "acc");
	struct pm_magnetic a = {.charge = pm_in(m->charge, 0), .mass = pm_in(m->mass, 0)};
	size_t n = m->set->n, blocks = (n + PM_ADVANCE_BLOCK - 1) / PM_ADVANCE_BLOCK;
	for (int r = 0; r < m->n; r++)
		acc = m->rates[r].state == m->v ? m->rates[r].rate : acc;
	for (int c = 0; c < 3; c++) {
		a.v[c] = c < m->v->components ? pm_out(m->v, c) : NULL;
		a.acc[c] = c < acc->components ? pm_in(acc, c) : NULL;
		a.b[c] = pm_in(m->b, c);
	}
	for (size_t i = 0; i < n && !a.v[2]; i++)
		if (a.b[0][i] != 0 || a.b[1][i] != 0)
			return pm_fail(PM_DATA, "'%s' has velocities of 2 components, and a magnetic field in the plane turns them out of it (give v 3 components)",
				m->set->name);
#pragma omp parallel for schedule(static) if (n > 16384)
	for (size_t block = 0; block < blocks; block++) {
		size_t i = block * PM_ADVANCE_BLOCK;
		step->magnetic(m->closing, f->dt, i, n - i < PM_ADVANCE_BLOCK ? n : i + PM_ADVANCE_BLOCK, &a);
	}
	return 0;
}

/* The data's part, but for absorption. */
static inline int pm_moving_run(const struct pm_frame *f, const struct pm_moving *m, const struct pm_push *p)
{
	struct pm_advance a = p->actions;
	bool finite = true;
	int status = p->magnetic ? pm_moving_turn(f, m, p->magnetic) : 0;
	for (int t = 0; t < a.actions; t++)
		a.action[t].dt = f->dt * p->part[t];
	if (p->scheme) {
		int own = m->pass.registers - m->pass.step->registers; /* those the asked scheme keeps come first */
		a.action[0].step = m->pass.step, a.action[0].pass = m->pass.pass;
		a.shift = m->pass.shift ? own : 0;
		a.registers = m->pass.step == p->scheme ? 0 : own;
	}
	for (int c = 0; c < PM_COMPONENTS && !status; c++) {
		struct pm_advanced lines[PM_RATES];
		struct pm_bounds b = pm_moving_bounds(f, c < f->dim ? c : 0);
		bool faces = p->moves && c < f->dim && c < m->x->components;
		int n = pm_moving_lines(m, c, true, lines);
		double *v = faces && m->v && c < m->v->components && (b.mirror[0] || b.mirror[1]) ? pm_out(m->v, c) : NULL;
		if (n)
			finite &= pm_advance_axis(m->set->n, &a, n, lines, faces ? pm_out(m->x, c) : NULL, v, &b);
		n = pm_moving_lines(m, c, false, lines);
		if (n)
			finite &= pm_advance_axis(m->set->n, &a, n, lines, NULL, NULL, NULL);
	}
	for (int r = 0; r < m->n && finite; r++) /* else the library looks for the place */
		if (!m->b || m->rates[r].state != m->v) {
			m->rates[r].state->use |= PM_USE_SEEN;
			for (int i = 0; i < PM_REGISTERS; i++)
				if (m->rates[r].q[i])
					m->rates[r].q[i]->use |= PM_USE_SEEN;
		}
	return status;
}

static inline size_t pm_moving_mark(const struct pm_frame *f, const struct pm_moving *m, unsigned char *gone)
{
	size_t n = m->set->n, count = 0;
	for (int a = 0; a < f->dim && a < m->x->components; a++)
		if (f->pface[a][0] == PM_PABSORB || f->pface[a][1] == PM_PABSORB)
			pm_particle_faces_absorb(n, f->lo[a], f->hi[a], (bool[]){f->pface[a][0] == PM_PABSORB, f->pface[a][1] == PM_PABSORB}, pm_in(m->x, a), gone);
	for (size_t i = 0; i < n; i++)
		count += gone[i];
	return count;
}

/* Takes out the particles that have crossed an absorbing face; *absorbed of them. */
static inline int pm_moving_absorb(struct pm_frame *f, const struct pm_moving *m, uint64_t *absorbed)
{
	size_t n = m->set->n;
	unsigned char *gone = pm_zalloc(n ? n : 1, 1);
	if (!gone)
		return -PM_DATA;
	*absorbed = pm_moving_mark(f, m, gone);
	for (size_t i = 0; i < f->nfields && *absorbed; i++) {
		struct pm_field *field = f->fields[i];
		unsigned char *bytes = strcmp(field->on, m->set->name) ? NULL : pm_field_bytes(field);
		size_t size = field->type == PM_U8 ? 1 : 8;
		for (int c = 0; bytes && c < field->components; c++)
			pm_advance_compact(n, gone, size, bytes + (size_t)c * n * size);
	}
	pm_free(gone);
	return *absorbed ? pm_frame_set_resize(f, m->set, n - *absorbed) : 0; /* which keeps the first values of every component */
}

#endif
