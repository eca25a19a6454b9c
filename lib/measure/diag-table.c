/* The table of diag: the columns that a frame can give or that were asked for, decided by the first frame, one row per frame, and the growth rate of a mode
 * or a column after the last row.
 * Cost: that of the measures, and with growth two numbers kept per frame. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "measure/diag-table.h"
#include "measure/measure-field.h"
#include "measure/known-energy.h"
#include "measure/separation.h"
#include "measure/species-moments.h"
#include "measure/time-average.h"
#include "world/world.h"

static int check(const struct pm_diag_choice *c)
{
	for (int k = 0; k < c->nradii; k++)
		if (!(c->radii[k] > 0 && c->radii[k] <= 1))
			return pm_fail(PM_USAGE, "--radii %g is not a fraction of the mass in 0..1", c->radii[k]);
	for (int k = 0; k < c->nmodes; k++)
		if (!(c->modes[k] >= 1 && c->modes[k] <= 1e6 && c->modes[k] == floor(c->modes[k])))
			return pm_fail(PM_USAGE, "--modes %g is not a whole number of waves", c->modes[k]);
	return 0;
}

/* A column of --columns that cannot be made. */
static int lacking(const struct pm_diag_request *g, const char *name)
{
	if (!strncmp(name, "mode_", strlen("mode_")) || !strncmp(name, "radius_", strlen("radius_")))
		return (*name == 'm' ? g->nmodes : g->nradii) == PM_COMPONENTS ?
			pm_fail(PM_USAGE, "--columns %s: at most %d of its kind", name, PM_COMPONENTS) :
			pm_fail(PM_USAGE, "--columns %s is no wave (mode_1: 1 to 1e6) and no fraction of the mass (radius_0.5)", name);
	return pm_fail(PM_USAGE, "--columns %s needs %s", name, !strncmp(name, "flux", strlen("flux")) ?
		"the box (--flux-box LOW,HIGH, its corners)" : "the two sets (--separation SET,SET)");
}

/* mode:M or a column, and T0:T1. */
static int take_growth(struct pm_diag_table *t)
{
	struct pm_diag_choice *c = &t->choice;
	struct pm_diag_request *g = &t->request;
	char mode[PM_DIAG_NAME] = "";
	int used = 0;
	c->from = c->to = NAN;
	if (c->window && (!(c->growth || c->average) || sscanf(c->window, "%lf:%lf%n", &c->from, &c->to, &used) != 2 || c->window[used] || !(c->to > c->from)))
		return pm_fail(PM_USAGE, "--window '%s' (it is written T0:T1, T0 < T1, and belongs to --growth and --average)", c->window);
	if (!c->growth)
		return 0;
	if (g->nmodes == PM_COMPONENTS || g->nradii == PM_COMPONENTS)
		return pm_fail(PM_USAGE, "--growth with %d modes or radii (at most %d)", PM_COMPONENTS, PM_COMPONENTS - 1);
	const bool wave = !strncmp(c->growth, "mode:", strlen("mode:"));
	snprintf(mode, sizeof mode, "mode_%s", wave ? c->growth + strlen("mode:") : "");
	if (!pm_diag_find(g, wave ? mode : c->growth, &t->growth))
		return pm_fail(PM_USAGE, "--growth '%s' (mode:1 for waves in the box along x, or a column of diag)", c->growth);
	for (t->mode = wave ? g->nmodes - 1 : -1; wave && g->mode[t->mode] != (int)strtod(mode + strlen("mode_"), NULL); t->mode--)
		;
	t->series.column = !wave;
	return 0;
}

