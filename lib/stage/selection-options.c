/* What the options of a selection name. SPDX-License-Identifier: GPL-3.0-or-later */
#include "stage/selection-options.h"

struct pm_selection pm_selection_of(const struct pm_selection_options *o)
{
	return (struct pm_selection){.sets = {o->sets.item, o->sets.n}, .meshes = {o->meshes.item, o->meshes.n}, .fields = {o->fields.item, o->fields.n},
		.drop = {o->drop.item, o->drop.n}};
}
