/* stab: text to stream and back, exactly. With FILE a source: a plain table becomes a frame, text that stab wrote becomes the frames it was made
 * from; without, a sink that writes its input as text (docs/methods/text.md). Cost: about 1 us a row of seven columns.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "mesh/grid.h"
#include "stage/attribute-options.h"
#include "stream/columns.h"
#include "stream/text.h"

struct config {
	const char *set, *mesh, *law;
	int64_t dim;
	double dt, time;
	struct pm_vector box;
	struct pm_cells cells;
	struct pm_list constants, faces, particle_faces, units, skip, text, strength;
	bool plain, number;
};

struct state {
	struct pm_text text;
	bool open, over;
	uint64_t frames;
};

static const struct pm_option options[] = {
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", .fallback = "matter", PM_AT(set),
		.text = "name of the set a plain table becomes; with --plain the set to write (if there is none of the default, the first)"},
	{.name = "law", .kind = PM_WORD, .fallback = "free", .choices = pm_law_names, PM_AT(law), .text = "the law the particles of a plain table obey"},
	{.name = "constant", .kind = PM_LIST, .unit = "NAME=VALUE", PM_AT(constants), .text = "constants: G=2.95912208286e-4, softening=0"},
	{.name = "dt", .kind = PM_REAL, .unit = "time", .fallback = "0", .high = 1e300, PM_AT(dt),
		.text = "the time step to write into the frame; 0 leaves it to push --dt"},
	{.name = "time", .kind = PM_REAL, .unit = "time", .fallback = "0", PM_AT(time), .text = "the time of the frame"},
	{.name = "dim", .kind = PM_INTEGER, .low = 1, .high = 3, PM_AT(dim),
		.text = "dimensions; the position columns must be as many (they decide without it)"},
	{.name = "box", .kind = PM_VECTOR, .unit = "length", PM_AT(box),
		.text = "lo,hi of every axis, or all lo and then all hi; without it a cube of twice the extent about the particles"},
	{.name = "faces", .kind = PM_LIST, .unit = "WORD", PM_AT(faces),
		.text = "boundary of the fields: periodic, open, wall, neumann or absorbing; one word, one per axis, or low,high per axis (open without it)"},
	{.name = "particle-faces", .kind = PM_LIST, .unit = "WORD", PM_AT(particle_faces),
		.text = "boundary of the particles: periodic, reflect, absorb or open"},
	{.name = "cells", .letter = 'n', .kind = PM_CELLS, .unit = "cells", .fallback = "32", PM_AT(cells),
		.text = "cells of the default mesh, which spans the box"},
	{.name = "strength", .kind = PM_LIST, .unit = "COLUMN", PM_AT(strength),
		.text = "columns that are strengths (extensive) besides mass, charge and circulation"},
	{.name = "unit", .kind = PM_LIST, .unit = "FIELD=UNIT", PM_AT(units), .text = "units to write beside the fields"},
	{.name = "text", .kind = PM_LIST, .unit = "COLUMN", PM_AT(text), .text = "columns of letters (at most 16) to keep, besides name"},
	{.name = "skip", .kind = PM_LIST, .unit = "COLUMN", PM_AT(skip), .text = "columns to leave out"},
	{.name = "number", .kind = PM_FLAG, PM_AT(number), .text = "add a field id that counts the rows from 0"},
	{.name = "plain", .kind = PM_FLAG, PM_AT(plain), .text = "write one table without headers; further frames follow after two empty lines"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "with --plain: write this mesh, the coordinates of its points first"},
	{0},
};

/* Text holds the frames as they are: no entry in their history. */
static void no_entry(struct pm_stage *s)
{
	json_decref(s->entry);
	s->entry = NULL;
}

static int begin(struct pm_stage *s)
{
	const struct config *c = s->config;
	static const char *const reading[] = {"law", "constant", "dt", "time", "dim", "box", "faces", "particle-faces", "cells", "strength", "unit", "text", "skip", "number", NULL};
	if (s->nargs)
		s->kind = PM_SOURCE;
	else {
		no_entry(s);
		for (int i = 0; reading[i]; i++)
			if (pm_given(s, reading[i]))
				return pm_fail(PM_USAGE, "--%s is for reading a table (name its file, or - for standard input)", reading[i]);
	}
	if (s->nargs && (c->plain || c->mesh))
		return pm_fail(PM_USAGE, "--plain and --mesh are for writing text; reading '%s' needs neither", s->args[0]);
	return c->mesh && !c->plain ? pm_fail(PM_USAGE, "--mesh goes with --plain") : 0;
}

