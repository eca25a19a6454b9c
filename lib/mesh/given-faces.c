/* The faces with given values of a mesh field, in its header. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/given-faces.h"

static const char key[] = "given_faces";
const char *const pm_face_places[3][2] = {{"x-low", "x-high"}, {"y-low", "y-high"}, {"z-low", "z-high"}};

bool pm_given_face(const struct pm_field *p, int d, int side)
{
	size_t i;
	json_t *name;
	json_array_foreach(json_object_get(p->more, key), i, name)
		if (json_is_string(name) && !strcmp(json_string_value(name), pm_face_places[d][side]))
			return true;
	return false;
}

void pm_given_face_mark(struct pm_field *p, int d, int side)
{
	if (!json_object_get(p->more, key))
		json_object_set_new(p->more, key, json_array());
	json_array_append_new(json_object_get(p->more, key), json_string(pm_face_places[d][side]));
}

void pm_given_faces_copy(struct pm_field *to, const struct pm_field *from)
{
	if (json_object_get(from->more, key))
		json_object_set(to->more, key, json_object_get(from->more, key));
}

void pm_given_faces_open(const struct pm_field *p, struct pm_grid *g)
{
	for (int d = 0; d < g->dim; d++)
		for (int side = 0; side < 2; side++)
			if (pm_given_face(p, d, side))
				g->face[d][side] = PM_OPEN;
}
