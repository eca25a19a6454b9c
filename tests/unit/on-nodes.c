/* Particles on the nodes of a mesh (lib/transfer/on-nodes.c): copies instead of sums have the values of the general loops on a mesh of unit cells,
 * where those are exact, and of those on the mesh itself to rounding; and who is not on nodes is found. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "stream/declare.h"
#include "stream/run.h"
#include "transfer/on-nodes.h"

struct problem {
	struct pm_frame *f;
	struct pm_field *x;
	struct pm_transfer t, unit;
	size_t n, points;
	double *at[3], *q[2], *mesh[2], *want[2], *out[2], *got[2]; /* at: on the mesh of unit cells */
};

static double random_of(uint64_t i, uint64_t kind)
{
	double u[2];
	pm_random(3, i, kind, u);
	return u[0] - 0.5;
}

static double *room(size_t n)
{
	double *p = pm_zalloc(n, sizeof *p);
	if (!p)
		exit(1);
	return p;
}

/* Is it so far from the faces that no kernel reaches them, or on no face? */
static bool inside(const struct pm_grid *g, const size_t index[3], size_t margin)
{
	bool is = true;
	for (int d = 0; d < g->dim; d++)
		is = is && index[d] >= margin && index[d] + margin <= g->cells[d];
	return is;
}

/* share: of the nodes that have a particle, of those `margin` nodes inside faces. */
static void begin(struct problem *p, int dim, const size_t cells[3], enum pm_face face, const char *kernel, double share, size_t margin)
{
	*p = (struct problem){.f = pm_frame_new(dim)};
	for (int d = 0; d < dim; d++)
		p->f->face[d][0] = p->f->face[d][1] = face, p->f->lo[d] = -0.3 - d, p->f->hi[d] = 1.9 + d;
	p->t = (struct pm_transfer){.grid = pm_grid_of(p->f, pm_frame_mesh_new(p->f, "mesh", cells)), .kernel = pm_kernel_find(kernel), .components = 2,
		.set = {true, false}};
	const struct pm_grid *g = &p->t.grid;
	p->points = pm_grid_size(g);
	for (int d = 0; d < 3; d++)
		p->at[d] = room(p->points);
	for (size_t i = 0; i < p->points; i++) {
		const size_t index[] = {i % g->points[0], i / g->points[0] % g->points[1], i / g->points[0] / g->points[1]};
		if (random_of(i, 0) + 0.5 >= share || !inside(g, index, margin))
			continue;
		for (int d = 0; d < dim; d++)
			p->at[d][p->n] = (double)index[d];
		p->n++;
	}
	pm_frame_set_new(p->f, "matter", p->n);
	p->x = pm_makes(p->f, "matter", "x", dim, PM_STATE);
	if (!p->x || pm_frame_ready(p->f))
		exit(1);
	for (int d = 0; d < dim; d++)
		for (size_t i = 0; i < p->n; i++)
			pm_out(p->x, d)[i] = g->lo[d] + p->at[d][i] * g->h[d];
	if (pm_frame_settle(p->f))
		exit(1);
	p->unit = p->t;
	for (int d = 0; d < dim; d++)
		p->unit.grid.lo[d] = 0, p->unit.grid.h[d] = 1;
	for (int c = 0; c < 2; c++) {
		p->q[c] = room(p->n), p->out[c] = room(p->n), p->got[c] = room(p->n), p->mesh[c] = room(p->points), p->want[c] = room(p->points);
		for (size_t i = 0; i < p->n; i++)
			p->q[c][i] = random_of(i, 1 + (uint64_t)c), p->out[c][i] = p->got[c][i] = 0.1 * (double)(i % 7);
	}
}

static void end(struct problem *p)
{
	for (int d = 0; d < 3; d++)
		pm_free(p->at[d]);
	for (int c = 0; c < 2; c++)
		pm_free(p->q[c]), pm_free(p->out[c]), pm_free(p->got[c]), pm_free(p->mesh[c]), pm_free(p->want[c]);
	pm_frame_free(p->f);
}

static double apart(size_t n, double *const a[], double *const b[])
{
	double most = 0;
	for (int c = 0; c < 2; c++)
		for (size_t i = 0; i < n; i++)
			check_worst(&most, fabs(a[c][i] - b[c][i]));
	return most;
}

