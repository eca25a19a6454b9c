/* Changes to the header of a frame that affect several fields. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_EDIT_H
#define PM_STREAM_EDIT_H

#include "stream/frame.h"

int pm_frame_rename(struct pm_frame *f, const char *old, const char *new); /* a set, a mesh, or all fields of that name */
/* Box and meshes, about the origin. */
void pm_frame_stretch(struct pm_frame *f, double by);
/* New boxes or faces change the meshes, so mesh fields must be computable again: 0, or failure that names a field of role state. */
int pm_frame_meshes_free(const struct pm_frame *f);
/* The state is about to change: change and derived fields of all sets and meshes are dropped. 0, or failure inside a step. */
int pm_frame_outdate(struct pm_frame *f);
/* In declare(): "f32", or "x=f64". Changes the type of real fields; those with data are marked as changed, so that they are rounded. */
int pm_frame_store(struct pm_frame *f, const char *choice);
/* In declare(): multiplies the value of a uniform field, and forgets what an earlier word within a cycle has filled in. */
void pm_uniform_scale(struct pm_field *field, double by);

#endif
