/* The name nearest to a misspelt one, for messages. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_BASE_NEAREST_NAME_H
#define PM_BASE_NEAREST_NAME_H

/* name if it is nearer to word than best, whose distance is *least. */
const char *pm_nearer(const char *word, const char *name, const char *best, int *least);
const char *pm_nearest(const char *word, const char *const *names); /* of a list that ends in NULL; NULL if none is near */

#endif
