/* VTK's XML formats with the data appended raw, little-endian, each array behind its length in bytes as 64 bits. Source: VTK User's Guide, File Formats,
 * XML file formats (Kitware 2010). Vectors have three components there, so missing ones are 0; fields of more than three components stay as they are.
 * f32 stays f32. Cost: that of the disk. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "vtk/vtk.h"

static const char *const types[] = {"Float64", "Float32", "Int64", "UInt8"}; /* by enum pm_type */

struct array {
	const struct pm_field *field; /* NULL: counts */
	int component;                /* -1: all */
	enum { WHOLE, COUNT_FROM_0, COUNT_FROM_1 } what;
	size_t n;
	int wide; /* components in the file */
	enum pm_type type;
};

static struct array array_of(const struct pm_field *p, int component)
{
	const int own = component < 0 ? p->components : 1;
	return (struct array){.field = p, .component = component, .n = p->count, .wide = own == 2 || (own == 1 && !strcmp(p->name, "x")) ? 3 : own,
		.type = p->type};
}

static size_t array_bytes(const struct array *a) { return a->n * (size_t)a->wide * pm_type_size(a->type); }

void pm_vtk_text(FILE *out, const char *s)
{
	for (; *s; s++)
		if (strchr("<>&\"'", *s) || (unsigned char)*s < ' ')
			fprintf(out, "&#%d;", (unsigned char)*s < ' ' ? '_' : *s);
		else
			fputc(*s, out);
}

static void array_head(FILE *out, const struct array *a, const char *name, uint64_t *offset)
{
	fprintf(out, "<DataArray type=\"%s\" Name=\"", types[a->type]);
	pm_vtk_text(out, name);
	fprintf(out, "\" NumberOfComponents=\"%d\" format=\"appended\" offset=\"%llu\"/>\n", a->wide, (unsigned long long)*offset);
	*offset += sizeof *offset + array_bytes(a);
}

/* Value i of component c. */
static void put(unsigned char *to, const struct array *a, size_t i, int c)
{
	const int from = a->component < 0 ? c : a->component;
	const bool there = !a->field || from < a->field->components;
	const int64_t count = (int64_t)i + (a->what == COUNT_FROM_1);
	if (a->what != WHOLE)
		memcpy(to, &count, sizeof count);
	else if (!there)
		memset(to, 0, pm_type_size(a->type));
	else if (a->type == PM_F64)
		memcpy(to, pm_in(a->field, from) + i, sizeof(double));
	else if (a->type == PM_I64)
		memcpy(to, pm_in_i64(a->field, from) + i, sizeof(int64_t));
	else if (a->type == PM_U8)
		*to = pm_in_u8(a->field, from)[i];
	else
		memcpy(to, &(float){(float)pm_in(a->field, from)[i]}, sizeof(float));
}

static void array_data(FILE *out, const struct array *a)
{
	unsigned char room[1 << 14];
	const uint64_t bytes = array_bytes(a);
	const size_t size = pm_type_size(a->type), row = size * (size_t)a->wide;
	size_t used = 0;
	fwrite(&bytes, sizeof bytes, 1, out);
	for (size_t i = 0; i < a->n; i++) {
		for (int c = 0; c < a->wide; c++)
			put(room + used + (size_t)c * size, a, i, c);
		used += row;
		if (used + row > sizeof room || i + 1 == a->n)
			fwrite(room, 1, used, out), used = 0;
	}
}

static void head(FILE *out, const char *type)
{
	fprintf(out, "<?xml version=\"1.0\"?>\n<VTKFile type=\"%s\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<%s", type, type);
}

