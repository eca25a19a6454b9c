/* A plain table as a frame. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "base/decimal.h"
#include "base/in-order.h"
#include "stream/columns.h"
#include "stream/over-stretches.h"
#include "stream/parts.h"
#include "stream/run.h"
#include "world/world.h"

static bool among(const char *name, const char *const *list)
{
	for (; list && *list; list++)
		if (!strcmp(name, *list))
			return true;
	return false;
}

static bool is_strength(const char *name)
{
	static const char *const names[] = {"mass", "charge", "circulation", "alpha", NULL};
	return among(name, names);
}

/* The field and component of a column; component -1: a field with one component. */
static int meaning(const char *name, char field[PM_NAME])
{
	size_t n = strlen(name), k = n;
	if (n == 1 && *name >= 'x' && *name <= 'z')
		return snprintf(field, PM_NAME, "x"), *name - 'x';
	if (n == 2 && *name == 'v' && name[1] >= 'x' && name[1] <= 'z')
		return snprintf(field, PM_NAME, "v"), name[1] - 'x';
	if (n == 7 && !strncmp(name, "alpha_", 6) && name[6] >= 'x' && name[6] <= 'z') /* of vortices in space, as diag writes it */
		return snprintf(field, PM_NAME, "alpha"), name[6] - 'x';
	while (k > 0 && name[k - 1] >= '0' && name[k - 1] <= '9')
		k--;
	if (k > 1 && k < n && n - k < 3 && name[k - 1] == '_') {
		snprintf(field, PM_NAME, "%.*s", (int)k - 1, name);
		return atoi(name + k);
	}
	snprintf(field, PM_NAME, "%s", name);
	return -1;
}

struct plan {
	char field[PM_NAME];
	int component, components; /* of the field, in the entry of its first column */
	int first;                 /* column that holds the entry of the field */
};

static int no_names(void) { return pm_fail(PM_DATA, "no column 'x' (the first line of the table names its columns: x y z vx vy vz mass ...)"); }

/* Groups the columns into fields. */
static int group(int n, const struct pm_table_column *column, const struct pm_columns_choice *choice, struct plan *plan)
{
	double number;
	for (int i = 0; i < n; i++) {
		bool whole = among(column[i].name, choice->text);
		plan[i].component = meaning(column[i].name, plan[i].field);
		if (whole)
			plan[i].component = -1, snprintf(plan[i].field, PM_NAME, "%s", column[i].name);
		plan[i].first = among(column[i].name, choice->skip) ? -1 : i;
		for (int k = 0; k < i && plan[i].first == i; k++)
			if (plan[k].first == k && !strcmp(plan[k].field, plan[i].field)) {
				plan[i].first = k;
				if (plan[i].component < 0 || plan[k].component < 0)
					return pm_decimal_read(column[i].name, &number) ? no_names() :
						pm_fail(PM_DATA, "the columns '%s' and '%s' are the same field", column[k].name, column[i].name);
			}
		if (plan[i].first >= 0)
			plan[plan[i].first].components++;
	}
	for (int i = 0; i < n; i++) { /* each component exactly once */
		unsigned seen = 0;
		if (plan[i].first != i || plan[i].component < 0)
			continue;
		for (int k = i; k < n; k++)
			if (plan[k].first == i && plan[k].component < PM_COMPONENTS)
				seen |= 1u << plan[k].component;
		const bool x = !strcmp(plan[i].field, "x"), v = !strcmp(plan[i].field, "v");
		if (plan[i].components > PM_COMPONENTS || seen != (1u << plan[i].components) - 1)
			return pm_fail(PM_DATA, "the columns of '%s' must be all its components in order (%s%s)", plan[i].field,
				x || v ? "" : plan[i].field, x ? "x y z" : v ? "vx vy vz" : "_0 ...");
	}
	return 0;
}

static int positions(int n, const struct plan *plan, int dim)
{
	for (int i = 0; i < n; i++)
		if (plan[i].first == i && !strcmp(plan[i].field, "x")) {
			if (dim && dim != plan[i].components)
				return pm_fail(PM_DATA, "%d position columns, but --dim is %d", plan[i].components, dim);
			return plan[i].components;
		}
	return no_names();
}

