/* Fields of two frames that are on one set or mesh, in one frame, which ranks can share as any other. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_JOINT_FRAME_H
#define PM_STREAM_JOINT_FRAME_H

#include "stream/frame.h"

/* Parameters of such a frame. */
#define PM_JOINT_PAIRS "pairs" /* of fields a0 b0 a1 b1 ..., which are its first ones */
#define PM_JOINT_IDS "ids"     /* 1: behind them are the ids of both */

/* Of the pairs a[i], b[i], i < n, of f and g. NULL: failure. */
struct pm_frame *pm_joint_frame(const struct pm_frame *f, const struct pm_frame *g, struct pm_field *const a[], struct pm_field *const b[], int n, bool ids);
/* No pairs, but the fields of f in use: all ranks will read them, and so check that they are finite. NULL: failure. */
struct pm_frame *pm_joint_check(const struct pm_frame *f);

/* A field of its own with the values of this rank, in a divided frame. NULL: failure. */
struct pm_field *pm_field_copy_here(const struct pm_field *field);
struct pm_field *pm_field_copy_free(struct pm_field *field); /* returns NULL */

#endif
