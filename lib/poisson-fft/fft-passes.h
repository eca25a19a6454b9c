/* The state of the transform solver and its passes over memory; private to lib/poisson-fft. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_FFT_FFT_PASSES_H
#define PM_POISSON_FFT_FFT_PASSES_H

#include "fft/axis-transform.h"
#include "fft/long-line.h"
#include "mesh/planes.h"
#include "poisson-fft/poisson-fft.h"

enum { L = PM_FFT_LINES, H = PM_FFT_LINES / 2, X = 0, Y = 1, Z = 2 };
enum shared { SHARED_FIRST, SHARED_NYQUIST, SHARED_BOTH };

struct pm_poisson_fft {
	struct pm_grid grid;
	struct pm_poisson_fft_choice choice;
	struct pm_fft_plans planner;
	bool complex, open;            /* every axis periodic or open: complex spectra of real rows; some face open */
	bool singular, empty;          /* empty: a wall axis without inner nodes */
	struct pm_transform line[3];        /* x along rows, y across a plane, z across planes; in 2-D y is trivial, z the mesh's second axis */
	size_t nodes[3], modes[3];     /* that take part; modes complex numbers or reals */
	size_t chunks;                 /* per row of modes: L reals, or H complex numbers as H real parts and H imaginary parts */
	bool shared;                   /* complex modes: frequencies 0 and N/2 along x, where rows have real spectra, share the first place of a row */
	char *holds;                   /* which of them is there (enum shared), for each row y of a plane of modes */
	size_t row;                    /* [doubles] stride of rows */
	double *w;                     /* [modes[Y]][zhere][row]: a pencil's slab is in one piece, a plane's rows are not */
	size_t slab;                   /* [doubles] from one of these slabs to the next */
	size_t planes, first;          /* of the mesh, those here and the number of the first one (mesh/planes.h) */
	size_t zhere, zfirst;          /* those that take part, nodes along z: all of them and 0, or those of this rank */
	uint64_t *from;                /* NULL, or the division of the planes among the ranks, ranks + 1 numbers, and behind it: */
	uint64_t *nodes_of, *units_of; /* the same for nodes along z, and for what pencils are dealt by: modes along y, in 2-D chunks */
	size_t *bytes;                 /* of the pieces that are sent to, and come from, every rank */
	double *lambda[3];             /* [1/length^2]: X per lane, padded with -1; Y per row of a plane of modes; Z per mode */
	double *green;                 /* open: transform of the Green's function over open axes (fft-open.c) */
	size_t green_row, green_slab;  /* [doubles] green[y][z][x], x in the order of the modes */
	size_t *fold, green_least;     /* open: of each row of a plane of modes (of this rank) the row y of green; the row z of the first mode */
	int threads;
	size_t block, rows, factors, lot; /* [doubles] of scratch per thread: a block; L rows of nodes; H factors a row; with a plane or slab of modes */
	double *scratch;
	bool streams;                  /* w is larger than the caches */
	bool turned;                   /* a complex mesh in space beyond them: w is [modes[Y]][chunks][nodes[Z]][L], and its pencils go to: */
	double *back;                  /* phi as [nodes[Z]][chunks][nodes[Y]][L], made the solution plane by plane; NULL, if it is open or phi not aligned: w */
	double distance;               /* with a wave: to the nearest eigenvalue, |lambda + a^2|/a^2 */
	bool single;                   /* a mesh that is one line of a suitable length: of what follows only these two are in use (fft-single.c) */
	struct pm_long_line across;
	double *nodes_of_line;         /* with images or zeros, as long as that line */
	struct pm_fft_james *james;    /* NULL, or the solution in open space by two between walls: nothing else here is then in use */
	double zero;                   /* the mode of constants, after the forward transform */
};

/* Where rows of nodes[X] values come from and go to: j, k count the nodes that take part. from may fill the buffer. */
struct rows {
	const struct pm_poisson_fft *p;
	const double *s;
	double *phi;
	const double *(*from)(const struct rows *r, size_t j, size_t k, double *buffer);
	double *(*to)(const struct rows *r, size_t j, size_t k);
};

/* The multipliers of a row along x: those of the modes, filled up to whole chunks. */
static inline size_t pm_poisson_fft_multipliers(const struct pm_poisson_fft *p)
{
	const size_t lanes = p->complex ? H : L;
	return (p->modes[X] + lanes - 1) / lanes * lanes;
}

