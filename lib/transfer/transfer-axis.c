/* Positions and faces along one axis. Beyond a wall the mesh goes on as its odd image, beyond a neumann face as its even image, both about the
 * end node; on a periodic axis it repeats. With half weight of the end nodes in mesh sums this makes spread and gather adjoint, and
 * the total strength of a neumann mesh exact: an end node receives its share once, as density twice.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>
#include <string.h>

#include "mesh/index-fold.h"
#include "transfer/transfer-axis.h"

/* +1, -1 or 0 (the weight of the kernel is 0 there). */
static int image_sign(enum pm_face face, bool flip)
{
	if (face == PM_WALL || face == PM_NEUMANN)
		return (face == PM_WALL) != flip ? -1 : 1;
	return 0;
}

static void fill_slots(struct pm_axis *a, const struct pm_grid *g, int d, const bool given[2], bool half, ptrdiff_t first)
{
	ptrdiff_t n = (ptrdiff_t)g->cells[d];
	for (int flip = 0; flip < 2; flip++) {
		const struct pm_index_axis axis = {.points = g->cells[d] + (!a->periodic && !half), .periodic = a->periodic, .staggered = half,
			.image = {given[0] ? 0 : image_sign(g->face[d][0], flip), given[1] ? 0 : image_sign(g->face[d][1], flip)}};
		for (size_t slot = 0; slot < a->slots; slot++) {
			int sign;
			size_t at = pm_index_image(first + (ptrdiff_t)slot, &axis, &sign);
			double weight = 1;
			if (!a->periodic && !half && (at == 0 || at == (size_t)n)) {
				int end = axis.image[at != 0];
				weight = end > 0 ? 0.5 : 1;
				sign = end < 0 ? 0 : sign; /* an odd function is 0 here */
			}
			a->at[slot] = at;
			a->put[flip][slot] = sign / weight;
			a->get[flip][slot] = sign;
		}
	}
	a->from = a->slots;
	a->to = 0;
	for (size_t slot = 0; slot < a->slots; slot++) {
		ptrdiff_t point = first + (ptrdiff_t)slot;
		if (point >= !a->periodic && point < n && slot < a->from)
			a->from = slot;
		if (point >= !a->periodic && point < n)
			a->to = slot + 1;
	}
	if (a->to < a->from)
		a->from = a->to = a->slots;
}

/* Open and absorbing faces keep the kernel inside the points 1..n-1, and off a rim of as many more as asked for; at walls and neumann faces a particle
 * may sit on the face itself. */
static void set_range(struct pm_axis *a, const struct pm_grid *g, int d, int width, int rim)
{
	double r = 0.5 * width + rim, rounding = 4 * DBL_EPSILON * (a->n + fabs(a->lo) / a->h);
	bool closed[2];
	for (int side = 0; side < 2; side++)
		closed[side] = g->face[d][side] == PM_WALL || g->face[d][side] == PM_NEUMANN;
	a->low = closed[0] ? 0 : r;
	a->high = closed[1] ? a->n + rounding : a->n - r;
	if (width == 1 && !closed[1])
		a->high = nextafter(a->high, 0); /* ngp jumps: ties go up */
}

/* Room for the factors of the slots, and their values. */
static int make_slots(struct pm_axis *a, const struct pm_grid *g, int d, const bool given[2], bool half, ptrdiff_t first)
{
	a->at = pm_alloc(a->slots, sizeof *a->at);
	double *factor = pm_alloc(a->slots, 4 * sizeof *factor);
	a->put[0] = factor;
	if (!a->at || !factor)
		return -PM_DATA;
	a->put[1] = factor + a->slots;
	a->get[0] = factor + 2 * a->slots;
	a->get[1] = factor + 3 * a->slots;
	fill_slots(a, g, d, given, half, first);
	return 0;
}

