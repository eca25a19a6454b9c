/* Interlacing: half of every strength goes to the mesh, half to one whose nodes sit at the centres of its cells; the second density, as a sum of waves, is read
 * at the nodes: s^(k) = (s1^(k) + exp(-i k.h/2) s2^(k))/2. An alias k + 2 pi n/h of the wave k has opposite signs on the two meshes if n1 + n2 + n3 is odd,
 * so the largest aliases cancel. The gather is the transpose (both meshes, half each), so that no particle acts on itself and momentum is conserved.
 * Source: Chen, Langdon and Birdsall 1974; Hockney and Eastwood 1988, sections 5-5 and 7-7; combination in k space: Sefusatti et al. 2016.
 * The Nyquist wave has no phase at the centres and is left out of the second mesh. Each line is computed by one thread, so the result does not depend on
 * their number.
 * Cost: twice the transfer, and a pass of transforms back and forth per axis and component; on many ranks lines along the divided axis are brought together, by
 * two exchanges a component. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fft/line-groups.h"
#include "mesh/planes.h"
#include "transfer/interlace.h"
#include "world/world.h"

#include <omp.h>
#include <stdio.h>
#include <string.h>

enum { L = PM_FFT_LINES, H = PM_FFT_LINES / 2 };

int pm_interlace_check(const struct pm_transfer *t)
{
	for (int d = 0; d < t->grid.dim; d++)
		if (t->grid.face[d][0] != PM_PERIODIC)
			return pm_fail(PM_DATA, "interlaced meshes go round a box that is periodic along every axis, and axis %c is %s (leave out "
				"--interlace, or take a wider kernel: --kernel tsc or pcs)", "xyz"[d], pm_face_names[t->grid.face[d][0]]);
	for (int c = 0; c < t->components; c++)
		if (t->staggered[c][0] || t->staggered[c][1] || t->staggered[c][2])
			return pm_fail(PM_DATA, "interlaced fields sit on the nodes (m2p --kernel takes it as it is)");
	if (t->components > PM_COMPONENTS / 2)
		return pm_fail(PM_DATA, "at most %d components are interlaced (leave out --interlace)", PM_COMPONENTS / 2);
	return 0;
}

/* A block of lines read at half a spacing above (sign 1) or below (-1) the nodes. */
static void shift_block(const struct pm_transform *l, double sign, double *block)
{
	size_t n = l->length;
	pm_transform_forward(l, false, block);
	for (size_t k = 0; k < n; k++) {
		double m = 2 * k <= n ? (double)k : (double)k - (double)n, *a = block + l->fft->at[k] * L;
		double c = cos(pm_pi * m / (double)n) / (double)n, s = sign * sin(pm_pi * m / (double)n) / (double)n;
		if (2 * k == n)
			c = s = 0;
		for (int q = 0; q < H; q++) {
			double re = a[q], im = a[q + H];
			a[q] = re * c - im * s, a[q + H] = im * c + re * s;
		}
	}
	pm_transform_backward(l, block);
}

static void shift_lines(const struct pm_transform *l, double sign, const struct pm_line_group g, double *at, double *block)
{
	for (size_t i = 0; i < l->n; i++)
		for (size_t q = 0; q < L; q++)
			block[i * L + q] = q < g.lines ? at[i * g.step + q * g.across] : 0;
	shift_block(l, sign, block);
	for (size_t i = 0; i < l->n; i++)
		for (size_t q = 0; q < g.lines; q++)
			at[i * g.step + q * g.across] = block[i * L + q];
}

static void shift_axis(const size_t points[3], int d, const struct pm_transform *l, double sign, double *a, double *scratch)
{
	const size_t groups = pm_line_groups(points, d);
#pragma omp parallel for schedule(static) num_threads(pm_threads()) if (points[0] * points[1] * points[2] > 16384)
	for (size_t b = 0; b < groups; b++) {
		const struct pm_line_group group = pm_line_group(points, d, b);
		shift_lines(l, sign, group, a + group.at, scratch + (size_t)omp_get_thread_num() * L * (l->length + 1));
	}
}

/* Lines that cross the planes of ranks. Called by all. */
static int shift_across(int status, const struct pm_planes *p, const struct pm_transform *l, double sign, double *a, double *scratch)
{
	double *lines = NULL;
	size_t columns = 0;
	status = pm_planes_turn(status, p, a, &lines, &columns);
	if (!status) {
		const size_t points[3] = {p->axis == 2 ? p->points[0] : columns, p->axis == 2 ? columns / p->points[0] : p->all, p->axis == 2 ? p->all : 1};
		shift_axis(points, p->axis, l, sign, lines, scratch);
	}
	return pm_planes_turn_back(status, p, &lines, a);
}

