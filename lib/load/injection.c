/* Particles that come in during a step. Through a face: the half of a drifting Maxwellian that moves inward, normal velocities with the density
 * v exp(-(v - d)^2/(2 vth^2)), v > 0, so that its density of flux is
 *     n (vth exp(-d^2/(2 vth^2))/sqrt(2 pi) + d/2 (1 + erf(d/(sqrt 2 vth))));
 * each at a random moment of the step, from where it moves freely to the end. In the volume: a Maxwellian at random places. Step k has
 * floor((k + 1) R) - floor(k R) particles, R = flux area dt/weight, which depends on the header alone: a run that is interrupted goes on with the same ones.
 * Random numbers are functions of (seed, set, face, step, number). Source: Birdsall and Langdon 1985, section 16-3; Bird 1994, section 4.2 (flux).
 * Cost: the particles that come in, and a pass over ids. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "expression/expression.h"
#include "law/law.h"
#include "load/density-profile.h"
#include "load/inverse.h"
#include "load/injection.h"
#include "push/electrode-charge.h"
#include "push/push-set.h"
#include "scene-parts/scene-loading.h"
#include "stream/declare.h"
#include "stream/edit.h"

struct arrivals {
	const struct pm_injection *s;
	const struct pm_frame *f;
	struct pm_inverse normal; /* of velocities through the face; unused without a drift along it */
	struct pm_expression share;
	struct pm_density_names names;
	uint64_t key;
	uint64_t n; /* that come, of which a share is taken */
	double *x[3], *v[3];
};

double pm_injection_flux(double d, double vth)
{
	if (!(vth > 0))
		return fmax(0, d);
	return vth * exp(-0.5 * (d / vth) * (d / vth)) / sqrt(2 * pm_pi) + 0.5 * d * erfc(-d / (sqrt(2) * vth));
}

static double inward(const struct pm_injection *s) { return s->side ? -s->drift[s->axis] : s->drift[s->axis]; }

/* Real particles a step. */
static double arriving(const struct pm_injection *s, const struct pm_frame *f)
{
	double size = 1;
	for (int d = 0; d < f->dim; d++)
		size *= d == s->axis ? 1 : f->hi[d] - f->lo[d];
	return size * f->dt * (isfinite(s->flux) ? s->flux : s->density * pm_injection_flux(inward(s), s->vth[s->axis]));
}

static bool alike(double a, double b) { return fabs(a - b) <= 1e-12 * fabs(b); }

static int weigh(struct pm_injection *s, const struct pm_frame *f, const struct pm_set *set)
{
	const struct pm_field *q = set && set->n ? pm_frame_field(f, s->set, "charge") : NULL, *m = q ? pm_frame_field(f, s->set, "mass") : NULL;
	if (isfinite(s->number))
		s->weight = arriving(s, f) / s->number;
	else if (!isfinite(s->weight) && m && m->uniform && q->uniform && alike(q->value[0], s->charge * (m->value[0] / s->mass)))
		s->weight = m->value[0] / s->mass;
	if (!(s->weight > 0 && isfinite(s->weight)))
		return isfinite(s->number) ? pm_fail(PM_DATA, "nothing comes in: the flux is 0 (--density, --drift inward)")
			: pm_fail(PM_DATA, "no particle of '%s' shows for how many of these real ones it stands (-w, or -n particles a step)", s->set);
	return 0;
}

static int make_set(const struct pm_injection *s, struct pm_frame *f)
{
	static const struct { const char *name, *unit; } row[] = {{"x", "length"}, {"v", "length/time"}, {"mass", "mass"}, {"charge", "charge"}, {"id", ""}};
	const int components[] = {f->dim, s->velocities, 1, 1, 1};
	if (!pm_frame_set(f, s->set) && !pm_frame_set_new(f, s->set, 0))
		return -PM_DATA;
	for (int i = 0; i < 5; i++) {
		const struct pm_field *old = pm_frame_field(f, s->set, row[i].name);
		struct pm_field *field = pm_makes(f, s->set, row[i].name, i == 1 && old ? old->components : components[i], PM_STATE);
		if (!field)
			return -PM_DATA;
		snprintf(field->unit, sizeof field->unit, "%s", row[i].unit);
		field->type = i == 4 ? PM_I64 : PM_F64;
		field->extensive = field->uniform = i == 2 || i == 3;
		field->value[0] = (i == 2 ? s->mass : s->charge) * s->weight;
	}
	return 0;
}

