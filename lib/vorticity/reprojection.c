/* Reprojection: lap chi = div omega, omega -= grad chi, which leaves the curl of a vector potential (the Helmholtz projection). omega is that of the
 * particles on the mesh; alpha -= volume grad chi at their positions: exact for particles on nodes and a kernel that interpolates.
 * Source: Cottet and Koumoutsakos 2000, section 3.3; Cocle, Winckelmans and Daeninck 2008, J. Comput. Phys. 227, 9091.
 * Differences of order 2, 4, 6 with the inverse of the spectral Laplacian leave the part 1 - k'^2/k^2 of a wave (k' its difference quotient), large for waves
 * near the grid's own; each further pass takes as much of what is left (defect correction).
 * Keeps the total of omega in periodic boxes to round-off. Beyond a wall chi has an odd image, as the tangential components of omega have.
 * Cost: a spread, a gather, one solution and four derivatives. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "fft/axis-transform.h"
#include "stream/declare.h"
#include "vorticity/reprojection.h"

static bool open(const struct pm_grid *g)
{
	bool any = false;
	for (int k = 0; k < 2 * g->dim; k++)
		any |= g->face[k / 2][k % 2] == PM_OPEN;
	return any;
}

int pm_reprojection_declare(const struct pm_reprojection_choice *c, struct pm_frame *f, struct pm_reprojection *r)
{
	*r = (struct pm_reprojection){.law = pm_law_of(f), .mesh = pm_frame_mesh(f, c->mesh), .above = c->above, .passes = c->passes};
	if (!r->law)
		return -PM_DATA;
	if (!r->law->vector)
		return pm_fail(PM_DATA, "the law '%s' has no vorticity in space (the law vortex in 3-D has)", f->law);
	if (!r->mesh)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", c->mesh ? " " : "", c->mesh ? c->mesh : "");
	const struct pm_grid g = pm_grid_of(f, r->mesh);
	const int order = pm_order_find(c->order ? c->order : open(&g) ? "6" : "spectral");
	r->kernel = pm_kernel_choose(c->kernel, NULL, r->law, "m4prime");
	int status = !r->kernel || order < 0 ? -PM_USAGE : pm_operator_init(&r->div, &g, PM_OP_DIV, order, 3, false);
	status = status ? status : pm_operator_init(&r->grad, &g, PM_OP_GRAD, order, 1, false);
	status = status ? status : pm_poisson_fft_check(&g, &r->solver);
	status = status ? status : pm_sets_choose(f, NULL, (const char *const[]){"x", r->law->strength, "volume", NULL}, "remesh gives volumes", &r->sets);
	for (size_t i = 0; i < r->sets.n && !status; i++) {
		const char *set = r->sets.name[i];
		status = pm_reads_positions(f, set);
		if (!status && !(pm_reads(f, set, "volume") && pm_changes(f, set, r->law->strength)))
			status = -PM_DATA;
		if (!status)
			pm_drops_roles(f, set, 1u << PM_CHANGE | 1u << PM_DERIVED);
	}
	if (!status)
		pm_drops_roles(f, NULL, 1u << PM_CHANGE | 1u << PM_DERIVED);
	return status;
}

static struct pm_transfer transfer_of(const struct pm_reprojection *r, const struct pm_grid *g)
{
	struct pm_transfer t = {.grid = *g, .kernel = r->kernel, .components = 3};
	for (int c = 0; c < 3; c++)
		t.flip[c][c] = 1;
	return t;
}

static int spread(const struct pm_reprojection *r, const struct pm_frame *f, const struct pm_grid *g, double *const omega[3])
{
	const struct pm_transfer t = transfer_of(r, g);
	int status = 0;
	for (size_t i = 0; i < r->sets.n && !status; i++) {
		const char *set = r->sets.name[i];
		const struct pm_field *alpha = pm_frame_field(f, set, r->law->strength);
		const double *x[3], *const q[3] = {pm_in(alpha, 0), pm_in(alpha, 1), pm_in(alpha, 2)};
		struct pm_strays strays = {.count = 0};
		pm_positions(f, set, x);
		status = pm_spread(&t, alpha->count, x, q, omega, &strays);
		if (!status && strays.count)
			status = pm_strays_refuse(&strays, set, r->mesh, &t, "a larger box, or remesh before it");
	}
	return status;
}

/* alpha -= volume grad chi */
static int gather(const struct pm_reprojection *r, struct pm_frame *f, const struct pm_grid *g, const double *const slope[3])
{
	const struct pm_transfer t = transfer_of(r, g);
	int status = 0;
	for (size_t i = 0; i < r->sets.n && !status; i++) {
		const char *set = r->sets.name[i];
		struct pm_field *alpha = pm_frame_field(f, set, r->law->strength);
		const double *volume = pm_in(pm_frame_field(f, set, "volume"), 0), *x[3], *const factor[3] = {volume, volume, volume};
		double *const out[3] = {pm_out(alpha, 0), pm_out(alpha, 1), pm_out(alpha, 2)};
		struct pm_strays strays = {.count = 0};
		pm_positions(f, set, x);
		status = pm_gather(&t, alpha->count, x, slope, factor, out, &strays);
	}
	return status;
}

