/* The transform solver on many ranks: each transforms its planes, one exchange turns planes into pencils, one turns them back. A rank owns the pencils of
 * consecutive units: in 3-D the rows y of the planes of modes, in 2-D chunks of a row. Of these it gets the planes of every rank, rank after rank, so that no
 * second copy is needed to put them in order: a unit is gathered from these pieces, and goes back to them.
 * Cost: two exchanges of the work array, of which the part 1 - 1/ranks travels. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "poisson-fft/fft-passes.h"
#include "world/world.h"

static bool thick(const struct pm_poisson_fft *p) { return p->grid.dim == 3; }
static size_t unit_size(const struct pm_poisson_fft *p) { return thick(p) ? p->row : L; }

/* Planes of the mesh to nodes that take part: those on walls do not. */
static size_t node(const struct pm_poisson_fft *p, uint64_t plane)
{
	const size_t first = p->line[Z].first, nodes = p->nodes[Z];
	return plane < first ? 0 : plane - first < nodes ? (size_t)plane - first : nodes;
}

int pm_poisson_fft_ranks(struct pm_poisson_fft *p, const struct pm_planes *planes)
{
	const size_t ranks = (size_t)pm_world_size(), units = thick(p) ? p->modes[Y] : p->chunks, me = (size_t)pm_world_rank();
	p->zhere = p->nodes[Z];
	p->planes = p->grid.points[Z];
	if (p->grid.dim < 3)
		p->planes = p->grid.dim == 2 ? p->grid.points[1] : 1;
	if (!planes || !planes->divided)
		return 0;
	p->from = malloc(3 * (ranks + 1) * sizeof *p->from);
	p->bytes = malloc(2 * ranks * sizeof *p->bytes);
	if (!p->from || !p->bytes)
		return pm_no_memory();
	p->nodes_of = p->from + ranks + 1, p->units_of = p->from + 2 * (ranks + 1);
	for (size_t r = 0; r <= ranks; r++) {
		p->from[r] = planes->from[r];
		p->nodes_of[r] = node(p, planes->from[r]);
		p->units_of[r] = units * r / ranks;
	}
	p->first = planes->first;
	p->planes = planes->here;
	p->zfirst = p->nodes_of[me];
	p->zhere = p->nodes_of[me + 1] - p->zfirst;
	return 0;
}

bool pm_poisson_fft_same_ranks(const struct pm_poisson_fft *p, const struct pm_planes *planes)
{
	const bool divided = planes && planes->divided;
	if (p->james)
		return pm_poisson_fft_same_ranks(pm_fft_james_walled(p->james), planes);
	return divided == (p->from != NULL) && (!divided || !memcmp(p->from, planes->from, ((size_t)pm_world_size() + 1) * sizeof *p->from));
}

void pm_poisson_fft_rows_here(const struct pm_poisson_fft *p, size_t *first, size_t *end)
{
	const bool some = p->from && thick(p);
	*first = some ? (size_t)p->units_of[pm_world_rank()] : 0;
	*end = some ? (size_t)p->units_of[pm_world_rank() + 1] : p->modes[Y];
}

/* In 2-D rows of chunks to units, or back. */
static void turn_rows(const struct pm_poisson_fft *p, double *units, bool back)
{
	for (size_t k = 0; k < p->zhere; k++)
		for (size_t c = 0; c < p->chunks; c++) {
			double *in_row = p->w + k * p->row + c * L, *in_unit = units + (c * p->zhere + k) * L;
			memcpy(back ? in_row : in_unit, back ? in_unit : in_row, L * sizeof *in_row);
		}
}

/* Bytes of the units of rank r, of the planes of rank s. */
static size_t piece(const struct pm_poisson_fft *p, size_t r, size_t s)
{
	return (p->units_of[r + 1] - p->units_of[r]) * (p->nodes_of[s + 1] - p->nodes_of[s]) * unit_size(p) * sizeof *p->w;
}

int pm_poisson_fft_to_pencils(int status, struct pm_poisson_fft *p, double **pencils)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	double *units = p->w;
	void *in = NULL;
	if (!status && !thick(p)) {
		units = pm_alloc(p->chunks * p->zhere * L + 1, sizeof *units);
		status = units ? 0 : pm_failed();
		if (units)
			turn_rows(p, units, false);
	}
	for (size_t r = 0; r < ranks; r++)
		p->bytes[r] = piece(p, r, me);
	status = pm_world_exchange(status, units, p->bytes, &in, p->bytes + ranks);
	if (units != p->w)
		pm_free(units);
	p->w = pm_free(p->w); /* the way back makes it anew */
	*pencils = in;
	return status;
}

int pm_poisson_fft_to_planes(int status, struct pm_poisson_fft *p, double **pencils)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	void *in = NULL;
	for (size_t r = 0; r < ranks; r++)
		p->bytes[r] = piece(p, me, r);
	status = pm_world_exchange(status, *pencils, p->bytes, &in, p->bytes + ranks);
	*pencils = pm_free(*pencils);
	if (status || thick(p)) {
		p->w = in;
		return status;
	}
	status = pm_poisson_fft_work(p);
	if (!status)
		turn_rows(p, in, true);
	pm_free(in);
	return pm_world_agree(status);
}

void pm_poisson_fft_unit(const struct pm_poisson_fft *p, size_t unit, double *pencils, double *slab, bool back)
{
	const size_t size = unit_size(p), me = (size_t)pm_world_rank(), units = p->units_of[me + 1] - p->units_of[me];
	for (size_t s = 0; s < (size_t)pm_world_size(); s++) {
		const size_t here = p->nodes_of[s + 1] - p->nodes_of[s];
		double *piece_of = pencils + (p->nodes_of[s] * units + unit * here) * size, *in_slab = slab + p->nodes_of[s] * size;
		memcpy(back ? piece_of : in_slab, back ? in_slab : piece_of, here * size * sizeof *slab);
	}
}

/* The rank that has the mode of constants. */
int pm_poisson_fft_zero(int status, struct pm_poisson_fft *p)
{
	int root = 0;
	while (p->units_of[root + 1] == 0)
		root++;
	return pm_world_share(status, root, &p->zero, sizeof p->zero);
}

int pm_poisson_fft_line_record(int status, struct pm_poisson_fft *p, double *largest)
{
	int root = 0;
	if (!p->from || !p->singular)
		return status;
	while (p->from[root + 1] == 0)
		root++;
	status = pm_world_largest(status, 1, largest);
	return pm_world_share(status, root, &p->zero, sizeof p->zero);
}
