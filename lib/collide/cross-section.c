/* A cross-section from a table of energy and area, as data bases print them: linear between two rows, the first below the table, the last above it.
 * Cost: a search by halves. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "chart/number-table.h"
#include "collide/cross-section.h"

static int copy(struct pm_cross_section *s, const struct pm_number_table *t, const char *path)
{
	if (t->columns != 2 || t->rows < 2)
		return pm_fail(PM_DATA, "'%s' has %zu columns and %zu rows, not two columns, energy and cross-section", path, t->columns, t->rows);
	s->energy = pm_alloc(2 * t->rows, sizeof *s->energy);
	if (!s->energy)
		return -PM_DATA;
	s->n = t->rows;
	s->area = s->energy + s->n;
	memcpy(s->energy, t->number, 2 * s->n * sizeof *s->energy);
	for (size_t i = 0; i < s->n; i++)
		if (!(s->area[i] >= 0 && isfinite(s->area[i]) && isfinite(s->energy[i]) && (!i || s->energy[i] > s->energy[i - 1])))
			return pm_fail(PM_DATA, "'%s': row %zu, %g %g: energies must ascend, and no cross-section be negative", path, i + 1, s->energy[i],
				s->area[i]);
	return 0;
}

int pm_cross_section_read(struct pm_cross_section *s, const char *path)
{
	struct pm_number_table t = {0};
	*s = (struct pm_cross_section){0};
	int status = pm_number_table_read(&t, path);
	status = status ? status : copy(s, &t, path);
	pm_number_table_free(&t);
	if (status)
		pm_cross_section_free(s);
	return status;
}

double pm_cross_section_at(const struct pm_cross_section *s, double energy)
{
	size_t low = 0, high = s->n - 1;
	if (!(energy > s->energy[low]))
		return s->area[low];
	if (energy >= s->energy[high])
		return s->area[high];
	while (high - low > 1) {
		const size_t middle = (low + high) / 2;
		*(energy < s->energy[middle] ? &high : &low) = middle;
	}
	const double part = (energy - s->energy[low]) / (s->energy[high] - s->energy[low]);
	return (1 - part) * s->area[low] + part * s->area[high];
}

void pm_cross_section_free(struct pm_cross_section *s)
{
	pm_free(s->energy);
	*s = (struct pm_cross_section){0};
}
