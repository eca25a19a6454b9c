/* Which derivatives of which components, the width from the mean volume, the images from the faces.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "near/derivative-frame.h"
#include "near/pse.h"
#include "stream/all-values.h"
#include "stream/declare.h"
#include "transfer/transfer-frame.h"
#include "world/world.h"

/* The operators of a name: one, or as many as the gradient or the Laplacian has axes. */
struct operators {
	int n, power[3][3], degree;
	bool gradient;
};

static int parse(const struct pm_derivative_choice *o, int dim, struct operators *d)
{
	*d = (struct operators){.gradient = !strcmp(o->derivative, "grad")};
	if (d->gradient || !strcmp(o->derivative, "lap")) {
		d->n = dim, d->degree = d->gradient ? 1 : 2;
		for (int a = 0; a < dim; a++)
			d->power[a][a] = d->degree;
	} else {
		const char *at = o->derivative;
		int axes = 0;
		for (d->n = 1; axes < 3 && *at >= '0' && *at <= '4'; at += *at == ',')
			d->degree += d->power[0][axes++] = *at++ - '0';
		if (*at || at[-1] == ',' || axes != dim || d->degree < 1 || d->degree > PM_DERIVATIVE_DEGREE)
			return pm_fail(PM_USAGE, "--derivative '%s': grad, lap, or the power of each of the %d axes, in all 1 to %d (%s)", o->derivative,
				dim, PM_DERIVATIVE_DEGREE, dim == 1 ? "2" : dim == 2 ? "1,0" : "1,0,0");
	}
	if (o->plus && d->degree % 2 == 0)
		return pm_fail(PM_USAGE, "--sign plus is for derivatives of odd degree: of even degree a constant would not have the derivative 0");
	if (o->corrected && o->order + d->degree - 1 > 7)
		return pm_fail(PM_USAGE, "--method dc takes moments to degree 7, and order %d of a derivative of degree %d needs %d (a lower --order, or "
			"--method integral)", o->order, d->degree, o->order + d->degree - 1);
	for (int k = 0; k < d->n && o->side; k++)
		for (int a = 0, axes = 0; a < 3; a++)
			if ((axes += d->power[k][a] > 0) > 1 || (!o->corrected && d->degree > 1))
				return pm_fail(PM_USAGE, "--side %s is for derivatives along one axis%s", o->side < 0 ? "below" : "above",
					o->corrected ? "" : ", and with --method integral for the first (--method dc takes higher ones)");
	return 0;
}

static const char *set_of(const struct pm_derivative_choice *o, const struct pm_frame *f)
{
	for (size_t i = 0; i < f->nsets && !o->set; i++)
		if (pm_frame_field(f, f->sets[i]->name, o->field) && pm_frame_field(f, f->sets[i]->name, "x"))
			return f->sets[i]->name;
	return o->set;
}

int pm_derivative_declare(const struct pm_derivative_choice *o, struct pm_frame *f)
{
	struct operators d;
	const char *set = set_of(o, f);
	if (!set || !pm_frame_set(f, set) || !pm_frame_field(f, set, o->field))
		return pm_fail(PM_DATA, "no field '%s' on %s%s%s (sls lists what there is)", o->field, set ? "'" : "particles", set ? set : "", set ? "'" : "");
	int status = parse(o, f->dim, &d);
	if (status)
		return status;
	const struct pm_field *q = pm_reads(f, set, o->field), *volume = pm_frame_field(f, set, "volume");
	if (!q || pm_reads_positions(f, set))
		return -PM_DATA;
	if (q->type != PM_F64 && q->type != PM_F32)
		return pm_fail(PM_DATA, "'%s' does not hold real numbers", o->field);
	if (!volume && (q->extensive || !o->corrected || isnan(o->eps)))
		return pm_fail(PM_DATA, "no field 'volume' on '%s', %s (remesh gives volumes; or scalc, or a column of the table)", set,
			q->extensive || !o->corrected ? "by which values are weighted" : "from which --overlap takes the width (or --eps LENGTH)");
	if (volume && !pm_reads(f, set, "volume"))
		return -PM_DATA;
	if (d.gradient && q->components > 1)
		return pm_fail(PM_DATA, "--derivative grad is of a field of one component, and '%s' has %d (take the components apart with scalc)", o->field,
			q->components);
	const int components = d.gradient ? f->dim : q->components;
	const struct pm_field *old = pm_frame_field(f, set, o->target);
	if (old && old->role != PM_DERIVED)
		return pm_fail(PM_DATA, "'%s' on '%s' is there and not derived (choose another --target)", o->target, set);
	return pm_makes(f, set, o->target, components, PM_DERIVED) ? 0 : -PM_DATA;
}

/* The particles of the set; with ranks that share the frame all of them on each rank. */
struct whole {
	size_t n;
	const double *x[3], *volume; /* volume NULL: none */
	double *room;      /* with ranks: the memory of them */
	uint64_t here[2];  /* the first particle that is here, and the one behind the last */
};

