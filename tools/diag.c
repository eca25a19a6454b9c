/* diag: measures every frame and prints a row of numbers; with --tee it writes them to a file instead. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/replace.h"
#include "measure/diag-table.h"
#include "stage/stage.h"
#include "world/launch.h"
#include "world/world.h"

struct config {
	const char *set, *format, *tee;
	struct pm_list columns, separation;
	struct pm_vector radii, modes, flux;
	const char *growth, *window;
	bool pair, exact, average, field, species;
};
struct state {
	FILE *out;
	struct pm_replace tee;
	struct pm_diag_table table;
	bool told;   /* why there is no energy */
	bool within; /* a frame inside a step was left out */
};
static const char *const formats[] = {"tsv", "csv", "json", "table", NULL}; /* as enum pm_diag_format */
_Static_assert((int)PM_LIST_MOST <= (int)PM_DIAG_ASKED, "every column of --columns has room");

/* As typed, else a table that people read where they look at it. */
static enum pm_diag_format format_of(const struct pm_stage *s)
{
	const struct config *c = s->config;
	int k = 0;
	while (c->format && strcmp(c->format, formats[k]))
		k++;
	return c->format ? (enum pm_diag_format)k : !c->tee && !pm_given(s, "output") && pm_output_is_terminal() ? PM_DIAG_READABLE : PM_DIAG_TSV;
}

static int begin(struct pm_stage *s)
{
	struct config *c = s->config;
	struct state *state = s->state;
	struct pm_diag_choice choice = {.set = c->set, .columns = c->columns.item, .ncolumns = c->columns.n, .radii = c->radii.x, .nradii = c->radii.n,
		.modes = c->modes.x, .nmodes = c->modes.n, .growth = c->growth, .window = c->window,
		.pair = c->pair, .exact = c->exact, .average = c->average, .field_errors = c->field, .species = c->species,
		.flux = c->flux.n ? c->flux.x : NULL, .nflux = c->flux.n, .format = format_of(s), .width = pm_readable_width(STDOUT_FILENO)};
	if (c->separation.n && c->separation.n != 2)
		return pm_fail(PM_USAGE, "--separation takes two sets (--separation matter,shadow)");
	for (int k = 0; k < c->separation.n; k++)
		choice.separation[k] = c->separation.item[k];
	if (pm_diag_table_init(&state->table, &choice, stdout))
		return -PM_USAGE;
	s->kind = c->tee ? PM_FILTER : PM_SINK;
	state->out = stdout;
	if (c->tee && !strcmp(c->tee, "-"))
		return pm_fail(PM_USAGE, "--tee -: the frames go to standard output, and a table is none (--tee FILE)");
	if (c->tee && pm_replace_open(&state->tee, pm_world_rank() ? "/dev/null" : c->tee, false)) /* rank 0 writes */
		return pm_failed();
	if (c->tee)
		state->out = fdopen(state->tee.fd, "w");
	state->table.out = state->out;
	state->table.readable.live = state->out == stdout && pm_output_is_terminal() && isatty(STDERR_FILENO);
	return state->out ? 0 : pm_fail_errno("cannot write '%s'", c->tee);
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	struct state *state = s->state;
	state->within = state->within || f->substep;
	return f->substep ? PM_PASS /* state is not at the header's time */ : pm_diag_table_reads(&state->table, f);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *state = s->state;
	int status = pm_diag_table_row(&state->table, f);
	const bool lacks = state->table.lacks[0] && state->table.expected && !state->table.readable.n; /* which has its own notes */
	if (!status && state->table.unknown[0] && !state->told)
		pm_note(s, "energy is nan: %s (energy_kinetic and energy_field_... are its known parts)", state->table.unknown);
	else if (!status && lacks && !state->told)
		pm_note(s, "energy is nan: %s", state->table.lacks);
	state->told = state->told || state->table.unknown[0] || lacks;
	for (int i = 0; i < PM_READABLE_NOTES && !status && state->table.readable.note[i][0]; i++) {
		pm_note(s, "%s", state->table.readable.note[i]);
		state->table.readable.note[i][0] = 0;
	}
	if (!status && state->table.note[0])
		pm_tell_once(s, "%s", state->table.note);
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return pm_diag_table_shared(&((const struct state *)s->state)->table, f); }

static int end(struct pm_stage *s)
{
	struct state *state = s->state;
	int status = pm_diag_table_end(&state->table);
	if (!status && !state->table.n && state->within)
		pm_note(s, "no row: every frame lies inside a step, where states and time are not those of one instant (cycle writes whole steps)");
	return status || state->out == stdout ? status : fflush(state->out) ? pm_fail_errno("cannot write the table") : pm_replace_commit(&state->tee, false);
}

static void release(struct pm_stage *s)
{
	struct state *state = s->state;
	pm_diag_table_clear(&state->table);
	if (state->out && state->out != stdout)
		fclose(state->out);
	pm_replace_drop(&state->tee);
}

