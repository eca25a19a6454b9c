/* Sources and targets of far fields, between the sets of a frame and plain arrays.
 * Every set with positions and the strength is a source. Every set with positions is accelerated (test particles too); a fixed one, and one without the
 * mass that its acceleration needs, gets only the potential.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "far/bodies.h"
#include "limit/rates.h"
#include "stream/all-values.h"
#include "stream/declare.h"
#include "stream/limits.h"
#include "stream/over-stretches.h"
#include "world/world.h"

static const struct pm_field *state_of(const struct pm_frame *f, const struct pm_set *s, const char *name)
{
	const struct pm_field *field = pm_frame_field(f, s->name, name);
	return field && field->role == PM_STATE ? field : NULL;
}

static bool is_source(const struct pm_frame *f, const struct pm_set *s, const struct pm_far *far)
{
	return state_of(f, s, "x") && state_of(f, s, far->strength);
}

static bool is_accelerated(const struct pm_frame *f, const struct pm_set *s, const struct pm_far *far)
{
	return !s->fixed && (!far->per || (state_of(f, s, far->per) && state_of(f, s, far->strength)));
}

static bool is_target(const struct pm_frame *f, const struct pm_set *s, const struct pm_far *far)
{
	return (!far->set || !strcmp(far->set, s->name)) && state_of(f, s, "x") && (is_accelerated(f, s, far) || far->with_potential);
}

static int plan_set(struct pm_frame *f, const struct pm_set *s, const struct pm_far *far, const char *term, bool replace)
{
	const struct pm_field *x = state_of(f, s, "x");
	bool source = is_source(f, s, far), target = is_target(f, s, far), pushed = target && is_accelerated(f, s, far);
	if ((source || target) && x->components < f->dim)
		return pm_fail(PM_DATA, "'x' of '%s' has %d components in %d-D", s->name, x->components, f->dim);
	bool good = (!source && !target) || pm_reads(f, s->name, "x");
	good = good && (!source || pm_reads(f, s->name, far->strength)) && (!pushed || !far->per || pm_reads(f, s->name, far->per));
	if (good && pushed)
		good = pm_contributes(f, s->name, far->change, far->of, f->dim, term, replace);
	if (good && pushed && source && far->turning) {
		struct pm_field *rate = pm_contributes(f, s->name, far->turning, far->strength, 3, "stretching", replace);
		good = rate;
		if (rate)
			rate->extensive = true;
	}
	if (good && target && far->with_potential)
		good = pm_makes(f, s->name, far->potential, far->vector ? 3 : 1, PM_DERIVED);
	return good ? 0 : -PM_DATA;
}

/* Why no set is accelerated. */
static int no_target(const struct pm_frame *f, const struct pm_far *far)
{
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_set *s = f->sets[i];
		const bool asked = !far->set || !strcmp(far->set, s->name);
		if (asked && far->per && !s->fixed && is_source(f, s, far) && !state_of(f, s, far->per))
			return pm_fail(PM_DATA, "no field '%s' on '%s', by which its acceleration is divided (a column %s for stab, or scalc --extensive "
				"'%s = 1'; --potential for the potential alone)", far->per, s->name, far->per, far->per);
	}
	if (far->set)
		return pm_fail(PM_DATA, "no set '%s' that could be accelerated (sls lists the sets)", far->set);
	return pm_fail(PM_DATA, "no set can be accelerated: all are fixed (smod --loose, or --potential for the potential alone)");
}

int pm_far_plan(struct pm_frame *f, const struct pm_far *far, const char *term, bool replace)
{
	int sources = 0, targets = 0, status = 0;
	for (size_t i = 0; i < f->nsets; i++)
		sources += is_source(f, f->sets[i], far), targets += is_target(f, f->sets[i], far);
	if (!sources)
		return pm_fail(PM_DATA, "no set with 'x' and '%s' (add it with stab --strength)", far->strength);
	if (!targets)
		return no_target(f, far);
	for (size_t i = 0; i < f->nsets && !status; i++)
		status = plan_set(f, f->sets[i], far, term, replace);
	return status;
}

