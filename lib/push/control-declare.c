/* Error-controlled steps, the header: what is refused, and what is remembered (step-control.h). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "push/step-control.h"
#include "stream/frame-time.h"

bool pm_control_register(const struct pm_moving *m, const struct pm_rate *rate, int i)
{
	const struct pm_step *s = m->pass.step;
	return rate->state != m->x || !m->v || s->embedded || (s->implicit ? i == 0 : i == PM_CONTROL_REST || i == PM_CONTROL_START);
}

/* Are the registers of an earlier step there? */
static bool remembers(const struct pm_frame *f, const struct pm_moving *m, const struct pm_step *scheme)
{
	const json_t *s = json_object_get(m->set->more, "scheme"), *name = json_object_get(s, "name");
	bool all = json_is_string(name) && !strcmp(json_string_value(name), scheme->name) && json_is_number(json_object_get(s, "dt"));
	for (int r = 0; r < m->n && all; r++)
		for (int i = 0; i < PM_CONTROL_KEPT && all; i++) {
			char q[PM_NAME];
			pm_register_name(q, i, m->rates[r].state->name);
			const struct pm_field *there = pm_control_register(m, &m->rates[r], i) ? pm_frame_field(f, m->set->name, q) : NULL;
			all = !pm_control_register(m, &m->rates[r], i) ||
				(there && there->role == PM_REGISTER && there->components == pm_rate_components(&m->rates[r]));
		}
	return all;
}

static int sound(const struct pm_frame *f, const struct pm_moving *m, const char *name)
{
	const char *on = m->set->name;
	if (pm_moving_face(f, PM_PREFLECT) || pm_moving_face(f, PM_PABSORB))
		return pm_fail(PM_DATA, "%s follows a smooth path, and the box has faces that %s particles (smod --particle-faces open, or push rk4)", name,
			pm_moving_face(f, PM_PREFLECT) ? "reflect" : "absorb");
	for (int r = 0; r < m->n; r++) {
		const struct pm_rate *rate = &m->rates[r];
		if (rate->state->type != PM_F64)
			return pm_fail(PM_DATA, "'%s' on '%s' is in single precision, which %s cannot use (make it again in f64, or push rk4)",
				rate->state->name, on, name);
		if (rate->state == m->v && m->x && pm_rate_components(rate) < m->x->components)
			return pm_fail(PM_DATA, "'%s' on '%s' has %d components, and 'x' %d: %s needs the rate of every position", rate->rate->name, on,
				rate->rate->components, m->x->components, name);
	}
	return 0;
}

int pm_control_set(const struct pm_frame *f, struct pm_moving *m, const struct pm_push *p)
{
	const struct pm_step *scheme = p->scheme;
	const int status = sound(f, m, scheme->name), pass = m->set->pass;
	const int nodes = scheme->control ? scheme->control->nodes : scheme->embedded ? scheme->embedded->stages : 2;
	if (status)
		return status;
	if (pass >= nodes)
		return pm_fail(PM_DATA, "'%s' claims node %d of %s, which has %d", m->set->name, pass, scheme->name, nodes);
	m->pass.step = scheme;
	m->pass = (struct pm_pass){.step = scheme, .pass = pass, .registers = scheme->registers, .kept = scheme->registers,
		.known = pass ? scheme->registers : scheme->control && remembers(f, m, scheme) ? PM_CONTROL_KEPT : 0};
	return 0;
}

int pm_control_frame(struct pm_frame *f, size_t n, const struct pm_moving *moving, const struct pm_push *p)
{
	for (size_t i = 0; i < f->nsets; i++) {
		bool here = !pm_set_moves(f, f->sets[i]);
		for (size_t k = 0; k < n && !here; k++)
			here = moving[k].set == f->sets[i];
		if (!here)
			return pm_fail(PM_DATA, "%s moves all sets together, and '%s' is left out (without --set; or fix it with smod --fixed)",
				p->scheme->name, f->sets[i]->name);
	}
	for (size_t k = 1; k < n; k++)
		if (moving[k].pass.pass != moving[0].pass.pass)
			return pm_fail(PM_DATA, "'%s' is at node %d of a step of %s, '%s' at node %d (start the step anew from a frame at substep 0)",
				moving[0].set->name, moving[0].pass.pass, p->scheme->name, moving[k].set->name, moving[k].pass.pass);
	if (!f->substep && pm_step_adapts(p->scheme) && fabs(f->dt) > p->most)
		pm_frame_dt_set(f, copysign(p->most, f->dt));
	return 0;
}
