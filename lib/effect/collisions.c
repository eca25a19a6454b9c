/* Collisions: encounters, which a smooth field leaves out. Bodies relax in N/(8 ln N) crossing times (spread/v); charges in N_D/ln N_D plasma periods over
 * 2 pi (N_D^2 in 1-D), N_D in a sphere of the Debye length. The share is T over that time. Summing pairs includes collisions; cold particles
 * keep their order.
 * Source: Binney and Tremaine 2008, equation 1.38; Birdsall and Langdon 1985, section 1-3; Dawson 1964, Phys. Fluids 7, 419.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/effect-decision.h"

static void bodies(const struct pm_scales *s, struct pm_decision *d)
{
	const double crossing = s->spread / s->v_thermal, relaxation = s->n / (8 * fmax(1, log(s->n))) * crossing;
	pm_effect_by(d, s, s->time / relaxation, s->time / relaxation);
	snprintf(d->text, sizeof d->text, "T is %.1g of the relaxation time", d->number);
}

/* Number of particles in a sphere with the Debye length as radius, in an interval of that length in 1-D. */
static int measure(const struct pm_effect_case *c, const struct pm_effect_run *run, double own[PM_EFFECT_OWN])
{
	const struct pm_scales *s = c->scales;
	const double ball[4] = {0, 1, pm_pi, 4 * pm_pi / 3};
	(void)run;
	own[0] = s->n / s->volume * ball[s->dim] * pow(s->debye, s->dim);
	return 0;
}

static void charges(const struct pm_scales *s, double per_debye, struct pm_decision *d)
{
	const double n = fmax(per_debye, 1e-300), periods = s->dim == 1 ? n * n : n / fmax(1, log(n)), share = s->omega * s->time / periods;
	pm_effect_by(d, s, per_debye, share);
	snprintf(d->text, sizeof d->text, "%.2g particles in a Debye length%s, T is %.1g of the time between collisions", per_debye,
		s->dim == 1 ? "" : "'s sphere", share);
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	if (s->kind != PM_MASSES && s->kind != PM_CHARGES)
		pm_effect_off(d, "the law has none");
	else if (pm_effect_alone(s))
		pm_effect_off(d, "no self field");
	else if (s->pairs)
		pm_effect_off(d, "every pair is summed, encounters are in the self field");
	else if (!(s->v_thermal > 1e-9 * s->omega * s->spread) || (s->dim == 1 && s->kind == PM_MASSES))
		pm_effect_off(d, s->dim == 1 && s->kind == PM_MASSES ? "sheets pass through each other" : "cold: no random velocities");
	else if (s->kind == PM_MASSES)
		bodies(s, d);
	else
		charges(s, c->own[0], d);
}

const struct pm_effect effect_collisions = {
	.name = "collisions",
	.sentence = "encounters that a smooth field leaves out",
	.source = "Binney and Tremaine 2008, equation 1.38; Birdsall and Langdon 1985, section 1-3",
	.word = "collide",
	.measure = measure,
	.decide = decide,
};
