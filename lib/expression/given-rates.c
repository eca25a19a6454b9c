/* Rates of change given by expressions, rate += expression. Cost: one evaluation a value. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "expression/given-limits.h"
#include "expression/given-rates.h"
#include "stream/declare.h"

/* The state whose rate of change `name` is; NULL: none. */
static const char *state_of(const char *name) { return !strcmp(name, "acc") ? "v" : !strcmp(name, "vel") ? "x" : name[0] == 'd' && name[1] ? name + 1 : NULL; }

/* A magnetic field, which is no rate of a state: the kicks of push turn v about it (lib/transfer/magnetic-field.c adds that of a mesh). */
static bool is_magnetic(const char *name) { return !strcmp(name, "bfield"); }

int pm_given_rate_check(const char *text)
{
	char name[PM_NAME];
	const char *expression;
	if (pm_expression_named(text, name, &expression))
		return -PM_USAGE;
	if (is_magnetic(name))
		return 0;
	if (!state_of(name) || !strcmp(name, "dx") || !strcmp(name, "dv"))
		return pm_fail(PM_USAGE, "'%s' is no rate of change (acc of v, vel of x, bfield, or d before any other state: dcirculation)", name);
	return 0;
}

static bool is_state(const struct pm_field *p) { return p && p->role == PM_STATE; }

/* Does the rate move the set? x has one only where there is no v. */
static bool moves(const struct pm_frame *f, const char *set, const char *of)
{
	return is_state(pm_frame_field(f, set, of)) && (strcmp(of, "x") || !is_state(pm_frame_field(f, set, "v")));
}

/* As many parts as the state has components; a velocity may have more than there are axes. */
static int fits(const struct pm_frame *f, const struct pm_field *state, const char *name, const struct pm_expression *e)
{
	if (state->type == PM_I64 || state->type == PM_U8)
		return pm_fail(PM_DATA, "'%s' on '%s' holds whole numbers, which have no rate of change", state->name, state->on);
	if (e->nparts != state->components && (strcmp(name, "acc") || e->nparts != f->dim))
		return pm_fail(PM_DATA, "'%s' on '%s' has %d components, and '%s' here %d (one expression each, commas between)", state->name, state->on,
			state->components, name, e->nparts);
	for (int i = 0; i < e->nvalues; i++)
		if (!strcmp(e->value[i].field, name))
			return pm_fail(PM_DATA, "'%s' is what is added to, and cannot be read (write it in terms of the state)", name);
	return 0;
}

static int declare_on(struct pm_expression_jobs *jobs, const struct pm_given_rate_choice *c, struct pm_frame *f, const char *set, const char *name,
	const char *expression)
{
	const struct pm_field *state = is_magnetic(name) ? NULL : pm_frame_field(f, set, state_of(name));
	struct pm_expression_job *job = pm_expression_jobs_next(jobs);
	int status = job ? pm_expression_compile(&job->e, f, set, expression) : -PM_DATA;
	if (!status)
		status = state ? fits(f, state, name, &job->e) : job->e.nparts == 3 ? 0 :
			pm_fail(PM_DATA, "a magnetic field has 3 components, and '%s' here %d (one expression each, commas between)", name, job->e.nparts);
	if (status)
		return status;
	job->field = pm_contributes(f, set, name, state ? state->name : "", job->e.nparts, c->term, c->replace);
	if (!job->field)
		return -PM_DATA;
	job->field->extensive = state && state->extensive;
	if (job->field->use & PM_USE_NEW)
		job->field->use |= PM_USE_FILL;
	jobs->n++;
	return 0;
}

int pm_given_rate_declare(struct pm_expression_jobs *jobs, const struct pm_given_rate_choice *c, struct pm_frame *f, const char *text)
{
	char name[PM_NAME];
	const char *expression = NULL;
	size_t before = jobs->n;
	int status = pm_expression_named(text, name, &expression);
	if (!status && c->set && !pm_frame_set(f, c->set))
		return pm_fail(PM_DATA, "no set '%s' (sls lists the sets)", c->set);
	const char *of = status || is_magnetic(name) ? "v" : state_of(name);
	for (size_t i = 0; i < f->nsets && !status; i++)
		if ((!c->set || !strcmp(c->set, f->sets[i]->name)) && moves(f, f->sets[i]->name, of))
			status = declare_on(jobs, c, f, f->sets[i]->name, name, expression);
	if (!status && jobs->n == before)
		return pm_fail(PM_DATA, "'%s' moves nothing: no %sset has the state '%s'%s", name, c->set ? "such " : "", of,
			strcmp(of, "x") ? "" : " without a velocity v (acc is the rate of change of v)");
	return status;
}

static int add(const struct pm_frame *f, const struct pm_expression_job *job)
{
	size_t n = job->field->count;
	double *more = pm_alloc(n ? n : 1, sizeof *more);
	for (int c = 0; c < job->e.nparts && more; c++) {
		double *rate = pm_out(job->field, c);
		pm_expression_eval(&job->e, f, c, n, more);
#pragma omp parallel for schedule(static) if (n > 16384)
		for (size_t i = 0; i < n; i++)
			rate[i] += more[i];
	}
	pm_free(more);
	return more ? 0 : -PM_DATA;
}

int pm_given_rates_add(const struct pm_expression_jobs *jobs, const struct pm_frame *f)
{
	int status = 0;
	for (size_t k = 0; k < jobs->n && !status; k++) { /* the status is agreed */
		const struct pm_expression_job *job = jobs->job + k;
		if (job->field->use & PM_USE_FILL)
			pm_expression_assign(&job->e, f, job->field);
		else
			status = add(f, job);
		if (job->field->of[0]) /* a magnetic field limits no step */
			status = pm_given_limits_add(status, job, f);
	}
	return status;
}
