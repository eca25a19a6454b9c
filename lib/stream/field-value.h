/* One number of a field that may be uniform. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_FIELD_VALUE_H
#define PM_STREAM_FIELD_VALUE_H

#include "stream/frame.h"

static inline double pm_value_at(const struct pm_field *f, int c, size_t i) { return f->uniform && !f->buffer ? f->value[c] : pm_in(f, c)[i]; }

#endif
