/* A frame without the sets, meshes, fields and particles that were not chosen. Cost: with an expression one evaluation and one copy of the particles.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expression/expression.h"
#include "expression/selection.h"
#include "stream/declare.h"
#include "stream/join.h"
#include "stream/strengths.h"
#include "world/world.h"

static bool listed(const struct pm_names *list, const struct pm_field *p)
{
	char full[2 * PM_NAME];
	snprintf(full, sizeof full, "%s/%s", p->on, p->name);
	for (int i = 0; i < list->n; i++)
		if (!strcmp(list->name[i], p->name) || !strcmp(list->name[i], full))
			return true;
	return false;
}

static bool named(const struct pm_names *list, const char *name)
{
	for (int i = 0; i < list->n; i++)
		if (!strcmp(list->name[i], name))
			return true;
	return false;
}

enum { SETS = 1, MESHES = 2, FIELDS = 4 };

static bool there_is(const struct pm_frame *f, const char *const *name, unsigned among)
{
	const struct pm_names one = {.name = name, .n = 1};
	bool there = (among & SETS && pm_frame_set(f, *name)) || (among & MESHES && pm_frame_mesh(f, *name));
	for (size_t k = 0; among & FIELDS && k < f->nfields && !there; k++)
		there = listed(&one, f->fields[k]);
	return there;
}

/* Checks that every name in a list exists in one of the frames. */
static int all_there(const struct pm_frame *const f[], int n, const struct pm_names *list, const char *option, unsigned among)
{
	for (int i = 0; i < list->n; i++) {
		bool there = false;
		for (int k = 0; k < n && !there; k++)
			there = there_is(f[k], &list->name[i], among);
		if (!there)
			return pm_fail(PM_DATA, "--%s: there is no '%s' (sls lists what there is)", option, list->name[i]);
	}
	return 0;
}

int pm_selection_check(const struct pm_selection *s, const struct pm_frame *const f[], int n)
{
	int status = all_there(f, n, &s->sets, "set", SETS);
	status = status ? status : all_there(f, n, &s->meshes, "mesh", MESHES);
	status = status ? status : all_there(f, n, &s->fields, "field", FIELDS);
	return status ? status : all_there(f, n, &s->drop, "drop", SETS | MESHES | FIELDS);
}

void pm_selection_leave_out(const struct pm_selection *s, struct pm_frame *f)
{
	for (size_t i = f->nsets; i-- > 0;)
		if ((s->sets.n && !named(&s->sets, f->sets[i]->name)) || named(&s->drop, f->sets[i]->name))
			pm_frame_remove(f, f->sets[i]->name);
	for (size_t i = f->nmeshes; i-- > 0;)
		if ((s->meshes.n && !named(&s->meshes, f->meshes[i]->name)) || named(&s->drop, f->meshes[i]->name))
			pm_frame_remove(f, f->meshes[i]->name);
	for (size_t i = f->nfields; i-- > 0;)
		if ((s->fields.n && !listed(&s->fields, f->fields[i])) || listed(&s->drop, f->fields[i]))
			pm_drops(f, f->fields[i]);
}

static bool takes_part(const struct pm_selection *s, const char *set) { return (!s->sets.n || named(&s->sets, set)) && !named(&s->drop, set); }

/* Declares all fields of the set, because each is filtered; those the expression does not use may be of any type. */
static int declare_where(const struct pm_selection *s, struct pm_frame *f, const char *on)
{
	struct pm_expression e;
	int status = pm_expression_compile(&e, f, on, s->where);
	for (size_t k = 0, n = f->nfields; k < n && !status;) { /* pm_changes moves a field to the end of the list */
		struct pm_field *p = f->fields[k];
		if (strcmp(p->on, on) || p->uniform || p->use & PM_USE_CHANGE) {
			k++;
			continue;
		}
		p->use |= p->use & PM_USE_READ ? 0 : PM_USE_ANY;
		pm_changes(f, on, p->name), n--;
	}
	return status;
}

