/* The steps of a compiled expression; shared by the compiler and the evaluator. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EXPRESSION_STEPS_H
#define PM_EXPRESSION_STEPS_H

enum pm_expression_code {
	PM_X_NUMBER, PM_X_VALUE, PM_X_NEGATE, PM_X_NOT, PM_X_ADD, PM_X_SUBTRACT, PM_X_MULTIPLY, PM_X_DIVIDE, PM_X_POWER, PM_X_SQUARE, PM_X_LESS,
	PM_X_LESS_EQUAL, PM_X_GREATER, PM_X_GREATER_EQUAL, PM_X_EQUAL, PM_X_UNEQUAL, PM_X_AND, PM_X_OR, PM_X_CHOOSE, PM_X_FUNCTION
};

struct pm_expression_function {
	const char *name;
	int arguments; /* -1: two or more, folded from the left */
	double (*one)(double);
	double (*two)(double, double);
};
extern const struct pm_expression_function pm_expression_functions[]; /* NULL ends */

#endif
