/* Particle strength exchange of a set: the width from the mean volume, the images from the faces, the change field; on many
 * ranks all particles on each.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "near/pse-frame.h"
#include "stream/all-values.h"
#include "stream/declare.h"
#include "stream/limits.h"
#include "stream/over-stretches.h"
#include "world/world.h"

static void change_name(const struct pm_pse_set *s, char name[PM_NAME]) { snprintf(name, PM_NAME, "d%.62s", s->field); }

int pm_pse_plan(struct pm_frame *f, const struct pm_pse_set *s, bool replace)
{
	char name[PM_NAME];
	const struct pm_field *g = pm_frame_field(f, s->set, s->field);
	if (g->role != PM_STATE || (g->type != PM_F64 && g->type != PM_F32))
		return pm_fail(PM_DATA, "'%s' on '%s' is not state of real numbers: no word would advance it", s->field, s->set);
	if (!pm_frame_field(f, s->set, "volume"))
		return pm_fail(PM_DATA, "no field 'volume' on '%s', and particles exchange strength by their volumes (remesh gives them volumes; or scalc, "
			"or a column volume in the table)", s->set);
	if (!pm_reads(f, s->set, s->field) || !pm_reads(f, s->set, "volume"))
		return -PM_DATA;
	change_name(s, name);
	struct pm_field *to = pm_contributes(f, s->set, name, s->field, g->components, "diffusion", replace);
	if (to)
		to->extensive = g->extensive;
	return to ? 0 : -PM_DATA;
}

/* The particles of a set; with ranks that share the frame all of them on each rank. */
struct whole {
	size_t n;              /* of all */
	const double *x[3], *volume;
	const double *own;     /* volumes of the particles here */
	double *room;          /* with ranks: the memory of the others */
	const double *share;   /* NULL: none */
	double *scaled;        /* positions where axes differ in nu */
	double nu;             /* of pm_pse_add */
	const struct pm_field *g; /* what is exchanged, of the particles here */
};

/* Behind the checks. Takes a status and returns the agreed one. */
static int bring_all(int status, const struct pm_frame *f, const struct pm_field *g, struct whole *w)
{
	const int last = f->dim + (w->share ? 1 : 0);
	status = pm_world_agree(status);
	if (!g->here)
		return status;
	w->room = status ? NULL : pm_alloc((size_t)(last + 1) * w->n + 1, sizeof *w->room);
	status = status ? status : w->room ? 0 : pm_failed();
	for (int d = 0; d <= last; d++) {
		const double **of = d < f->dim ? &w->x[d] : d == f->dim ? &w->volume : &w->share;
		double *all = w->room ? w->room + (size_t)d * w->n : NULL;
		status = pm_all_values(status, g, *of, all);
		*of = all;
	}
	return status;
}

/* Axes of different nu: lengths over the root of their ratio, where nu is the same along all; volumes there are smaller by the product of the roots, which
 * values do not feel. */
static int scale_axes(int status, const struct pm_pse_set *s, struct pm_domain *domain, struct whole *w)
{
	bool any = false;
	w->nu = s->nu;
	for (int d = 0; d < domain->dim; d++)
		any = any || s->axis[d] != 1;
	if (status || !any)
		return status;
	w->scaled = pm_alloc((size_t)domain->dim * w->n + 1, sizeof *w->scaled);
	for (int d = 0; d < domain->dim && w->scaled; d++) {
		const double root = sqrt(s->axis[d]);
		double *to = w->scaled + (size_t)d * w->n;
		for (size_t i = 0; i < w->n; i++)
			to[i] = w->x[d][i] / root;
		w->x[d] = to;
		domain->lo[d] /= root, domain->hi[d] /= root;
		w->nu /= s->corrected ? 1 : root;
	}
	return w->scaled ? 0 : pm_failed();
}

static int check_volumes(const struct pm_pse_set *s, const struct pm_field *g, const double *volume, bool value)
{
	for (size_t i = 0; i < g->count; i++)
		if (!(volume[i] >= 0) || (value && volume[i] == 0)) {
			pm_world_place(2, 0, 0, g->first + i);
			return pm_fail(PM_DATA, "particle %zu of '%s' has the volume %g, and %s", (size_t)g->first + i, s->set, volume[i],
				volume[i] < 0 ? "negative volumes amplify instead of damping" : "its value is strength over volume");
		}
	return 0;
}

