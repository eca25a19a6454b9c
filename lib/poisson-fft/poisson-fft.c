/* Poisson's equation lap phi - K^2 phi = c*s by fast transforms: phi^ = c s^ / (lambda - K^2), lambda the sum over axes of the symbol of d2/dx2.
 * Faces, in any mixture: periodic (Fourier), wall (sine, phi = 0), neumann (cosine), a wall opposite a neumann face (quarter waves), open: the convolution
 * with a Green's function of the open axes on a domain of doubled length 2n, exact because the function is even (fft-open.c).
 * Source: Hockney and Eastwood 1988, chapters 6-5 and 6-6; Swarztrauber 1977. Symbols: -k^2, or those of the centred differences of order 2, 4, 6.
 * Three passes over memory (fft-passes.c), except for a single line (fft-single.c). Periodic and open: complex spectra of real rows; otherwise real transforms
 * (fft/axis-transform.h).
 * Determinism: a partition that does not depend on threads, no reductions. Cost: N log N; memory one copy of the mesh, open 4 in 3-D and one
 * for the Green's function.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "poisson-fft/fft-passes.h"
#include "world/world.h"

bool pm_poisson_fft_singular(const struct pm_grid *g, const struct pm_poisson_fft_choice *o)
{
	bool singular = o->screening == 0 && o->wave == 0;
	for (int d = 0; d < g->dim; d++)
		for (int side = 0; side < 2; side++)
			singular = singular && (g->face[d][side] == PM_PERIODIC || g->face[d][side] == PM_NEUMANN);
	return singular;
}

int pm_poisson_fft_check(const struct pm_grid *g, const struct pm_poisson_fft_choice *o)
{
	for (int d = 0; d < g->dim; d++)
		if (g->face[d][0] == PM_ABSORBING || g->face[d][1] == PM_ABSORBING)
			return pm_fail(PM_DATA, "absorbing faces belong to Maxwell's equations (Poisson's take periodic, wall, neumann or open faces)");
	int status = o->james ? pm_fft_james_check(g, o) : pm_influence_check(&o->influence, g);
	for (int a = 0; a < 2 * g->dim && o->wave > 0; a++)
		if (g->face[a / 2][a % 2] == PM_OPEN || o->screening > 0 || pm_influence_any(&o->influence) || o->green)
			return pm_fail(PM_DATA, "--wave-number is for standing waves in a box of periodic, wall and neumann faces, without --screening, "
				"--green and --influence (open faces radiate: a complex Green's function)");
	return status || o->james ? status : pm_poisson_fft_open_check(g, o);
}

static size_t row_offset(const struct pm_poisson_fft *p, size_t j, size_t k)
{
	const struct pm_grid *g = &p->grid;
	size_t y = p->line[Y].first + j, z = p->line[Z].first + k - p->first;
	return g->points[0] * (g->dim == 2 ? z : y + g->points[1] * z);
}

static const double *source_row(const struct rows *r, size_t j, size_t k, double *buffer)
{
	(void)buffer;
	return r->s + row_offset(r->p, j, k) + r->p->line[X].first;
}

static double *result_row(const struct rows *r, size_t j, size_t k)
{
	const struct pm_poisson_fft *p = r->p;
	double *phi = r->phi + row_offset(p, j, k);
	if (p->line[X].face[0] == PM_WALL)
		phi[0] = 0;
	if (p->line[X].face[1] == PM_WALL)
		phi[p->line[X].n] = 0;
	return phi + p->line[X].first;
}

/* Threads worth waking for the three passes of a solve. */
static int threads_for(const struct pm_poisson_fft *p)
{
	enum { few = 100000 };
	return p->modes[Y] * p->slab < few ? 1 : pm_threads();
}

static int scratch_ready(struct pm_poisson_fft *p)
{
	int n = threads_for(p);
	if (n <= p->threads)
		return p->threads = n, 0;
	p->scratch = pm_free(p->scratch);
	p->threads = 0;
	if (!(p->scratch = pm_alloc((size_t)n * p->lot, sizeof *p->scratch)))
		return -PM_DATA;
	p->threads = n;
	return 0;
}

/* The nodes on the wall faces that no row covers, of the planes here: rows of each plane, and the first and last plane (in 2-D row). */
static void zero_walls(const struct pm_poisson_fft *p, double *phi)
{
	const struct pm_grid *g = &p->grid;
	const int last = g->dim - 1;
	const size_t nx = g->points[0], ny = g->points[1], size = pm_grid_size(g) / g->points[last];
	for (int side = 0; side < 2 && last > 0; side++) {
		const size_t end = side ? g->points[last] - 1 : 0;
		for (size_t k = 0; k < p->planes && g->dim > 2 && g->face[1][side] == PM_WALL; k++)
			memset(phi + (k * ny + (side ? ny - 1 : 0)) * nx, 0, nx * sizeof *phi);
		if (g->face[last][side] == PM_WALL && end >= p->first && end - p->first < p->planes)
			memset(phi + (end - p->first) * size, 0, size * sizeof *phi);
	}
}

