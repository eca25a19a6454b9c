/* Meshes whose planes are on 1 to 7 rehearsed ranks: derivatives of all orders at all faces, and parts over the mesh, have the bytes of the whole mesh.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mesh/gradient-parts.h"
#include "world/over-ranks.h"
#include "world/world.h"
#include "check.h"

enum { MOST = 11 * 9 * 40 };
static double data[3][MOST], want[3][MOST], got[3][MOST];

/* The field of a mesh, of which this rank has a part; kind: how its planes are dealt. */
static struct pm_field part_of(const struct pm_grid *g, int kind, uint64_t from[8])
{
	const size_t planes = g->points[g->dim - 1], size = pm_grid_size(g) / planes, ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	for (size_t r = 0; r <= ranks; r++)
		from[r] = size * (kind == 0 ? planes * r / ranks : kind == 1 ? planes * r * r / (ranks * ranks) : r ? planes : 0);
	return (struct pm_field){.here = true, .first = from[me], .count = from[me + 1] - from[me], .from = from};
}

static void make(const void *values, size_t from, size_t to, void *part)
{
	for (size_t i = from; i < to; i++)
		pm_sum_add(part, ((const double *)values)[i]);
}

static int sums(const struct pm_grid *g, const struct pm_field *f)
{
	const struct pm_parts parts = {.size = sizeof(struct pm_sum), .make = make, .join = pm_join_sums};
	struct pm_sum all = {0.1, 0}, here = {pm_world_rank() ? 7 : 0.1, 0};
	struct pm_planes p;
	pm_over_mesh(&parts, data[0], g->points, &all);
	int bad = pm_planes_init(&p, g, f);
	bad |= pm_planes_over(bad, &p, &parts, data[0] + f->first, &here) || memcmp(&all, &here, sizeof all);
	pm_planes_free(&p);
	return bad;
}

static int derivative(const struct pm_grid *g, const struct pm_field *f, enum pm_operator_kind kind, int order, int components)
{
	struct pm_operator o;
	struct pm_planes p;
	const double *in[3], *with[3];
	double *all[3], *out[3], *room;
	bool seen;
	if (pm_operator_init(&o, g, kind, order, components, false))
		return 0; /* too few nodes for one-sided differences */
	for (int c = 0; c < 3; c++)
		in[c] = data[c] + f->first, all[c] = want[c], out[c] = got[c];
	int bad = pm_operator_apply(&o, 0.7, (const double *const[]){data[0], data[1], data[2]}, all, &seen) || pm_planes_init(&p, g, f);
	bad |= pm_planes_halo(bad, &p, pm_operator_reach(&o, &p), components, in, with, &room);
	o.planes = &p;
	bad |= p.here && pm_operator_apply(&o, 0.7, with, out, &seen);
	for (int c = 0; c < o.out; c++)
		bad |= memcmp(want[c] + f->first, got[c], f->count * sizeof(double));
	pm_free(room);
	pm_planes_free(&p);
	return bad;
}

static int64_t wrong(void)
{
	static const enum pm_face faces[4][2] = {{PM_PERIODIC, PM_PERIODIC}, {PM_OPEN, PM_OPEN}, {PM_WALL, PM_NEUMANN}, {PM_OPEN, PM_WALL}};
	int64_t bad = 0;
	uint64_t from[8];
	for (int n = 1; n < 40; n += n < 7 ? 1 : 13)
		for (int k = 0; k < 4 * 2 * 3; k++) {
			struct pm_grid g = {.dim = 2 + k / 12, .h = {0.3, 0.2, 0.1}};
			for (int d = 0; d < 3; d++) {
				memcpy(g.face[d], faces[d >= g.dim ? 0 : d == g.dim - 1 ? k % 4 : 2], sizeof g.face[d]);
				g.cells[d] = d >= g.dim ? 1 : d == g.dim - 1 ? (size_t)n : 8;
				g.points[d] = g.cells[d] + (g.face[d][0] != PM_PERIODIC);
			}
			const struct pm_field f = part_of(&g, k / 4 % 3, from);
			bad += sums(&g, &f);
			for (int order = 2; order <= 6; order += 2)
				bad += derivative(&g, &f, PM_OP_GRAD, order, 1) + derivative(&g, &f, PM_OP_LAP, order, 1) +
					derivative(&g, &f, PM_OP_DIV, order, g.dim) + derivative(&g, &f, PM_OP_CURL, order, g.dim);
		}
	return bad;
}

int main(void)
{
	for (int c = 0; c < 3; c++)
		for (int i = 0; i < MOST; i++)
			data[c][i] = exp(40 * fmod(0.6180339887 * (i + 77 * c), 1)) * (i % 3 - 1);
	for (int n = 1; n <= 7; n += n < 4 ? 1 : 3) {
		struct pm_transport t;
		int how;
		fflush(NULL);
		const pid_t pid = fork();
		if (!pid) {
			alarm(240); /* on a machine with much else to do: 7 ranks take 3 s of a processor */
			pm_threads_use(n < 2 ? 2 : 1);
			if (n > 1 && pm_transport_rehearse(&t, n))
				_exit(99);
			if (n > 1)
				pm_world_set(&t);
			int64_t bad = wrong();
			const int status = pm_world_count(0, PM_SUM_OF, 1, &bad), rank = pm_world_rank(), end = pm_world_end();
			_exit(rank ? 0 : status || bad || end);
		}
		check(waitpid(pid, &how, 0) == pid && !how, "%d ranks: grad, lap, div and curl of orders 2, 4 and 6 at all faces, and sums over meshes", n);
	}
	return check_done();
}
