/* The parameters of all scenes, each name once, with the scenes that have it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

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
