/* An iteration that other programs wrote, as far as the base standard of openPMD 1.0 and 1.1 goes: species become sets (position + positionOffset
 * is x, velocity is v), cartesian mesh records become fields on meshes, everything in SI. Strengths are those of the whole particle: mass and charge are
 * multiplied by weighting^weightingPower if they are not macroWeighted. Anything that cannot be read is an error; nothing is skipped silently.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "h5/apart.h"
#include "h5/node.h"
#include "stream/columns.h"
#include "stream/list.h"
#include "stream/run.h"

struct part { /* a component */
	bool constant;
	enum pm_type type;
	double value, unit, place[3];
	int rank;
	hsize_t dims[3];
};

static bool is_dataset(hid_t at, const char *path)
{
	hid_t o = H5Oopen(at, path, H5P_DEFAULT);
	bool is = o >= 0 && H5Iget_type(o) == H5I_DATASET;
	H5Oclose(o);
	return is;
}

static bool is_component(hid_t at, const char *path)
{
	hid_t o = H5Oopen(at, path, H5P_DEFAULT);
	bool is = o >= 0 && (H5Iget_type(o) == H5I_DATASET || pm_h5_has(o, "shape"));
	H5Oclose(o);
	return is;
}

static int dataset_look(hid_t d, struct part *c)
{
	hid_t space = H5Dget_space(d), type = H5Dget_type(d);
	H5T_class_t class = H5Tget_class(type);
	c->rank = H5Sget_simple_extent_ndims(space);
	bool good = c->rank >= 1 && c->rank <= 3 && (class == H5T_FLOAT || class == H5T_INTEGER);
	if (good)
		H5Sget_simple_extent_dims(space, c->dims, NULL);
	c->type = class == H5T_INTEGER ? PM_I64 : H5Tget_size(type) <= 4 ? PM_F32 : PM_F64;
	H5Sclose(space), H5Tclose(type);
	return good ? 0 : -1;
}

static int look(hid_t at, const char *path, struct part *c)
{
	double shape[3] = {0};
	int status = 0, n = 3;
	hid_t o = H5Oopen(at, path, H5P_DEFAULT);
	*c = (struct part){.rank = 3, .constant = is_dataset(at, path) == false, .type = PM_F64};
	if (o < 0)
		return pm_fail(PM_DATA, "there is no '%s'", path);
	if (!c->constant)
		status = dataset_look(o, c);
	else if (!(status = pm_h5_get_reals(o, "shape", &c->rank, shape))) {
		c->value = pm_h5_number(o, "value", NAN);
		for (int a = 0; a < c->rank; a++)
			c->dims[a] = (hsize_t)shape[a];
		status = isfinite(c->value) ? 0 : -1;
	}
	c->unit = pm_h5_number(o, "unitSI", 1);
	if (pm_h5_has(o, "position"))
		status = status ? status : pm_h5_get_reals(o, "position", &n, c->place);
	H5Oclose(o);
	for (int a = 0; a < c->rank && !status; a++)
		status = c->dims[a] < (hsize_t)1 << 31 || c->rank == 1 ? 0 : -1;
	if (c->unit != 1)
		c->type = PM_F64, c->value *= c->unit;
	return status ? pm_fail(PM_DATA, "'%s' is neither an array of numbers with 1 to 3 axes nor a constant component", path) : 0;
}

/* Values of a component, times unitSI. */
static int load(hid_t at, const char *path, const struct part *c, struct pm_field *p, int k)
{
	pm_h5_goes_on(p->count * sizeof(double));
	hid_t d = H5Dopen2(at, path, H5P_DEFAULT);
	bool whole = p->type == PM_I64;
	void *to = whole ? (void *)pm_out_i64(p, k) : (void *)pm_out(p, k);
	int status = p->count && H5Dread(d, whole ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, to) < 0
		? pm_h5_fail("cannot read '%s'", path) : 0;
	H5Dclose(d);
	for (size_t i = 0; c->unit != 1 && !whole && i < p->count; i++)
		((double *)to)[i] *= c->unit;
	return status;
}

