/* Spread and gather with their particles and planes on 1 to 7 rehearsed ranks: the bytes of a transfer alone, for streams by tiles, nearly so and
 * at random, crowded or not, at all faces, in 1-D, 2-D and 3-D, components at several offsets, gathers that use the order of the spread; and how evenly
 * a crowd is dealt. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "check.h"
#include "transfer/shared-jobs.h"
#include "world/world.h"

enum { MOST = 40000, POINTS = 40 * 41 * 42, EVENLY = 1000000 };
static double x[3][MOST], q[3][MOST], mesh[3][POINTS], want_mesh[3][POINTS], want[3][MOST], part[3][POINTS], got[3][MOST];

enum order { AT_RANDOM, BY_TILES, NEARLY };
static const enum pm_face faces[4][2] = {{PM_PERIODIC, PM_PERIODIC}, {PM_OPEN, PM_OPEN}, {PM_WALL, PM_WALL}, {PM_NEUMANN, PM_OPEN}};

static struct pm_grid grid(int dim, int k)
{
	static const size_t cells[4][3] = {{0, 0, 0}, {9000, 1, 1}, {130, 200, 1}, {38, 40, 41}};
	struct pm_grid g = {.dim = dim, .lo = {-0.3, dim > 1 ? 0.1 : 0, dim > 2 ? 0.2 : 0}, .h = {0.7, dim > 1 ? 0.55 : 1, dim > 2 ? 0.9 : 1}};
	for (int d = 0; d < 3; d++) {
		memcpy(g.face[d], faces[d >= dim ? 0 : (k >> d) % 4], sizeof g.face[d]);
		g.cells[d] = cells[dim][d];
		g.points[d] = g.cells[d] + (g.face[d][0] != PM_PERIODIC);
	}
	return g;
}

/* The tile of the cell of a position. */
static size_t tile(const struct pm_grid *g, const double at[3])
{
	size_t tile = 0;
	for (int d = g->dim - 1; d >= 0; d--)
		tile = tile * 16 + ((size_t)((at[d] - g->lo[d]) / g->h[d]) >> pm_tile_shift[g->dim][d]);
	return tile;
}

/* n particles, nine tenths of them in one cell if crowded. Those of a stream by tiles are drawn tile by tile, as often as it takes. */
static void place(const struct pm_grid *g, size_t n, enum order order, bool crowded)
{
	static double u[3][MOST];
	static size_t key[MOST], begin[MOST + 1];
	for (size_t p = 0; p < n; p++) {
		double at[3] = {0}, r[2];
		for (int d = 0; d < g->dim; d++) {
			pm_random(5, p, (uint64_t)d, r);
			const bool crowd = crowded && p % 10;
			u[d][p] = at[d] = g->lo[d] + g->h[d] * (crowd ? 20 + r[0] : 3 + r[0] * ((double)g->cells[d] - 6));
		}
		key[p] = tile(g, at);
	}
	memset(begin, 0, sizeof begin);
	for (size_t p = 0; p < n; p++)
		begin[key[p] + 1]++;
	for (size_t i = 0; i < MOST; i++)
		begin[i + 1] += begin[i];
	for (size_t p = 0; p < n; p++) {
		const size_t to = order == AT_RANDOM ? p : begin[key[p]]++;
		for (int d = 0; d < g->dim; d++)
			x[d][to] = u[d][p] + (order == NEARLY && p % 7 == 0 ? 1.4 * g->h[d] : 0);
	}
	for (size_t p = 0; p < n; p++)
		for (int c = 0; c < 3; c++)
			q[c][p] = fmod(0.6180339887 * (double)(p + 1) * (c + 1), 1) - 0.3;
}

/* The part of this rank of n things in units of grain. */
static struct pm_field stretch(uint64_t from[8], size_t n, size_t grain)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank(), grains = (n + grain - 1) / grain;
	for (size_t r = 0; r <= ranks; r++)
		from[r] = r == ranks ? n : grain * (grains * r / ranks) < n ? grain * (grains * r / ranks) : n;
	return (struct pm_field){.here = true, .first = from[me], .count = from[me + 1] - from[me], .from = from};
}

