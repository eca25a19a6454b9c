/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-box.h"

/* Whether the default mesh has fields that differ from point to point. */
static bool has_fields(const struct pm_frame *f)
{
	const struct pm_mesh *m = pm_frame_mesh(f, NULL);
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->on, m->name) && !f->fields[i]->uniform)
			return true;
	return false;
}

int pm_scene_box(const struct pm_scene *scene, const struct pm_scene_choice *c, struct pm_frame *f, bool other_faces)
{
	const bool fields = has_fields(f), nodes = scene->n_fixed && !scene->n;
	bool moved = false, periodic = false, along = false;
	for (int d = 0; d < f->dim && c->box; d++) {
		const bool here = f->face[d][0] == PM_PERIODIC, away = f->lo[d] != c->lo[d] || f->hi[d] != c->hi[d];
		periodic = periodic || here, moved = moved || away, along = along || (here && away);
		f->lo[d] = c->lo[d], f->hi[d] = c->hi[d];
	}
	if (fields && other_faces)
		return pm_fail(PM_USAGE, "the fields of this scene are made for its own faces (leave out --faces)");
	if (fields && moved)
		return pm_fail(PM_USAGE, "the fields of the scene %s are made for its own box (leave out --box)", scene->name);
	if (!scene->any_box && (along || (nodes && periodic)))
		return pm_fail(PM_USAGE, "the particles of the scene %s fill its own periodic box (leave out --box)", scene->name);
	return 0;
}

int pm_scene_periods(const struct pm_frame *f)
{
	int n = 0;
	for (int d = 0; d < f->dim; d++)
		n += f->face[d][0] == PM_PERIODIC;
	return n;
}
