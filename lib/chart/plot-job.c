/* Tables and columns into a chart, the chart into a file or the terminal. SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/replace.h"
#include "chart/canvas.h"
#include "chart/plot-job.h"
#include "world/launch.h"

enum { most_files = 64, most_columns = 64, few_columns = 6 };
enum kind { TEXT, PNG, SVG, PPM };

struct plot {
	struct pm_plot_job *job;
	struct pm_chart chart;
	struct pm_number_table table[most_files];
	const char *file[most_files], *column[most_columns];
	int nfiles, ncolumns;
	enum kind kind;
	struct pm_chart_guide guide[2][16];
};

static int kind_of(const struct pm_plot_job *job, enum kind *kind)
{
	static const char *const endings[] = {"png", "svg", "ppm"};
	const char *name = job->output, *dot = name ? strrchr(name, '.') : NULL;
	*kind = TEXT;
	if (job->text && name && strcmp(name, "-"))
		return pm_fail(PM_USAGE, "--as-text goes to standard output (leave --output out, or redirect it with >)");
	if (!name || !strcmp(name, "-")) {
		if (name || job->text || job->ascii || pm_output_is_terminal())
			return 0;
		return pm_fail(PM_USAGE, "standard output is no terminal (-o FILE.png, .svg or .ppm for a picture, or --as-text)");
	}
	for (int k = 0; dot && k < 3; k++)
		if (!strcasecmp(dot + 1, endings[k]))
			return *kind = (enum kind)(k + 1), 0;
	return pm_fail(PM_USAGE, "--output '%s': the ending says the kind of the picture, .png, .svg or .ppm", name);
}

static bool is_file(const char *name)
{
	struct stat st;
	return !strcmp(name, "-") || (!stat(name, &st) && !S_ISDIR(st.st_mode));
}

/* a/b.tsv: what is not there, but is written as a file, is one too, and is missed under its name. */
static bool looks_like_file(const char *name)
{
	const char *dot = strrchr(name, '.');
	return dot && (!strcmp(dot, ".tsv") || !strcmp(dot, ".csv") || !strcmp(dot, ".txt") || !strcmp(dot, ".dat"));
}

static int arguments(struct plot *p, int nargs, const char *const *args)
{
	const struct pm_plot_job *job = p->job;
	for (int i = 0; i < job->n[0]; i++)
		p->column[p->ncolumns++] = job->list[0][i];
	if (job->input)
		p->file[p->nfiles++] = job->input;
	for (int i = 0; i < nargs; i++) {
		bool file = is_file(args[i]) || looks_like_file(args[i]);
		if (p->nfiles == most_files || p->ncolumns == most_columns)
			return pm_fail(PM_USAGE, "more than %d files or %d columns", most_files, most_columns);
		if (file)
			p->file[p->nfiles++] = args[i];
		else
			p->column[p->ncolumns++] = args[i];
	}
	if (!p->nfiles && isatty(STDIN_FILENO))
		return pm_fail(PM_USAGE, "no table: name a file, or send one through a pipe (... | diag | splot energy)");
	if (!p->nfiles)
		p->file[p->nfiles++] = "-";
	return 0;
}

/* Without a column: all of a narrow table. */
static int choose_columns(struct plot *p)
{
	const struct pm_number_table *t = &p->table[0];
	const char *x = pm_chart_x_name(&p->job->columns, t);
	if (p->ncolumns)
		return 0;
	if (t->columns > few_columns + 1)
		return pm_number_table_choose(t);
	for (size_t c = 0; c < t->columns; c++) {
		bool number = false;
		for (size_t i = 0; i < t->rows; i++)
			number |= isfinite(t->number[c * t->rows + i]);
		if (number && strcmp(t->name[c], x))
			p->column[p->ncolumns++] = t->name[c];
	}
	if (!p->ncolumns)
		return pm_fail(PM_DATA, "%s has no column of numbers besides '%s'", t->path, x);
	return 0;
}

