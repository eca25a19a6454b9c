/* A set or mesh of a frame as one plain table. Cost: that of writing numbers, about 1 us a row of seven columns. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "stream/declare.h"
#include "stream/plain-table.h"
#include "stream/table.h"

int pm_plain_table_declare(struct pm_frame *f, const char *on, bool mesh)
{
	if (!(mesh ? (void *)pm_frame_mesh(f, on) : (void *)pm_frame_set(f, on)))
		return pm_fail(PM_DATA, "no %s '%s' (sls lists what there is)", mesh ? "mesh" : "set", on);
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->on, on))
			f->fields[i]->use |= PM_USE_READ;
	if (mesh && pm_frame_field(f, on, "x"))
		return pm_fail(PM_DATA, "the mesh '%s' has a field x, which is what the coordinates are called (rename it with smod --rename)", on);
	return mesh && !pm_makes(f, on, "x", f->dim, PM_STATE) ? -PM_DATA : 0;
}

static void coordinates(const struct pm_frame *f, const struct pm_mesh *m, struct pm_field *x)
{
	size_t points[3];
	pm_mesh_points(f, m, points);
	for (size_t p = 0; p < x->count; p++) {
		const size_t i = (size_t)x->first + p, at[3] = {i % points[0], i / points[0] % points[1], i / points[0] / points[1]};
		for (int a = 0; a < f->dim; a++)
			pm_out(x, a)[p] = m->lo[a] + (double)at[a] * m->h[a];
	}
}

int pm_plain_table_write(FILE *out, bool csv, struct pm_frame *f, const char *on, bool mesh)
{
	struct pm_table_column column[PM_COLUMNS + 3];
	size_t rows = 0;
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->on, on))
			f->fields[i]->uniform = false, rows = f->fields[i]->count;
	int n = pm_table_columns(f, on, column + 3), axes = mesh ? f->dim : 0;
	if (mesh)
		coordinates(f, pm_frame_mesh(f, on), pm_frame_field(f, on, "x"));
	if (n < 0)
		return n;
	struct pm_table_column *first = column + 3 - axes;
	memmove(first, column + 3 + n - axes, (size_t)axes * sizeof *column); /* x was made last and comes first */
	return pm_table_write(out, csv, rows, n, first);
}
