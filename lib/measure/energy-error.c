/* When does a run of bodies that attract each other on a mesh no longer keep its energy? Only where it should: masses in open space, bound at the start, under
 * no other force than their own. Its bound, 5 %, is passed by cic when a cold sphere collapses into a few cells (10 %), not by tsc (2 %) or pcs (0.03 %):
 * tests/hard/pm-force.bats. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "measure/energy-error.h"

static const double bound = 0.05; /* of |E| at the first frame */

static bool alone(const struct pm_measure *how, const struct pm_frame *f)
{
	bool any = false;
	for (int k = 0; k < 2 * f->dim; k++)
		if (f->face[k / 2][k % 2] != PM_OPEN || f->pface[k / 2][k % 2] != PM_POPEN)
			return false;
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *a = f->fields[i];
		if (a->role != PM_CHANGE)
			continue;
		if (strcmp(a->of, "v") || a->nterms != 1 || strcmp(a->terms[0], "self"))
			return false;
		any = true;
	}
	return any && !how->set && !how->pair && how->potential && !how->plasma && !how->vortices;
}

/* Of the density, "" if there is none. */
static const char *kernel(const struct pm_measure *how, const struct pm_frame *f)
{
	for (size_t i = 0; i < f->nmeshes; i++) {
		const struct pm_field *density = pm_frame_field(f, f->meshes[i]->name, how->density);
		if (density)
			return density->kernel;
	}
	return "";
}

bool pm_energy_error_note(struct pm_energy_error *e, const struct pm_measure *how, const struct pm_frame *f, const struct pm_measures *m, char text[320])
{
	const double energy = m->value[PM_ENERGY], field = m->value[PM_ENERGY_MESH];
	if (!alone(how, f) || !isnan(m->value[PM_ENERGY_PAIR]) || !isfinite(energy))
		return false;
	if (!e->known) {
		*e = (struct pm_energy_error){true, energy, f->step};
		return false;
	}
	const double error = fabs((energy - e->first) / e->first);
	if (!(e->first < 0 && -e->first > 0.1 * fabs(field)) || !(error > bound))
		return false;
	const char *k = kernel(how, f), *smoother = !strcmp(k, "cic") || !strcmp(k, "ngp") ? "p2m --kernel tsc or pcs, " : !strcmp(k, "tsc")
		? "p2m --kernel pcs, " : "";
	snprintf(text, 320, "step %lld: |dE/E| is %.2g since step %lld: the mesh force of %s on these cells does not keep the energy (%smore cells, a "
		"shorter dt, or pp)", (long long)f->step, error, (long long)e->step, k, smoother);
	return true;
}