static void copies(int dim, const size_t cells[3], enum pm_face face, const char *kernel, double share)
{
	const size_t margin = face == PM_PERIODIC ? 0 : face == PM_OPEN ? (size_t)pm_kernel_find(kernel)->width / 2 + 1 : 1;
	struct problem p;
	struct pm_column q[2], times[2];
	struct pm_target to[2];
	struct pm_strays strays;
	bool on = false;
	begin(&p, dim, cells, face, kernel, share, margin);
	const double cell = pm_grid_cell(&p.t.grid), *x[3];
	for (int d = 0; d < dim; d++)
		x[d] = pm_in(p.x, d);
	const double *const *at = (const double *const *)p.at, *const *density = (const double *const *)p.mesh;
	check(!pm_on_nodes(&p.t, p.x, &on) && on, "%s, %d-D, %s faces: %zu particles are on the %zu nodes", kernel, dim,
		pm_face_names[face], p.n, p.points);
	for (int c = 0; c < 2; c++) {
		q[c] = pm_column_doubles(p.q[c]), times[c] = c ? pm_column_doubles(p.q[0]) : (struct pm_column){.value = -1.7};
		to[c] = (struct pm_target){.doubles = p.got[c]};
	}
	if (pm_on_nodes_spread(&p.t, p.x, q, false, p.mesh) || pm_spread(&p.t, p.n, x, (const double *const *)p.q, p.want, &strays))
		exit(1);
	const double off = apart(p.points, p.mesh, p.want) * cell;
	if (p.n == p.points) {
		for (int c = 0; c < 2; c++) {
			memcpy(p.want[c], p.mesh[c], p.points * sizeof *p.want[c]);
			for (size_t i = 0; i < p.points; i++)
				p.mesh[c][i] = NAN;
		}
		check(!pm_on_nodes_spread(&p.t, p.x, q, true, p.mesh) && apart(p.points, p.mesh, p.want) == 0, "what was on the mesh is replaced");
	}
	for (int c = 0; c < 2; c++) {
		memset(p.want[c], 0, p.points * sizeof *p.want[c]);
		for (size_t i = 0; i < p.n; i++)
			p.q[c][i] *= 1 / cell;
	}
	if (pm_spread(&p.unit, p.n, at, (const double *const *)p.q, p.want, &strays))
		exit(1);
	check(apart(p.points, p.mesh, p.want) == 0 && off < 1e-12, "the density is that of the general loops (%.1e)", off);
	double *factor = room(p.n);
	for (size_t i = 0; i < p.n; i++)
		factor[i] = -1.7;
	if (pm_on_nodes_gather(&p.t, p.x, density, times, to, &strays))
		exit(1);
	const double *const by[] = {factor, p.q[0]};
	check(strays.finite && !strays.count && !pm_gather(&p.unit, p.n, at, density, by, p.out, &strays) && apart(p.n, p.out, p.got) == 0,
		"so are the values at the particles, set and added");
	p.mesh[1][(size_t)p.at[0][p.n - 1] + p.points - p.t.grid.points[0]] = INFINITY; /* the row of the last node */
	check(share < 1 || margin || (!pm_on_nodes_gather(&p.t, p.x, density, times, to, &strays) && !strays.finite), "infinite values are found");
	p.t.grid.lo[0] += p.t.grid.h[0] / 4;
	check(!pm_on_nodes(&p.t, p.x, &on) && !on, "they are not on those of another mesh");
	pm_free(factor);
	end(&p);
}

/* what: changes the positions. */
static void apart_from(const char *why, enum pm_face face, size_t margin, const char *kernel, void what(struct problem *))
{
	struct problem p;
	bool on = true;
	begin(&p, 2, (const size_t[]){200, 170, 1}, face, kernel, 1, margin);
	p.x->use = PM_USE_CHANGE;
	if (pm_field_ready(p.x))
		exit(1);
	if (what)
		what(&p);
	check(!pm_on_nodes(&p.t, p.x, &on) && !on, "not where %s", why);
	end(&p);
}

static void nudge(struct problem *p) { pm_out(p->x, 1)[20011] = nextafter(pm_out(p->x, 1)[20011], 9); }
static void exchange(struct problem *p)
{
	for (int d = 0; d < 2; d++) {
		double *x = pm_out(p->x, d), was = x[8191];
		x[8191] = x[8192], x[8192] = was; /* of two pieces */
	}
}
static void double_up(struct problem *p)
{
	for (int d = 0; d < 2; d++)
		pm_out(p->x, d)[4096] = pm_out(p->x, d)[4095];
}
static void to_face(struct problem *p) { pm_out(p->x, 0)[p->n - 1] = p->t.grid.lo[0] + (double)p->t.grid.cells[0] * p->t.grid.h[0]; }
static void widen_rim(struct problem *p) { p->t.rim = 1; }
static void stagger(struct problem *p) { p->t.staggered[1][1] = 1; }

int main(void)
{
	static const char *const kernels[] = {"ngp", "cic", "m4prime", "m6prime", "lambda-8-4"};
	for (size_t k = 0; k < sizeof kernels / sizeof *kernels; k++) {
		copies(1, (const size_t[]){5001, 1, 1}, PM_PERIODIC, kernels[k], 0.7);
		copies(2, (const size_t[]){203, 171, 1}, PM_PERIODIC, kernels[k], 1);
		copies(2, (const size_t[]){203, 171, 1}, PM_OPEN, kernels[k], 0.9);
		copies(2, (const size_t[]){57, 131, 1}, PM_NEUMANN, kernels[k], 0.9);
		copies(3, (const size_t[]){39, 33, 18}, PM_PERIODIC, kernels[k], 0.3);
		copies(3, (const size_t[]){39, 33, 28}, PM_WALL, kernels[k], 0.9);
	}
	apart_from("a particle is beside its node", PM_PERIODIC, 0, "m6prime", nudge);
	apart_from("two have changed places", PM_PERIODIC, 0, "m6prime", exchange);
	apart_from("two are on one node", PM_PERIODIC, 0, "m6prime", double_up);
	apart_from("a component is half a cell up", PM_PERIODIC, 0, "m6prime", stagger);
	apart_from("the kernel does not interpolate", PM_PERIODIC, 0, "tsc", NULL);
	apart_from("one is on a wall", PM_WALL, 1, "m6prime", to_face);
	apart_from("kernels reach an open face", PM_OPEN, 3, "m6prime", NULL);
	apart_from("there is a rim beside open faces", PM_OPEN, 4, "m6prime", widen_rim);
	return check_done();
}
