/* Expressions: values, precedence, names, errors. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "expression/expression.h"
#include "stream/run.h"

enum { n = 2500 }; /* three blocks, the last not full */

static struct pm_frame *particles(void)
{
	struct pm_frame *f = pm_frame_new(3);
	pm_frame_constant_set(f, "G", 2.385);
	f->time = 1.5;
	pm_frame_set_new(f, "matter", n);
	struct pm_field *x = pm_makes(f, "matter", "x", 3, PM_STATE), *v = pm_makes(f, "matter", "v", 3, PM_STATE),
		*m = pm_makes(f, "matter", "mass", 1, PM_STATE),
			*acc = pm_makes(f, "matter", "acc", 2, PM_CHANGE), *id = pm_makes(f, "matter", "id", 1, PM_STATE);
	id->type = PM_I64;
	pm_frame_ready(f);
	for (size_t i = 0; i < n; i++) {
		for (int c = 0; c < 3; c++)
			pm_out(x, c)[i] = 0.25 * (double)i + c, pm_out(v, c)[i] = 1.0 / (double)(i + 1) - c;
		pm_out(m, 0)[i] = 1 + (double)(i % 7);
		pm_out(acc, 0)[i] = 3, pm_out(acc, 1)[i] = -4;
		pm_out_i64(id, 0)[i] = (int64_t)i - 5;
	}
	return f;
}

/* The value at particle i, NAN with a printed message if it does not compile. */
static double at(struct pm_frame *f, const char *text, size_t i)
{
	static double out[n];
	struct pm_expression e;
	if (pm_expression_compile(&e, f, "matter", text)) {
		printf("# %s\n", pm_message());
		return NAN;
	}
	pm_expression_eval(&e, f, 0, n, out);
	return out[i];
}

static bool refused(struct pm_frame *f, const char *text, const char *why)
{
	struct pm_expression e;
	if (pm_expression_compile(&e, f, "matter", text) && strstr(pm_message(), why) && !strchr(pm_message(), '\n'))
		return true;
	printf("# %s: %s\n", text, pm_message());
	return false;
}

static void values(struct pm_frame *f)
{
	const struct { const char *text; double want; } cases[] = {{"1 + 2 * 3 ^ 2", 19}, {"-2 ^ 2", -4}, {"2 ^ 3 ^ 2", 512}, {"2 ^ -1", 0.5},
		{"10 - 4 - 3", 3}, {"24 / 4 / 3", 2},
		{"1 < 2 && 2 < 1 || 1", 1}, {"1 || 0 && 0", 1}, {"!0 + !3", 1}, {"1 ? 2 : 0 ? 3 : 4", 2}, {"0 ? 2 : 0 ? 3 : 4", 4}, {"(1, 2)", NAN},
		{"min(3, 1, 2)", 1},
		{"max(3, 1, 2) + hypot(3, 4, 12)", 16}, {"mod(-1, 3)", 2}, {"atan2(1, 1) * 4 / pi", 1}, {"abs(-2.5) + sign(-3) + floor(-0.5)", 0.5},
		{"erf(0.5)", erf(0.5)},
		{"1e3 + .5", 1000.5}, {"3 >= 3 == 1", NAN}, {"(3 >= 3) == 1", 1}, {"2 != 2", 0}, {"log(exp(2)) + cbrt(8)", 4}, {"pow(2, 10)", 1024},
		{"--3", 3}, {"gamma(5)", 24}};
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
		if (!isnan(cases[i].want))
			check_near(at(f, cases[i].text, n - 1), cases[i].want, 4e-15 * fabs(cases[i].want), cases[i].text); /* a few roundings of libm */
}

static void names(struct pm_frame *f)
{
	size_t i = 1717;
	double x = 0.25 * (double)i, vx = 1.0 / (double)(i + 1);
	check(at(f, "x", i) == x && at(f, "y", i) == x + 1 && at(f, "z", i) == x + 2, "x y z are the components of x");
	check(at(f, "vx", i) == vx && at(f, "v.y", i) == vx - 1 && at(f, "v_2", i) == vx - 2 && at(f, "v_z", i) == vx - 2 && at(f, "v.0", i) == vx,
		"vx, v.y, v_2, v_z name components of v");
	check(at(f, "accx + acc_1", i) == -1, "accx and acc_1 name components of acc");
	check(at(f, "mass", i) == 1 + (double)(i % 7) && at(f, "id", i) == (double)i - 5, "mass and id are fields of one component");
	check(at(f, "time", 0) == 1.5 && at(f, "G", 0) == 2.385 && at(f, "n", 0) == n && at(f, "dim", 0) == 3 && at(f, "Lx", 0) == 1,
		"time, G, n, dim and Lx are numbers of the frame");
	check_near(at(f, "sqrt(vx^2 + vy^2 + vz^2)", i), sqrt(vx * vx + (vx - 1) * (vx - 1) + (vx - 2) * (vx - 2)), 1e-15, "a speed");
}

