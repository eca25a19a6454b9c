/* What a stage declares: the sets, meshes and fields that it reads, changes, makes and drops. Scenes use them too, to make all fields.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_DECLARE_H
#define PM_STREAM_DECLARE_H

#include "stream/frame.h"

PM_C_BEGIN

/* Key in the header of a mesh field that mgrad made (lib/mesh/gradient-frame.h): the order of the differences. A stage that changes the values removes it. */
#define PM_DIFFERENCES "differences"

struct pm_set *pm_frame_set_new(struct pm_frame *f, const char *name, uint64_t n);
struct pm_mesh *pm_frame_mesh_new(struct pm_frame *f, const char *name, const size_t cells[3]); /* spans the box */

/* For declare(). Fields that are not declared keep their order and come first; changed and new ones follow in the order of these calls.
 * NULL means failure with a message. */
struct pm_field *pm_reads(struct pm_frame *f, const char *on, const char *name);   /* its data will be available, read-only */
struct pm_field *pm_changes(struct pm_frame *f, const char *on, const char *name); /* read and rewritten in place */
/* New, zero; replaces a field of that name; f64, a value, unit "": set other properties on the returned field. */
struct pm_field *pm_makes(struct pm_frame *f, const char *on, const char *name, int components, enum pm_role role);
/* Adds to the change field `name` of set `on` (rate of state `of`), made with zeros if missing. Fails if the term is already there, unless `replace`, which
 * zeroes the field first and fails if other terms would be lost. */
struct pm_field *pm_contributes(struct pm_frame *f, const char *on, const char *name, const char *of, int components, const char *term,
	bool replace);
void pm_drops(struct pm_frame *f, struct pm_field *field);
void pm_drops_roles(struct pm_frame *f, const char *on, unsigned roles); /* roles: bits 1u << enum pm_role; on NULL: every mesh */
/* The field is computed from this source too: it takes over the source's kernel, whether that is interlaced, and, if derived, what m2p is to do outside the
 * mesh and the sets it is made of. Sources without a kernel do not count; of two that differ the kernel is "several", which m2p refuses. */
void pm_field_inherit(struct pm_field *field, const struct pm_field *from);

/* For a stage that makes a field in frame() (sources, meshes that grow): allocates what was just declared, new values zero. */
int pm_field_ready(struct pm_field *field);
/* For a stage that changes the number of particles or mesh points (declare() returned PM_HOLD: everything is loaded). Every field of the set gets
 * count n and keeps its first values, so a stage that removes particles must compact first; fields of the mesh must be uniform, others are an error. */
int pm_frame_set_resize(struct pm_frame *f, struct pm_set *set, uint64_t n);
int pm_frame_mesh_resize(struct pm_frame *f, const struct pm_mesh *m);

PM_C_END

#endif