/* The fields of a set that has particles: all are held, and those of new values made one a particle. */
static int grow(const struct pm_injection *s, struct pm_frame *f, struct pm_set *set)
{
	static const char *const own[] = {"x", "v", "mass", "charge", "id", NULL};
	const struct pm_moving m = {.set = set};
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *field = f->fields[i];
		bool known = strcmp(field->on, s->set) != 0 || field->uniform;
		for (int k = 0; own[k]; k++)
			known = known || !strcmp(field->name, own[k]);
		if (!known)
			return pm_fail(PM_DATA, "new particles have no '%s', which '%s' has (sel --drop %s)", field->name, s->set, field->name);
	}
	for (int k = 0; own[k]; k++) {
		const struct pm_field *field = pm_frame_field(f, s->set, own[k]);
		const double value = k == 2 ? s->mass * s->weight : s->charge * s->weight;
		if (!field)
			return pm_fail(PM_DATA, "'%s' has no '%s' (species makes sets with x, v, mass, charge and id)", s->set, own[k]);
		if (field->uniform && (k < 2 || k > 3 || !alike(field->value[0], value)) && !pm_changes(f, s->set, own[k]))
			return -PM_DATA;
	}
	return pm_moving_shrinks(f, &m);
}

static int refuse(const struct pm_injection *s, const struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return -PM_DATA;
	if (law->relativistic)
		return pm_fail(PM_DATA, "inject puts no current on the mesh, which the law '%s' needs (smod --law electrostatic)", f->law);
	if (!(f->dt > 0))
		return pm_fail(PM_DATA, "the time step is %g, and particles come in per time (smod --dt)", f->dt);
	if (s->axis >= f->dim)
		return pm_fail(PM_DATA, "a face along %c in %d-D", 'x' + s->axis, f->dim);
	if (s->axis >= 0 && f->pface[s->axis][s->side] == PM_PFOLD)
		return pm_fail(PM_DATA, "the %s face along %c is periodic: nothing is beyond it (--at volume, or smod --faces, --particle-faces absorb)",
			s->side ? "high" : "low", 'x' + s->axis);
	return pm_frame_mesh(f, s->set) ? pm_fail(PM_DATA, "'%s' is a mesh of this frame (another name)", s->set) : 0;
}

int pm_injection_declare(struct pm_injection *s, struct pm_frame *f)
{
	struct pm_set *set = pm_frame_set(f, s->set);
	const struct pm_field *v = pm_frame_field(f, s->set, "v");
	int status = refuse(s, f);
	if (status)
		return status;
	if (f->substep && !set)
		return pm_fail(PM_DATA, "no set '%s' (species %s -n 0 in front of the steps makes it)", s->set, s->set);
	if (f->substep && !(set->drift > 1 - 1e-9))
		return PM_INJECTION_WAITS;
	if (v)
		s->velocities = v->components;
	if (f->substep) /* behind the drift: the next force includes those that came in */
		pm_drops_roles(f, NULL, 1u << PM_CHANGE | 1u << PM_DERIVED);
	for (size_t i = 0; i < f->nfields && f->substep; i++)
		if (!strcmp(f->fields[i]->on, s->set) && (f->fields[i]->role == PM_CHANGE || f->fields[i]->role == PM_REGISTER))
			return pm_fail(PM_DATA, "'%s' has '%s' already, which new particles lack (put inject behind the drift, in front of the forces)", s->set,
				f->fields[i]->name);
	status = !f->substep && pm_frame_outdate(f) ? -PM_DATA : weigh(s, f, set);
	for (size_t i = 0; i < f->nsets && !status; i++)
		if (pm_frame_field(f, f->sets[i]->name, "id") && !pm_reads(f, f->sets[i]->name, "id"))
			status = -PM_DATA;
	status = status ? status : set && set->n ? grow(s, f, set) : make_set(s, f);
	return status ? status : PM_INJECTION_ACTS;
}