/* A record becomes a field: its components are the children of path, or path itself. */
static int record(hid_t at, const char *path, const struct pm_h5_names *parts, struct pm_frame *f, const char *on, const char *name)
{
	char full[4 * PM_H5_PATH];
	struct part c[PM_COMPONENTS];
	int n = parts->n ? parts->n : 1, status = n > PM_COMPONENTS ? pm_fail(PM_DATA, "'%s' has more components than %d", path, PM_COMPONENTS) : 0;
	struct pm_field *p = status ? NULL : pm_makes(f, on, name, n, PM_STATE);
	bool constant = true;
	if (!p)
		return -PM_DATA;
	for (int k = 0; k < n && !status; k++) {
		snprintf(full, sizeof full, parts->n ? "%s/%s" : "%s", path, parts->n ? parts->name[k] : "");
		status = look(at, full, c + k);
		hsize_t count = status ? 0 : c[k].dims[0] * (c[k].rank > 1 ? c[k].dims[1] : 1) * (c[k].rank > 2 ? c[k].dims[2] : 1);
		if (!status && count != p->count)
			status = pm_fail(PM_DATA, "'%s' has %llu values, but %zu are needed", full, (unsigned long long)count, p->count);
		p->type = k == 0 || c[k].type == p->type ? c[k].type : PM_F64;
		constant = constant && c[k].constant;
		p->value[k] = c[k].value;
	}
	if (!strncmp(name, "positionOffset", 14) || (!strcmp(name, "x") && pm_frame_set(f, on)))
		p->type = PM_F64; /* some programs count cells */
	p->uniform = constant;
	p->use = PM_USE_NEW;
	if (!status && !constant)
		status = pm_field_ready(p);
	for (int k = 0; k < n && !status && !constant; k++) {
		snprintf(full, sizeof full, parts->n ? "%s/%s" : "%s", path, parts->n ? parts->name[k] : "");
		for (size_t i = 0; c[k].constant && i < p->count; i++)
			pm_out(p, k)[i] = c[k].value;
		status = c[k].constant ? 0 : load(at, full, c + k, p, k);
	}
	p->use = 0;
	return status;
}

/* a <- a * b^power, or a + b; both of the same set. */
static int combine(struct pm_field *a, struct pm_field *b, bool add, double power)
{
	if (a->type == PM_I64 || b->type == PM_I64)
		return pm_fail(PM_DATA, "'%s' and '%s' must be real", a->name, b->name);
	if (a->uniform)
		a->use = PM_USE_READ;
	b->use = PM_USE_READ;
	if (pm_field_ready(a) || pm_field_ready(b))
		return -PM_DATA;
	a->uniform = a->uniform && b->uniform;
	for (int c = 0; c < a->components; c++) {
		double *y = pm_out(a, c);
		const double *x = pm_in(b, c < b->components ? c : 0);
		for (size_t i = 0; i < a->count; i++)
			y[i] = add ? y[i] + x[i] : y[i] * pow(x[i], power);
		a->value[c] = a->uniform && a->count ? y[0] : a->value[c];
	}
	a->type = PM_F64;
	a->use = b->use = 0;
	return 0;
}

/* Strengths of the whole particle. */
static int weigh(hid_t at, const char *folder, struct pm_frame *f, const char *set)
{
	static const char *const strengths[] = {"mass", "charge", NULL};
	struct pm_field *w = pm_frame_field(f, set, "weighting");
	if (w)
		w->extensive = true;
	for (int i = 0; strengths[i]; i++) {
		struct pm_field *p = pm_frame_field(f, set, strengths[i]);
		char path[2 * PM_H5_PATH];
		snprintf(path, sizeof path, "%s/%s", folder, strengths[i]);
		hid_t o = p ? H5Oopen(at, path, H5P_DEFAULT) : -1;
		double whole = p ? pm_h5_number(o, "macroWeighted", 1) : 1, power = p ? pm_h5_number(o, "weightingPower", 0) : 0;
		H5Oclose(o);
		if (p)
			p->extensive = true;
		if (p && w && whole == 0 && power != 0 && combine(p, w, false, power))
			return -PM_DATA;
	}
	return 0;
}

