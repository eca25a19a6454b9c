/* Groups, datasets and attributes, and the names of records. SPDX-License-Identifier: GPL-3.0-or-later */
#include <ctype.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "h5/node.h"
#include "stream/list.h"

static herr_t innermost(unsigned n, const H5E_error2_t *e, void *out)
{
	if (n == 0)
		snprintf(out, 256, "%s", e->desc ? e->desc : "");
	return 0;
}

int pm_h5_fail(const char *format, ...)
{
	char why[256] = "", what[1024];
	va_list ap;
	va_start(ap, format);
	vsnprintf(what, sizeof what, format, ap);
	va_end(ap);
	H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, why);
	for (char *c = why; *c; c++)
		if ((unsigned char)*c < ' ')
			*c = ' ';
	return pm_fail(PM_DATA, "%s (HDF5: %s)", what, *why ? why : "no reason given");
}

/* ---- writing ---- */

static int put(hid_t at, const char *name, hid_t file_type, hid_t memory_type, int n, const void *x)
{
	hsize_t dims[1] = {(hsize_t)n};
	hid_t space = n ? H5Screate_simple(1, dims, NULL) : H5Screate(H5S_SCALAR);
	hid_t a = H5Acreate2(at, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT);
	int status = a < 0 || H5Awrite(a, memory_type, x) < 0 ? pm_h5_fail("cannot write the attribute '%s'", name) : 0;
	H5Aclose(a);
	H5Sclose(space);
	return status;
}

int pm_h5_put_reals(hid_t at, const char *name, int n, const double *x) { return put(at, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, n, x); }

int pm_h5_put_counts(hid_t at, const char *name, int n, const uint64_t *x) { return put(at, name, H5T_STD_U64LE, H5T_NATIVE_UINT64, n, x); }

int pm_h5_put_flag(hid_t at, const char *name, unsigned x) { return put(at, name, H5T_STD_U32LE, H5T_NATIVE_UINT, 0, &x); }

static int put_texts(hid_t at, const char *name, size_t length, int n, const void *x)
{
	hid_t type = H5Tcopy(H5T_C_S1);
	H5Tset_size(type, length);
	H5Tset_strpad(type, H5T_STR_NULLPAD);
	int status = put(at, name, type, type, n, x);
	H5Tclose(type);
	return status;
}

int pm_h5_put_text(hid_t at, const char *name, const char *text) { return put_texts(at, name, *text ? strlen(text) : 1, 0, text); }

int pm_h5_put_letters(hid_t at, const char *name, int n, const char *letters) { return put_texts(at, name, 1, n, letters); }

/* Attributes of fixed length are limited to 64 KiB; those of variable length are stored elsewhere in the file. */
int pm_h5_put_long_text(hid_t at, const char *name, const char *text)
{
	hid_t type = H5Tcopy(H5T_C_S1);
	H5Tset_size(type, H5T_VARIABLE);
	H5Tset_cset(type, H5T_CSET_UTF8);
	int status = put(at, name, type, type, 0, &text);
	H5Tclose(type);
	return status;
}

/* No time stamps, so that equal runs give equal files. */
hid_t pm_h5_group(hid_t at, const char *name)
{
	hid_t how = H5Pcreate(H5P_GROUP_CREATE), links = H5Pcreate(H5P_LINK_CREATE);
	H5Pset_obj_track_times(how, false);
	H5Pset_create_intermediate_group(links, 1);
	hid_t g = H5Gcreate2(at, name, links, how, H5P_DEFAULT);
	H5Pclose(how);
	H5Pclose(links);
	if (g < 0)
		pm_h5_fail("cannot write the group '%s'", name);
	return g;
}

/* ---- reading ---- */

bool pm_h5_has(hid_t at, const char *name) { return H5Aexists(at, name) > 0; }

int pm_h5_get_reals(hid_t at, const char *name, int *n, double *x)
{
	if (!pm_h5_has(at, name))
		return pm_fail(PM_DATA, "no attribute '%s'", name);
	hid_t a = H5Aopen(at, name, H5P_DEFAULT), space = H5Aget_space(a), type = H5Aget_type(a);
	hssize_t there = H5Sget_simple_extent_npoints(space);
	H5T_class_t class = H5Tget_class(type);
	int status = 0;
	if ((class != H5T_FLOAT && class != H5T_INTEGER) || there < 1 || there > *n)
		status = pm_fail(PM_DATA, "the attribute '%s' is not 1 to %d numbers", name, *n);
	else if (H5Aread(a, H5T_NATIVE_DOUBLE, x) < 0)
		status = pm_h5_fail("cannot read the attribute '%s'", name);
	*n = (int)there;
	H5Tclose(type), H5Sclose(space), H5Aclose(a);
	return status;
}