/* The name of a file without what all of them share: its directory if there is but one, and its ending. */
static void short_name(const struct plot *p, int k, char out[256])
{
	const char *base = strrchr(p->file[k], '/');
	base = base ? base + 1 : p->file[k];
	bool alone = true;
	for (int i = 0; i < p->nfiles; i++) {
		const char *other = strrchr(p->file[i], '/');
		other = other ? other + 1 : p->file[i];
		alone &= i == k || strcmp(base, other);
	}
	const char *name = alone ? base : p->file[k], *dot = strrchr(name, '.');
	snprintf(out, 256, "%.*s", dot && dot > name ? (int)(dot - name) : (int)strlen(name), name);
}

static int read_all(struct plot *p)
{
	struct pm_plot_job *job = p->job;
	struct pm_chart_columns *w = &job->columns;
	int status = 0;
	w->nerrors = job->n[1], w->error = job->list[1], w->nxerrors = job->n[2], w->xerror = job->list[2];
	w->nby = job->n[3], w->by = job->list[3], w->nwhere = job->n[4], w->where = job->list[4];
	w->nstyles = job->n[5], w->styles = job->list[5];
	for (int k = 0; k < p->nfiles && !status; k++) {
		char file[256] = "";
		status = pm_number_table_read(&p->table[k], p->file[k]);
		if (!status && !k)
			status = choose_columns(p);
		w->ncolumns = p->ncolumns, w->column = p->column;
		if (p->nfiles > 1)
			short_name(p, k, file);
		if (!status)
			status = pm_chart_add(&p->chart, w, &p->table[k], file);
	}
	return status ? status : pm_chart_restyle(&p->chart, w);
}

static void labels(struct plot *p)
{
	struct pm_chart *c = &p->chart;
	struct pm_plot_job *job = p->job;
	const char *x = pm_chart_x_name(&job->columns, &p->table[0]);
	int column = pm_number_table_find(&p->table[0], x, strlen(x)), y = pm_number_table_find(&p->table[0], p->column[0], strlen(p->column[0]));
	c->x.label = job->label[0] ? job->label[0] : column >= 0 ? p->table[0].name[column] : x; /* with its unit */
	c->y.label = job->label[1] ? job->label[1] : p->ncolumns == 1 ? y >= 0 ? p->table[0].name[y] : p->column[0] : NULL;
	if (c->nseries == 1 && p->ncolumns == 1 && !job->n[3])
		*c->series[0].label = 0; /* the axis says it */
	c->title = job->title;
	c->legend_outside = job->legend_outside, c->no_legend = job->no_legend;
}

static int guides(struct plot *p)
{
	struct pm_chart *c = &p->chart;
	const struct pm_plot_job *job = p->job;
	const int data = (int)c->nseries;
	int status = 0;
	for (int d = 0; d < 2; d++) {
		for (int i = 0; i < job->count[3 + d] && i < 16; i++)
			p->guide[d][i].at = job->numbers[3 + d][i];
		c->level[d] = p->guide[d], c->nlevels[d] = (size_t)job->count[3 + d];
	}
	if ((status = pm_chart_scale(c)))
		return status;
	if (job->theory)
		status = pm_chart_theory(c, job->theory);
	for (int i = 0; i < job->count[2] && !status; i++) /* the first through the first line, the second through the second */
		status = pm_chart_slope(c, job->numbers[2][i], i < data ? i : data - 1);
	return status;
}

static bool speaks_utf8(void)
{
	const char *names[] = {"LC_ALL", "LC_CTYPE", "LANG"};
	for (int k = 0; k < 3; k++) {
		const char *s = getenv(names[k]);
		if (s && *s)
			return strcasestr(s, "utf-8") || strcasestr(s, "utf8");
	}
	return false;
}