/* Returns the largest absolute value: forward of the source, for a singular problem, back of the solution, INFINITY where one is not finite. */
double pm_poisson_fft_planes(const struct pm_poisson_fft *p, const struct rows *io, bool forward);
/* Forward along z, times factor/lambda or factor*green, and back. pencils: NULL, or those of this rank, of pm_poisson_fft_to_pencils. */
void pm_poisson_fft_pencils(struct pm_poisson_fft *p, double factor, double *pencils);
int pm_poisson_fft_work(struct pm_poisson_fft *p); /* w, if it is not there */

/* Of fft-ranks.c. The division of the work; is it the one of these planes? */
int pm_poisson_fft_ranks(struct pm_poisson_fft *p, const struct pm_planes *planes);
bool pm_poisson_fft_same_ranks(const struct pm_poisson_fft *p, const struct pm_planes *planes);
/* w to the pencils of this rank, and back (frees them). They take the caller's status and return the agreed one. */
int pm_poisson_fft_to_pencils(int status, struct pm_poisson_fft *p, double **pencils);
int pm_poisson_fft_to_planes(int status, struct pm_poisson_fft *p, double **pencils);
/* One unit of them, nodes[Z] rows of modes (in 2-D of L numbers), to a slab or back; and the mode of constants, which one rank has, to all. */
void pm_poisson_fft_unit(const struct pm_poisson_fft *p, size_t unit, double *pencils, double *slab, bool back);
int pm_poisson_fft_zero(int status, struct pm_poisson_fft *p);
/* On a line: that mode and the largest source of a singular problem, from the rank that has the line to all. */
int pm_poisson_fft_line_record(int status, struct pm_poisson_fft *p, double *largest);

/* Rows y of a plane of modes whose pencils are of this rank (in 2-D all). */
void pm_poisson_fft_rows_here(const struct pm_poisson_fft *p, size_t *first, size_t *end);

/* Eigenvalues of the modes of an axis by the row they are in, -1 beyond up to size; NULL with a message. */
double *pm_poisson_fft_eigenvalues(const struct pm_transform *l, size_t modes, size_t size, bool in_place, enum pm_symbol symbol, double h);
/* Of fft-open.c: fills green, with its strides; what cannot be done with a grid's open faces, 0 if there are none. */
int pm_poisson_fft_green(struct pm_poisson_fft *p);
int pm_poisson_fft_influence(struct pm_poisson_fft *p); /* of fft-influence.c: fills green for a periodic box */
int pm_poisson_fft_softened(struct pm_poisson_fft *p);  /* of fft-softened.c: the same from lambda, for walls */
int pm_poisson_fft_resonance(struct pm_poisson_fft *p); /* of fft-wave.c: failure at a resonance */
int pm_poisson_fft_fitted(struct pm_poisson_fft *p);    /* of fft-fitted.c: likewise, for known values on faces */
int pm_poisson_fft_open_check(const struct pm_grid *g, const struct pm_poisson_fft_choice *o);
/* The largest absolute value of n rows of a block. */
double pm_poisson_fft_largest(const double *block, size_t n);
/* Multipliers of a mesh in one dimension by mode, filled up to whole chunks. */
void pm_poisson_fft_multipliers_of_row(const struct pm_poisson_fft *p, double *u);
/* Of fft-single.c: the length of the line with its images, 0 where the solver is to take the passes; what is needed for it, the multipliers being there; and
 * its solution, which returns the largest source of a singular problem. */
size_t pm_fft_single_length(const struct pm_poisson_fft *p);
int pm_fft_single_init(struct pm_poisson_fft *p);
double pm_fft_single_solve(struct pm_poisson_fft *p, double factor, const double *s, double *phi);
/* Of fft-james.c: what cannot be solved so; NULL with a message, on all ranks that share the planes; as pm_poisson_fft_solve; the solver between walls. */
int pm_fft_james_check(const struct pm_grid *g, const struct pm_poisson_fft_choice *o);
struct pm_fft_james *pm_fft_james_new(const struct pm_grid *g, const struct pm_planes *planes);
struct pm_fft_james *pm_fft_james_free(struct pm_fft_james *j);
int pm_fft_james_solve(struct pm_fft_james *j, double c, const double *s, double *phi);
const struct pm_poisson_fft *pm_fft_james_walled(const struct pm_fft_james *j);

#endif
