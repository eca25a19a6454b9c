/* Ion motion: in a field that stays, ions shift as their plasma oscillation begins, by 1 - cos(omega_pi T), (omega_pi T)^2/2 at first, of what would
 * neutralise it. Where electrons drift through them faster than 1.3 of their thermal velocity, Buneman's instability grows at
 * 0.687 (omega_pi/omega_p)^(2/3) omega_p, which counts in place of omega_pi if it is faster. omega_pi^2 = |c| sum q^2/m/V over the sets whose q/m is below
 * half of the largest; of a background |c rho|/M, M the constant ion_mass. Ions may stand still by `smod --fixed`; plan changes no set, it says what to type.
 * Source: Birdsall and Langdon 1985, sections 5-8 and 5-9; Buneman 1959, Phys. Rev. 115, 503. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/effect-decision.h"
#include "law/law.h"
#include "stream/field-value.h"

enum { RATE, GROWTH, RATIO, FIXED, LOOSE, BACKGROUND }; /* own numbers: omega_pi, that of Buneman, q/m of ions over that of electrons; sets of ions; 1: one */

struct species {
	const struct pm_set *set;
	double n, qq_m, ratio, drift[3], vth; /* sum q^2/m; mean q/m, absolute; mean v and its standard deviation, of one component */
};

static bool species_of(const struct pm_effect_case *c, const struct pm_set *set, struct species *s)
{
	const struct pm_field *q = pm_frame_field(c->frame, set->name, c->law->strength), *m = pm_frame_field(c->frame, set->name, c->law->per);
	const struct pm_field *v = pm_frame_field(c->frame, set->name, "v");
	struct pm_sum pull = {0, 0}, ratio = {0, 0}, mean[3] = {{0, 0}}, square = {0, 0};
	*s = (struct species){.set = set, .n = (double)set->n};
	if (!q || !m || !set->n)
		return false;
	for (size_t i = 0; i < set->n; i++) {
		const double a = fabs(pm_value_at(q, 0, i)), mass = pm_value_at(m, 0, i);
		if (mass > 0) {
			pm_sum_add(&pull, a * a / mass);
			pm_sum_add(&ratio, a / mass);
		}
		for (int d = 0; v && d < v->components && d < 3; d++) {
			pm_sum_add(&mean[d], pm_value_at(v, d, i));
			pm_sum_add(&square, pow(pm_value_at(v, d, i), 2));
		}
	}
	double all = v ? pm_sum_total(square) / s->n : 0;
	for (int d = 0; v && d < v->components && d < 3; d++) {
		s->drift[d] = pm_sum_total(mean[d]) / s->n;
		all -= s->drift[d] * s->drift[d];
	}
	s->vth = v ? sqrt(fmax(0, all) / v->components) : 0;
	s->qq_m = pm_sum_total(pull), s->ratio = pm_sum_total(ratio) / s->n;
	return s->ratio > 0;
}

/* The species with the largest q/m. */
static struct species lightest(const struct pm_effect_case *c)
{
	struct species most = {.ratio = 0}, s;
	for (size_t k = 0; k < c->frame->nsets; k++)
		if (species_of(c, c->frame->sets[k], &s) && s.ratio > most.ratio)
			most = s;
	return most;
}

static bool heavy(const struct species *s, const struct species *electrons) { return s->ratio < 0.5 * electrons->ratio; }

static double apart(const struct species *a, const struct species *b)
{
	return sqrt(pow(a->drift[0] - b->drift[0], 2) + pow(a->drift[1] - b->drift[1], 2) + pow(a->drift[2] - b->drift[2], 2));
}

