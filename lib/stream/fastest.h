/* What push must know of a change field to refuse a step that is too long: `fastest`, a key of its header, is the largest rate at which the change
 * makes its state decay [1/time], the largest eigenvalue of the linear operator behind it. Added up over contributions. It travels with the
 * field. SPDX-License-Identifier: GPL-3.0-or-later */
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
