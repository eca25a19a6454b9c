/* Remeshing a set of a frame: which fields are strengths, which are remeshed with a strength, which are dropped.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_REMESH_FRAME_H
#define PM_REMESH_FRAME_H

#include "remesh/remesh.h"
#include "stream/strengths.h"
#include "transfer/transfer-frame.h"

struct pm_remesh_choice {
	const struct pm_kernel *kernel;
	double cut_off;          /* of the largest absolute strength; nan: see pm_remesh_defaults */
	int rim;                 /* cells around a particle whose nodes become particles too; below 0: see pm_remesh_defaults */
	const char *by;          /* values are remeshed as this strength times value, then divided by it; NULL: values are an error */
	const char *const *drop; /* fields to leave out */
	int ndrop;
	bool out;                /* particles outside an open mesh are left out; else an error */
	const unsigned char *mask; /* [nodes] bodies, NULL none (remesh.h) */
	bool overlap;            /* keep the overlap of the new particles (distortion.h) in the state field overlap */
};

struct pm_remesh_loss {
	uint64_t cut, strays;                 /* nodes below the cut-off; particles outside the mesh */
	struct pm_strengths under, outside;   /* their strengths */
	double square;                        /* of sum q^2/volume, the part that is gone (below 0: gained); 0 where there is no volume */
};

/* Where nothing was chosen (cut_off nan, rim below 0): 0, but with an open face the cut-off is 1e-6, and the rim 2 if there is a viscosity and no value is
 * remeshed. */
void pm_remesh_defaults(const struct pm_frame *f, struct pm_remesh_choice *c);
/* Enlarges the mesh until every particle of the sets lies inside, and the new ones have room to move. 0 or failure. */
int pm_remesh_grow(struct pm_frame *f, struct pm_mesh *m, const struct pm_kernel *kernel, const struct pm_sets *sets);
/* The one typed (NULL: none); else m6prime by volume, because cic smooths a value away that nothing makes anew; else the law's, else m4prime. */
const struct pm_kernel *pm_remesh_kernel(const char *option, const char *by, const struct pm_law *law);
/* The sets that have positions and a strength and are not fixed, or the one named only; fails with a sentence if there is none. */
int pm_remesh_choose(const struct pm_frame *f, const char *only, const struct pm_remesh_choice *c, struct pm_sets *sets);
/* For declare(): fails for fields that cannot be distributed to nodes, declares the others as read. */
int pm_remesh_reads(struct pm_frame *f, const char *set, const struct pm_remesh_choice *c);
/* Drops the fields that are invalid after the particles of the set are replaced: its change and derived fields and registers, and those of the meshes. */
void pm_remesh_drops(struct pm_frame *f, const char *set);
/* sum of q^2/volume, all components, of the set's first strength q that is not dropped (remesh-square.c), which is returned; NULL and 0 if it or the volume
 * is missing. */
const struct pm_field *pm_remesh_squared(const struct pm_frame *f, const char *set, const struct pm_remesh_choice *c, double *square);
/* For frame() of a stage that holds: the particles of the set are now the nodes of the mesh. */
int pm_remesh_set(struct pm_frame *f, const char *set, const struct pm_mesh *m, const struct pm_remesh_choice *c, struct pm_remesh_loss *loss);

#endif
