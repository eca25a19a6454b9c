/* How this process rounds (IEEE 754, 4.3), for the word digits. Threads that start later do as the one that starts them. Decimal text is read and written
 * in the same direction. SPDX-License-Identifier: GPL-3.0-or-later */
#include <fenv.h>
#include <string.h>

#include "base/base.h"
#include "base/rounding.h"

int pm_rounding(const char *name)
{
	static const struct {
		const char *name;
		int mode;
	} modes[] = {{"nearest", FE_TONEAREST}, {"up", FE_UPWARD}, {"down", FE_DOWNWARD}, {"zero", FE_TOWARDZERO}};
	if (!name || !*name)
		return 0;
	for (size_t i = 0; i < sizeof modes / sizeof *modes; i++)
		if (!strcmp(name, modes[i].name))
			return fesetround(modes[i].mode) ? pm_fail(PM_NUMERICS, "this processor cannot round %s", name) : 0;
	return pm_fail(PM_USAGE, "PM_ROUNDING is '%s' (nearest, up, down or zero)", name);
}
