/* Positions from a density in one, two or three dimensions, one axis after the other: x from the density integrated over y and z, y from that at this x
 * integrated over z, z from that at this x and y. Between the nodes of the table the density is linear in each variable, and drawn exactly.
 * Source: Rosenblatt 1952, Ann. Math. Stat. 23, 470 (the inverse of his transformation), which keeps low-discrepancy points evenly spread.
 * Table: 65536 intervals in 1-D, 1024^2 in 2-D, 128^3 in 3-D: a jump is as wide as one. Cost log n a value. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "expression/expression.h"
#include "load/density-profile.h"
#include "load/inverse.h"

int pm_density_name(void *context, const char *name)
{
	struct pm_density_names *names = context;
	const struct pm_frame *f = names->f;
	const struct { const char *name; double value; } known[] = {{"time", f->time}, {"dt", f->dt}, {"dim", f->dim},
		{"Lx", f->hi[0] - f->lo[0]}, {"Ly", f->hi[1] - f->lo[1]}, {"Lz", f->hi[2] - f->lo[2]}};
	double value = pm_frame_constant(f, name, NAN);
	int k = 0;
	for (; names->variable[k]; k++)
		if (!strcmp(names->variable[k], name))
			return k + 1;
	for (; k < names->n; k++)
		if (!strcmp(names->name[k], name))
			return k + 1;
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (!strcmp(known[i].name, name))
			value = known[i].value;
	if (isnan(value) || k == (int)(sizeof names->number / sizeof *names->number) || strlen(name) >= PM_NAME)
		return 0;
	snprintf(names->name[k], PM_NAME, "%s", name);
	names->number[k] = value;
	names->n = k + 1;
	return k + 1;
}

static size_t size_of(const struct pm_density_profile *p, int axes)
{
	size_t size = 1;
	for (int d = 0; d < axes; d++)
		size *= p->n[d] + 1;
	return size;
}

/* The values at all nodes; the first that is no density into *bad. */
static void tabulate(struct pm_density_profile *p, const struct pm_expression *e, const struct pm_density_names *names, size_t *bad)
{
	const size_t size = size_of(p, p->dim);
	double *value = p->value[p->dim - 1];
	size_t worst = size;
#pragma omp parallel for schedule(static) reduction(min:worst)
	for (size_t i = 0; i < size; i++) {
		double number[64];
		size_t rest = i;
		memcpy(number, names->number, sizeof number);
		for (int d = p->dim - 1; d >= 0; d--) {
			number[d] = p->lo[d] + (p->hi[d] - p->lo[d]) * (double)(rest % (p->n[d] + 1)) / (double)p->n[d];
			rest /= p->n[d] + 1;
		}
		value[i] = pm_expression_number(e, number);
		if (!(value[i] >= 0 && value[i] < HUGE_VAL) && i < worst)
			worst = i;
	}
	*bad = worst;
}

/* Integrals along the last axis, and the density without it. */
static void integrate(struct pm_density_profile *p, int axis)
{
	const size_t lines = size_of(p, axis), n = p->n[axis];
#pragma omp parallel for schedule(static) if (lines > 64)
	for (size_t i = 0; i < lines; i++) {
		pm_density_integrate(p->value[axis] + i * (n + 1), n, p->sum[axis] + i * (n + 1));
		if (axis)
			p->value[axis - 1][i] = p->sum[axis][i * (n + 1) + n];
	}
}

int pm_density_profile_init(struct pm_density_profile *p, const struct pm_frame *f, const char *text)
{
	static const size_t intervals[4] = {0, 65536, 1024, 128};
	static const char *const axes[4][4] = {{NULL}, {"x", NULL}, {"x", "y", NULL}, {"x", "y", "z", NULL}};
	struct pm_density_names names = {.f = f, .variable = axes[f->dim], .n = f->dim};
	struct pm_expression e;
	size_t bad = 0;
	memset(p, 0, sizeof *p);
	p->dim = f->dim;
	for (int d = 0; d < f->dim; d++)
		p->lo[d] = f->lo[d], p->hi[d] = f->hi[d], p->n[d] = intervals[f->dim];
	if (pm_expression_compile_numbers(&e, pm_density_name, &names, "coordinate or constant", text))
		return -PM_USAGE;
	for (int d = 0; d < f->dim; d++) {
		p->value[d] = pm_alloc(size_of(p, d + 1), sizeof(double));
		p->sum[d] = pm_alloc(size_of(p, d + 1), sizeof(double));
		if (!p->value[d] || !p->sum[d])
			return -PM_DATA;
	}
	tabulate(p, &e, &names, &bad);
	if (bad < size_of(p, p->dim))
		return pm_fail(PM_USAGE, "the density '%s' is %g somewhere in the box, and a density is not negative (max(0, ...))", text,
			p->value[p->dim - 1][bad]);
	for (int d = p->dim - 1; d >= 0; d--)
		integrate(p, d);
	p->total = p->sum[0][p->n[0]];
	for (int d = 0; d < p->dim; d++)
		p->total *= (p->hi[d] - p->lo[d]) / (double)p->n[d];
	return p->total > 0 ? 0 : pm_fail(PM_USAGE, "the density '%s' is 0 everywhere in the box of the frame (sls shows the box)", text);
}

/* Lines of the table around the place on the axes before, with their weights. */
static struct pm_density_columns lines_at(const struct pm_density_profile *p, int axis, const size_t *cell, const double *part)
{
	struct pm_density_columns c = {.columns = 1 << axis};
	for (int k = 0; k < c.columns; k++) {
		size_t line = 0;
		c.weight[k] = 1;
		for (int d = 0; d < axis; d++) {
			const int up = k >> d & 1;
			line = line * (p->n[d] + 1) + cell[d] + (size_t)up;
			c.weight[k] *= up ? part[d] : 1 - part[d];
		}
		c.value[k] = p->value[axis] + line * (p->n[axis] + 1);
		c.sum[k] = p->sum[axis] + line * (p->n[axis] + 1);
	}
	return c;
}

static void split(double at, size_t n, size_t *cell, double *part)
{
	*cell = at >= (double)n ? n - 1 : (size_t)fmax(at, 0);
	*part = at - (double)*cell;
}

void pm_density_profile_at(const struct pm_density_profile *p, const double *u, double *x)
{
	size_t cell[3];
	double part[3];
	for (int d = 0; d < p->dim; d++) {
		const struct pm_density_columns c = lines_at(p, d, cell, part);
		const double at = pm_density_invert(&c, p->n[d], u[d]);
		split(at, p->n[d], &cell[d], &part[d]);
		x[d] = p->lo[d] + (p->hi[d] - p->lo[d]) * (at / (double)p->n[d]);
	}
}

double pm_density_profile_value(const struct pm_density_profile *p, const double *x)
{
	const int last = p->dim - 1;
	size_t cell[3];
	double part[3], sum = 0;
	for (int d = 0; d < p->dim; d++)
		split((x[d] - p->lo[d]) / (p->hi[d] - p->lo[d]) * (double)p->n[d], p->n[d], &cell[d], &part[d]);
	const struct pm_density_columns c = lines_at(p, last, cell, part);
	for (int k = 0; k < c.columns; k++)
		sum += c.weight[k] * ((1 - part[last]) * c.value[k][cell[last]] + part[last] * c.value[k][cell[last] + 1]);
	return sum;
}

void pm_density_profile_free(struct pm_density_profile *p)
{
	for (int d = 0; d < 3; d++)
		pm_free(p->value[d]), pm_free(p->sum[d]);
	memset(p, 0, sizeof *p);
}
