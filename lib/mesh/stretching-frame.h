/* Stretching of vorticity on the mesh of a frame, d omega/dt += (omega . grad) u in one of its forms: what stretch does.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_STRETCHING_FRAME_H
#define PM_MESH_STRETCHING_FRAME_H

#include "mesh/gradient.h"

struct pm_stretching_choice {
	const char *mesh, *order; /* NULL: the first; the law's */
	enum pm_stretch_form form;
	bool replace;             /* the term anew, instead of refused a second time */
};

/* From the header to the data. */
struct pm_stretching {
	struct pm_grid grid;
	enum pm_stretch_form form;
	int order;
	const struct pm_field *omega, *u;
	struct pm_field *change;
};

/* Each 0 or failure. Header: the change field domega of alpha. */
int pm_stretching_declare(const struct pm_stretching_choice *c, struct pm_frame *f, struct pm_stretching *t);
/* Data. plans: of spectral operators, started anew where full. */
int pm_stretching_add(struct pm_stretching *t, struct pm_fft_plans *plans);

#endif
