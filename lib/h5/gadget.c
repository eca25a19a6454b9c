/* The particles of a GADGET snapshot as a frame (docs/methods/hdf5.md has the table): PartTypeN becomes a set of that name, Coordinates x, Velocities v,
 * Masses or the entry of MassTable mass, ParticleIDs id, every other array of numbers a field of its name. In comoving runs GADGET and Arepo
 * store sqrt(a) dx/dt (GADGET-2 user guide, section 6), so the peculiar velocity v = a dx/dt is sqrt(a) times that; SWIFT stores v. Lengths stay comoving,
 * in the units of the file.
 * Cost: that of the disk. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "h5/apart.h"
#include "h5/gadget.h"
#include "stream/columns.h"
#include "stream/list.h"
#include "stream/run.h"

enum { rows_at_once = 1 << 15 };

struct plan { /* a dataset and the field it becomes */
	char dataset[PM_NAME], field[PM_NAME];
	int components;
	enum pm_type type;
	bool large; /* whole numbers of 64 bits without a sign */
};

struct work {
	struct pm_gadget g;
	struct pm_frame *f;
	struct pm_h5_names names;
	char left_out[1024];
};

static void leave_out(struct work *w, const char *set, const char *name, const char *why)
{
	size_t n = strlen(w->left_out);
	snprintf(w->left_out + n, sizeof w->left_out - n, "%s%s/%s (%s)", n ? ", " : "", set, name, why);
}

/* The shape of a dataset: rows, and components of a row. Why it cannot be a field, or NULL. */
static const char *look(hid_t d, struct plan *p, hsize_t *rows)
{
	hid_t space = H5Dget_space(d), type = H5Dget_type(d);
	hsize_t dims[H5S_MAX_RANK] = {0, 1};
	H5T_class_t class = H5Tget_class(type);
	int rank = H5Sget_simple_extent_ndims(space);
	const char *why = class != H5T_FLOAT && class != H5T_INTEGER ? "no numbers" : rank != 1 && rank != 2 ? "neither a list nor a table" : NULL;
	if (!why)
		H5Sget_simple_extent_dims(space, dims, NULL);
	if (!why && (dims[1] < 1 || dims[1] > PM_COMPONENTS))
		why = "more than 16 columns";
	*rows = dims[0], p->components = (int)dims[1];
	p->type = class == H5T_INTEGER ? PM_I64 : H5Tget_size(type) <= 4 ? PM_F32 : PM_F64;
	p->large = class == H5T_INTEGER && H5Tget_size(type) >= 8 && H5Tget_sign(type) == H5T_SGN_NONE;
	H5Sclose(space), H5Tclose(type);
	return why;
}

static hid_t dataset_open(hid_t file, int type, const char *name)
{
	char path[2 * PM_NAME];
	snprintf(path, sizeof path, "PartType%d/%s", type, name);
	hid_t o = H5Oopen(file, path, H5P_DEFAULT);
	if (o >= 0 && H5Iget_type(o) == H5I_DATASET)
		return o;
	H5Oclose(o);
	return -1;
}

static const char *field_of(const char *dataset, int type)
{
	static const char *const ours[][2] = {{"Coordinates", "x"}, {"Velocities", "v"}, {"Masses", "mass"}, {"ParticleIDs", "id"}, {NULL, NULL}};
	for (int i = 0; ours[i][0]; i++)
		if (!strcmp(dataset, ours[i][0]))
			return ours[i][1];
	return type == 5 && !strcmp(dataset, "DynamicalMasses") ? "mass" : dataset; /* black holes of SWIFT */
}

