/* Transforms along one axis of a mesh, a block of PM_LANES real lines at a time: block is double [length][PM_LANES], 64-byte aligned, row i
 * holds node i of every line; lines q and q + PM_LANES/2 travel as one complex line. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LINES_H
#define PM_LINES_H

#include "mesh/grid.h"
#include "mesh/lanes.h"

struct pm_line {
	enum pm_face face;   /* periodic; wall: odd images; neumann: even images; open: zeros up to the doubled length */
	size_t n;            /* cells */
	size_t first, count; /* nodes that take part: all, without the two ends at a wall; the real transforms keep as many modes, in the same rows */
	size_t length;       /* of the complex transform: n, or 2n where images or zeros fill it */
	const struct pm_fft *fft; /* of that length; of the planner */
};

int pm_line_init(struct pm_planner *p, enum pm_face face, size_t n, struct pm_line *line);

/* Fills the rows that are not nodes: images at a wall or neumann face, zeros at an open one. odd: images change sign. */
void pm_line_extend(const struct pm_line *l, bool odd, double *block);

/* The real transform that diagonalises even operators with these faces, in place: Hartley (periodic), DST-I (wall), DCT-I (neumann). Nodes in rows
 * first ... first+count-1, mode k = first ... first+count-1 comes out in row fft->at[k]. It is its own inverse up to the factor pm_line.length.
 * Not for open. */
void pm_line_real(const struct pm_line *l, double *block);

/* phi = factor/(lambda + mine) s along the axis, for operators with an eigenvalue lambda[k] per mode k and mine[q] of each of the lines, as a whole: forward,
 * times, back, in place and not normalised. Images are filled in first. Not for open. */
void pm_line_solve(const struct pm_line *l, double factor, const double *lambda, const double *mine, bool singular, double *zero, double *block);

/* d/dx by i*k in place; Nyquist is zeroed (its derivative vanishes at the nodes). odd: the image rule of the lines at faces that are not periodic.
 * Not for open. */
void pm_line_derivative(const struct pm_line *l, double h, bool odd, double *block);
/* d2/dx2 by -k^2, likewise. */
void pm_line_second(const struct pm_line *l, double h, bool odd, double *block);

#endif