static int axis_init(struct pm_axis *a, const struct pm_transfer *t, int d, bool half)
{
	const struct pm_grid *g = &t->grid;
	const int width = d < g->dim ? t->kernel->width : 1, rim = d < g->dim ? t->rim : 0;
	const bool further = half && !t->lower; /* the lower kernel begins on the half above the first node */
	size_t beyond[2] = {0, 0};
	a->periodic = g->face[d][0] == PM_PERIODIC;
	a->lo = g->lo[d];
	a->h = g->h[d];
	a->n = (double)g->cells[d];
	a->shift = width % 2 ? 0.5 : 0;
	a->half = further ? 0.5 : 0;
	set_range(a, g, d, width, rim);
	if (t->cut) {
		pm_axis_path_room(g, d, width, beyond);
		a->low = beyond[0] ? -(double)beyond[0] : a->low;
		a->high = beyond[1] ? a->n + (double)beyond[1] : a->high;
		a->n += (double)beyond[1];
	}
	a->add = a->shift + (double)beyond[0];
	a->count = g->cells[d] + !a->periodic + beyond[0] + beyond[1] + further;
	a->slots = a->count + (size_t)width - 1;
	return make_slots(a, g, d, t->given[d], half, -((width - 1) / 2) - further - (ptrdiff_t)beyond[0]);
}

static int path_axis(struct pm_axis *a, const struct pm_grid *g, int d, int width, bool half)
{
	size_t beyond[2];
	pm_axis_path_room(g, d, width, beyond);
	*a = (struct pm_axis){.periodic = g->face[d][0] == PM_PERIODIC, .lo = g->lo[d], .h = g->h[d], .shift = width % 2 ? 0.5 : 0};
	a->n = (double)(g->cells[d] + beyond[1]);
	a->add = a->shift + (double)beyond[0];
	a->count = g->cells[d] + !a->periodic + beyond[0] + beyond[1];
	const size_t more = d < g->dim; /* a way down from the first cell, or up from the last one */
	a->slots = a->count + ((size_t)width + 1) * more;
	const double rounding = 4 * DBL_EPSILON * (a->n + fabs(a->lo) / a->h);
	a->low = -(double)beyond[0] - rounding;
	a->high = a->n + rounding;
	return make_slots(a, g, d, (const bool[]){false, false}, half, -((width - 1) / 2) - (ptrdiff_t)(beyond[0] + more));
}

int pm_axes_path(struct pm_axis nodes[3], struct pm_axis halves[3], const struct pm_grid *g, int width)
{
	for (int d = 0; d < 3; d++)
		nodes[d] = halves[d] = (struct pm_axis){.count = 0};
	for (int d = 0; d < 3; d++)
		if (path_axis(&nodes[d], g, d, d < g->dim ? width : 1, false) || path_axis(&halves[d], g, d, d < g->dim ? width : 1, d < g->dim))
			return -PM_DATA; /* the caller frees both */
	return 0;
}

void pm_axis_path_room(const struct pm_grid *g, int d, int width, size_t beyond[2])
{
	for (int side = 0; side < 2; side++)
		beyond[side] = d < g->dim && (g->face[d][side] == PM_OPEN || g->face[d][side] == PM_ABSORBING) ? (size_t)width / 2 + 1 : 0;
}

int pm_axes_init(struct pm_axis axes[3], const struct pm_transfer *t, const unsigned char staggered[3])
{
	for (int d = 0; d < 3; d++)
		axes[d] = (struct pm_axis){.count = 0};
	for (int d = 0; d < 3; d++) {
		bool used = d < t->grid.dim;
		int status = axis_init(&axes[d], t, d, used && staggered[d]);
		if (status) {
			pm_axes_free(axes);
			return status;
		}
	}
	return 0;
}

void pm_axes_free(struct pm_axis axes[3])
{
	for (int d = 0; d < 3; d++) {
		pm_free(axes[d].at);
		pm_free(axes[d].put[0]);
		axes[d] = (struct pm_axis){.count = 0};
	}
}

/* One period up or down, without a branch; values still outside, or at n by rounding, use the general function. */
static inline double wrap_near(const struct pm_axis *a, double x)
{
	double u = (x - a->lo) / a->h + a->add;
	u = u >= a->n ? u - a->n : u;
	return u < 0 ? u + a->n : u;
}

static bool wrap_far(const struct pm_axis *a, double x, double *u)
{
	double r = fmod(x - a->lo, a->n * a->h);
	*u = r / a->h + a->add;
	if (*u < 0)
		*u += a->n;
	if (*u >= a->n)
		*u -= a->n;
	return isfinite(r);
}

