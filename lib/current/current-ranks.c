/* The current where particles are divided among the ranks in the order of the stream, and the mesh in planes. Alone, the ways have the order: the first piece
 * of every particle, then all further ones. If there are any of these, the ways are cut anew in that order; then they travel to the jobs of their tiles,
 * and rows of their blocks to the planes, as those of a density (transfer-ranks.c), a component at a time. The three blocks of a job are made together,
 * with the first, and of the others the rows that are not zero wait: about twice the mesh of a component, of what a rank has. Where there is no memory for
 * them, they are made again.
 * Travels: dim + 4 numbers a way to its job, as many of one that changes its rank before; the rows.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "current/current-parts.h"
#include "world/world.h"

/* Beginnings of the first pieces, behind them those of the further ones, of all ranks, from their numbers here; ranks + 1 each. */
static int beginnings(int status, size_t firsts, size_t more, size_t ranks, uint64_t *from)
{
	const size_t me = (size_t)pm_world_rank();
	if (!status)
		from[me + 1] = firsts, from[ranks + 1 + me + 1] = more;
	status = pm_world_count(status, PM_SUM_OF, 2 * (ranks + 1), (int64_t *)from);
	for (size_t r = 0; r < ranks && !status; r++) {
		from[r + 1] += from[r];
		from[ranks + 1 + r + 1] += from[ranks + 1 + r];
	}
	return status;
}

/* One array of the ways: the first pieces and the further ones to where they belong. */
static int cut(int status, const uint64_t *from, const uint64_t *to, size_t ranks, size_t firsts, const double *in, double *out)
{
	const uint64_t *more_from = from + ranks + 1, *more_to = to + ranks + 1;
	const size_t me = (size_t)pm_world_rank(), ahead = status ? 0 : (size_t)(to[me + 1] - to[me]);
	status = pm_world_recut(status, from, to, sizeof *in, in, out);
	return pm_world_recut(status, more_from, more_to, sizeof *in, in ? in + firsts : NULL, out ? out + ahead : NULL);
}

static int deal(int status, struct pm_ways *w, int dim, size_t firsts, uint64_t *first)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	uint64_t *from = calloc(4 * (ranks + 1), sizeof *from), *to = from ? from + 2 * (ranks + 1) : NULL;
	struct pm_ways now = {.n = 0};
	status = beginnings(status ? status : from ? 0 : pm_no_memory(), firsts, w->n - firsts, ranks, from);
	if (!status)
		*first = from[me];
	if (status || !from[2 * ranks + 1])
		return free(from), status;
	const uint64_t n = from[ranks], all = n + from[2 * ranks + 1];
	for (size_t r = 0; r <= ranks; r++) {
		const uint64_t at = all / ranks * r + all % ranks * r / ranks;
		to[r] = at < n ? at : n;
		to[ranks + 1 + r] = at - to[r];
	}
	*first = to[me] + to[ranks + 1 + me];
	status = pm_world_agree(pm_ways_new(&now, dim, (size_t)(to[me + 1] + to[ranks + 1 + me + 1] - *first)));
	for (int d = 0; d < dim; d++) {
		status = cut(status, from, to, ranks, firsts, w->at[d], now.at[d]);
		status = cut(status, from, to, ranks, firsts, w->way[d], now.way[d]);
	}
	for (int d = dim; d < 3; d++)
		status = cut(status, from, to, ranks, firsts, w->along[d], now.along[d]);
	status = cut(status, from, to, ranks, firsts, w->q, now.q);
	pm_ways_free(w);
	*w = now;
	free(from);
	return status;
}

/* The ways here in the order of tiles; *stray: the number in the order of all of the first one outside the box, or as before. */
static int order_here(int status, const struct pm_current *c, const struct pm_ways *ways, uint64_t first, struct pm_order_cache *local,
	struct pm_axis halves[3], size_t *stray)
{
	struct pm_ways_columns columns;
	const struct pm_tile_particles particles = pm_ways_particles(c, ways, &columns);
	status = status ? status : pm_axes_path(local->axes, halves, &c->grid, c->kernel->width);
	status = status ? status : pm_tile_order_init(&local->order, local->axes, &particles, 0, &local->strays);
	int64_t outside = !status && local->strays.count ? (int64_t)(first + local->strays.first) : INT64_MAX;
	status = pm_world_count(status, PM_LEAST_OF, 1, &outside);
	if (!status && outside < INT64_MAX) {
		*stray = (size_t)outside;
		return -PM_DATA;
	}
	return status;
}

/* The rows of a block that are not zero. */
struct waiting {
	size_t n;
	struct waiting_row {
		size_t at;
		double value[];
	} *row; /* NULL: made anew */
};

