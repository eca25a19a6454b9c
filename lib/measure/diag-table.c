/* The table of diag: the columns that a frame can give or that were asked for, decided by the first frame, one row per frame, and the growth rate of a mode
 * after the last row.
 * Cost: that of the measures, and with growth two numbers kept per frame. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "measure/diag-table.h"

/* mode:M and T0:T1. */
static int take_growth(struct pm_diag_choice *c, const char *growth)
{
	int used = 0;
	if (growth && (sscanf(growth, "mode:%d%n", &c->growth, &used) != 1 || growth[used] || c->growth < 1))
		return pm_fail(PM_USAGE, "--growth '%s' (it is written mode:1, waves in the box along x)", growth);
	if (growth && c->nmodes == PM_COMPONENTS)
		return pm_fail(PM_USAGE, "--growth with %d modes (at most %d)", c->nmodes, PM_COMPONENTS - 1);
	if (c->window && (!growth || sscanf(c->window, "%lf:%lf%n", &c->from, &c->to, &used) != 2 || c->window[used] || !(c->to > c->from)))
		return pm_fail(PM_USAGE, "--window '%s' (it is written T0:T1, T0 < T1, and belongs to --growth)", c->window);
	return 0;
}

int pm_diag_choice_check(struct pm_diag_choice *c, const char *growth)
{
	c->growth = 0;
	c->from = c->to = NAN;
	for (int k = 0; k < c->nradii; k++)
		if (!(c->radii[k] > 0 && c->radii[k] <= 1))
			return pm_fail(PM_USAGE, "--radii %g is not a fraction of the mass in 0..1", c->radii[k]);
	for (int k = 0; k < c->nmodes; k++)
		if (!(c->modes[k] >= 1 && c->modes[k] <= 1e6 && c->modes[k] == floor(c->modes[k])))
			return pm_fail(PM_USAGE, "--modes %g is not a whole number of waves", c->modes[k]);
	return take_growth(c, growth);
}

void pm_diag_table_init(struct pm_diag_table *t, const struct pm_diag_choice *c, FILE *out)
{
	struct pm_diag_request *g = &t->request;
	*t = (struct pm_diag_table){.choice = *c, .out = out, .request = {.set = c->set, .pair = c->pair, .nradii = c->nradii, .nmodes = c->nmodes}};
	for (int k = 0; k < c->nradii; k++)
		g->fraction[k] = c->radii[k];
	for (int k = 0; k < c->nmodes; k++)
		g->mode[k] = (int)c->modes[k];
	if (c->growth)
		g->mode[g->nmodes++] = c->growth; /* the last is the mode whose growth is fitted */
}

static void add(struct pm_diag_table *t, const struct pm_frame *f, struct pm_diag_column column)
{
	const struct pm_scene *scene = t->choice.exact ? pm_diag_scene(f) : NULL;
	t->column[t->n++] = column;
	if (scene && isfinite(scene->exact(f, column.name, f->time)))
		t->column[t->n++] = pm_diag_exact(column.name);
}

/* All columns that exist here, or those given by --column in their order; radii and modes last. They stay the same over the stream. */
static int decide(struct pm_diag_table *t, const struct pm_frame *f)
{
	const struct pm_diag_choice *c = &t->choice;
	int vdim = 0;
	const struct pm_measure how = pm_diag_how(&t->request, f);
	if (c->exact && !pm_diag_scene(f))
		return pm_fail(PM_DATA, "the scene '%s' has no exact values (leave --exact out)", f->scene);
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->name, "v") && f->fields[i]->components > vdim)
			vdim = f->fields[i]->components;
	for (int k = 0; k < PM_COLUMNS && !c->ncolumns; k++)
		if (pm_column_exists((enum pm_column)k, f->dim, vdim) && pm_column_suits((enum pm_column)k, how.vortices, how.plasma))
			add(t, f, pm_diag_column((enum pm_column)k));
	for (int i = 0; i < c->ncolumns; i++)
		for (int k = 0; k < PM_COLUMNS; k++)
			if (!strcmp(c->columns[i], pm_column_names[k]))
				add(t, f, pm_diag_column((enum pm_column)k));
	for (int k = 0; k < c->nradii; k++)
		add(t, f, pm_diag_radius(&t->request, k));
	for (int k = 0; k < c->nmodes; k++)
		add(t, f, pm_diag_mode(&t->request, k));
	return 0;
}

int pm_diag_table_row(struct pm_diag_table *t, const struct pm_frame *f)
{
	struct pm_measures m;
	const bool json = t->choice.json, first = !t->n;
	const struct pm_measure how = pm_diag_how(&t->request, f);
	if ((first && decide(t, f)) || pm_measure_frame(&how, f, &m) ||
		(t->choice.growth && pm_series_add(&t->series, f->time, m.mode[how.nmodes - 1])))
		return -PM_DATA;
	for (int i = 0; i < t->n && first && !json; i++)
		fprintf(t->out, "%s%c", t->column[i].name, i + 1 < t->n ? '\t' : '\n');
	for (int i = 0; i < t->n; i++) {
		const double x = pm_diag_value(&t->column[i], &m, f);
		if (json)
			fprintf(t->out, "%c\"%s\":", i ? ',' : '{', t->column[i].name);
		fprintf(t->out, isfinite(x) ? "%.17g" : json ? "null" : "nan", x);
		fputs(i + 1 < t->n ? json ? "" : "\t" : json ? "}\n" : "\n", t->out);
	}
	return fflush(t->out) ? pm_fail_errno("cannot write the table") : 0;
}

int pm_diag_table_end(struct pm_diag_table *t)
{
	const struct pm_diag_choice *c = &t->choice;
	const bool json = c->json;
	if (!c->growth)
		return 0;
	const struct pm_growth g = pm_growth_of(&t->series, c->from, c->to);
	if (!isfinite(g.gamma))
		return pm_fail(PM_DATA, "%zu points of mode %d%s%s are too few for a growth rate (more frames: cycle --every, or another --window)", g.points,
			c->growth, c->window ? " in the window " : "", c->window ? c->window : "");
	fprintf(t->out, json ? "{\"growth\":\"mode:%d\",\"gamma\":%.9g,\"omega\":%.9g,\"from\":%.9g,\"to\":%.9g,\"points\":%zu}\n"
		: "# mode:%d gamma %.9g omega %.9g, from t = %.9g to %.9g, %zu points\n", c->growth, g.gamma, g.omega, g.from, g.to, g.points);
	return fflush(t->out) ? pm_fail_errno("cannot write the table") : 0;
}

void pm_diag_table_clear(struct pm_diag_table *t) { pm_series_release(&t->series); }
