/* Fields computed from expressions, NAME = EXPRESSION on a set or mesh. Cost: one evaluation a value. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "expression/computed-fields.h"
#include "expression/field-total.h"
#include "stream/declare.h"
#include "world/world.h"

/* The field to compute: an old one is rewritten, a new one made. */
static struct pm_field *target(const struct pm_computed_choice *c, struct pm_frame *f, const char *on, const char *name, const struct pm_expression *e)
{
	struct pm_field *p = pm_frame_field(f, on, name);
	if (p && (p->components != e->nparts || p->role == PM_CHANGE || p->role == PM_REGISTER)) {
		if (p->components != e->nparts)
			pm_fail(PM_DATA, "'%s' on '%s' has %d components, here are %d (one expression each, commas between)", name, on, p->components,
				e->nparts);
		else
			pm_fail(PM_DATA, "'%s' on '%s' is a %s field, which only the stages that add to it may change", name, on, pm_role_names[p->role]);
		return NULL;
	}
	if (p)
		return pm_changes(f, on, name);
	if (!(p = pm_makes(f, on, name, e->nparts, c->role)))
		return NULL;
	p->extensive = c->extensive;
	p->type = c->type;
	return p;
}

/* The kernel of a field is that of the fields it is computed from, its own old values among them. */
static void inherit(struct pm_field *field, const struct pm_frame *f, const struct pm_expression *e)
{
	struct pm_field made = {.kernel = "", .role = PM_DERIVED};
	for (int i = 0; i < e->nvalues; i++)
		if (*e->value[i].field)
			pm_field_inherit(&made, pm_frame_field(f, e->on, e->value[i].field));
	memcpy(field->kernel, made.kernel, sizeof field->kernel);
	field->interlaced = made.interlaced;
	field->outside = 0;
	for (int d = 0; d < 2 * f->dim && *made.kernel; d++) /* what is computed is no longer the law's field of the particles */
		if (f->face[d / 2][d % 2] == PM_OPEN)
			field->outside = made.outside == PM_OUTSIDE_DROP ? PM_OUTSIDE_DROP : PM_OUTSIDE_ERROR;
}

int pm_computed_declare(struct pm_expression_jobs *jobs, const struct pm_computed_choice *c, struct pm_frame *f, const char *on, const char *text,
	bool *changed)
{
	char name[PM_NAME];
	const char *expression;
	struct pm_expression_job *job = pm_expression_jobs_next(jobs);
	int status = job ? pm_expression_named(text, name, &expression) : -PM_DATA;
	if (!status)
		status = pm_expression_compile(&job->e, f, on, expression);
	if (status)
		return status;
	const struct pm_field *old = pm_frame_field(f, on, name);
	*changed |= old && old->role == PM_STATE;
	if (!(job->field = target(c, f, on, name, &job->e)))
		return -PM_DATA;
	inherit(job->field, f, &job->e);
	if (c->unit)
		snprintf(job->field->unit, PM_NAME, "%.63s", c->unit);
	jobs->n++;
	return c->total ? pm_total_declare(f, job->field, c->per) : 0;
}

int pm_computed_outdate(const struct pm_expression_jobs *jobs, struct pm_frame *f)
{
	for (size_t i = f->nfields; i-- > 0;) {
		struct pm_field *p = f->fields[i];
		bool ours = false;
		for (size_t k = 0; k < jobs->n; k++)
			ours |= jobs->job[k].field == p;
		if (ours || (p->role != PM_DERIVED && p->role != PM_CHANGE))
			continue;
		if (p->use & PM_USE_READ)
			return pm_fail(PM_DATA, "'%s' was computed from state that is changed here (one scalc to read it, then another to change the state)",
				p->name);
		pm_drops(f, p);
	}
	return 0;
}

static int integers(struct pm_frame *f, const struct pm_expression_job *job)
{
	size_t n = job->field->count;
	double *y = pm_alloc(n ? n : 1, sizeof *y);
	int status = y ? 0 : -PM_DATA;
	for (int c = 0; c < job->e.nparts && !status; c++) {
		pm_expression_eval(&job->e, f, c, n, y);
		for (size_t i = 0; i < n && !status; i++) {
			double v = floor(y[i]);
			if (!(v >= -0x1p63 && v < 0x1p63)) {
				if (job->field->here)
					pm_world_place(2, job->field->order, c, job->field->first + i);
				status = pm_fail(PM_NUMERICS, "'%s' is no whole number that fits at index %zu", job->field->name,
					(size_t)job->field->first + i);
			} else
				pm_out_i64(job->field, c)[i] = (int64_t)v;
		}
	}
	pm_free(y);
	return status;
}

int pm_computed_apply(const struct pm_expression_jobs *jobs, const struct pm_computed_choice *c, struct pm_frame *f)
{
	int status = 0;
	for (size_t k = 0; k < jobs->n && (!status || c->total); k++) { /* totals of all ranks, also of one that has failed */
		const struct pm_expression_job *job = jobs->job + k;
		if (status)
			;
		else if (job->field->type == PM_U8)
			status = pm_fail(PM_DATA, "'%s' holds bytes, which scalc does not compute", job->field->name);
		else if (job->field->type == PM_I64)
			status = integers(f, job);
		else
			pm_expression_assign(&job->e, f, job->field);
		if (c->total)
			status = pm_total(status, f, job->field, c->per);
	}
	return status;
}