int pm_diag_table_init(struct pm_diag_table *t, const struct pm_diag_choice *c, FILE *out)
{
	struct pm_diag_request *g = &t->request;
	*t = (struct pm_diag_table){.choice = *c, .out = out, .request = {.set = c->set, .pair = c->pair, .nradii = c->nradii, .nmodes = c->nmodes,
		.separation = {c->separation[0], c->separation[1]}, .species = c->species, .field_errors = c->field_errors,
		.flux = c->flux, .nflux = c->nflux}};
	t->readable = (struct pm_readable){.width = c->width, .asked = c->ncolumns > 0};
	struct pm_diag_column column;
	if (check(c))
		return -PM_USAGE;
	for (int k = 0; k < c->nradii; k++)
		g->fraction[k] = c->radii[k];
	for (int k = 0; k < c->nmodes; k++)
		g->mode[k] = (int)c->modes[k];
	for (int i = 0; i < c->ncolumns; i++)
		if (!pm_diag_find(g, c->columns[i], &column))
			return lacking(g, c->columns[i]);
	return take_growth(t);
}

static void add(struct pm_diag_table *t, const struct pm_frame *f, struct pm_diag_column column)
{
	const struct pm_scene *scene = t->choice.exact ? pm_diag_scene(f) : NULL;
	t->column[t->n++] = column;
	if (scene && isfinite(scene->exact(f, column.name, f->time)))
		t->column[t->n++] = pm_diag_exact(column.name);
}

static void add_new(struct pm_diag_table *t, const struct pm_frame *f, struct pm_diag_column column)
{
	for (int i = 0; i < t->n; i++)
		if (!strcmp(t->column[i].name, column.name))
			return;
	add(t, f, column);
}

/* One that an option adds, where --columns does not name it or its kind already. */
static void add_last(struct pm_diag_table *t, const struct pm_frame *f, struct pm_diag_column column)
{
	const size_t kind = strcspn(column.name, "_");
	for (int i = 0; i < t->choice.ncolumns; i++)
		if (!strncmp(t->choice.columns[i], column.name, kind))
			return;
	add(t, f, column);
}

/* All columns that exist here, or those given by --columns in their order; radii and modes last. They stay the same over the stream. */
static int decide(struct pm_diag_table *t, const struct pm_frame *f)
{
	struct pm_diag_column column;
	const struct pm_diag_choice *c = &t->choice;
	int vdim = 0;
	const struct pm_measure how = pm_diag_how(&t->request, f);
	if (c->exact && !pm_diag_scene(f))
		return pm_fail(PM_DATA, "the scene '%s' has no exact values (leave --exact out)", f->scene);
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->name, "v") && f->fields[i]->components > vdim)
			vdim = f->fields[i]->components;
	for (int k = 0; k < PM_COLUMNS && !c->ncolumns; k++)
		if (pm_column_exists((enum pm_column)k, f->dim, vdim) && pm_column_suits((enum pm_column)k, &how) &&
			(k != PM_OUTSIDE || pm_measure_has_outside(&how, f)))
			add(t, f, pm_diag_column((enum pm_column)k));
	for (int i = 0; i < c->ncolumns; i++)
		if (pm_diag_find(&t->request, c->columns[i], &column))
			add(t, f, column);
	for (int k = 0; k < c->nradii; k++)
		add_new(t, f, pm_diag_radius(&t->request, k));
	for (int k = 0; k < c->nmodes; k++)
		add_new(t, f, pm_diag_mode(&t->request, k));
	for (int k = 0; k < 2 && c->separation[0]; k++)
		add_last(t, f, pm_diag_separation(k));
	for (int k = c->flux ? PM_FLUX : PM_FIELD_RESIDUAL; k < (c->field_errors ? PM_FIELD_COLUMNS : PM_FIELD_RESIDUAL); k++)
		add_last(t, f, pm_diag_field((enum pm_field_column)k));
	for (size_t i = 0; i < f->nsets && c->species; i++) {
		const struct pm_field *v = pm_frame_field(f, f->sets[i]->name, "v");
		for (int k = 0; k < PM_MOMENTS; k++)
			if (pm_moment_exists((enum pm_moment)k, v ? v->components : 0))
				add(t, f, pm_diag_moment(f, i, (enum pm_moment)k));
	}
	return 0;
}