static int put(int status, const struct pm_frame *f, const struct pm_set *s, const struct pm_far *far, struct pm_bodies *b)
{
	const struct pm_field *q = state_of(f, s, far->strength), *x = state_of(f, s, "x");
	for (int d = 0; d < f->dim; d++)
		status = pm_all_values(status, x, pm_in(x, d), status ? NULL : b->x[d] + b->n);
	if (q && !far->vector)
		status = pm_all_values(status, q, pm_in(q, 0), status ? NULL : b->q + b->n);
	for (int d = 0; q && far->vector && d < 3; d++)
		status = pm_all_values(status, q, pm_in(q, d), status ? NULL : b->alpha[d] + b->n);
	if (status)
		return status;
	b->own[2 * b->sets] = x->first, b->own[2 * b->sets + 1] = x->first + x->count;
	b->n += b->count[b->sets++] = s->n;
	return 0;
}

int pm_bodies_gather(const struct pm_frame *f, const struct pm_far *far, struct pm_bodies *b)
{
	size_t n = 1, size = sizeof(double);
	for (size_t i = 0; i < f->nsets; i++)
		n += f->sets[i]->n;
	*b = (struct pm_bodies){.q = pm_zalloc(n, size), .count = pm_alloc(f->nsets + 1, sizeof *b->count),
		.own = pm_alloc(2 * f->nsets + 1, sizeof *b->own)};
	b->potential = far->with_potential && !far->vector ? pm_alloc(n, size) : NULL;
	bool good = b->q && b->count && b->own && (b->potential || !far->with_potential || far->vector);
	for (int d = 0; d < 3 && far->vector; d++) {
		b->alpha[d] = pm_zalloc(n, size), b->rate[d] = pm_alloc(n, size), b->psi[d] = far->with_potential ? pm_alloc(n, size) : NULL;
		good = good && b->alpha[d] && b->rate[d] && (b->psi[d] || !far->with_potential);
	}
	for (int d = 0; d < f->dim; d++) {
		b->x[d] = pm_alloc(n, size), b->gradient[d] = pm_alloc(n, size);
		good = good && b->x[d] && b->gradient[d];
	}
	int status = good ? 0 : -PM_DATA;
	for (size_t i = 0; i < f->nsets; i++)
		if (is_target(f, f->sets[i], far))
			status = put(status, f, f->sets[i], far, b);
	b->targets = b->n;
	for (size_t i = 0; i < f->nsets; i++)
		if (!is_target(f, f->sets[i], far) && is_source(f, f->sets[i], far))
			status = put(status, f, f->sets[i], far, b);
	if (status)
		pm_bodies_free(b);
	return status;
}

static void make_sizes(const void *data, size_t from, size_t to, void *part)
{
	for (size_t i = from; i < to; i++)
		pm_sum_add(part, fabs(((const double *)data)[i]));
}

/* The sum of all strengths without their signs. */
static double strength_of(const struct pm_bodies *b)
{
	struct pm_sum sum = {0, 0};
	const struct pm_parts parts = {.size = sizeof sum, .make = make_sizes, .join = pm_join_sums};
	for (size_t s = 0, at = 0; s < b->sets; at += b->count[s++])
		pm_over_set(&parts, b->q + at, b->count[s], &sum);
	return pm_sum_total(sum);
}

/* The largest rate of pm_orbit_rate: the square of a frequency, or of a flow the strain. x: of the set; `at`: of its first particle that is here. */
static double orbits(const struct pm_frame *f, const struct pm_set *s, const struct pm_far *far, const struct pm_field *x, double c, const struct pm_bodies *b,
	size_t at)
{
	const double *q = far->per ? pm_in(state_of(f, s, far->strength), 0) : NULL, *per = far->per ? pm_in(state_of(f, s, far->per), 0) : NULL;
	const double pull = fabs(c) * strength_of(b);
	double most = 0;
	for (size_t i = 0; i < x->count; i++) {
		double square = 0;
		for (int d = 0; d < f->dim; d++)
			square += b->gradient[d][at + i] * b->gradient[d][at + i];
		most = fmax(most, pm_orbit_rate(f->dim, fabs(c) * sqrt(square), pull) * (per ? fabs(q[i] / per[i]) : 1));
	}
	return pm_most_of_stretches(x, most);
}

