/* Cross-sections from a table. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_COLLIDE_CROSS_SECTION_H
#define PM_COLLIDE_CROSS_SECTION_H

#include <stddef.h>

struct pm_cross_section {
	size_t n;               /* 0: none */
	double *energy, *area;  /* [n] energies in ascending order; they belong to the table */
};

/* Two columns of a text, energy and area. 0 or failure with the file. */
int pm_cross_section_read(struct pm_cross_section *s, const char *path);
double pm_cross_section_at(const struct pm_cross_section *s, double energy);
void pm_cross_section_free(struct pm_cross_section *s);

#endif