/* ---- text to stream ---- */

static int number(struct pm_frame *f, const char *set)
{
	struct pm_field *id = pm_frame_field(f, set, "id") ? NULL : pm_makes(f, set, "id", 1, PM_STATE);
	if (!id)
		return pm_fail(PM_DATA, "the table has a column id already (leave --number out)");
	id->type = PM_I64;
	if (pm_field_ready(id))
		return -PM_DATA;
	for (size_t i = 0; i < id->count; i++)
		pm_out_i64(id, 0)[i] = (int64_t)i;
	id->use = 0;
	return 0;
}

static int table(struct pm_stage *s, struct pm_text *text, struct pm_frame **f)
{
	struct config *c = s->config;
	const struct pm_columns_choice choice = {.set = c->set, .dim = c->dim > 0 ? (int)c->dim : 0, .skip = c->skip.item, .text = c->text.item, .strength = c->strength.item};
	size_t cells[3];
	int status;
	c->skip.item[c->skip.n < PM_LIST_MOST ? c->skip.n : PM_LIST_MOST - 1] = NULL;
	c->text.item[c->text.n < PM_LIST_MOST ? c->text.n : PM_LIST_MOST - 1] = NULL;
	c->strength.item[c->strength.n < PM_LIST_MOST ? c->strength.n : PM_LIST_MOST - 1] = NULL;
	if ((status = pm_columns_frame(text, &choice, f)) || (c->number && (status = number(*f, c->set))))
		return status;
	struct pm_frame *g = *f;
	g->dt = c->dt, g->time = g->start = c->time;
	pm_columns_box(g, c->set);
	if ((status = pm_attributes_constants(g, &c->constants)) || (status = pm_attributes_law(g, c->law)) || (status = pm_attributes_box(g, &c->box)) ||
		(status = pm_attributes_faces(g, &c->faces)) || (status = pm_attributes_particle_faces(g, &c->particle_faces)) ||
		(status = pm_attributes_units(g, c->set, &c->units)) || (status = pm_cells_for(&c->cells, g->dim, cells)))
		return status;
	if (!c->box.n)
		pm_report_text(s, g, "box", "automatic");
	return pm_frame_mesh_new(g, "mesh", cells) ? 0 : -PM_DATA;
}

static int frames(struct pm_stage *s, struct state *st, struct pm_frame **f)
{
	static const char *const plain[] = {"law", "constant", "dt", "time", "dim", "box", "faces", "particle-faces", "cells", "strength", "unit", "text", "skip", "number", "set", NULL};
	for (int i = 0; plain[i]; i++)
		if (pm_given(s, plain[i]))
			return pm_fail(PM_USAGE, "--%s is for plain tables, and this text holds whole frames (change them with smod)", plain[i]);
	no_entry(s);
	return pm_text_frame_read(&st->text, f, &st->frames);
}

static int source(struct pm_stage *s, struct pm_frame **f)
{
	struct state *st = s->state;
	char why[512];
	int status = st->open ? 0 : pm_text_open(&st->text, s->args[0]);
	if (status || st->over)
		return status;
	*f = NULL;
	st->over = !st->open && !pm_text_is_frames(&st->text);
	st->open = true;
	status = st->over ? table(s, &st->text, f) : frames(s, st, f);
	if (st->over && !status)
		return 1;
	if (status < 0) {
		*f = pm_frame_free(*f);
		snprintf(why, sizeof why, "%s", pm_message());
		return pm_fail(-status, "%s: %s", strcmp(s->args[0], "-") ? s->args[0] : "standard input", why);
	}
	return status;
}

/* ---- stream to text ---- */

