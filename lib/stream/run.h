/* For the layer that runs stages (lib/stage, sentence, cycle, planner) and the readers and writers of frames; methods and words do not see it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_RUN_H
#define PM_STREAM_RUN_H

#include "stream/declare.h"

PM_C_BEGIN

struct pm_frame *pm_frame_header(const struct pm_frame *f); /* a copy without data, to try declare() on */

/* Between declare() and frame(): uniform fields that are read are filled in, new ones are zero, changed ones are ours to write. */
int pm_frame_ready(struct pm_frame *f);
/* After frame(): what was changed is finite (else -PM_NUMERICS naming it), f32 is rounded, the use bits are cleared, what was dropped goes. */
int pm_frame_settle(struct pm_frame *f);

int pm_field_hold(struct pm_field *field);            /* a buffer of its own, contents undefined */
void pm_field_forget(struct pm_field *field);         /* lets the data go, as after a change of the uniform value */
int pm_field_settle(struct pm_field *field);
int pm_field_resize(struct pm_field *field, size_t count);
int pm_field_check(struct pm_field *field, int code); /* finite, or failure with that code naming the place; reals only */
struct pm_field *pm_field_copy(const struct pm_field *field, bool with_data);
struct pm_field *pm_field_free(struct pm_field *field);

PM_C_END

#endif
