/* Periodic images: the field of the copies of the box beyond its periodic faces. They follow from the frame's faces: a transform includes them at no cost, but
 * open faces need a transform of twice the length per axis; so they are included if a face is periodic, and their share is printed:
 * (spread/box)^2 is the tide of the nearest image over the field at the edge of the cloud. Source: Hockney and Eastwood 1988, section 6-5.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "law/law.h"
#include "stream/frame.h"

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const double part = s->spread / s->box;
	if (!s->periodic)
		pm_effect_off(d, "no face is periodic");
	else if (pm_effect_alone(s))
		pm_effect_off(d, "no self field: the pull of the images is uniform");
	else {
		pm_effect_by(d, s, part, fmin(1, part * part));
		d->answer = PM_PUT_IN;
		d->kept = true;
		snprintf(d->text, sizeof d->text, "the box is periodic, spread/box = %.2g; %s includes them at no cost", part,
			s->light ? "the mesh" : s->pairs ? "the sum over pairs" : "the Fourier transform");
	}
}

static void stays(const struct pm_effect_case *c, char why[160])
{
	if (c->scales->periodic)
		snprintf(why, 160, "they belong to the faces of the frame (smod --faces open)");
}

static bool reversible(const struct pm_effect_case *c)
{
	return c->scales->periodic && !c->scales->light && !c->method->pairs && pm_effect_in(c, "self-field");
}

/* Open faces, which have no spectral symbol, and a mesh that follows the particles. */
static int reverse(const struct pm_effect_case *c, bool in, struct pm_frame *f, struct pm_method *m)
{
	(void)in;
	for (int k = 0; k < 2 * f->dim; k++) {
		f->face[k / 2][k % 2] = PM_OPEN;
		f->pface[k / 2][k % 2] = PM_POPEN;
	}
	m->order = c->law->order, m->symbol = NULL;
	m->grow = true;
	return 0;
}

const struct pm_effect effect_periodic_images = {
	.name = "periodic-images",
	.sentence = "the copies of the box beyond its periodic faces",
	.source = "Hockney and Eastwood 1988, section 6-5",
	.decide = decide,
	.stays = stays,
	.reversible = reversible,
	.reverse = reverse,
};
