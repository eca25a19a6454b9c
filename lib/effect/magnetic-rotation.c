/* Magnetic rotation: v turns about a given B by omega_c T, omega_c = q B/m, in the time of the run; omega_c dt is the angle of a step.
 * Source: Birdsall and Langdon 1985, section 4-3. SPDX-License-Identifier: GPL-3.0-or-later */
#include "effect/effect.h"

static void decide(const struct pm_scales *s, struct pm_decision *d)
{
	if (isnan(s->cyclotron)) {
		effect_off(d, "no magnetic field");
		return;
	}
	effect_by(d, s, s->cyclotron * s->dt, s->cyclotron * s->time);
	snprintf(d->text, sizeof d->text, "omega_c dt = %.2g, omega_c T = %.2g", s->cyclotron * s->dt, s->cyclotron * s->time);
}

const struct pm_effect effect_magnetic_rotation = {
	.name = "magnetic-rotation",
	.sentence = "velocities turn about a magnetic field",
	.source = "Birdsall and Langdon 1985, section 4-3",
	.decide = decide,
};
