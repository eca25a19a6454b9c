/* Resolution: the mesh's error of a smooth field, of the wavelengths that the frame has: h over the length of the field, |field|/|its sources|, 1/k for a
 * wave, by the atlas, for the kernel and the gradient chosen. The wavelengths are those of the particles themselves (lib/planner/sampling.c) where some wave
 * stands above their noise, since a mesh that is too coarse folds a short wave onto a long one; else of the field on the mesh, vortices k^2 =
 * |lap omega|/|omega|. A force error d shifts phases by d omega T/2. Plan has looked for more cells before. Source: Hockney and Eastwood 1988, section 5-4;
 * data/atlas/force.tsv. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/effect-decision.h"

/* Waves of light on Yee's mesh are slower by (k h)^2/24 (1 - (c dt/h)^2) of themselves along an axis, where they are slowest. */
static void light(const struct pm_scales *s, struct pm_decision *d)
{
	const double kh = s->wiggle * s->h, off = kh * kh / 24 * (1 - pow(s->c * s->dt / s->h, 2));
	if (!(s->magnetic > 0.5 * s->accuracy) || isnan(kh)) {
		pm_effect_off(d, "no light to speak of");
		return;
	}
	pm_effect_by(d, s, kh, fmin(1, off * s->c * s->wiggle * s->time));
	d->answer = d->share > s->accuracy ? PM_PUT_IN : PM_LEFT_OUT;
	snprintf(d->text, sizeof d->text, "k h = %.2g of the light: slower by %.1g, phases off by %.1g%s", kh, off, d->share,
		d->answer == PM_PUT_IN ? "; more cells, or maxwell --method psatd" : "");
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	if (s->light) {
		light(s, d);
		return;
	}
	const bool vortices = s->kind == PM_VORTICES, open = s->open && !s->periodic && !s->walls;
	const double ratio = s->h / s->length, grown = vortices ? 1 : fmax(1, 0.5 * s->omega * s->time);
	if (s->pairs || s->singular || pm_effect_alone(s) || !(s->length > 0) || isnan(s->mesh_error) || (open && !vortices)) {
		pm_effect_off(d, s->pairs ? "pairs are summed" : "no smooth field on a mesh");
		return;
	}
	pm_effect_by(d, s, ratio, s->mesh_error * grown);
	d->answer = s->mesh_error * grown > s->accuracy ? PM_PUT_IN : PM_LEFT_OUT; /* plan chose the mesh for all of it */
	snprintf(d->text, sizeof d->text, "h = %.2g of the field's length: the mesh changes the field by %.1g", ratio, s->mesh_error);
	if (grown > 1)
		snprintf(d->text + strlen(d->text), sizeof d->text - strlen(d->text), ", phases by %.1g", d->share);
}

const struct pm_effect effect_resolution = {
	.name = "resolution",
	.sentence = "what the cells are too coarse for",
	.source = "Hockney and Eastwood 1988, section 5-4",
	.numerical = true,
	.decide = decide,
};
