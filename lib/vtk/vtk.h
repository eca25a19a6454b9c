/* Frames as files of VTK in XML, for ParaView, VisIt and PyVista: sets as polygonal data with a vertex per particle, meshes as images.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_VTK_H
#define PM_VTK_H

#include "stream/frame.h"

/* Each 0 or failure. All fields are loaded. */
int pm_vtk_set(FILE *out, const struct pm_frame *f, const struct pm_set *set);
/* The fields of a mesh that sit on its points: part NULL; or one component of one field half a cell up. */
int pm_vtk_mesh(FILE *out, const struct pm_frame *f, const struct pm_mesh *m, const struct pm_field *part, int component);
bool pm_vtk_staggered(const struct pm_field *p, int component);

void pm_vtk_text(FILE *out, const char *s); /* as XML writes it, without control characters */

/* A run: path is the list of all files with their times (FILE.pvd), which appears at the end; the files are in a directory named as it is without .pvd. */
struct pm_vtk_run {
	const char *path;
	FILE *list;
	char *text; /* of the list so far */
	size_t size;
	uint64_t frames;
	char folder[4096];
};

/* Each 0 or failure. r: zeros. */
int pm_vtk_begin(struct pm_vtk_run *r, const char *path);
int pm_vtk_frame(struct pm_vtk_run *r, const struct pm_frame *f);
int pm_vtk_end(struct pm_vtk_run *r);
void pm_vtk_free(struct pm_vtk_run *r);

#endif
