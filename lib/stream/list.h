/* Lists of pointers inside a frame. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_LIST_H
#define PM_STREAM_LIST_H

#include "stream/frame.h"

void pm_name_copy(char to[PM_NAME], const char *from);        /* truncated, never overrun; readers reject longer names before */
void *pm_list_add(void ***list, size_t *n, void *item);       /* the item, or NULL without memory */
void pm_list_remove(void **list, size_t *n, const void *item);

#endif
