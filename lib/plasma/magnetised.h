/* Electromagnetic waves of species along or across a uniform magnetic field. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PLASMA_MAGNETISED_H
#define PM_PLASMA_MAGNETISED_H

#include "plasma/dispersion.h"

struct pm_gyrating {
	double frequency;  /* [1/time] plasma frequency of this species alone */
	double drift, vth; /* [length/time] along k; vth 0: cold */
	double gyration;   /* [1/time] q B/m, below 0 of electrons */
	double ratio;      /* temperature across k over that along it */
};

/* Along B, circularly polarised: turning with electrons (whistlers), with ions; without a field both are waves of light. Across B: E along it, and across. */
enum pm_light { PM_RIGHT, PM_LEFT, PM_ORDINARY, PM_EXTRAORDINARY };

struct pm_light_case {
	enum pm_light kind;
	const struct pm_gyrating *species;
	int n;
	double k, c; /* [1/length], [length/time] */
};

/* D(omega) whose roots are the waves, and its derivative. PM_ORDINARY and PM_EXTRAORDINARY are those of cold species. */
double complex pm_light_function(const struct pm_light_case *l, double complex omega, double complex *slope);
/* Newton's method from a start; NAN where it does not converge. */
double complex pm_light_root(const struct pm_light_case *l, double complex start);
/* The root nearest to a frequency in the complex plane, among those damped by less than half of theirs; NAN if none. */
double complex pm_light_nearest(const struct pm_light_case *l, double omega);
/* The root that grows most, or is damped least. */
double complex pm_light_strongest(const struct pm_light_case *l);

#endif