static void forget(struct pm_note *note)
{
	if (note)
		note->free(note);
}

/* Bytes that differ from those of a transfer alone, or a failure. */
static int differs(const struct pm_transfer *t, size_t n)
{
	const struct pm_grid *g = &t->grid;
	const size_t points = pm_grid_size(g), plane = g->dim == 1 ? points : points / g->points[g->dim - 1];
	uint64_t particles[8], planes[8];
	const struct pm_field set = stretch(particles, n, 4096), field = stretch(planes, points, g->dim == 2 ? 16 * plane : plane);
	struct pm_planes p;
	struct pm_note *kept = NULL;
	struct pm_strays strays;
	struct pm_transfer alone = *t, here = *t;
	const double *all[3], *own[3], *factor[3], *own_factor[3], *strength[3], *own_strength[3], *from[3], *own_from[3];
	double *to[3], *own_to[3], *out[3], *own_out[3];
	for (int c = 0; c < 3; c++) {
		all[c] = x[c], own[c] = x[c] + set.first;
		strength[c] = q[c], own_strength[c] = q[c] + set.first;
		factor[c] = c == 1 ? q[0] : NULL, own_factor[c] = c == 1 ? q[0] + set.first : NULL;
		to[c] = want_mesh[c], own_to[c] = part[c], out[c] = want[c], own_out[c] = got[c];
		from[c] = want_mesh[c], own_from[c] = want_mesh[c] + field.first;
		for (size_t i = 0; i < points; i++)
			want_mesh[c][i] = mesh[c][i] = 1e-3 * (double)(i % 17);
		memcpy(part[c], mesh[c] + field.first, field.count * sizeof **mesh);
		for (size_t i = 0; i < n; i++)
			want[c][i] = 0.25;
		for (size_t i = 0; i < set.count; i++)
			got[c][i] = 0.25;
	}
	int bad = pm_planes_init(&p, g, &field) || pm_spread(&alone, n, all, strength, to, &strays);
	const uint64_t outside = strays.count;
	here.planes = &p, here.kept = &kept;
	int status = pm_spread(&here, set.count, own, own_strength, own_to, &strays);
	int64_t count = (int64_t)strays.count;
	bad |= pm_world_count(status, PM_SUM_OF, 1, &count) || (uint64_t)count != outside;
	for (int c = 0; c < t->components; c++)
		bad |= memcmp(want_mesh[c] + field.first, part[c], field.count * sizeof **part);
	bad |= pm_gather(&alone, n, all, from, factor, out, &strays);
	for (int again = 0; again < 2; again++) { /* with the order of the spread, and with its own */
		for (int c = 0; c < 3; c++)
			for (size_t i = 0; i < set.count; i++)
				got[c][i] = 0.25;
		bad |= pm_gather(&here, set.count, own, own_from, own_factor, own_out, &strays);
		for (int c = 0; c < t->components; c++)
			bad |= memcmp(want[c] + set.first, got[c], set.count * sizeof **got);
		forget(kept);
		kept = NULL;
	}
	pm_planes_free(&p);
	return bad != 0;
}

static int64_t wrong(void)
{
	static const char *const kernels[] = {"cic", "tsc", "m4prime", "ngp"};
	int64_t bad = 0;
	for (int dim = 1, k = 0; dim <= 3; dim++)
		for (int order = AT_RANDOM; order <= NEARLY; order++)
			for (int crowded = 0; crowded < 2; crowded++, k++) {
				static const size_t sizes[] = {MOST, 12289, 4097, 0};
				const size_t n = k % 6 == 1 ? sizes[dim] : MOST;
				struct pm_transfer t = {.grid = grid(dim, k), .kernel = pm_kernel_find(kernels[k % 4 == 3 && !crowded ? 3 : k % 3]),
					.components = 1 + k % 3};
				t.flip[0][0] = t.set[0] = k % 2, t.cut = k % 5 == 0;
				place(&t.grid, n, (enum order)order, crowded);
				bad += differs(&t, n);
				t.components = dim == 3 ? 3 : 2;
				t.staggered[1][dim - 1] = 1; /* another pass */
				bad += (k % 3 == 0) && differs(&t, n);
			}
	return bad;
}

