/* Grid heating: the mesh aliases waves shorter than two cells, and warms a plasma whose Debye length it does not resolve. With L = lambda_D/h and n
 * particles in a cell, dL^2/d(omega_p t) = R L^-a, so L^(2+a) grows by (1 + a/2) R omega_p T. In 1-D a = p - 2, R = 2 C/(p n); in 2-D and 3-D a = 0.6 and
 * R is 0.5 and 0.2 times that; C and p of every kernel were measured (docs/plan.md). A drift v0 lowers it by (1 + (v0/v_th)^2)^1.5. A quiet start
 * has no noise until its beams have mixed, omega_p t = sqrt(N)/2. Beams colder than the mesh resolves are unstable at the rate gamma omega_p until their
 * spread is about sqrt(g) omega_p h/2, when the energy has changed by g (omega_p h/v0)^2.
 * With m2p --energy-conserving the energy of light and particles stays: 0.006 of the heat was measured (docs/methods/transfer.md), 0.01 is taken.
 * Source: Birdsall and Langdon 1985, sections 8-7, 8-12, 8-13; Hockney and Eastwood 1988, section 9-2; PIC-21 of the reference cases.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/effect-decision.h"

/* Measured with 64 cells, 64 particles in each, omega_p dt = 0.2, to omega_p t = 1000 at lambda_D/h = 0.05, 0.1, 0.3, and with beams at v0 = 0.4, 0.5 and 1
 * omega_p h: [0] differences of order 2 and 4, [1] the spectral gradient. Differences of order 6 have 1.3 times the C of order 4. */
struct row {
	const char *kernel;
	double p, C[2], g[2], gamma[2];
};
static const struct row rows[] = {
	{"ngp", 2.6, {0.034, 0.051}, {0.3, 0.4}, {0.5, 0.6}},
	{"cic", 3, {9.4e-4, 2.6e-3}, {0.010, 0.026}, {0.196, 0.389}},
	{"tsc", 2.6, {9.5e-5, 4.6e-4}, {0.0025, 0.0095}, {0.092, 0.235}},
	{"pcs", 2.4, {1.9e-5, 8e-5}, {0.0013, 0.004}, {0.050, 0.147}},
	{"m4prime", 3, {6.6e-4, 3.4e-3}, {0.0115, 0.037}, {0.203, 0.469}},
	{"m6prime", 2.6, {6.2e-4, 4.5e-3}, {0.0095, 0.042}, {0.182, 0.48}},
	{"lambda-2", 3, {2.1e-3, 8.1e-3}, {0.018, 0.09}, {0.36, 0.58}},
	{"star", 3, {2.1e-3, 8.1e-3}, {0.018, 0.09}, {0.36, 0.58}}, /* in 1-D lambda-2 */
	{"lambda-2-1", 3, {6.6e-4, 3.4e-3}, {0.0115, 0.037}, {0.203, 0.469}},
	{"lambda-2-2", 3, {9.7e-4, 4.5e-3}, {0.011, 0.045}, {0.20, 0.5}},
	{"lambda-4-2", 2.6, {6.2e-4, 4.5e-3}, {0.0095, 0.042}, {0.182, 0.48}},
	{"lambda-4-4", 2.8, {6e-4, 4.2e-3}, {0.011, 0.045}, {0.192, 0.5}},
	{"lambda-6-4", 2.6, {3.6e-4, 3.4e-3}, {0.0105, 0.045}, {0.169, 0.485}},
	{"lambda-6-6", 2.6, {4e-4, 3.8e-3}, {0.0105, 0.045}, {0.17, 0.5}},
	{"lambda-8-4", 2.4, {3.3e-4, 3.6e-3}, {0.011, 0.043}, {0.16, 0.47}},
};

static const struct row *row_of(const char *kernel)
{
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
		if (kernel && !strcmp(rows[i].kernel, kernel))
			return &rows[i];
	return &rows[1];
}