/* A particle beyond a wall would be a neighbour of its own image. */
static int check_faces(const struct pm_pse_set *s, const struct pm_domain *d, const struct pm_field *g, const double *const x[])
{
	for (int a = 0; a < d->dim; a++)
		for (int side = 0; side < 2; side++)
			for (size_t i = 0; i < g->count && (d->face[a][side] == PM_WALL || d->face[a][side] == PM_NEUMANN); i++)
				if (side ? x[a][i] > d->hi[a] : x[a][i] < d->lo[a]) {
					pm_world_place(3, 0, 2 * a + side, g->first + i);
					return pm_fail(PM_DATA,
						"particle %zu of '%s' is at %c = %g, behind a face that mirrors it (reflect particles there, or --wall none)",
						(size_t)g->first + i, s->set, "xyz"[a], x[a][i]);
				}
	return 0;
}

static int width(struct pm_pse_set *s, int dim, const struct pm_field *g, const struct whole *w, double *spacing)
{
	struct pm_sum sum = {0};
	pm_sum_of_stretches(g, w->own, NULL, &sum);
	*spacing = pow(pm_sum_total(sum) / (double)w->n, 1.0 / dim);
	if (isnan(s->eps))
		s->eps = s->overlap * *spacing;
	if (isnan(s->cutoff))
		s->cutoff = s->corrected ? pm_dc_cutoff(s->order) : pm_pse_cutoff(s->order);
	return s->eps >= 1e-60 && s->eps <= 1e60 ? 0 : pm_fail(PM_DATA, "the volumes on '%s' make a width of %g (--eps LENGTH)", s->set, s->eps);
}

/* strength: of the particles here. */
static int add(int status, const struct pm_pse *p, const struct pm_cell_list *l, double nu, const struct whole *w, const double *strength,
	double *rate, struct pm_pse_found *found)
{
	const struct pm_field *g = w->g;
	if (!g->here)
		return status ? status : pm_pse_add(p, l, nu, w->volume, strength, rate, found);
	double *all = status ? NULL : pm_alloc(w->n + 1, sizeof *all);
	status = pm_all_values(status ? status : all ? 0 : pm_failed(), g, strength, all);
	status = pm_pse_add_here(status, p, l, nu, &(struct pm_pse_all){w->volume, all, g->from}, rate, found);
	pm_free(all);
	return status;
}

/* One component; a value is exchanged as value times volume. */
static int component(const struct pm_pse *p, const struct pm_cell_list *l, const struct pm_field *g, int c, const struct whole *w,
	double *rate, struct pm_pse_found *found)
{
	const double *in = pm_in(g, c);
	if (g->extensive)
		return add(0, p, l, w->nu, w, in, rate, found);
	double *strength = pm_alloc(g->count + 1, sizeof *strength), *sum = pm_zalloc(g->count + 1, sizeof *sum);
	int status = strength && sum ? 0 : pm_failed();
	for (size_t i = 0; i < g->count && !status; i++)
		strength[i] = w->own[i] * in[i];
	status = add(status, p, l, w->nu, w, strength, sum, found);
	for (size_t i = 0; i < g->count && !status; i++)
		rate[i] += sum[i] / w->own[i];
	pm_free(strength), pm_free(sum);
	return status;
}

static int exchange(struct pm_pse_set *s, int dim, const struct pm_cell_list *l, const struct pm_field *g, const struct whole *w, struct pm_field *change,
	struct pm_pse_found *found)
{
	struct pm_pse p = pm_pse_of(dim, s->order, s->eps, s->cutoff);
	int status = 0;
	p.share = w->share;
	for (int c = 0; c < g->components && !status; c++)
		status = component(&p, l, g, c, w, pm_out(change, c), found);
	return status;
}

static int stuck(const struct pm_pse_set *s, const struct pm_dc_found *found, double reach)
{
	pm_world_place(4, 0, 0, found->stuck);
	return pm_fail(PM_DATA, "particle %zu of '%s' has %zu partners within %g, which do not determine the Laplacian (rank %d of %d; a larger --cutoff or "
		"--overlap, "
		"remesh, or --method exchange)", found->stuck, s->set, found->partners, reach, found->rank, found->wanted);
}

/* The largest row sum of all ranks, and the particles that widened. */
static int over_ranks(int status, struct pm_dc_found *dc)
{
	int64_t widened = status ? 0 : (int64_t)dc->widened;
	status = pm_world_largest(status, 1, &dc->fastest);
	status = pm_world_count(status, PM_SUM_OF, 1, &widened);
	dc->widened = (uint64_t)widened;
	return status;
}

