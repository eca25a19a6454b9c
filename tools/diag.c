/* diag: measures every frame and prints a row of numbers, as a table or as JSON. With --tee it writes them to a file and passes the frame on.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "measure/growth.h"
#include "measure/diag-column.h"
#include "stage/stage.h"

struct config {
	const char *set, *format, *tee;
	struct pm_list columns;
	struct pm_vector radii, modes;
	const char *growth, *window;
	bool pair, exact;
	int mode;          /* of --growth; 0 none */
	double from, to;   /* of --window; NAN not given */
};
enum { MOST = 2 * (PM_LIST_MOST + PM_COLUMNS + 2 * PM_COMPONENTS) };
struct state {
	FILE *out;
	int n; /* columns, decided by the first frame; 0 before */
	struct pm_series series; /* of --growth */
	struct pm_diag_column column[MOST];
	struct pm_diag_request gauge;
};

/* mode:M and T0:T1. */
static int take_growth(struct config *c)
{
	int used = 0;
	c->from = c->to = NAN;
	for (int k = 0; k < c->modes.n; k++)
		if (!(c->modes.x[k] >= 1 && c->modes.x[k] <= 1e6 && c->modes.x[k] == floor(c->modes.x[k])))
			return pm_fail(PM_USAGE, "--modes %g is not a whole number of waves", c->modes.x[k]);
	if (c->growth && (sscanf(c->growth, "mode:%d%n", &c->mode, &used) != 1 || c->growth[used] || c->mode < 1))
		return pm_fail(PM_USAGE, "--growth '%s' (it is written mode:1, waves in the box along x)", c->growth);
	if (c->growth && c->modes.n == PM_COMPONENTS)
		return pm_fail(PM_USAGE, "--growth beside %d modes (at most %d)", c->modes.n, PM_COMPONENTS - 1);
	if (c->window && (!c->growth || sscanf(c->window, "%lf:%lf%n", &c->from, &c->to, &used) != 2 || c->window[used] || !(c->to > c->from)))
		return pm_fail(PM_USAGE, "--window '%s' (it is written T0:T1, T0 < T1, and belongs to --growth)", c->window);
	return 0;
}

static void gauge_make(struct pm_diag_request *g, const struct config *c)
{
	*g = (struct pm_diag_request){.set = c->set, .pair = c->pair, .nradii = c->radii.n, .nmodes = c->modes.n};
	memcpy(g->fraction, c->radii.x, sizeof g->fraction);
	for (int k = 0; k < c->modes.n; k++)
		g->mode[k] = (int)c->modes.x[k];
	if (c->mode)
		g->mode[g->nmodes++] = c->mode; /* the last is that of the growth */
}

static int begin(struct pm_stage *s)
{
	struct config *c = s->config;
	struct state *state = s->state;
	for (int k = 0; k < c->radii.n; k++)
		if (!(c->radii.x[k] > 0 && c->radii.x[k] <= 1))
			return pm_fail(PM_USAGE, "--radii %g is not a fraction of the mass in 0..1", c->radii.x[k]);
	if (take_growth(c))
		return -PM_USAGE;
	gauge_make(&state->gauge, c);
	s->kind = c->tee ? PM_FILTER : PM_SINK;
	state->out = c->tee ? fopen(c->tee, "w") : stdout;
	return state->out ? 0 : pm_fail_errno("cannot write '%s'", c->tee);
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	return f->substep ? PM_PASS /* state is not at the header's time */ : pm_diag_reads(&((struct state *)s->state)->gauge, f);
}

static void add(struct state *state, const struct config *c, const struct pm_frame *f, struct pm_diag_column column)
{
	const struct pm_scene *scene = c->exact ? pm_diag_scene(f) : NULL;
	state->column[state->n++] = column;
	if (scene && isfinite(scene->exact(f, column.name, f->time)))
		state->column[state->n++] = pm_diag_exact(column.name);
}

/* All columns that exist here, or those asked for in their order; radii and modes last. They stay the same over the stream. */
static int decide(struct state *state, const struct config *c, const struct pm_frame *f)
{
	int vdim = 0;
	const struct pm_measure how = pm_diag_how(&state->gauge, f);
	if (c->exact && !pm_diag_scene(f))
		return pm_fail(PM_DATA, "the scene '%s' has no exact numbers (leave --exact out)", f->scene);
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->name, "v") && f->fields[i]->components > vdim)
			vdim = f->fields[i]->components;
	for (int k = 0; k < PM_COLUMNS && !c->columns.n; k++)
		if (pm_column_exists((enum pm_column)k, f->dim, vdim) && pm_column_suits((enum pm_column)k, how.vortices, how.plasma))
			add(state, c, f, pm_diag_column((enum pm_column)k));
	for (int i = 0; i < c->columns.n; i++)
		for (int k = 0; k < PM_COLUMNS; k++)
			if (!strcmp(c->columns.item[i], pm_column_names[k]))
				add(state, c, f, pm_diag_column((enum pm_column)k));
	for (int k = 0; k < c->radii.n; k++)
		add(state, c, f, pm_diag_radius(&state->gauge, k));
	for (int k = 0; k < c->modes.n; k++)
		add(state, c, f, pm_diag_mode(&state->gauge, k));
	return 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct state *state = s->state;
	struct pm_measures m;
	const bool json = !strcmp(c->format, "json"), first = !state->n;
	const struct pm_measure how = pm_diag_how(&state->gauge, f);
	if ((first && decide(state, c, f)) || pm_measure_frame(&how, f, &m) ||
		(c->mode && pm_series_add(&state->series, f->time, m.mode[how.nmodes - 1])))
		return -PM_DATA;
	for (int i = 0; i < state->n && first && !json; i++)
		fprintf(state->out, "%s%c", state->column[i].name, i + 1 < state->n ? '\t' : '\n');
	for (int i = 0; i < state->n; i++) {
		const double x = pm_diag_value(&state->column[i], &m, f);
		if (json)
			fprintf(state->out, "%c\"%s\":", i ? ',' : '{', state->column[i].name);
		fprintf(state->out, isfinite(x) ? "%.17g" : json ? "null" : "nan", x);
		fputs(i + 1 < state->n ? json ? "" : "\t" : json ? "}\n" : "\n", state->out);
	}
	return fflush(state->out) ? pm_fail_errno("cannot write the table") : 0;
}