/* Memory may be filled with the whole of a row range at most: values of the file in double or int64, one row after the other. */
static int rows_read(hid_t d, const struct plan *p, struct pm_field *field, size_t at, size_t n, double factor, bool *beyond)
{
	const size_t k = (size_t)p->components;
	double *room = pm_alloc(rows_at_once * k, sizeof *room);
	hid_t space = H5Dget_space(d);
	const bool whole = p->type == PM_I64;
	int status = room ? 0 : -PM_DATA, rank = H5Sget_simple_extent_ndims(space);
	for (size_t row = 0; row < n && !status; row += rows_at_once) {
		const size_t m = n - row < rows_at_once ? n - row : rows_at_once;
		const hsize_t from[2] = {row, 0}, count[2] = {m, k}, flat[1] = {m * k};
		hid_t memory = H5Screate_simple(1, flat, NULL);
		pm_h5_goes_on(m * k * sizeof *room);
		H5Sselect_hyperslab(space, H5S_SELECT_SET, from, NULL, count, NULL);
		if (rank > 2 || H5Dread(d, whole ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, room) < 0)
			status = pm_h5_fail("cannot read '%s' of '%s'", p->dataset, field->on);
		H5Sclose(memory);
		for (size_t c = 0; c < k && !status; c++)
			for (size_t i = 0; i < m; i++)
				if (whole) {
					const int64_t value = ((int64_t *)room)[i * k + c];
					pm_out_i64(field, (int)c)[at + row + i] = value;
					*beyond |= p->large && value == INT64_MAX; /* where HDF5 cuts it off */
				} else {
					const double value = room[i * k + c] * factor;
					pm_out(field, (int)c)[at + row + i] = p->type == PM_F32 ? (float)value : value;
				}
	}
	H5Sclose(space);
	pm_free(room);
	return status;
}

/* The part of a field that is in this file. */
static int part_read(struct work *w, hid_t file, int type, const struct plan *p, struct pm_field *field, size_t at, bool *beyond)
{
	struct plan there;
	hsize_t rows = 0;
	hid_t d = dataset_open(file, type, p->dataset);
	const char *why = d < 0 ? "missing" : look(d, &there, &rows);
	int status = 0;
	if (why || rows != (hsize_t)w->g.here[type] || there.components != p->components || there.type != p->type)
		status = pm_fail(PM_DATA, "PartType%d/%s: %s", type, p->dataset, why ? why : "its shape or type differs from the header or the first file");
	else
		status = rows_read(d, p, field, at, (size_t)rows, !strcmp(p->field, "v") && !w->g.swift ? sqrt(w->g.a) : 1, beyond);
	H5Dclose(d);
	return status;
}

static void unit(const struct pm_gadget *g, struct pm_field *p)
{
	const char *per_h = g->comoving && !g->swift ? "/h" : "";
	if (!g->length)
		return;
	if (!strcmp(p->name, "x"))
		snprintf(p->unit, PM_NAME, "%g cm%s%s", g->length, per_h, g->comoving ? " comoving" : "");
	if (!strcmp(p->name, "v"))
		snprintf(p->unit, PM_NAME, "%g cm/s", g->speed);
	if (!strcmp(p->name, "mass"))
		snprintf(p->unit, PM_NAME, "%g g%s", g->weight, per_h);
}

static struct pm_field *field_make(struct work *w, const char *set, const struct plan *p)
{
	struct pm_field *field = pm_makes(w->f, set, p->field, p->components, PM_STATE);
	if (!field)
		return NULL;
	field->type = p->type;
	field->extensive = !strcmp(p->field, "mass");
	unit(&w->g, field);
	return field;
}

static int uniform_mass(struct work *w, const char *set, double mass)
{
	const struct plan p = {.field = "mass", .components = 1, .type = PM_F64};
	struct pm_field *field = field_make(w, set, &p);
	if (!field)
		return -PM_DATA;
	field->uniform = true, field->value[0] = mass, field->use = 0;
	return 0;
}

