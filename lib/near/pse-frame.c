/* Particle strength exchange of a set: the width from the mean volume, the images from the faces, the change field.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "near/pse-frame.h"
#include "stream/declare.h"
#include "stream/limits.h"

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

static int check_volumes(const struct pm_pse_set *s, size_t n, const double *volume, bool value)
{
	for (size_t i = 0; i < n; i++)
		if (!(volume[i] >= 0) || (value && volume[i] == 0))
			return pm_fail(PM_DATA, "particle %zu of '%s' has the volume %g, and %s", i, s->set, volume[i],
				volume[i] < 0 ? "negative volumes amplify instead of damping" : "its value is strength over volume");
	return 0;
}

/* A particle beyond a wall would be a neighbour of its own image. */
static int check_faces(const struct pm_pse_set *s, const struct pm_domain *d, size_t n, const double *const x[])
{
	for (int a = 0; a < d->dim; a++)
		for (int side = 0; side < 2; side++)
			for (size_t i = 0; i < n && (d->face[a][side] == PM_WALL || d->face[a][side] == PM_NEUMANN); i++)
				if (side ? x[a][i] > d->hi[a] : x[a][i] < d->lo[a])
					return pm_fail(PM_DATA,
						"particle %zu of '%s' is at %c = %g, behind a face that mirrors it (reflect particles there, or --wall none)",
						i, s->set, "xyz"[a], x[a][i]);
	return 0;
}

static int width(struct pm_pse_set *s, int dim, size_t n, const double *volume, double *spacing)
{
	*spacing = pow(pm_sum_array(n, volume) / (double)n, 1.0 / dim);
	if (isnan(s->eps))
		s->eps = s->overlap * *spacing;
	if (isnan(s->cutoff))
		s->cutoff = s->corrected ? pm_dc_cutoff(s->order) : pm_pse_cutoff(s->order);
	return s->eps >= 1e-60 && s->eps <= 1e60 ? 0 : pm_fail(PM_DATA, "the volumes on '%s' make a width of %g (--eps LENGTH)", s->set, s->eps);
}

/* One component; a value is exchanged as value times volume. */
static int component(struct pm_pse_set *s, const struct pm_pse *p, const struct pm_cell_list *l, const struct pm_field *g, int c, const double *volume,
	double *rate, struct pm_pse_found *found)
{
	const double *in = pm_in(g, c);
	if (g->extensive)
		return pm_pse_add(p, l, s->nu, volume, in, rate, found);
	double *strength = pm_alloc(l->n, sizeof *strength), *sum = pm_zalloc(l->n, sizeof *sum);
	int status = strength && sum ? 0 : -PM_DATA;
	for (size_t i = 0; i < l->n && !status; i++)
		strength[i] = volume[i] * in[i];
	if (!status)
		status = pm_pse_add(p, l, s->nu, volume, strength, sum, found);
	for (size_t i = 0; i < l->n && !status; i++)
		rate[i] += sum[i] / volume[i];
	pm_free(strength), pm_free(sum);
	return status;
}

static int exchange(struct pm_pse_set *s, int dim, const struct pm_cell_list *l, const struct pm_field *g, const double *volume, struct pm_field *change,
	struct pm_pse_found *found)
{
	struct pm_pse p = pm_pse_of(dim, s->order, s->eps, s->cutoff);
	int status = 0;
	for (int c = 0; c < g->components && !status; c++)
		status = component(s, &p, l, g, c, volume, pm_out(change, c), found);
	return status;
}

static int stuck(const struct pm_pse_set *s, const struct pm_dc_found *found, double reach)
{
	return pm_fail(PM_DATA, "particle %zu of '%s' has %zu partners within %g, which do not determine the Laplacian (rank %d of %d; a larger --cutoff or "
		"--overlap, "
		"remesh, or --method exchange)", found->stuck, s->set, found->partners, reach, found->rank, found->wanted);
}

/* All components at once, because the weights are the same. A strength is its value times volume. */
static int correct(struct pm_pse_set *s, int dim, const struct pm_cell_list *l, const struct pm_field *g, const double *volume, struct pm_field *change,
	struct pm_pse_found *found)
{
	const size_t n = l->n, fields = (size_t)g->components;
	struct pm_dc o = {.dim = dim, .order = s->order, .eps = s->eps, .reach = l->reach / pm_dc_widest};
	struct pm_dc_found dc;
	double *value = pm_alloc(n * fields, sizeof *value), *sum = pm_zalloc(n * fields, sizeof *sum), *rates[PM_DC_FIELDS];
	const double *values[PM_DC_FIELDS];
	int status = value && sum ? 0 : -PM_DATA;
	for (size_t c = 0; c < fields && !status; c++) {
		values[c] = value + c * n, rates[c] = sum + c * n;
		for (size_t i = 0; i < n; i++)
			value[c * n + i] = pm_in(g, (int)c)[i] / (g->extensive ? volume[i] : 1);
	}
	if (!status && (status = pm_dc_add(&o, l, s->nu, g->components, values, rates, &dc)) == -PM_NUMERICS)
		status = stuck(s, &dc, l->reach);
	for (size_t c = 0; c < fields && !status; c++)
		for (size_t i = 0; i < n; i++)
			pm_out(change, (int)c)[i] += sum[c * n + i] * (g->extensive ? volume[i] : 1);
	found->fastest = status ? 0 : dc.fastest, found->widened = status ? 0 : dc.widened;
	pm_free(value), pm_free(sum);
	return status;
}

int pm_pse_apply(struct pm_frame *f, struct pm_pse_set *s, struct pm_pse_found *found)
{
	char name[PM_NAME];
	const double *x[3], *volume = pm_in(pm_frame_field(f, s->set, "volume"), 0);
	const struct pm_field *g = pm_frame_field(f, s->set, s->field);
	struct pm_domain domain = pm_domain_of(f);
	struct pm_cell_list list = {.n = 0};
	double spacing;
	*found = (struct pm_pse_found){0};
	for (int d = 0; d < f->dim; d++) {
		x[d] = pm_in(pm_frame_field(f, s->set, "x"), d);
		for (int side = 0; side < 2 && !s->images; side++)
			if (domain.face[d][side] != PM_PERIODIC)
				domain.face[d][side] = PM_OPEN;
	}
	if (!g->count)
		return 0;
	int status = check_volumes(s, g->count, volume, s->corrected || !g->extensive);
	if (!status)
		status = check_faces(s, &domain, g->count, x);
	if (!status)
		status = width(s, f->dim, g->count, volume, &spacing);
	if (status)
		return status;
	status = pm_cell_list_init(&list, &domain, g->count, x, pm_pse_reach(s->eps, s->cutoff) * (s->corrected ? pm_dc_widest : 1),
		(s->corrected ? 1 : 2) * spacing);
	change_name(s, name);
	struct pm_field *change = pm_frame_field(f, s->set, name);
	if (!status)
		status = (s->corrected ? correct : exchange)(s, f->dim, &list, g, volume, change, found);
	if (!status)
		pm_limits_add(change, (struct pm_limits){.decay = s->nu * found->fastest});
	pm_cell_list_free(&list);
	return status;
}
