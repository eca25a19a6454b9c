/* Energy-conserving force: acc_p += (q/m) sign sum_i phi_i grad W((x_p - x_i)/h), the derivative of the field's energy 1/2 sum rho phi by the particle's place,
 * where phi is a symmetric Green's function of rho. Of a B-spline the derivative is the difference of two splines one order lower, so this is E between
 * the nodes, gathered with the lower kernel along its own axis. Energy is conserved in the limit dt -> 0; momentum is not, and a particle feels its own images
 * on the mesh. The other way, m2p of mgrad's field, conserves momentum and not energy.
 * Source: Lewis 1970, J. Comput. Phys. 6, 136; Birdsall and Langdon 1985, chapter 10. Cost: dim width^dim products a particle, read in the order of the
 * particles. With ranks the planes that its particles reach come to a rank, some at a time. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/force-words.h"
#include "mesh/planes-some.h"
#include "stream/declare.h"
#include "transfer/gather-energy.h"
#include "transfer/gather-limits.h"
#include "transfer/magnetic-field.h"
#include "transfer/transfer-axis.h"
#include "world/world.h"

static int check_kernel(const struct pm_kernel *k)
{
	if (k->smooth < 0 || k->star)
		return pm_fail(PM_USAGE, "%s has no gradient (--energy-conserving needs a continuous kernel that is a product: cic, tsc, pcs)", k->name);
	return pm_kernel_folds(k->width, k->degree, 1) ? pm_fail(PM_USAGE, "--energy-conserving is not there for %s (cic, tsc, pcs, m4prime, m6prime)",
		k->name) : 0;
}

bool pm_gather_by_potential(const struct pm_gather_choice *choice, const struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	return choice->conserving && !(law && law->evolves);
}

int pm_gather_energy_choose(const struct pm_gather_choice *choice, const struct pm_frame *f, struct pm_gather_job *j)
{
	char words[PM_FORCE_WORDS];
	*j = (struct pm_gather_job){.choice = *choice, .law = pm_law_of(f)};
	if (!j->law)
		return -PM_DATA;
	j->name = j->law->potential;
	if (!j->name || j->law->of_potential != PM_GRADIENT || j->law->evolves)
		return pm_fail(PM_DATA, "the law '%s' has no potential whose gradient is a force (no --energy-conserving here)", f->law);
	for (size_t i = 0; i < f->nmeshes && !j->field; i++)
		if (!choice->mesh || !strcmp(choice->mesh, f->meshes[i]->name))
			j->field = pm_frame_field(f, (j->mesh = f->meshes[i])->name, j->name);
	if (!j->field) {
		const char *mesh = choice->mesh ? choice->mesh : "mesh";
		return pm_fail(PM_DATA, "no potential '%s' on the mesh (run %s first; --energy-conserving needs no mgrad)", j->name,
			pm_force_words(f, j->law, mesh, j->name, words));
	}
	const char *const needs[] = {"x", j->law->of, j->law->per, j->law->per ? j->law->strength : NULL, NULL};
	int status = pm_sets_choose(f, choice->set, needs, "stab reads it from a table", &j->sets);
	if (!status && j->field->interlaced)
		status = pm_fail(PM_DATA, "'%s' is interlaced, and --energy-conserving takes one mesh (p2m without --interlace)", j->name);
	j->transfer = (struct pm_transfer){.grid = pm_grid_of(f, j->mesh), .components = 1, .rim = j->field->rim,
		.kernel = status ? NULL : pm_kernel_choose(choice->kernel, j->field, j->law, "cic")};
	return status ? status : j->transfer.kernel ? check_kernel(j->transfer.kernel) : -PM_DATA;
}

int pm_gather_energy_declare(const struct pm_gather_job *j, struct pm_frame *f)
{
	const bool replace = j->choice.replace;
	int status = pm_reads(f, j->mesh->name, j->name) ? 0 : -PM_DATA;
	for (size_t i = 0; i < j->sets.n && !status; i++) {
		const char *set = j->sets.name[i];
		status = pm_reads_positions(f, set);
		if (!status && j->law->per && (!pm_reads(f, set, j->law->strength) || !pm_reads(f, set, j->law->per)))
			status = -PM_DATA;
		if (!status && !pm_contributes(f, set, j->law->change, j->law->of, f->dim, "self", replace))
			status = -PM_DATA;
		if (!status && j->law->magnetic)
			status = pm_bfield_plan(f, set, j->mesh, j->law->magnetic, replace);
	}
	return status ? status : pm_gather_limits_declare(j, f);
}

/* Weights of the points around one particle, and their derivatives by t = x/h. */
struct support {
	size_t slot[3];
	double w[3][PM_KERNEL_WIDTH], slope[3][PM_KERNEL_WIDTH];
};

