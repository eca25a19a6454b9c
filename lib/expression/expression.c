/* Arithmetic over the values of fields. The text is compiled by recursive descent into steps for a stack machine (expression-eval.c).
 *   choice := or ['?' choice ':' choice]; or := and {'||' and}; and := compare {'&&' compare}; compare := sum [('<' | '<=' | '>' | '>=' | '==' | '!=') sum]
 *   sum := product {('+' | '-') product}; product := sign {('*' | '/') sign}; sign := ['-' | '+' | '!'] sign | power; power := atom ['^' sign]
 * Truth is 1, falsehood 0; both sides of && || ?: are computed. -x^2 is -(x^2), 2^3^2 is 2^(3^2), a < b < c is refused.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/decimal.h"
#include "expression/expression.h"
#include "expression/expression-steps.h"

struct parser {
	struct pm_expression *e;
	struct pm_frame *f; /* NULL: names are those of slot */
	int (*slot)(void *context, const char *name);
	void *context;
	const char *what;
	const char *text, *at;
	int depth, nesting;
	bool failed;
	int code; /* code of the failure */
};

/* A byte that a name may contain: letters of all alphabets are allowed. */
static bool letter(char c) { return isalpha((unsigned char)c) || c == '_' || (unsigned char)c >= 0x80; }

/* Number of characters in n bytes of UTF-8. */
static int letters(const char *s, const char *end)
{
	int n = 0;
	for (; s < end; s++)
		n += ((unsigned char)*s & 0xC0) != 0x80;
	return n;
}

/* One line: the column, what is wrong, and the text with the place marked. */
static void wrong(struct parser *p, const char *at, const char *what, const char *name, int length)
{
	if (!p->failed)
		pm_fail(p->code, "column %d: %s%.*s%s: %.*s <here> %s", letters(p->text, at) + 1, what, length, name, length ? "'" : "", (int)(at - p->text),
			p->text, at);
	p->failed = true;
}

static char peek(struct parser *p)
{
	while (isspace((unsigned char)*p->at))
		p->at++;
	return *p->at;
}

static bool take(struct parser *p, const char *word)
{
	size_t n = strlen(word);
	peek(p);
	if (strncmp(p->at, word, n))
		return false;
	p->at += n;
	return true;
}

static void emit(struct parser *p, enum pm_expression_code code, int value, double number, int grows)
{
	struct pm_expression *e = p->e;
	if (e->nsteps == PM_EXPRESSION_STEPS || p->depth + grows > PM_EXPRESSION_DEPTH) {
		wrong(p, p->at, "the expression is too long or too deep (write it in two)", "", 0);
		return;
	}
	e->step[e->nsteps++] = (struct pm_expression_step){code, value, number};
	p->depth += grows;
	if (p->depth > e->depth)
		e->depth = p->depth;
}

static bool same(const char *name, const char *s, size_t length) { return strlen(name) == length && !strncmp(name, s, length); }

static struct pm_field *field_named(const struct parser *p, const char *s, size_t length)
{
	for (size_t i = 0; i < p->f->nfields; i++)
		if (!strcmp(p->f->fields[i]->on, p->e->on) && same(p->f->fields[i]->name, s, length))
			return p->f->fields[i];
	return NULL;
}

static int axis_of(char c) { return c >= 'x' && c <= 'z' ? c - 'x' : -1; }

/* The field and component a name stands for; false if none. */
static bool as_component(struct parser *p, const char *s, size_t n, struct pm_expression_value *v)
{
	struct pm_field *field = field_named(p, s, n);
	size_t k = n;
	int c = 0;
	if (n == 1 && axis_of(*s) >= 0 && pm_frame_set(p->f, p->e->on) && (field = field_named(p, "x", 1)) && axis_of(*s) < field->components)
		c = axis_of(*s);
	else if (field && field->components == 1)
		c = 0;
	else if (n > 1 && axis_of(s[n - 1]) >= 0) {
		k = n - 1 - (s[n - 2] == '.' || s[n - 2] == '_');
		field = field_named(p, s, k);
		c = axis_of(s[n - 1]);
	} else {
		while (k > 0 && isdigit((unsigned char)s[k - 1]))
			k--;
		if (k < 2 || k == n || n - k > 2 || (s[k - 1] != '_' && s[k - 1] != '.'))
			return false;
		field = field_named(p, s, k - 1);
		c = atoi(s + k);
	}
	if (!field || c >= field->components)
		return false;
	*v = (struct pm_expression_value){.component = c, .axis = -1};
	memcpy(v->field, field->name, PM_NAME);
	field->use |= PM_USE_READ;
	return true;
}