/* Reads a field out of all files; file: the one that is open. */
static int field_read(struct work *w, hid_t file, int type, const struct plan *p)
{
	char set[16];
	size_t at = 0;
	bool beyond = false;
	snprintf(set, sizeof set, "PartType%d", type);
	struct pm_field *field = field_make(w, set, p);
	int status = field ? pm_field_ready(field) : -PM_DATA;
	for (int k = 0; k < w->g.files && !status; k++) {
		hid_t part = w->g.files == 1 ? file : pm_gadget_open(&w->g, k);
		status = part < 0 || pm_gadget_here(part, &w->g) ? -PM_DATA : 0;
		if (!status && w->g.here[type] > (double)(field->count - at))
			status = pm_fail(PM_DATA, "the files hold more particles of type %d than the header says", type);
		if (!status && w->g.here[type] > 0)
			status = part_read(w, part, type, p, field, at, &beyond);
		at += status ? 0 : (size_t)w->g.here[type];
		if (w->g.files > 1)
			H5Fclose(part);
	}
	if (!status && at != field->count)
		status = pm_fail(PM_DATA, "the files hold %zu particles of type %d, but the header says %zu", at, type, field->count);
	if (status)
		return status;
	field->use = 0;
	if (beyond) {
		leave_out(w, set, p->dataset, "whole numbers beyond 2^63");
		pm_list_remove((void **)w->f->fields, &w->f->nfields, field);
		pm_field_free(field);
	}
	return 0;
}

static int compare(const void *a, const void *b)
{
	const struct plan *p = a, *q = b;
	static const char *const first[] = {"x", "v", "mass", "id", NULL};
	int i = 0, k = 0;
	while (first[i] && strcmp(first[i], p->field))
		i++;
	while (first[k] && strcmp(first[k], q->field))
		k++;
	return i != k ? i - k : strcmp(p->field, q->field);
}

static int set_read(struct work *w, hid_t file, int type, hid_t first)
{
	char set[16];
	struct plan *plan = calloc(256, sizeof *plan);
	int n = 0, status = plan ? 0 : pm_no_memory();
	bool mass = false, x = false;
	snprintf(set, sizeof set, "PartType%d", type);
	if (!status && (!pm_frame_set_new(w->f, set, (uint64_t)w->g.total[type]) || pm_h5_children(first, set, &w->names)))
		status = -PM_DATA;
	for (int i = 0; i < w->names.n && !status; i++) {
		struct plan *p = plan + n;
		hsize_t rows;
		hid_t d = dataset_open(first, type, w->names.name[i]);
		const char *why = d < 0 ? "no array" : look(d, p, &rows);
		H5Dclose(d);
		pm_name_copy(p->dataset, w->names.name[i]);
		pm_name_copy(p->field, field_of(p->dataset, type));
		for (int k = 0; k < n && !why; k++)
			why = strcmp(plan[k].field, p->field) ? NULL : "its name is taken";
		if (why)
			leave_out(w, set, p->dataset, why);
		n += !why;
	}
	if (!status)
		qsort(plan, (size_t)n, sizeof *plan, compare);
	for (int i = 0; i < n && !status; i++) {
		x |= !strcmp(plan[i].field, "x") && plan[i].components == 3 && plan[i].type != PM_I64;
		mass |= !strcmp(plan[i].field, "mass");
		if (!mass && i && !strcmp(plan[i - 1].field, "v") && w->g.mass[type] > 0)
			status = uniform_mass(w, set, w->g.mass[type]), mass = true;
		status = status ? status : field_read(w, file, type, plan + i);
	}
	if (!status && !mass && w->g.mass[type] > 0)
		status = uniform_mass(w, set, w->g.mass[type]), mass = true;
	if (!status && !x)
		status = pm_fail(PM_DATA, "PartType%d has no Coordinates of three components", type);
	if (!status && !mass)
		leave_out(w, set, "mass", "neither Masses nor MassTable have it");
	free(plan);
	return status;
}

/* The first file that has particles of this type, to see which arrays there are. */
static int type_read(struct work *w, hid_t file, int type)
{
	hid_t first = w->g.files == 1 ? file : -1;
	int status = 0;
	for (int k = 0; k < w->g.files && first < 0 && !status; k++) {
		first = pm_gadget_open(&w->g, k);
		status = first < 0 || pm_gadget_here(first, &w->g) ? -PM_DATA : 0;
		if (first >= 0 && (status || w->g.here[type] == 0))
			H5Fclose(first), first = -1;
	}
	if (!status)
		status = first < 0 ? pm_fail(PM_DATA, "no file holds particles of type %d, but the header says so", type) : set_read(w, file, type, first);
	if (w->g.files > 1 && first >= 0)
		H5Fclose(first);
	return status;
}

