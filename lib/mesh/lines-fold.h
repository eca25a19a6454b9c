/* Sine and cosine transforms of blocks of lines (mesh/lines.h) by complex FFTs of length n; of mesh/lines.c. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LINES_FOLD_H
#define PM_LINES_FOLD_H

#include "mesh/lanes.h"

/* Walls, neumann faces, a wall below a neumann face, a wall above one. */
enum pm_fold { PM_FOLD_NONE, PM_FOLD_SINE, PM_FOLD_COSINE, PM_FOLD_QUARTER_SINE, PM_FOLD_QUARTER_COSINE };

/* f: of pm_fft_folded, n cells. Nodes 0 ... n in rows 0 ... n (what is on a wall is not read, and not set on the way back); modes as of pm_line_real, but quarter
 * waves of a wall below have the sign (-1)^m. Both together multiply by 2n. */
void pm_fold(enum pm_fold fold, const struct pm_fft *f, double *block);
void pm_fold_back(enum pm_fold fold, const struct pm_fft *f, double *block);
/* The row of mode number `mode` (0: the lowest), on both ways. */
size_t pm_fold_row(enum pm_fold fold, const struct pm_fft *f, size_t mode);

#endif
