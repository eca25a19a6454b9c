/* Evaluates a compiled expression: a stack machine whose stack holds blocks of 128 values, so that decoding a step is paid once per block, the loops are
 * vectorised, and a thread with a small stack has room for it (16 kB). Blocks are independent, so threads do not change the result. Cost: about 1 ns a value
 * for arithmetic, 5 to 20 for a function.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "expression/expression.h"
#include "expression/expression-steps.h"

enum { block = 128, several = 1024 }; /* values of a block; from there on threads share them */

static double sign_of(double x) { return (x > 0) - (x < 0); }
static double modulo(double a, double b) { return a - b * floor(a / b); }

const struct pm_expression_function pm_expression_functions[] = {
	{"sqrt", 1, sqrt, NULL}, {"cbrt", 1, cbrt, NULL}, {"exp", 1, exp, NULL}, {"log", 1, log, NULL}, {"log10", 1, log10, NULL}, {"sin", 1, sin, NULL},
	{"cos", 1, cos, NULL}, {"tan", 1, tan, NULL}, {"asin", 1, asin, NULL}, {"acos", 1, acos, NULL}, {"atan", 1, atan, NULL}, {"sinh", 1, sinh, NULL},
	{"cosh", 1, cosh, NULL}, {"tanh", 1, tanh, NULL}, {"abs", 1, fabs, NULL}, {"sign", 1, sign_of, NULL}, {"floor", 1, floor, NULL},
	{"ceil", 1, ceil, NULL},
	{"round", 1, round, NULL}, {"erf", 1, erf, NULL}, {"erfc", 1, erfc, NULL}, {"gamma", 1, tgamma, NULL}, {"atan2", 2, NULL, atan2}, {"pow", 2, NULL, pow},
	{"mod", 2, NULL, modulo}, {"hypot", -1, NULL, hypot}, {"min", -1, NULL, fmin}, {"max", -1, NULL, fmax}, {0}};

/* The number of the first point of a mesh on this rank. */
static uint64_t first_here(const struct pm_frame *f, const char *on)
{
	for (size_t i = 0; i < f->nfields; i++)
		if (f->fields[i]->here && !strcmp(f->fields[i]->on, on))
			return f->fields[i]->first;
	return 0;
}

/* A field that the stage drops can still be read. */
static const struct pm_field *to_read(const struct pm_frame *f, const char *on, const char *name)
{
	const struct pm_field *field = pm_frame_field(f, on, name);
	for (size_t i = f->ndropped; i-- > 0 && !field;)
		if (!strcmp(f->dropped[i]->name, name) && !strcmp(f->dropped[i]->on, on))
			field = f->dropped[i];
	return field;
}

/* Of the points index[first] ..., or first ... */
static void load(const struct pm_expression_value *v, const struct pm_frame *f, const char *on, const size_t *index, size_t first, size_t n, double *out)
{
	if (*v->field) {
		const struct pm_field *field = to_read(f, on, v->field);
		if (field->type == PM_I64)
			for (size_t i = 0; i < n; i++)
				out[i] = (double)pm_in_i64(field, v->component)[index ? index[first + i] : first + i];
		else if (field->type == PM_U8)
			for (size_t i = 0; i < n; i++)
				out[i] = pm_in_u8(field, v->component)[index ? index[first + i] : first + i];
		else if (index)
			for (size_t i = 0; i < n; i++)
				out[i] = pm_in(field, v->component)[index[first + i]];
		else
			memcpy(out, pm_in(field, v->component) + first, n * sizeof *out);
		return;
	}
	const struct pm_mesh *m = pm_frame_mesh(f, on);
	size_t points[3], stride = 1;
	pm_mesh_points(f, m, points);
	const size_t here = (size_t)first_here(f, on);
	for (int a = 0; a < v->axis; a++)
		stride *= points[a];
	for (size_t i = 0; i < n; i++)
		out[i] = m->lo[v->axis] + (double)((here + (index ? index[first + i] : first + i)) / stride % points[v->axis]) * m->h[v->axis];
}

#define EACH(expression)                   \
	for (size_t i = 0; i < n; i++)         \
		a[i] = (expression);               \
	break