bool pm_axis_locate(const struct pm_axis *a, double x, double *u)
{
	if (a->periodic) {
		double at = wrap_near(a, x);
		const bool found = (at >= 0 && at < a->n) || wrap_far(a, x, &at);
		*u = at + a->half;
		return found;
	}
	const double s = (x - a->lo) / a->h;
	*u = (s > a->n ? a->n : s) + a->add + a->half;
	return s >= a->low && s <= a->high;
}

bool pm_axis_locate_far(const struct pm_axis *a, unsigned outside, size_t n, const double *x, double *u)
{
	bool all = true;
	for (size_t i = 0; i < n; i++)
		if (outside >> i & 1 && !pm_axis_locate(a, x[i], &u[i])) {
			u[i] = -1;
			all = false;
		}
	return all;
}

struct pm_axis_lanes pm_axis_lanes(const struct pm_axis *a)
{
	return (struct pm_axis_lanes){.lo = pm_simd_all(a->lo), .h = pm_simd_all(a->h), .inverse = pm_simd_all(1 / a->h), .add = pm_simd_all(a->add),
		.half = pm_simd_all(a->half),
		.low = pm_simd_all(a->periodic ? 0 : a->low), .high = pm_simd_all(a->periodic ? nextafter(a->n, 0) : fmin(a->high, a->n)),
		.periodic = a->periodic};
}

/* The same where eight do not fit a register, for the compiler to choose how many. */
static bool locate_by_one(const struct pm_axis *a, size_t n, const double *restrict x, double *restrict u)
{
	const double low = a->periodic ? 0 : a->low, high = a->periodic ? nextafter(a->n, 0) : fmin(a->high, a->n);
	int far = 0;
	if (a->periodic)
		for (size_t i = 0; i < n; i++) {
			const double at = (x[i] - a->lo) / a->h + a->add;
			u[i] = at + a->half;
			far |= !(at >= low && at <= high);
		}
	else
		for (size_t i = 0; i < n; i++) {
			const double s = (x[i] - a->lo) / a->h;
			u[i] = s + a->add + a->half;
			far |= !(s >= low && s <= high);
		}
	bool all = true;
	for (size_t i = 0; i < n && far; i++)
		all &= pm_axis_locate_far(a, 1, 1, x + i, u + i);
	return all;
}

/* The usual particle is inside the range. Each is treated by itself, whatever its neighbours need. */
bool pm_axis_locate_many(const struct pm_axis *a, size_t n, const double *restrict x, double *restrict u)
{
	const struct pm_axis_lanes lanes = pm_axis_lanes(a);
	unsigned outside;
	bool all = true;
	size_t i = 0;
	if ((int)PM_SIMD_PART < (int)PM_SIMD_WIDTH)
		return locate_by_one(a, n, x, u);
	for (; i + PM_SIMD_WIDTH <= n; i += PM_SIMD_WIDTH) {
		pm_simd_store_any(u + i, pm_axis_locate_eight(&lanes, pm_simd_load_any(x + i), &outside));
		if (outside)
			all &= pm_axis_locate_far(a, outside, PM_SIMD_WIDTH, x + i, u + i);
	}
	if (i < n) {
		pm_simd few = lanes.lo;
		memcpy(&few, x + i, (n - i) * sizeof *x);
		few = pm_axis_locate_eight(&lanes, few, &outside);
		memcpy(u + i, &few, (n - i) * sizeof *u);
		if (outside)
			all &= pm_axis_locate_far(a, outside, n - i, x + i, u + i);
	}
	return all;
}

void pm_strays_note_at(struct pm_strays *s, size_t index, const double x[3], int axis)
{
	if (!s->count || index < s->first) {
		s->first = index;
		s->axis = axis;
		memcpy(s->x, x, sizeof s->x);
	}
	s->count++;
}

void pm_strays_note(struct pm_strays *s, size_t index, int dim, const double *const x[], int axis)
{
	double at[3] = {0};
	for (int d = 0; d < dim; d++)
		at[d] = x[d][index];
	pm_strays_note_at(s, index, at, axis);
}
