/* What particles beyond the open faces of the mesh receive with the field that is gathered: the law's field, or its potential, of the ball that stands for
 * those inside; and those inside the reaction, a uniform field (outside.c). Which are outside follows from their positions and from the kernel of the field
 * alone, as in p2m. A density is zero there. Cost: nothing if none is outside, else three passes over the particles.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "transfer/gather-frame.h"
#include "world/world.h"

/* The quantities known beyond the mesh. */
static bool is_field(const struct pm_gather_job *j) { return j->law->field && !strcmp(j->name, j->law->field); }
static bool is_potential(const struct pm_gather_job *j) { return j->law->potential && !strcmp(j->name, j->law->potential); }
static bool is_density(const struct pm_gather_job *j) { return j->law->density && !strcmp(j->name, j->law->density); }

int pm_gather_outside_choose(struct pm_gather_job *j, const struct pm_frame *f)
{
	const char *word = j->choice.outside;
	if (j->law->evolves) { /* the kernels are cut at open faces, and what is farther out has no field */
		j->outside = word && !strcmp(word, pm_outside_names[PM_OUTSIDE_ERROR]) ? PM_OUTSIDE_ERROR : PM_OUTSIDE_DROP;
		return 0;
	}
	const bool asked = word && !strcmp(word, pm_outside_names[PM_OUTSIDE_MONOPOLE]);
	int known = pm_outside_init(&j->far, f, j->mesh, j->field);
	if (known < 0)
		return known;
	j->outside = j->field->outside;
	for (int i = 0; word && pm_outside_names[i]; i++)
		if (!strcmp(word, pm_outside_names[i]))
			j->outside = (enum pm_outside)i;
	known = known && (is_field(j) || is_potential(j) || is_density(j));
	if (j->outside != PM_OUTSIDE_MONOPOLE || known)
		return 0;
	j->outside = PM_OUTSIDE_ERROR;
	if (asked && pm_outside_open(&j->transfer.grid))
		return pm_fail(PM_DATA, "'%s' was not computed from the particles by the law %s alone, so it is not known beyond mesh '%s' (--outside drop or "
			"error)", j->name, f->law, j->mesh->name);
	return 0;
}

struct pm_field *pm_gather_target(const struct pm_gather_job *j, const struct pm_frame *f, const char *set)
{
	return pm_frame_field(f, set, j->choice.field ? j->choice.field : j->law->change);
}

/* The components of what is gathered, from potential and gradient. */
static void values(const struct pm_gather_job *j, double potential, const double g[3], double v[3])
{
	const bool curl = j->law->of_potential == PM_CURL;
	memset(v, 0, 3 * sizeof *v);
	if (is_potential(j))
		v[0] = potential;
	for (int d = 0; d < 3 && is_field(j); d++)
		v[d] = !curl ? j->law->sign * g[d] : d == 0 ? g[1] : d == 1 ? -g[0] : 0;
}

/* One set; mask has room for it. */
static void add(const struct pm_gather_job *j, const struct pm_frame *f, const char *set, const unsigned char *mask, const double *factor,
	struct pm_field *target)
{
	const int components = target->components < 3 ? target->components : 3;
	const double *x[3];
	double reaction[3], *out[3];
	pm_positions(f, set, x);
	values(j, j->far.potential, j->far.gradient, reaction);
	for (int c = 0; c < components; c++)
		out[c] = pm_out(target, c);
#pragma omp parallel for schedule(static) if (target->count > 16384)
	for (size_t p = 0; p < target->count; p++) {
		double at[3] = {0}, v[3] = {reaction[0], reaction[1], reaction[2]}, potential, gradient[3];
		for (int d = 0; d < f->dim && mask[p]; d++)
			at[d] = x[d][p];
		if (mask[p]) {
			pm_outside_at(&j->far, at, &potential, gradient);
			values(j, potential, gradient, v);
		}
		for (int c = 0; c < components; c++)
			out[c][p] += factor ? factor[p] * v[c] : v[c];
	}
	target->use &= ~(unsigned)PM_USE_SEEN;
}

static int finish_set(const struct pm_gather_job *j, const struct pm_frame *f, const char *set)
{
	struct pm_field *target = pm_gather_target(j, f, set);
	unsigned char *mask = pm_alloc(target->count + 1, 1);
	struct pm_strays closed;
	const double *ratio = NULL;
	double *made = NULL;
	int status = mask ? pm_outside_find(f, set, &j->far.transfer, mask, &closed) : pm_failed();
	if (!status && closed.count)
		status = pm_strays_refuse(&closed, set, j->mesh, &j->transfer, "--outside drop leaves it without");
	if (!status && !j->choice.field && j->law->per)
		status = pm_ratio(f, set, j->law->strength, j->law->per, &ratio, &made);
	if (!status)
		add(j, f, set, mask, ratio, target);
	pm_free(made);
	pm_free(mask);
	return pm_world_agree(status);
}

/* 1 if a particle is outside: one of the sets gathered to, which has been counted if the kernel is that of the deposit, or of the other sources. */
static int any_outside(const struct pm_gather_job *j, const struct pm_frame *f, bool counted)
{
	for (size_t i = 0; i < j->far.sources.n && !j->strays; i++) {
		const char *name = j->far.sources.name[i];
		bool target = false, any = false;
		for (size_t k = 0; k < j->sets.n; k++)
			target |= !strcmp(name, j->sets.name[k]);
		if (target && counted)
			continue;
		int64_t some = 0;
		int status = pm_outside_any(f, name, &j->far.transfer, &any);
		some = any;
		status = pm_world_count(status, PM_MOST_OF, 1, &some);
		if (status || some)
			return status ? status : 1;
	}
	return j->strays > 0;
}

int pm_gather_outside(struct pm_gather_job *j, struct pm_frame *f)
{
	if (j->outside != PM_OUTSIDE_MONOPOLE)
		return 0;
	const int own = j->transfer.kernel->width, deposit = j->far.transfer.kernel->width;
	int status = any_outside(j, f, own == deposit);
	if (status <= 0)
		return status;
	status = pm_outside_measure(&j->far, f);
	if (status)
		return status;
	if (own != deposit)
		return pm_fail(PM_DATA, "the kernels of p2m and m2p, %s and %s, differ in which particles are beyond mesh '%s' (leave out m2p --kernel)",
			j->far.transfer.kernel->name, j->transfer.kernel->name, j->mesh->name);
	if (!j->far.within && j->far.count > 1)
		return pm_fail(PM_DATA, "all %zu particles are beyond mesh '%s', so it has no force (p2m --outside grow enlarges it)", (size_t)j->far.count,
			j->mesh->name);
	for (size_t i = 0; i < j->sets.n && !status; i++)
		status = finish_set(j, f, j->sets.name[i]);
	return status;
}
