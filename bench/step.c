/* A whole step of a particle-mesh sentence, fused as in cycle, compared with the sum of its kernels measured alone on the same particles, in turn. Reads one
 * frame:
 * pinit uniform -n N --cells C | step. SPDX-License-Identifier: GPL-3.0-or-later */
#include "law/law.h"
#include "mesh/gradient.h"
#include "transfer/transfer.h"
#include "poisson-fft/poisson-fft.h"
#include "sentence/sentence.h"
#include "stream/wire.h"

#include "push/state-advance.h"

#include "bench.h"

struct step {
	struct pm_sentence *words;
	struct pm_frame *frame;
	size_t n;
	struct pm_transfer spread, gather;
	struct pm_poisson_fft *solver;
	struct pm_operator gradient;
	double *x[3], *v[3], *a[3], *q, *rho, *phi, *g[3];
};

static void whole(void *with)
{
	struct step *s = with;
	if (pm_sentence_pass(s->words, &s->frame)) {
		fprintf(stderr, "step: %s\n", pm_message());
		exit(1);
	}
}

static void check(int status)
{
	if (status)
		exit(1);
}

static void p2m(void *with)
{
	struct step *s = with;
	struct pm_strays strays;
	memset(s->rho, 0, pm_grid_size(&s->spread.grid) * sizeof(double));
	check(pm_spread(&s->spread, s->n, (const double *const *)s->x, (const double *const *)&s->q, &s->rho, &strays));
}

static void poisson(void *with)
{
	struct step *s = with;
	check(pm_poisson_fft_solve(s->solver, 1e-9, s->rho, s->phi, NULL));
}

static void mgrad(void *with)
{
	struct step *s = with;
	bool seen;
	check(pm_operator_apply(&s->gradient, -1, (const double *const *)&s->phi, s->g, &seen));
}

static void m2p(void *with)
{
	struct step *s = with;
	struct pm_strays strays;
	check(pm_gather(&s->gather, s->n, (const double *const *)s->x, (const double *const *)s->g, NULL, s->a, &strays));
}

/* The closing half kick of one step, and the opening half kick and the drift of the next. */
static void push(void *with)
{
	struct step *s = with;
	struct pm_advance open = {.actions = 2}, close = {.actions = 1};
	open.action[0].step = close.action[0].step = pm_step_find("kick"), open.action[1].step = pm_step_find("drift");
	for (int d = 0; d < 3; d++) {
		struct pm_bounds box = {.lo = s->frame->lo[d], .hi = s->frame->hi[d], .fold = true};
		struct pm_advanced lines[2] = {{.y = s->x[d], .k = s->v[d], .position = true}, {.y = s->v[d], .k = s->a[d]}};
		pm_advance_axis(s->n, &open, 2, lines, s->x[d], NULL, &box, NULL);
		pm_advance_axis(s->n, &close, 1, lines + 1, NULL, NULL, NULL, NULL);
	}
}

static double *values(size_t n)
{
	double *p = pm_zalloc(n, sizeof *p);
	check(!p);
	return p;
}

static void prepare(struct step *s)
{
	const struct pm_field *x = pm_frame_field(s->frame, "matter", "x");
	struct pm_grid g = pm_grid_of(s->frame, pm_frame_mesh(s->frame, NULL));
	s->n = pm_frame_set(s->frame, "matter")->n;
	s->spread = s->gather = (struct pm_transfer){.grid = g, .kernel = pm_kernel_find("cic"), .components = 1};
	s->gather.components = 3;
	s->gather.set[0] = s->gather.set[1] = s->gather.set[2] = true;
	s->solver = pm_poisson_fft_new(&g, &(struct pm_poisson_fft_choice){.symbol = PM_SPECTRAL});
	check(!s->solver || pm_operator_init(&s->gradient, &g, PM_OP_GRAD, 2, 1, false));
	for (int d = 0; d < 3; d++) {
		s->x[d] = values(s->n), s->v[d] = values(s->n), s->a[d] = values(s->n), s->g[d] = values(pm_grid_size(&g));
		memcpy(s->x[d], pm_in(x, d), s->n * sizeof(double));
	}
	s->q = values(s->n), s->rho = values(pm_grid_size(&g)), s->phi = values(pm_grid_size(&g));
	for (size_t p = 0; p < s->n; p++)
		s->q[p] = 1 / (double)s->n;
}

int main(void)
{
	struct step s = {0};
	struct pm_reader *in = pm_reader_open(NULL);
	if (!in || pm_read_frame(in, &s.frame) != PM_GOT_FRAME)
		return fprintf(stderr, "step: %s\n", pm_message()), 1;
	s.words = pm_sentence_new("push kick/2 drift | p2m --kernel cic | poisson-fft | mgrad --order 2 | m2p | push kick/2", true, &(struct pm_list){0});
	if (!s.words || pm_sentence_prime(s.words, &s.frame))
		return fprintf(stderr, "step: %s\n", pm_message()), 1;
	prepare(&s);
	struct bench_job jobs[] = {{whole, &s, {0}}, {p2m, &s, {0}}, {poisson, &s, {0}}, {mgrad, &s, {0}}, {m2p, &s, {0}}, {push, &s, {0}}};
	bench_turns(6, jobs);
	static const char *const names[] = {"whole step", "p2m alone", "poisson-fft alone", "mgrad alone", "m2p alone", "push alone"};
	double quotient[BENCH_ROUNDS], sum = 0;
	for (int r = 0; r < BENCH_ROUNDS; r++) {
		double alone = 0;
		for (int k = 1; k < 6; k++)
			alone += jobs[k].seconds[r];
		quotient[r] = jobs[0].seconds[r] / alone, sum += alone / BENCH_ROUNDS;
	}
	char name[64];
	for (int k = 0; k < 6; k++) {
		snprintf(name, sizeof name, "%s, %zu^3, %.2g particles", names[k], s.spread.grid.cells[0], (double)s.n);
		struct bench_row row = {.kernel = "step", .name = name, .unit = "M particles/s", .per = 1e6};
		if (!k)
			row.against = "time of its kernels", row.other = (double)s.n / sum / 1e6, row.ratio = bench_middle(quotient).median, row.most = 1.2;
		bench_rate(row, (double)s.n, &jobs[k]);
	}
	return 0;
}
