/* Particles beyond the open faces of the mesh whose field the law uses: their number, and the energy between them and those inside, sum q_j phi(x_j) with
 * the potential of the ball that stands for those inside (lib/transfer/outside.c). Cost: a pass over the positions, three where any is outside.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/measure.h"
#include "stream/declare.h"
#include "transfer/outside.h"
#include "world/world.h"

/* 1: prepared for the first mesh with a density, potential or field of the law; 0: there is none, or it is not open; or failure. */
static int find(const struct pm_measure *how, const struct pm_frame *f, struct pm_outside_force *o, enum pm_outside *what)
{
	const char *const names[] = {how->density, how->potential, how->field};
	for (size_t i = 0; i < f->nmeshes && how->outside; i++)
		for (int k = 0; k < 3; k++) {
			const struct pm_field *made = names[k] ? pm_frame_field(f, f->meshes[i]->name, names[k]) : NULL;
			const int found = made ? pm_outside_init(o, f, f->meshes[i], made) : 0;
			*what = made ? made->outside : PM_OUTSIDE_DROP;
			if (found)
				return found;
		}
	return 0;
}

bool pm_measure_has_outside(const struct pm_measure *how, const struct pm_frame *f)
{
	struct pm_outside_force o;
	enum pm_outside what;
	return find(how, f, &o, &what) == 1;
}

void pm_outside_of_reads(const struct pm_measure *how, struct pm_frame *f)
{
	struct pm_outside_force o;
	enum pm_outside what;
	if (find(how, f, &o, &what) == 1)
		pm_outside_reads(&o, f);
}

int pm_outside_of(const struct pm_measure *how, const struct pm_frame *f, double *count, double *energy)
{
	struct pm_outside_force o;
	enum pm_outside what;
	bool any = false;
	int status = find(how, f, &o, &what);
	*count = status == 1 ? 0 : NAN;
	*energy = 0;
	if (status != 1)
		return status;
	status = 0;
	for (size_t i = 0; i < o.sources.n && !any && !status; i++)
		status = pm_outside_any(f, o.sources.name[i], &o.transfer, &any);
	int64_t anywhere = any; /* of all ranks */
	status = pm_world_count(status, PM_MOST_OF, 1, &anywhere);
	if (!anywhere || status)
		return status;
	status = pm_outside_measure(&o, f);
	*count = (double)o.count;
	*energy = what == PM_OUTSIDE_MONOPOLE ? o.energy : 0;
	return status;
}