int pm_poisson_fft_work(struct pm_poisson_fft *p)
{
	return p->w || p->empty || p->single || (p->w = pm_zalloc(p->modes[Y] * p->slab + L, sizeof *p->w)) ? 0 : -PM_DATA;
}

/* Along z: here, or with the planes of the other ranks turned to pencils and back. */
static int along_z(int status, struct pm_poisson_fft *p, double factor)
{
	double *own = NULL;
	if (!p->from) {
		if (!status)
			pm_poisson_fft_pencils(p, factor, NULL);
		return status;
	}
	status = pm_poisson_fft_to_pencils(status, p, &own);
	if (!status)
		pm_poisson_fft_pencils(p, factor, own);
	status = pm_poisson_fft_to_planes(status, p, &own);
	return p->singular ? pm_poisson_fft_zero(status, p) : status;
}

static void record(const struct pm_poisson_fft *p, double norm, double largest, struct pm_poisson_fft_record *r)
{
	if (p->singular)
		r->mean = p->zero * norm, r->incompatible = largest > 0 ? fabs(p->zero * norm) / largest : 0;
}

int pm_poisson_fft_solve(struct pm_poisson_fft *p, double c, const double *s, double *phi, struct pm_poisson_fft_record *r)
{
	struct pm_poisson_fft_record none;
	r = r ? r : &none;
	*r = (struct pm_poisson_fft_record){.most = NAN};
	if (p->james)
		return pm_fft_james_solve(p->james, c, s, phi);
	if (p->empty) {
		r->most = 0;
		memset(phi, 0, pm_grid_size(&p->grid) / (p->grid.dim == 1 ? 1 : p->grid.points[p->grid.dim - 1]) * p->planes * sizeof *phi);
		return 0;
	}
	if (p->single) {
		const double one = 1 / (double)p->across.n;
		double most = p->planes ? pm_fft_single_solve(p, c * one, s, phi) : 0; /* of several ranks one has the line */
		const int status = pm_poisson_fft_line_record(0, p, &most);
		record(p, one, most, r);
		return status;
	}
	struct rows io = {.p = p, .s = s, .phi = phi, .from = source_row, .to = result_row};
	double norm = 1, largest = 0;
	for (int a = X; a <= Z; a++)
		norm /= (double)p->line[a].length;
	p->back = (uintptr_t)phi % 64 || p->open ? NULL : phi;
	int status = scratch_ready(p) || pm_poisson_fft_work(p) ? -PM_DATA : 0;
	if (!status)
		largest = pm_poisson_fft_planes(p, &io, true);
	if (p->from && p->singular)
		status = pm_world_largest(status, 1, &largest);
	status = along_z(status, p, c * norm);
	if (status)
		return status;
	r->most = pm_poisson_fft_planes(p, &io, false);
	zero_walls(p, phi);
	record(p, norm, largest, r);
	return 0;
}

/* Strides that are an odd number of blocks' rows, so that pencils do not fall on the same sets of the cache. */
static size_t odd_stride(size_t doubles)
{
	return ((doubles + L - 1) / L | 1) * L;
}

/* Row k of a plane of modes has frequency 0 along x in the shared place, row N-k frequency N/2. */
static int shares(struct pm_poisson_fft *p)
{
	const struct pm_transform *l = &p->line[Y];
	if (p->complex && !(p->holds = pm_zalloc(l->length, 1)))
		return -PM_DATA;
	for (size_t k = 0; k < l->length && p->shared; k++) {
		const size_t partner = pm_transform_partner(l, k);
		p->holds[l->fft->at[k]] = k == partner ? SHARED_BOTH : k < partner ? SHARED_FIRST : SHARED_NYQUIST;
	}
	return 0;
}

static int layout(struct pm_poisson_fft *p)
{
	const struct pm_grid *g = &p->grid;
	const int axis[3] = {0, g->dim == 3 ? 1 : -1, g->dim == 3 ? 2 : g->dim == 2 ? 1 : -1};
	size_t most = 0;
	for (int a = X; a <= Z; a++) {
		const enum pm_face none[2] = {PM_PERIODIC, PM_PERIODIC};
		bool used = axis[a] >= 0;
		if ((p->complex ? pm_transform_init : pm_transform_init_real)(&p->planner, used ? g->face[axis[a]] : none, used ? g->cells[axis[a]] : 1,
			&p->line[a]))
			return -PM_DATA;
		p->nodes[a] = p->line[a].count;
		p->modes[a] = !p->complex ? p->line[a].modes : a == X ? p->line[a].length / 2 + 1 : p->line[a].length;
		p->empty = p->empty || p->nodes[a] == 0;
		most = p->line[a].length > most ? p->line[a].length : most;
	}
	p->shared = p->complex && p->line[X].length % L == 0; /* one chunk less */
	p->chunks = p->complex ? (p->modes[X] - p->shared + H - 1) / H : (p->modes[X] + L - 1) / L;
	p->row = odd_stride(p->chunks * L);
	p->streams = p->modes[Y] * p->nodes[Z] * p->row > (size_t)1 << 20; /* 8 MiB */
	p->block = odd_stride((most + 1) * L);
	p->rows = odd_stride(p->nodes[X] * L);
	size_t slab = p->modes[Y] > p->nodes[Z] ? p->modes[Y] : p->nodes[Z];
	p->factors = odd_stride(p->line[Z].length * H);
	p->lot = p->block + p->rows + p->factors + (g->dim == 3 ? odd_stride((slab + L) * p->row) : p->choice.planes ? odd_stride((p->nodes[Z] + 1) * L) : 0);
	const int status = pm_poisson_fft_ranks(p, p->choice.planes);
	p->choice.planes = NULL; /* the caller's */
	p->single = pm_fft_single_length(p) > 0;
	p->turned = g->dim == 3 && p->shared && !p->from && p->modes[Y] * p->nodes[Z] * p->row > (size_t)1 << 18; /* 2 MiB */
	p->streams = p->streams && !p->turned;
	p->slab = p->zhere * p->row + (p->from ? 0 : L); /* so that a plane's rows do not fall on the same sets of the cache */
	return status || shares(p) ? -PM_DATA : pm_poisson_fft_work(p);
}

