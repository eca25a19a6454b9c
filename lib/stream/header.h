/* A frame's header as JSON, both ways (docs/stream.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_HEADER_H
#define PM_STREAM_HEADER_H

#include "stream/frame.h"

extern const char *const pm_kind_names[]; /* value, strength */
json_t *pm_header_json(const struct pm_frame *f);                 /* NULL if a number is not finite, with a message */
int pm_header_frame(const json_t *header, struct pm_frame **f);   /* everything checked; unknown keys are kept */
size_t pm_field_wire(const struct pm_field *field);               /* bytes in the stream without padding; 0 if uniform */
char *pm_json_line(const json_t *j);                              /* canonical text: sorted keys, compact, %.17g; free() it */

static inline json_t *pm_json_number(double x) { return isfinite(x) ? json_real(x) : json_null(); }

#endif