/* The stated box, periodic, if all particles are in it; else twice their extent, open. */
static void box_about(struct work *w)
{
	struct pm_frame *f = w->f;
	double lo[3], hi[3];
	bool inside = w->g.box[0] > 0 && w->g.box[1] > 0 && w->g.box[2] > 0 && w->g.periodic != 0;
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_field *x = pm_frame_field(f, f->sets[i]->name, "x");
		for (int d = 0; d < 3 && inside; d++)
			for (size_t k = 0; k < x->count && inside; k++)
				inside = pm_in(x, d)[k] >= 0 && pm_in(x, d)[k] <= w->g.box[d];
		pm_columns_box(f, f->sets[i]->name);
		for (int d = 0; d < 3; d++)
			lo[d] = i && lo[d] < f->lo[d] ? lo[d] : f->lo[d], hi[d] = i && hi[d] > f->hi[d] ? hi[d] : f->hi[d];
	}
	for (int d = 0; d < 3; d++) {
		f->lo[d] = inside ? 0 : lo[d], f->hi[d] = inside ? w->g.box[d] : hi[d];
		for (int side = 0; side < 2 && inside; side++)
			f->face[d][side] = PM_PERIODIC, f->pface[d][side] = PM_PFOLD;
	}
	w->g.periodic = inside;
}

/* One sentence on how it was read; sh5 prints it. */
static int describe(struct work *w, const char *word)
{
	const struct pm_gadget *g = &w->g;
	struct pm_frame *f = w->f;
	char text[2048], how[64] = "", law[160];
	if (g->comoving && !g->swift)
		snprintf(how, sizeof how, ", v = sqrt(a) Velocities");
	else
		snprintf(how, sizeof how, ", v = Velocities");
	if (g->G && !g->comoving) {
		pm_name_copy(f->law, "gravity");
		pm_frame_constant_set(f, "G", g->G);
		snprintf(law, sizeof law, "gravity with G = %g", g->G);
	} else if (g->comoving)
		snprintf(law, sizeof law, "law free, because no law here expands (smod --law gravity --constant G=%g)", g->G ? g->G : 43007.1);
	else
		snprintf(law, sizeof law, "no units stated, so the law is free (kpc, 1e10 Msun, km/s: smod --law gravity --constant G=43007.1)");
	if (g->comoving)
		pm_frame_constant_set(f, "a", g->a);
	snprintf(text, sizeof text, "GADGET snapshot%s, %d file%s%s%s, %s box, %s", g->swift ? " of SWIFT" : "", g->files, g->files > 1 ? "s" : "",
		g->comoving ? ", comoving lengths" : "", how, g->periodic ? "the periodic" : "an open", law);
	json_t *said = json_pack("{s:s, s:s}", "read", text, "left_out", *w->left_out ? w->left_out : "nothing");
	return said && !json_object_set_new(f->report, word, said) ? 0 : pm_no_memory();
}

int pm_gadget_frame(const struct pm_h5 *h, struct pm_frame **out)
{
	struct work *w = calloc(1, sizeof *w);
	int status = w ? pm_gadget_header(h->file, h->path, &w->g) : pm_no_memory();
	if (!status && !(w->f = pm_frame_new(3)))
		status = -PM_DATA;
	for (int t = 0; t < (w ? w->g.types : 0) && !status; t++)
		if (w->g.total[t] > 0)
			status = type_read(w, h->file, t);
	if (!status && !w->f->nsets)
		status = pm_fail(PM_DATA, "the snapshot has no particles");
	if (!status) {
		w->f->time = w->f->start = w->g.time;
		box_about(w);
		status = describe(w, h->word);
	}
	*out = status && w ? pm_frame_free(w->f) : w ? w->f : NULL;
	free(w);
	return status;
}