static const struct pm_option options[] = {
	{.name = "set", .kind = PM_TEXT, .cosmetic = true, PM_AT(set), .text = "measure only this set (default: all)"},
	{.name = "columns", .kind = PM_LIST, .choices = pm_column_names, .numbered = pm_columns_numbered, .cosmetic = true, PM_AT(columns),
		.text = "print these columns in this order (default: all), also mode_M and radius_F, as --modes and --radii add them"},
	{.name = "radii", .kind = PM_VECTOR, .cosmetic = true, PM_AT(radii),
		.text = "add Lagrangian radii about the centre of mass, for these fractions of the mass"},
	{.name = "modes", .kind = PM_VECTOR, .cosmetic = true, PM_AT(modes),
		.text = "add the amplitudes of these waves along x of the law's field (u.y of vortices, E.y of light, else the first component); "
			"in open space the amplitudes [length] of these waves around a vortex, a ring of vortices or a vortex ring"},
	{.name = "separation", .kind = PM_LIST, .unit = "SET", PM_AT(separation),
		.text = "add the root mean square distance of two sets, particle by particle, and of their velocities: a run and its shadow (stack)"},
	{.name = "species", .kind = PM_FLAG, .cosmetic = true, PM_AT(species),
		.text = "add for every set particles, kinetic energy, mean and covariance of the velocities (the temperature tensor over the mass)"},
	{.name = "flux-box", .kind = PM_VECTOR, .unit = "LOW,HIGH", .cosmetic = true, PM_AT(flux),
		.text = "add the flux of -grad phi out of the box between these corners and Gauss's charge inside; of light its power and the energy inside"},
	{.name = "field-errors", .kind = PM_FLAG, .cosmetic = true, PM_AT(field),
		.text = "add field_residual, of lap phi = c rho, and field_curl, of the law's field"},
	{.name = "average", .kind = PM_FLAG, .cosmetic = true, PM_AT(average),
		.text = "after the table print a line for each column: mean over the frames, its error by blocks, autocorrelation time"},
	{.name = "growth", .kind = PM_TEXT, .unit = "mode:M|COLUMN", .cosmetic = true, PM_AT(growth),
		.text = "after the table print a line with the growth rate and frequency of wave M along x, or of a column; or none, and why"},
	{.name = "window", .kind = PM_TEXT, .unit = "T0:T1", .cosmetic = true, PM_AT(window),
		.text = "fit them between these times (default: where the rate has the smallest error)"},
	{.name = "pair", .kind = PM_FLAG, .cosmetic = true, PM_AT(pair),
		.text = "sum the pair energy over all pairs, softened as pp was, else as the frame says (cost n^2)"},
	{.name = "exact", .kind = PM_FLAG, .cosmetic = true, PM_AT(exact), .text = "add a column exact_NAME for every column whose exact value the scene "
		"provides"},
	{.name = "format", .kind = PM_WORD, .choices = formats, .cosmetic = true, PM_AT(format),
		.text = "a header line and a line per frame; one JSON object per line; or, the default on a terminal, a table of few columns and digits"},
	{.name = "tee", .kind = PM_TEXT, .unit = "FILE", .cosmetic = true, PM_AT(tee), .text = "write to FILE and pass the frames on"},
	{0},
};

static const struct pm_example examples[] = {
	{"A star cluster compared with the exact values", "pinit plummer -n 1000 | diag --pair --exact --radii 0.1,0.5,0.9"},
	{"Two columns as JSON", "pinit two-body --eccentricity 0.5 | diag --pair --columns energy,angular_momentum_z --format json"},
	{"A decaying vortex compared with the exact values", "pinit lamb-oseen | p2m | diag --exact"},
	{"The growth rate of two cold streams", "pinit two-stream -n 2000 --cells 32 | cycle -n 300 --every 4 'push kick/2 drift | p2m | poisson-fft | mgrad "
		"| m2p | push kick/2' "
		"| p2m | poisson-fft | mgrad | diag --columns time,energy_field_x --modes 1 --growth mode:1"},
	{"A table written while the stream is passed on", "pinit uniform -n 100 --dispersion 1 | diag --tee start.tsv | sls"},
	{0},
};

const struct pm_tool tool_diag = {
	.name = "diag",
	.summary = "measures energy, momentum, mass, radii, vorticity of every frame",
	.about = "Energies: kinetic; of the field on the mesh, 1/2 integral rho phi (it includes the self-energy of the smoothed particles); of the field "
		"at the\n"
		"particles, 1/2 sum m phi, if they have a potential (pp --potential), or with --pair by direct summation. The total takes the\n"
		"particles' energy if known, else that of the mesh; it is nan where a given force acts (field), whose potential nobody states.\n"
		"Quantities that cannot be computed are nan. All sums are compensated and do not depend on the number\n"
		"of threads. Vortices: circulation, impulse, angular impulse, and of omega on the mesh enstrophy, palinstrophy, maximum, value at the\n"
		"centre (the middle of the box; of shear-layer the braid at (0, 1/4)); distortion as in remesh. Plasmas: the charge and the energy eps0/2 "
		"integral E^2 of each component. Frames inside a step (substep other than 0) give no row.",
	.kind = PM_SINK,
	.reads = "x, v, mass, the law's strength and potential, density and potential of the mesh",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.end = end,
	.free = release,
};
