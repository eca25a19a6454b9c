/* Direct summation in a frame: the law gives strength, factor and sign, and names the mollifier. Cost: that of the sum (pp.c).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "far/bodies.h"
#include "far/pp-frame.h"
#include "far/pp.h"
#include "law/law.h"
#include "stream/acting-forces.h"
#include "world/world.h"

static struct pm_far far_of(const struct pm_law *law, const struct pm_pp_choice *c)
{
	return (struct pm_far){.strength = law->strength, .per = law->per, .change = law->change, .of = law->of, .potential = law->potential,
		.curl = law->of_potential == PM_CURL, .sign = law->sign, .set = c->set, .with_potential = c->potential};
}

static int open_space(const struct pm_frame *f)
{
	for (int a = 0; a < 2 * f->dim; a++)
		if (f->face[a / 2][a % 2] != PM_OPEN)
			return pm_fail(PM_DATA, "the box is %s along %c, but pp sums in open space (use p2m | poisson-fft | "
				"mgrad | m2p)", pm_face_names[f->face[a / 2][a % 2]], "xyz"[a / 2]);
	return 0;
}

/* What to sum, from the law, the frame and the options. */
static int method(const struct pm_pp_choice *c, const struct pm_frame *f, const struct pm_law *law, struct pm_pp *p)
{
	const char *name = c->mollifier ? c->mollifier : law->mollifier ? law->mollifier : "plummer";
	*p = (struct pm_pp){.dim = f->dim, .half = c->half, .mollifier = pm_mollifier_find(name)};
	if (!p->mollifier)
		return -PM_DATA;
	if (!(p->mollifier->dims >> f->dim & 1))
		return pm_fail(PM_DATA, "the mollifier %s is not defined in %d-D (plummer, rankine and gaussian are)", name, f->dim);
	if (p->mollifier->bare)
		return 0;
	p->delta = isnan(c->softening) ? pm_frame_constant(f, "softening", NAN) : c->softening;
	if (!(p->delta >= 0))
		return pm_fail(PM_DATA, "no softening length (--softening LENGTH, which may be 0; smod --constant softening=LENGTH for the frame; or "
			"--mollifier none)");
	return 0;
}

/* The smoothing goes with the change where it is not the frame's. */
static void tell(const struct pm_pp_choice *c, struct pm_frame *f, const struct pm_law *law, const struct pm_pp *p)
{
	const bool softened = !p->mollifier->bare && p->delta != pm_frame_constant(f, "softening", 0);
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
	if (!status && law->vector)
		return pm_fail(PM_DATA, "pp sums scalar strengths, and '%s' is a vector (p2m | poisson-fft | mgrad | stretch | m2p)", law->strength);
	if (!status && !(law->strength && law->change && law->coefficient && law->dims >> f->dim & 1))
		return pm_fail(PM_DATA, "the law %s has no sum over pairs in %d-D", f->law, f->dim);
	if (!status)
		status = method(c, f, law, &p);
	if (status)
		return status;
	const struct pm_far far = far_of(law, c);
	status = pm_far_plan(f, &far, "self", c->replace);
	if (!status)
		tell(c, f, law, &p);
	return status;
}

int pm_pp_apply(const struct pm_pp_choice *c, struct pm_frame *f, uint64_t *coincident)
{
	const struct pm_law *law = pm_law_of(f);
	const struct pm_far far = far_of(law, c);
	struct pm_bodies b;
	struct pm_pp p;
	int status = method(c, f, law, &p);
	if (status)
		return status;
	status = pm_bodies_gather(f, &far, &b);
	p.sets = b.sets, p.count = b.count, p.own = b.own;
	if (!status)
		status = pm_pp_sum(&p, b.targets, b.n, (const double *const *)b.x, b.q, b.gradient, b.potential, coincident);
	int64_t pairs = (int64_t)*coincident;
	status = pm_world_count(status, PM_SUM_OF, 1, &pairs);
	*coincident = (uint64_t)pairs;
	if (!status)
		pm_bodies_scatter(f, &far, law->coefficient(f), &b);
	pm_bodies_free(&b);
	return status;
}
