/* Spectral derivatives on a mesh: each line along an axis to wave numbers, times i*k (Nyquist zeroed) or -k^2, and back; odd images at a wall, even
 * ones at a neumann face. Exact for what the mesh resolves. A first derivative is antisymmetric, so it makes no self force.
 * Source: Trefethen 2000, chapter 3. Rings where the field is not smooth on the mesh (case PM-02: cic).
 * Cost: n log n per line, one pass over memory per term.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "fft/axis-transform.h"
#include "mesh/gradient-parts.h"

enum { L = PM_FFT_LINES };

/* Lines along y or z: L neighbours in x. stride: between nodes of a line; width: lines of this block. */
static void columns(const struct pm_transform *l, double h, bool flip, int derivative, double factor, bool add, size_t nodes, size_t stride, size_t width,
	const double *in, double *out, double *block)
{
	for (size_t i = 0; i < nodes; i++)
		for (size_t q = 0; q < L; q++)
			block[i * L + q] = q < width ? in[i * stride + q] : 0;
	if (derivative == 1)
		pm_transform_derivative(l, h, flip, block);
	else
		pm_transform_second(l, h, flip, block);
	for (size_t i = 0; i < nodes; i++)
		for (size_t q = 0; q < width; q++)
			out[i * stride + q] = factor * block[i * L + q] + (add ? out[i * stride + q] : 0);
}

/* Lines along x: L rows. */
static void rows(const struct pm_transform *l, double h, bool flip, int derivative, double factor, bool add, size_t nodes, size_t width, const double *in,
	double *out, double *block)
{
	for (size_t q = 0; q < L; q++)
		for (size_t i = 0; i < nodes; i++)
			block[i * L + q] = q < width ? in[q * nodes + i] : 0;
	if (derivative == 1)
		pm_transform_derivative(l, h, flip, block);
	else
		pm_transform_second(l, h, flip, block);
	for (size_t q = 0; q < width; q++)
		for (size_t i = 0; i < nodes; i++)
			out[q * nodes + i] = factor * block[i * L + q] + (add ? out[q * nodes + i] : 0);
}

struct work { /* of all terms */
	struct pm_transform line[3];
	double *scratch; /* lot values for each thread */
	size_t lot;
};

static void term(const struct pm_operator *o, const struct work *w, int d, bool flip, double factor, bool add, const double *in, double *out)
{
	const size_t *n = o->grid.points, chunks = (n[0] + L - 1) / L;
	const size_t across = d == 1 ? n[2] : n[1], stride = d == 1 ? n[0] : n[0] * n[1], other = d == 1 ? n[0] * n[1] : n[0];
	const size_t blocks = d == 0 ? (n[1] * n[2] + L - 1) / L : across * chunks;
#pragma omp parallel for schedule(static) num_threads(pm_threads())
	for (size_t b = 0; b < blocks; b++) {
		double *block = w->scratch + (size_t)omp_get_thread_num() * w->lot;
		if (d == 0) {
			size_t width = n[1] * n[2] - b * L;
			rows(&w->line[0], o->grid.h[0], flip, o->derivative, factor, add, n[0], width < L ? width : L, in + b * L * n[0], out + b * L * n[0],
				block);
		} else {
			size_t x = b % chunks * L, width = n[0] - x, at = b / chunks * other + x;
			columns(&w->line[d], o->grid.h[d], flip, o->derivative, factor, add, n[d], stride, width < L ? width : L, in + at, out + at, block);
		}
	}
}

int pm_operator_spectral(const struct pm_operator *o, double factor, const double *const in[], double *const out[])
{
	struct work w;
	size_t most = 2;
	for (int d = 0; d < o->grid.dim; d++) { /* the transforms are there since pm_operator_plan */
		if (pm_transform_init(o->plans, o->grid.face[d], o->grid.cells[d], &w.line[d]))
			return -PM_DATA;
		most = w.line[d].length > most ? w.line[d].length : most;
	}
	w.lot = (most + 1) * L;
	w.scratch = pm_alloc((size_t)pm_threads() * w.lot, sizeof *w.scratch);
	if (!w.scratch)
		return -PM_DATA;
	for (int t = 0; t < o->nterms; t++) {
		const struct pm_operator_term *q = &o->term[t];
		bool flip = pm_operator_odd(o, q->in, q->axis, 0) != (o->grid.face[q->axis][0] == PM_WALL);
		term(o, &w, q->axis, flip, factor * q->sign, t && q->out == q[-1].out, in[q->in], out[q->out]);
	}
	pm_free(w.scratch);
	return 0;
}
