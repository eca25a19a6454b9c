/* The time step that the state of a frame allows: the smallest over the rules asked for and the sets that move.
 * Courant, Friedrichs and Lewy 1928 (cells crossed in a step); Springel 2005, MNRAS 364, 1105, eq. 34 (softening over acceleration); Cottet and
 * Koumoutsakos 2000, section 7.1 (strain); Birdsall and Langdon 1985, section 4-2 (plasma frequency); the limits that
 * words state (docs/methods/push.md), for an orbit that of its largest acceleration, so that every part of an ellipse has as many steps as a circle of its
 * radius. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "limit/rates.h"
#include "measure/timestep-rules.h"
#include "mesh/force-words.h"
#include "stream/declare.h"
#include "stream/limits.h"

static bool takes_part(const struct pm_timestep_rules *r, const struct pm_frame *f, const struct pm_set *s)
{
	const struct pm_field *x = pm_frame_field(f, s->name, "x");
	return (!r->set || !strcmp(r->set, s->name)) && !s->fixed && x && x->role == PM_STATE;
}

/* The velocity of a set: its state v, or vel where it has none. */
static const char *velocity(const struct pm_frame *f, const struct pm_set *s) { return pm_frame_field(f, s->name, "v") ? "v" : "vel"; }

static int needs(const struct pm_timestep_rules *r, struct pm_frame *f, const struct pm_set *set)
{
	const char *names[] = {!isnan(r->courant) ? velocity(f, set) : NULL,
		(!isnan(r->acceleration) || !isnan(r->oscillation)) && pm_frame_field(f, set->name, "v") ? "acc" : NULL};
	char words[PM_FORCE_WORDS];
	const struct pm_law *law = pm_law_of(f);
	for (int i = 0; i < 2 && law; i++)
		if (names[i] && !pm_frame_field(f, set->name, names[i]))
			return pm_fail(PM_MISSING, "no field '%s' on '%s' (compute it first: %s)", names[i], set->name,
				*pm_force_words(f, law, NULL, names[i], words) ? words : "with field");
		else if (names[i] && !pm_reads(f, set->name, names[i]))
			return -PM_DATA;
	return law ? 0 : -PM_DATA;
}

/* The mesh field that advects particles. */
static int needs_flow(struct pm_frame *f, const struct pm_law *law)
{
	const struct pm_mesh *mesh = NULL;
	if (!law->field || strcmp(law->of, "x"))
		return pm_fail(PM_DATA, "the strain rule needs a flow, but the law '%s' has none (laws vortex and passive)", law->name);
	for (size_t i = 0; i < f->nmeshes && !mesh; i++)
		if (pm_frame_field(f, f->meshes[i]->name, law->field))
			mesh = f->meshes[i];
	if (!mesh)
		return pm_fail(PM_MISSING, "no field '%s' on a mesh (put dt after p2m | poisson-fft | mgrad)", law->field);
	return pm_reads(f, mesh->name, law->field) ? 0 : -PM_DATA;
}

static bool charged(const struct pm_frame *f, const struct pm_law *law, const char *set)
{
	return law->background && pm_frame_field(f, set, law->strength) && pm_frame_field(f, set, law->per);
}

static int needs_charges(struct pm_frame *f, const struct pm_law *law)
{
	size_t sets = 0;
	for (size_t i = 0; i < f->nsets; i++)
		if (charged(f, law, f->sets[i]->name)) {
			if (!pm_reads(f, f->sets[i]->name, law->strength) || !pm_reads(f, f->sets[i]->name, law->per))
				return -PM_DATA;
			sets++;
		}
	return sets ? 0 : pm_fail(PM_DATA, "no set with charge and mass under the law '%s' for the plasma frequency rule", law->name);
}

static double softening(const struct pm_timestep_rules *r, const struct pm_frame *f)
{
	return isnan(r->softening) ? pm_frame_constant(f, "softening", NAN) : r->softening;
}

int pm_timestep_declare(const struct pm_timestep_rules *r, struct pm_frame *f)
{
	int status = 0, sets = 0;
	if (!isnan(r->courant) && !f->nmeshes)
		return pm_fail(PM_DATA, "no mesh, but --courant counts its cells (p2m -n makes one)");
	if (!isnan(r->acceleration) && !(softening(r, f) > 0))
		return pm_fail(PM_DATA, "the acceleration rule needs a softening length (--softening LENGTH)");
	const struct pm_law *law = pm_law_of(f);
	if (!law || (!isnan(r->strain) && (status = needs_flow(f, law))) || (!isnan(r->plasma) && (status = needs_charges(f, law))))
		return status ? status : -PM_DATA;
	for (size_t i = 0; i < f->nsets && !status; i++)
		if (takes_part(r, f, f->sets[i])) {
			status = needs(r, f, f->sets[i]);
			sets++;
		}
	if (!status && !sets)
		return pm_fail(PM_DATA, "no particle set with a velocity%s%s", r->set ? " is called " : "", r->set ? r->set : "");
	return status;
}

static double strain(const struct pm_frame *f, const char *name)
{
	for (size_t i = 0; i < f->nmeshes; i++) {
		const struct pm_field *u = pm_frame_field(f, f->meshes[i]->name, name);
		const struct pm_grid g = pm_grid_of(f, f->meshes[i]);
		const double *component[PM_COMPONENTS];
		for (int c = 0; u && c < u->components; c++)
			component[c] = pm_in(u, c);
		if (u)
			return pm_strain(&g, u, component);
	}
	return 0;
}

bool pm_timestep_ruled(const struct pm_timestep_rules *r)
{
	return !isnan(r->courant) || !isnan(r->acceleration) || !isnan(r->strain) || !isnan(r->plasma) || !isnan(r->oscillation);
}

double pm_timestep_allowed(const struct pm_timestep_rules *r, const struct pm_frame *f, double *rate)
{
	const struct pm_law *law = pm_law_of(f);
	double dt = isnan(r->plasma) ? HUGE_VAL : r->plasma / pm_plasma_frequency(f, law);
	*rate = isnan(r->strain) ? 0 : strain(f, law->field);
	dt = *rate > 0 ? fmin(dt, r->strain / *rate) : dt;
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_set *set = f->sets[i];
		if (!takes_part(r, f, set))
			continue;
		if (!isnan(r->courant))
			dt = fmin(dt, r->courant / pm_most(pm_frame_field(f, set->name, velocity(f, set)), f->meshes[0]->h));
		const struct pm_field *acc = isnan(r->acceleration) ? NULL : pm_frame_field(f, set->name, "acc");
		const struct pm_field *turns = isnan(r->oscillation) ? NULL : pm_frame_field(f, set->name, "acc");
		const double omega = turns ? pm_limits_of(turns).oscillation : 0;
		dt = omega > 0 ? fmin(dt, r->oscillation / omega) : dt;
		if (acc)
			dt = fmin(dt, sqrt(r->acceleration * softening(r, f) / sqrt(pm_most(acc, NULL))));
	}
	return dt;
}
