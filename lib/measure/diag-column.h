/* Measures of a frame by name: the columns of diag, for diag itself and for cycle --until. The law determines the fields, the scene the exact values.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_DIAG_COLUMN_H
#define PM_MEASURE_DIAG_COLUMN_H

#include "measure/measure.h"
#include "scene/scene.h"

struct pm_diag_request { /* the options that add columns or cost */
	const char *set;                         /* this set alone; NULL all */
	bool pair;                               /* the pair energy by direct summation */
	const char *separation[2];               /* two sets whose separation is a column; NULL: none */
	bool species;                            /* the moments of every set */
	bool field_errors;                       /* residual and curl of the field */
	const double *flux;                      /* corners of a box; NULL: none */
	int nflux;
	int nradii, nmodes;
	double fraction[PM_COMPONENTS];          /* of the mass, of each Lagrangian radius */
	int mode[PM_COMPONENTS];                 /* waves along x of the law's field */
};

enum { PM_DIAG_NAME = PM_NAME + 16 };
struct pm_diag_column { /* one column */
	char name[PM_DIAG_NAME];
	/* index among the measures; from PM_COLUMNS on radii, then modes, then separations; -1: the scene's exact value of this name (exact_NAME) */
	int from;
};

/* The scene of the frame if it has exact values, else NULL. */
const struct pm_scene *pm_diag_scene(const struct pm_frame *f);
/* How to measure it; *g must outlive it. */
struct pm_measure pm_diag_how(const struct pm_diag_request *g, const struct pm_frame *f);
/* In declare(): declares the fields that are read; 0 or failure. */
int pm_diag_reads(const struct pm_diag_request *g, struct pm_frame *f);
struct pm_diag_column pm_diag_column(enum pm_column c);
struct pm_diag_column pm_diag_radius(const struct pm_diag_request *g, int k);
struct pm_diag_column pm_diag_mode(const struct pm_diag_request *g, int k);
struct pm_diag_column pm_diag_field(enum pm_field_column k);
struct pm_diag_column pm_diag_separation(int k); /* of positions, of velocities */
struct pm_diag_column pm_diag_moment(const struct pm_frame *f, size_t set, enum pm_moment k); /* of the set with that number */
struct pm_diag_column pm_diag_exact(const char *name);
/* A column by its name: one of diag's, exact_NAME, radius_FRACTION, mode_M, field_residual, field_curl (the latter four are added to *g), and those of
 * the box of the flux and of the separation that *g asks for. False: there is none. */
bool pm_diag_find(struct pm_diag_request *g, const char *name, struct pm_diag_column *column);
/* NAN where it cannot be computed. */
double pm_diag_value(const struct pm_diag_column *column, const struct pm_measures *m, const struct pm_frame *f);

#endif
