/* A gradient, or a curl in the plane, that is left to be made (lib/mesh/gradient-later.c): gathered from the potential, and made for who asks, it has the bytes
 * of the one made at once.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "mesh/gradient-later.h"
#include "stream/run.h"
#include "stream/declare.h"
#include "transfer/on-nodes.h"
#include "transfer/tile-cic.h"
#include "transfer/transfer-columns.h"

enum { MOST = 20000 };

struct problem {
	struct pm_frame *f;
	struct pm_grid grid;
	struct pm_gradient gradient;
	size_t points;
	double *at_once[3], *x[3], *a[3], *b[3];
};

static double random_of(uint64_t i, uint64_t kind)
{
	double u[2];
	pm_random(11, i, kind, u);
	return u[0] - 0.5;
}

static struct pm_field *made(struct pm_frame *f, const char *name, int components)
{
	struct pm_field *p = pm_makes(f, "mesh", name, components, PM_DERIVED);
	if (!p || pm_field_ready(p))
		exit(1);
	return p;
}

static double *room(size_t n)
{
	double *p = pm_zalloc(n, sizeof *p);
	if (!p)
		exit(1);
	return p;
}

/* size: of the potential. A box with faces of one kind; in the plane where cells[2] is 1. */
static void begin(struct problem *p, enum pm_operator_kind kind, const size_t cells[3], enum pm_face face, int order, double size)
{
	const int dim = cells[2] > 1 ? 3 : 2;
	*p = (struct problem){.f = pm_frame_new(dim)};
	for (int d = 0; d < dim; d++)
		p->f->face[d][0] = p->f->face[d][1] = face, p->f->lo[d] = -0.3, p->f->hi[d] = 1.9 + d;
	const struct pm_mesh *mesh = pm_frame_mesh_new(p->f, "mesh", cells);
	struct pm_field *phi = made(p->f, "phi", 1), *g = made(p->f, "g", dim);
	p->grid = pm_grid_of(p->f, mesh);
	p->points = pm_grid_size(&p->grid);
	for (size_t i = 0; i < p->points; i++)
		pm_out(phi, 0)[i] = size * random_of(i, 0);
	p->gradient = (struct pm_gradient){.source = phi, .target = g, .factor = -1};
	if (pm_operator_init(&p->gradient.operator, &p->grid, kind, order, 1, false))
		exit(1);
	for (int c = 0; c < dim; c++) {
		p->at_once[c] = room(p->points), p->x[c] = room(MOST), p->a[c] = room(MOST), p->b[c] = room(MOST);
		for (size_t i = 0; i < MOST; i++)
			p->x[c][i] = p->grid.lo[c] + (random_of(i, 1 + (uint64_t)c) + 0.5) * (double)cells[c] * p->grid.h[c];
	}
	const double *in[] = {pm_in(phi, 0)};
	if (pm_operator_apply(&p->gradient.operator, p->gradient.factor, in, p->at_once, NULL))
		exit(1);
}

static void end(struct problem *p)
{
	for (int c = 0; c < 3; c++)
		pm_free(p->at_once[c]), pm_free(p->x[c]), pm_free(p->a[c]), pm_free(p->b[c]);
	pm_frame_free(p->f);
}

/* Particles in the order of p2m's tiles of 32x16x8 cells; now and then one that is not. */
static void sort(struct problem *p, size_t every)
{
	static const size_t edge[3] = {32, 16, 8};
	size_t across[3], tiles = 1;
	for (int d = 0; d < 3; d++)
		tiles *= across[d] = (p->grid.cells[d] + edge[d] - 1) / edge[d];
	for (size_t i = 0; i < MOST; i++) {
		const size_t k = every && i % every == 0 && i > 1000 ? i - 1000 : i, tile = k * tiles / MOST;
		const size_t at[3] = {tile % across[0], tile / across[0] % across[1], tile / across[0] / across[1]};
		for (int d = 0; d < 3; d++) {
			const size_t first = at[d] * edge[d], left = p->grid.cells[d] - first, wide = left < edge[d] ? left : edge[d];
			p->x[d][i] = p->grid.lo[d] + ((double)first + 0.001 + (random_of(i, 7 + (uint64_t)d) + 0.5) * ((double)wide - 0.002)) * p->grid.h[d];
		}
	}
}

