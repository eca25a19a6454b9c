/* For the layer that runs stages (lib/stage, sentence, cycle, planner) and the readers and writers of frames; methods and words do not include it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_RUN_H
#define PM_STREAM_RUN_H

#include "stream/declare.h"

PM_C_BEGIN

struct pm_frame *pm_frame_header(const struct pm_frame *f); /* a copy without data, to try declare() on */

int pm_frame_affordable(const struct pm_frame *f); /* fails where a few bytes of header would become gigabytes */
/* Between declare() and frame(): expands uniform fields that are read, zeroes new ones, makes changed ones writable. */
int pm_frame_ready(struct pm_frame *f);
/* After frame(): rounds f32, checks that changed values are finite (else -PM_NUMERICS with the place), clears the use bits, frees dropped fields. */
int pm_frame_settle(struct pm_frame *f);

int pm_field_hold(struct pm_field *field);            /* a buffer of its own, contents undefined */
void pm_field_forget(struct pm_field *field);         /* frees the data, as after a change of the uniform value */
int pm_field_settle(struct pm_field *field);
int pm_field_resize(struct pm_field *field, size_t count);
int pm_field_check(struct pm_field *field, int code); /* are all values finite? else failure with that code and the place; reals only */
struct pm_field *pm_field_copy(const struct pm_field *field, bool with_data);
struct pm_field *pm_field_free(struct pm_field *field);

PM_C_END

#endif
