/* Letters as strokes of a round pen. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PICTURE_LETTERING_H
#define PM_PICTURE_LETTERING_H

enum { PM_CAPITAL = 14, PM_STROKES = 96 }; /* height of a capital in units of the strokes; the most segments of a letter */

/* The segments x0 y0 x1 y1 of an ASCII letter, base line at 0, y upwards; returns their number and the width with the space behind. */
int pm_lettering(char c, double segments[PM_STROKES][4], double *width);

#endif
