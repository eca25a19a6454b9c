/* Outgrowing: the flow carries its vorticity beyond the open faces of its mesh. The vorticity as a whole moves with its mean velocity U = sum |q| u/sum |q|
 * and the stream; the number is the part of sum |q| whose straight way U T ends beyond a face, or within the two nodes that order 6 needs beside it. p2m
 * and remesh --outside grow follow it, with more points from then on; without them it is lost. What turns in place, and what viscosity spreads, does not count.
 * Source: Cottet and Koumoutsakos 2000, section 7.3 (grid-free vorticity on a finite mesh). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/body-in-flow.h"
#include "effect-parts/effect-decision.h"
#include "law/law.h"
#include "stream/field-value.h"
#include "stream/frame.h"

enum { PARTS = 64 }; /* of the time T */

/* What left in each part of the time; how far it goes beyond the faces. */
struct leaving {
	double out[PARTS], all, beyond[3];
};

static double size(const struct pm_field *q, size_t i)
{
	double sum = 0;
	for (int c = 0; c < q->components; c++)
		sum = hypot(sum, pm_value_at(q, c, i));
	return sum;
}

/* Particles of both kinds have x, strength and change. */
static bool has(const struct pm_effect_case *c, const struct pm_frame *f, size_t k, const struct pm_field *of[3])
{
	of[0] = pm_frame_field(f, f->sets[k]->name, "x"), of[1] = pm_frame_field(f, f->sets[k]->name, c->law->strength);
	of[2] = pm_frame_field(f, f->sets[k]->name, c->law->change);
	return pm_set_moves(f, f->sets[k]) && of[0] && of[1] && of[2] && of[2]->count == of[0]->count;
}

static void mean_velocity(const struct pm_effect_case *c, const struct pm_frame *f, double U[3])
{
	const struct pm_field *of[3];
	double all = 0;
	for (size_t k = 0; k < f->nsets; k++)
		for (size_t i = 0; has(c, f, k, of) && i < of[0]->count; i++) {
			const double q = size(of[1], i);
			all += q;
			for (int d = 0; d < f->dim; d++)
				U[d] += q * pm_value_at(of[2], d, i);
		}
	struct pm_scene_solid b;
	pm_effect_body(f, &b);
	for (int d = 0; d < 3; d++)
		U[d] = (all > 0 ? U[d] / all : 0) + b.stream[d];
}

static void ways(const struct pm_effect_case *c, const struct pm_frame *f, const double U[3], struct leaving *l)
{
	const struct pm_field *of[3];
	for (size_t k = 0; k < f->nsets; k++)
		for (size_t i = 0; has(c, f, k, of) && i < of[0]->count; i++) {
			const double q = size(of[1], i);
			double when = 1;
			l->all += q;
			for (int d = 0; d < f->dim; d++) {
				const double h = f->meshes[0]->h[d], x = pm_value_at(of[0], d, i), way = U[d] * c->scales->time;
				const double room = way > 0 ? f->hi[d] - x - 2 * h : x - f->lo[d] - 2 * h;
				if (f->face[d][way > 0] != PM_OPEN || !(fabs(way) > h) || fabs(way) < room)
					continue;
				when = fmin(when, fmax(0, room) / fabs(way) * (1 - 1e-9));
				l->beyond[d] = fmax(l->beyond[d], fabs(way) - room);
			}
			if (when < 1)
				l->out[(int)(PARTS * when)] += q;
		}
}

/* own: the part that leaves, the time at which more than the accuracy has, and the points of a mesh that follows, over those now. */
static int measure(const struct pm_effect_case *c, const struct pm_effect_run *run, double own[PM_EFFECT_OWN])
{
	const struct pm_scales *s = c->scales;
	struct leaving l = {.all = 0};
	double U[3] = {0}, gone = 0;
	if (s->kind != PM_VORTICES || s->pairs || !s->open || !c->frame->nmeshes)
		return 0;
	struct pm_frame *g = run->force(c->frame, run->sentence);
	if (!g)
		return pm_failed();
	mean_velocity(c, g, U);
	ways(c, g, U, &l);
	own[1] = s->time, own[2] = 1;
	for (int i = PARTS - 1; i >= 0; i--)
		gone += l.out[i];
	own[0] = l.all > 0 ? gone / l.all : 0;
	for (int i = PARTS - 1; i >= 0 && gone > s->accuracy * l.all; i--) {
		gone -= l.out[i];
		own[1] = i * s->time / PARTS;
	}
	for (int d = 0; d < g->dim; d++)
		own[2] *= 1 + l.beyond[d] / (g->hi[d] - g->lo[d]);
	pm_frame_free(g);
	return 0;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	if (isnan(c->own[0])) {
		pm_effect_off(d, s->kind != PM_VORTICES ? "no vorticity" : s->pairs ? "pairs are summed, there is no mesh" : "no face is open");
		return;
	}
	pm_effect_by(d, s, c->own[0], c->own[0]);
	d->answer = c->own[0] > s->accuracy ? PM_PUT_IN : PM_LEFT_OUT;
	if (d->answer == PM_PUT_IN)
		snprintf(d->text, sizeof d->text, "%.2g of the vorticity leaves the mesh from t = %.3g on; a mesh that follows it has at least %.2g times"
			" the points", c->own[0], c->frame->time + c->own[1], c->own[2]);
	else
		snprintf(d->text, sizeof d->text, "%.1g of the vorticity leaves the mesh", c->own[0]);
}

const struct pm_effect effect_outgrowing = {
	.name = "outgrowing",
	.sentence = "vorticity that leaves its mesh",
	.source = "Cottet and Koumoutsakos 2000, section 7.3",
	.numerical = true,
	.measure = measure,
	.decide = decide,
};