static bool as_number(const struct parser *p, const char *s, size_t n, double *x)
{
	const struct pm_frame *f = p->f;
	const struct pm_set *set = pm_frame_set(f, p->e->on);
	size_t points[3];
	const struct { const char *name; double value; } known[] = {{"time", f->time}, {"dt", f->dt}, {"step", (double)f->step}, {"dim", f->dim}, {"pi", pm_pi},
		{"n", set ? (double)set->n : (double)pm_mesh_points(f, pm_frame_mesh(f, p->e->on), points)},
		{"Lx", f->hi[0] - f->lo[0]}, {"Ly", f->hi[1] - f->lo[1]}, {"Lz", f->hi[2] - f->lo[2]}};
	char name[PM_NAME];
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (same(known[i].name, s, n))
			return *x = known[i].value, true;
	snprintf(name, sizeof name, "%.*s", (int)n, s);
	*x = pm_frame_constant(f, name, NAN);
	return !isnan(*x);
}

static void unknown(struct parser *p, const char *s, size_t n)
{
	char list[256] = "no field or number '";
	const struct pm_field *field = field_named(p, s, n);
	char what[320];
	snprintf(list + strlen(list), sizeof list - strlen(list), "%.*s' (on '%s' there is", n < 60 ? (int)n : 60, s, p->e->on);
	for (size_t i = 0; i < p->f->nfields; i++)
		if (!strcmp(p->f->fields[i]->on, p->e->on) && strlen(list) < 180)
			snprintf(list + strlen(list), sizeof list - strlen(list), " %s", p->f->fields[i]->name);
	if (field)
		snprintf(what, sizeof what, "'%s' has %d components (choose one: %s_0, %s.x)", field->name, field->components, field->name, field->name);
	else
		snprintf(what, sizeof what, "%s)", list);
	p->code = PM_DATA;
	wrong(p, s, what, "", 0);
}

/* Compiles a name of a slot, a coordinate or a field; false: it was a number, or unknown. */
static bool value_named(struct parser *p, const char *s, size_t n, struct pm_expression_value *v)
{
	double x;
	if (!p->f) {
		char name[2 * PM_NAME], message[3 * PM_NAME];
		snprintf(name, sizeof name, "%.*s", (int)n, s);
		*v = (struct pm_expression_value){.axis = -1, .slot = n < sizeof name ? p->slot(p->context, name) : 0};
		snprintf(message, sizeof message, "no %s '", p->what);
		if (!v->slot && same("pi", s, n))
			return emit(p, PM_X_NUMBER, 0, pm_pi, 1), false;
		if (!v->slot)
			wrong(p, s, message, s, (int)n);
		return v->slot;
	}
	if (pm_frame_mesh(p->f, p->e->on) && !pm_frame_set(p->f, p->e->on) && n == 1 && axis_of(*s) >= 0 && axis_of(*s) < p->f->dim)
		return *v = (struct pm_expression_value){.axis = axis_of(*s)}, true;
	if (as_component(p, s, n, v))
		return true;
	if (as_number(p, s, n, &x))
		emit(p, PM_X_NUMBER, 0, x, 1);
	else
		unknown(p, s, n);
	return false;
}

static void variable(struct parser *p, const char *s, size_t n)
{
	struct pm_expression *e = p->e;
	struct pm_expression_value v;
	if (!value_named(p, s, n, &v))
		return;
	for (int i = 0; i < e->nvalues; i++)
		if (!strcmp(e->value[i].field, v.field) && e->value[i].component == v.component && e->value[i].axis == v.axis && e->value[i].slot == v.slot) {
			emit(p, PM_X_VALUE, i, 0, 1);
			return;
		}
	if (e->nvalues == PM_EXPRESSION_VALUES) {
		wrong(p, s, "too many different fields (write it in two)", "", 0);
		return;
	}
	e->value[e->nvalues] = v;
	emit(p, PM_X_VALUE, e->nvalues++, 0, 1);
}

