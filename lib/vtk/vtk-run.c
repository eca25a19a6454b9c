/* A run as files of VTK: a directory with a file per set and mesh of each frame, and beside it the list of all with their times (a .pvd).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/replace.h"
#include "vtk/vtk.h"

int pm_vtk_begin(struct pm_vtk_run *r, const char *path)
{
	const size_t n = path ? strlen(path) : 0;
	if (n < 5 || strcmp(path + n - 4, ".pvd") || path[n - 5] == '/' || n >= sizeof r->folder)
		return pm_fail(PM_USAGE, "where to? (-o FILE.pvd, the kind of file that ParaView opens)");
	r->path = path;
	snprintf(r->folder, sizeof r->folder, "%.*s", (int)n - 4, path);
	if (mkdir(r->folder, 0777) && errno != EEXIST)
		return pm_fail_errno("cannot make the directory '%s'", r->folder);
	if (!(r->list = open_memstream(&r->text, &r->size)))
		return pm_no_memory();
	fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n", r->list);
	return 0;
}

struct piece {
	const struct pm_set *set;
	const struct pm_mesh *mesh;
	const struct pm_field *field; /* of the mesh, with a component that is staggered */
	int component, part;
};

static int piece_write(struct pm_vtk_run *r, const struct pm_frame *f, const struct piece *p)
{
	char name[3 * PM_NAME], path[sizeof r->folder + sizeof name + 64];
	const char *slash = strrchr(r->folder, '/');
	if (p->field)
		snprintf(name, sizeof name, "%s-%s_%d", p->mesh->name, p->field->name, p->component);
	else
		snprintf(name, sizeof name, "%s", p->set ? p->set->name : p->mesh->name);
	for (char *c = name; *c; c++)
		*c = isalnum((unsigned char)*c) || strchr("-_", *c) ? *c : '_';
	snprintf(path, sizeof path, "%s/%s-%06llu-%d.%s", r->folder, name, (unsigned long long)r->frames, p->part, p->set ? "vtp" : "vti");
	FILE *out = fopen(path, "wbe");
	if (!out)
		return pm_fail_errno("cannot write '%s'", path);
	int status = p->set ? pm_vtk_set(out, f, p->set) : pm_vtk_mesh(out, f, p->mesh, p->field, p->component);
	if (fclose(out) && !status)
		status = pm_fail_errno("cannot write '%s'", path);
	fprintf(r->list, "<DataSet timestep=\"%.17g\" part=\"%d\" name=\"%s\" file=\"", f->time, p->part, name);
	pm_vtk_text(r->list, path + (slash ? slash + 1 - r->folder : 0));
	fputs("\"/>\n", r->list);
	return status;
}

int pm_vtk_frame(struct pm_vtk_run *r, const struct pm_frame *f)
{
	struct piece p = {.part = 0};
	int status = 0;
	for (size_t i = 0; i < f->nsets && !status; i++)
		if (pm_frame_field(f, (p.set = f->sets[i])->name, "x"))
			status = piece_write(r, f, &p), p.part++;
	p.set = NULL;
	for (size_t i = 0; i < f->nmeshes && !status; i++, p.part++)
		p.mesh = f->meshes[i], status = piece_write(r, f, &p);
	for (size_t i = 0; i < f->nfields; i++)
		for (p.component = 0; p.component < f->fields[i]->components && !status; p.component++)
			if (pm_vtk_staggered(p.field = f->fields[i], p.component))
				p.mesh = pm_frame_mesh(f, p.field->on), status = piece_write(r, f, &p), p.part++;
	r->frames++;
	return status;
}

int pm_vtk_end(struct pm_vtk_run *r)
{
	struct pm_replace to;
	fputs("</Collection>\n</VTKFile>\n", r->list);
	if (fflush(r->list))
		return pm_no_memory();
	int status = pm_replace_open(&to, r->path, true);
	if (status)
		return status;
	FILE *out = fdopen(to.fd, "w");
	if (!out || fwrite(r->text, 1, r->size, out) != r->size || fflush(out))
		status = pm_fail_errno("cannot write '%s'", r->path);
	status = status ? status : pm_replace_commit(&to, false);
	pm_replace_drop(&to);
	if (out)
		fclose(out);
	return status;
}

void pm_vtk_free(struct pm_vtk_run *r)
{
	if (r->list)
		fclose(r->list);
	free(r->text);
}
