/* Options that scale, rotate, shift and boost particles, converted into a motion of sets. SPDX-License-Identifier: GPL-3.0-or-later */
#include "stage/attribute-options.h"
#include "stage/motion-options.h"

bool pm_motion_given(const struct pm_motion_options *o) { return o->scale.n || o->rotate || o->shift.n || o->boost.n; }

int pm_motion_begin(const struct pm_motion_options *o, struct pm_set_motion *m)
{
	*m = (struct pm_set_motion){.set = o->sets.item, .nsets = o->sets.n, .shift = o->shift.x, .nshift = o->shift.n,
		.boost = o->boost.x, .nboost = o->boost.n};
	return pm_turn_of(o->rotate, &m->turn);
}

int pm_motion_check(const struct pm_motion_options *o, struct pm_set_motion *m, const struct pm_frame *f)
{
	for (m->nfactors = 0; m->nfactors < o->scale.n; m->nfactors++) {
		struct pm_factor *factor = &m->factor[m->nfactors];
		int status = pm_attributes_pair(o->scale.item[m->nfactors], factor->field, &factor->by);
		if (status)
			return status;
	}
	return pm_set_motion_check(m, f);
}
