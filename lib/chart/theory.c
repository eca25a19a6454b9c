/* Lines beside the data: of a theory, and of a slope. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "chart/columns.h"
#include "expression/expression.h"

enum { theory_points = 401 };

static int slot_x(void *context, const char *name) { return (void)context, !strcmp(name, "x"); }

static struct pm_chart_series *guide_new(struct pm_chart *c, const char *label)
{
	struct pm_chart_series *s = pm_chart_series_new(c, theory_points);
	if (!s || !(s->label = strdup(label)))
		return s ? pm_no_memory(), NULL : NULL;
	s->style = PM_CHART_LINES, s->colour = -1, s->dashed = true, s->n = theory_points;
	for (size_t k = 0; k + 1 < c->nseries; k++) /* each guide has its own dashes */
		s->mark += c->series[k].colour < 0;
	return s;
}

static double x_at(const struct pm_chart *c, int i)
{
	double low = pm_chart_break(&c->x);
	return pm_chart_value(&c->x, low + (1 - low) * i / (theory_points - 1));
}

/* Where the expression of "NAME = EXPRESSION" begins; the text itself, if it has no name: then = stands in a comparison, or nowhere. */
static const char *behind_name(const char *text)
{
	const char *equal = strchr(text, '=');
	return equal && equal > text && equal[1] != '=' && !strchr("<>!=", equal[-1]) ? equal + 1 : text;
}

static int theory(struct pm_chart *c, const char *text)
{
	char name[256];
	const char *expression = behind_name(text);
	struct pm_expression *e = pm_alloc(1, sizeof *e);
	int n = (int)(expression - text) - 1;
	while (n > 0 && text[n - 1] == ' ')
		n--;
	snprintf(name, sizeof name, "%.*s", n > 0 ? n : (int)strlen(text), text);
	int status = e ? pm_expression_compile_numbers(e, slot_x, NULL, "name but x:", expression) : -PM_DATA;
	struct pm_chart_series *s = status ? NULL : guide_new(c, name);
	for (int i = 0; s && i < theory_points; i++) {
		s->x[i] = x_at(c, i);
		s->y[i] = pm_expression_number(e, &s->x[i]);
	}
	pm_free(e);
	return status ? status : s ? 0 : pm_failed();
}

int pm_chart_theory(struct pm_chart *c, const char *text)
{
	char *copy = strdup(text), *save = NULL;
	int status = copy ? 0 : pm_no_memory();
	for (char *part = copy ? strtok_r(copy, ";", &save) : NULL; part && !status; part = strtok_r(NULL, ";", &save)) {
		part += strspn(part, " ");
		size_t n = strlen(part);
		while (n && part[n - 1] == ' ')
			part[--n] = 0;
		status = n ? theory(c, part) : 0;
	}
	free(copy);
	return status;
}

/* The middle of what is drawn of a series, in the coordinates of the axes. */
static void middle(const struct pm_chart *c, const struct pm_chart_series *s, double at[2])
{
	double sum[2] = {0, 0};
	size_t n = 0;
	for (size_t i = 0; i < s->n; i++) {
		double x = s->x[i], y = s->y[i];
		if (!isfinite(x) || !isfinite(y) || (c->x.log && x <= 0) || (c->y.log && y <= 0))
			continue;
		sum[0] += c->x.log ? log(x) : x, sum[1] += c->y.log ? log(y) : y;
		n++;
	}
	at[0] = sum[0] / (double)n, at[1] = sum[1] / (double)n;
}

int pm_chart_slope(struct pm_chart *c, double slope, int which)
{
	double at[2];
	char label[64];
	snprintf(label, sizeof label, "slope %g", slope);
	middle(c, &c->series[which], at);
	struct pm_chart_series *s = guide_new(c, label);
	for (int i = 0; s && i < theory_points; i++) {
		double x = s->x[i] = x_at(c, i), y = at[1] + slope * ((c->x.log ? log(x) : x) - at[0]);
		s->y[i] = c->y.log ? exp(y) : y;
	}
	return s ? 0 : pm_failed();
}
