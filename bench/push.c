/* push (a half kick and a drift) and the bulk sums of diag, as a fraction of the bandwidth of a plain loop of the same kind in the same rounds.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "bandwidth.h"

#include "measure/measure.h"
#include "push/state-advance.h"

enum { N = 4 << 20 };

struct particles {
	double *x[3], *v[3], *a[3], *mass;
};

static void push(void *with)
{
	struct particles *p = with;
	struct pm_advance a = {.actions = 2};
	struct pm_bounds box = {.lo = 0, .hi = 1, .fold = true};
	a.action[0].step = pm_step_find("kick"), a.action[0].dt = 1e-9;
	a.action[1].step = pm_step_find("drift"), a.action[1].dt = 1e-9;
	for (int d = 0; d < 3; d++) {
		struct pm_advanced lines[2] = {{.y = p->x[d], .k = p->v[d], .position = true}, {.y = p->v[d], .k = p->a[d]}};
		if (!pm_advance_axis(N, &a, 2, lines, p->x[d], NULL, &box, NULL))
			exit(1);
	}
}

static void bulk(void *with)
{
	struct particles *p = with;
	struct pm_measured b = {.n = N, .dim = 3, .vdim = 3, .x = {p->x[0], p->x[1], p->x[2]}, .v = {p->v[0], p->v[1], p->v[2]}, .mass = p->mass};
	struct pm_particle_sums sums = {0};
	pm_particle_sums_add(&b, &sums);
	if (!(sums.mass > 0))
		exit(1);
}

static void measure(struct particles *p, struct bandwidth_arrays w[2])
{
	struct bench_job jobs[] = {{bandwidth_pass, &w[0], {0}}, {bandwidth_pass, &w[1], {0}}, {push, p, {0}}, {bulk, p, {0}}};
	bench_turns(4, jobs);
	bandwidth_row("push", "kick/2 drift", 120, 12, N, &jobs[2], &w[0], &jobs[0]);
	bandwidth_row("diag", "bulk sums", 56, 140, N, &jobs[3], &w[1], &jobs[1]);
}

int main(void)
{
	struct particles p = {.mass = pm_alloc(N, sizeof(double))};
	struct bandwidth_arrays w[2] = {bandwidth_new(8 << 20)};
	int most = pm_threads();
	for (int d = 0; d < 3; d++)
		p.x[d] = pm_alloc(N, sizeof(double)), p.v[d] = pm_alloc(N, sizeof(double)), p.a[d] = pm_alloc(N, sizeof(double));
	for (size_t i = 0; i < N; i++)
		for (int d = 0; d < 3; d++)
			p.x[d][i] = (double)(i % 1021) / 1021, p.v[d][i] = (double)(i % 31) - 15, p.a[d][i] = (double)(i % 7) - 3, p.mass[i] = 1;
	w[1] = w[0];
	w[0].way = BANDWIDTH_TRIAD_NT, w[1].way = BANDWIDTH_READ;
	pm_threads_use(1);
	measure(&p, w);
	if (most > 1) {
		pm_threads_use(most);
		measure(&p, w);
	}
	return 0;
}