static int species(hid_t at, const char *folder, const char *name, struct pm_frame *f)
{
	struct pm_h5_names *records = malloc(2 * sizeof *records), *parts = records + 1;
	char path[2 * PM_H5_PATH];
	struct part first;
	int status = records ? pm_h5_children(at, folder, records) : pm_no_memory();
	snprintf(path, sizeof path, "%s/position", folder);
	if (!status && !(status = pm_h5_children(at, path, parts))) {
		snprintf(path, sizeof path, "%s/position/%s", folder, parts->name[0]);
		status = parts->n == f->dim ? look(at, path, &first)
			: pm_fail(PM_DATA, "the positions of '%s' have %d components in %d dimensions", name, parts->n, f->dim);
	}
	if (!status && (pm_frame_set(f, name) || !pm_frame_set_new(f, name, first.dims[0])))
		status = -PM_DATA;
	for (int i = 0; i < (records ? records->n : 0) && !status; i++) {
		const char *r = records->name[i];
		snprintf(path, sizeof path, "%s/%s", folder, r);
		if (!strcmp(r, "particlePatches"))
			continue;
		parts->n = 0;
		status = is_component(at, path) ? 0 : pm_h5_children(at, path, parts);
		if (!status)
			status = record(at, path, parts, f, name, !strcmp(r, "position") ? "x" : !strcmp(r, "velocity") ? "v" : r);
	}
	struct pm_field *offset = pm_frame_field(f, name, "positionOffset"), *x = pm_frame_field(f, name, "x");
	if (!status && offset && x) {
		status = combine(x, offset, true, 1);
		pm_list_remove((void **)f->fields, &f->nfields, offset);
		pm_field_free(offset);
	}
	if (!status)
		status = weigh(at, folder, f, name);
	free(records);
	return status;
}

/* ---- meshes ---- */

struct lattice { /* by dataset axis */
	int axis[3]; /* the axis of the frame that it is */
	double h[3], lo[3];
};

static int lattice_look(hid_t o, const char *name, int dim, struct lattice *l)
{
	char letters[3], *geometry = pm_h5_has(o, "geometry") ? pm_h5_get_text(o, "geometry") : NULL;
	char *order = pm_h5_has(o, "dataOrder") ? pm_h5_get_text(o, "dataOrder") : NULL;
	bool good = (!geometry || !strcmp(geometry, "cartesian")) && (!order || *order == 'C');
	int nh = 3, nlo = 3;
	free(geometry), free(order);
	if (!good)
		return pm_fail(PM_DATA, "mesh '%s': only cartesian meshes in C order are read", name);
	if (pm_h5_get_letters(o, "axisLabels", 3, letters) != dim || pm_h5_get_reals(o, "gridSpacing", &nh, l->h) ||
		pm_h5_get_reals(o, "gridGlobalOffset", &nlo, l->lo) || nh != dim || nlo != dim)
		return pm_fail(PM_DATA, "mesh '%s': axisLabels, gridSpacing and gridGlobalOffset do not name %d axes", name, dim);
	double unit = pm_h5_number(o, "gridUnitSI", 1);
	for (int k = 0; k < dim; k++) {
		l->h[k] *= unit, l->lo[k] *= unit, l->axis[k] = 0;
		for (int j = 0; j < dim; j++)
			l->axis[k] += letters[j] < letters[k];
		for (int j = 0; j < k; j++)
			good = good && letters[j] != letters[k];
		good = good && l->h[k] > 0;
	}
	return good ? 0 : pm_fail(PM_DATA, "mesh '%s': an axis is named twice, or has an invalid spacing", name);
}

/* The mesh with these points, made if it does not exist. */
static struct pm_mesh *mesh_of(struct pm_frame *f, const struct lattice *l, const struct part *c, const char *name)
{
	size_t cells[3] = {1, 1, 1};
	double h[3] = {1, 1, 1}, lo[3] = {0};
	char free_name[PM_NAME] = "mesh";
	for (int k = 0; k < f->dim; k++) {
		int a = l->axis[k];
		if (c->dims[k] < 2) {
			pm_fail(PM_DATA, "mesh '%s' has one point along an axis", name);
			return NULL;
		}
		cells[a] = c->dims[k] - 1, h[a] = l->h[k], lo[a] = l->lo[k] + c->place[k] * l->h[k];
	}
	for (size_t i = 0; i < f->nmeshes; i++)
		if (!memcmp(f->meshes[i]->cells, cells, sizeof cells) && !memcmp(f->meshes[i]->h, h, sizeof h) && !memcmp(f->meshes[i]->lo, lo, sizeof lo))
			return f->meshes[i];
	for (int k = 2; pm_frame_set(f, free_name) || pm_frame_mesh(f, free_name); k++)
		snprintf(free_name, sizeof free_name, "mesh-%d", k);
	struct pm_mesh *m = pm_frame_mesh_new(f, free_name, cells);
	if (m)
		memcpy(m->h, h, sizeof h), memcpy(m->lo, lo, sizeof lo);
	return m;
}

