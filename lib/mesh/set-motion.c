/* Sets of particles scaled, rotated, shifted and boosted, in this order. The header determines the fields that change, rigid-motion.c changes the data; a field
 * that is uniform and only scaled stays uniform. Cost: one pass over each field named. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "mesh/set-motion.h"
#include "stream/declare.h"
#include "stream/edit.h"

struct pm_motion_job {
	struct pm_field *field;
	double by;
	bool x, v; /* is it the position, the velocity? */
};

static bool takes_part(const struct pm_set_motion *m, const char *set)
{
	for (int i = 0; i < m->nsets; i++)
		if (!strcmp(m->set[i], set))
			return true;
	return !m->nsets;
}

/* The factor of a field; 1 where it has none. */
static double factor(const struct pm_set_motion *m, const char *field)
{
	double by = 1;
	for (int i = 0; i < m->nfactors; i++)
		by *= strcmp(m->factor[i].field, field) ? 1 : m->factor[i].by;
	return by;
}

static int factors_fit(const struct pm_set_motion *m, const struct pm_frame *f)
{
	for (int i = 0; i < m->nfactors; i++) {
		const char *field = m->factor[i].field;
		bool box = !strcmp(field, "box"), there = box;
		for (size_t k = 0; k < f->nsets && !there; k++)
			there = takes_part(m, f->sets[k]->name) && pm_frame_field(f, f->sets[k]->name, field);
		if (!there)
			return pm_fail(PM_DATA, "no field '%s' to scale (sls lists what there is)", field);
		if (box && !(m->factor[i].by > 0))
			return pm_fail(PM_USAGE, "the box can be scaled only by a factor above 0");
	}
	return factor(m, "box") != 1 ? pm_frame_meshes_free(f) : 0;
}

static int vectors_fit(const struct pm_set_motion *m, const struct pm_frame *f)
{
	for (size_t i = 0; i < f->nsets; i++) {
		const char *set = f->sets[i]->name;
		const struct pm_field *v = pm_frame_field(f, set, "v");
		if (!takes_part(m, set))
			continue;
		if (m->nshift && m->nshift != f->dim)
			return pm_fail(PM_USAGE, "--shift takes %d numbers here, not %d", f->dim, m->nshift);
		if (m->nboost && !v)
			return pm_fail(PM_DATA, "no field 'v' on '%s' to boost", set);
		if (m->nboost && m->nboost != v->components)
			return pm_fail(PM_USAGE, "--boost takes %d numbers here, not %d", v->components, m->nboost);
	}
	const int *axis = m->turn.axis;
	if (axis[0] >= 0 && (f->dim == 1 || (f->dim == 2 && (axis[0] > 1 || axis[1] > 1))))
		return pm_fail(PM_USAGE, "--rotate: in %d dimensions %s", f->dim, f->dim == 1 ? "nothing turns" : "only z can be the axis");
	return 0;
}

int pm_set_motion_check(const struct pm_set_motion *m, const struct pm_frame *f)
{
	int status = factors_fit(m, f);
	if (!status)
		status = vectors_fit(m, f);
	for (int i = 0; i < m->nsets && !status; i++)
		if (!pm_frame_set(f, m->set[i]))
			status = pm_fail(PM_DATA, "no set '%s' (sls lists what there is)", m->set[i]);
	return status;
}

static int add_job(struct pm_set_motion *m, struct pm_motion_job job)
{
	if (m->njobs == m->room) {
		struct pm_motion_job *more = realloc(m->job, (2 * m->room + 8) * sizeof *more);
		if (!more)
			return pm_no_memory();
		m->job = more;
		m->room = 2 * m->room + 8;
	}
	m->job[m->njobs++] = job;
	return 0;
}

/* A field with its factor and motion; *taken if its data are to be changed. */
static int declare_field(struct pm_set_motion *m, struct pm_frame *f, struct pm_field *p, bool *touched, bool *taken)
{
	const struct pm_motion_job job = {.field = p, .by = factor(m, p->name), .x = !strcmp(p->name, "x"), .v = !strcmp(p->name, "v")};
	const bool turns = m->turn.axis[0] >= 0, moves = (job.x && (m->nshift || turns)) || (job.v && (m->nboost || turns));
	if (!moves && job.by == 1)
		return 0;
	if (p->type == PM_I64 || p->type == PM_U8)
		return pm_fail(PM_DATA, "'%s' holds integers, which --scale cannot multiply", p->name);
	if (p->role != PM_STATE)
		return pm_fail(PM_DATA, "'%s' is a %s field, which is computed again, not scaled", p->name, pm_role_names[p->role]);
	*touched = true;
	if (p->uniform && !moves && !job.x) { /* stays uniform: no data to load; positions are folded */
		pm_uniform_scale(p, job.by);
		return 0;
	}
	*taken = true;
	return pm_changes(f, p->on, p->name) ? add_job(m, job) : -PM_DATA;
}

int pm_set_motion_declare(struct pm_set_motion *m, struct pm_frame *f, bool *touched)
{
	const double box = factor(m, "box");
	int status = 0;
	m->njobs = 0;
	if (box != 1) {
		pm_frame_stretch(f, box);
		*touched = true;
	}
	for (size_t i = 0; i < f->nsets && !status; i++)
		for (size_t k = 0, n = f->nfields; k < n && !status && takes_part(m, f->sets[i]->name);) { /* pm_changes moves a field to the end of the list */
			struct pm_field *p = f->fields[k];
			bool taken = false;
			if (!strcmp(p->on, f->sets[i]->name) && !(p->use & PM_USE_CHANGE))
				status = declare_field(m, f, p, touched, &taken);
			n -= taken;
			k += !taken;
		}
	return status;
}

void pm_set_motion_apply(const struct pm_set_motion *m, const struct pm_frame *f)
{
	for (size_t i = 0; i < m->njobs; i++) {
		const struct pm_motion_job *job = &m->job[i];
		struct pm_field *p = job->field;
		for (int c = 0; job->by != 1 && c < p->components; c++)
			for (size_t j = 0; j < p->count; j++)
				pm_out(p, c)[j] *= job->by;
		if (m->turn.axis[0] >= 0 && (job->x || job->v))
			pm_move_turn(&m->turn, p);
		if (job->x && m->nshift)
			pm_move_add(p, m->nshift, m->shift);
		if (job->v && m->nboost)
			pm_move_add(p, m->nboost, m->boost);
		if (job->x)
			pm_move_fold(f, p);
	}
}

void pm_set_motion_clear(struct pm_set_motion *m)
{
	free(m->job);
	m->job = NULL;
	m->njobs = m->room = 0;
}
