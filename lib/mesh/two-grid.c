/* Every second node of a mesh is a node of the coarse one. Along an axis
 *   R: r_I = (r_2I-1 + 2 r_2I + r_2I+1)/4      P: e_2I = e_I,  e_2I+1 = (e_I + e_I+1)/2
 * and products of these in the plane and in space; indices beyond a face are folded there, walls have no unknowns. Each value is summed by one thread, in one
 * order. Sources: Trottenberg, Oosterlee, Schueller 2001, section 2.3; Briggs, Henson, McCormick 2000, chapter 3. Cost: 3^dim and 2^dim operations a node.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "mesh/two-grid.h"

#include "mesh/index-fold.h"

enum { parallel = 16384 };

int pm_two_grid_check(const struct pm_grid *g)
{
	for (int d = 0; d < g->dim; d++) {
		if (g->cells[d] % 2)
			return pm_fail(PM_DATA, "axis %c has %zu cells, and the coarse mesh has half as many (p2m -n with even numbers; poisson-mg takes any)",
				"xyz"[d], g->cells[d]);
		for (int side = 0; side < 2; side++)
			if (g->face[d][side] == PM_OPEN || g->face[d][side] == PM_ABSORBING)
				return pm_fail(PM_DATA, "axis %c has %s faces, which give no values (pinit --faces wall, or poisson-mg, which takes open ones)",
					"xyz"[d], pm_face_names[g->face[d][side]]);
	}
	return 0;
}

struct pm_grid pm_two_grid_coarse(const struct pm_grid *fine)
{
	struct pm_grid g = *fine;
	for (int d = 0; d < g.dim; d++) {
		g.cells[d] /= 2;
		g.points[d] = g.cells[d] + (fine->points[d] - fine->cells[d]);
		g.h[d] *= 2;
	}
	return g;
}

static bool wall(const struct pm_grid *g, int d, size_t i)
{
	return d < g->dim && ((i == 0 && g->face[d][0] == PM_WALL) || (i + 1 == g->points[d] && g->face[d][1] == PM_WALL));
}

/* Node i of an axis of `to` as a weighted sum of nodes of `from`: R if down, else P. Returns how many. */
static int stencil(const struct pm_grid *fine, const struct pm_grid *coarse, int d, size_t i, bool down, size_t node[3], double w[3])
{
	const bool periodic = fine->face[d][0] == PM_PERIODIC;
	if (d >= fine->dim)
		return node[0] = i, w[0] = 1, 1;
	for (int s = 0; down && s < 3; s++) {
		node[s] = pm_index_fold(2 * (ptrdiff_t)i + s - 1, fine->points[d], periodic);
		w[s] = s == 1 ? 0.5 : 0.25;
	}
	if (down)
		return 3;
	node[0] = i / 2, node[1] = pm_index_fold((ptrdiff_t)(i / 2) + 1, coarse->points[d], periodic);
	w[0] = i % 2 ? 0.5 : 1, w[1] = 0.5;
	return i % 2 ? 2 : 1;
}

/* to = or += the weighted sums of from. */
static void transfer(const struct pm_grid *fine, const struct pm_grid *coarse, bool down, const double *from, double *to)
{
	const struct pm_grid *a = down ? fine : coarse, *b = down ? coarse : fine;
	#pragma omp parallel for num_threads(pm_threads()) if (pm_grid_size(b) > parallel)
	for (size_t row = 0; row < b->points[1] * b->points[2]; row++) {
		const size_t j = row % b->points[1], k = row / b->points[1];
		size_t node[3][3];
		double w[3][3];
		const int ny = stencil(fine, coarse, 1, j, down, node[1], w[1]), nz = stencil(fine, coarse, 2, k, down, node[2], w[2]);
		for (size_t i = 0; i < b->points[0]; i++) {
			const size_t at = i + row * b->points[0];
			const bool fixed = wall(b, 0, i) || wall(b, 1, j) || wall(b, 2, k);
			const int nx = stencil(fine, coarse, 0, i, down, node[0], w[0]);
			double sum = 0;
			for (int z = 0; z < nz && !fixed; z++)
				for (int y = 0; y < ny; y++)
					for (int x = 0; x < nx; x++)
						sum += w[2][z] * w[1][y] * w[0][x] * from[node[0][x] + a->points[0] * (node[1][y] + a->points[1] * node[2][z])];
			to[at] = down ? sum : to[at] + sum;
		}
	}
}

void pm_two_grid_restrict(const struct pm_grid *fine, const double *from, double *coarse)
{
	const struct pm_grid c = pm_two_grid_coarse(fine);
	transfer(fine, &c, true, from, coarse);
}

void pm_two_grid_prolong(const struct pm_grid *fine, const double *coarse, double *to)
{
	const struct pm_grid c = pm_two_grid_coarse(fine);
	transfer(fine, &c, false, coarse, to);
}