/* Transposes to the order of the frame: axis 0 fastest. Every value has 8 bytes. */
static int reorder(const struct pm_frame *f, struct pm_field *p, const struct lattice *l, const hsize_t *dims)
{
	size_t stride[3] = {1, 1, 1};
	bool same = true;
	for (int k = 0; k < f->dim; k++)
		same = same && l->axis[k] == f->dim - 1 - k;
	for (int k = 0; k < f->dim; k++)
		for (int j = 0; j < f->dim; j++)
			stride[k] *= l->axis[j] < l->axis[k] ? dims[j] : 1;
	int64_t *copy = same || p->uniform ? NULL : pm_alloc(p->count, sizeof *copy);
	if (same || p->uniform || !copy)
		return same || p->uniform ? 0 : -PM_DATA;
	for (int c = 0; c < p->components; c++) {
		memcpy(copy, pm_out_i64(p, c), p->count * sizeof *copy);
		for (size_t i = 0; i < p->count; i++) {
			size_t left = i, to = 0;
			for (int k = f->dim - 1; k >= 0; k--)
				to += left % dims[k] * stride[k], left /= dims[k];
			pm_out_i64(p, c)[to] = copy[i];
		}
	}
	pm_free(copy);
	return 0;
}

static int mesh_part(hid_t at, const char *path, const struct pm_h5_names *parts, const struct lattice *l, const struct part *c, struct pm_frame *f,
	const char *name)
{
	struct pm_mesh *m = mesh_of(f, l, c, name);
	int status = m ? record(at, path, parts, f, m->name, name) : -PM_DATA;
	return status ? status : reorder(f, pm_frame_field(f, m->name, name), l, c->dims);
}

/* Components at different positions in a cell become fields NAME_x on separate meshes. */
static int mesh_record(hid_t at, const char *folder, const char *name, struct pm_frame *f)
{
	struct pm_h5_names *parts = malloc(2 * sizeof *parts), *none = parts + 1;
	struct part c[PM_COMPONENTS];
	struct lattice l;
	char path[2 * PM_H5_PATH], full[3 * PM_H5_PATH], own[2 * PM_NAME];
	bool together = true;
	if (!parts)
		return pm_no_memory();
	snprintf(path, sizeof path, "%s/%s", folder, name);
	hid_t o = H5Oopen(at, path, H5P_DEFAULT);
	int status = parts && o >= 0 ? lattice_look(o, name, f->dim, &l) : -PM_DATA;
	H5Oclose(o);
	if (parts)
		parts->n = none->n = 0;
	if (!status && !is_component(at, path))
		status = pm_h5_children(at, path, parts);
	for (int k = 0; !status && k < (parts->n ? parts->n : 1); k++) {
		snprintf(full, sizeof full, parts->n ? "%s/%s" : "%s", path, parts->n ? parts->name[k] : "");
		status = k == PM_COMPONENTS ? pm_fail(PM_DATA, "mesh '%s' has too many components", name) : look(at, full, c + k);
		if (!status && (c[k].rank != f->dim || memcmp(c[k].dims, c[0].dims, (size_t)f->dim * sizeof(hsize_t))))
			status = pm_fail(PM_DATA, "'%s' has a different shape from the others", full);
		together = status || (together && !memcmp(c[k].place, c[0].place, sizeof c[0].place));
	}
	if (!status && together)
		status = mesh_part(at, path, parts, &l, c, f, name);
	for (int k = 0; !status && !together && k < parts->n; k++) {
		snprintf(full, sizeof full, "%s/%s", path, parts->name[k]);
		if (snprintf(own, sizeof own, "%s_%s", name, parts->name[k]) >= PM_NAME)
			status = pm_fail(PM_DATA, "the name '%s' is too long", own);
		else
			status = mesh_part(at, full, none, &l, c + k, f, own);
	}
	free(parts);
	return status;
}

/* ---- the iteration ---- */

