/* Elements and the energies that free their electrons. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_IONISATION_ENERGIES_H
#define PM_IONISATION_ENERGIES_H

#include <stddef.h>

enum { PM_ELEMENT_MOST = 54 }; /* electrons */

struct pm_element {
	const char *symbol;
	int z;                /* electrons of the atom */
	const double *energy; /* [eV] [z] of the ion of charge 0, 1 ... z - 1 */
};

const struct pm_element *pm_element_find(const char *symbol); /* NULL: not in the table */
const struct pm_element *pm_element_at(size_t k);             /* NULL behind the last */
/* Angular momentum of the subshell that gives an electron, of so many (1 to PM_ELEMENT_MOST). */
int pm_element_l(int electrons);

#endif
