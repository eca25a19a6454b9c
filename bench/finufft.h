/* FINUFFT's spreading and interpolation alone, without its transforms, through the functions of a library found at run time; nothing of it is needed
 * to build. Complex values of which we use the real part. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_BENCH_FINUFFT_H
#define PM_BENCH_FINUFFT_H

#include <complex.h>
#include <dlfcn.h>

#include "bench.h"

/* The first options are ints, whose places have been the same since 2.4: 1 spreads or interpolates only, 5 threads, 7 sorts. */
enum { FINUFFT_ONLY = 1, FINUFFT_WARN = 4, FINUFFT_THREADS = 5, FINUFFT_OPTIONS = 256 };

struct finufft {
	void *library;
	int (*make)(int type, int dim, const int64_t *cells, int sign, int many, double tolerance, void **plan, int *options);
	int (*points)(void *plan, int64_t n, double *x, double *y, double *z, int64_t m, double *s, double *t, double *u);
	int (*execute)(void *plan, double complex *c, double complex *mesh);
	int (*destroy)(void *plan);
	void (*defaults)(int *options);
	void *plan;
	size_t n;
	int64_t cells;
	int type, dim;
	double *x[3];         /* in [-pi, pi) */
	double complex *c, *mesh;
};

/* False, with a message, if it is not installed. */
static inline bool finufft_open(struct finufft *f)
{
	const char *file = getenv("PM_FINUFFT");
	memset(f, 0, sizeof *f);
	f->library = dlopen(file ? file : "libfinufft.so", RTLD_NOW | RTLD_LOCAL);
	if (!f->library) {
		fprintf(stderr, "bench: skipped FINUFFT (no libfinufft.so; PM_FINUFFT names another place)\n");
		return false;
	}
	*(void **)&f->make = dlsym(f->library, "finufft_makeplan"), *(void **)&f->points = dlsym(f->library, "finufft_setpts");
	*(void **)&f->execute = dlsym(f->library, "finufft_execute"), *(void **)&f->destroy = dlsym(f->library, "finufft_destroy");
	*(void **)&f->defaults = dlsym(f->library, "finufft_default_opts");
	int options[FINUFFT_OPTIONS];
	if (f->defaults)
		f->defaults(options);
	if (!f->make || !f->points || !f->execute || !f->destroy || !f->defaults || options[FINUFFT_ONLY] || options[FINUFFT_WARN] != 1 ||
		options[FINUFFT_THREADS])
		return fprintf(stderr, "bench: skipped FINUFFT (its options are not those of version 2.4 and later)\n"), false;
	return true;
}

/* Particles at x[d][p] in [0, cells). */
static inline void finufft_fill(struct finufft *f, int dim, size_t cells, size_t n, double *const x[])
{
	size_t points = 1;
	f->n = n, f->dim = dim, f->cells = (int64_t)cells;
	for (int d = 0; d < dim; d++) {
		points *= cells;
		f->x[d] = pm_alloc(n, sizeof(double));
		for (size_t p = 0; p < n; p++)
			f->x[d][p] = 2 * pm_pi * (x[d][p] / (double)cells - 0.5);
	}
	f->c = pm_alloc(n, sizeof *f->c), f->mesh = pm_zalloc(points, sizeof *f->mesh);
	for (size_t p = 0; p < n; p++)
		f->c[p] = 1;
}

/* Tolerance 10^(1-width) makes kernels of that width. */
static inline bool finufft_plan(struct finufft *f, int type, int width)
{
	int options[FINUFFT_OPTIONS];
	int64_t cells[3] = {f->cells, f->cells, f->cells};
	f->defaults(options);
	options[FINUFFT_ONLY] = 1, options[FINUFFT_THREADS] = pm_threads(), options[FINUFFT_WARN] = 0;
	f->type = type;
	int status = f->make(type, f->dim, cells, 1, 1, pow(10, 1 - width), &f->plan, options);
	if (status > 1)
		fprintf(stderr, "bench: FINUFFT refuses width %d (%d)\n", width, status);
	return status <= 1;
}

/* Sorting is in setpts. */
static inline void finufft_run(void *with)
{
	struct finufft *f = with;
	if (f->points(f->plan, (int64_t)f->n, f->x[0], f->x[1], f->x[2], 0, NULL, NULL, NULL) > 1 || f->execute(f->plan, f->c, f->mesh) > 1)
		exit(1);
}

static inline void finufft_release(struct finufft *f)
{
	for (int d = 0; d < 3; d++)
		pm_free(f->x[d]);
	pm_free(f->c), pm_free(f->mesh);
}

#endif
