/* Snapshots of GADGET and of the codes that took over its HDF5 layout (Arepo, SWIFT, GIZMO): what their header says, and the particles as a frame.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_H5_GADGET_H
#define PM_H5_GADGET_H

#include "h5/node.h"

enum { PM_GADGET_TYPES = 16 };

struct pm_gadget {
	int types;                          /* PartType0 ... PartType(types-1) */
	double here[PM_GADGET_TYPES], total[PM_GADGET_TYPES]; /* particles in the file that was opened, and in all files */
	double mass[PM_GADGET_TYPES];       /* of each particle of the type; 0: they differ, and there is a dataset */
	double time, box[3];                /* box 0: none stated */
	bool swift, comoving;
	double a;                           /* scale factor; 1 unless comoving */
	double length, weight, speed;       /* the units in cm, g, cm/s; 0: not stated */
	double G;                           /* in these units; 0 unknown */
	int periodic;                       /* 1 yes, 0 no, -1 not stated */
	int files, allowed;                 /* allowed: the last one for which memory has been allowed; for the 0th it was at the start */
	char stem[4096], ending[8];         /* of several files: STEM.K.ENDING */
};

bool pm_gadget_is(hid_t file);
int pm_gadget_header(hid_t file, const char *path, struct pm_gadget *g);
hid_t pm_gadget_open(struct pm_gadget *g, int k); /* the k-th of several files, counted by pm_gadget_here; negative with a message */
int pm_gadget_here(hid_t file, struct pm_gadget *g);    /* sets here[] */

/* The whole snapshot as a frame; its report says how it was read. */
int pm_gadget_frame(const struct pm_h5 *h, struct pm_frame **f);

#endif
