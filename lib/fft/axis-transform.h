/* Transforms along one axis of a mesh, a block of PM_FFT_LINES real lines at a time: block is double [length][PM_FFT_LINES], 64-byte aligned, row i
 * holds node i of every line; lines q and q + PM_FFT_LINES/2 are transformed as one complex line. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_AXIS_TRANSFORM_H
#define PM_FFT_AXIS_TRANSFORM_H

#include "stream/frame.h"
#include "fft/fft-block.h"
#include "fft/sine-cosine.h"

struct pm_transform {
	enum pm_face face[2]; /* periodic; wall: odd images; neumann: even images; open: zeros up to the doubled length; open at one end: both,
	                       * images at the other and as much space again, four times the length */
	bool shifted;         /* a wall at one end, neumann at the other: frequency k stands for k + 1/2, its partner is length-1-k */
	size_t n;             /* cells */
	size_t first, count;  /* number of nodes transformed: all, except the end nodes at walls */
	size_t row;           /* of the block where the first of them is: first, or n more where the face below is open and that above is not */
	size_t least, modes;  /* of the real transforms: frequency of the first, and how many */
	size_t length;        /* of the complex transform: n, or 2n where images or zeros fill it, or 4n where both do */
	const struct pm_fft *fft; /* of that length, folded: n; of the planner */
	enum pm_waves fold;    /* of pm_transform_init_real */
	const size_t *map;    /* rows of the block in which the modes of the real transforms are */
};

int pm_transform_init(struct pm_fft_plans *p, const enum pm_face face[2], size_t n, struct pm_transform *line);
/* For pm_transform_real and back only, which then take half the time between walls and neumann faces. */
int pm_transform_init_real(struct pm_fft_plans *p, const enum pm_face face[2], size_t n, struct pm_transform *line);

/* The frequency whose waves are the conjugates of those of frequency k. */
static inline size_t pm_transform_partner(const struct pm_transform *l, size_t k)
{
	return l->shifted ? l->length - 1 - k : k ? l->length - k : 0;
}

/* Fills the rows that are not nodes: images at a wall or neumann face, zeros at an open one. flip: odd and even images are exchanged. */
void pm_transform_extend(const struct pm_transform *l, bool flip, double *block);

/* Nodes in rows row ... row+count-1 to the spectra of the pairs, frequency k in row fft->at[k]; and back, not normalised. flip as above;
 * on the way back it makes no difference. Open: the way there only fills in zeros, the half weight of end nodes is the caller's. */
void pm_transform_forward(const struct pm_transform *l, bool flip, double *block);
void pm_transform_backward(const struct pm_transform *l, double *block);

/* The real transform that diagonalises even operators with these faces: Hartley (periodic; open: of the doubled line), DST-I (wall), DCT-I (neumann),
 * quarter-wave sines (wall, neumann; up to a sign) and cosines (neumann, wall). Nodes in rows row ... row+count-1 to mode m in row map[m] (fft->at[least+m]
 * unless folded), and back; together they multiply by length. */
void pm_transform_real(const struct pm_transform *l, double *block);
void pm_transform_real_back(const struct pm_transform *l, double *block);

/* d/dx by i*k in place; Nyquist is zeroed (its derivative vanishes at the nodes). Not for open. */
void pm_transform_derivative(const struct pm_transform *l, double h, bool flip, double *block);
/* d2/dx2 by -k^2, likewise. */
void pm_transform_second(const struct pm_transform *l, double h, bool flip, double *block);

#endif