static int measure(const struct pm_effect_case *c, const struct pm_effect_run *run, double own[PM_EFFECT_OWN])
{
	const struct pm_law *law = c->law;
	const struct pm_frame *f = c->frame;
	const double coefficient = law->coefficient ? fabs(law->coefficient(f)) : 1 / pm_frame_constant(f, "eps0", 1);
	const double rho = fabs(pm_frame_constant(f, "background", 0)), mass = pm_frame_constant(f, "ion_mass", NAN);
	struct pm_sum square = {0, 0};
	(void)run;
	own[RATE] = own[GROWTH] = own[FIXED] = own[LOOSE] = 0;
	own[BACKGROUND] = rho > 0;
	own[RATIO] = mass > 0 ? 1 / mass : 0;
	if (c->scales->kind != PM_CHARGES || !law->per)
		return 0;
	const struct species e = lightest(c);
	struct species s;
	bool drift = false;
	for (size_t k = 0; k < f->nsets; k++)
		if (species_of(c, f->sets[k], &s) && heavy(&s, &e)) {
			pm_sum_add(&square, coefficient * s.qq_m / c->scales->volume);
			own[pm_set_moves(f, s.set) ? LOOSE : FIXED]++;
			own[RATIO] = fmax(own[RATIO], s.ratio);
			drift = drift || apart(&s, &e) > 1.3 * e.vth;
		}
	if (own[BACKGROUND] > 0 && mass > 0) {
		pm_sum_add(&square, coefficient * rho / mass);
		drift = drift || apart(&e, &(struct species){.n = 0}) > 1.3 * e.vth;
	}
	own[RATIO] /= e.ratio;
	own[RATE] = sqrt(pm_sum_total(square));
	const double omega_p = sqrt(coefficient * e.qq_m / c->scales->volume);
	own[GROWTH] = drift && omega_p > 0 ? 0.687 * pow(own[RATE] / omega_p, 2.0 / 3) * omega_p : 0;
	return 0;
}

/* The name of the first set of ions that moves, or does not. */
static const char *name(const struct pm_effect_case *c, bool moves)
{
	const struct species e = lightest(c);
	struct species s;
	for (size_t k = 0; k < c->frame->nsets; k++)
		if (species_of(c, c->frame->sets[k], &s) && heavy(&s, &e) && pm_set_moves(c->frame, s.set) == moves)
			return s.set->name;
	return "";
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const double *own = c->own, T = fabs(s->time), rate = fmax(own[RATE], own[GROWTH]);
	if (s->kind != PM_CHARGES || !s->second || pm_effect_alone(s)) {
		pm_effect_off(d, s->kind != PM_CHARGES ? "no charges" : "no self field");
		return;
	}
	if (!(own[RATE] > 0)) {
		pm_effect_off(d, own[BACKGROUND] > 0 ? "the background has no ion_mass: it is at rest" : "no ions: no species is heavier than the others");
		if (own[BACKGROUND] > 0)
			snprintf(d->text, sizeof d->text, "ions are a background at rest; protons would have omega_pi T = %.2g (smod --constant ion_mass=1836)",
				s->omega * T / sqrt(1836));
		return;
	}
	pm_effect_by(d, s, own[RATE] * T, rate * T < pm_pi ? 1 - cos(rate * T) : 2);
	const bool in = d->answer == PM_PUT_IN, still = !(own[LOOSE] > 0);
	d->brought = d->kept = in && !still; /* push moves them; a quiet ion is small now and may grow */
	d->error = still;
	const int n = snprintf(d->text, sizeof d->text, "omega_pi T = %.2g, q/m %.2g of the electrons'%s", own[RATE] * T, own[RATIO],
		own[GROWTH] > own[RATE] ? ", which drift" : "");
	char *end = d->text + n;
	const size_t room = sizeof d->text - (size_t)n;
	if (in && own[FIXED] > 0)
		snprintf(end, room, "; but they are fixed (smod --loose %s)", name(c, false));
	else if (in && still)
		snprintf(end, room, "; but they are a background (species, --constant background=0)");
	else if (!in && !still)
		snprintf(end, room, "; they could stand still (smod --fixed %s)", name(c, true));
}

static bool reversible(const struct pm_effect_case *c) { return c->own[LOOSE] > 0; }

/* The frame's ions move, whatever the decision: the other run is that with ions at rest. */
static int reverse(const struct pm_effect_case *c, bool in, struct pm_frame *f, struct pm_method *m)
{
	const struct species e = lightest(c);
	struct species s;
	(void)m, (void)in;
	for (size_t k = 0; k < c->frame->nsets; k++)
		if (species_of(c, c->frame->sets[k], &s) && heavy(&s, &e))
			pm_frame_set(f, s.set->name)->fixed = true;
	return 0;
}

const struct pm_effect effect_ion_motion = {
	.name = "ion-motion",
	.sentence = "heavy charges move, not only electrons",
	.source = "Birdsall and Langdon 1985, sections 5-8 and 5-9; Buneman 1959",
	.word = NULL,
	.measure = measure,
	.decide = decide,
	.reversible = reversible,
	.reverse = reverse,
};
