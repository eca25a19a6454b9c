/* Collisions: encounters that a smooth field leaves out. Bodies relax in N/(8 ln N) crossing times (spread/v); charges in N_D/ln N_D plasma periods over 2 pi (N_D^2 in 1-D),
 * N_D in a sphere of the Debye length. The part of that time that T is, is the share. Pairs that are summed collide by themselves, cold particles keep their order.
 * Source: Binney and Tremaine 2008, equation 1.38; Birdsall and Langdon 1985, section 1-3; Dawson 1964, Phys. Fluids 7, 419.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "effect/effect.h"

static void bodies(const struct pm_scales *s, struct pm_decision *d)
{
	const double crossing = s->spread / s->v_thermal, relaxation = s->n / (8 * fmax(1, log(s->n))) * crossing;
	effect_by(d, s, s->time / relaxation, s->time / relaxation);
	snprintf(d->text, sizeof d->text, "T is %.1g of the relaxation time", d->number);
}

static void charges(const struct pm_scales *s, struct pm_decision *d)
{
	const double n = fmax(s->per_debye, 1e-300), periods = s->dim == 1 ? n * n : n / fmax(1, log(n)), share = s->omega * s->time / periods;
	effect_by(d, s, s->per_debye, share);
	snprintf(d->text, sizeof d->text, "%.2g particles in a Debye length%s, T is %.1g of the time between collisions", s->per_debye, s->dim == 1 ? "" : "'s sphere", share);
}

static void decide(const struct pm_scales *s, struct pm_decision *d)
{
	if (s->kind != PM_MASSES && s->kind != PM_CHARGES)
		effect_off(d, "the law has none");
	else if (effect_alone(s))
		effect_off(d, "no self field");
	else if (s->pairs)
		effect_off(d, "every pair is summed, encounters are in the self field");
	else if (!(s->v_thermal > 1e-9 * s->omega * s->spread) || (s->dim == 1 && s->kind == PM_MASSES))
		effect_off(d, s->dim == 1 && s->kind == PM_MASSES ? "sheets pass through each other" : "cold: no velocities at random");
	else if (s->kind == PM_MASSES)
		bodies(s, d);
	else
		charges(s, d);
}

const struct pm_effect effect_collisions = {
	.name = "collisions",
	.sentence = "encounters that a smooth field leaves out",
	.source = "Binney and Tremaine 2008, equation 1.38; Birdsall and Langdon 1985, section 1-3",
	.word = "collide",
	.decide = decide,
};
