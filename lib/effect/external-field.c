/* External field: a field given on a mesh (E, or u for passive particles). Its share is the change of velocity, (q/m) E T, over the largest
 * speed before or after it. A given field of zeros does not count. Source: the definition. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "law/law.h"
#include "stream/declare.h"

static const char *lacks(const struct pm_effect_case *c)
{
	return c->scales->light ? "the fields of the mesh are those that the particles and light make" : isnan(c->scales->given) ? "none is given" : NULL;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const char *missing = lacks(c);
	const double gain = s->given * s->time, share = gain / (gain + s->v_rms);
	if (missing) {
		pm_effect_off(d, missing);
		return;
	}
	if (s->given == 0) {
		pm_effect_off(d, "the given field is 0");
		return;
	}
	if (s->kind == PM_CARRIED) {
		pm_effect_by(d, s, s->given, 1);
		snprintf(d->text, sizeof d->text, "largest u = %.2g", s->given);
		return;
	}
	pm_effect_by(d, s, gain, share);
	snprintf(d->text, sizeof d->text, "(q/m) E T = %.2g, the part %.1g of the speeds", gain, share);
}

/* A magnetic field, which m2p also interpolates, is given on the same mesh. */
static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	const bool in = c->decision->answer == PM_PUT_IN, self = pm_effect_in(c, "self-field");
	const struct pm_mesh *m = pm_effect_given_mesh(c->frame, c->law);
	char words[160];
	if (c->scales->light || (!in && !pm_effect_in(c, "magnetic-rotation")) || !m || (self && !*pm_effect_own_mesh(c->frame, c->law)))
		return;
	snprintf(words, sizeof words, c->frame->nmeshes > 1 || self ? "m2p --mesh %s" : "m2p", m->name);
	pm_words_add(w, PM_SLOT_FORCES, words, "external field: %s, %s", in ? "on" : "off", c->decision->text);
}

static void stays(const struct pm_effect_case *c, char why[160])
{
	if (c->scales->given > 0 && !isnan(c->scales->cyclotron))
		snprintf(why, 160, "the field %s is in the frame (sel --drop %s)", c->law->field, c->law->field);
}

static bool reversible(const struct pm_effect_case *c) { return c->scales->given > 0 && !c->scales->light; }

/* A given field of zeros: m2p requires it on the mesh of the magnetic field. */
static int reverse(const struct pm_effect_case *c, bool in, struct pm_frame *f, struct pm_method *m)
{
	(void)in, (void)m;
	for (size_t i = 0; i < f->nmeshes; i++) {
		const struct pm_field *old = pm_frame_field(f, f->meshes[i]->name, c->law->field);
		struct pm_field *zero = old ? pm_makes(f, f->meshes[i]->name, c->law->field, old->components, PM_STATE) : NULL;
		if (old && !zero)
			return -PM_DATA;
		if (zero)
			zero->uniform = true;
	}
	return 0;
}

const struct pm_effect effect_external_field = {
	.name = "external-field",
	.sentence = "a field given on a mesh",
	.source = "Birdsall and Langdon 1985, section 4-3",
	.force = true,
	.decide = decide,
	.lacks = lacks,
	.stays = stays,
	.words = words,
	.reversible = reversible,
	.reverse = reverse,
};
