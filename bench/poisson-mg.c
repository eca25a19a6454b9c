/* Multigrid with walls: a red-black sweep, a solve to 1e-10 and one pass of full multigrid in million points or unknowns per second, the residual at which
 * round-off stops it; hypre's conjugate gradients with its multigrid for comparison if its library is found. poisson-mg [cells per axis ...]
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-hierarchy.h"

#include "hypre.h"

struct problem {
	size_t cells, points;
	struct pm_mg *mg;
	struct pm_mg_choice choice;
	double *s, *phi;
	struct pm_mg_record record;
	struct hypre hypre;
};

static void sweep(void *with)
{
	struct problem *p = with;
	pm_mg_sweep(p->mg, 0, 1, 2, (enum mg_stage[]){MG_RED, MG_BLACK});
}

static void solve(void *with)
{
	struct problem *p = with;
	if (pm_mg_solve(p->mg, &p->choice, 1, p->s, p->phi, &p->record)) {
		fprintf(stderr, "poisson-mg: %s\n", pm_message());
		exit(1);
	}
}

static void peer(void *with)
{
	struct problem *p = with;
	hypre_solve(&p->hypre);
}

static struct problem problem_new(size_t n)
{
	struct problem p = {.cells = n, .points = (n + 1) * (n + 1) * (n + 1)};
	struct pm_grid g = {.dim = 3, .cells = {n, n, n}, .points = {n + 1, n + 1, n + 1}};
	for (int d = 0; d < 3; d++)
		g.h[d] = 1 / (double)n, g.face[d][0] = g.face[d][1] = PM_WALL;
	p.mg = pm_mg_new(&g, 2);
	p.s = pm_zalloc(p.points, sizeof(double)), p.phi = pm_zalloc(p.points, sizeof(double));
	for (size_t i = 0; i < p.points; i++) {
		double u[2];
		pm_random(1, i, 0, u);
		p.s[i] = u[0] - 0.5;
	}
	if (!p.mg || !p.s || !p.phi)
		exit(1);
	return p;
}

static void rows(struct problem *p, const struct problem *fmg, const struct bench_job jobs[4], bool hypre)
{
	const double inner = pow((double)p->cells - 1, 3);
	char name[64];
	/* u read, f read, u written; 8 additions and a multiplication */
	snprintf(name, sizeof name, "red-black sweep %zu", p->cells);
	bench_rate((struct bench_row){.kernel = "poisson-mg", .name = name, .unit = "M points/s", .per = 1e6, .bytes = 24, .flops = 9, .stream = "triad-nt",
		.against = "our sketch", .other = p->cells > 200 ? 709 : 920, .recorded = true, .least = 1}, inner, &jobs[0]);
	/* a V(2,2) cycle: four sweeps, a residual and a correction, 8/7 for the coarser grids */
	snprintf(name, sizeof name, "to 1e-10, %zu, %d cycles", p->cells, p->record.cycles);
	bench_against((struct bench_row){.kernel = "poisson-mg", .name = name, .unit = "M unknowns/s", .per = 1e6,
		.bytes = 8. / 7 * 144 * (p->record.cycles + 1),
		.flops = 8. / 7 * 60 * (p->record.cycles + 1), .stream = "triad-nt", .least = 8}, inner, &jobs[1], "hypre PCG-PFMG", hypre ? &jobs[3] : NULL,
		p->cells > 200 ? 2.9 : 3.3);
	snprintf(name, sizeof name, "full multigrid, %zu, residual %.1e", p->cells, fmg->record.after);
	bench_against((struct bench_row){.kernel = "poisson-mg", .name = name, .unit = "M unknowns/s", .per = 1e6, .bytes = 8. / 7 * 96, .flops = 8. / 7 * 40,
		.stream = "triad-nt", .least = 3}, inner, &jobs[2], "HPGMG 7pt", NULL, p->cells > 200 ? 24.6 : 27.6);
}

static void measure(size_t n)
{
	struct problem p = problem_new(n), fmg = p;
	p.choice = (struct pm_mg_choice){.pre = 2, .post = 2, .cycle = PM_MG_FMG, .smoother = PM_MG_SOR, .relaxation = 1.15, .tolerance = 1e-10, .most = 50};
	fmg.choice = (struct pm_mg_choice){.pre = 1, .post = 1, .cycle = PM_MG_FMG, .relaxation = 1, .tolerance = 0.9, .most = 50};
	bool hypre = n <= 128 && pm_threads() == 1 && hypre_new(&p.hypre, n, p.s);
	struct bench_job jobs[] = {{sweep, &p, {0}}, {solve, &p, {0}}, {solve, &fmg, {0}}, {peer, &p, {0}}};
	bench_turns(hypre ? 4 : 3, jobs);
	rows(&p, &fmg, jobs, hypre);
	p.choice.tolerance = 0;
	solve(&p);
	printf("poisson-mg\tresidual floor %zu\t%d\t%.2e\trelative\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\n", n, pm_threads(), p.record.after);
	if (hypre)
		hypre_free(&p.hypre);
	pm_mg_free(p.mg), pm_free(p.s), pm_free(p.phi);
}

int main(int argc, char **argv)
{
	int most = pm_threads();
	for (int a = 0; a < (argc > 1 ? argc - 1 : 2); a++) {
		size_t n = argc > 1 ? strtoul(argv[a + 1], NULL, 10) : a ? 256 : 128;
		pm_threads_use(1);
		measure(n);
		if (most > 1) {
			pm_threads_use(most);
			measure(n);
		}
	}
	return 0;
}
