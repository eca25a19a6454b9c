/* The passes of the transform solver over its work array: planes forward (rows, then columns while the plane is in cache), pencils forward, times the
 * symbol, and back, planes back. A block of L lines at a time is transformed in cache (mesh/lanes.h); the modes of complex axes stay in the
 * order in which the transform leaves them. The partition does not depend on threads.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "poisson/fft-passes.h"

/* n rows of L doubles, stride doubles apart, to and from a block. */
static void gather(const double *restrict from, size_t stride, size_t n, double *restrict block)
{
	for (size_t i = 0; i < n; i++)
		for (int q = 0; q < L; q++)
			block[i * L + q] = from[i * stride + q];
}

static void scatter(const double *restrict block, size_t n, size_t stride, double *restrict to)
{
	for (size_t i = 0; i < n; i++)
		for (int q = 0; q < L; q++)
			to[i * stride + q] = block[i * L + q];
}

static double *thread_scratch(const struct pm_poisson_fft *p)
{
	return p->scratch + (size_t)omp_get_thread_num() * p->lot;
}

/* A slab is what one thread transforms at a time: a plane, or L single rows where planes are that thin. */
static bool thick(const struct pm_poisson_fft *p)
{
	return p->line[Y].length > 1;
}

/* Up to L rows of a slab: row r is row j+r*dj of plane k+r*dk, at w + r*stride. */
struct group {
	size_t j, k, rows, dj, dk, stride;
	double *w;
};

static struct group group_of(const struct pm_poisson_fft *p, size_t slab, size_t start)
{
	bool plane = thick(p);
	struct group g = {.j = plane ? start : 0, .k = plane ? slab : slab * L, .dj = plane, .dk = !plane, .stride = plane ? p->row : p->plane};
	size_t left = plane ? p->nodes[Y] - g.j : p->nodes[Z] - g.k;
	g.rows = left < L ? left : L;
	g.w = p->w + g.k * p->plane + g.j * p->row;
	return g;
}

static void get_rows(const struct pm_poisson_fft *p, const struct rows *io, const struct group *g, double *buffer)
{
	for (size_t r = 0; r < L; r++)
		if (r < g->rows)
			io->get(io, g->j + r * g->dj, g->k + r * g->dk, buffer + r * p->buffer);
		else
			memset(buffer + r * p->buffer, 0, p->buffer * sizeof *buffer);
}

static void put_rows(const struct pm_poisson_fft *p, const struct rows *io, const struct group *g, const double *buffer)
{
	for (size_t r = 0; r < g->rows; r++)
		io->put(io, g->j + r * g->dj, g->k + r * g->dk, buffer + r * p->buffer);
}

static void rows_forward(const struct pm_poisson_fft *p, const struct rows *io, const struct group *g, double *block, double *buffer)
{
	const struct pm_line *l = &p->line[X];
	get_rows(p, io, g, buffer);
	pm_lanes_in(buffer, p->buffer, p->nodes[X], block + l->first * L);
	if (p->complex) {
		double *row[L];
		for (size_t r = 0; r < L; r++)
			row[r] = g->w + r * g->stride;
		pm_line_extend(l, false, block);
		pm_fft_forward(l->fft, block);
		pm_spectra_out(l->fft, block, (int)g->rows, row);
		return;
	}
	pm_line_real(l, block);
	pm_lanes_out(block, l->fft->at + l->first, p->nodes[X], p->buffer, buffer);
	for (size_t r = 0; r < g->rows; r++) {
		memcpy(g->w + r * g->stride, buffer + r * p->buffer, p->nodes[X] * sizeof *buffer);
		memset(g->w + r * g->stride + p->nodes[X], 0, (p->chunks * L - p->nodes[X]) * sizeof *buffer);
	}
}

static void rows_backward(const struct pm_poisson_fft *p, const struct rows *io, const struct group *g, double *block, double *buffer)
{
	const struct pm_line *l = &p->line[X];
	if (p->complex) {
		const double *row[L];
		for (size_t r = 0; r < L; r++)
			row[r] = g->w + r * g->stride;
		pm_spectra_in(l->fft, (int)g->rows, row, block);
		pm_fft_backward(l->fft, block);
		pm_lanes_out(block, NULL, p->nodes[X], p->buffer, buffer);
	} else {
		for (size_t r = 0; r < g->rows; r++)
			memcpy(buffer + r * p->buffer, g->w + r * g->stride, p->nodes[X] * sizeof *buffer);
		for (size_t r = g->rows; r < L; r++)
			memset(buffer + r * p->buffer, 0, p->nodes[X] * sizeof *buffer);
		pm_lanes_in(buffer, p->buffer, p->nodes[X], block + l->first * L);
		pm_line_real(l, block);
		pm_lanes_out(block, l->fft->at + l->first, p->nodes[X], p->buffer, buffer);
	}
	put_rows(p, io, g, buffer);
}