/* Keeps the row for the averages. */
static int remember(struct pm_diag_table *t, const double *value, double time)
{
	const size_t width = (size_t)t->n + 1;
	if (!t->choice.average || (time < t->choice.from) || (time > t->choice.to))
		return 0;
	if (t->nrows == t->room) {
		const size_t room = 2 * t->room + 64;
		double *rows = realloc(t->rows, room * width * sizeof *rows);
		if (!rows)
			return pm_no_memory();
		t->rows = rows, t->room = room;
	}
	memcpy(t->rows + t->nrows * width, value, (width - 1) * sizeof *value);
	t->rows[t->nrows++ * width + width - 1] = time;
	return 0;
}

/* Is this the frame whose species have the theory of a wave: the first one with --exact and the growth of a mode? Rank 0 alone knows. */
static bool wants_theory(const struct pm_diag_table *t, const struct pm_frame *f)
{
	return t->choice.exact && t->mode >= 0 && !t->series.n && !pm_world_rank() &&
		(!strcmp(f->law, "electrostatic") || !strcmp(f->law, "electromagnetic"));
}

int pm_diag_table_reads(const struct pm_diag_table *t, struct pm_frame *f)
{
	if (wants_theory(t, f))
		pm_wave_theory_reads(f);
	return pm_diag_reads(&t->request, f);
}

/* Of the wave that the scene starts with, as long as the plasma is that which the scene made; `mode` of a scene is the wave that `gamma` belongs to. Else of
 * the species. */
static void ask_theory(struct pm_diag_table *t, const struct pm_frame *f)
{
	const struct pm_scene *scene = t->choice.exact && t->mode >= 0 ? pm_diag_scene(f) : NULL;
	const double known = scene ? scene->exact(f, "mode", f->time) : NAN, mode = isnan(known) ? pm_frame_parameter(f, "mode", 1) : known;
	bool its = scene && t->request.mode[t->mode] == (int)mode;
	if (wants_theory(t, f)) {
		const double k1 = 2 * pm_pi / (f->hi[0] - f->lo[0]);
		t->k = k1 * t->request.mode[t->mode];
		pm_wave_theory_of(&t->waves, f, k1, pm_diag_how(&t->request, f).wave);
		its = its && pm_wave_theory_as_made(&t->waves, f, scene, t->k);
	}
	t->theory[0] = its ? scene->exact(f, "gamma", f->time) : NAN;
	t->theory[1] = its ? scene->exact(f, "omega", f->time) : NAN;
	t->bounce = its ? scene->exact(f, "bounce", f->time) : NAN;
	t->bounce = t->theory[0] < 0 && t->bounce > -t->theory[0] ? t->bounce : NAN;
	if (isfinite(t->theory[0]))
		t->k = 0;
}

static int follow(struct pm_diag_table *t, const struct pm_frame *f, const struct pm_measures *m)
{
	if (!t->choice.growth)
		return 0;
	if (!t->series.n)
		ask_theory(t, f);
	const double value[2] = {t->mode < 0 ? pm_diag_value(&t->growth, m, f) : 0, 0};
	return pm_series_add(&t->series, f->time, t->mode < 0 ? value : m->mode[t->mode], t->mode < 0 || isnan(m->field_most) ? 0 : m->field_most);
}

static bool needs_energy(const struct pm_diag_table *t)
{
	bool needs = false;
	for (int i = 0; i <= t->n; i++) {
		const int from = i < t->n ? t->column[i].from : t->choice.growth ? t->growth.from : 0;
		needs = needs || from == PM_ENERGY_PAIR || from == PM_ENERGY || from == PM_ENERGY_LOSS ||
			(from >= PM_VIRIAL_RATIO && from <= PM_RELAXATION_TIME);
	}
	return needs;
}

/* Measures the frame; sums pairs too where that is the only way to the energy and cheap. The first row of a run
 * decides whether, so that a column is one quantity; another run begins where the step does not rise. */