static bool support_of(const struct pm_transfer *t, const struct pm_axis axes[3], const double *const x[], size_t p, struct support *s)
{
	const struct pm_kernel *k = t->kernel;
	for (int d = 0; d < t->grid.dim; d++) {
		double u;
		if (!pm_axis_locate(&axes[d], x[d][p], &u))
			return false;
		s->slot[d] = (size_t)floor(u);
		const double at = u - floor(u) - axes[d].shift;
		pm_kernel_weights(k, at, s->w[d]);
		for (int i = 0; i < k->width; i++) {
			double sum = 0;
			for (int power = k->degree; power > 0; power--)
				sum = sum * at + power * k->coefficients[power * k->width + i];
			s->slope[d][i] = sum;
		}
	}
	return true;
}

/* The gradient of the potential at a particle; points of axes above dim are one. */
static void gradient_at(const struct pm_transfer *t, const struct pm_axis axes[3], const struct support *s, const double *const plane[], double gradient[3])
{
	const struct pm_grid *g = &t->grid;
	const int n = t->kernel->width, ny = g->dim > 1 ? n : 1, nz = g->dim > 2 ? n : 1;
	gradient[0] = gradient[1] = gradient[2] = 0;
	for (int k = 0; k < nz; k++)
		for (int j = 0; j < ny; j++) {
			const size_t sz = g->dim > 2 ? s->slot[2] + (size_t)k : 0, sy = g->dim > 1 ? s->slot[1] + (size_t)j : 0;
			const double sign = (g->dim > 2 ? axes[2].get[0][sz] : 1) * (g->dim > 1 ? axes[1].get[0][sy] : 1);
			const double *row = g->dim > 2 ? plane[axes[2].at[sz]] + axes[1].at[sy] * g->points[0] : plane[g->dim > 1 ? axes[1].at[sy] : 0];
			double value = 0, slope = 0;
			for (int i = 0; i < n; i++) {
				const double p = axes[0].get[0][s->slot[0] + (size_t)i] * row[axes[0].at[s->slot[0] + (size_t)i]];
				value += s->w[0][i] * p;
				slope += s->slope[0][i] * p;
			}
			const double wy = g->dim > 1 ? s->w[1][j] : 1, wz = g->dim > 2 ? s->w[2][k] : 1;
			gradient[0] += sign * wy * wz * slope;
			gradient[1] += g->dim > 1 ? sign * s->slope[1][j] * wz * value : 0;
			gradient[2] += g->dim > 2 ? sign * wy * s->slope[2][k] * value : 0;
		}
	for (int d = 0; d < g->dim; d++)
		gradient[d] /= g->h[d];
}

/* The particles whose support begins at the slots from..to-1 of the last axis, and the planes of the mesh around these. */
struct window {
	size_t from, to;
	const double *const *plane;
};

/* Particles whose kernel leaves the mesh get nothing, and are counted. */
static uint64_t gather_window(const struct pm_gather_job *j, const struct pm_axis axes[3], const struct pm_frame *f, const char *set, const double *ratio,
	const struct window *w)
{
	const struct pm_field *target = pm_frame_field(f, set, j->law->change);
	const double *x[3];
	double *out[3];
	uint64_t lost = 0;
	pm_positions(f, set, x);
	for (int d = 0; d < f->dim; d++)
		out[d] = pm_out((struct pm_field *)target, d);
#pragma omp parallel for schedule(static) reduction(+:lost) if (target->count > 4096)
	for (size_t p = 0; p < target->count; p++) {
		struct support s;
		double gradient[3];
		if (!support_of(&j->transfer, axes, x, p, &s)) {
			lost++;
			continue;
		}
		const size_t slot = s.slot[f->dim - 1];
		if (slot < w->from || slot >= w->to)
			continue;
		gradient_at(&j->transfer, axes, &s, w->plane, gradient);
		for (int d = 0; d < f->dim; d++)
			out[d][p] += (ratio ? ratio[p] : 1) * j->law->sign * gradient[d];
	}
	return lost;
}

