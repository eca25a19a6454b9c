/* One number of a field that may be uniform. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_FIELD_VALUE_H
#define PM_STREAM_FIELD_VALUE_H

#include "stream/frame.h"

static inline bool pm_value_is_one(const struct pm_field *f) { return f->uniform && !f->buffer; } /* one for all, and no array of it */
static inline double pm_value_at(const struct pm_field *f, int c, size_t i) { return pm_value_is_one(f) ? f->value[c] : pm_in(f, c)[i]; }

#endif