static struct pm_field *field_make(struct pm_frame *f, const struct pm_columns_choice *choice, const struct plan *p, const char *column, bool text)
{
	struct pm_field *field = pm_makes(f, choice->set, p->field, text ? PM_COMPONENTS : p->components, PM_STATE);
	if (!field)
		return NULL;
	field->type = text ? PM_U8 : strcmp(p->field, "id") ? PM_F64 : PM_I64;
	field->extensive = is_strength(p->field) || among(column, choice->strength) || among(p->field, choice->strength);
	if (text)
		snprintf(field->unit, PM_NAME, "text");
	return field;
}

static int frame_make(const struct pm_text *t, int n, struct pm_table_column *column, const struct plan *plan,
	const struct pm_columns_choice *choice, size_t rows, struct pm_frame *f)
{
	if (!pm_frame_set_new(f, choice->set, rows))
		return -PM_DATA;
	for (int i = 0; i < n; i++) {
		bool text = !strcmp(column[i].name, "name") || among(column[i].name, choice->text);
		if (plan[i].first < 0)
			continue;
		column[i].field = plan[i].first == i ? field_make(f, choice, plan + i, column[i].name, text) : column[plan[i].first].field;
		if (!column[i].field)
			return -PM_DATA;
		column[i].text = text;
		column[i].component = plan[i].component < 0 ? 0 : plan[i].component;
	}
	for (size_t i = 0; i < f->nfields; i++)
		if (pm_table_field(t, f->fields[i]))
			return -PM_DATA;
	return pm_frame_ready(f);
}

static int number_rows(const struct pm_text *t, struct pm_frame *f, const char *set)
{
	struct pm_field *id = pm_frame_field(f, set, "id") ? NULL : pm_makes(f, set, "id", 1, PM_STATE);
	if (!id)
		return pm_fail(PM_DATA, "the table has a column id already (leave --number out)");
	id->type = PM_I64;
	if ((t->ranks && pm_field_share(id, pm_sum_block)) || pm_field_ready(id))
		return -PM_DATA;
	for (size_t i = 0; i < id->count; i++)
		pm_out_i64(id, 0)[i] = (int64_t)(id->first + i);
	id->use = 0;
	return 0;
}

int pm_columns_frame(struct pm_text *t, const struct pm_columns_choice *choice, struct pm_frame **f)
{
	struct pm_table_column *column = pm_alloc(PM_COLUMNS, sizeof *column);
	struct plan *plan = pm_zalloc(PM_COLUMNS, sizeof *plan);
	size_t rows = 0;
	int n = 0, dim = 0, status = column && plan ? 0 : -PM_DATA;
	*f = NULL;
	if (!status)
		status = pm_text_separator(t);
	if (!status && (n = pm_text_names(t, t->size, column)) <= 0)
		status = n < 0 ? n : pm_fail(PM_DATA, "line %lu: the text ends before a line of column names", (unsigned long)t->line);
	if (!status && !(status = group(n, column, choice, plan)))
		dim = positions(n, plan, choice->dim), status = dim < 0 ? dim : 0;
	status = pm_table_count(status, t, t->size, &rows);
	if (!status && !(*f = pm_frame_new(dim)))
		status = -PM_DATA;
	status = status ? status : frame_make(t, n, column, plan, choice, rows, *f);
	status = pm_table_read(status, t, t->size, *f, n < 0 ? 0 : n, column);
	status = status ? status : pm_frame_settle(*f);
	if (!status && choice->number)
		status = number_rows(t, *f, choice->set);
	status = t->ranks ? pm_world_agree(status) : status;
	if (status)
		*f = pm_frame_free(*f);
	pm_free(column), pm_free(plan);
	return status;
}

void pm_columns_box(struct pm_frame *f, const char *set)
{
	const struct pm_field *x = pm_frame_field(f, set, "x");
	double side = 0, centre[3] = {0}, far = 0;
	const bool any = pm_frame_set(f, set)->n;
	for (int a = 0; any && a < f->dim; a++) {
		double low = HUGE_VAL, high = -HUGE_VAL;
		for (size_t i = 0; i < x->count; i++)
			low = fmin(low, pm_in(x, a)[i]), high = fmax(high, pm_in(x, a)[i]);
		low = -pm_most_of_stretches(x, -low), high = pm_most_of_stretches(x, high);
		side = fmax(side, high - low);
		centre[a] = low / 2 + high / 2;
		far = fmax(far, fabs(centre[a]));
	}
	side = side > far * 1e-9 ? side : fmax(far, 0.5);
	for (int a = 0; any && a < f->dim; a++)
		f->lo[a] = centre[a] - side, f->hi[a] = centre[a] + side;
}
