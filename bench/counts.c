/* The hot loops on small fixed problems, for counting instructions under callgrind (counts.sh): each case runs once to make its plans and once inside
 * pm_counted. Prints per case: name, what is counted per, how many of them. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <stdlib.h>

#include "far/pp.h"
#include "mesh/gradient.h"
#include "current/current.h"
#include "transfer/transfer.h"
#include "poisson-fft/poisson-fft.h"
#include "poisson-mg/mg.h"

#include "push/state-advance.h"

enum { CELLS = 32, POINTS = CELLS * CELLS * CELLS, NODES = (CELLS + 1) * (CELLS + 1) * (CELLS + 1), BODIES = 1024 };

struct work {
	double *x[3], *v[3], *a[3], *q, *rho, *phi, *g[3];
	struct pm_transfer transfer;
	struct pm_current current;
	struct pm_poisson_fft *fft;
	struct pm_mg *mg;
	struct pm_operator gradient;
	struct pm_pp pp;
	const char *step; /* a magnetic kick */
};

/* The function that callgrind counts. */
void pm_counted(void (*run)(struct work *), struct work *w);
__attribute__((noinline)) void pm_counted(void (*run)(struct work *), struct work *w)
{
	run(w);
	__asm__ volatile("" ::: "memory"); /* the call must not be the last thing done, or it becomes a jump */
}

static void must(int status)
{
	if (status)
		fprintf(stderr, "counts: %s\n", pm_message()), exit(1);
}

static void spread(struct work *w)
{
	struct pm_strays strays;
	w->transfer.components = 1;
	must(pm_spread(&w->transfer, POINTS, (const double *const *)w->x, (const double *const *)&w->q, &w->rho, &strays));
}

static void gather(struct work *w)
{
	struct pm_strays strays;
	w->transfer.components = 3;
	must(pm_gather(&w->transfer, POINTS, (const double *const *)w->x, (const double *const *)w->g, NULL, w->a, &strays));
}

static void fft(struct work *w) { must(pm_poisson_fft_solve(w->fft, 1, w->rho, w->phi, NULL)); }
static void cycle(struct work *w) { pm_mg_once(w->mg, &(struct pm_mg_choice){.pre = 2, .post = 2, .smoother = PM_MG_SOR, .relaxation = 1.15}); }
static void gradient(struct work *w) { must(pm_operator_apply(&w->gradient, -1, (const double *const *)&w->phi, w->g, &(bool){false})); }

static void pairs(struct work *w)
{
	uint64_t coincident;
	must(pm_pp_sum(&w->pp, BODIES, BODIES, (const double *const *)w->x, w->q, w->a, NULL, &coincident));
}

static void push(struct work *w)
{
	struct pm_advance a = {.actions = 2};
	struct pm_bounds box = {.lo = 0, .hi = CELLS, .fold = true};
	a.action[0].step = pm_step_find("kick"), a.action[1].step = pm_step_find("drift");
	for (int d = 0; d < 3; d++) {
		struct pm_advanced lines[2] = {{.y = w->x[d], .k = w->v[d], .position = true}, {.y = w->v[d], .k = w->a[d]}};
		pm_advance_axis(POINTS, &a, 2, lines, w->x[d], NULL, &box, NULL);
	}
}

static void current(struct work *w)
{
	size_t stray;
	must(pm_current_add(&w->current, POINTS, (const double *const *)w->x, (const double *const *)w->v, w->q, w->g, &stray));
}

/* E and B on Yee's mesh. */
static void light(struct work *w)
{
	const double *const mesh[] = {w->g[0], w->g[1], w->g[2], w->g[0], w->g[1], w->g[2]};
	double *const out[] = {w->a[0], w->a[1], w->a[2], w->rho, w->phi, w->q};
	struct pm_strays strays;
	w->transfer.components = 6;
	for (int c = 0; c < 6; c++)
		for (int d = 0; d < 3; d++)
			w->transfer.set[c] = true, w->transfer.staggered[c][d] = (c % 3 == d) == (c < 3);
	must(pm_gather(&w->transfer, POINTS, (const double *const *)w->x, mesh, NULL, out, &strays));
}