/* The set or mesh that --plain writes. */
static const char *table_of(const struct pm_stage *s, const struct pm_frame *f)
{
	const struct config *c = s->config;
	bool other = !pm_given(s, "set") && f->nsets && !pm_frame_set(f, c->set);
	return c->mesh ? c->mesh : other ? f->sets[0]->name : c->set;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	const char *on = table_of(s, f);
	if (c->plain && !(c->mesh ? (void *)pm_frame_mesh(f, on) : (void *)pm_frame_set(f, on)))
		return pm_fail(PM_DATA, "no %s '%s' (sls lists what there is)", c->mesh ? "mesh" : "set", on);
	for (size_t i = 0; i < f->nfields; i++)
		if (c->plain ? !strcmp(f->fields[i]->on, on) : !f->fields[i]->uniform)
			f->fields[i]->use |= PM_USE_READ;
	if (c->mesh && pm_frame_field(f, on, "x"))
		return pm_fail(PM_DATA, "the mesh '%s' has a field x, which is what the coordinates are called (rename it with smod --rename)", on);
	return c->mesh && !pm_makes(f, on, "x", f->dim, PM_STATE) ? -PM_DATA : 0;
}

static void coordinates(const struct pm_frame *f, const struct pm_mesh *m, struct pm_field *x)
{
	struct pm_grid g = pm_grid_of(f, m);
	for (size_t p = 0; p < x->count; p++) {
		size_t at[3] = {p % g.points[0], p / g.points[0] % g.points[1], p / g.points[0] / g.points[1]};
		for (int a = 0; a < f->dim; a++)
			pm_out(x, a)[p] = g.lo[a] + (double)at[a] * g.h[a];
	}
}

static int plain_table(const struct config *c, struct pm_frame *f, const char *on)
{
	struct pm_column column[PM_COLUMNS + 3];
	size_t rows = 0;
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->on, on))
			f->fields[i]->uniform = false, rows = f->fields[i]->count;
	int n = pm_table_columns(f, on, column + 3), axes = c->mesh ? f->dim : 0;
	if (c->mesh)
		coordinates(f, pm_frame_mesh(f, on), pm_frame_field(f, on, "x"));
	if (n < 0)
		return n;
	struct pm_column *first = column + 3 - axes;
	memmove(first, column + 3 + n - axes, (size_t)axes * sizeof *column); /* x was made last and comes first */
	return pm_table_write(stdout, rows, n, first);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	if (c->plain && st->frames)
		fputs("\n\n", stdout);
	st->frames++;
	return c->plain ? plain_table(c, f, table_of(s, f)) : pm_text_frame_write(stdout, f);
}

static int end(struct pm_stage *s)
{
	const struct config *c = s->config;
	if (s->kind == PM_SINK && !c->plain)
		pm_text_end_write(stdout, ((struct state *)s->state)->frames);
	return 0;
}

static void done(struct pm_stage *s)
{
	struct state *st = s->state;
	if (st->open)
		pm_text_close(&st->text);
}

static const struct pm_example examples[] = {
	{"Three bodies from a table, and back.", "printf 'x y z mass\\n0 0 0 1\\n1 0 0 1e-3\\n0 5.2 0 2e-4\\n' | stab - --law gravity --constant G=39.478 | stab"},
	{"A scene as a plain table for gnuplot.", "pinit plummer -n 5 | stab --plain"},
	{"Text and stream are the same thing twice.", "pinit plummer -n 100 > a; stab < a | stab - > b; cmp a b"},
	{0}};

const struct pm_tool tool_stab = {
	.name = "stab",
	.summary = "text to stream and back, exactly",
	.about = "With FILE (- is standard input) a source. A plain table has a line of column names and then a row a line, blanks or tabs between; empty lines and "
		 "lines that start with # are passed over. x y z are the positions, vx vy vz the velocity, NAME_0 NAME_1 ... the components of a field, id whole "
		 "numbers, name letters (kept as a field of bytes with the unit text), any other column a field. A value that is no number or not finite, "
		 "and a row with too few or too many columns, is an error that names its line. No rows are legal: a set of 0 particles.\n"
		 "Without FILE a sink: every frame as a line of JSON (the header of the stream) and a table per set and mesh, numbers with as many digits as "
		 "bring back the same bits. stab reads this text again, rows added or removed included.",
	.kind = PM_SINK,
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.arguments = "[FILE]",
	.arguments_text = "A text to read; without it the stream on standard input is written as text.",
	.most = 1,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.end = end,
	.free = done,
	.source = source,
};
