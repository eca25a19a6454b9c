/* Near-field correction: what a mesh smooths away of the pull of near pairs. Pairs summed one by one, and particles that cover their mesh as a field,
 * need none. Bodies: a pair nearer than 2.5 cells feels less than its force; by the neighbours' distance d the part is (h/d)^2/4 where all are apart. Where bodies
 * sample a cloud their neighbours pull as m/d^2 over the mean force, which counts while they are cold; warm ones pass each other, and what stays is
 * the relaxation of collisions.c. In open space the atlas knows what a mesh does to a cluster of bodies. Source: Hockney and Eastwood 1988, section 8-2; docs/methods/pm-force.md.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "effect/effect.h"

static void decide(const struct pm_scales *s, struct pm_decision *d)
{
	const double cells = (s->n < 32 ? s->nearest : s->spacing) / s->h, apart = fmin(1, 0.25 / (cells * cells));
	effect_off(d, "every pair is summed");
	if (effect_alone(s))
		effect_off(d, "no self field");
	else if (s->pairs)
		return;
	else if (s->kind == PM_VORTICES) {
		d->number = cells;
		snprintf(d->text, sizeof d->text, "the particles cover the mesh, neighbours are %.2g cells apart", cells);
	} else if (s->softening > 2 * s->h) {
		d->number = s->softening / s->h;
		snprintf(d->text, sizeof d->text, "the mesh resolves the softening, softening/h = %.2g", d->number);
	} else if (s->kind == PM_CHARGES || s->dim == 1) {
		d->number = s->n / s->points;
		snprintf(d->text, sizeof d->text, "particles sample a cloud, %.2g in a cell, and are as wide as one", d->number);
	} else if (s->open && s->mesh_error > s->accuracy) {
		effect_by(d, s, s->mesh_error, s->mesh_error);
		snprintf(d->text, sizeof d->text, "the mesh is wrong by %.1g where bodies are near", s->mesh_error);
	} else if (cells > 2.5 || s->n < 32) {
		effect_by(d, s, cells, apart);
		snprintf(d->text, sizeof d->text, "nearest pair %.2g cells apart, the mesh is wrong by %.1g there", cells, apart);
	} else {
		const double pull = s->omega * s->omega * s->spacing / (4 * pm_pi * s->self), passing = s->v_thermal * s->time / s->spacing;
		effect_by(d, s, pull, passing > 1 ? pull / sqrt(passing) : pull);
		snprintf(d->text, sizeof d->text, "neighbours are %.2g cells apart and pull %.2g of the mesh force", cells, pull);
	}
}

const struct pm_effect effect_near_field = {
	.name = "near-field",
	.sentence = "the pull of pairs nearer than a few cells",
	.source = "Hockney and Eastwood 1988, section 8-2",
	.word = "pair",
	.decide = decide,
};
