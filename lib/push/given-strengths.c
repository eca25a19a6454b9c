/* Which strengths a push changes in total, as its rates say. Diffusion exchanges strength between particles; its rates add up to 0 but for what passes through
 * a wall, where the density is held at 0. Those of stretching add up to 0, or to the error of its differences.
 * Every other rate of a strength is given by the user. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "push/push-set.h"

static bool passes(const struct pm_frame *f)
{
	for (int k = 0; k < 2 * f->dim; k++)
		if (f->face[k / 2][k % 2] == PM_WALL || f->face[k / 2][k % 2] == PM_ABSORBING)
			return true;
	return false;
}

static bool given(const struct pm_frame *f, const struct pm_field *rate)
{
	for (int t = 0; t < rate->nterms; t++)
		if (strcmp(rate->terms[t], "diffusion") && strcmp(rate->terms[t], "stretching"))
			return true;
	return passes(f);
}

void pm_moving_given(const struct pm_frame *f, const struct pm_moving *m, struct pm_strengths *s)
{
	s->n = 0;
	for (int r = 0; r < m->n; r++)
		if (pm_is_strength(m->rates[r].state) && given(f, m->rates[r].rate))
			pm_strengths_add(m->rates[r].state, s);
}
