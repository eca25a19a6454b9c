/* Which columns a person wants to see depends on the law; they stand in order of importance, and as many are shown as fit into a line. Units are those of
 * the fields that a column is made of, where the frame states them: energy is mass (v)^2. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>

#include "measure/readable-table.h"

enum { digits = 12 }; /* -1.23457e-05 */

static const int bodies[] = {PM_STEP, PM_TIME, PM_ENERGY, PM_VIRIAL_RATIO, PM_ENERGY_KINETIC, PM_ENERGY_PAIR, PM_ENERGY_MESH, PM_ANGULAR + 2, PM_MOMENTUM,
	PM_OUTSIDE, PM_DISTANCE_MAX, PM_MASS, PM_PARTICLES, -1};
static const int plasma[] = {PM_STEP, PM_TIME, PM_ENERGY, PM_ENERGY_KINETIC, PM_ENERGY_COMPONENT, PM_ENERGY_COMPONENT + 1, PM_ENERGY_COMPONENT + 2,
	PM_MOMENTUM, PM_CHARGE, PM_SPEED_RMS, PM_PARTICLES, -1};
static const int vortices[] = {PM_STEP, PM_TIME, PM_CIRCULATION, PM_ENERGY, PM_ENSTROPHY, PM_OMEGA_MAX, PM_ANGULAR_IMPULSE, PM_IMPULSE, PM_IMPULSE + 1,
	PM_DISTORTION, PM_PARTICLES, -1};
static const int space[] = {PM_STEP, PM_TIME, PM_ENERGY, PM_ENSTROPHY, PM_HELICITY, PM_DIVERGENCE, PM_OMEGA_MAX, PM_IMPULSE, PM_IMPULSE + 1, PM_IMPULSE + 2,
	PM_DISTORTION, PM_PARTICLES, -1};
static const int others[] = {PM_STEP, PM_TIME, PM_PARTICLES, PM_DISTANCE_MAX, PM_SPEED_RMS, PM_ENERGY_KINETIC, PM_MOMENTUM, PM_MASS, -1};

int pm_readable_width(int file)
{
	struct winsize size = {0};
	const int typed = getenv("COLUMNS") ? atoi(getenv("COLUMNS")) : 0;
	return !ioctl(file, TIOCGWINSZ, &size) && size.ws_col ? size.ws_col : typed > 0 ? typed : 80;
}

static const int *of_law(const struct pm_measure *how)
{
	return how->vector ? space : how->vortices ? vortices : how->plasma ? plasma : how->strength ? bodies : others;
}

static bool seldom(const double *value, int k, const struct pm_diag_column *column) /* the second of two energies of the field, and zeros */
{
	return column[k].from == PM_ENERGY_PAIR || column[k].from == PM_ENERGY_MESH ? isnan(value[k]) : column[k].from == PM_OUTSIDE && value[k] == 0;
}

static int breadth(const struct pm_diag_column *c)
{
	const int name = (int)strlen(c->name), least = c->from == PM_STEP ? 8 : digits;
	return name > least ? name : least;
}

/* ---- units ---- */

static const char *unit_of(const struct pm_frame *f, const char *name)
{
	for (size_t i = 0; name && i < f->nfields; i++)
		if (!strcmp(f->fields[i]->name, name) && f->fields[i]->unit[0])
			return f->fields[i]->unit;
	return "";
}

/* "" where a field does not state its own. */
static void unit(const struct pm_diag_column *c, const struct pm_measure *how, const struct pm_frame *f, char text[200])
{
	const char *x = unit_of(f, "x"), *v = unit_of(f, "v"), *m = unit_of(f, "mass"), *q = unit_of(f, how->strength);
	const int k = c->from;
	const size_t length = strlen(x);
	text[0] = 0;
	if (k >= PM_ENERGY_KINETIC && k <= PM_ENERGY && *m && *v && !how->vortices)
		snprintf(text, 200, "%.60s (%.60s)^2", m, v);
	else if (k >= PM_MOMENTUM && k <= PM_MOMENTUM_SCALE && *m && *v)
		snprintf(text, 200, "%.60s (%.60s)", m, v);
	else if (k >= PM_ANGULAR && k < PM_MASS && *m && *v && *x)
		snprintf(text, 200, "%.60s %.60s (%.60s)", m, x, v);
	else if (k == PM_MASS)
		snprintf(text, 200, "%.60s", m);
	else if ((k >= PM_CENTRE && k < PM_SPEED_RMS) || k == PM_DISTANCE_MAX || (k >= PM_COLUMNS && k < PM_COLUMNS + PM_COMPONENTS))
		snprintf(text, 200, "%.60s", x);
	else if (k == PM_SPEED_RMS)
		snprintf(text, 200, "%.60s", v);
	else if (k == PM_CIRCULATION || k == PM_CHARGE)
		snprintf(text, 200, "%.60s", q);
	else if (k == PM_OMEGA_MAX || k == PM_OMEGA_CENTRE)
		snprintf(text, 200, "%.60s", unit_of(f, "omega"));
	else if (k == PM_TIME && length && !strncmp(v, x, length) && v[length] == '/')
		snprintf(text, 200, "%.60s", v + length + 1);
	if (!strcmp(text, c->name))
		text[0] = 0;
}

