/* The whole particle-mesh force, p2m, poisson, mgrad, m2p, in every mixture of periodic, wall and neumann faces, against the same force in a periodic
 * box of four times the length that holds the images: of a particle at x between faces at 0 and L those at -x, 2L - x and x - 2L, with the sign
 * of each reflection (odd in a wall, even in a neumann face). Agreement to round-off shows that every word treats each end of an axis separately.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fft/axis-transform.h"
#include "mesh/gradient.h"
#include "transfer/transfer.h"
#include "poisson-fft/poisson-fft.h"

static const enum pm_face ends[][2] = {{PM_PERIODIC, PM_PERIODIC}, {PM_WALL, PM_WALL}, {PM_NEUMANN, PM_NEUMANN}, {PM_WALL, PM_NEUMANN},
	{PM_NEUMANN, PM_WALL}};
enum { KINDS = sizeof ends / sizeof *ends, N = 7, IMAGES = 64 };

struct particles {
	size_t n;
	double *x[3], *m, *a[3];
};

static struct particles particles_new(size_t n)
{
	struct particles p = {.n = n, .m = calloc(n, sizeof(double))};
	for (int d = 0; d < 3; d++)
		p.x[d] = calloc(n, sizeof(double)), p.a[d] = calloc(n, sizeof(double));
	return p;
}

static void particles_free(struct particles *p)
{
	free(p->m);
	for (int d = 0; d < 3; d++)
		free(p->x[d]), free(p->a[d]);
}

/* Accelerations of the particles p due to themselves, for the first `some` only. */
static bool force(const struct pm_grid *g, const char *kernel, const struct pm_poisson_fft_choice *o, int order, struct particles *p, size_t some)
{
	size_t n = pm_grid_size(g);
	double *rho = calloc(n, sizeof *rho), *field[3] = {calloc(n, sizeof *rho), calloc(n, sizeof *rho), calloc(n, sizeof *rho)};
	struct pm_transfer t = {.grid = *g, .kernel = pm_kernel_find(kernel), .components = 1}, back = t;
	struct pm_strays strays;
	struct pm_operator grad;
	struct pm_fft_plans planner = {0};
	back.components = g->dim;
	for (int d = 0; d < 3; d++)
		back.flip[d][d] = 1; /* the normal component of a gradient, as m2p does */
	struct pm_poisson_fft *solver = pm_poisson_fft_new(g, o);
	bool good = solver && pm_spread(&t, p->n, (const double *const *)p->x, (const double *[]){p->m}, (double *[]){rho}, &strays) == 0 &&
		pm_poisson_fft_solve(solver, 4 * pm_pi, rho, rho, NULL) == 0 && pm_operator_init(&grad, g, PM_OP_GRAD, order, 1, false) == 0 &&
		pm_operator_plan(&grad, &planner) == 0 && pm_operator_apply(&grad, -1, (const double *[]){rho}, field, NULL) == 0 &&
		pm_gather(&back, some, (const double *const *)p->x, (const double *const *)field, NULL, p->a, &strays) == 0;
	pm_poisson_fft_free(solver);
	pm_fft_plans_clear(&planner);
	free(rho);
	for (int d = 0; d < 3; d++)
		free(field[d]);
	return good;
}

/* The box with the images, and the images: image 0 of each particle first. */
static struct particles unfold(const struct pm_grid *g, const struct particles *p, struct pm_grid *wide)
{
	int count = 1;
	*wide = *g;
	for (int d = 0; d < g->dim; d++)
		if (g->face[d][0] != PM_PERIODIC) {
			wide->cells[d] = wide->points[d] = 4 * g->cells[d];
			wide->face[d][0] = wide->face[d][1] = PM_PERIODIC;
			count *= 4;
		}
	struct particles all = particles_new(p->n * (size_t)count);
	for (size_t i = 0; i < all.n; i++) {
		size_t from = i % p->n, which = i / p->n;
		all.m[i] = p->m[from];
		for (int d = 0; d < g->dim; d++) {
			double x = p->x[d][from], twice = 2 * g->h[d] * (double)g->cells[d];
			if (g->face[d][0] != PM_PERIODIC) {
				bool low = which % 4 == 1 || which % 4 == 3, high = which % 4 >= 2;
				x = which % 4 == 0 ? x : which % 4 == 1 ? -x : which % 4 == 2 ? twice - x : x - twice;
				all.m[i] *= (low && g->face[d][0] == PM_WALL ? -1 : 1) * (high && g->face[d][1] == PM_WALL ? -1 : 1);
				which /= 4;
			}
			all.x[d][i] = x;
		}
	}
	return all;
}

