/* Near-field correction: the part of the force of near pairs that a mesh smooths away. Summed pairs, and particles that represent a field on their mesh,
 * need none. The force of a pair at distance d is too small by (h/d)^2/4, and almost zero within 2.5 cells: the fraction of bodies with such a neighbour,
 * times its force, m/d^2 at the distance of neighbours, relative to the mesh force; warm bodies pass their neighbours, so their contributions add
 * as the square root of their number. The pairs that are close in the frame are summed as well (up to 4096 bodies): of two bodies at distance d the mesh
 * lacks 1/(1 + 4 d^2/h^2) of the force, for the time that they stay together, and no more than what they would have fallen.
 * In open space the atlas has the error of a mesh for a cluster of bodies. Source: Hockney and Eastwood 1988, section 8-2; docs/methods/pm-force.md.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/effect-decision.h"
#include "law/law.h"
#include "stream/field-value.h"
#include "stream/frame.h"

enum { BODIES = 4096 }; /* of more, pairs are not searched */

struct body {
	double x[3], v[3], m;
};

/* The bodies of all sets; at most BODIES, or more in the number returned. */
static size_t bodies(const struct pm_frame *f, const struct pm_law *law, struct body *b)
{
	size_t n = 0;
	for (size_t k = 0; k < f->nsets; k++) {
		const struct pm_field *x = pm_frame_field(f, f->sets[k]->name, "x"), *v = pm_frame_field(f, f->sets[k]->name, "v");
		const struct pm_field *m = pm_frame_field(f, f->sets[k]->name, law->strength);
		for (size_t i = 0; x && m && i < f->sets[k]->n; i++, n++) {
			if (n >= BODIES)
				continue;
			b[n].m = fabs(pm_value_at(m, 0, i));
			for (int d = 0; d < f->dim; d++)
				b[n].x[d] = pm_value_at(x, d, i), b[n].v[d] = v ? pm_value_at(v, d, i) : 0;
		}
	}
	return n;
}

/* The square of the velocity that the pair gives to body i beyond what the mesh does; G: the coefficient of the law. */
static double given(const struct pm_frame *f, const struct pm_scales *s, double G, const struct body *i, const struct body *j)
{
	double r2 = 0, v2 = 0;
	for (int d = 0; d < f->dim; d++) {
		const double side = f->hi[d] - f->lo[d], x = j->x[d] - i->x[d], y = f->face[d][0] == PM_PERIODIC ? x - side * floor(x / side + 0.5) : x;
		r2 += y * y, v2 += (j->v[d] - i->v[d]) * (j->v[d] - i->v[d]);
	}
	if (r2 > 16 * s->h * s->h)
		return 0;
	const double soft = r2 + s->softening * s->softening, sphere = f->dim == 2 ? 2 * pm_pi : 4 * pm_pi;
	if (!(soft > 0))
		return 0;
	const double force = G * j->m / sphere * sqrt(r2) / pow(soft, 0.5 * f->dim) / (1 + 4 * soft / (s->h * s->h));
	const double together = fmin(s->time, v2 > 0 ? sqrt(soft / v2) : HUGE_VAL);
	const double fall = 2 * G * (i->m + j->m) / sphere / (f->dim == 2 ? 1 : sqrt(soft)) * pow(j->m / (i->m + j->m), 2);
	return fmin(pow(force * together, 2), fall);
}

/* own[0]: rms velocity that the near pairs of the frame give within T. */
static int measure(const struct pm_effect_case *c, const struct pm_effect_run *run, double own[PM_EFFECT_OWN])
{
	const struct pm_scales *s = c->scales;
	const struct pm_frame *f = c->frame;
	(void)run;
	if (s->kind != PM_MASSES || s->pairs || f->dim < 2 || !c->law->coefficient)
		return 0;
	struct body *b = pm_alloc(BODIES, sizeof *b);
	if (!b)
		return -PM_DATA;
	const size_t n = bodies(f, c->law, b);
	const double G = fabs(c->law->coefficient(f));
	struct pm_sum all = {0, 0};
	for (size_t i = 0; n <= BODIES && i < n; i++)
		for (size_t j = 0; j < n; j++)
			if (j != i)
				pm_sum_add(&all, given(f, s, G, &b[i], &b[j]));
	if (n > 0 && n <= BODIES)
		own[0] = sqrt(pm_sum_total(all) / (double)n);
	pm_free(b);
	return 0;
}

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
		const double pairs = isnan(c->own[0]) ? 0 : c->own[0] / sqrt(pow(c->own[0], 2) + s->v_rms * s->v_rms + pow(s->self * s->time, 2) + 1e-300);
		/* those that fall together get velocities of their own: l2 over all bodies */
		pm_effect_by(d, s, pull, fmax(pairs, passing > 1 ? pull / sqrt(passing) : s->omega * s->time > 1 ? fmax(pull, sqrt(part)) : pull));
		snprintf(d->text, sizeof d->text, "%.2g of the bodies have neighbours within 2.5 cells; left out changes %.2g", part, d->share);
	}
}

const struct pm_effect effect_near_field = {
	.name = "near-field",
	.sentence = "forces of pairs closer than a few cells",
	.source = "Hockney and Eastwood 1988, section 8-2",
	.word = "pair",
	.measure = measure,
	.decide = decide,
};
