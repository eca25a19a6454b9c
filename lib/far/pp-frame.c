/* Direct summation in a frame: the law gives strength, factor and sign, and names the mollifier. Cost: that of the sum (pp.c).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "far/bodies.h"
#include "far/pp-frame.h"
#include "far/pp-periodic.h"
#include "far/pp-vortex.h"
#include "far/pp.h"
#include "far/wall-images.h"
#include "law/law.h"
#include "stream/acting-forces.h"
#include "stream/declare.h"
#include "world/world.h"

static struct pm_far far_of(const struct pm_law *law, const struct pm_pp_choice *c)
{
	return (struct pm_far){.strength = law->strength, .per = law->per, .change = law->change, .of = law->of, .potential = law->potential,
		.curl = law->of_potential == PM_CURL, .sign = law->sign, .set = c->set, .with_potential = c->potential,
		.vector = law->vector, .turning = law->vector && c->form != PM_PP_NONE ? "dalpha" : NULL};
}

/* Open, or a half of it beside one wall. */
static bool open_along(const struct pm_frame *f, int axis)
{
	return (f->face[axis][0] == PM_OPEN && f->face[axis][1] == PM_OPEN) || pm_wall_alone(f, axis);
}

int pm_pp_periodic_axis(const struct pm_frame *f)
{
	for (int a = 0; a < f->dim; a++)
		if (f->dim == 2 && f->face[a][0] == PM_PERIODIC && open_along(f, !a))
			return a;
	return -1;
}

static int open_space(const struct pm_frame *f)
{
	for (int a = 0; a < f->dim; a++)
		if (!open_along(f, a) && pm_pp_periodic_axis(f) != a)
			return pm_fail(PM_DATA, "the box is %s along %c, but pp sums in open space, beside one wall an axis, or in the plane with one periodic "
				"axis (use p2m | poisson-fft | mgrad | m2p)", pm_face_names[f->face[a][0]], "xyz"[a]);
	return 0;
}

/* Core spreading: exp(-r^2/delta^2)/(pi delta^2) solves the heat equation if delta^2 grows by 4 nu a time, in the plane and in space (Kuwahara and Takami
 * 1973, J. Phys. Soc. Japan 34, 247). The cores are those of the frame's time, in Runge-Kutta schemes of the pass. */
static int spread(const struct pm_pp_choice *c, const struct pm_frame *f, const struct pm_law *law, struct pm_pp *p)
{
	const double age = f->time - c->spreading, nu = pm_frame_constant(f, "nu", 0);
	if (law->of_potential != PM_CURL)
		return pm_fail(PM_DATA, "--core-spreading is the viscosity of vortices, and the law is %s (leave it out)", f->law);
	if (strcmp(p->mollifier->name, "gaussian"))
		return pm_fail(PM_DATA, "cores of the mollifier %s do not spread as the heat equation has it (--mollifier gaussian)", p->mollifier->name);
	if (!(p->delta >= 0))
		return pm_fail(PM_DATA, "no softening length from which the cores spread (--softening LENGTH)");
	if (age < 0)
		return pm_fail(PM_DATA, "the cores have their softening at time %g, and it is %g (--core-spreading of an earlier time)", c->spreading, f->time);
	p->delta = sqrt(p->delta * p->delta + 4 * nu * age);
	return 0;
}

/* What to sum, from the law, the frame and the options. */
static int method(const struct pm_pp_choice *c, const struct pm_frame *f, const struct pm_law *law, struct pm_pp *p)
{
	const bool spreads = !isnan(c->spreading);
	const char *name = c->mollifier ? c->mollifier : spreads ? "gaussian" : law->mollifier ? law->mollifier : "plummer";
	*p = (struct pm_pp){.dim = f->dim, .half = c->half, .mollifier = pm_mollifier_find(name)};
	if (!p->mollifier)
		return -PM_DATA;
	if (!(p->mollifier->dims >> f->dim & 1))
		return pm_fail(PM_DATA, "the mollifier %s is not defined in %d-D (plummer, rankine and gaussian are)", name, f->dim);
	if (law->vector && !p->mollifier->slope)
		return pm_fail(PM_DATA, "the mollifier %s has no smoothed velocity gradient, which stretches (gaussian, algebraic)", name);
	if (pm_pp_periodic_axis(f) >= 0 && !p->mollifier->square)
		return pm_fail(PM_DATA, "the mollifier %s has no sum over periodic images (krasny and none have)", name);
	if (p->mollifier->bare && !spreads)
		return 0;
	p->delta = isnan(c->softening) ? pm_frame_constant(f, "softening", NAN) : c->softening;
	if (!(p->delta >= 0) && !law->vector)
		return pm_fail(PM_DATA, "no softening length (--softening LENGTH, which may be 0; smod --constant softening=LENGTH for the frame; or "
			"--mollifier none)");
	return spreads ? spread(c, f, law, p) : 0;
}

static const struct pm_field *volume_of(const struct pm_frame *f, const struct pm_set *set, const struct pm_law *law)
{
	const struct pm_field *q = pm_frame_field(f, set->name, law->strength);
	return q && q->role == PM_STATE ? pm_frame_field(f, set->name, "volume") : NULL;
}

