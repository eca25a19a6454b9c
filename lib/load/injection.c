/* Particles that come in during a step. Through a face: the half of a drifting Maxwellian that moves inward, normal velocities with the density
 * v exp(-(v - d)^2/(2 vth^2)), v > 0, so that its density of flux is
 *     n (vth exp(-d^2/(2 vth^2))/sqrt(2 pi) + d/2 (1 + erf(d/(sqrt 2 vth))));
 * each at a random moment of the step, from where it moves freely to the end. Under a law whose field currents change it stands in front of the current: then
 * it is put beyond the face, from where the drift to come takes it through the face at that moment; its current begins there (current-ways.c). In the volume:
 * a Maxwellian at random places. Step k has floor((k + 1) R) - floor(k R) particles, R = flux area dt/weight, which depends on the header alone: a run that is
 * interrupted goes on with the same ones.
 * Random numbers are functions of (seed, set, face, step, number). Source: Birdsall and Langdon 1985, section 16-3; Bird 1994, section 4.2 (flux).
 * Cost: the particles that come in, and a pass over ids. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "expression/expression.h"
#include "law/law.h"
#include "load/density-profile.h"
#include "load/inverse.h"
#include "load/injection.h"
#include "load/newcomers.h"
#include "push/electrode-charge.h"
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
	bool current;             /* the drift of this step is to come, and a current with it */
	double c;                 /* [length/time] HUGE_VAL without */
	struct pm_newcomers room; /* for all that come, of which a share is taken */
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

static int refuse(const struct pm_injection *s, const struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return -PM_DATA;
	if (law->evolves && s->axis < 0)
		return pm_fail(PM_DATA, "a charge that appears in the volume breaks Gauss's law, and '%s' has no other (a face: --at x-low)", f->law);
	if (!(f->dt > 0))
		return pm_fail(PM_DATA, "the time step is %g, and particles come in per time (smod --dt)", f->dt);
	if (s->axis >= f->dim)
		return pm_fail(PM_DATA, "a face along %c in %d-D", 'x' + s->axis, f->dim);
	if (s->axis >= 0 && f->pface[s->axis][s->side] == PM_PFOLD)
		return pm_fail(PM_DATA, "the %s face along %c is periodic: nothing is beyond it (--at volume, or smod --faces, --particle-faces absorb)",
			s->side ? "high" : "low", 'x' + s->axis);
	return 0;
}

static struct pm_newcomers newcomers(const struct pm_injection *s)
{
	return (struct pm_newcomers){.set = s->set, .velocities = s->velocities, .equal = true, .mass = s->mass * s->weight, .charge = s->charge * s->weight};
}

