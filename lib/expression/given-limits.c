/* How fast a given rate makes its state decay, oscillate and strain, from its derivatives by that state at up to 64 particles of the set, by central
 * differences. acc: decay -d acc_k/d v_k; oscillation sqrt(-d acc_k/d x_k), and |d acc_k/d v_l - d acc_l/d v_k|/2 of a rotation. vel: strain, the largest row
 * sum of |d vel/d x|, as of a flow on a mesh. Any other: decay -d rate_k/d state_k. Diagonal elements never exceed the largest eigenvalue of a symmetric
 * matrix, so no step is refused that would be stable. Where differences of two widths disagree (a jump) the element is left out.
 * Cost: a few hundred evaluations of the expression at single particles, whatever N. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "expression/given-limits.h"
#include "stream/limits.h"
#include "world/world.h"

enum { most_sampled = 64, axes = 3 };

/* The expression at one particle, as a function of its values. */
struct point {
	struct pm_expression e; /* of one part, its values by slots */
	double value[PM_EXPRESSION_VALUES];
};

static double value_at(const struct pm_frame *f, const char *on, const struct pm_expression_value *v, size_t i)
{
	const struct pm_field *field = pm_frame_field(f, on, v->field);
	return field->type == PM_I64 ? (double)pm_in_i64(field, v->component)[i] : field->type == PM_U8 ? pm_in_u8(field, v->component)[i] :
		pm_in(field, v->component)[i];
}

static double difference(struct point *p, int j, double width)
{
	const double here = p->value[j];
	p->value[j] = here + width;
	const double above = pm_expression_number(&p->e, p->value);
	p->value[j] = here - width;
	const double below = pm_expression_number(&p->e, p->value);
	p->value[j] = here;
	return (above - below) / (2 * width);
}

/* d(part)/d(component c of a field); 0 if it is not read. The width 1e-5 leaves 1e-10 of truncation and 1e-11 of rounding, relative to a smooth expression. */
static double derivative(struct point *p, const char *field, int c)
{
	for (int j = 0; j < p->e.nvalues; j++)
		if (!strcmp(p->e.value[j].field, field) && p->e.value[j].component == c) {
			const double width = 1e-5 * (p->value[j] != 0 ? fabs(p->value[j]) : 1);
			const double wide = difference(p, j, width), narrow = difference(p, j, width / 2);
			return fabs(wide - narrow) <= 0.01 * fabs(wide) ? wide : 0;
		}
	return 0;
}

/* d rate_k/d (component l of a field) at particle i. */
static void jacobian(const struct pm_expression_job *job, const struct pm_frame *f, const char *field, size_t i, int n, double J[axes][axes])
{
	struct point p = {.e = job->e};
	for (int j = 0; j < p.e.nvalues; j++) {
		p.value[j] = value_at(f, p.e.on, p.e.value + j, i);
		p.e.value[j].slot = j + 1;
	}
	for (int k = 0; k < n; k++) {
		p.e.part[0] = job->e.part[k], p.e.part[1] = job->e.part[k + 1];
		for (int l = 0; l < n; l++)
			J[k][l] = derivative(&p, field, l);
	}
}

static void at(const struct pm_expression_job *job, const struct pm_frame *f, size_t i, struct pm_limits *most)
{
	const int n = job->e.nparts < axes ? job->e.nparts : axes;
	const bool acc = !strcmp(job->field->of, "v"), vel = !strcmp(job->field->of, "x");
	double J[axes][axes], K[axes][axes];
	jacobian(job, f, job->field->of, i, n, J);
	if (acc)
		jacobian(job, f, "x", i, n, K);
	for (int k = 0; k < n; k++) {
		double row = 0;
		for (int l = 0; l < n; l++) {
			row += fabs(J[k][l]);
			if (acc)
				most->oscillation = fmax(most->oscillation, fabs(J[k][l] - J[l][k]) / 2);
		}
		if (vel)
			most->strain = fmax(most->strain, row);
		else
			most->decay = fmax(most->decay, -J[k][k]);
		if (acc)
			most->oscillation = fmax(most->oscillation, sqrt(fmax(0, -K[k][k])));
	}
}

/* The particles that are looked at are chosen among all; each rank looks at its own. */
int pm_given_limits_add(int status, const struct pm_expression_job *job, const struct pm_frame *f)
{
	const struct pm_set *set = pm_frame_set(f, job->e.on);
	const size_t here = job->field->count, n = set ? set->n : here, sampled = n < most_sampled ? n : most_sampled;
	struct pm_limits most = {0};
	bool state = false;
	for (int j = 0; j < job->e.nvalues; j++) {
		const struct pm_field *read = pm_frame_field(f, job->e.on, job->e.value[j].field);
		if (!read)
			return pm_world_agree(status);
		state = state || !strcmp(read->name, job->field->of) || !strcmp(read->name, "x");
	}
	for (size_t k = 0; k < sampled && state && !status; k++) {
		const size_t i = k * n / sampled;
		if (i >= job->field->first && i - job->field->first < here)
			at(job, f, i - job->field->first, &most);
	}
	double all[] = {most.decay, most.oscillation, most.strain};
	status = pm_world_largest(status, 3, all);
	pm_limits_add(job->field, (struct pm_limits){all[0], all[1], all[2]});
	return status;
}
