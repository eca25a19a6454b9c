/* One axis of a transfer: the position of a particle on it, and the mesh points around it. For lib/transfer and lib/current.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_AXIS_H
#define PM_TRANSFER_AXIS_H

#define PM_SIMD_FOURS
#include "base/simd.h"
#include "transfer/transfer.h"

_Static_assert((int)PM_SIMD_WIDTH == ((int)PM_SIMD_PART < 8 ? 4 : 8), "what includes simd.h before this header has to say PM_SIMD_FOURS");

/* A particle at x has u = ((x - lo)/h + add) + half, cell floor(u) in 0..count-1 and t = u - cell - shift; its kernel touches the slots
 * cell..cell+width-1, and slot i is mesh point at[i]. For points half a cell up, u is that among the nodes and half a cell, to the last bit; or with the
 * lower kernel that among the nodes, whose slots but the last one its points are. */
struct pm_axis {
	bool periodic;
	double lo, h;      /* [length] */
	double n;          /* cells of the mesh */
	double low, high;  /* non-periodic: where (x-lo)/h may be, inclusive */
	double add, half, shift; /* [cells] */
	size_t count, slots;
	size_t *at;        /* [slots] */
	double *put[2];    /* [flip][slots] factor of what is spread to the slot: sign of the image, 1/weight of the point */
	double *get[2];    /* [flip][slots] factor of what is gathered from it */
	size_t from, to;   /* slots from..to-1 are consecutive points with factors 1 */
};

/* For components that sit at staggered[]; axes above dim have one cell. */
int pm_axes_init(struct pm_axis axes[3], const struct pm_transfer *t, const unsigned char staggered[3]);
void pm_axes_free(struct pm_axis axes[3]);

/* The axes of the ways of particles (lib/current), which begin in a cell and end there or in one beside it: there is one slot more above, and one below, so
 * that cell c has the slots c + 1..c + width. `nodes` for components on the nodes and to locate, `halves` with the same slots for components half a cell up.
 * Beyond an open face there are slots that are not on the mesh, for particles up to `beyond` cells outside: as far as their kernel reaches, and a cell to
 * spare. 0 or failure; free both in any case. */
int pm_axes_path(struct pm_axis nodes[3], struct pm_axis halves[3], const struct pm_grid *g, int width);
void pm_axis_path_room(const struct pm_grid *g, int d, int width, size_t beyond[2]);

/* u of a particle anywhere: periodic axes fold (lo+L is lo; -1e-17 and 1e300 too); false if it is outside. */
bool pm_axis_locate(const struct pm_axis *a, double x, double *u);
/* The same for n particles; u is -1 for those outside. False if there is one. */
bool pm_axis_locate_many(const struct pm_axis *a, size_t n, const double *x, double *u);

/* The same for eight (or four) particles; those outside the range, as bits, need pm_axis_locate_far. */
struct pm_axis_lanes {
	pm_simd lo, h, inverse, add, half, low, high; /* low..high: where no particle needs folding or a limit */
	bool periodic;
};
struct pm_axis_lanes pm_axis_lanes(const struct pm_axis *a);

PM_SIMD_INLINE pm_simd pm_axis_locate_eight(const struct pm_axis_lanes *a, pm_simd x, unsigned *outside)
{
	const pm_simd s = pm_simd_divide(x - a->lo, a->h, a->inverse), u = s + a->add;
	*outside = pm_simd_outside(a->periodic ? u : s, a->low, a->high);
	return u + a->half;
}
bool pm_axis_locate_far(const struct pm_axis *a, unsigned outside, size_t n, const double *x, double *u); /* n <= 8 */

/* Records a stray; the one with the smallest index is kept. */
void pm_strays_note(struct pm_strays *s, size_t index, int dim, const double *const x[], int axis);
void pm_strays_note_at(struct pm_strays *s, size_t index, const double x[3], int axis);

#endif