/* All components at once, because the weights are the same. A strength is its value times volume. */
static int correct(struct pm_pse_set *s, int dim, const struct pm_cell_list *l, const struct pm_field *g, const struct whole *w, struct pm_field *change,
	struct pm_pse_found *found)
{
	const size_t n = l->n, here = g->count, fields = (size_t)g->components;
	const uint64_t wanted[2] = {g->first, g->first + here};
	struct pm_dc o = {.dim = dim, .order = s->order, .here = wanted, .eps = s->eps, .reach = l->reach / pm_dc_widest};
	struct pm_dc_found dc = {.fastest = 0};
	double *value = pm_alloc(n * fields, sizeof *value), *sum = pm_zalloc(here * fields + 1, sizeof *sum), *rates[PM_DC_FIELDS];
	const double *values[PM_DC_FIELDS];
	int status = value && sum ? 0 : -PM_DATA;
	for (size_t c = 0; c < fields; c++) {
		double *own = status ? NULL : value + c * n + g->first;
		for (size_t i = 0; i < here && own; i++)
			own[i] = pm_in(g, (int)c)[i] / (g->extensive ? w->own[i] : 1);
		values[c] = value + c * n, rates[c] = sum + c * here;
		status = pm_all_values(status, g, own, status ? NULL : value + c * n);
	}
	if (!status && (status = pm_dc_add(&o, l, w->nu, g->components, values, rates, &dc)) == -PM_NUMERICS)
		status = stuck(s, &dc, l->reach);
	status = over_ranks(status, &dc);
	for (size_t c = 0; c < fields && !status; c++)
		for (size_t i = 0; i < here; i++)
			pm_out(change, (int)c)[i] += sum[c * here + i] * (g->extensive ? w->own[i] : 1);
	found->fastest = status ? 0 : dc.fastest, found->widened = status ? 0 : dc.widened;
	pm_free(value), pm_free(sum);
	return status;
}

int pm_pse_apply(struct pm_frame *f, struct pm_pse_set *s, struct pm_pse_found *found)
{
	char name[PM_NAME];
	struct whole w = {.n = pm_frame_set(f, s->set)->n, .own = pm_in(pm_frame_field(f, s->set, "volume"), 0)};
	const struct pm_field *g = pm_frame_field(f, s->set, s->field);
	struct pm_domain domain = pm_domain_of(f);
	struct pm_cell_list list = {.n = 0};
	double spacing = 0;
	*found = (struct pm_pse_found){0};
	w.volume = w.own, w.g = g, w.share = s->share;
	for (int d = 0; d < f->dim; d++) {
		w.x[d] = pm_in(pm_frame_field(f, s->set, "x"), d);
		for (int side = 0; side < 2 && !s->images; side++)
			if (domain.face[d][side] != PM_PERIODIC)
				domain.face[d][side] = PM_OPEN;
	}
	if (!w.n)
		return 0;
	int status = pm_world_agree(check_volumes(s, g, w.own, s->corrected || !g->extensive));
	status = pm_world_agree(status ? status : check_faces(s, &domain, g, w.x));
	status = status ? status : width(s, f->dim, g, &w, &spacing); /* the same on all ranks */
	status = bring_all(status, f, g, &w);
	status = scale_axes(status, s, &domain, &w);
	if (!status)
		status = pm_cell_list_init(&list, &domain, w.n, w.x, pm_pse_reach(s->eps, s->cutoff) * (s->corrected ? pm_dc_widest : 1),
			(s->corrected ? 1 : 2) * spacing);
	status = pm_world_agree(status);
	change_name(s, name);
	struct pm_field *change = pm_frame_field(f, s->set, name);
	if (!status)
		status = (s->corrected ? correct : exchange)(s, f->dim, &list, g, &w, change, found);
	found->fastest *= w.nu;
	found->overlap *= w.nu / s->nu; /* axes: scale_axes() */
	found->spacing = spacing;
	if (!status)
		pm_limits_add(change, (struct pm_limits){.decay = found->fastest});
	pm_cell_list_free(&list);
	pm_free(w.room), pm_free(w.scaled);
	return status;
}

/* A lattice stretched by 2.7 has 0.002 above 1. Beyond order 2 some weights are negative, and are missing
 * beside edges (0.016 in 2-D, 0.043 in 3-D) and beyond a short cut-off. Of a width below 0.6 of the spacing the sum is not the integral on a lattice either. */
bool pm_pse_distorted(const struct pm_pse_set *p, int dim, const struct pm_pse_found *found)
{
	return found->overlap > 1 + (p->order > 2 ? 0.02 * dim + found->beyond : 0.002) && p->eps > 0.6 * found->spacing;
}