static int measure(struct pm_diag_table *t, const struct pm_frame *f, bool begins, struct pm_measure *how, struct pm_measures *m)
{
	char why[200] = "";
	*how = pm_diag_how(&t->request, f);
	int status = pm_measure_frame(how, f, m);
	const bool lacks = t->energies && !t->choice.pair && isnan(m->value[PM_ENERGY_PAIR]) && isnan(m->value[PM_ENERGY_MESH]);
	const enum pm_pairs pairs = lacks || t->unasked ? pm_pairs_unasked(f, pm_law_of(f), how, why) : PM_PAIRS_NO;
	bool again = pairs == PM_PAIRS_SUM && ((begins && lacks) || t->unasked);
	if (pm_measure_divided(f)) /* rank 0 has seen all frames of the run */
		status = pm_world_share(status, 0, &again, sizeof again);
	if (!status && again) {
		t->unasked = t->request.pair = true;
		*how = pm_diag_how(&t->request, f);
		t->request.pair = false;
		status = pm_measure_frame(how, f, m);
	}
	snprintf(t->lacks, sizeof t->lacks, "%s", lacks ? why : "");
	t->expected = lacks && (pairs == PM_PAIRS_MANY || t->choice.ncolumns); /* where all are written, those that are nan show themselves */
	t->unknown[0] = 0;
	for (int i = 0; i < t->n; i++)
		if (t->column[i].from == PM_ENERGY)
			memcpy(t->unknown, how->unknown, sizeof t->unknown);
	if (how->vortices && !begins && f->time > t->before[0])
		m->value[PM_ENERGY_LOSS] = (t->before[1] - m->value[PM_ENERGY]) / (f->time - t->before[0]);
	t->before[0] = f->time, t->before[1] = m->value[PM_ENERGY];
	return status;
}

bool pm_diag_table_shared(const struct pm_diag_table *t, const struct pm_frame *f)
{
	const struct pm_measure how = pm_diag_how(&t->request, f);
	return pm_measure_shared(&how) && !wants_theory(t, f); /* rank 0 looks at the species of the first frame */
}

static void print_row(struct pm_diag_table *t, const double *value, bool first)
{
	const bool json = t->choice.format == PM_DIAG_JSON;
	const char between = t->choice.format == PM_DIAG_CSV ? ',' : '\t';
	for (int i = 0; i < t->n && first && !json; i++)
		fprintf(t->out, "%s%c", t->column[i].name, i + 1 < t->n ? between : '\n');
	for (int i = 0; i < t->n; i++) {
		if (json)
			fprintf(t->out, "%c\"%s\":", i ? ',' : '{', t->column[i].name);
		fprintf(t->out, isfinite(value[i]) ? "%.17g" : json ? "null" : "nan", value[i]);
		if (!json && i + 1 < t->n)
			fputc(between, t->out);
	}
	fputs(json ? "}\n" : "\n", t->out);
}

/* A set of masses that moves and has no v, as behind --drop v: what a sum over velocities leaves out. */
static void no_velocity(const struct pm_frame *f, const struct pm_measure *how, char note[320])
{
	note[0] = 0;
	for (size_t i = 0; i < f->nsets && !how->vortices; i++) {
		const char *set = f->sets[i]->name;
		if (pm_set_moves(f, f->sets[i]) && pm_frame_field(f, set, "mass") && !pm_frame_field(f, set, "v"))
			snprintf(note, 320, "'%s' has no velocities 'v': kinetic energy and momentum are 0, energy is that of the field alone", set);
	}
}

/* Filaments hold circulation and nodes in order, not alpha: the word filament sums over their elements. */
static void filaments(const struct pm_frame *f, const struct pm_measure *how, char note[320])
{
	for (size_t i = 0; i < f->nsets && how->vortices && how->vector; i++) {
		const char *set = f->sets[i]->name;
		if (pm_frame_field(f, set, "curve") && pm_frame_field(f, set, "circulation") && !pm_frame_field(f, set, how->strength))
			snprintf(note, 320, "'%s' are filaments, whose length and impulse are in the report of the word filament (sls --report)", set);
	}
}

