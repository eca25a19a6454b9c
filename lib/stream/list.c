/* Lists of pointers that double at powers of two. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "stream/list.h"

void pm_name_copy(char to[PM_NAME], const char *from)
{
	const size_t n = strnlen(from, PM_NAME - 1);
	memmove(to, from, n);
	to[n] = 0;
}

void *pm_list_add(void ***list, size_t *n, void *item)
{
	if ((*n & (*n - 1)) == 0) { /* room for the next power of two */
		void **more = realloc(*list, (*n ? 2 * *n : 1) * sizeof *more);
		if (!more) {
			pm_no_memory();
			return NULL;
		}
		*list = more;
	}
	(*list)[(*n)++] = item;
	return item;
}

void pm_list_remove(void **list, size_t *n, const void *item)
{
	size_t i = 0;
	while (i < *n && list[i] != item)
		i++;
	if (i == *n)
		return;
	memmove(list + i, list + i + 1, (*n - i - 1) * sizeof *list);
	--*n;
	/* pm_list_add reallocates at powers of two only, so after shrinking there is always enough room */
}