/* The largest acceleration that a gather from sorted particles found, beside a search: the same number, or 0 with SSE2 alone, where it does not look. */
static bool largest_found(struct problem *p, size_t every)
{
	struct pm_transfer t = {.grid = p->grid, .kernel = pm_kernel_find("cic"), .components = 3, .set = {true, true, true}};
	struct pm_column x[3], times[3];
	struct pm_target to[3];
	struct pm_strays strays;
	double most = 0;
	sort(p, every);
	for (int c = 0; c < 3; c++)
		x[c] = pm_column_doubles(p->x[c]), times[c] = (struct pm_column){.value = 1.7}, to[c] = (struct pm_target){.doubles = p->a[c]};
	if (pm_gather_columns(&t, MOST, x, (const double *const *)p->at_once, times, to, &strays))
		return false;
	for (size_t i = 0; i < MOST; i++)
		most = fmax(most, p->a[0][i] * p->a[0][i] + p->a[1][i] * p->a[1][i] + p->a[2][i] * p->a[2][i]);
	return strays.most == (PM_TILE_CIC_EIGHT ? most : 0);
}

static bool equal(const struct problem *p, size_t n, const char *kernel)
{
	struct pm_transfer t = {.grid = p->grid, .kernel = pm_kernel_find(kernel), .components = p->grid.dim, .set = {true, true, true}}, left = t;
	const double *none[3] = {NULL};
	struct pm_strays strays;
	bool same = true;
	left.gradient = pm_gradient_later_of(p->gradient.target);
	if (!left.gradient || pm_gather(&t, n, (const double *const *)p->x, (const double *const *)p->at_once, NULL, p->a, &strays) ||
		pm_gather(&left, n, (const double *const *)p->x, none, NULL, p->b, &strays))
		return false;
	for (int c = 0; c < p->grid.dim; c++)
		same &= !memcmp(p->a[c], p->b[c], n * sizeof *p->a[c]);
	return same;
}

/* A particle on every node, in the order of the mesh: its values are made from the potential. */
static bool equal_on_nodes(const struct problem *p)
{
	struct pm_transfer t = {.grid = p->grid, .kernel = pm_kernel_find("cic"), .components = p->grid.dim, .set = {true, true, true},
		.gradient = pm_gradient_later_of(p->gradient.target)};
	const double *none[3] = {NULL};
	double *out[3];
	struct pm_column factor[3];
	struct pm_target to[3];
	struct pm_strays strays;
	pm_frame_set_new(p->f, "matter", p->points);
	struct pm_field *x = pm_makes(p->f, "matter", "x", p->grid.dim, PM_STATE);
	if (!x || pm_field_ready(x))
		exit(1);
	for (size_t i = 0; i < p->points; i++) {
		const size_t at[3] = {i % p->grid.points[0], i / p->grid.points[0] % p->grid.points[1], i / p->grid.points[0] / p->grid.points[1]};
		for (int d = 0; d < p->grid.dim; d++)
			pm_out(x, d)[i] = p->grid.lo[d] + (double)at[d] * p->grid.h[d];
	}
	bool on = false, same = !pm_on_nodes(&t, x, &on) && on;
	for (int c = 0; c < p->grid.dim; c++)
		out[c] = room(p->points), factor[c] = (struct pm_column){.value = 1}, to[c] = (struct pm_target){.doubles = out[c]};
	same = same && !pm_on_nodes_gather(&t, x, none, factor, to, &strays) && strays.finite;
	for (int c = 0; c < p->grid.dim; c++) {
		for (size_t i = 0; i < p->points; i++)
			same &= out[c][i] == p->at_once[c][i];
		pm_free(out[c]);
	}
	return same && pm_gradient_later_of(p->gradient.target);
}

