/* Subgrid: the scales of a turbulent flow below the cells as a viscosity. Its number is the part of the dissipation beyond the mesh, that of smallest-scales.
 * Where particles are remeshed every few steps, remeshing takes the energy that the mesh cannot hold, and a model takes as much again from the scales that it
 * holds (docs/methods/subgrid.md: Taylor-Green at Re = 1600 on 32^3 cells); without remeshing nothing takes it, and it piles up.
 * Source: Germano et al. 1991; Lilly 1992; Cottet 1996. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	pm_effect_off(d, s->kind != PM_VORTICES ? "no vorticity" : s->dim < 3 ? "2-D: energy goes to the large scales" : "pairs are summed, there is no mesh");
}

/* After smallest-scales and remeshing have decided. */
static void reconsider(const struct pm_effect_case *c, struct pm_decision *d)
{
	double share = NAN;
	for (int i = 0; pm_effects[i]; i++)
		if (!strcmp(pm_effects[i]->name, "smallest-scales") && !isnan(c->decided[i].number))
			share = c->decided[i].share;
	const struct pm_scales *s = c->scales;
	if (s->kind != PM_VORTICES || s->dim < 3 || s->pairs)
		return;
	if (isnan(share)) {
		pm_effect_off(d, "nu = 0: there is no smallest scale");
		return;
	}
	const bool below = share > s->accuracy, taken = pm_effect_in(c, "remeshing");
	*d = (struct pm_decision){.answer = below && !taken ? PM_PUT_IN : PM_LEFT_OUT, .number = share, .share = taken ? 0 : share};
	snprintf(d->text, sizeof d->text, "%.1g of the dissipation is below the cells%s", share, !below ? "" : taken ? ", and remeshing takes it" :
		", and nothing else takes it");
}

static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	if (c->decision->answer != PM_PUT_IN || c->method->pairs)
		return;
	pm_words_add(w, PM_SLOT_MESH, "subgrid --model dynamic", "subgrid: on, %s", c->decision->text);
	pm_words_amend(w, PM_SLOT_PARTICLES, "m2p", "", ", and the change of their strengths by the model");
}

static const char *lacks(const struct pm_effect_case *c)
{
	return c->scales->kind == PM_VORTICES && c->scales->dim == 3 && !c->scales->pairs ? NULL : "no vorticity in space on a mesh";
}

/* Beside remeshing a model changes what the mesh holds, which proves nothing about what it does not. */
static bool reversible(const struct pm_effect_case *c)
{
	return c->scales->kind == PM_VORTICES && c->scales->dim == 3 && !c->scales->pairs && !pm_effect_in(c, "remeshing");
}

/* One step of the strengths, as for diffusion. */
static void test(const struct pm_effect_case *c, struct pm_effect_test *t)
{
	(void)c;
	t->of = PM_TEST_STRENGTH;
	t->steps = 1;
}

const struct pm_effect effect_subgrid = {
	.name = "subgrid",
	.sentence = "the scales below the cells as a viscosity",
	.source = "Germano et al. 1991; Lilly 1992",
	.word = "subgrid",
	.decide = decide,
	.reconsider = reconsider,
	.words = words,
	.lacks = lacks,
	.reversible = reversible,
	.test = test,
};
