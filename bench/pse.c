/* Particle strength exchange in millions of partners per second (those within the cut-off, either way): a lattice and particles at random in the plane and in
 * space, beside all pairs of particles that see each other, where the cell list costs nothing. SPDX-License-Identifier: GPL-3.0-or-later */
#include "near/pse.h"

#include "bench.h"

enum { SEEN = 4096 };

struct bodies {
	struct pm_pse how;
	struct pm_domain domain;
	size_t n;
	double *x[3], *volume, *strength, *rate, spacing;
	double partners; /* in all */
};

static void exchange(void *with)
{
	struct bodies *b = with;
	struct pm_cell_list l;
	struct pm_pse_found found;
	if (pm_cell_list_init(&l, &b->domain, b->n, (const double *const *)b->x, b->how.reach, 2 * b->spacing) ||
		pm_pse_add(&b->how, &l, 1, b->volume, b->strength, b->rate, &found))
		exit(1);
	pm_cell_list_free(&l);
}

/* All partners, from those of a sample of particles. */
static double partners(const struct bodies *b)
{
	double seen = 0;
	enum { SAMPLE = 64 };
	for (size_t s = 0; s < SAMPLE; s++) {
		size_t p = b->n / SAMPLE * s;
		for (size_t q = 0; q < b->n; q++) {
			double r2 = 0;
			for (int d = 0; d < b->domain.dim; d++) {
				double z = b->x[d][p] - b->x[d][q];
				z -= b->domain.face[d][0] == PM_PERIODIC ? floor(z + 0.5) : 0;
				r2 += z * z;
			}
			seen += r2 <= b->how.reach * b->how.reach;
		}
	}
	return seen / SAMPLE * (double)b->n;
}

static struct bodies bodies(int dim, size_t side, bool random, int order)
{
	struct bodies b = {.domain = {.dim = dim, .hi = {1, 1, 1}}, .n = dim == 2 ? side * side : side * side * side, .spacing = 1 / (double)side};
	b.how = pm_pse_of(dim, order, b.spacing, pm_pse_cutoff(order));
	b.volume = pm_alloc(b.n, sizeof(double)), b.strength = pm_alloc(b.n, sizeof(double)), b.rate = pm_zalloc(b.n, sizeof(double));
	for (int d = 0; d < dim; d++) {
		b.domain.face[d][0] = b.domain.face[d][1] = PM_PERIODIC;
		b.x[d] = pm_alloc(b.n, sizeof(double));
	}
	for (size_t i = 0; i < b.n; i++) {
		size_t at = i;
		for (int d = 0; d < dim; d++, at /= side) {
			double u[2];
			pm_random(1, i, (uint64_t)d, u);
			b.x[d][i] = random ? u[0] : (double)(at % side) / (double)side;
		}
		b.volume[i] = 1 / (double)b.n, b.strength[i] = sin((double)i);
	}
	b.partners = partners(&b);
	return b;
}

int main(void)
{
	static const char *const names[] = {"all pairs", "a lattice, 2-D", "at random, 2-D", "a lattice, 3-D", "at random, 3-D", "a lattice, 3-D, order 4"};
	struct bodies b[] = {bodies(3, 16, true, 2), bodies(2, 256, false, 2), bodies(2, 256, true, 2), bodies(3, 40, false, 2), bodies(3, 40, true, 2),
		bodies(3, 40, false, 4)};
	struct bench_job jobs[6];
	b[0].how = pm_pse_of(3, 2, 1, 8), b[0].partners = (double)SEEN * SEEN;
	for (int d = 0; d < 3; d++)
		b[0].domain.face[d][0] = b[0].domain.face[d][1] = PM_OPEN;
	for (int most = pm_threads(), t = 1; t <= most; t += most > 1 ? most - 1 : 1) {
		pm_threads_use(t);
		for (int i = 0; i < 6; i++)
			jobs[i] = (struct bench_job){.run = exchange, .with = b + i};
		bench_turns(6, jobs);
		for (int i = 0; i < 6; i++) {
			/* Multiplications: 23 instructions for 8 pairs, which are 16 partners, two flops each. */
			struct bench_row row = {.kernel = "pse", .name = names[i], .unit = "Mneighbour/s", .per = 1e6, .flops = 23};
			if (i)
				row.against = names[0], row.other = b[0].partners / bench_median(&jobs[0]) / row.per, row.ratio = NAN;
			bench_rate(row, b[i].partners, &jobs[i]);
		}
	}
	return 0;
}
