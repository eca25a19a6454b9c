/* Options that choose sets, meshes and fields of a frame: those of sel, and of cycle for what it writes. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_SELECTION_OPTIONS_H
#define PM_STAGE_SELECTION_OPTIONS_H

#include "expression/selection.h"
#include "stage/stage.h"

struct pm_selection_options {
	struct pm_list sets, meshes, fields, drop;
};

/* Rows of options; AT(MEMBER) is the offset of a member of the struct above; kept: they belong in the history (1) or not (0). */
#define PM_SELECTION_ROWS(AT, kept) \
	{.name = "set", .kind = PM_LIST, .unit = "NAME", .cosmetic = !(kept), AT(sets), .text = "keep only these sets"}, \
	{.name = "mesh", .kind = PM_LIST, .unit = "NAME", .cosmetic = !(kept), AT(meshes), .text = "keep only these meshes"}, \
	{.name = "field", .letter = 'f', .kind = PM_LIST, .unit = "NAME|ON/NAME", .cosmetic = !(kept), AT(fields), .text = "keep only these fields"}, \
	{.name = "drop", .kind = PM_LIST, .unit = "NAME|ON/NAME", .cosmetic = !(kept), AT(drop), .text = "remove these fields, sets or meshes"}

struct pm_selection pm_selection_of(const struct pm_selection_options *o);

#endif