static void add(const struct pm_frame *f, const struct pm_set *s, const struct pm_far *far, double c, const struct pm_bodies *b, size_t at)
{
	struct pm_field *change = pm_frame_field(f, s->name, far->change);
	const double *q = far->per ? pm_in(state_of(f, s, far->strength), 0) : NULL, *per = far->per ? pm_in(state_of(f, s, far->per), 0) : NULL;
	for (int d = 0; d < f->dim; d++) {
		const double *g = b->gradient[far->curl ? 1 - d : d] + at;
		double factor = !far->curl ? far->sign * c : d ? -c : c, *y = pm_out(change, d);
		for (size_t i = 0; i < change->count; i++)
			y[i] += per ? factor * g[i] * (q[i] / per[i]) : factor * g[i];
	}
}

/* Velocity and the rate of the strengths, with the strain: what turns alpha is no faster than the flow strains. */
static void add_vortices(const struct pm_frame *f, const struct pm_set *s, const struct pm_far *far, double c, const struct pm_bodies *b, size_t at)
{
	struct pm_field *change = pm_frame_field(f, s->name, far->change), *turning = far->turning && state_of(f, s, far->strength) ?
		pm_frame_field(f, s->name, far->turning) : NULL;
	double strain = 0;
	for (int d = 0; d < f->dim; d++) {
		double *y = pm_out(change, d), *r = turning ? pm_out(turning, d) : NULL;
		for (size_t i = 0; i < s->n; i++)
			y[i] -= c * b->gradient[d][at + i];
		for (size_t i = 0; r && i < s->n; i++)
			r[i] -= c * b->rate[d][at + i];
	}
	for (size_t i = 0; turning && i < s->n; i++) {
		double rate = 0, size = 0;
		for (int d = 0; d < 3; d++)
			rate = hypot(rate, c * b->rate[d][at + i]), size = hypot(size, b->alpha[d][at + i]);
		strain = size > 0 ? fmax(strain, rate / size) : strain;
	}
	pm_limits_add(change, (struct pm_limits){.strain = strain});
}

void pm_bodies_scatter(struct pm_frame *f, const struct pm_far *far, double coefficient, const struct pm_bodies *b)
{
	size_t at = 0;
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_set *s = f->sets[i];
		if (!is_target(f, s, far))
			continue;
		const struct pm_field *x = state_of(f, s, "x");
		const size_t here = at + x->first;
		if (far->vector && is_accelerated(f, s, far)) {
			add_vortices(f, s, far, coefficient, b, here);
		} else if (is_accelerated(f, s, far)) {
			const double rate = orbits(f, s, far, x, coefficient, b, here);
			add(f, s, far, coefficient, b, here);
			pm_limits_add(pm_frame_field(f, s->name, far->change), strcmp(far->of, "x") ?
				(struct pm_limits){.oscillation = sqrt(rate)} : (struct pm_limits){.strain = rate});
		}
		double *phi = b->potential ? pm_out(pm_frame_field(f, s->name, far->potential), 0) : NULL;
		for (size_t k = 0; phi && k < x->count; k++)
			phi[k] = coefficient * b->potential[here + k];
		for (int d = 0; d < 3 && b->psi[d]; d++) {
			double *psi = pm_out(pm_frame_field(f, s->name, far->potential), d);
			for (size_t k = 0; k < x->count; k++)
				psi[k] = -coefficient * b->psi[d][here + k];
		}
		at += s->n;
	}
}

void pm_bodies_free(struct pm_bodies *b)
{
	for (int d = 0; d < 3; d++)
		pm_free(b->x[d]), pm_free(b->gradient[d]), pm_free(b->alpha[d]), pm_free(b->rate[d]), pm_free(b->psi[d]);
	pm_free(b->q), pm_free(b->potential), pm_free(b->count), pm_free(b->own);
	*b = (struct pm_bodies){.n = 0};
}
