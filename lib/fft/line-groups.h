/* Lines of a mesh along an axis, in groups of PM_FFT_LINES that are transformed together: along x rows of one plane, along y and z neighbours in x. Two lines
 * of a group round as the real and imaginary parts of one, so a group crosses neither a plane nor a row of pencils: what is in another plane changes no byte
 * (docs/distributed.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_LINE_GROUPS_H
#define PM_FFT_LINE_GROUPS_H

#include "fft/fft-block.h"

struct pm_line_group {
	size_t at, lines;    /* value of the first line's first node; lines, 1 .. PM_FFT_LINES */
	size_t across, step; /* from one line to the next, from one node to the next */
};

static inline size_t pm_line_groups_in(size_t lines) { return (lines + PM_FFT_LINES - 1) / PM_FFT_LINES; }

/* How many groups the lines along axis d have. */
static inline size_t pm_line_groups(const size_t points[3], int d)
{
	return d == 0 ? points[2] * pm_line_groups_in(points[1]) : points[d == 1 ? 2 : 1] * pm_line_groups_in(points[0]);
}

static inline struct pm_line_group pm_line_group(const size_t points[3], int d, size_t number)
{
	const size_t plane = points[0] * points[1], side = points[d == 0 ? 1 : 0], each = pm_line_groups_in(side), first = number % each * PM_FFT_LINES;
	const size_t left = side - first, outer = number / each;
	return (struct pm_line_group){.at = outer * (d == 2 ? points[0] : plane) + (d == 0 ? first * points[0] : first),
		.lines = left < PM_FFT_LINES ? left : PM_FFT_LINES, .across = d == 0 ? points[0] : 1, .step = d == 0 ? 1 : d == 1 ? points[0] : plane};
}

#endif
