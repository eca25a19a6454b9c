/* Particles that join a set during a run: its fields in the header, and the data behind those that are there. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LOAD_NEWCOMERS_H
#define PM_LOAD_NEWCOMERS_H

#include "stream/frame.h"

struct pm_newcomers {
	const char *set;
	int velocities;       /* components of v, where the set is made here */
	bool equal;           /* all have this mass and charge; else each its own */
	double mass, charge;
	uint64_t n, room;     /* that have come; that the arrays hold */
	double *x[3], *v[3], *m, *q; /* m and q NULL if equal */
};

/* Header: the set is made if it is missing or empty, else all its fields are held and may grow. Between steps, or where no change field is left. */
int pm_newcomers_declare(struct pm_frame *f, const struct pm_newcomers *a);
/* The arrays for so many. */
int pm_newcomers_room(const struct pm_frame *f, struct pm_newcomers *a, uint64_t room);
/* Data: the first n become the last particles of the set, with the ids behind the largest of the frame. */
int pm_newcomers_append(const struct pm_newcomers *a, struct pm_frame *f);
void pm_newcomers_free(struct pm_newcomers *a);

#endif
