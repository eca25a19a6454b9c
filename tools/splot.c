/* splot: columns of tables as curves, in the terminal or as PNG, SVG or PPM (lib/chart/, docs/methods/splot.md). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "chart/plot-job.h"
#include "stage/stage.h"

static const char *const legends[] = {"auto", "outside", "none", NULL};

struct config {
	const char *style, *legend;
	struct pm_list columns, errors, xerrors, by, where, styles;
	struct pm_vector slope, level, mark, xrange, yrange;
	int64_t width, height;
	bool log, logx, logy;
	struct pm_plot_job job;
};

static const struct pm_option options[] = {
	{.name = "output", .letter = 'o', .kind = PM_TEXT, .unit = "FILE", .cosmetic = true, PM_AT(job.output),
		.text = "the picture, by its ending .png, .svg or .ppm (default: text on the terminal)"},
	{.name = "input", .letter = 'i', .kind = PM_TEXT, .unit = "FILE", .cosmetic = true, PM_AT(job.input),
		.text = "read this table instead of standard input"},
	{.name = "as-text", .kind = PM_FLAG, PM_AT(job.text), .text = "text, also where standard output is no terminal"},
	{.name = "ascii", .kind = PM_FLAG, PM_AT(job.ascii), .text = "text of ASCII letters alone"},
	{.name = "x", .letter = 'x', .kind = PM_TEXT, .unit = "COLUMN", PM_AT(job.columns.x),
		.text = "the column along x, or an expression (default: time, else the first column)"},
	{.name = "column", .letter = 'y', .kind = PM_LIST, .unit = "COLUMN", PM_AT(columns),
		.text = "columns to draw, as if they were arguments, for names that are files too"},
	{.name = "log", .letter = 'l', .kind = PM_FLAG, PM_AT(log), .text = "both axes logarithmic; 0 is drawn below a break at the low end"},
	{.name = "log-x", .kind = PM_FLAG, PM_AT(logx), .text = "the x axis logarithmic"},
	{.name = "log-y", .kind = PM_FLAG, PM_AT(logy), .text = "the y axis logarithmic"},
	{.name = "x-range", .kind = PM_VECTOR, .unit = "LO,HI", PM_AT(xrange), .text = "ends of the x axis (default: those of the data)"},
	{.name = "y-range", .kind = PM_VECTOR, .unit = "LO,HI", PM_AT(yrange), .text = "ends of the y axis"},
	{.name = "error", .letter = 'e', .kind = PM_LIST, .unit = "COLUMN", PM_AT(errors),
		.text = "half lengths of error bars along y, a column for each one drawn (- none)"},
	{.name = "x-error", .kind = PM_LIST, .unit = "COLUMN", PM_AT(xerrors), .text = "half lengths of error bars along x"},
	{.name = "by", .letter = 'b', .kind = PM_LIST, .unit = "COLUMN", PM_AT(by), .text = "a line for each value of these columns"},
	{.name = "where", .letter = 'w', .kind = PM_LIST, .unit = "COLUMN=VALUE", PM_AT(where), 
		.text = "only rows with this value (of several: with all of them)"},
	{.name = "name", .kind = PM_TEXT, .unit = "COLUMN", PM_AT(job.columns.name), .text = "write the words of this column beside the points"},
	{.name = "theory", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(job.theory),
		.text = "a line of x, perhaps with its name: 'decay = exp(-0.15*x)'; several with ; between"},
	{.name = "slope", .kind = PM_VECTOR, .unit = "1", PM_AT(slope), 
		.text = "lines of these slopes (on logarithmic axes: powers), through the middle of the first, the second ... line of data"},
	{.name = "level", .kind = PM_VECTOR, .unit = "Y", PM_AT(level), .text = "horizontal lines"},
	{.name = "mark", .kind = PM_VECTOR, .unit = "X", PM_AT(mark), .text = "vertical lines"},
	{.name = "style", .letter = 's', .kind = PM_WORD, .fallback = "auto", .choices = pm_chart_styles, PM_AT(style),
		.text = "lines, points, both, or steps; auto: both up to 60 points, then lines"},
	{.name = "style-of", .kind = PM_LIST, .unit = "LABEL=STYLE", PM_AT(styles), .text = "the style of one line; steps is then thick and black too"},
	{.name = "title", .kind = PM_TEXT, .unit = "TEXT", PM_AT(job.title), .text = "title"},
	{.name = "x-label", .kind = PM_TEXT, .unit = "TEXT", PM_AT(job.label[0]), .text = "label of the x axis, as 'time [s]' (default: the column)"},
	{.name = "y-label", .kind = PM_TEXT, .unit = "TEXT", PM_AT(job.label[1]), .text = "label of the y axis"},
	{.name = "legend", .kind = PM_WORD, .fallback = "auto", .choices = legends, PM_AT(legend),
		.text = "auto: where no data are, else beside the picture"},
	{.name = "width", .kind = PM_INTEGER, .unit = "pixels", .low = 20, .high = 8192, PM_AT(width),
		.text = "of the picture (default: 900), or of text in letters (default: the terminal's, or 79)"},
	{.name = "height", .kind = PM_INTEGER, .unit = "pixels", .low = 8, .high = 8192, PM_AT(height), .text = "alike (default: 620; the terminal's, or 24)"},
	{0},
};

static int whole(struct pm_stage *s)
{
	struct config *c = s->config;
	struct pm_plot_job *j = &c->job;
	const struct pm_list *const list[] = {&c->columns, &c->errors, &c->xerrors, &c->by, &c->where, &c->styles};
	const struct pm_vector *const numbers[] = {&c->xrange, &c->yrange, &c->slope, &c->mark, &c->level};
	for (int k = 0; k < 6; k++)
		j->list[k] = list[k]->item, j->n[k] = list[k]->n;
	for (int k = 0; k < 5; k++)
		j->numbers[k] = numbers[k]->x, j->count[k] = numbers[k]->n;
	while (strcmp(pm_chart_styles[j->columns.style], c->style))
		j->columns.style++;
	j->logx = c->log || c->logx, j->logy = c->log || c->logy;
	j->legend_outside = *c->legend == 'o', j->no_legend = *c->legend == 'n';
	j->width = pm_given(s, "width") ? (int)c->width : 0, j->height = pm_given(s, "height") ? (int)c->height : 0;
	int status = pm_plot_job_run(j, s->nargs, s->args);
	if (!status && j->beyond)
		pm_note(s, "numbers below 0, which a logarithmic axis leaves out: %zu", j->beyond);
	if (!status && j->unplaced)
		pm_note(s, "names beside points without room: %zu (a larger --width and --height, or fewer rows with --where)", j->unplaced);
	return status;
}

static const struct pm_example examples[] = {
	{"The energy of a run against time, on the terminal (here as text).", "pinit plummer -n 50 | cycle -n 20 --every 1 "
		"'push kick/2 drift | pp | push kick/2' | diag --pair | splot energy_kinetic --as-text"},
	{"The drift of the energy as a picture.", "pinit plummer -n 50 | cycle -n 20 --every 1 'push kick/2 drift | pp | push kick/2' | diag --pair | "
		"splot 'abs(energy/energy0 - 1)' --log-y -o drift.png"},
	{"Errors against the step, with the slope of theory.", "printf 'dt error\\n0.1 1e-2\\n0.05 2.4e-3\\n0.025 6.1e-4\\n' | splot error --log --slope 2 "
		"-o order.svg"},
	{0}};

const struct pm_tool tool_splot = {
	.name = "splot",
	.summary = "columns of tables as curves, in the terminal or as a picture",
	.about = "Draws columns of diag's table, or of any table with tabs, commas or blanks between its columns, against time (or --x). Arguments that are "
		"files are tables; all others are columns, or expressions over columns such as 'energy/energy0 - 1', where NAME0 is the first number of a "
		"column. Without files the table is read from standard input. Several files are drawn over each other. nan, - and empty cells are gaps. See "
		"docs/methods/splot.md.",
	.kind = PM_SINK,
	.config = sizeof(struct config),
	.options = options,
	.arguments = "[COLUMN|FILE...]",
	.arguments_text = "Columns to draw, and tables to read; with neither all columns of a narrow table on standard input.",
	.most = 256,
	.examples = examples,
	.whole = whole,
};
