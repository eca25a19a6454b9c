/* The parameters of all scenes as one list, each name once: what pinit offers as options.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SCENE_ROWS_H
#define PM_SCENE_ROWS_H

#include <stdio.h>
#include <string.h>

#include "scene/scene.h"

enum { SCENE_ROWS = 64 };

/* Place of a name in rows[0..n-1], n if it is not there. */
static inline int scene_row_at(const struct pm_scene_parameter *const *rows, int n, const char *name)
{
	int k = 0;
	while (k < n && strcmp(rows[k]->name, name))
		k++;
	return k;
}

/* The first row of every name, in the order of the table; how many. */
static inline int scene_rows(const struct pm_scene_parameter *rows[SCENE_ROWS])
{
	int n = 0;
	for (int s = 0; pm_scenes[s]; s++)
		for (const struct pm_scene_parameter *p = pm_scenes[s]->parameters; p->name; p++)
			if (n < SCENE_ROWS && scene_row_at(rows, n, p->name) == n)
				rows[n++] = p;
	return n;
}

/* "text (default: plummer 0.02, uniform 0.001)": which scenes have a parameter, with their defaults. */
static inline void scene_row_text(const struct pm_scene_parameter *row, char *text, size_t bytes)
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

#endif
