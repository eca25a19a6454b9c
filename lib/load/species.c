/* A species of a plasma: n particles, places from the density, velocities from the distribution, each through the inverse of its cumulative distribution,
 * of points that are even (Hammersley's, Sobol's) or random. A particle stands for W = (integral of the density)/n real ones: charge q W, mass m W.
 * Species with one density, n and sequence have the same places, so that they begin neutral everywhere. Cost n.
 * Source: Birdsall and Langdon 1985, chapter 16; Hammersley 1960; Sobol 1967. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "expression/expression.h"
#include "law/law.h"
#include "load/density-profile.h"
#include "load/inverse.h"
#include "load/species.h"
#include "stream/declare.h"
#include "stream/edit.h"
#include "stream/join.h"

struct loader { /* tables of the species; axes of the points: of space, then radial, then the others of the distribution */
	struct pm_density_profile density;
	struct pm_inverse f[3], radial;
	int axes, numbers;
	double *u[PM_LOAD_AXES];
};

static const size_t intervals = 65536;

static int state(struct pm_frame *f, const char *set, const char *name, int components, const char *unit, struct pm_field **field)
{
	*field = pm_makes(f, set, name, components, PM_STATE);
	if (*field)
		snprintf((*field)->unit, sizeof (*field)->unit, "%s", unit);
	return *field ? 0 : -PM_DATA;
}

static bool unequal(const struct pm_species *s) { return s->weighted && s->density; }

/* Real particles for which one stands, in the mean. */
static int weight_of(const struct pm_species *s, const struct pm_frame *f, double *weight)
{
	struct pm_density_profile p = {0};
	int status = s->density ? pm_density_profile_init(&p, f, s->density) : 0;
	double total = 1;
	for (int d = 0; d < f->dim; d++)
		total *= f->hi[d] - f->lo[d];
	*weight = s->n ? (s->density ? p.total : total) / (double)s->n : 0;
	pm_density_profile_free(&p);
	return status;
}

static void equal(struct pm_field *field, double value)
{
	field->uniform = true;
	field->value[0] = value;
}

int pm_species_declare(const struct pm_species *s, struct pm_frame *f)
{
	double weight = 0;
	const struct pm_set *old = pm_frame_set(f, s->name);
	const struct pm_law *law = pm_law_of(f);
	struct pm_field *x, *v, *m, *q, *id;
	if (!law)
		return -PM_DATA;
	if (old && old->n)
		return pm_fail(PM_DATA, "the set '%s' is there already, with %llu particles (another name; stack --merge makes one set of two)", s->name,
			(unsigned long long)old->n);
	if (pm_frame_mesh(f, s->name))
		return pm_fail(PM_DATA, "'%s' is a mesh of this frame (another name)", s->name);
	if (pm_frame_outdate(f))
		return -PM_DATA;
	if (old)
		pm_frame_remove(f, s->name);
	if (!pm_frame_set_new(f, s->name, s->n) || state(f, s->name, "x", f->dim, "length", &x) ||
		state(f, s->name, "v", s->choice.velocities, "length/time", &v) || state(f, s->name, "mass", 1, "mass", &m) ||
		state(f, s->name, "id", 1, "", &id) || state(f, s->name, "charge", 1, "charge", &q))
		return -PM_DATA;
	m->extensive = q->extensive = true;
	id->type = PM_I64;
	if (unequal(s))
		return 0;
	int status = weight_of(s, f, &weight);
	equal(m, s->mass * weight);
	equal(q, s->charge * weight);
	return status;
}

struct of_velocity {
	struct pm_expression e;
	struct pm_density_names names;
};

static double at_velocity(const void *data, double v)
{
	const struct of_velocity *of = data;
	double number[64];
	memcpy(number, of->names.number, sizeof number);
	number[0] = v;
	return pm_expression_number(&of->e, number);
}

/* Where f is above 1e-14 of its largest value: looked for at speeds that grow by 1 % from 1e-6 to 1e6 on both sides of 0. */
static int support(const struct of_velocity *of, const char *text, double range[2])
{
	enum { steps = 2800 };
	double most = 0;
	for (int pass = 0; pass < 2; pass++)
		for (int side = -1; side < 2; side += 2)
			for (int i = -1; i <= steps; i++) {
				const double v = i < 0 ? 0 : side * 1e-6 * exp(0.01 * i), f = at_velocity(of, v);
				if (!pass)
					most = isfinite(f) ? fmax(most, f) : most;
				else if (f > 1e-14 * most && side * v >= side * range[side > 0])
					range[side > 0] = i < 0 ? side * 1e-6 : side * 1e-6 * exp(0.01 * (i + 1));
			}
	if (!(most > 0))
		return pm_fail(PM_USAGE, "the distribution '%s' is 0 at all velocities looked at (give --range LOW,HIGH)", text);
	if (range[0] < -1e6 || range[1] > 1e6)
		return pm_fail(PM_USAGE, "the distribution '%s' does not fall to 0 (give --range LOW,HIGH)", text);
	return 0;
}

static int expression_table(const struct pm_species *s, const struct pm_frame *f, const char *text, struct pm_inverse *t)
{
	static const char *const variable[] = {"v", NULL};
	struct of_velocity of = {.names = {.f = f, .variable = variable, .n = 1}};
	double range[2] = {0, 0};
	char what[160];
	if (pm_expression_compile_numbers(&of.e, pm_density_name, &of.names, "number (v is the velocity)", text))
		return -PM_USAGE;
	if (s->range)
		memcpy(range, s->range, sizeof range);
	else if (support(&of, text, range))
		return -PM_USAGE;
	snprintf(what, sizeof what, "the distribution '%.120s'", text);
	return pm_inverse_init(t, intervals, range[0], range[1], at_velocity, &of, what);
}

