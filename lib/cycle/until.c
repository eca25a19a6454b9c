/* When a run ends: the columns in an expression are measured after every step, reading only the fields they need. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "expression/expression.h"
#include "measure/diag-column.h"
#include "measure/known-energy.h"
#include "cycle/until.h"
#include "stream/run.h"

enum { most = PM_EXPRESSION_VALUES };

struct pm_until {
	struct pm_expression expression;
	struct pm_diag_request gauge;
	int n;
	struct pm_diag_column column[most];
	double number[2 * most]; /* of column k: at 2k now, at 2k + 1 at the beginning of the run */
	char unknown[200]; /* why the total energy is not known; "" */
	bool first[most], known[most]; /* does the expression use column k at the beginning; is that number from the beginning of this run */
};

static int place(struct pm_until *u, const char *name)
{
	for (int k = 0; k < u->n; k++)
		if (!strcmp(u->column[k].name, name))
			return k;
	return u->n < most && pm_diag_find(&u->gauge, name, &u->column[u->n]) ? u->n++ : -1;
}

/* Index of NAME, else NAME0 (or NAME_0 if NAME ends in a digit), from 1; 0 unknown. */
static int slot(void *context, const char *name)
{
	struct pm_until *u = context;
	char shorter[2 * PM_NAME];
	size_t n = strlen(name);
	int k = place(u, name);
	if (k >= 0)
		return 2 * k + 1;
	if (n < 2 || name[n - 1] != '0')
		return 0;
	n -= name[n - 2] == '_' ? 2 : 1;
	snprintf(shorter, sizeof shorter, "%.*s", (int)n, name);
	k = place(u, shorter);
	if (k < 0)
		return 0;
	u->first[k] = true;
	return 2 * k + 2;
}

struct pm_until *pm_until_new(const char *text)
{
	struct pm_until *u = calloc(1, sizeof *u);
	if (!u)
		return pm_no_memory(), NULL;
	if (!pm_expression_compile_numbers(&u->expression, slot, u, "column", text))
		return u;
	char message[1024];
	snprintf(message, sizeof message, "%s", pm_message());
	pm_fail(PM_USAGE, "--until: %s (columns are those of diag; NAME0 is the value at the beginning)", message);
	return pm_until_free(u);
}

struct pm_until *pm_until_free(struct pm_until *u)
{
	free(u);
	return NULL;
}

static bool wants(const struct pm_until *u, int first, int last)
{
	for (int k = 0; k < u->n; k++)
		if (u->column[k].from >= first && u->column[k].from <= last)
			return true;
	return false;
}

static struct pm_measure how_of(const struct pm_until *u, const struct pm_frame *f)
{
	struct pm_measure how = pm_diag_how(&u->gauge, f);
	if (!wants(u, PM_ENERGY_MESH, PM_ENERGY) && !wants(u, PM_VIRIAL_RATIO, PM_RELAXATION_TIME) && !wants(u, PM_ENERGY_FLOW, PM_HELICITY))
		how.potential = NULL;
	how.vortices = how.vortices && wants(u, PM_CIRCULATION, PM_DISTORTION);
	how.plasma = how.plasma && wants(u, PM_CHARGE, PM_STRENGTH_SCALE - 1);
	how.outside = how.potential || wants(u, PM_OUTSIDE, PM_OUTSIDE);
	how.level = how.level && wants(u, PM_LEVEL_INSIDE, PM_LEVEL_DIFFERENCE);
	return how;
}

/* Computes the columns of this frame into number[2k + at]. Returns the first that cannot be computed, -1 if there is none, or failure (below -1). */
static int measure(struct pm_until *u, struct pm_frame *f, int at)
{
	struct pm_measures m;
	int missing = -1;
	if (pm_diag_reads(&u->gauge, f))
		return -2;
	const struct pm_measure how = how_of(u, f);
	memcpy(u->unknown, how.unknown, sizeof u->unknown);
	if (pm_frame_ready(f) || pm_measure_frame(&how, f, &m) || pm_frame_settle(f))
		return -2;
	for (int k = u->n - 1; k >= 0; k--)
		if (!isfinite(u->number[2 * k + at] = pm_diag_value(&u->column[k], &m, f)))
			missing = k;
	return missing;
}

static int cannot(const struct pm_until *u, int k)
{
	if (u->column[k].from == PM_ENERGY && u->unknown[0])
		return pm_fail(PM_DATA, "--until: the column 'energy' cannot be computed: %s (use another column)", u->unknown);
	return pm_fail(PM_DATA, "--until: the column '%s' cannot be computed from this frame "
		"(derived fields are dropped when particles move: put the words that make them after the last push, or use another column)",
		u->column[k].name);
}

/* Uses a direct sum if the frame has no potential, where that is possible and cheap. */
static bool may_sum(const struct pm_until *u, const struct pm_frame *f, int missing)
{
	char why[200];
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return false;
	const struct pm_measure how = pm_diag_how(&u->gauge, f);
	const int from = missing >= 0 ? u->column[missing].from : -1;
	return (from == PM_ENERGY || from == PM_ENERGY_PAIR || (from >= PM_VIRIAL_RATIO && from <= PM_RELAXATION_TIME)) && !u->gauge.pair &&
		pm_pairs_unasked(f, law, &how, why) == PM_PAIRS_SUM;
}

static int measure_first(struct pm_until *u, struct pm_frame *f)
{
	u->gauge.pair = false;
	int missing = measure(u, f, 1);
	if (may_sum(u, f, missing)) {
		u->gauge.pair = true;
		missing = measure(u, f, 1);
	}
	return missing == -1 ? 0 : missing < 0 ? pm_failed() : cannot(u, missing);
}

int pm_until_begin(struct pm_until *u, struct pm_frame *f)
{
	for (int k = 0; k < u->n; k++)
		u->known[k] = true;
	return measure_first(u, f);
}

int pm_until_met(struct pm_until *u, struct pm_frame *f)
{
	const int missing = measure(u, f, 0);
	return missing == -1 ? pm_expression_number(&u->expression, u->number) != 0 : missing < 0 ? pm_failed() : cannot(u, missing);
}

json_t *pm_until_save(const struct pm_until *u)
{
	json_t *columns = json_object();
	for (int k = 0; k < u->n; k++)
		if (u->known[k])
			json_object_set_new(columns, u->column[k].name, json_real(u->number[2 * k + 1]));
	return json_pack("{s:o,s:b}", "first", columns, "pair", u->gauge.pair);
}

int pm_until_load(struct pm_until *u, struct pm_frame *f, const json_t *saved)
{
	const json_t *columns = json_object_get(saved, "first");
	bool all = saved != NULL;
	for (int k = 0; k < u->n; k++) {
		u->known[k] = json_is_number(json_object_get(columns, u->column[k].name));
		if (u->first[k] && !u->known[k])
			return pm_fail(PM_USAGE, "--until: the checkpoint has no value of '%s' at the beginning of its run (it was made with another "
				"--until, or without)", u->column[k].name);
		all = all && u->known[k];
	}
	if (!all && measure_first(u, f))
		return pm_failed();
	for (int k = 0; k < u->n; k++)
		if (u->known[k])
			u->number[2 * k + 1] = json_number_value(json_object_get(columns, u->column[k].name));
	if (all)
		u->gauge.pair = json_is_true(json_object_get(saved, "pair"));
	return 0;
}
