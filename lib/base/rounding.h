/* How a process rounds (rounding.c). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_ROUNDING_H
#define PM_ROUNDING_H

/* Rounding from now on: nearest, up, down, zero; NULL or empty: as it is. 0, or failure with a message. */
int pm_rounding(const char *name);

#endif
