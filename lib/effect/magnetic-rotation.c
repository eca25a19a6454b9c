/* Magnetic rotation: v rotates about a given B by omega_c T, omega_c = q B/m, in the time of the run; omega_c dt is the angle of a step.
 * Source: Birdsall and Langdon 1985, section 4-3. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "law/law.h"
#include "stream/declare.h"

static const char *lacks(const struct pm_effect_case *c)
{
	return isnan(c->scales->cyclotron) ? "no magnetic field" : NULL;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const char *missing = lacks(c);
	if (missing) {
		pm_effect_off(d, missing);
		return;
	}
	pm_effect_by(d, s, s->cyclotron * s->dt, s->cyclotron * s->time);
	snprintf(d->text, sizeof d->text, "omega_c dt = %.2g, omega_c T = %.2g", s->cyclotron * s->dt, s->cyclotron * s->time);
}

static bool asked(const struct pm_frame *f, const struct pm_law *law, char what[64])
{
	const struct pm_field *field = NULL;
	for (size_t i = 0; i < f->nmeshes && law->magnetic && !field; i++)
		field = pm_frame_field(f, f->meshes[i]->name, law->magnetic);
	snprintf(what, 64, "a magnetic field %.40s", field ? field->name : "");
	return field && field->role == PM_STATE;
}

static void stays(const struct pm_effect_case *c, char why[160])
{
	if (!isnan(c->scales->cyclotron))
		snprintf(why, 160, "the field %s is in the frame (sel --drop %s)", c->law->magnetic, c->law->magnetic);
}

static void ask(const struct pm_effect_case *c, struct pm_method *m)
{
	if (c->decision->answer == PM_PUT_IN && !c->scales->light)
		m->kick = "boris/2";
}

/* The kick rotates the velocities; B is interpolated by the m2p of the self field, or by that of a given field. */
static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	if (c->decision->answer != PM_PUT_IN)
		return;
	pm_words_amend(w, PM_SLOT_OPENING, "push", "", "; magnetic rotation: on, %s", c->decision->text);
	pm_words_amend(w, PM_SLOT_FORCES, "m2p", "", "; brings B");
}

static bool reversible(const struct pm_effect_case *c) { return !isnan(c->scales->cyclotron) && !c->scales->light; }

static int reverse(const struct pm_effect_case *c, bool in, struct pm_frame *f, struct pm_method *m)
{
	(void)m;
	for (size_t i = 0; i < f->nmeshes && !in; i++) {
		struct pm_field *field = pm_frame_field(f, f->meshes[i]->name, c->law->magnetic);
		if (field)
			pm_drops(f, field);
	}
	return 0;
}

const struct pm_effect effect_magnetic_rotation = {
	.name = "magnetic-rotation",
	.sentence = "velocities turn about a magnetic field",
	.source = "Birdsall and Langdon 1985, section 4-3",
	.force = true,
	.asked = asked,
	.done_by = (const char *const[]){"boris", "boris-tan", "relativistic", "vay", "higuera-cary", "landau-lifshitz", NULL},
	.decide = decide,
	.lacks = lacks,
	.stays = stays,
	.ask = ask,
	.words = words,
	.reversible = reversible,
	.reverse = reverse,
};
