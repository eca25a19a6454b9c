/* The parameters of all scenes, each name once, with the scenes that have it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "base/nearest-name.h"
#include "scene-parts/scene-parameters.h"

int pm_scene_row_at(const struct pm_scene_parameter *const *rows, int n, const char *name)
{
	int k = 0;
	while (k < n && strcmp(rows[k]->name, name))
		k++;
	return k;
}

int pm_scene_rows(const struct pm_scene_parameter *rows[PM_SCENE_ROWS])
{
	int n = 0;
	for (int s = 0; pm_scenes[s]; s++)
		for (const struct pm_scene_parameter *p = pm_scenes[s]->parameters; p->name; p++)
			if (n < PM_SCENE_ROWS && pm_scene_row_at(rows, n, p->name) == n)
				rows[n++] = p;
	return n;
}

void pm_scene_row_text(const struct pm_scene_parameter *row, char *text, size_t bytes)
{
	FILE *out = fmemopen(text, bytes, "w");
	const char *comma = "";
	if (!out)
		return;
	fprintf(out, "%s (default: ", row->text);
	for (int s = 0; pm_scenes[s]; s++)
		for (const struct pm_scene_parameter *p = pm_scenes[s]->parameters; p->name; p++)
			if (!strcmp(p->name, row->name)) {
				fprintf(out, "%s%s %g", comma, pm_scenes[s]->name, p->otherwise);
				comma = ", ";
			}
	fprintf(out, ")");
	fclose(out);
}

int pm_scene_parameters_choose(const struct pm_scene *scene, const double typed[PM_SCENE_ROWS], double *value)
{
	const struct pm_scene_parameter *rows[PM_SCENE_ROWS], *own = scene->parameters;
	const char *names[PM_SCENE_PARAMETERS + 1] = {0};
	const int n = pm_scene_rows(rows);
	bool mine[PM_SCENE_ROWS] = {0};
	for (int i = 0; own[i].name; i++) {
		const int k = pm_scene_row_at(rows, n, names[i] = own[i].name);
		mine[k] = true;
		value[i] = isnan(typed[k]) ? own[i].otherwise : typed[k];
		if ((own[i].low != 0 || own[i].high != 0) && !(value[i] >= own[i].low && value[i] <= own[i].high))
			return pm_fail(PM_USAGE, "--%s %g is not in %g..%g", own[i].name, value[i], own[i].low, own[i].high);
	}
	for (int k = 0; k < n; k++)
		if (!mine[k] && !isnan(typed[k])) {
			const char *near = pm_nearest(rows[k]->name, names);
			if (!names[0])
				return pm_fail(PM_USAGE, "the scene %s has no --%s, nor any parameter of its own (leave it out)", scene->name, rows[k]->name);
			return pm_fail(PM_USAGE, "the scene %s has no --%s (%s --%s)", scene->name, rows[k]->name, near ? "did you mean" : "it has",
				near ? near : names[0]);
		}
	return 0;
}
