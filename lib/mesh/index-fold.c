/* Points beyond the ends of an axis (index-fold.h): periodic by division with remainder, else mirrored at one end after the other until inside. Apart from
 * the inline functions, so that these cost loops over rows no more than a comparison. SPDX-License-Identifier: GPL-3.0-or-later */
#include "mesh/index-fold.h"

size_t pm_index_beyond(ptrdiff_t i, const struct pm_index_axis *a, int *factor)
{
	const ptrdiff_t last = (ptrdiff_t)a->points - 1;
	*factor = 1;
	if (i >= 0 && i <= last)
		return (size_t)i;
	if (a->periodic)
		return (size_t)((i % (last + 1) + last + 1) % (last + 1));
	if (last == 0 && !a->staggered)
		return 0;
	while (i < 0 || i > last) {
		*factor *= a->image[i > last];
		i = i < 0 ? -i - a->staggered : 2 * last + a->staggered - i;
	}
	return (size_t)i;
}
