/* The header part of a push of one set: refusals, the clock, the declaration of fields.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "push/flow-pass.h"
#include "push/kick-later.h"
#include "push/motion-pass.h"
#include "push/step-control.h"
#include "stream/declare.h"

const struct pm_mesh *pm_push_mesh(const struct pm_frame *f)
{
	for (size_t i = 0; i < f->nmeshes; i++)
		for (size_t k = 0; k < f->nfields; k++)
			if (!strcmp(f->fields[k]->on, f->meshes[i]->name))
				return f->meshes[i];
	return NULL;
}

void pm_push_drops(struct pm_frame *f, const struct pm_push *p, const char *only)
{
	const unsigned roles = 1u << PM_CHANGE | 1u << PM_DERIVED;
	pm_drops_roles(f, NULL, roles);
	for (size_t i = 0; i < f->nsets; i++)
		if (f->sets[i]->fixed || (p->clear && (!only || !strcmp(only, f->sets[i]->name))))
			pm_drops_roles(f, f->sets[i]->name, roles);
}

static int declare_register(struct pm_frame *f, struct pm_moving *m, struct pm_rate *rate, int i)
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
	rate->q[i] = known ? pm_changes(f, m->set->name, name) : pm_makes(f, m->set->name, name, pm_rate_components(rate), PM_REGISTER);
	if (rate->q[i] && rate->q[i]->components != pm_rate_components(rate))
		return pm_fail(PM_DATA, "the register '%s' on '%s' has %d components, its rate %d", name, m->set->name, rate->q[i]->components,
			pm_rate_components(rate));
	if (rate->q[i] && !known && m->pass.step->fills && m->pass.registers == m->pass.step->registers)
		rate->q[i]->use |= PM_USE_FILL;
	return rate->q[i] ? 0 : -PM_DATA;
}

/* Registers of the set that are dropped after this pass: all but the first `kept` of each rate. */
static void forget_registers(struct pm_frame *f, const struct pm_moving *m, int kept)
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

/* Schemes have registers, which are doubles. */
static void takes_columns(struct pm_field *field, const struct pm_push *p)
{
	if (field && !p->scheme)
		field->use |= PM_USE_COLUMNS;
}

static int declare_fields(struct pm_frame *f, struct pm_moving *m, const struct pm_push *p)
{
	for (int r = 0; r < m->n; r++) {
		if (!pm_changes(f, m->set->name, m->rates[r].state->name))
			return -PM_DATA;
		m->rates[r].rate->use |= PM_USE_READ;
		takes_columns(m->rates[r].state, p);
		if (!m->rates[r].rate->uniform)
			takes_columns(m->rates[r].rate, p);
	}
	if (m->v && p->moves && pm_moving_face(f, PM_PREFLECT) && !pm_changes(f, m->set->name, "v"))
		return -PM_DATA;
	for (int k = 0; k < 3 && m->turned; k++)
		if (k > 0 || m->v->type == PM_F32)
			takes_columns((struct pm_field *[]){m->b, m->charge, m->mass}[k], p);
	if (pm_kick_may_wait(m, p))
		m->v->use |= m->v->use & PM_USE_FROM_VALUE ? PM_USE_LATER : PM_USE_LATER | PM_USE_WAITS, m->rates[0].rate->use |= PM_USE_LATER,
			m->b->use |= PM_USE_LATER;
	pm_motion_declare(f, m, p);
	for (int r = 0; r < m->n && p->scheme; r++)
		for (int i = 0; i < m->pass.registers; i++)
			if ((!pm_step_decides(p->scheme) || pm_control_register(m, &m->rates[r], i)) && declare_register(f, m, &m->rates[r], i))
				return -PM_DATA;
	pm_flow_declare(f, m, p);
	forget_registers(f, m, p->scheme ? m->pass.kept : 0);
	if (p->moves)
		pm_drops_roles(f, m->set->name, 1u << PM_CHANGE | 1u << PM_DERIVED);
	return p->moves && pm_moving_face(f, PM_PABSORB) ? pm_moving_shrinks(f, m) : 0;
}

const struct pm_step *pm_moving_magnetic(const struct pm_frame *f, const struct pm_push *p)
{
	const struct pm_law *law = pm_law_of(f);
	return law && law->relativistic && p->magnetic && !strcmp(p->magnetic->name, "boris") ? pm_step_find("relativistic") : p->magnetic;
}

/* The fields that a magnetic kick reads besides acc. */
static int declare_magnetic(struct pm_frame *f, struct pm_moving *m, const struct pm_step *step)
{
	const char *on = m->set->name;
	m->closing = m->set->drift > 0;
	m->turned = true;
	const struct pm_law *law = pm_law_of(f);
	if (law && law->relativistic && !step->relativistic)
		return pm_fail(PM_DATA, "%s is not relativistic, and the law '%s' is (push boris/2, vay/2 or higuera-cary/2)", step->name, f->law);
	if (step->relativistic && !(pm_law_constant(f, "c", NAN) > 0))
		return pm_fail(PM_DATA, "the frame has no speed of light c (smod --constant c=C, or push kick/2)");
	if (step->radiates && !(pm_frame_constant(f, "radiation_time", NAN) >= 0))
		return pm_fail(PM_DATA, "the frame has no radiation_time, e^2/(6 pi eps0 m c^3) of a charge of |q/m| = 1 (smod --constant radiation_time=T)");
	if (step->relativistic && !m->v)
		return pm_fail(PM_DATA, "relativistic advances velocities, and '%s' has none", on);
	if (step->relativistic && !step->radiates && !pm_frame_field(f, on, "bfield"))
		return 0;
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

int pm_moving_declare(struct pm_frame *f, struct pm_set *set, const struct pm_push *p, struct pm_moving *m)
{
	enum pm_step_kind kind = p->scheme || (p->kick > 0 && p->drift > 0) ? PM_SCHEME : p->kick > 0 ? PM_KICK : PM_DRIFT;
	int status = pm_clock_allows(set, p->scheme, p->kick, p->drift);
	/* half a kick, at the beginning and at the end, belongs to a whole step; between them a kick to a part of its own size */
	const bool inner = set->kick > 0 && set->kick + p->kick < 1 - 1e-9;
	const double part = p->scheme ? 1 : fmin(1, (inner ? 1 : 2) * p->kick);
	*m = (struct pm_moving){.part = part, .set = set, .x = pm_frame_field(f, set->name, "x"), .v = pm_frame_field(f, set->name, "v")};
	if (!pm_rate_is_state(m->v))
		m->v = NULL;
	if (!status && p->scheme && p->scheme->kicks && !m->v)
		status = pm_fail(PM_DATA, "%s kicks velocities and moves by them, and '%s' has no 'v' (rk4, lsrk3 advance what moves by a flow)",
			p->scheme->name, set->name);
	if (!status && p->magnetic)
		status = declare_magnetic(f, m, pm_moving_magnetic(f, p));
	if (!status && kind != PM_DRIFT)
		status = pm_rates_allowed(f, set, p->magnetic ? NULL : p->scheme ? p->scheme->name : "a plain kick");
	if (!status)
		status = pm_rates_complete(f, set);
	if (!status)
		status = m->n = pm_rates(f, set, kind, m->rates);
	if (status >= 0)
		status = !p->scheme ? pm_clock_add(set, p->kick, p->drift, p->open) : pm_step_decides(p->scheme) ? pm_control_set(f, m, p) :
			pm_clock_pass(f, set, p->scheme, m->n, m->rates, &m->pass);
	return status < 0 ? status : declare_fields(f, m, p);
}
