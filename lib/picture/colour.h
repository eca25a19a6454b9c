/* Colour maps in which equal steps of the number look like equal steps. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PICTURE_COLOUR_H
#define PM_PICTURE_COLOUR_H

#include "base/base.h"

extern const char *const pm_colour_names[]; /* NULL ends */
/* The colour at t in [0, 1] (clamped), of the map with this index in pm_colour_names. */
void pm_colour_of(int map, double t, unsigned char rgb[3]);
int pm_colour_find(const char *name); /* -1 if there is none */
double pm_colour_lightness(const unsigned char rgb[3]); /* CIE L*, 0 to 100 */

#endif
