/* Sources and points of a sampled function in one cell list, component by component. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "near/sample-frame.h"
#include "stream/declare.h"

struct job {
	const char *set, *field, *on; /* sources; where the points are */
	bool nodes;                   /* of a mesh */
	enum pm_sample_operator operator;
	enum pm_sample_correction correction;
};

static int find(const struct pm_sample_choice *o, const struct pm_frame *f, struct job *j)
{
	const struct pm_law *law = pm_law_of(f);
	const struct pm_mesh *mesh = pm_frame_mesh(f, o->mesh);
	if (!law)
		return -PM_DATA;
	*j = (struct job){.set = o->set, .field = o->field ? o->field : law->strength, .nodes = !o->at, .on = o->at ? o->at : mesh ? mesh->name : NULL};
	while (strcmp(pm_sample_operator_names[j->operator], o->operator))
		j->operator++;
	while (o->correct && strcmp(pm_sample_correction_names[j->correction], o->correct))
		j->correction++;
	if (!j->field)
		return pm_fail(PM_DATA, "the law %s has no strength (--field NAME)", law->name);
	for (size_t i = 0; i < f->nsets && !j->set; i++)
		if (pm_frame_field(f, f->sets[i]->name, j->field) && pm_frame_field(f, f->sets[i]->name, "x"))
			j->set = f->sets[i]->name;
	if (!j->set || !pm_frame_set(f, j->set))
		return pm_fail(PM_DATA, "no set %s%s%swith x and '%s' (sls lists what there is)", o->set ? "named " : "", o->set ? o->set : "",
			o->set ? " " : "", j->field);
	if (j->nodes ? !j->on : !pm_frame_set(f, j->on))
		return pm_fail(PM_DATA, j->nodes ? "no mesh%s%s (p2m -n makes one, or --at SET)" : "no set%s%s (sls lists what there is)",
			j->on || o->mesh ? " " : "", j->nodes ? (o->mesh ? o->mesh : "") : j->on);
	return 0;
}

int pm_sample_declare(const struct pm_sample_choice *o, struct pm_frame *f)
{
	struct job j;
	int status = find(o, f, &j);
	if (status)
		return status;
	const struct pm_field *q = pm_reads(f, j.set, j.field);
	if (!q || !pm_reads(f, j.set, "x") || (!j.nodes && !pm_reads(f, j.on, "x")))
		return -PM_DATA;
	if (q->type != PM_F64 && q->type != PM_F32)
		return pm_fail(PM_DATA, "'%s' does not hold real numbers", j.field);
	if ((!q->extensive || isnan(o->eps) || j.correction) && !pm_frame_field(f, j.set, "volume"))
		return pm_fail(PM_DATA, "no field 'volume' on '%s', %s (remesh gives volumes; or scalc, or a column of the table)", j.set,
			j.correction ? "which --correct sums" :
			q->extensive ? "from which --overlap takes the width (or --eps LENGTH)" : "with which a value becomes a strength");
	if (pm_frame_field(f, j.set, "volume") && !pm_reads(f, j.set, "volume"))
		return -PM_DATA;
	const int components = q->components;
	if (j.operator == PM_SAMPLE_GRAD && components > 1)
		return pm_fail(PM_DATA, "--operator grad is of a field of one component, and '%s' has %d", j.field, components);
	const struct pm_field *old = pm_frame_field(f, j.on, o->target);
	if (old && old->role != PM_DERIVED)
		return pm_fail(PM_DATA, "'%s' on '%s' is there and not derived (choose another --target)", o->target, j.on);
	return pm_makes(f, j.on, o->target, j.operator == PM_SAMPLE_GRAD ? f->dim : components, PM_DERIVED) ? 0 : -PM_DATA;
}

/* Positions: sources, then points. */
static int positions(const struct job *j, const struct pm_frame *f, size_t sources, size_t points, double *x[3])
{
	const struct pm_field *from = pm_frame_field(f, j->set, "x"), *at = j->nodes ? NULL : pm_frame_field(f, j->on, "x");
	const struct pm_mesh *m = j->nodes ? pm_frame_mesh(f, j->on) : NULL;
	size_t n[3] = {1, 1, 1}, stride = 1;
	if (m)
		pm_mesh_points(f, m, n);
	for (int d = 0; d < f->dim; d++) {
		if (!(x[d] = pm_alloc(sources + points + 1, sizeof(double))))
			return -PM_DATA;
		memcpy(x[d], pm_in(from, d), sources * sizeof(double));
		for (size_t i = 0; i < points && m; i++)
			x[d][sources + i] = m->lo[d] + (double)(i / stride % n[d]) * m->h[d];
		if (at)
			memcpy(x[d] + sources, pm_in(at, d), points * sizeof(double));
		stride *= n[d];
	}
	return 0;
}

