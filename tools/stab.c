/* stab: text to stream and back, exactly. With FILE a source: a plain table becomes a frame, text that stab wrote becomes the frames it was made
 * from; without, a sink that writes its input as text (docs/methods/text.md). Cost: about 1 us per row of seven columns.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "stage/file-operands.h"
#include "stage/h5-pipe.h"
#include "stage/table-source.h"
#include "stream/plain-table.h"
#include "stream/text.h"

struct config {
	struct pm_table_options table;
	const char *mesh;
	const char *format;
	bool plain; /* one table: --plain, or a format that has nothing else */
};

struct state {
	struct pm_table_source source;
	uint64_t frames; /* written */
};

static const char *const formats[] = {"text", "tsv", "csv", NULL};
static const struct pm_option options[] = {
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", .fallback = "matter", PM_AT(table.set),
		.text = "name of the set made from a plain table; with --plain the set to write (if the default does not exist, the first that has particles)"},
	{.name = "law", .kind = PM_WORD, .fallback = "free", .choices = pm_law_names, PM_AT(table.law), .text = "the law of the particles of a plain table"},
	{.name = "constant", .kind = PM_LIST, .unit = "NAME=VALUE", PM_AT(table.constants), .text = "constants: G=2.95912208286e-4, softening=0"},
	{.name = "dt", .kind = PM_REAL, .unit = "time", .fallback = "0", .high = 1e300, PM_AT(table.dt),
		.text = "the time step of the frame; 0 leaves it to push --dt"},
	{.name = "time", .kind = PM_REAL, .unit = "time", .fallback = "0", PM_AT(table.time), .text = "the time of the frame"},
	{.name = "dim", .kind = PM_INTEGER, .low = 1, .high = 3, PM_AT(table.dim),
		.text = "number of dimensions, equal to the number of position columns (default: that number)"},
	{.name = "box", .kind = PM_VECTOR, .unit = "length", PM_AT(table.box),
		.text = "lo,hi of every axis, or all lo and then all hi (default: a cube of twice the extent about the particles)"},
	{.name = "faces", .kind = PM_LIST, .unit = "WORD", PM_AT(table.faces),
		.text = "boundary of the fields: periodic, open, wall, neumann or absorbing; one word, one per axis, or low,high per axis (default: open)"},
	{.name = "particle-faces", .kind = PM_LIST, .unit = "WORD", PM_AT(table.particle_faces),
		.text = "boundary of the particles: periodic, reflect, absorb or open"},
	{.name = "cells", .letter = 'n', .kind = PM_CELLS, .unit = "cells", .fallback = "32", PM_AT(table.cells),
		.text = "cells of the default mesh, which spans the box"},
	{.name = "strength", .kind = PM_LIST, .unit = "COLUMN", PM_AT(table.strength),
		.text = "columns that are strengths (extensive) besides mass, charge and circulation"},
	{.name = "unit", .kind = PM_LIST, .unit = "FIELD=UNIT", PM_AT(table.units), .text = "units of the fields"},
	{.name = "text", .kind = PM_LIST, .unit = "COLUMN", PM_AT(table.text), .text = "text columns (at most 16 letters) to keep, besides name"},
	{.name = "skip", .kind = PM_LIST, .unit = "COLUMN", PM_AT(table.skip), .text = "columns to skip"},
	{.name = "number", .kind = PM_FLAG, PM_AT(table.number), .text = "add a field id that counts the rows from 0"},
	{.name = "format", .kind = PM_WORD, .fallback = "text", .choices = formats, PM_AT(format),
		.text = "write whole frames as text that stab reads again, or one table as --plain does, with tabs or commas"},
	{.name = "plain", .kind = PM_FLAG, PM_AT(plain), .text = "write one table without headers; further frames follow after two empty lines"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "with --plain: write this mesh, the coordinates of its points first"},
	{0},
};

