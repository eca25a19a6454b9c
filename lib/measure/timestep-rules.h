/* The rules by which the state of a frame limits its time step, for the word dt. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_TIMESTEP_RULES_H
#define PM_MEASURE_TIMESTEP_RULES_H

#include "stream/frame.h"

/* NAN: the rule is not asked for. */
struct pm_timestep_rules {
	double courant;      /* Courant number: largest displacement per step in cells of the first mesh */
	double acceleration; /* ETA of sqrt(ETA softening/|acc|) */
	double strain;       /* C of C/|grad u|, of the flow on a mesh */
	double plasma;       /* C of C/omega_p */
	double oscillation;  /* C of C/omega, the fastest oscillation that the words which made acc have stated (stream/limits.h) */
	double softening;    /* [length]; NAN: the frame's constant */
	const char *set;     /* this set alone; NULL: every set that moves */
};

/* Header: declares the fields that the rules read; fails if a rule is not defined here. */
int pm_timestep_declare(const struct pm_timestep_rules *r, struct pm_frame *f);
bool pm_timestep_ruled(const struct pm_timestep_rules *r); /* is any rule given? */
/* Data: the longest step allowed, infinite if nothing limits it; *rate is |grad u| [1/time], 0 without that rule. */
double pm_timestep_allowed(const struct pm_timestep_rules *r, const struct pm_frame *f, double *rate);

#endif