static void time_of(FILE *out, const struct pm_frame *f)
{
	fputs("<FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">", out);
	fprintf(out, "%.17g</DataArray></FieldData>\n", f->time);
}

static int end(FILE *out, const char *type, const struct array *a, int n)
{
	fprintf(out, "</Piece></%s>\n<AppendedData encoding=\"raw\">\n_", type);
	for (int i = 0; i < n; i++)
		array_data(out, a + i);
	fputs("\n</AppendedData></VTKFile>\n", out);
	return ferror(out) ? pm_fail_errno("cannot write") : 0;
}

int pm_vtk_set(FILE *out, const struct pm_frame *f, const struct pm_set *set)
{
	int n = 3;
	uint64_t offset = 0;
	const struct pm_field *x = pm_frame_field(f, set->name, "x");
	if (!x || (x->type != PM_F64 && x->type != PM_F32))
		return pm_fail(PM_DATA, "the set '%s' has no positions", set->name);
	struct array *a = pm_alloc(f->nfields + 3, sizeof *a);
	if (!a)
		return -PM_DATA;
	a[0] = array_of(x, -1);
	a[1] = (struct array){.what = COUNT_FROM_0, .n = x->count, .wide = 1, .type = PM_I64};
	a[2] = (struct array){.what = COUNT_FROM_1, .n = x->count, .wide = 1, .type = PM_I64};
	head(out, "PolyData");
	fputs(">\n", out);
	time_of(out, f);
	fprintf(out, "<Piece NumberOfPoints=\"%zu\" NumberOfVerts=\"%zu\" ", x->count, x->count);
	fputs("NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n", out);
	array_head(out, a, "x", &offset);
	fputs("</Points>\n<Verts>\n", out);
	array_head(out, a + 1, "connectivity", &offset);
	array_head(out, a + 2, "offsets", &offset);
	fputs("</Verts>\n<PointData>\n", out);
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *p = f->fields[i];
		if (strcmp(p->on, set->name) || p == x)
			continue;
		a[n] = array_of(p, -1);
		array_head(out, a + n++, p->name, &offset);
	}
	fputs("</PointData>\n", out);
	int status = end(out, "PolyData", a, n);
	pm_free(a);
	return status;
}

bool pm_vtk_staggered(const struct pm_field *p, int component)
{
	const unsigned char *s = p->staggered[component];
	return s[0] || s[1] || s[2];
}

static bool whole(const struct pm_field *p)
{
	for (int c = 0; c < p->components; c++)
		if (pm_vtk_staggered(p, c))
			return false;
	return true;
}

int pm_vtk_mesh(FILE *out, const struct pm_frame *f, const struct pm_mesh *m, const struct pm_field *part, int component)
{
	struct array *a = pm_alloc(f->nfields + 1, sizeof *a);
	int n = 0;
	uint64_t offset = 0;
	size_t points[3] = {1, 1, 1};
	double lo[3] = {0}, h[3] = {1, 1, 1};
	if (!a)
		return -PM_DATA;
	pm_mesh_points(f, m, points);
	for (int d = 0; d < f->dim; d++)
		h[d] = m->h[d], lo[d] = m->lo[d] + (part && part->staggered[component][d] ? m->h[d] / 2 : 0);
	for (int d = f->dim; d < 3; d++)
		points[d] = 1;
	head(out, "ImageData");
	fprintf(out, " WholeExtent=\"0 %zu 0 %zu 0 %zu\" Origin=\"%.17g %.17g %.17g\" Spacing=\"%.17g %.17g %.17g\">\n", points[0] - 1, points[1] - 1,
		points[2] - 1, lo[0], lo[1], lo[2], h[0], h[1], h[2]);
	time_of(out, f);
	fprintf(out, "<Piece Extent=\"0 %zu 0 %zu 0 %zu\">\n<PointData>\n", points[0] - 1, points[1] - 1, points[2] - 1);
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *p = f->fields[i];
		if (strcmp(p->on, m->name) || (part ? p != part : !whole(p)))
			continue;
		a[n] = array_of(p, part ? component : -1);
		array_head(out, a + n++, p->name, &offset);
	}
	fputs("</PointData>\n", out);
	int status = end(out, "ImageData", a, n);
	pm_free(a);
	return status;
}