/* Two operands: a is the deeper one and takes the result. */
static void binary(enum pm_expression_code code, const struct pm_expression_function *fn, size_t n, double *restrict a, const double *restrict b)
{
	switch (code) {
	case PM_X_ADD: EACH(a[i] + b[i]);
	case PM_X_SUBTRACT: EACH(a[i] - b[i]);
	case PM_X_MULTIPLY: EACH(a[i] * b[i]);
	case PM_X_DIVIDE: EACH(a[i] / b[i]);
	case PM_X_POWER: EACH(pow(a[i], b[i]));
	case PM_X_LESS: EACH(a[i] < b[i]);
	case PM_X_LESS_EQUAL: EACH(a[i] <= b[i]);
	case PM_X_GREATER: EACH(a[i] > b[i]);
	case PM_X_GREATER_EQUAL: EACH(a[i] >= b[i]);
	case PM_X_EQUAL: EACH(a[i] == b[i]);
	case PM_X_UNEQUAL: EACH(a[i] != b[i]);
	case PM_X_AND: EACH(a[i] != 0 && b[i] != 0);
	case PM_X_OR: EACH(a[i] != 0 || b[i] != 0);
	default: EACH(fn->two(a[i], b[i]));
	}
}

static void unary(enum pm_expression_code code, const struct pm_expression_function *fn, size_t n, double *restrict a)
{
	switch (code) {
	case PM_X_NEGATE: EACH(-a[i]);
	case PM_X_NOT: EACH(a[i] == 0);
	case PM_X_SQUARE: EACH(a[i] * a[i]);
	default: EACH(fn->one(a[i]));
	}
}

/* Leaves the result of part k in stack[0]. number: the values of the slots (n is 1), or NULL. */
static void block_eval(const struct pm_expression *e, const struct pm_frame *f, const double *number, int k, const size_t *index, size_t first,
	size_t n, double (*stack)[block])
{
	int top = -1;
	for (int s = e->part[k]; s < e->part[k + 1]; s++) {
		const struct pm_expression_step *step = e->step + s;
		const struct pm_expression_function *fn = step->code == PM_X_FUNCTION ? pm_expression_functions + step->value : NULL;
		double *a;
		if (step->code == PM_X_NUMBER)
			for (a = stack[++top]; a < stack[top] + n; a++)
				*a = step->number;
		else if (step->code == PM_X_VALUE && number)
			*stack[++top] = number[e->value[step->value].slot - 1];
		else if (step->code == PM_X_VALUE)
			load(e->value + step->value, f, e->on, index, first, n, stack[++top]);
		else if (step->code == PM_X_CHOOSE) {
			top -= 2;
			for (size_t i = 0; i < n; i++)
				stack[top][i] = stack[top][i] != 0 ? stack[top + 1][i] : stack[top + 2][i];
		} else if (step->code == PM_X_NEGATE || step->code == PM_X_NOT || step->code == PM_X_SQUARE || (fn && fn->one))
			unary((enum pm_expression_code)step->code, fn, n, stack[top]);
		else {
			top--;
			binary((enum pm_expression_code)step->code, fn, n, stack[top], stack[top + 1]);
		}
	}
}

void pm_expression_eval_at(const struct pm_expression *e, const struct pm_frame *f, int k, size_t n, const size_t *index, double *out)
{
#pragma omp parallel for if (n > several)
	for (size_t first = 0; first < n; first += block) {
		double stack[PM_EXPRESSION_DEPTH][block];
		size_t here = n - first < block ? n - first : block;
		block_eval(e, f, NULL, k, index, first, here, stack);
		memcpy(out + first, stack[0], here * sizeof *out);
	}
}

void pm_expression_eval(const struct pm_expression *e, const struct pm_frame *f, int k, size_t n, double *out)
{
#pragma omp parallel for
	for (size_t first = 0; first < n; first += block) {
		double stack[PM_EXPRESSION_DEPTH][block];
		size_t here = n - first < block ? n - first : block;
		block_eval(e, f, NULL, k, NULL, first, here, stack);
		memcpy(out + first, stack[0], here * sizeof *out);
	}
}

void pm_expression_assign(const struct pm_expression *e, const struct pm_frame *f, struct pm_field *field)
{
	size_t n = field->count;
#pragma omp parallel for
	for (size_t first = 0; first < n; first += block) {
		double stack[PM_EXPRESSION_DEPTH][block], result[PM_EXPRESSION_PARTS][block];
		size_t here = n - first < block ? n - first : block;
		for (int k = 0; k < e->nparts; k++) {
			block_eval(e, f, NULL, k, NULL, first, here, stack);
			memcpy(result[k], stack[0], here * sizeof(double));
		}
		for (int k = 0; k < e->nparts; k++)
			memcpy(pm_out(field, k) + first, result[k], here * sizeof(double));
	}
}

double pm_expression_number(const struct pm_expression *e, const double *number)
{
	double stack[PM_EXPRESSION_DEPTH][block];
	block_eval(e, NULL, number, 0, NULL, 0, 1, stack);
	return stack[0][0];
}
