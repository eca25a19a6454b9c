/* What diag measures of plasmas in addition to the quantities of all bodies: the charge of the particles, and the energy of each component of the field on the
 * first mesh that holds it or its potential (law-field.c), eps0/2 int E_c^2. Modes of the
 * law's field along x for any law. Missing quantities are NAN. Source: Birdsall and Langdon 1985, section 2-8 and 4-9.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "measure/growth.h"
#include "measure/law-field.h"
#include "measure/measure.h"
#include "stream/declare.h"
#include "stream/over-stretches.h"

static bool needs_field(const struct pm_measure *how) { return how->plasma || how->nmodes; }

void pm_plasma_reads(const struct pm_measure *how, struct pm_frame *f)
{
	if (needs_field(how))
		pm_law_field_reads(how, f);
}

static double charge(const struct pm_measure *how, const struct pm_frame *f)
{
	struct pm_sum sum = {0};
	size_t sets = 0;
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_field *q = how->set && strcmp(how->set, f->sets[i]->name) ? NULL : pm_frame_field(f, f->sets[i]->name, how->strength);
		if (q)
			pm_sum_of_stretches(q, pm_in(q, 0), NULL, &sum);
		sets += q != NULL;
	}
	return sets ? pm_sum_total(sum) : NAN;
}

static double largest(const struct pm_field *field)
{
	double most = 0;
	for (int c = 0; c < field->components; c++)
		for (size_t i = 0; i < field->count; i++)
			most = fmax(most, fabs(pm_in(field, c)[i]));
	return pm_most_of_stretches(field, most);
}

int pm_plasma_of(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m)
{
	struct pm_law_field law = {0};
	int status = needs_field(how) ? pm_law_field_of(how, f, &law) : 0;
	const struct pm_field *e = law.field;
	const struct pm_grid g = e ? pm_grid_of(f, pm_frame_mesh(f, e->on)) : (struct pm_grid){0};
	m->value[PM_CHARGE] = how->plasma ? charge(how, f) : NAN;
	for (int c = 0; c < 3; c++) /* eps0 is -1 over the coefficient of the law */
		m->value[PM_ENERGY_COMPONENT + c] = how->plasma && e && c < e->components
			? pm_energy_of_field(&g, e, pm_in(e, c), pm_in(e, c)) / -how->coefficient : NAN;
	for (int k = 0; k < how->nmodes; k++) {
		m->mode[k][0] = m->mode[k][1] = NAN;
		if (e && f->face[0][0] == PM_PERIODIC && !status)
			status = pm_mode(&g, e, pm_in(e, how->wave < e->components ? how->wave : 0), how->modes[k], m->mode[k]);
	}
	m->field_most = how->nmodes && e ? largest(e) : NAN;
	pm_law_field_free(&law);
	return status;
}