struct filling {
	struct pm_current_fill fill;
	int dim;
	double *three;           /* [threads][3][PM_BLOCK_MOST], zero between jobs */
	struct pm_current_cells *cells; /* [threads], or NULL */
	struct waiting *waiting; /* [jobs][2]; NULL: no memory */
	size_t jobs;
};

static size_t row_bytes(int dim) { return sizeof(struct waiting_row) + (size_t)pm_block_row[dim] * sizeof(double); }

static struct waiting_row *row_at(const struct waiting *w, int dim, size_t i) { return (struct waiting_row *)(void *)((char *)w->row + i * row_bytes(dim)); }

static bool is_zero(const double *row, size_t n)
{
	bool zero = true;
	for (size_t i = 0; i < n; i++)
		zero &= row[i] == 0;
	return zero;
}

/* Rows of a block to where they wait. */
static void keep(const double *block, int dim, struct waiting *w)
{
	const size_t row = (size_t)pm_block_row[dim], rows = PM_BLOCK_MOST / row;
	size_t n = 0;
	for (size_t r = 0; r < rows; r++)
		n += !is_zero(block + r * row, row);
	if (!(w->row = malloc((n + 1) * row_bytes(dim))))
		return;
	for (size_t r = 0; r < rows; r++)
		if (!is_zero(block + r * row, row)) {
			struct waiting_row *to = row_at(w, dim, w->n++);
			to->at = r * row;
			memcpy(to->value, block + r * row, row * sizeof *block);
		}
}

static int begin(const void *data, size_t jobs, int threads)
{
	struct filling *f = (struct filling *)(uintptr_t)data;
	f->three = pm_zalloc((size_t)threads * 3 * PM_BLOCK_MOST, sizeof *f->three);
	f->waiting = calloc(2 * jobs + 1, sizeof *f->waiting);
	f->jobs = jobs;
	return f->three && !pm_current_cells_new(&f->cells, threads, f->dim, f->fill.c->kernel) ? 0 : pm_failed();
}

static void filling_free(struct filling *f)
{
	for (size_t i = 0; f->waiting && i < 2 * f->jobs; i++)
		free(f->waiting[i].row);
	free(f->waiting), pm_free(f->three);
	f->cells = pm_current_cells_free(f->cells);
}

/* One of the three blocks of a job: blocks of a rank wait for no message. */
static void fill_one(const void *data, const struct pm_tile_pass *p, const struct pm_tile_job *j, int component, double *block)
{
	const struct filling *f = data;
	const size_t row = (size_t)pm_block_row[f->dim];
	struct waiting *two = f->waiting ? f->waiting + 2 * (size_t)(j - p->job) : NULL;
	if (component && two && two[component - 1].row) {
		struct waiting *w = &two[component - 1];
		for (size_t i = 0; i < w->n; i++)
			memcpy(block + row_at(w, f->dim, i)->at, row_at(w, f->dim, i)->value, row * sizeof *block);
		free(w->row);
		w->row = NULL;
		return;
	}
	double *three = f->three + (size_t)omp_get_thread_num() * 3 * PM_BLOCK_MOST;
	pm_current_fill(&f->fill, p, j, three, f->cells ? f->cells + omp_get_thread_num() : NULL);
	for (int k = 1; k < 3 && !component && two; k++)
		keep(three + k * PM_BLOCK_MOST, f->dim, &two[k - 1]);
	memcpy(block, three + component * PM_BLOCK_MOST, PM_BLOCK_MOST * sizeof *block);
	memset(three, 0, 3 * PM_BLOCK_MOST * sizeof *three);
}

int pm_current_ranks(int status, const struct pm_current *c, struct pm_ways *ways, size_t firsts, double *const mesh[3], size_t *stray)
{
	const struct pm_transfer t = {.grid = c->grid, .kernel = c->kernel, .components = 3, .planes = c->planes};
	struct pm_order_cache *local = calloc(1, sizeof *local);
	struct pm_axis halves[3] = {{0}};
	struct pm_tile_target to[3];
	unsigned char flip[3][3];
	uint64_t first = 0;
	status = deal(status ? status : local ? 0 : pm_no_memory(), ways, c->grid.dim, firsts, &first);
	status = order_here(status, c, ways, first, local, halves, stray);
	if (!status) {
		struct filling fill = {.fill = {c, local->axes[0].shift, NULL}, .dim = c->grid.dim};
		for (int k = 0; k < 3; k++)
			to[k] = pm_current_target(c, local->axes, halves, k, flip[k]);
		status = pm_spread_jobs_ranks(status, &t, local, &(struct pm_job_blocks){3, to, fill_one, begin, &fill}, mesh);
		filling_free(&fill);
	} else
		pm_order_cache_free(local);
	pm_axes_free(halves);
	return status;
}
