/* The account of the law's strength: the sum of its absolute values over the sets, and what faces, cut-off, mesh and given rates took away or added, as the
 * words report it for the whole run. Cost N. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "measure/measure.h"
#include "stream/strengths.h"

void pm_account_of(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m)
{
	static const struct {
		enum pm_column column;
		const char *key;
	} part[] = {{PM_STRENGTH_ABSORBED, "absorbed"}, {PM_STRENGTH_CUT, "lost"}, {PM_STRENGTH_OUTSIDE, "outside"}, {PM_STRENGTH_GIVEN, "given"}};
	struct pm_strengths s;
	m->value[PM_STRENGTH_SCALE] = NAN;
	pm_strengths_of(f, how->set, &s);
	for (int i = 0; i < s.n; i++)
		if (how->strength && !strcmp(s.of[i].name, how->strength))
			m->value[PM_STRENGTH_SCALE] = s.of[i].scale + (isnan(m->value[PM_STRENGTH_SCALE]) ? 0 : m->value[PM_STRENGTH_SCALE]);
	for (size_t k = 0; k < sizeof part / sizeof *part; k++)
		m->value[part[k].column] = how->strength ? pm_strength_reported(f, part[k].key, how->strength) : NAN;
}
