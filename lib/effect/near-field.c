/* Near-field correction: the part of the force of near pairs that a mesh smooths away. Summed pairs, and particles that represent a field on their mesh,
 * need none. The force of a pair at distance d is too small by (h/d)^2/4, and almost zero within 2.5 cells: the fraction of bodies with such a neighbour,
 * times its force, m/d^2 at the distance of neighbours, relative to the mesh force; warm bodies pass their neighbours, so their contributions add
 * as the square root of their number.
 * In open space the atlas has the error of a mesh for a cluster of bodies. Source: Hockney and Eastwood 1988, section 8-2; docs/methods/pm-force.md.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/effect-decision.h"

/* Can the nearest pair fall together within the run? Alone it would at 1.11/sqrt(G m/d^3); in a lattice the pulls of the others cancel its own. */
static bool falls(const struct pm_scales *s)
{
	const double rate = s->encounter / sqrt(2), d = fmax(s->nearest, s->softening);
	return rate * s->time > 0.8 && s->self_max > 0.3 * rate * rate * d;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const double cells = s->nearest / s->h, apart = fmin(1, 0.25 / (cells * cells));
	pm_effect_off(d, "every pair is summed");
	if (pm_effect_alone(s))
		pm_effect_off(d, "no self field");
	else if (s->pairs)
		return;
	else if (s->singular) {
		pm_effect_by(d, s, s->mesh_error, s->mesh_error);
		d->answer = s->mesh_error > s->accuracy ? PM_PUT_IN : PM_LEFT_OUT;
		snprintf(d->text, sizeof d->text, "point vortices, softening/h = %.2g: the error of the mesh is %.1g", s->softening / s->h, s->mesh_error);
	} else if (s->kind == PM_VORTICES) {
		d->number = s->spacing / s->h;
		snprintf(d->text, sizeof d->text, "the particles cover the mesh, neighbours are %.2g cells apart", d->number);
	} else if (s->softening > 2 * s->h) {
		d->number = s->softening / s->h;
		snprintf(d->text, sizeof d->text, "the mesh resolves the softening, softening/h = %.2g", d->number);
	} else if (s->kind == PM_CHARGES || s->dim == 1) {
		d->number = s->n / s->points;
		snprintf(d->text, sizeof d->text, "particles sample a smooth density, %.2g in a cell, and are a cell wide", d->number);
	} else if (s->open && !s->periodic && !s->walls && s->mesh_error > s->accuracy) {
		pm_effect_by(d, s, s->mesh_error, s->mesh_error);
		snprintf(d->text, sizeof d->text, "the error of the mesh is %.1g where bodies are close", s->mesh_error);
	} else if (cells > 2.5 && falls(s)) {
		pm_effect_by(d, s, cells, 1);
		snprintf(d->text, sizeof d->text, "the nearest pair, now %.2g cells apart, may fall together", cells);
	} else if (cells > 2.5) {
		pm_effect_by(d, s, cells, apart);
		snprintf(d->text, sizeof d->text, "nearest pair %.2g cells apart, the error of the mesh there is %.1g", cells, apart);
	} else {
		const double ball[4] = {0, 2, pm_pi, 4 * pm_pi / 3}, part = fmin(1, ball[s->dim] * pow(2.5 * s->h / s->spacing, s->dim));
		const double pull = part * s->omega * s->omega * s->spacing / (4 * pm_pi * s->self), passing = s->v_thermal * s->time / s->spacing;
		/* those that fall together get velocities of their own: l2 over all bodies */
		pm_effect_by(d, s, pull, passing > 1 ? pull / sqrt(passing) : s->omega * s->time > 1 ? fmax(pull, sqrt(part)) : pull);
		snprintf(d->text, sizeof d->text, "%.2g of the bodies have neighbours within 2.5 cells; left out changes %.2g", part, d->share);
	}
}

const struct pm_effect effect_near_field = {
	.name = "near-field",
	.sentence = "forces of pairs closer than a few cells",
	.source = "Hockney and Eastwood 1988, section 8-2",
	.word = "pair",
	.decide = decide,
};