int pm_diag_table_row(struct pm_diag_table *t, const struct pm_frame *f)
{
	struct pm_measures m;
	struct pm_measure how;
	const bool first = !t->n;
	double value[PM_DIAG_WIDEST];
	if (first && decide(t, f))
		return -PM_DATA;
	t->energies = needs_energy(t);
	const bool begins = first || f->step <= t->step;
	t->step = f->step;
	t->unasked = t->unasked && !begins;
	if (measure(t, f, begins, &how, &m) || follow(t, f, &m))
		return -PM_DATA;
	if (!pm_energy_error_note(&t->energy, &how, f, &m, t->note))
		no_velocity(f, &how, t->note);
	if (!t->note[0])
		filaments(f, &how, t->note);
	if (!t->note[0] && (how.flux || how.field_errors) && !pm_field_known(&how, f))
		snprintf(t->note, sizeof t->note, "%s nan: no mesh has %s",
			how.flux ? "flux and flux_enclosed are" : "field_residual and field_curl are", how.evolves ? "E and B where Yee has them (for which "
			"flux is that of the energy)" : "the density and the potential of the law (a solver before diag: poisson-fft)");
	for (int i = 0; i < t->n; i++)
		value[i] = pm_diag_value(&t->column[i], &m, f);
	if (remember(t, value, f->time))
		return -PM_DATA;
	if (t->choice.format == PM_DIAG_READABLE)
		pm_readable_row(&t->readable, t->out, t->n, t->column, value, &how, f, t->lacks);
	else
		print_row(t, value, first);
	return fflush(t->out) ? pm_fail_errno("cannot write the table") : 0;
}

static void number(FILE *out, bool json, const char *before, double x)
{
	fprintf(out, isfinite(x) ? "%s%.9g" : json ? "%snull" : "%snan", before, x);
}

/* The line of the growth rate: for people, a comment of the table. */
static void print_growth(FILE *out, bool json, const char *of, const struct pm_growth *g, const struct pm_diag_table *t)
{
	const char *const name[2][6] = {{"# ", " gamma ", " +- ", " omega ", ", from t = ", " to "},
		{"{\"growth\":\"", "\",\"gamma\":", ",\"error\":", ",\"omega\":", ",\"from\":", ",\"to\":"}}, *const *n = name[json];
	fprintf(out, "%s%s", n[0], of);
	number(out, json, n[1], g->gamma);
	number(out, json, n[2], g->error);
	number(out, json, n[3], g->omega);
	if (g->reason[0]) {
		fprintf(out, json ? ",\"points\":%zu,\"none\":\"%s\"" : ", none of %zu points: %s", g->points, g->reason);
	} else {
		number(out, json, n[4], g->from);
		number(out, json, n[5], g->to);
		fprintf(out, json ? ",\"points\":%zu,\"over_noise\":%.3g" : ", %zu points, %.3g times the noise", g->points, g->over_noise);
	}
	if (isfinite(t->theory[0])) {
		const char *const start = t->k > 0 ? "; theory of the species: gamma " : "; theory: gamma ";
		number(out, json, json ? ",\"theory_gamma\":" : start, t->theory[0]);
		number(out, json, json ? ",\"theory_omega\":" : " omega ", t->theory[1]);
		fputs(!json ? "" : t->k > 0 ? ",\"theory_of\":\"species\"" : ",\"theory_of\":\"scene\"", out);
		if (isfinite(t->bounce))
			fprintf(out, json ? ",\"bounce\":%.3g" : ", of a small wave: this one traps particles before it is damped (bounce frequency %.3g)",
				t->bounce);
	} else if (t->k > 0) {
		fprintf(out, json ? ",\"theory_none\":\"%s\"" : "; theory of the species: none (%s)", t->waves.why[0] ? t->waves.why :
			g->reason[0] ? "no rate from which to look for a root" : "no root near what was measured");
	}
	fputs(json ? "}\n" : "\n", out);
}