static double radial_of(const void *data, double r)
{
	const struct pm_species *s = data;
	return s->distribution->radial(&s->choice, r);
}

static int prepare(const struct pm_species *s, const struct pm_frame *f, struct loader *l)
{
	const struct pm_distribution *d = s->distribution;
	double range[2];
	int status = s->density ? pm_density_profile_init(&l->density, f, s->density) : 0;
	for (int c = 0; c < s->choice.velocities && !status; c++)
		if (s->f[c])
			status = expression_table(s, f, s->f[c], &l->f[c]);
	if (!status && d->radial) {
		d->range(&s->choice, range);
		status = pm_inverse_init(&l->radial, intervals, range[0], range[1], radial_of, s, d->name);
	}
	l->numbers = d->numbers[s->choice.velocities];
	l->axes = f->dim + (d->radial != NULL) + l->numbers;
	l->u[0] = status ? NULL : pm_alloc((size_t)l->axes * s->n + 1, sizeof(double));
	for (int k = 1; k < l->axes; k++)
		l->u[k] = l->u[0] ? l->u[0] + (size_t)k * s->n : NULL;
	return status ? status : l->u[0] ? pm_scene_points(s->loading, s->seed, s->n, l->axes, l->u) : -PM_DATA;
}

/* Place and velocity of particle i. */
static void draw(const struct pm_species *s, const struct pm_frame *f, const struct loader *l, size_t i, double *x, double *v)
{
	double u[PM_LOAD_AXES];
	const double *rest = u + f->dim;
	for (int k = 0; k < l->axes; k++)
		u[k] = l->u[k][i];
	for (int d = 0; d < f->dim; d++)
		x[d] = f->lo[d] + (f->hi[d] - f->lo[d]) * u[d];
	if (s->density && !s->weighted)
		pm_density_profile_at(&l->density, u, x);
	for (int d = 0; d < f->dim; d++) /* rounding may reach the upper face, which in a periodic box is the lower one */
		x[d] = x[d] < f->hi[d] ? x[d] : f->face[d][0] == PM_PERIODIC ? f->lo[d] : nextafter(f->hi[d], f->lo[d]);
	double r = 0;
	if (s->distribution->radial)
		r = pm_inverse_at(&l->radial, *rest++);
	s->distribution->draw(&s->choice, r, rest, v);
	for (int c = 0; c < s->choice.velocities; c++)
		if (s->f[c])
			v[c] = s->choice.drift[c] + pm_inverse_at(&l->f[c], rest[c]);
}

static int fill(const struct pm_species *s, struct pm_frame *f, const struct loader *l, double *weight)
{
	struct pm_field *x = pm_frame_field(f, s->name, "x"), *v = pm_frame_field(f, s->name, "v"), *id = pm_frame_field(f, s->name, "id");
	const double c = pm_law_of(f)->relativistic ? pm_frame_constant(f, "c", 1) : HUGE_VAL;
	uint64_t first = 0, fast = 0;
	for (size_t k = 0; k < f->nsets && strcmp(f->sets[k]->name, s->name); k++)
		first += f->sets[k]->n;
#pragma omp parallel for schedule(static) reduction(+:fast) if (s->n > 1024)
	for (uint64_t i = 0; i < s->n; i++) {
		double at[3], w[3] = {0};
		draw(s, f, l, i, at, w);
		for (int d = 0; d < f->dim; d++)
			pm_out(x, d)[i] = at[d];
		for (int d = 0; d < s->choice.velocities; d++)
			pm_out(v, d)[i] = w[d];
		pm_out_i64(id, 0)[i] = (int64_t)(first + i);
		if (weight)
			weight[i] = pm_density_profile_value(&l->density, at);
		fast += !(w[0] * w[0] + w[1] * w[1] + w[2] * w[2] < c * c);
	}
	return fast ? pm_fail(PM_USAGE, "%llu of %llu particles would be faster than light, c = %g (a smaller --vth or --drift, or --distribution juettner)",
		(unsigned long long)fast, (unsigned long long)s->n, c) : 0;
}

/* w: the density where each particle is; becomes its mass, and charge. */
static int weigh(const struct pm_species *s, const struct pm_frame *f, double total, double *w)
{
	double *q = pm_out(pm_frame_field(f, s->name, "charge"), 0);
	const double sum = pm_sum_array(s->n, w);
	if (s->n && !(sum > 0))
		return pm_fail(PM_DATA, "no particle is where the density is not 0 (more particles, or equal weights)");
	for (uint64_t i = 0; i < s->n; i++) {
		const double each = total * (w[i] / sum);
		w[i] = s->mass * each;
		q[i] = s->charge * each;
	}
	return 0;
}

int pm_species_fill(const struct pm_species *s, struct pm_frame *f, double *weight)
{
	struct pm_field *m = pm_frame_field(f, s->name, "mass");
	struct loader l = {0};
	double *w = unequal(s) ? pm_out(m, 0) : NULL;
	int status = prepare(s, f, &l);
	status = status ? status : fill(s, f, &l, w);
	*weight = w ? s->n ? l.density.total / (double)s->n : 0 : m->value[0] / s->mass;
	if (!status && w)
		status = weigh(s, f, l.density.total, w);
	pm_density_profile_free(&l.density);
	pm_inverse_free(&l.radial);
	for (int d = 0; d < 3; d++)
		pm_inverse_free(&l.f[d]);
	pm_free(l.u[0]);
	return status;
}
