/* Spectral derivatives on a mesh: each line along an axis to wave numbers, times i*k (Nyquist zeroed) or -k^2, and back; odd images at a wall, even
 * ones at a neumann face. Exact for all waves that the mesh resolves. The first derivative is antisymmetric, so there is no self-force.
 * Source: Trefethen 2000, chapter 3. Oscillates where the field is not smooth on the mesh (case PM-02: cic).
 * Cost: n log n per line, one pass over memory per term. On many ranks lines along the divided axis are brought together, by two exchanges a term.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "fft/axis-transform.h"
#include "fft/line-groups.h"
#include "mesh/gradient-parts.h"
#include "world/world.h"

enum { L = PM_FFT_LINES };

/* A derivative along lines. */
struct lines {
	const struct pm_transform *line;
	double h, factor;
	bool flip, add; /* odd and even images exchanged; added to the output */
	bool bare;      /* nothing but the derivative is put out */
	int derivative;
	size_t nodes;
};

static double put(const struct lines *l, double by, double value, double before) { return l->factor * by * value + (l->add ? before : 0); }

static void transform(const struct lines *l, const struct pm_line_group g, const double *in, const double *weight, double *out, double *block)
{
	for (size_t i = 0; i < l->nodes; i++)
		for (size_t q = 0; q < L; q++)
			block[i * L + q] = q < g.lines ? in[i * g.step + q * g.across] : 0;
	if (l->derivative == 1)
		pm_transform_derivative(l->line, l->h, l->flip, block);
	else
		pm_transform_second(l->line, l->h, l->flip, block);
	for (size_t i = 0; i < l->nodes; i++)
		for (size_t q = 0; q < g.lines; q++) {
			double *to = out + i * g.step + q * g.across;
			const double by = weight ? weight[i * g.step + q * g.across] : 1;
			*to = l->bare ? block[i * L + q] : put(l, by, block[i * L + q], *to);
		}
}

/* Lines along axis d of a mesh of these points. */
static void along(const size_t points[3], int d, const struct lines *l, const double *in, const double *weight, double *out, double *scratch, size_t lot)
{
	const size_t groups = pm_line_groups(points, d);
#pragma omp parallel for schedule(static) num_threads(pm_threads())
	for (size_t b = 0; b < groups; b++) {
		const struct pm_line_group g = pm_line_group(points, d, b);
		transform(l, g, in + g.at, weight ? weight + g.at : NULL, out + g.at, scratch + (size_t)omp_get_thread_num() * lot);
	}
}

/* Lines that cross the planes of ranks. Called by all. */
static int across(int status, const struct pm_planes *p, const struct lines *l, const double *in, const double *weight, double *out, double *scratch,
	size_t lot)
{
	double *lines = NULL, *here = status ? NULL : pm_alloc(p->here * p->size + 1, sizeof *here);
	size_t columns = 0;
	struct lines bare = *l;
	bare.bare = true;
	status = status ? status : here ? 0 : pm_failed();
	status = pm_planes_turn(status, p, in, &lines, &columns);
	if (!status) {
		const size_t points[3] = {p->axis == 2 ? p->points[0] : columns, p->axis == 2 ? columns / p->points[0] : p->all, p->axis == 2 ? p->all : 1};
		along(points, p->axis, &bare, lines, NULL, lines, scratch, lot);
	}
	status = pm_planes_turn_back(status, p, &lines, here);
	for (size_t i = 0; i < p->here * p->size && !status; i++)
		out[i] = put(l, weight ? weight[i] : 1, here[i], out[i]);
	pm_free(here);
	return status;
}

int pm_operator_spectral(const struct pm_operator *o, double factor, const double *const in[], double *const out[])
{
	const struct pm_planes *p = o->planes;
	size_t n[3], most = 2;
	struct pm_transform line[3];
	int status = 0;
	memcpy(n, o->grid.points, sizeof n);
	for (int d = 0; d < o->grid.dim && !status; d++) { /* the transforms are there since pm_operator_plan */
		status = pm_transform_init(o->plans, o->grid.face[d], o->grid.cells[d], &line[d]) ? pm_failed() : 0;
		most = !status && line[d].length > most ? line[d].length : most;
	}
	size_t lot = (most + 1) * L;
	double *scratch = status ? NULL : pm_alloc((size_t)pm_threads() * lot, sizeof *scratch);
	status = status ? status : scratch ? 0 : pm_failed();
	status = p ? pm_world_agree(status) : status;
	if (p && p->axis)
		n[p->axis] = p->here;
	for (int t = 0; t < o->nterms && !status; t++) {
		const struct pm_operator_term *q = &o->term[t];
		bool flip = pm_operator_odd(o, q->as, q->axis, 0) != (o->grid.face[q->axis][0] == PM_WALL);
		const struct lines l = {.line = &line[q->axis], .h = o->grid.h[q->axis], .factor = factor * q->sign, .flip = flip,
			.add = o->add || (t && q->out == q[-1].out), .derivative = o->derivative, .nodes = o->grid.points[q->axis]};
		const double *weight = q->by ? o->weight[q->by - 1] : NULL;
		if (p && p->axis && q->axis == p->axis)
			status = across(status, p, &l, in[q->in], weight, out[q->out], scratch, lot);
		else if (!p || p->here)
			along(n, q->axis, &l, in[q->in], weight, out[q->out], scratch, lot);
	}
	pm_free(scratch);
	return status;
}
