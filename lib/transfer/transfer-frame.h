/* Transfers between the sets and the meshes of a frame, shared by p2m and m2p.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_FRAME_H
#define PM_TRANSFER_FRAME_H

#include "law/law.h"
#include "transfer/transfer.h"

/* The sets that take part: those that have every field of needs[] (NULL ends) as state or derived, or the one named only. Fails with a sentence if there is
 * none (remedy in brackets). */
enum { PM_SETS_MOST = 64 };
struct pm_sets {
	size_t n;
	const char *name[PM_SETS_MOST];
};
int pm_sets_choose(const struct pm_frame *f, const char *only, const char *const needs[], const char *remedy, struct pm_sets *sets);

/* Declares x of the set as read; fails with a sentence if it has not got dim real components. */
int pm_reads_positions(struct pm_frame *f, const char *set);
void pm_positions(const struct pm_frame *f, const char *set, const double *x[3]);

/* Declares the field `name` of the set, and its volume if the field is a value, as read. */
int pm_reads_strength(struct pm_frame *f, const char *set, const char *name);
/* q[c][n]: the field, times volume if it is a value; *made is to be freed. */
int pm_strengths(const struct pm_frame *f, const char *set, const char *name, const double *q[], double **made);

/* The same quotient for all, where neither field has more than one value and it is defined. */
bool pm_ratio_is_one(const struct pm_frame *f, const char *set, const char *strength, const char *per, double *ratio);
/* strength/per, particle by particle, which is kept while both stay; *made is to be freed. */
int pm_ratio(const struct pm_frame *f, const char *set, const char *strength, const char *per, const double **ratio, double **made);
/* The least and the largest of its n values, kept too. */
void pm_ratio_range(const struct pm_frame *f, const char *set, const char *strength, const char *per, const double *ratio, double range[2]);

/* Refuses particles outside the mesh with a sentence that names the first, and the remedies of the tool. */
int pm_strays_refuse(const struct pm_strays *s, const char *set, const struct pm_mesh *m, const struct pm_transfer *t, const char *remedy);

/* Enlarges the mesh (regrid.h) so that every particle of the sets fits, by whole blocks of 8 cells: a slow expansion does not change it at every
 * step. 1 if it had to, 0 if not, or failure. */
int pm_mesh_grow(struct pm_frame *f, struct pm_mesh *m, const struct pm_transfer *t, const struct pm_sets *sets);

/* The kernel between particles and a mesh: the option's, else the one that `field` (NULL: none yet) was made with, else the law's, else `otherwise`. */
const struct pm_kernel *pm_kernel_choose(const char *option, const struct pm_field *field, const struct pm_law *law, const char *otherwise);

/* Makes the mesh field `name` for the density of field `strength` of the sets, or with add changes the one that is there. */
struct pm_density {
	const char *name;
	const struct pm_kernel *kernel;
	bool interlaced;
	const struct pm_sets *sets;
	const char *strength;
	enum pm_outside outside;
	int rim;
};
int pm_makes_density(struct pm_frame *f, const struct pm_mesh *m, const struct pm_density *density, bool add);

/* Makes the particle field that takes the values of a mesh field of the same name: new and derived, or a strength that is there (values times
 * volume, which is then read); NULL with a message if it has no volume or is other state. */
struct pm_field *pm_makes_gathered(struct pm_frame *f, const char *set, const struct pm_field *from);

#endif