static double normal_density(const void *data, double v)
{
	const struct pm_injection *s = data;
	const double z = (v - inward(s)) / s->vth[s->axis];
	return v * exp(-0.5 * z * z);
}

static int prepare(struct arrivals *a)
{
	static const char *const variable[] = {"x", "y", "z", "time", NULL};
	const struct pm_injection *s = a->s;
	const struct pm_frame *f = a->f;
	const double rate = arriving(s, f) / s->weight, k = (double)f->step, n = floor((k + 1) * rate) - floor(k * rate);
	int status = 0;
	if (!(n < 1e9))
		return pm_fail(PM_DATA, "%g particles a step (a larger -w)", n);
	a->n = (uint64_t)n;
	a->key = s->seed ^ (uint64_t)pm_crc32c(0, s->set, strlen(s->set)) << 20 ^ (uint64_t)(2 * (s->axis + 1) + s->side) << 56;
	if (s->axis >= 0 && s->vth[s->axis] > 0 && inward(s) != 0) {
		const double d = inward(s), w = 10 * s->vth[s->axis];
		status = pm_inverse_init(&a->normal, 8192, fmax(0, d - w), fmax(0, d) + w, normal_density, s, "the distribution of the flux");
	}
	a->names = (struct pm_density_names){.f = f, .variable = variable, .n = 4};
	if (!status && s->share)
		status = pm_expression_compile_numbers(&a->share, pm_density_name, &a->names, "number (of a place: x y z, time)", s->share);
	for (int d = 0; d < 3 && !status; d++) {
		a->x[d] = d < f->dim ? pm_alloc(a->n + 1, sizeof(double)) : NULL;
		a->v[d] = d < s->velocities ? pm_alloc(a->n + 1, sizeof(double)) : NULL;
		status = (d < f->dim && !a->x[d]) || (d < s->velocities && !a->v[d]) ? -PM_DATA : 0;
	}
	return status;
}

/* Speed through the face. */
static double through(const struct arrivals *a, double u)
{
	const struct pm_injection *s = a->s;
	const double vth = s->vth[s->axis];
	return !(vth > 0) ? inward(s) : a->normal.n ? pm_inverse_at(&a->normal, u) : vth * sqrt(-2 * log(u));
}

/* Place and velocity of arrival i. Is it taken? -1: the share is no share. */
static int arrive(const struct arrivals *a, uint64_t i, double x[3], double v[3])
{
	const struct pm_injection *s = a->s;
	const struct pm_frame *f = a->f;
	double u[8], share = 1;
	for (int k = 0; k < 4; k++)
		pm_random(a->key, i, (uint64_t)f->step * 4 + (uint64_t)k, u + 2 * k);
	for (int d = 0; d < f->dim; d++)
		x[d] = fmin(f->lo[d] + (f->hi[d] - f->lo[d]) * u[d], nextafter(f->hi[d], f->lo[d]));
	for (int d = 0; d < s->velocities; d++)
		v[d] = s->drift[d] + (s->vth[d] > 0 ? s->vth[d] * pm_scene_normal_of(u[3 + d]) : 0);
	if (s->axis >= 0) {
		const double speed = through(a, u[3 + s->axis]), sign = s->side ? -1 : 1;
		v[s->axis] = sign * speed;
		x[s->axis] = s->side ? f->hi[s->axis] : f->lo[s->axis];
	}
	if (s->share) {
		double number[64];
		memcpy(number, a->names.number, sizeof number);
		for (int d = 0; d < 3; d++)
			number[d] = d < f->dim ? x[d] : 0;
		number[3] = f->time;
		share = pm_expression_number(&a->share, number);
		if (!(share >= 0 && share <= 1))
			return -1;
	}
	if (s->axis >= 0)
		x[s->axis] += v[s->axis] * f->dt * u[6];
	return u[7] < share;
}

