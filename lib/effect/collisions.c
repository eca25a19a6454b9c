/* Collisions: encounters, which a smooth field leaves out. Bodies relax in N/(8 ln N) crossing times (spread/v), that is, velocities; the mean square of their
 * energies' change over v^2 is 0.42 of T over that time. Charges: what T is of the time in which their velocities become isotropic, in 3-D N_D/(0.075 ln L)
 * plasma periods over 2 pi (N_D in a sphere of the Debye length, L the lesser of 9 N_D and the cells in a Debye length), in 2-D N_D/0.155; in 1-D 10 N_D^2,
 * in which they become Maxwellian. All measured: docs/plan-errors.sh. Summing pairs includes collisions; cold particles keep their order.
 * Charges on a mesh that stand for a number of real ones, the constant `bodies`, and have v of 3 components, scatter as those by the word collide: N_D and
 * L = 9 N_D of the real ones, in 1-D and 2-D too. Particles that stand for more bodies than there are (the constant `bodies`; charges always, unless it is
 * given) have encounters that those have not: two-body relaxation, an error. With pairs ln N is ln(R/softening), on a mesh ln(R/h), R the spread, if that is
 * less.
 * Source: Binney and Tremaine 2008, equation 1.38; NRL Plasma Formulary (Huba 2016), temperature isotropization; Dawson 1964, Phys. Fluids 7, 419.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "stream/frame.h"

/* Charges whose pairs are summed are points, unless the frame says otherwise. */
static bool sample(const struct pm_scales *s) { return s->bodies > s->n && (!s->pairs || isfinite(s->bodies)); }

/* T over the relaxation time of n bodies. */
static double relaxed(const struct pm_scales *s, double n, double logarithm)
{
	return s->time * s->v_thermal / s->spread * 8 * logarithm / n;
}

static void bodies(const struct pm_scales *s, struct pm_decision *d)
{
	const double least = fmax(s->softening, s->pairs ? 0 : s->h), range = least > 0 ? fmax(1, s->spread / least) : HUGE_VAL;
	double part = relaxed(s, s->n, fmax(1, log(s->n)));
	if (sample(s))
		part = fmax(0, relaxed(s, s->n, log(fmin(s->n, range))) - relaxed(s, s->bodies, log(s->bodies)));
	pm_effect_by(d, s, part, 0.42 * part);
	d->error = sample(s);
	snprintf(d->text, sizeof d->text, "T is %.1g of the relaxation time", d->number);
	if (d->error)
		snprintf(d->text, sizeof d->text, "%g particles for %g bodies relax by encounters: T is %.1g of that time%s", s->n, s->bodies, part,
			d->answer == PM_PUT_IN ? "; more particles, more softening" : "");
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
	const double n = fmax(per_debye, 1e-300), reach = s->pairs ? 9 * n : fmin(9 * n, s->debye / s->h);
	const double rate[4] = {0, 0.1 / (n * n), 0.155 / n, 0.075 * fmax(1, log(reach)) / n}, share = s->omega * s->time * rate[s->dim];
	pm_effect_by(d, s, per_debye, share);
	snprintf(d->text, sizeof d->text, "%.2g particles in a Debye length%s, T is %.1g of the time between collisions", per_debye,
		s->dim == 1 ? "" : "'s sphere", share);
	d->error = sample(s);
}

/* Is it known how many real charges there are, and can collide turn their velocities? */
static bool scatters(const struct pm_effect_case *c)
{
	const struct pm_scales *s = c->scales;
	bool space = s->kind == PM_CHARGES && !s->pairs && isfinite(s->bodies);
	for (size_t k = 0; k < c->frame->nsets; k++) {
		const struct pm_field *v = pm_frame_field(c->frame, c->frame->sets[k]->name, "v");
		space = space && (!v || v->components == 3);
	}
	return space;
}

/* Of as many charges in space as there are bodies: the collisions that are physics, if they matter; beside them those of the sample. */
static bool physical(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const double n = fmax(s->bodies / s->volume * 4 * pm_pi / 3 * pow(s->debye, 3), 1e-300), share = s->omega * s->time * 0.075 * fmax(1, log(9 * n)) / n;
	const double of_sample = d->share;
	if (!(share > s->accuracy))
		return false;
	pm_effect_by(d, s, n, share);
	d->error = false;
	snprintf(d->text, sizeof d->text, "%.2g charges in a Debye sphere, T is %.1g of the time between collisions", n, share);
	if (sample(s) && of_sample > 0.1 * share)
		snprintf(d->text + strlen(d->text), sizeof d->text - strlen(d->text), "; the sample adds %.1g", of_sample);
	return true;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	bool placed = false;
	if (s->kind != PM_MASSES && s->kind != PM_CHARGES)
		pm_effect_off(d, "the law has none");
	else if (pm_effect_alone(s))
		pm_effect_off(d, "no self field");
	else if (s->pairs && !sample(s))
		pm_effect_off(d, "every pair is summed, encounters are in the self field");
	else if (!(s->v_thermal > 1e-9 * s->omega * s->spread) || pm_effect_ordered(s) || (s->dim == 1 && s->kind == PM_MASSES))
		pm_effect_off(d, s->dim == 1 && s->kind == PM_MASSES ? "sheets pass through each other" : "cold: no random velocities");
	else if (s->kind == PM_MASSES)
		bodies(s, d);
	else {
		charges(s, c->own[0], d);
		placed = scatters(c) && physical(c, d);
	}
	d->named = !placed;
}

static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	if (c->decision->answer == PM_PUT_IN && !c->decision->error && !c->decision->named)
		pm_words_add(w, PM_SLOT_AFTER, "collide", "collisions: on, %s", c->decision->text);
}

const struct pm_effect effect_collisions = {
	.name = "collisions",
	.sentence = "encounters that a smooth field leaves out",
	.source = "Binney and Tremaine 2008, equation 1.38; Birdsall and Langdon 1985, section 1-3",
	.word = "collide",
	.measure = measure,
	.decide = decide,
	.words = words,
};
