/* Periodic images: the field of the copies of the box beyond its periodic faces. They belong to the frame's faces: a transform brings them for nothing, where
 * open faces cost a transform of twice the length per axis; so they are put in wherever a face is periodic, and the part they make is said:
 * (spread/box)^2 is the tide of the nearest image over the field at the edge of the cloud. Source: Hockney and Eastwood 1988, section 6-5.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "effect/effect.h"

static void decide(const struct pm_scales *s, struct pm_decision *d)
{
	const double part = s->spread / s->box;
	if (!s->periodic)
		effect_off(d, "no face is periodic");
	else if (effect_alone(s))
		effect_off(d, "no self field: the images pull evenly");
	else {
		effect_by(d, s, part, fmin(1, part * part));
		d->answer = PM_PUT_IN;
		d->kept = true;
		snprintf(d->text, sizeof d->text, "the box is periodic, spread/box = %.2g; the transform has them for nothing", part);
	}
}

const struct pm_effect effect_periodic_images = {
	.name = "periodic-images",
	.sentence = "the copies of the box beyond its periodic faces",
	.source = "Hockney and Eastwood 1988, section 6-5",
	.decide = decide,
};