static int64_t next_id(const struct pm_frame *f)
{
	int64_t most = -1;
	for (size_t k = 0; k < f->nsets; k++) {
		const struct pm_field *id = pm_frame_field(f, f->sets[k]->name, "id");
		if (!id || id->type != PM_I64 || !id->count)
			continue;
		const int64_t *number = pm_in_i64(id, 0);
#pragma omp parallel for schedule(static) reduction(max:most) if (id->count > 16384)
		for (size_t i = 0; i < id->count; i++)
			most = number[i] > most ? number[i] : most;
	}
	return most + 1;
}

/* The first `came` places and velocities of a become the last particles of the set. */
static int append(const struct arrivals *a, struct pm_frame *f, uint64_t came)
{
	const struct pm_injection *s = a->s;
	struct pm_set *set = pm_frame_set(f, s->set);
	const uint64_t old = set->n;
	const int64_t first = next_id(f);
	if (pm_frame_set_resize(f, set, old + came))
		return -PM_DATA;
	struct pm_field *x = pm_frame_field(f, s->set, "x"), *v = pm_frame_field(f, s->set, "v"), *id = pm_frame_field(f, s->set, "id");
	for (int d = 0; d < f->dim; d++)
		memcpy(pm_out(x, d) + old, a->x[d], came * sizeof(double));
	for (int d = 0; d < s->velocities; d++)
		memcpy(pm_out(v, d) + old, a->v[d], came * sizeof(double));
	for (uint64_t i = 0; i < came; i++)
		pm_out_i64(id, 0)[old + i] = first + (int64_t)i;
	for (int k = 0; k < 2; k++) {
		struct pm_field *strength = pm_frame_field(f, s->set, k ? "charge" : "mass");
		double *value = strength->uniform ? NULL : pm_out(strength, 0);
		for (uint64_t i = 0; value && i < came; i++)
			value[old + i] = (k ? s->charge : s->mass) * s->weight;
	}
	return 0;
}

static int take(struct arrivals *a, struct pm_frame *f, uint64_t *came)
{
	const struct pm_injection *s = a->s;
	for (uint64_t i = 0; i < a->n; i++) {
		double x[3], v[3];
		const int taken = arrive(a, i, x, v);
		if (taken < 0)
			return pm_fail(PM_DATA, "the share '%s' is not between 0 and 1 everywhere", s->share);
		if (taken && s->axis >= 0 && !(x[s->axis] >= f->lo[s->axis] && x[s->axis] <= f->hi[s->axis]))
			return pm_fail(PM_DATA, "a particle that comes in at %g crosses the whole box within a step (a shorter --dt)", v[s->axis]);
		for (int d = 0; d < f->dim && taken; d++)
			a->x[d][*came] = x[d];
		for (int d = 0; d < s->velocities && taken; d++)
			a->v[d][*came] = v[d];
		*came += taken;
	}
	return append(a, f, *came);
}

int pm_injection_step(struct pm_injection *s, struct pm_frame *f, uint64_t *came)
{
	struct arrivals a = {.s = s, .f = f};
	*came = 0;
	int status = weigh(s, f, pm_frame_set(f, s->set));
	status = status ? status : prepare(&a);
	status = status ? status : take(&a, f, came);
	if (!status && s->axis >= 0 && pm_electrode(f, s->axis, s->side))
		pm_electrode_add(f, s->axis, s->side, -s->charge * s->weight * (double)*came);
	pm_inverse_free(&a.normal);
	for (int d = 0; d < 3; d++) {
		pm_free(a.x[d]);
		pm_free(a.v[d]);
	}
	return status;
}