/* A line or more, folded at the width: units: energy, energy_kinetic [mass (length/time)^2]; distance_max [length] */
static void units(const struct pm_readable *r, FILE *out, const struct pm_diag_column *column, const struct pm_measure *how, const struct pm_frame *f)
{
	char text[PM_READABLE_MOST][200], entry[2 * 200];
	int at = 0;
	for (int i = 0; i < r->n; i++)
		unit(&column[r->shown[i]], how, f, text[i]);
	for (int i = 0; i < r->n; i++) {
		if (!text[i][0])
			continue;
		int n = snprintf(entry, sizeof entry, "%s", column[r->shown[i]].name);
		for (int k = i + 1; k < r->n; k++)
			if (!strcmp(text[k], text[i]) && n < 300) {
				n += snprintf(entry + n, sizeof entry - (size_t)n, ", %.60s", column[r->shown[k]].name);
				text[k][0] = 0;
			}
		snprintf(entry + n, sizeof entry - (size_t)n, " [%.90s]", text[i]);
		n = (int)strlen(entry);
		if (7 + n > r->width) /* too narrow for it */
			continue;
		const bool fold = at && at + 2 + n > r->width;
		fprintf(out, "%s%s", !at ? "units: " : fold ? "\n       " : "; ", entry);
		at = !at || fold ? 7 + n : at + 2 + n;
	}
	if (at)
		fputc('\n', out);
}

/* ---- columns ---- */

static bool is_shown(const struct pm_readable *r, int k)
{
	for (int i = 0; i < r->n; i++)
		if (r->shown[i] == k)
			return true;
	return false;
}

static void show(struct pm_readable *r, int *used, const struct pm_diag_column *c, int k)
{
	const int more = breadth(c) + (r->n ? 2 : 0);
	if (is_shown(r, k))
		return;
	if (r->n == PM_READABLE_MOST || (r->n >= 2 && *used + more > r->width)) { /* two columns at least */
		r->left++;
		return;
	}
	r->shown[r->n++] = k;
	*used += more;
}

static int find(int n, const struct pm_diag_column *column, int from)
{
	for (int k = 0; k < n; k++)
		if (column[k].from == from)
			return k;
	return -1;
}

/* Step and time, then what an option asked for, then the law's own. */
static void choose(struct pm_readable *r, int n, const struct pm_diag_column *column, const double *value, const struct pm_measure *how)
{
	const int *own = of_law(how);
	const struct pm_readable before = *r;
	int used = 0;
	r->n = r->left = 0;
	r->absent = 0;
	for (int k = 0; k < n && r->asked; k++)
		show(r, &used, &column[k], k);
	for (int i = 0; i < 2 && !r->asked; i++)
		show(r, &used, &column[find(n, column, own[i])], find(n, column, own[i]));
	for (int k = 0; k < n && !r->asked; k++)
		if (column[k].from >= PM_COLUMNS || (k + 1 < n && column[k + 1].from < 0) || column[k].from < 0)
			if (isfinite(value[k]))
				show(r, &used, &column[k], k);
	for (int i = 2; own[i] >= 0 && !r->asked; i++) {
		const int k = find(n, column, own[i]);
		r->absent |= (unsigned)(k >= 0 && isnan(value[k]) && !is_shown(&before, k)) << i;
		if (k >= 0 && (is_shown(&before, k) || (isfinite(value[k]) && !seldom(value, k, column))))
			show(r, &used, &column[k], k);
	}
	r->left = r->asked ? r->left : 0;
	for (int k = 0; k < n && !r->asked; k++) /* the rest is not offered, only counted */
		r->left += isfinite(value[k]) && !is_shown(r, k) && !seldom(value, k, column);
}

/* ---- what is missing, and why ---- */

static bool any(const struct pm_frame *f, const char *name, bool mesh)
{
	for (size_t i = 0; name && i < f->nfields; i++)
		if (!strcmp(f->fields[i]->name, name) && (pm_frame_mesh(f, f->fields[i]->on) != NULL) == mesh)
			return true;
	return false;
}

