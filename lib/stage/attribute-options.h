/* Options that set attributes of a frame, the same in every tool that has them. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_ATTRIBUTE_OPTIONS_H
#define PM_STAGE_ATTRIBUTE_OPTIONS_H

#include "stage/stage.h"

/* "G=1.5" into a name and a number, or a name and a text. */
int pm_attributes_pair(const char *text, char name[PM_NAME], double *value);
int pm_attributes_words(const char *text, char name[PM_NAME], const char **value);
/* Each returns 0 or failure; a list or vector that was not given (n = 0) changes nothing. */
int pm_attributes_law(struct pm_frame *f, const char *law);                  /* and its default constants, unless they are set */
int pm_attributes_constants(struct pm_frame *f, const struct pm_list *list); /* NAME=VALUE */
int pm_attributes_units(struct pm_frame *f, const char *on, const struct pm_list *list); /* FIELD=UNIT */
int pm_attributes_units_anywhere(struct pm_frame *f, const struct pm_list *list); /* on every set and mesh that has the field; at least one must */
int pm_attributes_fixed(struct pm_frame *f, const struct pm_list *list, bool fixed); /* sets that push must not move; sets that it moves again */
int pm_attributes_rename(struct pm_frame *f, const struct pm_list *list); /* OLD=NEW, sets, meshes and fields */
int pm_attributes_corners(const struct pm_vector *box, int dim, double lo[], double hi[]); /* lo,hi of every axis, or all lo, then all hi */
int pm_attributes_box(struct pm_frame *f, const struct pm_vector *box);      /* of the frame, if given */
/* One word for all faces, one per axis, or low,high per axis. If an axis becomes periodic for the fields, or stops being so, the same is done for the
 * particles. */
int pm_attributes_faces(struct pm_frame *f, const struct pm_list *list);
int pm_attributes_particle_faces(struct pm_frame *f, const struct pm_list *list);

#endif
