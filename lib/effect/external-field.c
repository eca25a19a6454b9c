/* External field: a field given on a mesh (E, or u for particles that are carried). It matters by what it makes of the velocity, (q/m) E T over the largest
 * speed that there is or comes of it. A given field of zeros is none. Source: the definition. SPDX-License-Identifier: GPL-3.0-or-later */
#include "effect/effect.h"

static void decide(const struct pm_scales *s, struct pm_decision *d)
{
	const double gain = s->given * s->time, share = gain / (gain + s->v_rms);
	if (isnan(s->given)) {
		effect_off(d, "none is given");
		return;
	}
	if (s->given == 0) {
		effect_off(d, "the given field is 0");
		return;
	}
	if (s->kind == PM_CARRIED) {
		effect_by(d, s, s->given, 1);
		snprintf(d->text, sizeof d->text, "largest u = %.2g", s->given);
		return;
	}
	effect_by(d, s, gain, share);
	snprintf(d->text, sizeof d->text, "(q/m) E T = %.2g, the part %.1g of the speeds", gain, share);
}

const struct pm_effect effect_external_field = {
	.name = "external-field",
	.sentence = "a field given on a mesh",
	.source = "Birdsall and Langdon 1985, section 4-3",
	.decide = decide,
};
