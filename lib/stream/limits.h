/* The limits of a change field: how fast it makes its state decay, oscillate and strain (struct pm_limits). The word that adds to the change states them, and
 * push compares them with the stability region of its scheme. They travel in the tail, under the key limits (docs/stream.md), and go with their field:
 * a field that is dropped or made anew loses them. Streams of older versions have a decay alone, as the key `fastest` of the field's header.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_LIMITS_H
#define PM_STREAM_LIMITS_H

#include "stream/frame.h"

enum { PM_LIMITS_KEY = 2 * PM_NAME };

/* One more contribution: decays add, of the others the largest counts; what is not finite or not above 0 is left out. */
void pm_limits_add(struct pm_field *change, struct pm_limits more);
struct pm_limits pm_limits_of(const struct pm_field *change); /* with `fastest` */
/* The same, but of rates that are left to be made (they are new, and have no `fastest`): no less, and near where the oscillation is above `enough`. Makes
 * none. */
struct pm_limits pm_limits_most(const struct pm_field *change, double enough);

/* For readers and writers of frames. */
void pm_limits_key(const struct pm_field *field, char key[PM_LIMITS_KEY]);         /* owner/name */
json_t *pm_limits_json(const struct pm_frame *f);                                  /* of all fields; NULL: none has any */
int pm_limits_check(const json_t *limits);                                         /* 0, or failure: not such an object; NULL is allowed */
void pm_limits_take(const json_t *limits, const char *key, struct pm_field *change); /* adds the entry `key` to the field, if there is one */
int pm_limits_take_all(const json_t *limits, struct pm_frame *f);                  /* checks and takes; 0 or failure */

#endif