/* What leaves with a set is accounted for: its strengths are summed. */
static void declare_left_out(struct pm_frame *f, const char *on)
{
	for (size_t k = 0; k < f->nfields; k++)
		if (!strcmp(f->fields[k]->on, on) && pm_is_strength(f->fields[k]) && !f->fields[k]->uniform)
			f->fields[k]->use |= f->fields[k]->use & PM_USE_READ ? 0 : PM_USE_ANY;
}

int pm_selection_declare(const struct pm_selection *s, struct pm_frame *f)
{
	const struct pm_frame *const one[] = {f};
	int status = pm_selection_check(s, one, 1);
	if (status)
		return status;
	if (s->where && !f->nsets)
		return pm_fail(PM_DATA, "no particles for --where to choose from");
	for (size_t i = 0; s->where && i < f->nsets && !status; i++) {
		if (takes_part(s, f->sets[i]->name))
			status = declare_where(s, f, f->sets[i]->name);
		else
			declare_left_out(f, f->sets[i]->name);
	}
	if (!s->where)
		pm_selection_leave_out(s, f);
	return status;
}

static int select_particles(const struct pm_selection *s, struct pm_frame *f, struct pm_set *set)
{
	struct pm_expression e;
	size_t n = set->n, first = 0;
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->on, set->name) && f->fields[i]->here)
			n = f->fields[i]->count, first = (size_t)f->fields[i]->first;
	double *y = pm_alloc(n ? n : 1, sizeof *y);
	unsigned char *keep = (unsigned char *)y;
	int status = y ? pm_expression_compile(&e, f, set->name, s->where) : -PM_DATA;
	if (!status) {
		pm_expression_eval(&e, f, 0, n, y);
		for (size_t i = 0; i < n && !status; i++) {
			double v = y[i]; /* the bytes overwrite numbers that were already tested */
			keep[i] = v != 0;
			if (isnan(v))
				status = pm_fail(PM_NUMERICS, "--where is not a number for the particle at index %zu of '%s'", first + i, set->name);
		}
	}
	status = pm_world_agree(status);
	if (!status)
		status = pm_frame_select(f, set, keep);
	pm_free(y);
	return status;
}

bool pm_selection_divides(const struct pm_selection *s, const struct pm_frame *f)
{
	bool can = s->where;
	for (size_t i = 0; i < f->nsets; i++) {
		bool divided = !takes_part(s, f->sets[i]->name);
		for (size_t k = 0; k < f->nfields && !divided; k++)
			divided = !strcmp(f->fields[k]->on, f->sets[i]->name) && f->fields[k]->use & PM_USE_CHANGE;
		can = can && divided;
	}
	return can;
}

int pm_selection_apply(const struct pm_selection *s, struct pm_frame *f)
{
	int status = 0;
	for (size_t i = 0; i < f->nsets && !status; i++)
		if (takes_part(s, f->sets[i]->name))
			status = select_particles(s, f, f->sets[i]);
	pm_selection_leave_out(s, f);
	return status;
}

/* "3" or "3:5" or "3:" as first and last. */
static bool range(const char *text, uint64_t *first, uint64_t *last)
{
	char *end;
	if (*text < '0' || *text > '9')
		return false;
	*first = *last = strtoull(text, &end, 10);
	if (*end == ':') {
		const char *second = end + 1;
		*last = *second ? strtoull(second, &end, 10) : UINT64_MAX;
		end = *second ? (*second < '0' || *second > '9' ? "bad" : end) : "";
	}
	return !*end && *first >= 1 && *last >= *first;
}

int pm_frame_numbers_check(const struct pm_names *ranges)
{
	uint64_t first, last;
	for (int i = 0; i < ranges->n; i++)
		if (!range(ranges->name[i], &first, &last))
			return pm_fail(PM_USAGE, "--frames '%s' is neither N nor N:M with N from 1 and not above M", ranges->name[i]);
	return 0;
}

bool pm_frame_numbers_contain(const struct pm_names *ranges, uint64_t number)
{
	bool in = !ranges->n;
	for (int i = 0; i < ranges->n && !in; i++) {
		uint64_t first, last;
		in = range(ranges->name[i], &first, &last) && number >= first && number <= last;
	}
	return in;
}