/* Texts of either kind, n of them in one block of memory with `stride` bytes each; NULL with a message. */
static char *texts(hid_t at, const char *name, int most, int *n, size_t *stride)
{
	if (!pm_h5_has(at, name)) {
		pm_fail(PM_DATA, "no attribute '%s'", name);
		return NULL;
	}
	hid_t a = H5Aopen(at, name, H5P_DEFAULT), space = H5Aget_space(a), type = H5Aget_type(a);
	hssize_t there = H5Sget_simple_extent_npoints(space);
	bool variable = H5Tis_variable_str(type) > 0, text = H5Tget_class(type) == H5T_STRING && there >= 1 && there <= most;
	char *out = NULL, *one = NULL;
	*n = (int)there;
	*stride = H5Tget_size(type) + 1;
	errno = 0;
	if (text && variable && there == 1 && H5Aread(a, type, &one) >= 0 && one) {
		out = strdup(one);
		H5free_memory(one);
	} else if (text && !variable && (out = calloc((size_t)there, *stride))) {
		hid_t wide = H5Tcopy(H5T_C_S1);
		H5Tset_size(wide, *stride);
		if (H5Aread(a, wide, out) < 0)
			free(out), out = NULL;
		H5Tclose(wide);
	} else if (text && variable && (out = calloc((size_t)there, *stride))) {
		char *list[16] = {0};
		if (there > 16 || H5Aread(a, type, list) < 0)
			free(out), out = NULL;
		for (int i = 0; out && i < there; i++)
			out[(size_t)i * *stride] = list[i] ? list[i][0] : 0, H5free_memory(list[i]);
	}
	H5Tclose(type), H5Sclose(space), H5Aclose(a);
	if (!out)
		errno == ENOMEM ? pm_no_memory() : pm_fail(PM_DATA, "the attribute '%s' is not text", name);
	return out;
}

char *pm_h5_get_text(hid_t at, const char *name)
{
	int n;
	size_t stride;
	return texts(at, name, 1, &n, &stride);
}

int pm_h5_get_letters(hid_t at, const char *name, int most, char *letters)
{
	int n;
	size_t stride;
	char *t = texts(at, name, most, &n, &stride);
	if (!t)
		return -PM_DATA;
	for (int i = 0; i < n; i++)
		letters[i] = t[(size_t)i * stride];
	free(t);
	return n;
}

double pm_h5_number(hid_t at, const char *name, double otherwise)
{
	int n = 1;
	double x;
	return pm_h5_has(at, name) && !pm_h5_get_reals(at, name, &n, &x) ? x : otherwise;
}

static herr_t name_add(hid_t at, const char *name, const H5L_info_t *info, void *p)
{
	struct pm_h5_names *all = p;
	(void)at, (void)info;
	if (all->n == 256 || strlen(name) >= PM_NAME)
		return -1;
	pm_name_copy(all->name[all->n++], name);
	return 0;
}

int pm_h5_children(hid_t at, const char *path, struct pm_h5_names *all)
{
	hsize_t from = 0;
	all->n = 0;
	hid_t g = H5Gopen2(at, path, H5P_DEFAULT);
	int status = g < 0 || H5Literate(g, H5_INDEX_NAME, H5_ITER_INC, &from, name_add, all) < 0
		? pm_fail(PM_DATA, "'%s' is not a group, or has too many members, or names longer than 63 bytes", path) : 0;
	H5Gclose(g);
	return status;
}

hid_t pm_h5_type(enum pm_type type)
{
	switch (type) { /* the types are not constants: they are made when the library starts */
	case PM_F64:
		return H5T_IEEE_F64LE;
	case PM_F32:
		return H5T_IEEE_F32LE;
	case PM_I64:
		return H5T_STD_I64LE;
	default:
		return H5T_STD_U8LE;
	}
}

/* ---- names ---- */

static const char *standard(const struct pm_field *p, bool particles)
{
	if (particles && !strcmp(p->name, "x"))
		return "position";
	if (particles && !strcmp(p->name, "v"))
		return "velocity";
	return p->name;
}

/* openPMD knows letters, digits and _ only. */
static void clean(char *name)
{
	for (; *name; name++)
		if (!isalnum((unsigned char)*name) && *name != '_')
			*name = '_';
}

static void unlike(char (*path)[PM_H5_PATH], size_t i, const char *folder, const char *name)
{
	for (int copy = 1, again = 1; again; copy++) {
		again = 0;
		snprintf(path[i], PM_H5_PATH, copy == 1 ? "%s%s" : "%s%s_%d", folder, name, copy);
		for (size_t k = 0; k < i && !again; k++)
			again = !strcmp(path[k], path[i]);
	}
}

static void set_folder(const struct pm_frame *f, const char *set, char out[PM_H5_PATH])
{
	size_t same = 0, i = 0;
	char name[PM_NAME], other[PM_NAME];
	pm_name_copy(name, set);
	clean(name);
	for (; strcmp(f->sets[i]->name, set); i++) {
		pm_name_copy(other, f->sets[i]->name);
		clean(other);
		same += !strcmp(other, name);
	}
	/* The index in the frame, appended, makes the name unique. */
	snprintf(out, PM_H5_PATH, same ? "particles/%s__%zu/" : "particles/%s/", name, i);
}

void pm_h5_paths(const struct pm_frame *f, char (*path)[PM_H5_PATH])
{
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *p = f->fields[i];
		char folder[PM_H5_PATH] = "meshes/", name[3 * PM_NAME];
		bool particles = pm_frame_set(f, p->on), other = !particles && strcmp(f->meshes[0]->name, p->on);
		if (particles)
			set_folder(f, p->on, folder);
		snprintf(name, sizeof name, "%s%s%s", other ? p->on : "", other ? "_" : "", standard(p, particles));
		if (particles && (!strcmp(p->name, "position") || !strcmp(p->name, "positionOffset")))
			strcat(name, "_"); /* reserved words */
		clean(name);
		unlike(path, i, folder, name);
	}
}

bool pm_h5_is_vector(const struct pm_field *p)
{
	static const char *const vectors[] = {"x", "v", "acc", "vel", "g", "E", "B", "u", NULL};
	for (int i = 0; vectors[i]; i++)
		if (!strcmp(p->name, vectors[i]))
			return true;
	return p->components > 1;
}

void pm_h5_component(const struct pm_field *p, int c, char name[8])
{
	if (p->components <= 3)
		snprintf(name, 8, "%c", 'x' + c);
	else
		snprintf(name, 8, "c%d", c & 15);
}