/* Of X, Y, Z; a line of fd2 is fitted (fft-fitted.c). */
static int fitted_axis(const struct pm_poisson_fft *p)
{
	const int d = (p->choice.fitted - 1) / 2;
	return d == 0 ? X : p->grid.dim == 2 || d == 2 ? Z : Y;
}

static int symbols(struct pm_poisson_fft *p)
{
	const double shift = p->choice.screening * p->choice.screening - p->choice.wave * p->choice.wave;
	const struct pm_grid *g = &p->grid;
	const double h[3] = {g->h[0], g->h[1], g->dim == 2 ? g->h[1] : g->h[2]};
	for (int a = X; a <= Z && !p->empty; a++) {
		size_t size = a == X ? pm_poisson_fft_multipliers(p) : p->modes[a];
		p->lambda[a] = pm_poisson_fft_eigenvalues(&p->line[a], p->modes[a], size, a == Y && p->complex,
			p->choice.fitted && a == fitted_axis(p) ? PM_FD2 : p->choice.symbol, h[a]);
		if (!p->lambda[a])
			return -PM_DATA;
	}
	for (size_t k = 0; k < p->modes[Z] && !p->empty; k++)
		p->lambda[Z][k] -= shift;
	return p->choice.wave > 0 && !p->empty && !p->choice.fitted ? pm_poisson_fft_resonance(p) : 0;
}

/* Ranks that share the mesh call it together. */
static int multipliers(struct pm_poisson_fft *p)
{
	const struct pm_poisson_fft_choice *o = &p->choice;
	bool soft = o->green && o->green->factor && o->softening > 0 && !p->empty;
	if (p->open && !p->empty)
		return pm_poisson_fft_green(p);
	if (pm_influence_any(&o->influence) || (soft && p->complex))
		return pm_poisson_fft_influence(p);
	int status = symbols(p);
	if (!status && o->fitted && !p->empty)
		return pm_poisson_fft_fitted(p);
	return status || !soft ? status : pm_poisson_fft_softened(p);
}

struct pm_poisson_fft *pm_poisson_fft_new(const struct pm_grid *g, const struct pm_poisson_fft_choice *o)
{
	if (pm_poisson_fft_check(g, o))
		return NULL;
	const bool divided = o->planes && o->planes->divided;
	struct pm_poisson_fft *p = calloc(1, sizeof *p);
	int status = p ? 0 : pm_no_memory();
	if (!p && divided)
		pm_world_agree(status);
	if (!p)
		return NULL;
	p->grid = *g;
	p->choice = *o;
	p->singular = pm_poisson_fft_singular(g, o);
	p->complex = true;
	for (int d = 0; d < g->dim; d++) {
		bool open[2] = {g->face[d][0] == PM_OPEN, g->face[d][1] == PM_OPEN};
		p->open = p->open || open[0] || open[1];
		p->complex = p->complex && (g->face[d][0] == PM_PERIODIC || (open[0] && open[1]));
	}
	status = !o->james ? layout(p) : (p->james = pm_fft_james_new(g, o->planes)) ? 0 : pm_failed();
	if (divided)
		status = pm_world_agree(status);
	if (!status && !o->james)
		status = multipliers(p);
	if (!status && p->single)
		status = pm_fft_single_init(p);
	if (divided && p->single)
		status = pm_world_agree(status);
	return status ? pm_poisson_fft_free(p) : p;
}

struct pm_poisson_fft *pm_poisson_fft_free(struct pm_poisson_fft *p)
{
	if (!p)
		return NULL;
	pm_fft_james_free(p->james);
	pm_long_line_free(&p->across), pm_free(p->nodes_of_line);
	pm_fft_plans_clear(&p->planner);
	free(p->from), free(p->bytes);
	pm_free(p->w);
	pm_free(p->green);
	pm_free(p->holds);
	pm_free(p->fold);
	pm_free(p->scratch);
	for (int a = X; a <= Z; a++)
		pm_free(p->lambda[a]);
	free(p);
	return NULL;
}

const struct pm_fft_plans *pm_poisson_fft_planner(const struct pm_poisson_fft *p)
{
	return &p->planner;
}
