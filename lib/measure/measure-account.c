/* The account of the law's strength, of a vector the sum over its components: the sum of its absolute values over the sets, and what faces, cut-off, mesh and
 * given rates took away or added, as the words report it for the whole run. Cost N. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "measure/measure.h"
#include "stream/strengths.h"

void pm_account_of(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m)
{
	static const struct {
		enum pm_column column;
		const char *key;
	} part[] = {{PM_STRENGTH_ABSORBED, "absorbed"}, {PM_STRENGTH_CUT, "lost"}, {PM_STRENGTH_OUTSIDE, "outside"}, {PM_STRENGTH_GIVEN, "given"}};
	struct pm_strengths s = {.n = 0};
	m->value[PM_STRENGTH_SCALE] = NAN;
	for (size_t i = 0; i < f->nsets && how->strength; i++) {
		const struct pm_field *q = how->set && strcmp(how->set, f->sets[i]->name) ? NULL : pm_frame_field(f, f->sets[i]->name, how->strength);
		if (q && pm_is_strength(q))
			pm_strengths_add(q, &s);
	}
	for (size_t k = 0; k < sizeof part / sizeof *part; k++)
		m->value[part[k].column] = how->strength ? 0 : NAN;
	for (int c = 0; how->strength && c < (how->vector ? 3 : 1); c++) {
		char name[PM_NAME + 4];
		snprintf(name, sizeof name, how->vector ? "%.63s_%d" : "%.63s", how->strength, c);
		for (int i = 0; i < s.n; i++)
			if (!strcmp(s.of[i].name, name))
				m->value[PM_STRENGTH_SCALE] = s.of[i].scale + (isnan(m->value[PM_STRENGTH_SCALE]) ? 0 : m->value[PM_STRENGTH_SCALE]);
		for (size_t k = 0; k < sizeof part / sizeof *part; k++)
			m->value[part[k].column] += pm_strength_reported(f, part[k].key, name);
	}
}