/* With a current: after the first half of the kick, before J and the drift. */
static int in_front_of_current(const struct pm_frame *f, const struct pm_set *set)
{
	bool made = false;
	for (size_t i = 0; i < f->nfields; i++)
		made = made || (pm_frame_mesh(f, f->fields[i]->on) && f->fields[i]->role == PM_CHANGE);
	return f->substep && !(set->drift > 0) && !made ? 0
		: pm_fail(PM_DATA, "under the law '%s' inject stands in front of the current (push boris/2 | inject | p2m --current | maxwell | push drift | "
			"m2p | push boris/2)", f->law);
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
	const bool current = pm_law_of(f)->evolves;
	if (current && (status = in_front_of_current(f, set)))
		return status;
	if (f->substep && !current && !(set->drift > 1 - 1e-9))
		return PM_INJECTION_WAITS;
	if (v)
		s->velocities = v->components;
	if (f->substep) /* behind the drift: the next force includes those that came in */
		pm_drops_roles(f, NULL, 1u << PM_CHANGE | 1u << PM_DERIVED);
	if (current) /* the kick has used them, and m2p makes them anew */
		pm_drops_roles(f, s->set, 1u << PM_CHANGE);
	for (size_t i = 0; i < f->nfields && f->substep; i++)
		if (!strcmp(f->fields[i]->on, s->set) && (f->fields[i]->role == PM_CHANGE || f->fields[i]->role == PM_REGISTER))
			return pm_fail(PM_DATA, "'%s' has '%s' already, which new particles lack (put inject behind the drift, in front of the forces)", s->set,
				f->fields[i]->name);
	status = !f->substep && pm_frame_outdate(f) ? -PM_DATA : weigh(s, f, set);
	const struct pm_newcomers a = newcomers(s);
	status = status ? status : pm_newcomers_declare(f, &a);
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
	a->key = s->seed ^ (uint64_t)pm_crc32c(0, s->set, strlen(s->set)) << 20 ^ (uint64_t)(2 * (s->axis + 1) + s->side) << 56;
	if (s->axis >= 0 && s->vth[s->axis] > 0 && inward(s) != 0) {
		const double d = inward(s), w = 10 * s->vth[s->axis];
		status = pm_inverse_init(&a->normal, 8192, fmax(0, d - w), fmax(0, d) + w, normal_density, s, "the distribution of the flux");
	}
	a->names = (struct pm_density_names){.f = f, .variable = variable, .n = 4};
	if (!status && s->share)
		status = pm_expression_compile_numbers(&a->share, pm_density_name, &a->names, "number (of a place: x y z, time)", s->share);
	a->room = newcomers(s);
	status = status ? status : pm_newcomers_room(f, &a->room, (uint64_t)n);
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
		x[s->axis] += v[s->axis] * f->dt * (a->current ? u[6] - 1 : u[6]);
	return u[7] < share;
}

static int take(struct arrivals *a, struct pm_frame *f, uint64_t *came)
{
	const struct pm_injection *s = a->s;
	for (uint64_t i = 0; i < a->room.room; i++) {
		double x[3], v[3];
		const int taken = arrive(a, i, x, v);
		if (taken < 0)
			return pm_fail(PM_DATA, "the share '%s' is not between 0 and 1 everywhere", s->share);
		if (taken && v[0] * v[0] + (s->velocities > 1 ? v[1] * v[1] : 0) + (s->velocities > 2 ? v[2] * v[2] : 0) >= a->c * a->c)
			return pm_fail(PM_DATA, "a particle comes in faster than light, c = %g (--drift, --vth)", a->c);
		const double end = s->axis < 0 ? 0 : x[s->axis] + (a->current ? v[s->axis] * f->dt : 0);
		if (taken && s->axis >= 0 && !(end >= f->lo[s->axis] && end <= f->hi[s->axis]))
			return pm_fail(PM_DATA, "a particle that comes in at %g crosses the whole box within a step (a shorter --dt)", v[s->axis]);
		for (int d = 0; d < f->dim && taken; d++)
			a->room.x[d][a->room.n] = x[d];
		for (int d = 0; d < s->velocities && taken; d++)
			a->room.v[d][a->room.n] = v[d];
		a->room.n += (uint64_t)taken;
	}
	*came = a->room.n;
	return pm_newcomers_append(&a->room, f);
}

int pm_injection_step(struct pm_injection *s, struct pm_frame *f, uint64_t *came)
{
	const struct pm_law *law = pm_law_of(f);
	struct arrivals a = {.s = s, .f = f, .current = law->evolves, .c = law->relativistic ? pm_frame_constant(f, "c", 1) : HUGE_VAL};
	*came = 0;
	int status = weigh(s, f, pm_frame_set(f, s->set));
	status = status ? status : prepare(&a);
	status = status ? status : take(&a, f, came);
	if (!status && s->axis >= 0 && pm_electrode(f, s->axis, s->side))
		pm_electrode_add(f, s->axis, s->side, -s->charge * s->weight * (double)*came);
	pm_inverse_free(&a.normal);
	pm_newcomers_free(&a.room);
	return status;
}
