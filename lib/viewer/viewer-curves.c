/* The columns of diag in time: all that exist under the law; those without a number throughout are left out. SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/diag-column.h"
#include "measure/known-energy.h"
#include "stream/header.h"
#include "viewer/viewer-curves.h"
#include "viewer/viewer-frame.h"

static const struct pm_diag_request request, summed = {.pair = true};

int pm_viewer_curves_reads(struct pm_frame *f) { return f->substep ? 0 : pm_diag_reads(&request, f); }

int pm_viewer_curves_add(struct pm_viewer_curves *c, const struct pm_frame *f)
{
	struct pm_measure how = pm_diag_how(&request, f);
	struct pm_measures m;
	char why[200];
	if (f->substep) /* the state is not at the header's time */
		return 0;
	int status = pm_measure_frame(&how, f, &m);
	const bool lacks = !c->rows && isnan(m.value[PM_ENERGY_PAIR]) && isnan(m.value[PM_ENERGY_MESH]);
	if (!status && (lacks || c->pairs) && pm_pairs_unasked(f, pm_law_of(f), &how, why) == PM_PAIRS_SUM) {
		c->pairs = true;
		how = pm_diag_how(&summed, f);
		status = pm_measure_frame(&how, f, &m);
	}
	if (status)
		return status;
	json_t *row = json_array();
	for (int k = 0; k < PM_COLUMNS; k++)
		json_array_append_new(row, pm_column_suits((enum pm_column)k, &how) ? pm_json_number(m.value[k]) : json_null());
	if (!c->rows)
		c->rows = json_array();
	return json_array_append_new(c->rows, row) ? pm_no_memory() : 0;
}

json_t *pm_viewer_curves_json(const struct pm_viewer_curves *c)
{
	json_t *columns = json_array(), *rows = json_array(), *row;
	size_t i;
	bool there[PM_COLUMNS] = {false};
	json_array_foreach(c->rows, i, row)
		for (size_t k = 0; k < PM_COLUMNS; k++)
			there[k] = there[k] || json_is_number(json_array_get(row, k));
	for (size_t k = 0; k < PM_COLUMNS; k++)
		if (there[k])
			json_array_append_new(columns, json_string(pm_column_names[k]));
	json_array_foreach(c->rows, i, row) {
		json_t *some = json_array();
		for (size_t k = 0; k < PM_COLUMNS; k++)
			if (there[k])
				json_array_append(some, json_array_get(row, k));
		json_array_append_new(rows, some);
	}
	return json_pack("{s:o, s:o}", "columns", columns, "rows", rows);
}

void pm_viewer_curves_free(struct pm_viewer_curves *c)
{
	json_decref(c->rows);
	c->rows = NULL;
}
