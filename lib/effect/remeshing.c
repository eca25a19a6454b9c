/* Remeshing: particles that carry a field go back on the lattice before they stop covering space. The distortion |H - H0|/H0 is how wrong they represent a
 * constant (lib/remesh/distortion.c) and is held against the accuracy itself: measured after 1, 2, 4, 8 steps without remeshing, it goes on as t^2. Shear
 * along the mesh has none by that measure, so strains e = |grad u| t count too, as (e/4)^2: a lattice stretched 1.25, 1.5, 1.75 times has 0.0032, 0.0106, 0.0336
 * (docs/methods/remesh.md). Points, which cover nothing, have no lattice to go back to. Source: Hieber and Koumoutsakos 2005, J. Comput. Phys. 210, 342.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "effect/effect.h"

/* As measured, after so many steps: the longest of the times below, and t^2 from there on. */
static double measured(const struct pm_scales *s, double steps)
{
	double known = 0;
	for (int i = 0; i < 4 && !isnan(s->distortion[i]); i++)
		known = 1 << i <= steps || !i ? s->distortion[i] * pow(steps / (1 << i), 2) : known;
	return known;
}

/* And by the strain. */
static double distortion(const struct pm_scales *s, double steps) { return fmax(measured(s, steps), pow(0.25 * s->strain * fabs(s->dt) * steps, 2)); }

static void decide(const struct pm_scales *s, struct pm_decision *d)
{
	const double end = distortion(s, s->time / fabs(s->dt));
	if (s->kind != PM_VORTICES || isnan(s->overlap)) {
		effect_off(d, "the particles do not carry a field on a lattice");
		return;
	}
	if (s->pairs) {
		effect_off(d, "");
		d->number = s->overlap;
		snprintf(d->text, sizeof d->text, "these are points: sqrt(volume)/h = %.2g, they miss a lattice by %.2g", s->width / s->h, s->overlap);
		return;
	}
	effect_by(d, s, end, fmin(1, end));
	if (d->answer == PM_LEFT_OUT) {
		snprintf(d->text, sizeof d->text, "distortion reaches %.1g in the time T", end);
		return;
	}
	d->kept = measured(s, s->time / fabs(s->dt)) <= s->accuracy; /* not seen in the first steps */
	for (d->every = 1; d->every < 16 && distortion(s, d->every + 1) <= s->accuracy;)
		d->every++;
	d->number = distortion(s, d->every);
	snprintf(d->text, sizeof d->text, "distortion reaches %.2g", d->number);
}

const struct pm_effect effect_remeshing = {
	.name = "remeshing",
	.sentence = "particles back on the lattice",
	.source = "Hieber and Koumoutsakos 2005",
	.word = "remesh",
	.decide = decide,
};
