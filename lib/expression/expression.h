/* Arithmetic over the values of fields, as people type it: "sqrt(vx^2 + vy^2)", "x < 0.5 && mass > 0" (docs/methods/expressions.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EXPRESSION_H
#define PM_EXPRESSION_H

#include "stream/frame.h"

enum { PM_EXPRESSION_STEPS = 256, PM_EXPRESSION_VALUES = 32, PM_EXPRESSION_DEPTH = 16, PM_EXPRESSION_PARTS = PM_COMPONENTS };

/* A name in an expression: a component of a field, a coordinate of a mesh point, or a number of the frame. */
struct pm_expression_value {
	char field[PM_NAME]; /* "" none */
	int component;
	int axis;            /* of the mesh point, -1 none */
	int slot;            /* from 1: index of a number supplied by the caller; 0 none */
};

struct pm_expression {
	char on[PM_NAME];    /* the set or mesh */
	int nsteps, nvalues, depth;
	int nparts, part[PM_EXPRESSION_PARTS + 1]; /* "a, b, c" has three parts: part[k] is the first step of the k-th */
	struct pm_expression_step {
		int code, value;
		double number;
	} step[PM_EXPRESSION_STEPS];
	struct pm_expression_value value[PM_EXPRESSION_VALUES];
};

/* "NAME = EXPRESSION": the name, and where the expression starts. */
int pm_expression_named(const char *text, char name[PM_NAME], const char **expression);
/* Compiles text for the fields of `on` and marks the fields that it reads. 0, or failure with the column in the message. Names: the components of x are x y
 * z, of v vx vy vz, of any field NAME_0 or NAME.x or NAMEx; a field of one component is NAME. On a mesh x y z are the coordinates of the point. time, dt,
 * step, n, dim, pi, Lx Ly Lz, and the constants of the frame by name. */
int pm_expression_compile(struct pm_expression *e, struct pm_frame *f, const char *on, const char *text);
/* Compiles text for numbers supplied by the caller: slot(context, name) returns the index of a name from 1, or 0 if there is no such name (message "no WHAT
 * 'name'"). */
int pm_expression_compile_numbers(struct pm_expression *e, int (*slot)(void *context, const char *name), void *context, const char *what, const char *text);
double pm_expression_number(const struct pm_expression *e, const double *number); /* number[slot - 1] */
/* Part k for every value of the set or mesh; out must not be an input of it. Cost: constant per value; the same bytes for any number of threads. */
void pm_expression_eval(const struct pm_expression *e, const struct pm_frame *f, int k, size_t n, double *out);
/* The same at n chosen values or points alone: those of index, counted from the first one here. */
void pm_expression_eval_at(const struct pm_expression *e, const struct pm_frame *f, int k, size_t n, const size_t *index, double *out);
/* All parts at once into the components of a field that may be an input. */
void pm_expression_assign(const struct pm_expression *e, const struct pm_frame *f, struct pm_field *field);

#endif