static int bring(const struct pm_frame *f, const char *set, const struct pm_field *q, struct whole *w)
{
	const struct pm_field *v = pm_frame_field(f, set, "volume");
	*w = (struct whole){.n = pm_frame_set(f, set)->n, .volume = v ? pm_in(v, 0) : NULL, .here = {q->first, q->first + q->count}};
	pm_positions(f, set, w->x);
	if (!q->here)
		return 0;
	w->room = pm_alloc((size_t)(f->dim + 1) * w->n + 1, sizeof *w->room);
	int status = w->room ? 0 : -PM_DATA;
	for (int a = 0; a < f->dim + (v != NULL); a++) {
		const double **of = a < f->dim ? &w->x[a] : &w->volume;
		double *all = status ? NULL : w->room + (size_t)a * w->n;
		status = pm_all_values(status, q, *of, all);
		*of = all;
	}
	return status;
}

/* One operator on one component, added to the rates of the particles here. */
static int add(const struct pm_derivative_choice *o, const struct pm_cell_list *l, const int power[3], const struct whole *w, const double *value,
	double *rate, struct pm_derivative_took *took)
{
	int axis = 0;
	while (axis < 2 && !power[axis])
		axis++;
	if (!o->corrected)
		return pm_derivative_add(&(struct pm_derivative){.dim = l->domain.dim, .order = o->order, .power = {power[0], power[1], power[2]},
			.eps = took->eps, .plus = o->plus, .here = w->here, .axis = axis, .side = o->side}, l, w->volume, value, rate);
	const struct pm_dc dc = {.dim = l->domain.dim, .order = o->order, .power = {power[0], power[1], power[2]}, .axis = axis, .side = o->side,
		.here = w->here, .eps = took->eps, .reach = l->reach / pm_dc_widest};
	struct pm_dc_found found;
	int status = pm_dc_add(&dc, l, 1, 1, &value, &rate, &found);
	if (status == -PM_NUMERICS) {
		pm_world_place(1, 0, 0, found.stuck);
		status = pm_fail(PM_DATA, "particle %zu has %zu partners within %g%s, which do not determine the derivative "
			"(rank %d of %d; a larger --cutoff or --overlap, remesh, or --method integral)", found.stuck, found.partners, l->reach,
			o->side ? " on that side" : "", found.rank, found.wanted);
	}
	int64_t widened = (int64_t)found.widened;
	status = pm_world_count(status, PM_SUM_OF, 1, &widened);
	took->widened = (uint64_t)widened > took->widened ? (uint64_t)widened : took->widened;
	return status;
}

static int components(const struct pm_derivative_choice *o, const struct operators *d, const struct pm_cell_list *l, const struct pm_field *q,
	const struct whole *w, struct pm_field *target, struct pm_derivative_took *took)
{
	double *value = pm_alloc(w->n + 1, sizeof *value);
	int status = pm_world_agree(value ? 0 : -PM_DATA);
	for (int c = 0; c < q->components && !status; c++) {
		for (size_t i = q->first; i < q->first + q->count; i++)
			value[i] = pm_in(q, c)[i - q->first] / (q->extensive ? w->volume[i] : 1);
		status = pm_all_values(0, q, value + q->first, value);
		for (int k = 0; k < d->n && !status; k++)
			status = pm_world_agree(add(o, l, d->power[k], w, value, pm_out(target, d->gradient ? k : c), took));
	}
	pm_free(value);
	return status;
}

int pm_derivative_apply(const struct pm_derivative_choice *o, struct pm_frame *f, struct pm_derivative_took *took)
{
	const char *set = set_of(o, f);
	const struct pm_field *q = pm_frame_field(f, set, o->field);
	struct pm_field *target = pm_frame_field(f, set, o->target);
	struct pm_domain domain = pm_domain_of(f);
	struct pm_cell_list list = {.n = 0};
	struct operators d;
	struct whole w;
	*took = (struct pm_derivative_took){.eps = o->eps, .cutoff = o->cutoff};
	if (!pm_frame_set(f, set)->n)
		return parse(o, f->dim, &d);
	int status = bring(f, set, q, &w);
	status = status ? status : parse(o, f->dim, &d);
	for (size_t i = 0; i < w.n && !status && w.volume; i++)
		if (!(w.volume[i] > 0))
			status = pm_fail(PM_DATA, "particle %zu of '%s' has the volume %g (above 0)", i, set, w.volume[i]);
	for (int a = 0; a < f->dim; a++)
		for (int side = 0; side < 2 && !o->images; side++)
			if (domain.face[a][side] != PM_PERIODIC)
				domain.face[a][side] = PM_OPEN;
	const double spacing = status ? NAN : w.volume ? pow(pm_sum_array(w.n, w.volume) / (double)w.n, 1.0 / f->dim) : o->eps;
	if (isnan(took->eps))
		took->eps = o->overlap * spacing;
	if (isnan(took->cutoff) && !status)
		took->cutoff = o->corrected ? pm_dc_cutoff(o->order + (d.degree > 2 ? d.degree - 1 : 0)) : pm_pse_cutoff(o->order) + 0.5 * d.degree;
	if (!status && !(took->eps >= 1e-60 && took->eps <= 1e60))
		status = pm_fail(PM_DATA, "the volumes on '%s' make a width of %g (--eps LENGTH)", set, took->eps);
	if (!status)
		status = pm_cell_list_init(&list, &domain, w.n, w.x, pm_pse_reach(took->eps, took->cutoff) * (o->corrected ? pm_dc_widest : 1), 2 * spacing);
	status = pm_world_agree(status);
	if (!status)
		status = components(o, &d, &list, q, &w, target, took);
	pm_cell_list_free(&list);
	pm_free(w.room);
	return status;
}