static void kick(struct work *w)
{
	struct pm_magnetic m = {.charge = w->q, .mass = w->q, .c = 10};
	for (int d = 0; d < 3; d++)
		m.v[d] = w->v[d], m.acc[d] = w->a[d], m.b[d] = w->g[d];
	pm_step_find(w->step)->magnetic(true, 0.01, 0, POINTS, &m);
}

static void run(struct work *w, const char *name, const char *per, double items, void (*f)(struct work *))
{
	f(w);
	pm_counted(f, w);
	printf("%s\t%s\t%.0f\n", name, per, items);
}

static void fill(struct work *w)
{
	w->q = pm_zalloc(POINTS, 8), w->rho = pm_zalloc(NODES, 8), w->phi = pm_zalloc(NODES, 8);
	for (int d = 0; d < 3; d++) {
		w->x[d] = pm_zalloc(POINTS, 8), w->v[d] = pm_zalloc(POINTS, 8), w->a[d] = pm_zalloc(POINTS, 8), w->g[d] = pm_zalloc(POINTS, 8);
		for (size_t p = 0; p < POINTS; p++) {
			double u[2];
			pm_random(1, p, (uint64_t)d, u);
			w->x[d][p] = u[0] * CELLS, w->v[d][p] = u[1], w->q[p] = 1;
		}
	}
}

/* In the order of cells, up to ways of a twentieth: most have the tile of the one before. */
static void in_order(struct work *w)
{
	for (size_t p = 0; p < POINTS; p++)
		for (int d = 0; d < 3; d++) {
			const size_t cell[3] = {p % CELLS, p / CELLS % CELLS, p / CELLS / CELLS};
			w->x[d][p] = (double)cell[d] + w->v[d][p];
			w->v[d][p] = 0.1 * w->v[d][p] - 0.05;
		}
	w->current = (struct pm_current){.grid = w->transfer.grid, .dt = 1, .hi = {CELLS, CELLS, CELLS}};
}

/* Poisson's equation with one kind of face all around. */
static void solve(struct work *w, enum pm_face face)
{
	struct pm_grid g = {.dim = 3};
	char name[32];
	for (int d = 0; d < 3; d++)
		g.cells[d] = CELLS, g.points[d] = CELLS + (face != PM_PERIODIC), g.h[d] = 1, g.face[d][0] = g.face[d][1] = face;
	w->fft = pm_poisson_fft_new(&g, &(struct pm_poisson_fft_choice){.symbol = PM_SPECTRAL});
	must(!w->fft);
	snprintf(name, sizeof name, "poisson-fft %s 32^3", pm_face_names[face]);
	run(w, name, "point", (double)pm_grid_size(&g), fft);
	w->fft = pm_poisson_fft_free(w->fft);
}

static void gather_line(struct work *w)
{
	struct pm_strays strays;
	must(pm_gather(&w->transfer, POINTS, (const double *const *)w->x, (const double *const *)w->g, NULL, w->a, &strays));
}

/* cic on a line, straight from the stream. */
static void on_a_line(struct work *w)
{
	struct pm_grid g = {.dim = 1, .cells = {1024, 1, 1}, .points = {1024, 1, 1}, .h = {CELLS / 1024., 1, 1}};
	for (int d = 0; d < 3; d++)
		g.face[d][0] = g.face[d][1] = PM_PERIODIC;
	w->transfer = (struct pm_transfer){.grid = g, .kernel = pm_kernel_find("cic"), .components = 1};
	run(w, "p2m cic, 1-D", "particle", POINTS, spread);
	run(w, "m2p cic, 1-D", "particle", POINTS, gather_line);
	w->fft = pm_poisson_fft_new(&g, &(struct pm_poisson_fft_choice){.symbol = PM_SPECTRAL});
	must(!w->fft);
	run(w, "poisson-fft periodic 1024", "point", 1024, fft);
	w->fft = pm_poisson_fft_free(w->fft);
}