static double in_a_cell(const struct pm_scales *s) { return s->effective * pow(s->h, s->dim) / s->volume; }

/* Noise over that of as many particles at random: 1, or less. */
static double randomness(const struct pm_scales *s) { return isnan(s->noise) ? 1 : fmin(1, s->noise * s->effective); }

/* Spread that beams get by the instability, in omega_p h; and the change of v^2 in (omega_p h)^2, into *gain. */
static double unstable(const struct pm_scales *s, const struct row *r, bool spectral, double *gain)
{
	const double cell = s->omega * s->h, end = 0.45 * sqrt(r->g[spectral]);
	const double begun = 0.005 * sqrt(fmax(randomness(s), 1e-28) / in_a_cell(s));
	const double grown = fmin(end, begun * exp(fmin(r->gamma[spectral] * s->omega * s->time, 100)));
	*gain = 0;
	if (s->drift < 0.01 * cell || s->thermal > end * cell)
		return 0;
	*gain = r->g[spectral] * pow(grown / end, 2);
	return grown;
}

/* The change of the energy over the energy. */
static double heat(const struct pm_effect_case *c)
{
	const struct pm_scales *s = c->scales;
	const struct pm_method *m = c->method;
	const struct row *r = row_of(m->kernel);
	const bool spectral = m->order && !strcmp(m->order, "spectral"), six = m->order && !strcmp(m->order, "6");
	const double cell = s->omega * s->h, quiet = randomness(s) < 0.1 ? 0.5 * sqrt(s->effective) : 0;
	const double all = s->v_rms * s->v_rms + pow(s->self / s->omega, 2), factor[4] = {0, 1, 0.5, 0.2};
	double gain, L = fmax(s->thermal / cell, unstable(s, r, spectral, &gain));
	if (s->kind != PM_CHARGES || !(all > 0))
		return 0;
	const double a = s->dim == 1 ? r->p - 2 : 0.6, drift = pow(1 + pow(s->drift / fmax(L * cell, 1e-30), 2), -1.5);
	const double R = factor[s->dim] * 2 / r->p * r->C[spectral] * (six ? 1.3 : 1) * (m->conserving ? 0.01 : 1) / in_a_cell(s) * drift;
	const double tau = fmax(0, s->omega * s->time - quiet), cold = L * cell < 1e-6 * sqrt(all) && quiet > 0;
	if (!cold)
		gain += s->dim * (pow(pow(L, 2 + a) + (1 + a / 2) * R * tau, 2 / (2 + a)) - L * L);
	return fmax(0, gain) * cell * cell / all;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const double L = s->thermal / (s->omega * s->h);
	if (s->kind != PM_CHARGES)
		pm_effect_off(d, "the law has no Debye length");
	else if (s->pairs || pm_effect_alone(s) || !(s->effective > 0))
		pm_effect_off(d, s->pairs ? "pairs are summed, there is no mesh" : "no self field");
	else {
		pm_effect_by(d, s, L, heat(c));
		if (s->thermal < 0.05 * s->drift) {
			d->number = s->drift / (s->omega * s->h);
			snprintf(d->text, sizeof d->text, "cold beams, v0/(omega_p h) = %.2g: the mesh changes the energy by %.1g", d->number, d->share);
		} else
			snprintf(d->text, sizeof d->text, "lambda_D/h = %.2g, %.2g particles in a cell: the mesh changes the energy by %.1g", L, in_a_cell(s),
				d->share);
		if (d->answer == PM_PUT_IN)
			snprintf(d->text + strlen(d->text), sizeof d->text - strlen(d->text), "; more cells, or -n %.1g", s->n * 2 * d->share / s->accuracy);
	}
}

const struct pm_effect effect_grid_heating = {
	.name = "grid-heating",
	.sentence = "a plasma warmed by its mesh",
	.source = "Birdsall and Langdon 1985, sections 8-12, 8-13",
	.numerical = true,
	.share = heat,
	.decide = decide,
};