/* One line behind the table. */
static int end(struct pm_stage *s)
{
	const struct config *c = s->config;
	struct state *state = s->state;
	const bool json = !strcmp(c->format, "json");
	if (!c->mode)
		return 0;
	const struct pm_growth g = pm_growth_of(&state->series, c->from, c->to);
	if (!isfinite(g.gamma))
		return pm_fail(PM_DATA, "%zu points of mode %d%s%s are too few for a growth rate (more frames: cycle --every, or another --window)", g.points, c->mode,
			c->window ? " in the window " : "", c->window ? c->window : "");
	fprintf(state->out, json ? "{\"growth\":\"mode:%d\",\"gamma\":%.9g,\"omega\":%.9g,\"from\":%.9g,\"to\":%.9g,\"points\":%zu}\n"
		: "# mode:%d gamma %.9g omega %.9g, from t = %.9g to %.9g, %zu points\n", c->mode, g.gamma, g.omega, g.from, g.to, g.points);
	return fflush(state->out) ? pm_fail_errno("cannot write the table") : 0;
}

static void release(struct pm_stage *s)
{
	struct state *state = s->state;
	pm_series_release(&state->series);
	if (state->out && state->out != stdout)
		fclose(state->out);
}

static const char *const formats[] = {"tsv", "json", NULL};
static const struct pm_option options[] = {
	{.name = "set", .kind = PM_TEXT, .cosmetic = true, PM_AT(set), .text = "measure this set alone (default: all)"},
	{.name = "columns", .kind = PM_LIST, .choices = pm_column_names, .cosmetic = true, PM_AT(columns),
		.text = "these columns in this order (default: all)"},
	{.name = "radii", .kind = PM_VECTOR, .cosmetic = true, PM_AT(radii),
		.text = "add Lagrangian radii about the centre of mass, for these fractions of the mass"},
	{.name = "modes", .kind = PM_VECTOR, .cosmetic = true, PM_AT(modes),
		.text = "add the amplitudes of these waves along x of the law's field (its first component)"},
	{.name = "growth", .kind = PM_TEXT, .unit = "mode:M", .cosmetic = true, PM_AT(growth),
		.text = "behind the table a line with the growth rate and frequency of wave M along x"},
	{.name = "window", .kind = PM_TEXT, .unit = "T0:T1", .cosmetic = true, PM_AT(window),
		.text = "fit them between these times (default: where it grows from 1 to 10 % of its largest, else all)"},
	{.name = "pair", .kind = PM_FLAG, .cosmetic = true, PM_AT(pair), .text = "sum the pair energy over all pairs, with the frame's softening (cost n^2)"},
	{.name = "exact", .kind = PM_FLAG, .cosmetic = true, PM_AT(exact), .text = "beside every column the scene knows exactly, exact_NAME"},
	{.name = "format", .kind = PM_WORD, .fallback = "tsv", .choices = formats, .cosmetic = true, PM_AT(format),
		.text = "a table with a header line, or one JSON object a line"},
	{.name = "tee", .kind = PM_TEXT, .unit = "FILE", .cosmetic = true, PM_AT(tee), .text = "write to FILE and pass the frames on"},
	{0},
};

static const struct pm_example examples[] = {
	{"The numbers of a star cluster beside the exact ones", "pinit plummer -n 1000 | diag --pair --exact --radii 0.1,0.5,0.9"},
	{"Two columns as JSON", "pinit two-body --eccentricity 0.5 | diag --pair --columns energy,angular_momentum_z --format json"},
	{"A decaying vortex beside its exact numbers", "pinit lamb-oseen | p2m | diag --exact"},
	{"The growth rate of two cold streams", "pinit two-stream -n 2000 --cells 32 | cycle -n 300 --every 4 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' "
		"| p2m | poisson-fft | mgrad | diag --columns time,energy_field_x --modes 1 --growth mode:1"},
	{"A table on the way", "pinit uniform -n 100 --dispersion 1 | diag --tee start.tsv | sls"},
	{0},
};

const struct pm_tool tool_diag = {
	.name = "diag",
	.summary = "measures energy, momentum, mass, radii, vorticity of every frame",
	.about = "Energies: kinetic; of the field on the mesh, 1/2 integral rho phi (it holds the self-energy of the smeared particles); of the field at the\n"
		"particles, 1/2 sum m phi, where they carry a potential (pp --potential), or with --pair by direct summation. The total takes the\n"
		"particles' where it is known, else the mesh's. What cannot be computed is nan. All sums are compensated and do not depend on the number\n"
		"of threads. Vortices: circulation, impulse, angular impulse, and of omega on the mesh enstrophy, palinstrophy, maximum, value at the\n"
		"centre (the middle of the box; of shear-layer the braid at (0, 1/4)); distortion as in remesh. Plasmas: the charge and the energy eps0/2 integral E^2 of each component. Frames inside a step (substep other than 0) give no row.",
	.kind = PM_SINK,
	.reads = "x, v, mass, the law's strength and potential, density and potential of the mesh",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.end = end,
	.free = release,
};