/* "meshes/" of the file, without the slash. */
static void folder_of(hid_t at, const char *attribute, const char *otherwise, char out[PM_NAME])
{
	hid_t file = H5Iget_file_id(at), root = H5Gopen2(file, "/", H5P_DEFAULT);
	char *text = pm_h5_has(root, attribute) ? pm_h5_get_text(root, attribute) : NULL;
	pm_name_copy(out, text && *text ? text : otherwise);
	free(text);
	size_t n = strlen(out);
	if (n && out[n - 1] == '/')
		out[n - 1] = 0;
	H5Gclose(root), H5Fclose(file);
}

/* The number of dimensions: that of the positions of the first species, or of the axes of the first mesh. */
static int dimensions(hid_t at, const char *sets, const struct pm_h5_names *set, const char *meshes, const struct pm_h5_names *mesh)
{
	struct pm_h5_names *parts = malloc(sizeof *parts);
	char path[PM_H5_PATH], letters[3];
	int dim = -1;
	if (!parts)
		return pm_no_memory();
	if (parts && set->n) {
		snprintf(path, sizeof path, "%s/%s/position", sets, set->name[0]);
		dim = pm_h5_children(at, path, parts) ? -1 : parts->n;
	} else if (parts && mesh->n) {
		snprintf(path, sizeof path, "%s/%s", meshes, mesh->name[0]);
		hid_t o = H5Oopen(at, path, H5P_DEFAULT);
		dim = pm_h5_get_letters(o, "axisLabels", 3, letters);
		H5Oclose(o);
	} else
		pm_fail(PM_DATA, "there are neither particles nor meshes");
	free(parts);
	return dim >= 1 && dim <= 3 ? dim : dim < 0 ? -PM_DATA : pm_fail(PM_DATA, "%d dimensions are not supported", dim);
}

/* The box: that of the meshes, or without any a box around the particles. */
static void box_about(struct pm_frame *f)
{
	for (size_t i = 0; i < f->nmeshes; i++)
		for (int a = 0; a < f->dim; a++) {
			const struct pm_mesh *m = f->meshes[i];
			double lo = m->lo[a], hi = lo + (double)m->cells[a] * m->h[a];
			f->lo[a] = i && f->lo[a] < lo ? f->lo[a] : lo;
			f->hi[a] = i && f->hi[a] > hi ? f->hi[a] : hi;
		}
	struct pm_field *x = f->nsets ? pm_frame_field(f, f->sets[0]->name, "x") : NULL;
	if (!f->nmeshes && x && !x->uniform)
		pm_columns_box(f, f->sets[0]->name);
}

int pm_h5_get_foreign(hid_t at, const char *name, struct pm_frame **out)
{
	struct pm_h5_names *set = malloc(2 * sizeof *set), *mesh = set + 1;
	char sets[PM_NAME], meshes[PM_NAME], path[PM_H5_PATH];
	folder_of(at, "particlesPath", "particles", sets), folder_of(at, "meshesPath", "meshes", meshes);
	int status = set ? 0 : pm_no_memory();
	if (set)
		set->n = mesh->n = 0;
	if (!status && H5Lexists(at, sets, H5P_DEFAULT) > 0)
		status = pm_h5_children(at, sets, set);
	if (!status && H5Lexists(at, meshes, H5P_DEFAULT) > 0)
		status = pm_h5_children(at, meshes, mesh);
	int dim = status ? status : dimensions(at, sets, set, meshes, mesh);
	struct pm_frame *f = dim > 0 ? pm_frame_new(dim) : NULL;
	status = f ? 0 : -PM_DATA;
	for (int i = 0; !status && i < set->n; i++) {
		snprintf(path, sizeof path, "%s/%s", sets, set->name[i]);
		status = species(at, path, set->name[i], f);
	}
	for (int i = 0; !status && i < mesh->n; i++)
		status = mesh_record(at, meshes, mesh->name[i], f);
	if (!status) {
		double unit = pm_h5_number(at, "timeUnitSI", 1);
		f->time = f->start = unit * pm_h5_number(at, "time", 0), f->dt = unit * pm_h5_number(at, "dt", 0);
		f->step = strtoll(name, NULL, 10);
		box_about(f);
	}
	free(set);
	*out = status ? pm_frame_free(f) : f;
	return status;
}