static void choice(struct parser *p);

static void call(struct parser *p, const char *s, size_t n)
{
	int k = 0, arguments = 0;
	while (pm_expression_functions[k].name && !same(pm_expression_functions[k].name, s, n))
		k++;
	if (!pm_expression_functions[k].name) {
		wrong(p, s, "no function '", s, (int)n);
		return;
	}
	do {
		choice(p);
		if (++arguments > 1 && pm_expression_functions[k].arguments < 0)
			emit(p, PM_X_FUNCTION, k, 0, -1);
	} while (!p->failed && take(p, ","));
	if (!p->failed && !take(p, ")"))
		wrong(p, p->at, "expected ')' or ',' in the call of '", s, (int)n);
	if (pm_expression_functions[k].arguments > 0 && arguments != pm_expression_functions[k].arguments)
		wrong(p, s, pm_expression_functions[k].arguments == 1 ? "one argument is needed in '" : "two arguments are needed in '", s, (int)n);
	if (pm_expression_functions[k].arguments < 0 && arguments < 2)
		wrong(p, s, "two arguments or more are needed in '", s, (int)n);
	if (pm_expression_functions[k].arguments > 0)
		emit(p, PM_X_FUNCTION, k, 0, 1 - arguments);
}

static void atom(struct parser *p)
{
	char c = peek(p);
	const char *s = p->at;
	double x;
	size_t n;
	if (take(p, "(")) {
		choice(p);
		if (!p->failed && !take(p, ")"))
			wrong(p, p->at, "expected ')'", "", 0);
	} else if ((isdigit((unsigned char)c) || c == '.') && (n = pm_decimal_read(s, &x))) {
		p->at += n;
		emit(p, PM_X_NUMBER, 0, x, 1);
	} else if (letter(c)) {
		for (n = 0; letter(s[n]) || isdigit((unsigned char)s[n]) || s[n] == '.';)
			n++;
		p->at += n;
		take(p, "(") ? call(p, s, n) : variable(p, s, n);
	} else
		wrong(p, s, c ? "expected a number, a name or '('" : "the expression stops here", "", 0);
}

static void sign(struct parser *p);

static void power(struct parser *p)
{
	atom(p);
	if (p->failed || !take(p, "^"))
		return;
	int first = p->e->nsteps;
	sign(p);
	struct pm_expression_step *last = p->e->step + p->e->nsteps - 1;
	if (!p->failed && p->e->nsteps == first + 1 && last->code == PM_X_NUMBER && last->number == 2) {
		p->e->nsteps--, p->depth--; /* a square as a product: the same result as pow, ten times faster */
		emit(p, PM_X_SQUARE, 0, 0, 0);
	} else
		emit(p, PM_X_POWER, 0, 0, -1);
}

static void sign(struct parser *p)
{
	char c = peek(p);
	if (++p->nesting > 200)
		wrong(p, p->at, "too deep", "", 0);
	if (p->failed)
		return;
	if (c == '-' || c == '+' || (c == '!' && p->at[1] != '=')) {
		p->at++;
		sign(p);
		if (c != '+')
			emit(p, c == '-' ? PM_X_NEGATE : PM_X_NOT, 0, 0, 0);
	} else
		power(p);
	p->nesting--;
}

static void product(struct parser *p)
{
	sign(p);
	for (char c; !p->failed && ((c = peek(p)) == '*' || c == '/');) {
		p->at++;
		sign(p);
		emit(p, c == '*' ? PM_X_MULTIPLY : PM_X_DIVIDE, 0, 0, -1);
	}
}

static void sum(struct parser *p)
{
	product(p);
	for (char c; !p->failed && ((c = peek(p)) == '+' || c == '-');) {
		p->at++;
		product(p);
		emit(p, c == '+' ? PM_X_ADD : PM_X_SUBTRACT, 0, 0, -1);
	}
}

