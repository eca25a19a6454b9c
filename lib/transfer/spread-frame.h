/* Spreads the strengths of a frame's sets to a density on a mesh; used by p2m. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_SPREAD_FRAME_H
#define PM_TRANSFER_SPREAD_FRAME_H

#include "transfer/interlace.h"
#include "transfer/transfer-frame.h"

struct pm_spread_choice {
	const char *kernel, *mesh, *set, *strength, *field; /* NULL: the law's, the first mesh, every set that has the strength */
	bool cells;              /* a mesh that is not there will be made */
	bool add;                /* to the density that is there */
	bool interlace;
	const char *outside;     /* a choice of p2m --outside */
	int rim;                 /* [cells] beside open faces that are left free */
};

/* The choice applied to a frame. */
struct pm_spread_job {
	struct pm_spread_choice choice;
	const struct pm_law *law;
	const struct pm_kernel *kernel;
	const char *strength, *density;
	enum pm_outside outside; /* particles beyond open faces: left out, with the force of the monopole or without, or refused */
	bool grow;               /* the mesh grows to hold them */
	struct pm_sets sets;
	struct pm_mesh *mesh; /* NULL: to be made before pm_spread_declare */
};

/* Each 0 or failure. In declare(): */
int pm_spread_choose(const struct pm_spread_choice *choice, const struct pm_frame *f, struct pm_spread_job *j);
int pm_spread_declare(const struct pm_spread_job *j, struct pm_frame *f);
/* With the data, all of it (*outside counts the particles left out);
 * or in parts: the mesh grows, then set by set (`first`: the mesh is still zero), then what the law adds to its density. */
int pm_spread_all(struct pm_spread_job *j, struct pm_frame *f, struct pm_fft_plans *plans, uint64_t *outside);
int pm_spread_grow(struct pm_spread_job *j, struct pm_frame *f);
int pm_spread_set(const struct pm_spread_job *j, struct pm_frame *f, const char *set, bool first, struct pm_fft_plans *plans, uint64_t *outside);
void pm_spread_background(const struct pm_spread_job *j, struct pm_frame *f);

#endif
