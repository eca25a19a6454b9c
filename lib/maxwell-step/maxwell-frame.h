/* Maxwell's equations on the mesh of a frame; used by maxwell. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MAXWELL_STEP_MAXWELL_FRAME_H
#define PM_MAXWELL_STEP_MAXWELL_FRAME_H

#include "maxwell/maxwell.h"
#include "poisson-fft/poisson-fft.h"

struct pm_maxwell_choice {
	const char *mesh, *method; /* mesh NULL: the first; method NULL: yee, and with gauss that of E */
	bool gauss;                /* E is corrected by the charge; nothing advances */
	int marder;                /* with gauss: by so many passes of diffusion; 0: exactly */
	bool nodal;                /* with gauss: E is made on the nodes */
	int layers;                /* [cells] */
	double drift[3];           /* [length/time] of currents in a step (psatd) */
};

/* The choice applied to a frame, from declare to frame. */
struct pm_maxwell_job {
	struct pm_maxwell_choice choice;
	const struct pm_maxwell *method;
	struct pm_mesh *mesh;
	bool spectral;                  /* Gauss's law is that of derivatives of waves */
	struct pm_yee yee;              /* without data */
	struct pm_field *e, *b, *pml[3];
	const struct pm_field *j, *rho; /* NULL none */
};

/* Of a projection. */
struct pm_gauss_record {
	double before; /* max |div E - rho/eps0| [mass length/(charge time^2 length^2)] */
	double mean;   /* of that, taken out where no face fixes the potential */
};

/* Each 0 or failure. */
int pm_maxwell_declare(const struct pm_maxwell_choice *choice, struct pm_frame *f, struct pm_maxwell_job *j);
int pm_maxwell_step(struct pm_maxwell_job *j, double dt);
int pm_maxwell_project(struct pm_maxwell_job *j, struct pm_gauss_record *r);

/* The law's constants and the geometry; no data. */
struct pm_yee pm_yee_of(const struct pm_frame *f, const struct pm_mesh *m);
/* Is the field E or B as Yee's mesh has it? */
bool pm_yee_staggered(const struct pm_field *field, int dim, bool electric);

#endif