/* Why a column is nan; "" where another one stands for it, or the reason is told elsewhere. */
static void reason(int k, const struct pm_measure *how, const struct pm_frame *f, const char *lacks, char text[300])
{
	text[0] = 0;
	if (k == PM_ENERGY_PAIR || k == PM_ENERGY_MESH || how->unknown[0])
		return;
	if (k >= PM_ENSTROPHY && k <= PM_OMEGA_CENTRE && !any(f, "omega", true))
		snprintf(text, 300, "no mesh holds omega (p2m makes it)");
	else if (k >= PM_ENERGY_COMPONENT && k < PM_STRENGTH_SCALE)
		snprintf(text, 300, "no mesh holds %.60s (p2m | poisson-fft | mgrad makes it)", how->field ? how->field : "the field");
	else if ((k == PM_ENERGY || k == PM_VIRIAL_RATIO) && *lacks)
		snprintf(text, 300, "%s", lacks);
	else if (k <= PM_SPEED_RMS && !any(f, "v", false))
		snprintf(text, 300, "the particles have no velocity v");
	else if ((k <= PM_SPEED_RMS || k == PM_VIRIAL_RATIO) && !any(f, "mass", false))
		snprintf(text, 300, "the particles have no mass");
}

/* The columns of one reason are told together. */
static void missing(struct pm_readable *r, int n, const struct pm_diag_column *column, const double *value, const struct pm_measure *how,
	const struct pm_frame *f, const char *lacks)
{
	const int *own = of_law(how);
	char why[PM_READABLE_NOTES][300], text[300];
	int notes = 0;
	for (int i = 0; i < (r->asked ? n : 64) && (r->asked || own[i] >= 0); i++) {
		const int k = r->asked ? i : find(n, column, own[i]);
		int at = 0;
		if (k < 0 || !isnan(value[k]))
			continue;
		reason(column[k].from, how, f, lacks, text);
		while (at < notes && strcmp(why[at], text))
			at++;
		if (!text[0] || at == PM_READABLE_NOTES - 1)
			continue;
		if (at == notes)
			strcpy(why[notes++], text), r->note[at][0] = 0;
		const size_t length = strlen(r->note[at]);
		snprintf(r->note[at] + length, sizeof r->note[at] - length, "%s%.60s", length ? ", " : "", column[k].name);
	}
	for (int i = 0; i < notes; i++) {
		const size_t length = strlen(r->note[i]);
		snprintf(r->note[i] + length, sizeof r->note[i] - length, " cannot be computed: %s", why[i]);
	}
	if (r->left)
		snprintf(r->note[notes], sizeof r->note[notes], "%d more column%s not shown (%s; all: --format tsv, or into a pipe)", r->left,
			r->left == 1 ? " is" : "s are", r->asked ? "a wider terminal" : "--columns chooses");
}

static void begin(struct pm_readable *r, FILE *out, int n, const struct pm_diag_column *column, const double *value, const struct pm_measure *how,
	const struct pm_frame *f, const char *lacks)
{
	const bool again = r->n > 0;
	choose(r, n, column, value, how);
	if (again)
		fputc('\n', out);
	else
		missing(r, n, column, value, how, f, lacks);
	units(r, out, column, how, f);
	for (int i = 0; i < r->n; i++)
		fprintf(out, "%*s%s", breadth(&column[r->shown[i]]), column[r->shown[i]].name, i + 1 < r->n ? "  " : "\n");
}

/* Has one of the law's columns a value now that was nan when the columns were chosen? */
static bool appeared(const struct pm_readable *r, int n, const struct pm_diag_column *column, const double *value, const struct pm_measure *how)
{
	const int *own = of_law(how);
	for (int i = 0; own[i] >= 0 && !r->asked; i++) {
		const int k = find(n, column, own[i]);
		if (k >= 0 && r->absent >> i & 1 && isfinite(value[k]))
			return true;
	}
	return false;
}

void pm_readable_row(struct pm_readable *r, FILE *out, int n, const struct pm_diag_column *column, const double *value, const struct pm_measure *how,
	const struct pm_frame *f, const char *lacks)
{
	if (r->live)
		fputs("\r\033[K", out);
	if (!r->n || appeared(r, n, column, value, how))
		begin(r, out, n, column, value, how, f, lacks);
	for (int i = 0; i < r->n; i++) {
		const int k = r->shown[i], width = breadth(&column[k]);
		isfinite(value[k]) ? fprintf(out, "%*.6g", width, value[k]) : fprintf(out, "%*s", width, "nan");
		fputs(i + 1 < r->n ? "  " : "\n", out);
	}
}
