/* The transform solver with its planes on 1 to 7 rehearsed ranks: the bytes of the whole mesh, at all kinds of faces, in 1-D, 2-D and 3-D; and what travels.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mesh/planes.h"
#include "poisson-fft/poisson-fft.h"
#include "world/world.h"
#include "check.h"

enum { MOST = 33 * 91 * 101 };
static double s[MOST], want[MOST], got[MOST];

static const enum pm_face faces[6][2] = {{PM_PERIODIC, PM_PERIODIC}, {PM_OPEN, PM_OPEN}, {PM_WALL, PM_WALL}, {PM_NEUMANN, PM_NEUMANN}, {PM_WALL, PM_NEUMANN},
	{PM_OPEN, PM_WALL}};

static struct pm_grid grid(int dim, int k)
{
	static const size_t cells[4][3] = {{0, 0, 0}, {37, 1, 1}, {9, 39, 1}, {7, 9, 8}};
	struct pm_grid g = {.dim = dim, .h = {0.3, dim > 1 ? 0.2 : 1, dim > 2 ? 0.1 : 1}};
	for (int d = 0; d < 3; d++) {
		memcpy(g.face[d], faces[d >= dim ? 0 : d == dim - 1 ? k % 6 : k / 6 % 6], sizeof g.face[d]);
		g.cells[d] = dim == 1 && d == 0 && k >= 6 ? 64 : cells[dim][d]; /* a line transformed alone, and one that is not */
		g.points[d] = g.cells[d] + (g.face[d][0] != PM_PERIODIC);
	}
	return g;
}

/* Beside what tables and agreements take, an exchange sends the work array there and back: at most 2 (1 - 1/ranks) of it. */
static int solve(const struct pm_grid *g, uint64_t *travels)
{
	const size_t planes = g->dim == 1 ? 1 : g->points[g->dim - 1], size = pm_grid_size(g) / planes, ranks = (size_t)pm_world_size(),
		me = (size_t)pm_world_rank(), grain = g->dim == 2 ? 16 : 1, grains = (planes + grain - 1) / grain;
	uint64_t from[8];
	struct pm_planes p;
	struct pm_poisson_fft_record all = {0}, here = {0};
	struct pm_poisson_fft_choice choice = {.symbol = PM_SPECTRAL};
	for (size_t r = 0; r <= ranks; r++)
		from[r] = size * (r == ranks ? planes : grain * (grains * r / ranks));
	const struct pm_field f = {.here = true, .first = from[me], .count = from[me + 1] - from[me], .from = from};
	struct pm_poisson_fft *whole = pm_poisson_fft_new(g, &choice);
	int bad = !whole || pm_poisson_fft_solve(whole, 0.7, s, want, &all) || pm_planes_init(&p, g, &f);
	pm_poisson_fft_free(whole);
	choice.planes = &p;
	struct pm_poisson_fft *part = pm_poisson_fft_new(g, &choice);
	for (int again = 0; again < 2 && !bad; again++) {
		const uint64_t before = pm_world_traffic().bytes;
		bad |= !part || pm_poisson_fft_solve(part, 0.7, s + f.first, got, &here);
		*travels = pm_world_traffic().bytes - before;
		bad |= memcmp(want + f.first, got, f.count * sizeof *got);
		bad |= all.mean != here.mean || all.incompatible != here.incompatible || here.most > all.most;
	}
	pm_poisson_fft_free(part);
	pm_planes_free(&p);
	return bad;
}

static int64_t wrong(void)
{
	int64_t bad = 0;
	uint64_t travels = 0;
	for (int dim = 1; dim <= 3; dim++)
		for (int k = 0; k < (dim == 1 ? 12 : 36); k += dim == 3 ? 5 : 1) {
			const struct pm_grid g = grid(dim, k);
			bad += solve(&g, &travels);
		}
	static const int turned[] = {0, 1, 6, 7}; /* beyond the caches, periodic and open: without ranks the passes turn the mesh (fft-passes.c) */
	for (int i = 0; i < 4; i++) {
		struct pm_grid g = grid(3, turned[i]);
		for (int d = 0; d < 3; d++)
			g.cells[d] = (const size_t[]){32, 90, 100}[d], g.points[d] = g.cells[d] + (g.face[d][0] != PM_PERIODIC);
		bad += solve(&g, &travels);
	}
	const struct pm_grid g = grid(3, 0); /* periodic: 9 x 8 rows of a chunk of 16, of which each rank sends what is not its own */
	bad += solve(&g, &travels);
	int64_t all[2] = {(int64_t)travels, 0};
	const int64_t ranks = pm_world_size();
	for (int64_t r = 0; r < ranks; r++)
		all[1] += r == pm_world_rank() ? 2 * (8 * (r + 1) / ranks - 8 * r / ranks) * (9 - (9 * (r + 1) / ranks - 9 * r / ranks)) * 16 * 8 : 0;
	bad += pm_world_count(0, PM_SUM_OF, 2, all) || all[0] < all[1] || all[0] > all[1] + 4096 * ranks;
	return bad;
}

int main(void)
{
	for (int i = 0; i < MOST; i++)
		s[i] = fmod(0.6180339887 * i, 1) + i % 7;
	for (int n = 1; n <= 7; n += n < 4 ? 1 : 3) {
		struct pm_transport t;
		int how;
		fflush(NULL);
		const pid_t pid = fork();
		if (!pid) {
			alarm(60);
			pm_threads_use(n < 2 ? 2 : 1);
			if (n > 1 && pm_transport_rehearse(&t, n))
				_exit(99);
			if (n > 1)
				pm_world_set(&t);
			int64_t bad = wrong();
			const int status = pm_world_count(0, PM_SUM_OF, 1, &bad), rank = pm_world_rank(), end = pm_world_end();
			_exit(rank ? 0 : status || bad || end);
		}
		check(waitpid(pid, &how, 0) == pid && !how, "%d ranks: potential and removed mean in 1-D, 2-D and 3-D at all faces; two exchanges travel", n);
	}
	return check_done();
}