static double largest(size_t n, int components, const double *const y[])
{
	double most = 0;
	for (size_t i = 0; i < n; i++) {
		double square = 0;
		for (int c = 0; c < components; c++)
			square += y[c][i] * y[c][i];
		most = fmax(most, square);
	}
	return sqrt(most);
}

/* work: room for a gradient, div omega, and room for two more scalars of n. div omega becomes chi. */
static int potential_of(const struct pm_reprojection *r, const struct pm_operator *div, const struct pm_operator *grad, struct pm_poisson_fft *solver,
	size_t n, double *work)
{
	double *const slope[3] = {work, work + n, work + 2 * n}, *rest = work + 3 * n, *chi = work + 4 * n, *part = work + 5 * n;
	int status = 0;
	for (int64_t pass = 0; pass < r->passes && !status; pass++) {
		status = pm_poisson_fft_solve(solver, 1, rest, part, NULL);
		for (size_t i = 0; i < n; i++)
			chi[i] += part[i];
		status = status ? status : pm_operator_apply(grad, 1, (const double *const[]){part}, slope, NULL);
		status = status ? status : pm_operator_apply(div, 1, (const double *const *)slope, (double *const[]){part}, NULL);
		for (size_t i = 0; i < n; i++)
			rest[i] -= part[i];
	}
	memcpy(rest, chi, n * sizeof *rest);
	return status;
}

int pm_reprojection_apply(const struct pm_reprojection *r, struct pm_frame *f, struct pm_fft_plans *plans, struct pm_fft_solvers *solvers, double *divergence)
{
	const struct pm_grid g = pm_grid_of(f, r->mesh);
	const size_t n = pm_grid_size(&g);
	const size_t arrays = r->passes > 1 ? 6 : 4;
	double *work = pm_zalloc(arrays * n, sizeof *work), *const omega[3] = {work, work + n, work + 2 * n}, *div = work + 3 * n;
	struct pm_operator first = r->div, slope = r->grad;
	int status = work ? spread(r, f, &g, omega) : -PM_DATA, changed = 0;
	if (!status)
		status = pm_operator_plan(&first, plans) || pm_operator_plan(&slope, plans) ? -PM_DATA : 0;
	if (!status)
		status = pm_operator_apply(&first, 1, (const double *const *)omega, (double *const[]){div}, NULL);
	if (!status) {
		const double most = largest(n, 3, (const double *const *)omega), h = fmax(g.h[0], fmax(g.h[1], g.h[2]));
		*divergence = most > 0 ? largest(n, 1, (const double *const[]){div}) * h / most : 0;
		changed = *divergence > r->above;
	}
	if (!status && changed) {
		struct pm_poisson_fft *solver = pm_fft_solvers_find(solvers, &g, &r->solver);
		solver = solver ? solver : pm_fft_solvers_add(solvers, &g, &r->solver, true);
		status = !solver ? -PM_DATA : r->passes == 1 ? pm_poisson_fft_solve(solver, 1, div, div, NULL) :
			potential_of(r, &first, &slope, solver, n, work);
		if (!status)
			status = pm_operator_apply(&slope, -1, (const double *const[]){div}, omega, NULL);
		if (!status)
			status = gather(r, f, &g, (const double *const *)omega);
	}
	pm_free(work);
	return status ? status : changed;
}
