/* The table that diag prints: one row per frame. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_DIAG_TABLE_H
#define PM_MEASURE_DIAG_TABLE_H

#include <stdio.h>

#include "measure/diag-column.h"
#include "measure/energy-error.h"
#include "measure/growth.h"
#include "measure/readable-table.h"
#include "measure/wave-theory.h"

enum { PM_DIAG_ASKED = 32, PM_DIAG_WIDEST = 2 * (PM_DIAG_ASKED + PM_COLUMNS + 2 * PM_COMPONENTS + PM_FIELD_COLUMNS + PM_SPECIES_MOST * PM_MOMENTS) };

enum pm_diag_format { PM_DIAG_TSV, PM_DIAG_CSV, PM_DIAG_JSON, PM_DIAG_READABLE };

struct pm_diag_choice {
	const char *set;                                /* this set alone; NULL all */
	const char *const *columns;                     /* names, PM_DIAG_ASKED at most */
	int ncolumns;                                   /* 0: all that exist here */
	const double *radii, *modes;                    /* fractions of the mass; waves along x */
	int nradii, nmodes;                             /* PM_COMPONENTS at most, the mode of the growth included */
	const char *growth;                             /* what is fitted, as typed: mode:M or a column; NULL none */
	const char *window;                             /* as typed, for messages; NULL none */
	double from, to;                                /* [time] of the fit; NAN: chosen */
	const char *separation[2];                      /* two sets; NULL: none */
	bool species;                                   /* the moments of every set */
	bool field_errors;                              /* residual and curl of the law's field */
	const double *flux;                             /* corners of a box; NULL: none */
	int nflux;
	bool pair, exact, average;                      /* average: over the rows, after the last one */
	enum pm_diag_format format;
	int width;                                      /* [characters] of a line of the readable table */
};

struct pm_diag_table {
	struct pm_diag_choice choice;
	FILE *out;
	int n; /* columns, decided by the first frame; 0 before */
	struct pm_diag_column column[PM_DIAG_WIDEST];
	struct pm_diag_request request;
	struct pm_diag_column growth; /* the column that is fitted */
	int mode;                     /* of the request, that is fitted with its phase; -1: a column */
	double theory[2];             /* [1/time] gamma and omega that the scene states for this mode; NAN: none */
	double bounce;                /* [1/time] of particles that this wave traps, where they do so before it is damped; NAN: none */
	struct pm_wave_theory waves;  /* the species of the first frame */
	double k;                     /* [1/length] of the mode whose theory is that of the species; 0: of the scene, or none is asked for */
	struct pm_series series;
	double *rows;                 /* of --average: n values and the time each; NULL: none */
	size_t nrows, room;
	int64_t step;                 /* of the last row */
	double before[2];             /* time and energy of the last row */
	bool energies, unasked; /* a column needs the energy of the field; the first row needed the sum over pairs for it, unasked */
	char unknown[200]; /* why the column energy is nan, if the forces are the reason; "" */
	char lacks[200];   /* why it is nan, if no mesh and no particle holds the potential; "" */
	bool expected;     /* a column was asked for that needs it, or the particles are too many to sum pairs unasked */
	struct pm_energy_error energy;
	struct pm_readable readable;
	char note[320];               /* a sentence about the last row for stderr; "" none */
};

/* Checks what was typed, and takes the growth and the window (T0:T1) apart. 0 or failure. */
int pm_diag_table_init(struct pm_diag_table *t, const struct pm_diag_choice *c, FILE *out);
/* Can ranks share the measures of a row? Sums over pairs that nobody asked for are for rank 0, which alone knows what the first row had. */
bool pm_diag_table_shared(const struct pm_diag_table *t, const struct pm_frame *f);
/* In declare(): what the rows need. */
int pm_diag_table_reads(const struct pm_diag_table *t, struct pm_frame *f);
/* 0 or failure. The first row is preceded by the line of names; end prints the line of the growth rate, or that there is none and why. */
int pm_diag_table_row(struct pm_diag_table *t, const struct pm_frame *f);
int pm_diag_table_end(struct pm_diag_table *t);
void pm_diag_table_clear(struct pm_diag_table *t);

#endif