static int comparison(struct parser *p)
{
	static const struct {
		const char *sign;
		enum pm_expression_code code;
	} signs[] = {{"<=", PM_X_LESS_EQUAL}, {">=", PM_X_GREATER_EQUAL}, {"==", PM_X_EQUAL}, {"!=", PM_X_UNEQUAL}, {"<", PM_X_LESS}, {">", PM_X_GREATER}};
	for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
		if (take(p, signs[i].sign))
			return signs[i].code;
	return -1;
}

static void compare(struct parser *p)
{
	sum(p);
	int code = p->failed ? -1 : comparison(p);
	if (code < 0)
		return;
	sum(p);
	emit(p, (enum pm_expression_code)code, 0, 0, -1);
	const char *at = p->at;
	if (!p->failed && comparison(p) >= 0)
		wrong(p, at, "comparisons cannot be chained (write a < b && b < c)", "", 0);
}

static void both(struct parser *p)
{
	compare(p);
	while (!p->failed && take(p, "&&")) {
		compare(p);
		emit(p, PM_X_AND, 0, 0, -1);
	}
}

static void either(struct parser *p)
{
	both(p);
	while (!p->failed && take(p, "||")) {
		both(p);
		emit(p, PM_X_OR, 0, 0, -1);
	}
}

static void choice(struct parser *p)
{
	if (++p->nesting > 200)
		wrong(p, p->at, "too deep", "", 0);
	either(p);
	if (!p->failed && take(p, "?")) {
		choice(p);
		if (!p->failed && !take(p, ":"))
			wrong(p, p->at, "expected ':'", "", 0);
		choice(p);
		emit(p, PM_X_CHOOSE, 0, 0, -2);
	}
	p->nesting--;
}

static int compile(struct parser *p)
{
	struct pm_expression *e = p->e;
	do {
		if (e->nparts == PM_EXPRESSION_PARTS)
			wrong(p, p->at, "too many components", "", 0);
		else
			e->part[e->nparts++] = e->nsteps;
		p->depth = 0;
		if (!p->failed)
			choice(p);
	} while (!p->failed && take(p, ","));
	e->part[e->nparts] = e->nsteps;
	if (!p->failed && peek(p))
		wrong(p, p->at, "expected an operator or the end", "", 0);
	return p->failed ? -p->code : 0;
}

int pm_expression_compile(struct pm_expression *e, struct pm_frame *f, const char *on, const char *text)
{
	struct parser p = {.e = e, .f = f, .text = text, .at = text, .code = PM_USAGE};
	memset(e, 0, sizeof *e);
	snprintf(e->on, PM_NAME, "%s", on);
	if (!pm_frame_set(f, on) && !pm_frame_mesh(f, on))
		return pm_fail(PM_DATA, "no set or mesh '%s' (sls lists what there is)", on);
	return compile(&p);
}

int pm_expression_compile_numbers(struct pm_expression *e, int (*slot)(void *context, const char *name), void *context, const char *what, const char *text)
{
	struct parser p = {.e = e, .slot = slot, .context = context, .what = what, .text = text, .at = text, .code = PM_USAGE};
	memset(e, 0, sizeof *e);
	const int status = compile(&p);
	return status || e->nparts == 1 ? status : pm_fail(PM_USAGE, "one expression is needed, not %d separated by commas: %s", e->nparts, text);
}

int pm_expression_named(const char *text, char name[PM_NAME], const char **expression)
{
	size_t n = 0, k;
	while (isspace((unsigned char)*text))
		text++;
	while (isalnum((unsigned char)text[n]) || text[n] == '_' || text[n] == '-' || (unsigned char)text[n] >= 0x80)
		n++;
	for (k = n; isspace((unsigned char)text[k]);)
		k++;
	if (!n || n >= PM_NAME || isdigit((unsigned char)*text) || text[k] != '=' || text[k + 1] == '=')
		return pm_fail(PM_USAGE, "'%s' is not NAME = EXPRESSION", text);
	snprintf(name, PM_NAME, "%.*s", (int)n, text);
	*expression = text + k + 1;
	return 0;
}
