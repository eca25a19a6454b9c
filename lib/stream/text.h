/* Frames as text, exactly (docs/methods/text.md): the header as a line of JSON, then the fields that are not uniform as tables.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_TEXT_H
#define PM_STREAM_TEXT_H

#include "stream/table.h"

/* #pmpipe {header} / #report {report} / #limits {limits} / #set NAME and its table / #mesh NAME and its table ... */
int pm_text_frame_write(FILE *out, struct pm_frame *f);
void pm_text_end_write(FILE *out, uint64_t frames); /* #end FRAMES */
bool pm_text_is_frames(struct pm_text *t);          /* does the next line start or end the frames? */
int pm_text_frames_index(struct pm_text *t);        /* before the first: where tables begin, for ranks that share the text; agreed */
/* The next frame: 1, or 0 after the end, or failure. *frames counts them and is checked against each end line. */
int pm_text_frame_read(struct pm_text *t, struct pm_frame **f, uint64_t *frames);

#endif