/* Columns of a plane: L lanes at a time. Real modes are put in order, complex ones stay as they come. */
static void columns(const struct pm_poisson_fft *p, double *plane, bool forward, double *block)
{
	const struct pm_line *l = &p->line[Y];
	for (size_t c = 0; c < p->chunks; c++, plane += L) {
		if (!p->complex) {
			gather(plane, p->row, p->nodes[Y], block + l->first * L);
			pm_line_real(l, block);
			for (size_t i = 0; i < p->nodes[Y]; i++)
				memcpy(plane + i * p->row, block + l->fft->at[l->first + i] * L, L * sizeof *block);
		} else if (forward) {
			gather(plane, p->row, p->nodes[Y], block);
			pm_line_extend(l, false, block);
			pm_fft_forward(l->fft, block);
			scatter(block, p->modes[Y], p->row, plane);
		} else {
			gather(plane, p->row, p->modes[Y], block);
			pm_fft_backward(l->fft, block);
			scatter(block, p->nodes[Y], p->row, plane);
		}
	}
}

void pm_poisson_fft_planes(const struct pm_poisson_fft *p, const struct rows *io, bool forward)
{
	bool plane = thick(p);
	size_t slabs = plane ? p->nodes[Z] : (p->nodes[Z] + L - 1) / L, rows = plane ? p->nodes[Y] : L;
#pragma omp parallel for schedule(dynamic) num_threads(p->threads)
	for (size_t i = 0; i < slabs; i++) {
		double *buffer = thread_scratch(p), *block = buffer + L * p->buffer;
		if (plane && !forward)
			columns(p, p->w + i * p->plane, false, block);
		for (size_t r = 0; r < rows; r += L) {
			struct group g = group_of(p, i, r);
			if (forward)
				rows_forward(p, io, &g, block, buffer);
			else
				rows_backward(p, io, &g, block, buffer);
		}
		if (plane && forward)
			columns(p, p->w + i * p->plane, true, block);
	}
}

static void times(const double *u, double *a)
{
	for (int q = 0; q < H; q++)
		a[q] *= u[q], a[q + H] *= u[q];
}

/* A block of complex pencils: frequencies k and n-k have the same factor. */
static void complex_pencils(struct pm_poisson_fft *p, size_t j, size_t c, double factor, double *block)
{
	const struct pm_line *l = &p->line[Z];
	const double *lx = p->lambda[X] + c * H, *green = p->green ? p->green + p->fold[j] * p->green_row + c * H : NULL;
	size_t n = l->length;
	pm_line_extend(l, false, block);
	pm_fft_forward(l->fft, block);
	if (j == 0 && c == 0)
		p->zero = block[0];
	for (size_t k = 0; k <= n - k; k++) {
		double u[H], *a = block + l->fft->at[k] * L, *b = block + l->fft->at[(n - k) % n] * L;
		for (int q = 0; q < H; q++)
			u[q] = green ? factor * green[k * p->green_plane + (size_t)q] : factor / (lx[q] + (p->lambda[Y][j] + p->lambda[Z][k]));
		if (p->singular && j == 0 && c == 0 && k == 0)
			u[0] = 0;
		times(u, a);
		if (a != b)
			times(u, b);
	}
	pm_fft_backward(l->fft, block);
}

static void real_pencils(struct pm_poisson_fft *p, size_t j, size_t c, double factor, double *block)
{
	double mine[L], zero;
	for (int q = 0; q < L; q++)
		mine[q] = p->lambda[X][c * L + (size_t)q] + p->lambda[Y][j];
	pm_line_solve(&p->line[Z], factor, p->lambda[Z], mine, p->singular && j == 0 && c == 0, &zero, block);
	if (j == 0 && c == 0)
		p->zero = zero;
}

void pm_poisson_fft_pencils(struct pm_poisson_fft *p, double factor, bool spectrum)
{
	const struct pm_line *l = &p->line[Z];
	size_t n = p->modes[Y] * p->chunks;
#pragma omp parallel for schedule(static) num_threads(p->threads)
	for (size_t i = 0; i < n; i++) {
		size_t j = i / p->chunks, c = i % p->chunks;
		double *block = thread_scratch(p), *at = p->w + j * p->row + c * L;
		gather(at, p->plane, p->nodes[Z], block + l->first * L);
		if (spectrum) {
			pm_line_real(l, block);
			for (size_t k = 0; k < p->nodes[Z]; k++)
				memcpy(at + k * p->plane, block + l->fft->at[l->first + k] * L, L * sizeof *block);
			continue;
		}
		if (p->complex)
			complex_pencils(p, j, c, factor, block);
		else
			real_pencils(p, j, c, factor, block);
		scatter(block + l->first * L, p->nodes[Z], p->plane, at);
	}
}