/* Vortices without a core of their own get one from their volumes, which must be there. */
static int read_volumes(struct pm_frame *f, const struct pm_law *law)
{
	size_t found = 0;
	for (size_t i = 0; i < f->nsets; i++)
		if (volume_of(f, f->sets[i], law) && pm_reads(f, f->sets[i]->name, "volume"))
			found++;
	return found ? 0 : pm_fail(PM_DATA, "no softening length and no 'volume' that a core could follow from (--softening LENGTH; remesh gives volumes)");
}

static int core_of(const struct pm_frame *f, const struct pm_law *law, double overlap, double *core)
{
	struct pm_sum sum = {0};
	uint64_t n = 0;
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_field *volume = volume_of(f, f->sets[i], law);
		for (size_t k = 0; volume && k < f->sets[i]->n; k++, n++)
			pm_sum_add(&sum, pm_in(volume, 0)[k]);
	}
	*core = n ? overlap * cbrt(pm_sum_total(sum) / (double)n) : 0;
	return !n || *core > 0 ? 0 : pm_fail(PM_DATA, "the volumes have the mean %g, from which no core follows (--softening LENGTH)",
		pm_sum_total(sum) / (double)n);
}

/* The smoothing goes with the change where it is not the frame's. */
static void tell(const struct pm_pp_choice *c, struct pm_frame *f, const struct pm_law *law, const struct pm_pp *p)
{
	const bool softened = !p->mollifier->bare && !isnan(p->delta) && p->delta != pm_frame_constant(f, "softening", 0);
	const bool other = strcmp(p->mollifier->name, law->mollifier ? law->mollifier : "plummer") != 0;
	for (size_t i = 0; i < f->nsets; i++) {
		struct pm_field *change = c->set && strcmp(c->set, f->sets[i]->name) ? NULL : pm_frame_field(f, f->sets[i]->name, law->change);
		if (change && change->role == PM_CHANGE)
			pm_acting_smooth(change, softened ? p->delta : NAN, other ? p->mollifier->name : NULL);
	}
}

int pm_pp_declare(const struct pm_pp_choice *c, struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	struct pm_pp p;
	int status = law ? open_space(f) : -PM_DATA;
	if (!status && !(law->strength && law->change && law->coefficient && law->dims >> f->dim & 1))
		return pm_fail(PM_DATA, "the law %s has no sum over pairs in %d-D", f->law, f->dim);
	if (!status)
		status = method(c, f, law, &p);
	if (!status && isnan(p.delta))
		status = read_volumes(f, law);
	if (status)
		return status;
	const struct pm_far far = far_of(law, c);
	status = pm_far_plan(f, &far, "self", c->replace);
	if (!status)
		tell(c, f, law, &p);
	return status;
}

static int vortices(const struct pm_pp_choice *c, const struct pm_pp *p, struct pm_bodies *b, uint64_t *coincident)
{
	const struct pm_pp_vortex v = {.delta = p->delta, .mollifier = p->mollifier, .form = (enum pm_pp_form)c->form};
	struct pm_pp_vortex_sums to = {.coincident = 0};
	for (int d = 0; d < 3; d++)
		to.velocity[d] = b->gradient[d], to.stretching[d] = b->rate[d], to.psi[d] = b->psi[d];
	int status = pm_pp_vortex_sum(&v, b->targets, b->n, (const double *const *)b->x, (const double *const *)b->alpha, &to);
	*coincident = to.coincident;
	return status;
}

static int plane_with_images(const struct pm_pp *p, const struct pm_frame *f, int axis, struct pm_bodies *b, uint64_t *coincident)
{
	const struct pm_pp_periodic row = {.axis = axis, .period = f->hi[axis] - f->lo[axis], .delta = p->mollifier->bare ? 0 : p->delta};
	return pm_pp_periodic_sum(&row, b->targets, b->n, (const double *const *)b->x, b->q, b->gradient, b->potential, coincident);
}

int pm_pp_apply(const struct pm_pp_choice *c, struct pm_frame *f, struct pm_pp_done *done)
{
	const struct pm_law *law = pm_law_of(f);
	const struct pm_far far = far_of(law, c);
	struct pm_bodies b;
	struct pm_pp p;
	*done = (struct pm_pp_done){0};
	int status = method(c, f, law, &p);
	if (!status && isnan(p.delta)) {
		status = core_of(f, law, c->overlap, &done->core);
		p.delta = done->core;
	}
	if (status)
		return status;
	status = pm_bodies_gather(f, &far, &b);
	if (!status && (status = pm_wall_images(f, &far, &b)))
		pm_bodies_free(&b);
	p.sets = b.sets, p.count = b.count, p.own = b.own;
	if (!status && law->vector)
		status = vortices(c, &p, &b, &done->coincident);
	else if (!status && pm_pp_periodic_axis(f) >= 0)
		status = plane_with_images(&p, f, pm_pp_periodic_axis(f), &b, &done->coincident);
	else if (!status)
		status = pm_pp_sum(&p, b.targets, b.n, (const double *const *)b.x, b.q, b.gradient, b.potential, &done->coincident);
	int64_t pairs = (int64_t)done->coincident;
	status = pm_world_count(status, PM_SUM_OF, 1, &pairs);
	done->coincident = (uint64_t)pairs;
	if (!status)
		pm_bodies_scatter(f, &far, law->coefficient(f), &b);
	pm_bodies_free(&b);
	return status;
}
