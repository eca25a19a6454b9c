/* A plain table as a frame: the names of the columns determine the fields. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_COLUMNS_H
#define PM_STREAM_COLUMNS_H

#include "stream/table.h"

struct pm_columns_choice {
	const char *set;                       /* name of the set made */
	int dim;                               /* 0: the number of position columns */
	const char *const *skip, *const *text, *const *strength; /* names of columns, each list ended by NULL */
	bool number;                           /* a field id that counts the rows from 0 */
};

/* x y z are the positions x, vx vy vz the velocity v, NAME_0 NAME_1 ... one field, id a field of whole numbers, name (and what `text` lists) letters,
 * any other column a field of its own; mass, charge, circulation and what `strength` lists are strengths. All have the role state. The box is not changed. */
int pm_columns_frame(struct pm_text *t, const struct pm_columns_choice *choice, struct pm_frame **f);
/* A cube about the particles: centred on their bounding box, twice its longest side (1 where that is 0). */
void pm_columns_box(struct pm_frame *f, const char *set);

#endif
