/* Stream: a uniform flow U that no vorticity of the frame makes, and that carries it. Its share is U/(U + u), u the rms velocity that the vorticity gives.
 * U is that of the scene, or the constants stream_x, stream_y, stream_z of the frame.
 * Source: Cottet and Koumoutsakos 2000, section 4.1 (u = curl psi + grad phi).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/body-in-flow.h"
#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"

/* [length/time] The stream past the vortices; 0: none. */
static double speed(const struct pm_effect_case *c)
{
	struct pm_scene_solid b;
	char text[96];
	pm_effect_body(c->frame, &b);
	return pm_effect_stream(c->frame, &b, text);
}

static const char *lacks(const struct pm_effect_case *c)
{
	return c->scales->kind != PM_VORTICES ? "no vorticity" : speed(c) > 0 ? NULL : "none is given (smod --constant stream_x=U)";
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const double U = speed(c);
	const char *missing = lacks(c);
	if (missing) {
		pm_effect_off(d, missing);
		return;
	}
	pm_effect_by(d, s, U, U / (U + s->self));
	snprintf(d->text, sizeof d->text, "U = %.3g, the part %.1g of the speeds, moves %.2g of the box in the time T", U, d->share, U * s->time / s->box);
}

static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	struct pm_scene_solid b;
	char text[96], words[160];
	if (c->decision->answer != PM_PUT_IN)
		return;
	pm_effect_body(c->frame, &b);
	pm_effect_stream(c->frame, &b, text);
	snprintf(words, sizeof words, "field 'vel = %s'", text);
	pm_words_add(w, PM_SLOT_FORCES, words, "stream: on, %s", c->decision->text);
}

static bool reversible(const struct pm_effect_case *c) { return c->decision->answer == PM_PUT_IN; }

const struct pm_effect effect_stream = {
	.name = "stream",
	.sentence = "a uniform flow that carries the vorticity",
	.source = "Cottet and Koumoutsakos 2000, section 4.1",
	.word = "field",
	.decide = decide,
	.lacks = lacks,
	.words = words,
	.reversible = reversible,
};
