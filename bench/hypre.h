/* hypre's PFMG as preconditioner of its conjugate gradients for the 7-point equations with walls, through the functions of a library found at run
 * time; nothing of it is needed to build. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_BENCH_HYPRE_H
#define PM_BENCH_HYPRE_H

#include <dlfcn.h>

#include "bench.h"

struct hypre {
	void *library, *comm, *grid, *stencil, *matrix, *b, *x, *solver, *precondition;
	size_t inner;
	double *zero;
	int lo[3], hi[3];
};

/* Functions are looked up by name without a prototype; all arguments except those of two setters are pointers and ints. */
#pragma GCC diagnostic ignored "-Wstrict-prototypes"
#define HYPRE_CALL(h, name, ...) (((int (*)())hypre_function((h)->library, name))(__VA_ARGS__))

static inline void (*hypre_function(void *library, const char *name))(void)
{
	void (*f)(void);
	*(void **)&f = dlsym(library, name);
	if (!f) {
		fprintf(stderr, "bench: the library of hypre has no %s\n", name);
		exit(1);
	}
	return f;
}

/* The values of the matrix: -lap times h^2, without the couplings across a wall; entries centre, -x, -y, -z (symmetric). */
static inline void hypre_matrix(struct hypre *h)
{
	static int offsets[4][3] = {{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, entries[4] = {0, 1, 2, 3};
	const size_t n = h->inner;
	double *values = pm_zalloc(n * n * n, 4 * sizeof(double));
	HYPRE_CALL(h, "HYPRE_StructStencilCreate", 3, 4, &h->stencil);
	for (int e = 0; e < 4; e++)
		HYPRE_CALL(h, "HYPRE_StructStencilSetElement", h->stencil, e, offsets[e]);
	HYPRE_CALL(h, "HYPRE_StructMatrixCreate", h->comm, h->grid, h->stencil, &h->matrix);
	HYPRE_CALL(h, "HYPRE_StructMatrixSetSymmetric", h->matrix, 1);
	HYPRE_CALL(h, "HYPRE_StructMatrixInitialize", h->matrix);
	for (size_t i = 0; i < n * n * n; i++) {
		values[4 * i] = 6;
		values[4 * i + 1] = i % n ? -1 : 0;
		values[4 * i + 2] = i / n % n ? -1 : 0;
		values[4 * i + 3] = i / (n * n) ? -1 : 0;
	}
	HYPRE_CALL(h, "HYPRE_StructMatrixSetBoxValues", h->matrix, h->lo, h->hi, 4, entries, values);
	HYPRE_CALL(h, "HYPRE_StructMatrixAssemble", h->matrix);
	pm_free(values);
}

static inline void *hypre_vector(struct hypre *h, double *values)
{
	void *v;
	HYPRE_CALL(h, "HYPRE_StructVectorCreate", h->comm, h->grid, &v);
	HYPRE_CALL(h, "HYPRE_StructVectorInitialize", v);
	HYPRE_CALL(h, "HYPRE_StructVectorSetBoxValues", v, h->lo, h->hi, values);
	HYPRE_CALL(h, "HYPRE_StructVectorAssemble", v);
	return v;
}

static inline void hypre_solver(struct hypre *h)
{
	HYPRE_CALL(h, "HYPRE_StructPCGCreate", h->comm, &h->solver);
	((int (*)(void *, double))hypre_function(h->library, "HYPRE_StructPCGSetTol"))(h->solver, 1e-10);
	HYPRE_CALL(h, "HYPRE_StructPCGSetMaxIter", h->solver, 100);
	HYPRE_CALL(h, "HYPRE_StructPCGSetTwoNorm", h->solver, 1);
	HYPRE_CALL(h, "HYPRE_StructPFMGCreate", h->comm, &h->precondition);
	HYPRE_CALL(h, "HYPRE_StructPFMGSetMaxIter", h->precondition, 1);
	((int (*)(void *, double))hypre_function(h->library, "HYPRE_StructPFMGSetTol"))(h->precondition, 0);
	HYPRE_CALL(h, "HYPRE_StructPFMGSetZeroGuess", h->precondition);
	HYPRE_CALL(h, "HYPRE_StructPFMGSetRelaxType", h->precondition, 2); /* symmetric red-black Gauss-Seidel */
	HYPRE_CALL(h, "HYPRE_StructPCGSetPrecond", h->solver, hypre_function(h->library, "HYPRE_StructPFMGSolve"),
		hypre_function(h->library, "HYPRE_StructPFMGSetup"), h->precondition);
	HYPRE_CALL(h, "HYPRE_StructPCGSetup", h->solver, h->matrix, h->b, h->x);
}

/* False, with a message, if there is no hypre with Open MPI. s: [cells+1]^3, its inner nodes are used. */
static inline bool hypre_new(struct hypre *h, size_t cells, const double *s)
{
	const size_t n = cells - 1;
	*h = (struct hypre){.library = dlopen("libHYPRE.so", RTLD_NOW | RTLD_GLOBAL), .inner = n, .lo = {0, 0, 0}, .hi = {(int)n - 1, (int)n - 1, (int)n - 1}};
	int (*start)(int *, char ***) = NULL;
	if (h->library) {
		*(void **)&start = dlsym(RTLD_DEFAULT, "MPI_Init");
		h->comm = dlsym(RTLD_DEFAULT, "ompi_mpi_comm_world");
	}
	if (!h->library || !start || !h->comm) {
		fprintf(stderr, "bench: skipped hypre (%s)\n", h->library ? "it is not of Open MPI" : "no libHYPRE.so");
		return false;
	}
	double *f = pm_alloc(n * n * n, sizeof(double));
	h->zero = pm_zalloc(n * n * n, sizeof(double));
	for (size_t i = 0; i < n * n * n; i++)
		f[i] = s[((i / (n * n) + 1) * (n + 2) + i / n % n + 1) * (n + 2) + i % n + 1];
	start(NULL, NULL);
	HYPRE_CALL(h, "HYPRE_StructGridCreate", h->comm, 3, &h->grid);
	HYPRE_CALL(h, "HYPRE_StructGridSetExtents", h->grid, h->lo, h->hi);
	HYPRE_CALL(h, "HYPRE_StructGridAssemble", h->grid);
	hypre_matrix(h);
	h->b = hypre_vector(h, f), h->x = hypre_vector(h, h->zero);
	hypre_solver(h);
	pm_free(f);
	return true;
}

static inline void hypre_solve(struct hypre *h)
{
	HYPRE_CALL(h, "HYPRE_StructVectorSetBoxValues", h->x, h->lo, h->hi, h->zero);
	HYPRE_CALL(h, "HYPRE_StructPCGSolve", h->solver, h->matrix, h->b, h->x);
}

static inline void hypre_free(struct hypre *h)
{
	HYPRE_CALL(h, "HYPRE_StructPCGDestroy", h->solver);
	HYPRE_CALL(h, "HYPRE_StructPFMGDestroy", h->precondition);
	pm_free(h->zero);
}

#endif
