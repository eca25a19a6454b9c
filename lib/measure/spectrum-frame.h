/* The field of a frame whose spectrum is wanted, and its table. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_SPECTRUM_FRAME_H
#define PM_MEASURE_SPECTRUM_FRAME_H

#include "measure/spectrum-table.h"

struct pm_spectrum_choice {
	const char *field, *mesh; /* NULL: the law's velocity or density; the first mesh that has it */
	double shell;             /* [1/length] width; 0: by the box */
	bool contrast;            /* divide by the mean */
};
struct pm_spectrum_source { /* from declare to frame */
	const char *name;
	const struct pm_mesh *mesh;
	bool made;                /* it is the law's field, which is made again from its potential */
};

/* In declare(): finds the field and declares the reads; failure where there is none. */
int pm_spectrum_declare(const struct pm_spectrum_choice *c, struct pm_frame *f, struct pm_spectrum_source *from);
/* Prints the table; scale, dim and time of *print are set here. */
int pm_spectrum_frame(const struct pm_spectrum_choice *c, const struct pm_frame *f, const struct pm_spectrum_source *from, struct pm_fft_plans *plans,
	const struct pm_spectrum_print *print);

#endif