static void gathered(enum pm_operator_kind kind, const size_t cells[3], int order)
{
	static const char *const kernels[] = {"ngp", "cic", "tsc", "m6prime"};
	struct problem p;
	bool left = false, same = true;
	begin(&p, kind, cells, PM_PERIODIC, order, 1);
	const int dim = p.grid.dim;
	check(!pm_gradient_leave(&p.gradient, &left) && left && pm_gradient_later_of(p.gradient.target), "%s, %zux%zux%zu, order %d: it is left to be made",
		pm_operator_names[kind], cells[0], cells[1], cells[2], order);
	const struct pm_gradient_later *l = pm_gradient_later_of(p.gradient.target);
	double largest = 0, most = pm_gradient_later_most(l);
	for (size_t i = 0; i < p.points; i++)
		largest = fmax(largest, sqrt(pow(p.at_once[0][i], 2) + pow(p.at_once[1][i], 2) + (dim > 2 ? pow(p.at_once[2][i], 2) : 0)));
	check(largest <= most && most < largest * (1 + 1e-8) && l->within >= largest, "the largest gradient is %g, by a pass %g, by the largest potential %g",
		largest, most, l->within);
	for (size_t k = 0; k < sizeof kernels / sizeof *kernels; k++)
		same &= equal(&p, MOST, kernels[k]) && equal(&p, 90, kernels[k]);
	check(same, "what m2p makes of the potential has the bytes of what it reads");
	check(equal_on_nodes(&p), "and the values of particles on nodes");
	check(dim < 3 || (largest_found(&p, 0) && largest_found(&p, 97)), "it finds the largest acceleration");
	struct pm_field *phi = pm_frame_field(p.f, "mesh", "phi");
	phi->use = PM_USE_CHANGE;
	if (pm_field_ready(phi))
		exit(1);
	for (size_t i = 0; i < p.points; i++)
		pm_out(phi, 0)[i] = 7;
	same = pm_in(phi, 0)[p.points - 1] == 7;
	for (int c = 0; c < dim; c++)
		same &= !memcmp(p.at_once[c], pm_in(p.gradient.target, c), p.points * sizeof *p.at_once[c]);
	check(same && !pm_gradient_later_of(p.gradient.target), "who asks has the gradient of the potential as it was");
	end(&p);
}

static void at_once(const char *why, const size_t cells[3], enum pm_face face, int order, double size)
{
	struct problem p;
	bool left = true;
	begin(&p, PM_OP_GRAD, cells, face, order, size);
	check(!pm_gradient_leave(&p.gradient, &left) && !left, "made at once: %s", why);
	end(&p);
}

int main(void)
{
	for (int order = 2; order <= 6; order += 2) {
		gathered(PM_OP_GRAD, (const size_t[]){40, 33, 18}, order);
		gathered(PM_OP_GRAD, (const size_t[]){7, 64, 9}, order);
		gathered(PM_OP_GRAD, (const size_t[]){131, 70, 1}, order);
		gathered(PM_OP_CURL, (const size_t[]){131, 70, 1}, order);
		gathered(PM_OP_CURL, (const size_t[]){7, 1100, 1}, order);
		gathered(PM_OP_CURL, (const size_t[]){1100, 7, 1}, order);
	}
	at_once("walls in the plane", (const size_t[]){16, 16, 1}, PM_WALL, 2, 1);
	at_once("walls", (const size_t[]){16, 16, 16}, PM_WALL, 2, 1);
	at_once("an axis no longer than its differences", (const size_t[]){6, 16, 16}, PM_PERIODIC, 6, 1);
	at_once("values that may be infinite", (const size_t[]){16, 16, 16}, PM_PERIODIC, 2, 1e308);
	return check_done();
}