static void errors(struct pm_frame *f)
{
	check(refused(f, "1 +", "column 4: the expression stops here"), "what stops too early is refused at its end");
	check(refused(f, "sqrt(vx^2 + vq)", "column 13: no field or number 'vq'"), "an unknown name is refused at its column");
	check(refused(f, "v + 1", "'v' has 3 components"), "a vector without component is refused");
	check(refused(f, "acc_2", "no field or number"), "a component that does not exist is an error");
	check(refused(f, "sqr(2)", "column 1: no function 'sqr'"), "an unknown function is refused");
	check(refused(f, "atan2(1)", "two arguments") && refused(f, "min(1)", "two arguments") && refused(f, "sin(1, 2)", "one argument"),
		"wrong numbers of arguments are refused");
	check(refused(f, "(1 + 2", "column 7: expected ')'") && refused(f, "1 + 2)", "column 6: expected an operator"), "brackets must match");
	check(refused(f, "1 < 2 < 3", "comparisons cannot be chained"), "a < b < c is refused");
	check(refused(f, "1 $ 2", "column 3: expected an operator") && refused(f, "", "stops here") && refused(f, "1 2", "expected an operator"), "invalid "
		"expressions are errors");
	char deep[600] = "", wide[2000] = "1";
	memset(deep, '(', 500);
	for (int i = 0; i < 300; i++)
		strcat(wide, "+1");
	check(refused(f, deep, "too deep") && refused(f, wide, "too long"), "expressions that are too deep or too long are errors");
	check(refused(f, "1+(2+(3+(4+(5+(6+(7+(8+(9+(1+(2+(3+(4+(5+(6+(7+8)))))))))))))))", "too deep"), "a stack that is too small is detected");
}

static void threads(struct pm_frame *f)
{
	static double one[n], more[n];
	struct pm_expression e;
	pm_expression_compile(&e, f, "matter", "sin(x) * exp(-mass) + vx / (1 + vy^2)");
	pm_threads_use(1);
	pm_expression_eval(&e, f, 0, n, one);
	pm_threads_use(3);
	pm_expression_eval(&e, f, 0, n, more);
	check(!memcmp(one, more, sizeof one), "one thread and three give the same bytes");
}

static void assign(struct pm_frame *f)
{
	struct pm_expression e;
	struct pm_field *x = pm_frame_field(f, "matter", "x");
	double y = pm_in(x, 1)[2000], z = pm_in(x, 2)[2000];
	check(!pm_expression_compile(&e, f, "matter", "y, z, x") && e.nparts == 3, "a list of three has three parts");
	pm_expression_assign(&e, f, x);
	check(pm_in(x, 0)[2000] == y && pm_in(x, 1)[2000] == z, "a field is rewritten from its own components");
}

static void mesh(void)
{
	struct pm_frame *f = pm_frame_new(2);
	size_t cells[3] = {3, 2, 1};
	struct pm_expression e;
	double out[12];
	pm_frame_mesh_new(f, "mesh", cells);
	check(!pm_expression_compile(&e, f, "mesh", "x + 10 * y"), "x and y are the coordinates of mesh points");
	pm_expression_eval(&e, f, 0, 12, out);
	check_near(out[11], 11, 1e-14, "the last point sits at the upper corner");
	check_near(out[5], 1.0 / 3 + 5, 1e-14, "x runs fastest");
	pm_frame_free(f);
}

/* Numbers supplied by the caller, as in cycle --until: a is 1, b is 2. */
static int slot(void *context, const char *name)
{
	(void)context;
	return !strcmp(name, "a") ? 1 : !strcmp(name, "b") ? 2 : 0;
}

static void numbers(void)
{
	struct pm_expression e;
	const double number[] = {3, -4};
	check(!pm_expression_compile_numbers(&e, slot, NULL, "column", "hypot(a, b) > 4.9 && a < pi ? a*b^2 : 0"), "an expression of numbers compiles");
	check_near(pm_expression_number(&e, number), 48, 0, "its value is computed from these numbers");
	check(pm_expression_compile_numbers(&e, slot, NULL, "column", "a + c") == -PM_USAGE && strstr(pm_message(), "column 5: no column 'c'"), "an unknown "
		"name is reported with its column");
	check(pm_expression_compile_numbers(&e, slot, NULL, "column", "a, b") == -PM_USAGE && strstr(pm_message(), "one expression"),
		"two expressions are refused");
}

int main(void)
{
	struct pm_frame *f = particles();
	values(f), names(f), errors(f), threads(f), assign(f), mesh(), numbers();
	pm_frame_free(f);
	return check_done();
}
