/* Gathers a mesh field of a frame, changes on the mesh and a magnetic field to the sets; used by m2p. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_GATHER_FRAME_H
#define PM_TRANSFER_GATHER_FRAME_H

#include "mesh/gradient-later.h"
#include "mesh/planes.h"
#include "transfer/interlace.h"
#include "transfer/mesh-changes.h"
#include "transfer/outside.h"

struct pm_gather_choice {
	const char *kernel, *mesh, *set; /* NULL: as the field was made, the first mesh that has the field, every set that the law moves */
	const char *field;               /* to a particle field of its name; NULL: the law's, to the change field of the law */
	bool replace;                    /* replace a change field instead of refusing to add twice */
	bool conserving;                 /* of E and B on Yee's mesh: with kernels one order lower along the axes on which they sit half a cell up */
	bool later;                      /* the rates may be left to be made (gather-later.h) */
	bool beside;                     /* beside bodies and faces kernels are one-sided (one-sided.h) */
	const unsigned char *mask;       /* with the data: the nodes inside bodies; NULL none */
	const char *outside;             /* of particles beyond open faces, a name of pm_outside; NULL: as the field was made */
};

/* The choice applied to a frame. */
struct pm_gather_job {
	struct pm_gather_choice choice;
	const struct pm_law *law;
	const char *name; /* of the mesh field */
	struct pm_sets sets;
	struct pm_mesh *mesh;
	struct pm_field *field;
	struct pm_transfer transfer;
	struct pm_planes planes;        /* of the field, from pm_gather_prepare on */
	bool interlaced;
	struct pm_interlaced both;      /* of the field, on two meshes */
	struct pm_mesh_changes changes; /* carried along */
	enum pm_outside outside;        /* what is done with particles outside */
	struct pm_outside_force far;          /* monopole: of those inside, and the reaction */
	uint64_t strays;                /* outside, of the sets so far */
	struct pm_limits limits;        /* of the law's change, what all sets have in common */
	double pull;                    /* |coefficient| sum |strength| of masses; else 0 */
};

/* Each 0 or failure. In declare(): */
int pm_gather_choose(const struct pm_gather_choice *choice, const struct pm_frame *f, struct pm_gather_job *j);
int pm_gather_declare(const struct pm_gather_job *j, struct pm_frame *f);
/* With the data: first the part common to all sets, then set by set; *dropped counts the particles left out; then the monopole. Free in any case. */
int pm_gather_prepare(struct pm_gather_job *j, const struct pm_frame *f, struct pm_fft_plans *plans);
int pm_gather_set(struct pm_gather_job *j, struct pm_frame *f, const char *set, uint64_t *dropped);
/* Private to lib/transfer: the gradient that the field is left as, if it can be gathered so to all sets: nothing else is on the mesh, or asks for the
 * field; else NULL. */
const struct pm_gradient_later *pm_gather_gradient(const struct pm_gather_job *j);
/* And (gather-outside.c): */
int pm_gather_outside_choose(struct pm_gather_job *j, const struct pm_frame *f);
struct pm_field *pm_gather_target(const struct pm_gather_job *j, const struct pm_frame *f, const char *set);
/* For m2p, after all sets: */
int pm_gather_outside(struct pm_gather_job *j, struct pm_frame *f);
void pm_gather_free(struct pm_gather_job *j);

#endif