/* The width and the reach. */
static int choose(const struct pm_sample_choice *o, const struct pm_frame *f, const struct job *j, size_t n, struct pm_sample *s)
{
	*s = (struct pm_sample){.dim = f->dim, .order = o->order, .operator = j->operator, .eps = o->eps};
	while (strcmp(pm_sample_kind_names[s->kind], o->mollifier))
		s->kind++;
	const struct pm_field *volume = pm_frame_field(f, j->set, "volume");
	if (isnan(s->eps))
		s->eps = (isnan(o->overlap) ? pm_sample_overlap(s->kind) : o->overlap) * pow(pm_sum_array(n, pm_in(volume, 0)) / (double)n, 1.0 / f->dim);
	s->reach = s->eps * (isnan(o->cutoff) ? pm_sample_cutoff(s->kind, s->order) : o->cutoff) * (1 + 1e-9);
	return s->eps >= 1e-60 && s->eps <= 1e60 ? 0 : pm_fail(PM_DATA, "the volumes on '%s' make a width of %g (--eps LENGTH)", j->set, s->eps);
}

/* Component c of the strength, or of a value times volume, and zeros for the points. */
static void strengths(const struct pm_frame *f, const struct job *j, int c, size_t sources, size_t points, double *q)
{
	const struct pm_field *g = pm_frame_field(f, j->set, j->field), *volume = pm_frame_field(f, j->set, "volume");
	for (size_t i = 0; i < sources; i++)
		q[i] = pm_in(g, c)[i] * (g->extensive ? 1 : pm_in(volume, 0)[i]);
	for (size_t i = 0; i < points; i++)
		q[sources + i] = 0;
}

/* Room for the sums that an operator makes at n points. */
static double *room_for(struct pm_sample *s, enum pm_sample_operator operator, size_t n, double *of[PM_SAMPLE_SUMS])
{
	s->operator = operator;
	double *room = pm_alloc((size_t)pm_sample_components(s) * n + 1, sizeof *room);
	for (int c = 0; c < pm_sample_components(s); c++)
		of[c] = room ? room + (size_t)c * n : NULL;
	return room;
}

/* Every component of the target, corrected by the moments of the volumes. */
static int correct(const struct pm_frame *f, const struct job *j, struct pm_sample s, const struct pm_cell_list *l, size_t sources, double *q,
	struct pm_field *target, size_t *bare)
{
	const bool slopes = j->correction == PM_SAMPLE_LINEAR;
	const size_t points = target->count;
	const enum pm_sample_operator first = slopes ? PM_SAMPLE_FIRST : PM_SAMPLE_VALUE;
	double *moment[PM_SAMPLE_SUMS], *sum[PM_SAMPLE_SUMS], *moments = room_for(&s, slopes ? PM_SAMPLE_SECOND : PM_SAMPLE_VALUE, points, moment);
	int status = moments ? 0 : pm_failed();
	for (size_t i = 0; i < sources + points; i++)
		q[i] = i < sources ? pm_in(pm_frame_field(f, j->set, "volume"), 0)[i] : 0;
	s.even = true;
	status = status ? status : pm_sample_sum(&s, l, q, sources, points, moment);
	s.even = false;
	double *sums = room_for(&s, first, points, sum);
	status = status ? status : sums ? 0 : pm_failed();
	for (int c = 0; c < target->components && !status; c++) {
		strengths(f, j, c, sources, points, q);
		status = pm_sample_sum(&s, l, q, sources, points, sum);
		if (!status)
			pm_sample_correct(j->correction, s.dim, points, (const double *const *)sum, (const double *const *)moment, pm_out(target, c), bare);
	}
	pm_free(moments), pm_free(sums);
	return status;
}

int pm_sample_apply(const struct pm_sample_choice *o, struct pm_frame *f, struct pm_sample_found *found)
{
	struct job j;
	struct pm_sample s;
	struct pm_cell_list list = {.n = 0};
	double *x[3] = {NULL}, *q = NULL;
	int status = find(o, f, &j);
	*found = (struct pm_sample_found){0};
	if (status)
		return status;
	struct pm_field *target = pm_frame_field(f, j.on, o->target);
	const size_t sources = pm_frame_set(f, j.set)->n, points = target->count;
	if (!sources || !points)
		return 0; /* the new field is 0 */
	const struct pm_domain domain = pm_domain_of(f);
	if (!(status = choose(o, f, &j, sources, &s)) && !(status = positions(&j, f, sources, points, x)))
		status = pm_cell_list_init(&list, &domain, sources + points, (const double *const *)x, s.reach, 0.25 * s.reach);
	if (!status && !(q = pm_alloc(sources + points, sizeof *q)))
		status = -PM_DATA;
	if (!status && j.correction)
		status = correct(f, &j, s, &list, sources, q, target, &found->bare);
	for (int c = 0; c < (s.operator == PM_SAMPLE_GRAD ? 1 : target->components) && !status && !j.correction; c++) {
		double *out[3] = {pm_out(target, c)};
		for (int d = 1; d < f->dim && s.operator == PM_SAMPLE_GRAD; d++)
			out[d] = pm_out(target, d);
		strengths(f, &j, c, sources, points, q);
		status = pm_sample_sum(&s, &list, q, sources, points, out);
	}
	found->eps = s.eps;
	pm_cell_list_free(&list);
	pm_free(x[0]), pm_free(x[1]), pm_free(x[2]), pm_free(q);
	return status;
}
