/* Numbers packed into text for a page. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_VIEWER_PACK_H
#define PM_VIEWER_PACK_H

#include <jansson.h>

#include "base/base.h"

enum pm_viewer_as {
	PM_AS_F32, /* as it is, or divided by the largest magnitude where f32 does not reach */
	PM_AS_F16, /* divided by the largest magnitude: 3 digits, over 7 decades */
	PM_AS_U16  /* in 65535 equal steps from lo to hi */
};

struct pm_viewer_blocks { /* texts in base64, one after the other */
	size_t n, room, bytes;
	char **text;
};

/* Packs n finite values as the next block. Its description for the page: {"at": number of the block, "as": type, "lo", "step"}: value = lo + step * stored.
 * NULL without memory. */
json_t *pm_viewer_pack(struct pm_viewer_blocks *b, size_t n, const double *value, enum pm_viewer_as as, double lo, double hi);
void pm_viewer_blocks_free(struct pm_viewer_blocks *b);
uint16_t pm_half_of(float x); /* IEEE 754 binary16, to the nearest, ties to even; |x| <= 65504 */

#endif