/* The slots at which supports of particles here begin, along the last axis. */
static void mark_slots(const struct pm_axis *last, size_t n, const double *x, unsigned char *any)
{
	for (size_t p = 0; p < n; p++) {
		double u;
		if (pm_axis_locate(last, x[p], &u))
			any[(size_t)floor(u)] = 1;
	}
}

/* In as many rounds as the rank needs whose particles reach most planes. */
static int gather(int status, const struct pm_gather_job *j, const struct pm_axis axes[3], const struct pm_frame *f, const char *set, const double *ratio,
	uint64_t *strays)
{
	const struct pm_field *x = pm_frame_field(f, set, "x");
	const struct pm_axis *last = &axes[f->dim - 1];
	const size_t width = (size_t)j->transfer.kernel->width, at_once = j->planes.axis ? pm_planes_at_once(&j->planes, width) - width : last->count;
	const double *phi[] = {pm_in(j->field, 0)};
	unsigned char *any = status ? NULL : pm_zalloc(last->count + j->planes.all, 1), *wanted = any ? any + last->count : NULL;
	struct window w = {0, 0, NULL};
	int64_t left = 1;
	status = status || any ? status : pm_failed();
	if (!status && j->planes.divided)
		mark_slots(last, x->count, pm_in(x, f->dim - 1), any);
	else if (!status)
		memset(any, 1, last->count);
	for (bool first = true; left; first = false) {
		struct pm_some_planes some;
		for (w.from = w.to; any && w.from < last->count && !any[w.from]; w.from++)
			;
		w.to = w.from + at_once < last->count ? w.from + at_once : last->count;
		if (any)
			memset(wanted, 0, j->planes.all);
		for (size_t slot = w.from; any && slot < w.to; slot++)
			for (size_t i = slot; any[slot] && i < slot + width; i++)
				wanted[j->planes.axis ? last->at[i] : 0] = 1;
		status = pm_planes_some(status, &j->planes, wanted, 1, phi, &some);
		w.plane = some.at;
		const uint64_t lost = status ? 0 : gather_window(j, axes, f, set, ratio, &w);
		*strays = first ? lost : *strays;
		pm_planes_some_free(&some);
		left = 0;
		for (size_t slot = w.to; any && slot < last->count; slot++)
			left |= any[slot];
		status = pm_world_count(status, PM_MOST_OF, 1, &left);
		left = status ? 0 : left;
	}
	pm_free(any);
	int64_t all = (int64_t)*strays;
	status = pm_world_count(status, PM_SUM_OF, 1, &all);
	*strays = (uint64_t)all;
	return status;
}

static int one_set(const struct pm_gather_job *j, const struct pm_axis axes[3], struct pm_frame *f, const char *set)
{
	const double before = pm_gather_limits_most(j, f, set);
	const double *ratio = NULL;
	double *made = NULL;
	uint64_t lost = 0;
	int status = j->law->per ? pm_ratio(f, set, j->law->strength, j->law->per, &ratio, &made) : 0;
	status = gather(status, j, axes, f, set, ratio, &lost);
	pm_free(made);
	if (!status && lost)
		status = pm_fail(PM_DATA, "the kernels of %llu particles of '%s' leave the mesh '%s' (a larger box, or m2p without --energy-conserving)",
			(unsigned long long)lost, set, j->mesh->name);
	if (!status && j->law->magnetic)
		status = pm_bfield(f, set, j->mesh, j->law->magnetic, &j->transfer);
	if (!status)
		pm_gather_limits_add(j, f, set, before, 0);
	return status;
}

int pm_gather_energy(struct pm_gather_job *j, struct pm_frame *f)
{
	struct pm_axis axes[3];
	int status = pm_axes_init(axes, &j->transfer, j->transfer.staggered[0]);
	status = pm_world_agree(status ? status : pm_planes_init(&j->planes, &j->transfer.grid, j->field));
	j->transfer.planes = &j->planes;
	if (!status)
		pm_gather_limits_prepare(j, f);
	for (size_t i = 0; i < j->sets.n && !status; i++)
		status = one_set(j, axes, f, j->sets.name[i]);
	pm_axes_free(axes);
	pm_planes_free(&j->planes);
	return status;
}
