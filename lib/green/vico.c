/* The truncated-kernel spectral Green's function: Green's function truncated beyond the longest separation in the box has a known, smooth transform,
 * which is sampled on frequencies fine enough for box + that distance (about 4n per axis). Transformed back to separations it is used on a doubled domain
 * like any other. No special value at 0 and no sampling error: the result is as accurate as the source is resolved and small at the faces.
 * Source: Vico, Greengard and Ferrando 2016, chapters 2 and 3. Cost: transforms of twice the octant per axis, once.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "green-parts/truncated.h"

static void prepare(struct pm_green_case *c)
{
	pm_truncated_prepare(c);
}

static double transform(const struct pm_green_case *c, double k2)
{
	return pm_truncated(c, k2);
}

const struct pm_green green_vico = {
	.name = "vico",
	.sentence = "the truncated kernel, spectrally accurate",
	.source = "Vico, Greengard and Ferrando 2016",
	.order = 0,
	.plain = 1u << 1 | 1u << 2 | 1u << 3,
	.screened = 1u << 1 | 1u << 2 | 1u << 3,
	.transform = transform,
	.prepare = prepare,
};