static int begin(struct pm_stage *s)
{
	struct config *c = s->config;
	const char *only;
	c->plain = c->plain || strcmp(c->format, "text");
	s->files = s->nargs && pm_file_kind(s->args[0]) != PM_FILE_OTHER;
	if (s->nargs && !s->files)
		s->kind = PM_SOURCE;
	else {
		pm_stage_no_entry(s);
		if ((only = pm_table_option_given(s)))
			return pm_fail(PM_USAGE, "--%s is for reading a table (name its file, or - for standard input)", only);
	}
	if (s->kind == PM_SOURCE && (c->plain || c->mesh))
		return pm_fail(PM_USAGE, "--plain and --mesh are for writing text, as --format is, not for reading '%s'", s->args[0]);
	return c->mesh && !c->plain ? pm_fail(PM_USAGE, "--mesh needs --plain or --format csv") : 0;
}

static int source(struct pm_stage *s, struct pm_frame **f)
{
	return pm_table_source_next(s, &((struct state *)s->state)->source, &((struct config *)s->config)->table, f);
}

/* The set or mesh that --plain writes. */
static const char *table_of(const struct pm_stage *s, const struct pm_frame *f)
{
	const struct config *c = s->config;
	bool other = !pm_given(s, "set") && f->nsets && !pm_frame_set(f, c->table.set);
	size_t first = 0;
	while (first < f->nsets && !f->sets[first]->n)
		first++;
	return c->mesh ? c->mesh : other ? f->sets[first < f->nsets ? first : 0]->name : c->table.set;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	if (c->plain)
		return pm_plain_table_declare(f, table_of(s, f), c->mesh);
	for (size_t i = 0; i < f->nfields; i++)
		f->fields[i]->use |= f->fields[i]->uniform ? 0 : PM_USE_READ;
	return 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	if (c->plain && st->frames)
		fputs("\n\n", stdout);
	st->frames++;
	return c->plain ? pm_plain_table_write(stdout, !strcmp(c->format, "csv"), f, table_of(s, f), c->mesh) : pm_text_frame_write(stdout, f);
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return f ? s->kind == PM_SINK : pm_table_source_by_ranks(s); }

static int end(struct pm_stage *s)
{
	const struct config *c = s->config;
	if (s->kind == PM_SINK && !c->plain)
		pm_text_end_write(stdout, ((struct state *)s->state)->frames);
	return 0;
}

static void done(struct pm_stage *s) { pm_table_source_close(&((struct state *)s->state)->source); }

static const struct pm_example examples[] = {
	{"Three bodies from a table, and back.", "printf 'x y z mass\\n0 0 0 1\\n1 0 0 1e-3\\n0 5.2 0 2e-4\\n' | stab - --law gravity --constant G=39.478 | "
		"stab"},
	{"A scene as a plain table for gnuplot.", "pinit plummer -n 5 | stab --plain"},
	{"From stream to text and back.", "pinit plummer -n 100 > a; stab < a | stab - > b; cmp a b"},
	{0}};

const struct pm_tool tool_stab = {
	.name = "stab",
	.summary = "text to stream and back, exactly",
	.about = "With FILE (- is standard input) a source. A plain table has a line of column names and then one row per line, separated by blanks, "
		"tabs or commas; empty "
		"lines and "
		 "lines that start with # are skipped. x y z are the positions, vx vy vz the velocity, NAME_0 NAME_1 ... the components of a field, id "
		 "whole "
		 "numbers, name a text (stored as a field of bytes with the unit text), any other column a field. Values that are not finite numbers, and "
		"rows with "
		 "too few or too many columns, are errors reported with the line. A table without rows is a set of 0 particles.\n"
		 "Without FILE a sink: every frame as a line of JSON (the header of the stream) and a table per set and mesh, numbers with enough digits to "
		"restore "
		 "the same bits. stab reads this text again, also with rows added or removed.",
	.kind = PM_SINK,
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.arguments = "[FILE...]",
	.arguments_text = "Texts to make a stream of (- is a text on standard input), or streams and .h5 files to write as text; the first bytes tell which. "
		"Without FILE the stream on standard input is written as text.",
	.most = PM_FILES_MOST,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.end = end,
	.free = done,
	.source = source,
};