/* Currents by sums of cells, 32 particles in each: on a line, and in the plane. */
static void by_cells(struct work *w)
{
	for (int dim = 1; dim < 3; dim++) {
		struct pm_grid g = {.dim = dim};
		char name[32];
		for (int d = 0; d < 3; d++) {
			g.cells[d] = g.points[d] = d >= dim ? 1 : dim == 1 ? 1024 : CELLS;
			g.h[d] = dim == 1 && d == 0 ? CELLS / 1024. : 1;
			g.face[d][0] = g.face[d][1] = PM_PERIODIC;
		}
		w->current = (struct pm_current){.grid = g, .kernel = pm_kernel_find("cic"), .dt = g.h[0], .hi = {CELLS, CELLS, CELLS}};
		snprintf(name, sizeof name, "p2m --current cic, %d-D", dim), run(w, name, "particle", POINTS, current);
	}
}

int main(void)
{
	static const char *const kernels[] = {"cic", "pcs", "m6prime"};
	struct work w = {.pp = {.dim = 3, .delta = 0.1, .mollifier = pm_mollifier_find("plummer")}};
	struct pm_grid g = {.dim = 3};
	char name[32];
	for (int d = 0; d < 3; d++)
		g.cells[d] = g.points[d] = CELLS, g.h[d] = 1, g.face[d][0] = g.face[d][1] = PM_PERIODIC;
	fill(&w);
	w.transfer.grid = g;
	w.mg = pm_mg_new(&g, 2);
	must(!w.mg);
	for (int k = 0; k < 3; k++) {
		w.transfer.kernel = pm_kernel_find(kernels[k]);
		snprintf(name, sizeof name, "p2m %s", kernels[k]), run(&w, name, "particle", POINTS, spread);
		snprintf(name, sizeof name, "m2p %s, vector", kernels[k]), run(&w, name, "particle", POINTS, gather);
	}
	for (enum pm_face face = PM_PERIODIC; face <= PM_WALL; face++)
		solve(&w, face);
	pm_mg_start(w.mg, w.rho, w.phi);
	run(&w, "poisson-mg V(2,2) 32^3", "point", POINTS, cycle);
	for (int order = 2; order < 5; order += 2) {
		must(pm_operator_init(&w.gradient, &g, PM_OP_GRAD, order, 1, false));
		snprintf(name, sizeof name, "mgrad order %d", order), run(&w, name, "point", POINTS, gradient);
	}
	run(&w, "pp full", "pair", (double)BODIES * BODIES, pairs);
	w.pp.half = true;
	run(&w, "pp half", "pair", (double)BODIES * BODIES, pairs);
	run(&w, "push kick/2 drift", "particle", POINTS, push);
	in_order(&w);
	for (int k = 0; k < 2; k++) {
		w.transfer.kernel = w.current.kernel = pm_kernel_find(k ? "tsc" : "cic");
		snprintf(name, sizeof name, "p2m --current %s", w.current.kernel->name), run(&w, name, "particle", POINTS, current);
	}
	for (int k = 0; k < 4; k++) {
		w.step = (const char *const[]){"relativistic", "boris", "vay", "higuera-cary"}[k];
		snprintf(name, sizeof name, "push %s/2", w.step), run(&w, name, "particle", POINTS, kick);
	}
	for (int k = 0; k < 2; k++) {
		w.transfer.kernel = pm_kernel_find(k ? "tsc" : "cic");
		snprintf(name, sizeof name, "m2p of E and B, %s", w.transfer.kernel->name), run(&w, name, "particle", POINTS, light);
	}
	for (int d = 0; d < 3; d++) /* 64 particles a cell */
		g.cells[d] = g.points[d] = CELLS / 4, g.h[d] = 4;
	w.transfer.grid = g;
	for (int k = 0; k < 2; k++) {
		w.transfer.kernel = pm_kernel_find(k ? "tsc" : "cic"), w.transfer.lower = pm_kernel_lower(w.transfer.kernel);
		snprintf(name, sizeof name, "m2p --energy-conserving, %s", w.transfer.kernel->name), run(&w, name, "particle", POINTS, light);
	}
	on_a_line(&w);
	by_cells(&w);
	return 0;
}
