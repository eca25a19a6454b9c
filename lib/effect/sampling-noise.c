/* Sampling noise: particles that stand for a smooth density have waves of their own, |a_k|^2 = 1/N at random, of which half is in phase with a wave of the
 * frame: its amplitude a is known to sqrt(|a_k|^2/2)/a. The noise is that of the frame (lib/planner/sampling.c): a quiet start has less, until its beams
 * have mixed at omega_p t = sqrt(N)/2. Where no wave stands above it, it counts by its part of the density, 2 |a_k|, or by the energy of its field
 * over the kinetic energy; between beams both grow, at most by the rate of two cold beams, omega_p/sqrt 8.
 * Single particles: a quiet start in 1-D is cold beams of sqrt(N) places each, and quiet only up to the wave number of these places, k_s. Above it the
 * beams are at random as soon as they have moved; fields of n particles a length at random, passed with the speed v, change velocities by
 * omega_p^2 sqrt(T/(n v))/k_s, of which a mesh with the largest wave number k_h shows (k_h/k_s)^2/20 (measured, docs/plan.md).
 * Source: Birdsall and Langdon 1985, sections 5-6 and 12-3, chapter 16. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/effect-decision.h"

static void waves(const struct pm_scales *s, bool mixed, struct pm_decision *d)
{
	const double noise = sqrt((mixed ? 1 / s->effective : s->noise) / 2);
	pm_effect_by(d, s, noise, fmin(1, noise / s->wave));
	snprintf(d->text, sizeof d->text, "%g particles%s: noise %.2g of each wave, the largest has %.2g and is known to %.1g", s->n,
		mixed ? ", mixed within T" : "", 2 * noise, 2 * s->wave, d->share);
	if (d->answer == PM_PUT_IN)
		snprintf(d->text + strlen(d->text), sizeof d->text - strlen(d->text), "; -n %.1g", s->n * pow(2 * d->share / s->accuracy, 2));
}

static void nothing(const struct pm_scales *s, bool mixed, struct pm_decision *d)
{
	const double noise = 2 * sqrt(mixed ? 1 / s->effective : s->noise), grown = s->beams ? exp(fmin(0.35 * s->omega * s->time, 50)) : 1;
	const double field = pow(s->self / s->omega / s->v_rms, 2);
	pm_effect_by(d, s, noise, fmin(1, fmax(noise, field * grown) * grown));
	snprintf(d->text, sizeof d->text, "%g particles%s, no wave above their noise of %.2g of the density%s", s->n,
		mixed ? ", mixed within T" : "", noise, grown > 1.1 ? ", which grows" : "");
	if (field > 0.01)
		snprintf(d->text + strlen(d->text), sizeof d->text - strlen(d->text), ", its field has %.1g of the kinetic energy", field);
}

/* Change of velocities over their rms by single particles on the mesh. */
static double singles(const struct pm_scales *s, double *quiet, double *shown)
{
	*quiet = 2 * pm_pi / s->box * sqrt(s->effective / 0.295 / 0.8 / (s->beams ? 2 : 1)); /* 0.295: of equal strengths, for a Maxwellian to 6 sigma */
	*shown = pm_pi / s->h;
	const double all = s->omega * s->omega * sqrt(s->time * s->box / (s->effective * s->v_rms)) / *quiet;
	return s->dim == 1 && pm_effect_quiet(s) && !s->pairs ? fmin(1, all * fmin(1, pow(*shown / *quiet, 2) / 20) / s->v_rms) : 0;
}

static void single(const struct pm_scales *s, struct pm_decision *d)
{
	double quiet, shown;
	const double share = singles(s, &quiet, &shown);
	if (!(share > d->share) || !(share > 0.5 * s->accuracy))
		return;
	pm_effect_by(d, s, shown / quiet, share);
	snprintf(d->text, sizeof d->text, "%g particles are quiet to k = %.2g, the mesh shows %.2g: single ones push by %.1g; fewer cells, or -n %.1g",
		s->n, quiet, shown, share, s->n * fmax(1.1, sqrt(2 * share / s->accuracy)));
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const bool mixed = s->thermal > 0 && !pm_effect_ordered(s) && s->noise * s->effective < 1 && s->omega * s->time > 0.5 * sqrt(s->effective);
	if (s->kind != PM_MASSES && s->kind != PM_CHARGES)
		pm_effect_off(d, "the particles are no sample");
	else if (pm_effect_alone(s))
		pm_effect_off(d, "no self field");
	else if (!(s->bodies > s->n))
		pm_effect_off(d, "each particle is a body (or else smod --constant bodies=N)");
	else if (isnan(s->noise))
		pm_effect_off(d, "not measured: no periodic box, or too few particles");
	else if (s->wave > 0)
		waves(s, mixed, d);
	else
		nothing(s, mixed, d);
	if (!isnan(d->number) && !mixed)
		single(s, d);
}

const struct pm_effect effect_sampling_noise = {
	.name = "sampling-noise",
	.sentence = "waves that the particles have as a sample",
	.source = "Birdsall and Langdon 1985, section 12-3 and chapter 16",
	.numerical = true,
	.decide = decide,
};
