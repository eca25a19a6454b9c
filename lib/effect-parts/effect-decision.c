/* Decisions that several effects make alike. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/effect-decision.h"

static double rest_of(const struct pm_scales *s) { return s->self / (s->omega * s->omega * s->spacing); }

bool pm_effect_round_off(const struct pm_scales *s) { return s->second && rest_of(s) < 1e-9; }

bool pm_effect_cancels(const struct pm_scales *s)
{
	const double rest = rest_of(s);
	return pm_effect_round_off(s) && !s->walls && s->v_thermal <= 1e-7 * s->v_rms && rest * cosh(fmin(s->omega * s->time, 700)) < s->accuracy;
}

bool pm_effect_alone(const struct pm_scales *s)
{
	return s->kind == PM_NO_FIELD || s->kind == PM_CARRIED || s->sources < 1 || (s->sources < 2 && !s->walls) || pm_effect_cancels(s);
}

void pm_effect_off(struct pm_decision *d, const char *text)
{
	*d = (struct pm_decision){.answer = PM_LEFT_OUT, .number = NAN, .share = 0};
	snprintf(d->text, sizeof d->text, "%s", text);
}

bool pm_effect_ordered(const struct pm_scales *s)
{
	return s->kind == PM_CHARGES && s->noise * s->effective < 1 && s->thermal < 0.1 * s->omega * s->spacing;
}

bool pm_effect_quiet(const struct pm_scales *s)
{
	return s->kind == PM_CHARGES && s->bodies > s->n && s->noise * s->effective < 1e-3 && s->thermal > s->omega * s->spacing;
}

void pm_effect_by(struct pm_decision *d, const struct pm_scales *s, double number, double share)
{
	*d = (struct pm_decision){.answer = share > 0.5 * s->accuracy ? PM_PUT_IN : PM_LEFT_OUT, .number = number, .share = share};
}