/* At random, and on the faces, half a cell and a tenth of a cell from them. */
static struct particles places(const struct pm_grid *g)
{
	struct particles p = particles_new(N);
	for (size_t i = 0; i < N; i++) {
		double u[2], v[2];
		pm_random(31, i, 0, u);
		pm_random(31, i, 1, v);
		p.m[i] = 0.5 + v[1];
		const double at[3] = {u[0], u[1], v[0]};
		for (int d = 0; d < g->dim; d++) {
			double n = (double)g->cells[d], s = at[d] * n;
			s = i == 0 ? 0.1 : i == 1 ? n - 0.5 : i == 2 ? (d ? 0.5 : 0) : i == 3 ? (d ? s : n) : s;
			p.x[d][i] = s * g->h[d];
		}
	}
	return p;
}

static double mixture(int dim, int m, const char *kernel, const struct pm_poisson_fft_choice *o, int order)
{
	static const size_t cells[3] = {6, 5, 4};
	static const double h[3] = {0.7, 0.55, 0.9};
	struct pm_grid g = {.dim = dim, .cells = {1, 1, 1}, .points = {1, 1, 1}, .h = {1, 1, 1}}, wide;
	for (int d = 0; d < dim; d++, m /= KINDS) {
		memcpy(g.face[d], ends[m % KINDS], sizeof g.face[d]);
		g.cells[d] = cells[d], g.h[d] = h[d];
		g.points[d] = g.cells[d] + (m % KINDS != 0);
	}
	struct particles p = places(&g), all = unfold(&g, &p, &wide);
	double worst = 0, scale = 0;
	if (!force(&g, kernel, o, order, &p, p.n) || !force(&wide, kernel, o, order, &all, p.n))
		worst = NAN;
	for (int d = 0; d < dim; d++)
		for (size_t i = 0; i < N; i++) {
			double e = fabs(p.a[d][i] - all.a[d][i]);
			check_worst(&worst, e);
			check_worst(&scale, fabs(all.a[d][i]));
		}
	particles_free(&p), particles_free(&all);
	return worst / scale;
}

static void images(int dim, const char *kernel)
{
	int count = dim == 1 ? KINDS : dim == 2 ? KINDS * KINDS : KINDS * KINDS * KINDS;
	for (int order = 0; order <= 6; order += 2) {
		struct pm_poisson_fft_choice o = {.symbol = (enum pm_symbol)(order / 2), .screening = order == 4 ? 0.8 : 0};
		double worst = 0;
		int at = 0;
		for (int m = 0; m < count; m++) {
			double error = mixture(dim, m, kernel, &o, order);
			if (check_worst(&worst, error))
				at = m;
		}
		/* sums of some hundred images, a few thousand nodes: some hundred roundings of 1e-16 */
		check(worst < 2e-13, "%s, %d-D, %s and mgrad --order %s%s: the force is that of the images in all %d mixtures of faces (error %.1e, mixture "
			"%d)",
			kernel, dim, pm_symbol_names[o.symbol], pm_order_names[order ? order / 2 - 1 : 3], o.screening > 0 ? ", screened" : "", count, worst,
			at);
	}
}

int main(void)
{
	pm_threads_use(1); /* the meshes are small */
	for (int dim = 1; dim <= 3; dim++) {
		images(dim, "cic");
		images(dim, "tsc");
		if (dim < 3)
			images(dim, "m4prime");
	}
	return check_done();
}
