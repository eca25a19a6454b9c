/* How push recognises a step that is too long for a change field: `fastest`, a key of its header, is the largest rate at which the change
 * makes its state decay [1/time], the largest eigenvalue of the linear operator behind it. Contributions are added. It is part of the field's header.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_FASTEST_H
#define PM_STREAM_FASTEST_H

#include "stream/frame.h"

static inline double pm_fastest(const struct pm_field *change) { return json_number_value(json_object_get(change->more, "fastest")); }

static inline void pm_fastest_add(struct pm_field *change, double rate)
{
	if (rate > 0)
		json_object_set_new(change->more, "fastest", json_real(pm_fastest(change) + rate));
}

#endif
