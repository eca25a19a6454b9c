/* The rate at which a field frees the next electron of an ion. Atomic units. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_IONISATION_TUNNEL_RATE_H
#define PM_IONISATION_TUNNEL_RATE_H

#include <stdbool.h>

#include "ionisation/ionisation-energies.h"

#define PM_HARTREE 27.211386245981       /* [eV] (CODATA 2022) */
#define PM_ATOMIC_LENGTH 5.29177210544e-11  /* [m] */
#define PM_ATOMIC_TIME 2.4188843265864e-17  /* [s] */
#define PM_ATOMIC_FIELD 5.14220675112e11    /* [V/m] */

struct pm_tunnel {
	double energy;   /* that is to be overcome */
	double n;        /* effective principal quantum number */
	double constant; /* log of the factor of the tunnelling rate */
	double critical; /* field from where on the barrier is suppressed */
};

/* The next electron of the ion of this charge, 0 to z - 1. */
struct pm_tunnel pm_tunnel_of(const struct pm_element *e, int charge);
/* Per time, in the field |E|; beyond `critical` that of a suppressed barrier if asked for. */
double pm_tunnel_rate(const struct pm_tunnel *t, double field, bool suppressed);

#endif