/* Nine tenths of the particles in a hundredth of the box: the most records that a rank's jobs have, over the mean. */
static double unevenness(size_t n)
{
	struct pm_grid g = grid(3, 0);
	const size_t points = pm_grid_size(&g), ranks = (size_t)pm_world_size();
	uint64_t particles[8], planes[8];
	const struct pm_field set = stretch(particles, n, 4096), field = stretch(planes, points, points / g.points[2]);
	struct pm_planes p;
	const struct pm_transfer t = {.grid = g, .kernel = pm_kernel_find("cic"), .components = 1, .planes = &p};
	struct pm_shared_jobs v = {.t = &t, .w = {.t = &t, .components = 1}};
	double *own[3], ratio = NAN, u[2];
	int status = pm_planes_init(&p, &g, &field);
	for (int d = 0; d < 3; d++) {
		own[d] = pm_alloc(set.count + 1, sizeof **own);
		for (size_t i = 0; i < set.count && own[d]; i++) {
			pm_random(6, set.first + i, (uint64_t)d, u);
			own[d][i] = g.lo[d] + (double)g.cells[d] * g.h[d] * ((set.first + i) % 10 ? 0.4 + 0.2154 * u[0] : u[0]); /* 0.2154^3 = 0.01 */
		}
	}
	status = pm_shared_jobs_init(status, &v, set.count, (const double *const *)own, 0, NULL, 3);
	for (size_t r = 0, most = 0; r < ranks && !status; r++) {
		const size_t records = v.record_of[r + 1] - v.record_of[r];
		most = records > most ? records : most;
		ratio = (double)most * (double)ranks / (double)n;
	}
	pm_shared_jobs_free(&v, false);
	pm_planes_free(&p);
	for (int d = 0; d < 3; d++)
		pm_free(own[d]);
	return ratio;
}

int main(void)
{
	for (int n = 1; n <= 7; n += n < 3 ? 1 : 4) {
		struct pm_transport t;
		int how;
		fflush(NULL);
		const pid_t pid = fork();
		if (!pid) {
			alarm(60);
			pm_threads_use(n < 3 ? 2 : 1);
			if (n > 1 && pm_transport_rehearse(&t, n))
				_exit(99);
			if (n > 1)
				pm_world_set(&t);
			int64_t bad = wrong();
			const int status = pm_world_count(0, PM_SUM_OF, 1, &bad), rank = pm_world_rank(), end = pm_world_end();
			_exit(rank ? 0 : status || bad || end);
		}
		check(waitpid(pid, &how, 0) == pid && !how, "%d ranks: spreads and gathers have the bytes of one alone", n);
	}
	struct pm_transport t;
	int how;
	fflush(NULL);
	const pid_t pid = fork();
	if (!pid) {
		alarm(60);
		if (pm_transport_rehearse(&t, 4))
			_exit(99);
		pm_world_set(&t);
		const double ratio = unevenness(EVENLY);
		const int rank = pm_world_rank(), end = pm_world_end();
		if (!rank)
			printf("# slowest over mean %.4f\n", ratio);
		fflush(NULL);
		_exit(rank ? 0 : end || !(ratio < 1 + 16384. * 4 / EVENLY && ratio < 1.1));
	}
	check(waitpid(pid, &how, 0) == pid && !how, "4 ranks, nine tenths of %d particles in a hundredth of the box: no rank has more than 1.1 of the mean",
		EVENLY);
	return check_done();
}