/* The line of the largest Lyapunov exponent: a separation grows by factors that vary along the path. */
static int print_divergence(const struct pm_diag_table *t)
{
	const struct pm_series *s = &t->series;
	const struct pm_divergence e = pm_divergence_of(s->n, s->t, s->re, t->choice.from, t->choice.to);
	const bool json = t->choice.format == PM_DIAG_JSON;
	fprintf(t->out, json ? "{\"growth\":\"%s\"" : "# %s", t->growth.name);
	number(t->out, json, json ? ",\"lambda\":" : " lambda ", e.lambda);
	number(t->out, json, json ? ",\"error\":" : " +- ", e.error);
	if (isfinite(e.lambda))
		fprintf(t->out, json ? ",\"from\":%.9g,\"to\":%.9g" : ", from t = %.9g to %.9g", e.from, e.to);
	fprintf(t->out, json ? ",\"points\":%zu}\n" : isfinite(e.lambda) ? ", %zu points\n" : ", none: %zu points below a hundredth of the largest, and 24 are "
		"needed\n", e.points);
	return fflush(t->out) ? pm_fail_errno("cannot write the table") : 0;
}

/* A line for every column but step and time that has values. */
static int print_averages(const struct pm_diag_table *t)
{
	const size_t n = t->nrows, width = (size_t)t->n + 1;
	const bool json = t->choice.format == PM_DIAG_JSON;
	double *y = pm_alloc(n + 1, sizeof *y);
	if (!y)
		return -PM_DATA;
	const double from = n ? t->rows[width - 1] : NAN, to = n ? t->rows[n * width - 1] : NAN, spacing = n > 1 ? (to - from) / (double)(n - 1) : NAN;
	for (int k = 0; k < t->n; k++) {
		for (size_t i = 0; i < n; i++)
			y[i] = t->rows[i * width + (size_t)k];
		const struct pm_average a = pm_average_of(n, y);
		if (t->column[k].from == PM_STEP || t->column[k].from == PM_TIME || !isfinite(a.mean))
			continue;
		fprintf(t->out, json ? "{\"average\":\"%s\"" : "# average %s", t->column[k].name);
		number(t->out, json, json ? ",\"mean\":" : " ", a.mean);
		number(t->out, json, json ? ",\"error\":" : " +- ", a.error);
		number(t->out, json, json ? ",\"correlation_time\":" : ", correlation time ", a.correlation * spacing);
		fprintf(t->out, json ? ",\"from\":%.9g,\"to\":%.9g,\"frames\":%zu,\"brief\":%s}\n" : ", from t = %.9g to %.9g, %zu frames%s\n", from, to, n,
			json ? a.brief ? "true" : "false" : a.brief ? ", fewer than 50 correlation times: the error is too small" : "");
	}
	pm_free(y);
	return fflush(t->out) ? pm_fail_errno("cannot write the table") : 0;
}

int pm_diag_table_end(struct pm_diag_table *t)
{
	const struct pm_diag_choice *c = &t->choice;
	struct pm_growth g;
	if (c->average && print_averages(t))
		return -PM_DATA;
	if (!c->growth)
		return 0;
	if (c->separation[0] && !strncmp(t->growth.name, "separation", strlen("separation")))
		return print_divergence(t);
	if (pm_growth_of(&t->series, c->from, c->to, &g))
		return -PM_DATA;
	if (t->k > 0) {
		const double complex root = pm_wave_theory_close(&t->waves, t->k, g.omega + I * g.gamma);
		const double gamma = fabs(cimag(root)) < 1e-12 * cabs(root) ? 0 : cimag(root); /* round-off of a real root */
		t->theory[0] = isnan(creal(root)) ? NAN : gamma, t->theory[1] = creal(root);
	}
	print_growth(t->out, c->format == PM_DIAG_JSON, c->growth, &g, t);
	return fflush(t->out) ? pm_fail_errno("cannot write the table") : 0;
}

void pm_diag_table_clear(struct pm_diag_table *t)
{
	pm_series_release(&t->series);
	free(t->rows);
}