static int to_terminal(struct plot *p)
{
	struct winsize w = {.ws_col = 0};
	const bool terminal = pm_output_is_terminal();
	const char *none = getenv("NO_COLOR"), *term = getenv("TERM");
	bool sized = terminal && !ioctl(STDOUT_FILENO, TIOCGWINSZ, &w) && w.ws_col > 20 && w.ws_row > 8;
	p->chart.width = p->job->width ? p->job->width : sized ? w.ws_col : 79;
	p->chart.height = p->job->height ? p->job->height : sized ? w.ws_row - 2 : 24;
	p->chart.width = p->chart.width > 1000 ? 1000 : p->chart.width;
	return pm_chart_print(&p->chart, stdout, (struct pm_chart_print){.ascii = p->job->ascii || !speaks_utf8(),
		.colours = terminal && !(none && *none) && !(term && !strcmp(term, "dumb"))});
}

static int write_pixels(struct plot *p, FILE *out)
{
	struct pm_picture picture;
	static const unsigned char white[3] = {255, 255, 255};
	int status = pm_picture_new(&picture, p->chart.width, p->chart.height, white);
	if (status)
		return status;
	struct pm_canvas canvas = pm_canvas_pixels(&picture);
	status = pm_chart_draw(&p->chart, &canvas);
	if (!status)
		status = p->kind == PNG ? pm_picture_png(&picture, out) : pm_picture_ppm(&picture, out);
	pm_picture_free(&picture);
	return status;
}

static int to_file(struct plot *p)
{
	struct pm_replace file;
	p->chart.width = p->job->width ? p->job->width : 900, p->chart.height = p->job->height ? p->job->height : 620;
	if (p->chart.width < 120 || p->chart.height < 90)
		return pm_fail(PM_USAGE, "%d by %d pixels are too few for a picture (at least --width 120 --height 90)", p->chart.width, p->chart.height);
	int status = pm_replace_open(&file, p->job->output, true);
	if (status)
		return status;
	FILE *out = fdopen(dup(file.fd), "wb");
	if (!out)
		status = pm_fail_errno("cannot write '%s'", p->job->output);
	else if (p->kind == SVG) {
		struct pm_canvas canvas = pm_canvas_svg(out, p->chart.width, p->chart.height);
		status = pm_chart_draw(&p->chart, &canvas);
		pm_canvas_svg_end(&canvas);
	} else
		status = write_pixels(p, out);
	bool bad = out && (fflush(out) || ferror(out));
	bad |= out && fclose(out);
	if (bad && !status)
		status = pm_fail_errno("cannot write '%s'", p->job->output);
	if (!status)
		status = pm_replace_commit(&file, false);
	close(file.fd);
	pm_replace_drop(&file);
	return status;
}

static int axis(const struct pm_plot_job *job, int which, struct pm_chart_axis *a)
{
	const double *x = job->numbers[which];
	const int n = job->count[which];
	if (n && (n != 2 || !(x[1] > x[0])))
		return pm_fail(PM_USAGE, "--%c-range takes LO,HI with LO below HI", "xy"[which]);
	*a = (struct pm_chart_axis){.log = which ? job->logy : job->logx, .lo = n ? x[0] : NAN, .hi = n ? x[1] : NAN};
	return 0;
}

int pm_plot_job_run(struct pm_plot_job *job, int nargs, const char *const *args)
{
	struct plot *p = calloc(1, sizeof *p);
	if (!p)
		return pm_no_memory();
	p->job = job;
	int status = kind_of(job, &p->kind);
	if (!status)
		status = axis(job, 0, &p->chart.x);
	if (!status)
		status = axis(job, 1, &p->chart.y);
	if (!status)
		status = arguments(p, nargs, args);
	if (!status)
		status = read_all(p);
	if (!status) {
		p->chart.y.down = p->chart.y.names;
		labels(p);
		status = guides(p);
	}
	if (!status)
		status = p->kind == TEXT ? to_terminal(p) : to_file(p);
	job->beyond = p->chart.x.beyond + p->chart.y.beyond, job->unplaced = p->chart.unplaced;
	pm_chart_free(&p->chart);
	for (int k = 0; k < p->nfiles; k++)
		pm_number_table_free(&p->table[k]);
	free(p);
	return status;
}
