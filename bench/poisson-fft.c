/* poisson-fft against FFTW's own measured r2c and c2r pair on the same cells, in turn, on one thread and on all (the pair is always serial: on several threads
 * the rows compare with one thread instead). bench/poisson-fft [cells per axis ...] SPDX-License-Identifier: GPL-3.0-or-later */
#include <fftw3.h>

#include "poisson-fft/poisson-fft.h"

#include "bench.h"

struct problem {
	struct pm_poisson_fft *solver;
	double *s, *phi;
};

struct pair {
	fftw_plan there, back;
	double *x, *w;
};

static struct pm_grid cube(size_t n, enum pm_face face)
{
	struct pm_grid g = {.dim = 3};
	for (int d = 0; d < 3; d++) {
		g.cells[d] = n, g.points[d] = n + (face != PM_PERIODIC), g.h[d] = 1;
		g.face[d][0] = g.face[d][1] = face;
	}
	return g;
}

static void solve(void *with)
{
	struct problem *p = with;
	if (pm_poisson_fft_solve(p->solver, 1, p->s, p->phi, NULL))
		exit(1);
}

static void transform(void *with)
{
	struct pair *p = with;
	fftw_execute(p->there), fftw_execute(p->back);
}

/* Three passes that read and write; walls move and transform as much, open faces eight times the points once of the three. */
static const double passes[] = {[PM_PERIODIC] = 3, [PM_WALL] = 3, [PM_OPEN] = 2 * 3 + 4};
static const double transforms[] = {[PM_PERIODIC] = 1, [PM_WALL] = 1, [PM_OPEN] = 14. / 3};

static struct bench_row row_of(size_t n, enum pm_face face, char name[64])
{
	snprintf(name, 64, "%s %zu", pm_face_names[face], n);
	return (struct bench_row){.kernel = "poisson-fft", .name = name, .unit = "M points/s", .per = 1e6, .bytes = 16 * passes[face],
		.flops = transforms[face] * 5 * log2(pow((double)n, 3)), .stream = "copy-nt"};
}

/* Time divided by the time of `other`. */
static void compare(struct bench_row row, double points, const struct bench_job *j, const char *other, const struct bench_job *with, double most)
{
	row.against = other, row.most = most;
	row.other = points / bench_median(with) / row.per, row.ratio = bench_faster(j, with);
	bench_rate(row, points, j);
}

static const enum pm_face faces[] = {PM_PERIODIC, PM_WALL, PM_OPEN};
enum { FACES = 3 };

static void measure(size_t n, struct problem problems[FACES], struct pair *pair)
{
	struct bench_job jobs[FACES + 1] = {{solve, &problems[0], {0}}, {solve, &problems[1], {0}}, {solve, &problems[2], {0}}, {transform, pair, {0}}};
	const double points = pow((double)n, 3);
	char name[64];
	bench_turns(FACES + 1, jobs);
	struct bench_row row = row_of(n, PM_PERIODIC, name);
	compare(row, points, &jobs[0], "time of FFTW's pair", &jobs[FACES], n < 128 ? 0 : n < 256 ? 0.8 : 0.5);
	row = row_of(n, PM_WALL, name);
	compare(row, points, &jobs[1], "time of periodic", &jobs[0], 2);
	row = row_of(n, PM_OPEN, name);
	compare(row, points, &jobs[2], "time of periodic", &jobs[0], 4);
	row = (struct bench_row){.kernel = "poisson-fft", .name = name, .unit = "M points/s", .per = 1e6};
	snprintf(name, sizeof name, "FFTW's r2c + c2r %zu", n);
	bench_rate(row, points, &jobs[FACES]);
}

/* Speed-up on all threads, by wall time. */
static void threads(size_t n, struct problem problems[FACES], int most)
{
	for (int f = 0; f < FACES; f++) {
		struct bench_job all = {solve, &problems[f], {0}};
		double quotient[BENCH_ROUNDS];
		char name[64];
		for (int r = -1; r < BENCH_ROUNDS; r++) {
			double began = pm_seconds();
			pm_threads_use(1), solve(&problems[f]);
			double one = pm_seconds() - began;
			pm_threads_use(most), solve(&problems[f]);
			if (r >= 0)
				all.seconds[r] = pm_seconds() - began - one, quotient[r] = one / all.seconds[r];
		}
		struct bench_row row = row_of(n, faces[f], name);
		row.against = "one thread", row.other = NAN, row.ratio = bench_middle(quotient).median, row.least = 0.925 * most;
		bench_rate(row, pow((double)n, 3), &all);
	}
}

int main(int argc, char **argv)
{
	static const size_t usual[] = {64, 128, 256};
	int most = pm_threads();
	for (int a = 0; a < (argc > 1 ? argc - 1 : 3); a++) {
		size_t n = argc > 1 ? strtoul(argv[a + 1], NULL, 10) : usual[a], points = (n + 1) * (n + 1) * (n + 1);
		struct problem problems[FACES] = {{.s = pm_zalloc(points, sizeof(double)), .phi = pm_zalloc(points, sizeof(double))}};
		struct pair pair = {.x = pm_zalloc(n * n * n, sizeof(double)), .w = pm_zalloc(n * n * (n + 2), sizeof(double))};
		pair.there = fftw_plan_dft_r2c_3d((int)n, (int)n, (int)n, pair.x, (fftw_complex *)pair.w, FFTW_MEASURE);
		pair.back = fftw_plan_dft_c2r_3d((int)n, (int)n, (int)n, (fftw_complex *)pair.w, pair.x, FFTW_MEASURE);
		for (size_t i = 0; i < points; i++)
			problems[0].s[i] = (double)(i % 17) - 8;
		for (int f = 0; f < FACES; f++) {
			struct pm_grid grid = cube(n, faces[f]);
			problems[f].s = problems[0].s, problems[f].phi = problems[0].phi;
			problems[f].solver = pm_poisson_fft_new(&grid, &(struct pm_poisson_fft_choice){.symbol = PM_SPECTRAL});
			if (!problems[f].solver) {
				fprintf(stderr, "poisson-fft: %s\n", pm_message());
				return 1;
			}
		}
		pm_threads_use(1);
		measure(n, problems, &pair);
		pm_threads_use(most);
		if (most > 1)
			threads(n, problems, most);
		for (int f = 0; f < FACES; f++)
			pm_poisson_fft_free(problems[f].solver);
		fftw_destroy_plan(pair.there), fftw_destroy_plan(pair.back);
		pm_free(problems[0].s), pm_free(problems[0].phi), pm_free(pair.x), pm_free(pair.w);
	}
	return 0;
}
