/* A text, or a snapshot of NEMO, as a source of frames: the reading half of stab. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_TABLE_SOURCE_H
#define PM_STAGE_TABLE_SOURCE_H

#include "nemo/nemo.h"
#include "stage/stage.h"
#include "stream/table.h"

/* What is typed for a plain table. */
struct pm_table_options {
	const char *set, *law;
	int64_t dim;     /* not positive: as many as there are position columns */
	double dt, time;
	struct pm_vector box;
	struct pm_cells cells;
	struct pm_list constants, faces, particle_faces, units, skip, text, strength;
	bool number;     /* the rows, as a field id */
};

struct pm_table_source {
	struct pm_text text;
	bool open, over; /* the text: has been opened; was a table, which has been read */
	bool first_only; /* it is for rank 0, and the others follow */
	int file;        /* which of the arguments it is, from 0 */
	uint64_t frames; /* read of it */
	struct pm_nemo nemo; /* data NULL: it is text */
};

/* The name of the first option that was typed of those for reading a plain table; NULL none. */
const char *pm_table_option_given(const struct pm_stage *s);
bool pm_table_source_by_ranks(const struct pm_stage *s); /* its texts are files, of which each rank could read a share */
/* source(): opens one text after another; 1 and a frame, 0 at the end, or failure that names the file. */
int pm_table_source_next(struct pm_stage *s, struct pm_table_source *t, struct pm_table_options *o, struct pm_frame **f);
void pm_table_source_close(struct pm_table_source *t);

#endif
