/* Fields on a mesh of another frame, at the particles of this one. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_FIELD_OF_FILE_H
#define PM_TRANSFER_FIELD_OF_FILE_H

#include "transfer/transfer-frame.h"

struct pm_file_field {
	const struct pm_frame *from;     /* whole; its meshes have the law's field (E, g, u), the magnetic field (B), or both */
	const char *path;                /* its name, for messages */
	const char *kernel, *set, *term; /* kernel and set may be NULL: cic, every set that the law moves */
	bool replace;
};

/* Header: the rates. 0 or failure: the frame has no such field, or another number of dimensions. */
int pm_file_field_declare(const struct pm_file_field *c, struct pm_frame *f);
/* Data: rate_p += (strength/per) sum over points of W((x_p - x_i)/h) field_i, bfield_p += that of B. 0 or failure: a particle outside the mesh. */
int pm_file_field_add(const struct pm_file_field *c, struct pm_frame *f);

#endif
