/* Spectral derivatives on a mesh: each line along an axis to wave numbers, times i*k (Nyquist zeroed) or -k^2, and back; odd images at a wall, even
 * ones at a neumann face. Exact for all waves that the mesh resolves. The first derivative is antisymmetric, so there is no self-force.
 * Source: Trefethen 2000, chapter 3. Oscillates where the field is not smooth on the mesh (case PM-02: cic).
 * Cost: n log n per line, one pass over memory per term.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "fft/axis-transform.h"
#include "fft/line-groups.h"
#include "mesh/gradient-parts.h"

enum { L = PM_FFT_LINES };

/* A derivative along lines. */
struct lines {
	const struct pm_transform *line;
	double h, factor;
	bool flip, add; /* odd and even images exchanged; added to the output */
	int derivative;
	size_t nodes;
};

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
			*to = l->factor * by * block[i * L + q] + (l->add ? *to : 0);
		}
}

static void term(const struct pm_operator *o, int d, const struct lines *l, const double *in, const double *weight, double *out, double *scratch,
	size_t lot)
{
	const size_t groups = pm_line_groups(o->grid.points, d);
#pragma omp parallel for schedule(static) num_threads(pm_threads())
	for (size_t b = 0; b < groups; b++) {
		const struct pm_line_group g = pm_line_group(o->grid.points, d, b);
		transform(l, g, in + g.at, weight ? weight + g.at : NULL, out + g.at, scratch + (size_t)omp_get_thread_num() * lot);
	}
}

int pm_operator_spectral(const struct pm_operator *o, double factor, const double *const in[], double *const out[])
{
	const size_t *n = o->grid.points;
	struct pm_transform line[3];
	size_t most = 2;
	for (int d = 0; d < o->grid.dim; d++) { /* the transforms are there since pm_operator_plan */
		if (pm_transform_init(o->plans, o->grid.face[d], o->grid.cells[d], &line[d]))
			return -PM_DATA;
		most = line[d].length > most ? line[d].length : most;
	}
	size_t lot = (most + 1) * L;
	double *scratch = pm_alloc((size_t)pm_threads() * lot, sizeof *scratch);
	if (!scratch)
		return -PM_DATA;
	for (int t = 0; t < o->nterms; t++) {
		const struct pm_operator_term *q = &o->term[t];
		bool flip = pm_operator_odd(o, q->as, q->axis, 0) != (o->grid.face[q->axis][0] == PM_WALL);
		const struct lines l = {.line = &line[q->axis], .h = o->grid.h[q->axis], .factor = factor * q->sign, .flip = flip,
			.add = o->add || (t && q->out == q[-1].out), .derivative = o->derivative, .nodes = n[q->axis]};
		term(o, q->axis, &l, in[q->in], q->by ? o->weight[q->by - 1] : NULL, out[q->out], scratch, lot);
	}
	pm_free(scratch);
	return 0;
}
