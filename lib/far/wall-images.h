/* Images of particles in plane walls, for sums over pairs beside them. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FAR_WALL_IMAGES_H
#define PM_FAR_WALL_IMAGES_H

#include "far/bodies.h"

/* Has this axis one wall or neumann face, and the other end open? Then the images are a finite number. */
bool pm_wall_alone(const struct pm_frame *f, int axis);
/* Puts the images of all sources behind them, as sources alone. 0 or failure: a particle outside a wall, by name. */
int pm_wall_images(const struct pm_frame *f, const struct pm_far *far, struct pm_bodies *b);

#endif