/* Takes the caller's status; with planes of ranks all call it. */
static int shift(int status, const struct pm_transfer *t, struct pm_fft_plans *p, double sign, int components, double *const a[])
{
	const struct pm_grid *g = &t->grid;
	const struct pm_planes *planes = t->planes && t->planes->divided ? t->planes : NULL;
	size_t here[3] = {g->points[0], g->points[1], g->points[2]};
	if (planes)
		here[planes->axis] = planes->axis ? planes->here : planes->here * g->points[0];
	for (int d = 0; d < g->dim && !status; d++) {
		struct pm_transform l;
		double *scratch = NULL;
		status = pm_transform_init(p, g->face[d], g->cells[d], &l) ? -PM_DATA : 0;
		if (!status && !(scratch = pm_alloc((size_t)pm_threads() * L * (l.length + 1), sizeof *scratch)))
			status = -PM_DATA;
		status = planes ? pm_world_agree(status) : status;
		for (int c = 0; c < components && !status; c++)
			if (planes && planes->axis && d == planes->axis)
				status = shift_across(status, planes, &l, sign, a[c], scratch);
			else if (here[g->dim - 1])
				shift_axis(here, d, &l, sign, a[c], scratch);
		pm_free(scratch);
	}
	return status;
}

/* The points of the mesh on this rank. */
static size_t points_here(const struct pm_transfer *t) { return t->planes ? t->planes->here * t->planes->size : pm_grid_size(&t->grid); }

/* Components on the nodes, then the same at the centres. */
static struct pm_transfer doubled(const struct pm_transfer *t)
{
	struct pm_transfer two = *t;
	two.components = 2 * t->components;
	for (int c = 0; c < t->components; c++) {
		memcpy(two.flip[t->components + c], t->flip[c], sizeof two.flip[c]);
		two.set[t->components + c] = false;
		for (int d = 0; d < t->grid.dim; d++)
			two.staggered[t->components + c][d] = 1;
	}
	return two;
}

int pm_interlace_spread(const struct pm_transfer *t, struct pm_fft_plans *p, size_t n, const double *const x[], const double *const strength[],
	double *const mesh[], struct pm_strays *strays)
{
	const size_t size = points_here(t), count = (size_t)t->components;
	struct pm_transfer two = doubled(t);
	const double *half[PM_COMPONENTS];
	double *both[PM_COMPONENTS], *store = pm_zalloc(count * (size + n) + 1, sizeof *store);
	int status = pm_planes_agree(store ? 0 : -PM_DATA, t->planes);
	if (status)
		return pm_free(store), status;
	for (size_t c = 0; c < count; c++) {
		double *q = store + count * size + c * n;
		for (size_t i = 0; i < n; i++)
			q[i] = 0.5 * strength[c][i];
		half[c] = half[count + c] = q;
		both[c] = mesh[c];
		both[count + c] = store + c * size;
	}
	status = pm_spread(&two, n, x, half, both, strays);
	status = shift(status, t, p, -1, t->components, both + count);
	for (size_t c = 0; c < count && !status; c++)
		for (size_t i = 0; i < size; i++)
			mesh[c][i] += both[count + c][i];
	pm_free(store);
	return status;
}

int pm_interlace_init(struct pm_interlaced *i, const struct pm_transfer *t, struct pm_fft_plans *p, const double *const mesh[])
{
	const size_t size = points_here(t), count = (size_t)t->components;
	double *centres[PM_COMPONENTS];
	*i = (struct pm_interlaced){.store = pm_alloc(2 * count * size + 1, sizeof(double))};
	int status = pm_planes_agree(i->store ? 0 : -PM_DATA, t->planes);
	if (status)
		return status;
	for (size_t c = 0; c < count; c++) {
		double *node = i->store + c * size, *centre = i->store + (count + c) * size;
		for (size_t q = 0; q < size; q++)
			node[q] = centre[q] = 0.5 * mesh[c][q];
		i->mesh[c] = node;
		i->mesh[count + c] = centres[c] = centre;
	}
	return shift(0, t, p, 1, t->components, centres);
}

void pm_interlace_free(struct pm_interlaced *i)
{
	i->store = pm_free(i->store);
}

int pm_interlace_gather(const struct pm_interlaced *i, const struct pm_transfer *t, size_t n, const double *const x[], const double *const factor[],
	double *const out[], struct pm_strays *strays)
{
	struct pm_transfer two = doubled(t);
	const double *factors[PM_COMPONENTS];
	double *outs[PM_COMPONENTS];
	for (int c = 0; c < two.components; c++) {
		factors[c] = factor ? factor[c % t->components] : NULL;
		outs[c] = out[c % t->components];
	}
	return pm_gather(&two, n, x, i->mesh, factors, outs, strays);
}
