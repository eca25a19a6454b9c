/* Frames into an openPMD 1.1 file (https://github.com/openPMD/openPMD-standard/blob/1.1.0/STANDARD.md): particles, meshes, constant components,
 * and in addition the header of the stream, verbatim, from which sh5 reproduces the same bytes. Every unitSI is 1, because the units are the user's.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/replace.h"
#include "h5/apart.h"
#include "h5/node.h"
#include "stream/forward.h"
#include "stream/header.h"
#include "stream/limits.h"
#include "stream/parts-file.h"
#include "world/world.h"

/* Powers of length, mass, time, current, temperature, amount, luminous intensity. A density is divided by a length per dimension. */
static const struct dimension {
	const char *law, *name;
	double power[7];
	bool density;
} dimensions[] = {
	{NULL, "x", {1}, false},
	{NULL, "v", {1, 0, -1}, false},
	{NULL, "vel", {1, 0, -1}, false},
	{NULL, "u", {1, 0, -1}, false},
	{NULL, "acc", {1, 0, -2}, false},
	{NULL, "g", {1, 0, -2}, false},
	{NULL, "mass", {0, 1}, false},
	{NULL, "charge", {0, 0, 1, 1}, false},
	{NULL, "circulation", {2, 0, -1}, false},
	{NULL, "alpha", {3, 0, -1}, false},
	{NULL, "omega", {0, 0, -1}, false},
	{NULL, "psi", {2, 0, -1}, false},
	{NULL, "E", {1, 1, -3, -1}, false},
	{NULL, "B", {0, 1, -2, -1}, false},
	{"gravity", "rho", {0, 1}, true},
	{"gravity", "phi", {2, 0, -2}, false},
	{"electrostatic", "rho", {0, 0, 1, 1}, true},
	{"electrostatic", "phi", {2, 1, -3, -1}, false},
	{NULL, NULL, {0}, false},
};

static int put_dimension(hid_t at, const struct pm_frame *f, const struct pm_field *p)
{
	const struct dimension *d = dimensions;
	double power[7];
	while (d->name && (strcmp(d->name, p->name) || (d->law && strcmp(d->law, f->law))))
		d++;
	memcpy(power, d->power, sizeof power);
	power[0] -= d->density ? f->dim : 0;
	return pm_h5_put_reals(at, "unitDimension", 7, power);
}

/* Shape as HDF5 counts: the fastest axis last. */
static int shape(const struct pm_frame *f, const struct pm_field *p, hsize_t dims[3])
{
	const struct pm_mesh *m = pm_frame_mesh(f, p->on);
	size_t points[3];
	dims[0] = p->count;
	if (!m)
		return 1;
	pm_mesh_points(f, m, points);
	for (int a = 0; a < f->dim; a++)
		dims[f->dim - 1 - a] = points[a];
	return f->dim;
}

static hid_t put_constant(hid_t at, const char *name, double value, int rank, const hsize_t *dims)
{
	uint64_t as[3] = {0};
	hid_t g = pm_h5_group(at, name);
	for (int a = 0; a < rank; a++)
		as[a] = dims[a];
	return g < 0 || pm_h5_put_reals(g, "value", 0, &value) || pm_h5_put_counts(g, "shape", rank, as) ? -1 : g;
}

static hid_t put_component(hid_t at, const char *name, const struct pm_frame *f, struct pm_field *p, int c, struct pm_reader *r)
{
	hsize_t dims[3];
	double one = 1, place[3];
	int rank = shape(f, p, dims), status;
	hid_t o = p->uniform ? put_constant(at, name, p->value[c], rank, dims) : pm_h5_put_data(at, name, p, c, rank, dims, r);
	if (o < 0)
		return -1;
	status = pm_h5_put_reals(o, "unitSI", 0, &one);
	for (int a = 0; a < f->dim; a++)
		place[f->dim - 1 - a] = p->staggered[c][a] / 2.;
	if (!status && pm_frame_mesh(f, p->on))
		status = pm_h5_put_reals(o, "position", f->dim, place);
	return status ? -1 : o;
}

static int put_mesh_record(hid_t at, const struct pm_frame *f, const struct pm_mesh *m)
{
	char labels[3];
	double h[3], lo[3], one = 1;
	for (int a = 0; a < f->dim; a++) {
		int k = f->dim - 1 - a;
		labels[k] = (char)('x' + a), h[k] = m->h[a], lo[k] = m->lo[a];
	}
	return pm_h5_put_text(at, "geometry", "cartesian") || pm_h5_put_text(at, "dataOrder", "C") || pm_h5_put_letters(at, "axisLabels", f->dim, labels) ||
			pm_h5_put_reals(at, "gridSpacing", f->dim, h) || pm_h5_put_reals(at, "gridGlobalOffset", f->dim, lo) ||
			pm_h5_put_reals(at, "gridUnitSI", 0, &one)
		? -PM_DATA
		: 0;
}

/* A strength belongs to the whole (macro)particle, a value to each body in it (terms of the ED-PIC extension, useful without it too). */
static int put_record(hid_t at, const struct pm_frame *f, const struct pm_field *p)
{
	const struct pm_mesh *m = pm_frame_mesh(f, p->on);
	double zero = 0, power = p->extensive;
	int status = put_dimension(at, f, p);
	if (!status)
		status = pm_h5_put_reals(at, "timeOffset", 0, &zero);
	if (!status && m)
		status = put_mesh_record(at, f, m);
	else if (!status && !(status = pm_h5_put_flag(at, "macroWeighted", p->extensive)))
		status = pm_h5_put_reals(at, "weightingPower", 0, &power);
	return status;
}

static int put_field(hid_t iteration, const struct pm_frame *f, struct pm_field *p, const char *path, struct pm_reader *r)
{
	char name[8];
	hid_t g, o;
	int status = 0;
	if (!pm_h5_is_vector(p)) { /* the group was made before */
		if ((o = put_component(iteration, path, f, p, 0, r)) < 0)
			return -PM_DATA;
		status = put_record(o, f, p);
		H5Oclose(o);
		return status;
	}
	if ((g = pm_h5_group(iteration, path)) < 0)
		return -PM_DATA;
	for (int c = 0; c < p->components && !status; c++) {
		pm_h5_component(p, c, name);
		status = (o = put_component(g, name, f, p, c, r)) < 0 ? -PM_DATA : 0;
		if (!status)
			H5Oclose(o);
	}
	status = status ? status : put_record(g, f, p);
	H5Gclose(g);
	return status;
}

/* Positions are absolute, so the positionOffset required by openPMD is 0. path: that of x. */
static int put_offset(hid_t iteration, const struct pm_frame *f, const struct pm_field *x, const char *path)
{
	struct pm_field offset = *x;
	char longer[PM_H5_PATH + 8];
	offset.uniform = true;
	memset(offset.value, 0, sizeof offset.value);
	snprintf(longer, sizeof longer, "%sOffset", path);
	return put_field(iteration, f, &offset, longer, NULL);
}

/* The group of a path, made if it does not exist. */
static int put_folder(hid_t iteration, const char *path)
{
	char folder[PM_H5_PATH];
	snprintf(folder, sizeof folder, "%s", path);
	*strrchr(folder, '/') = 0;
	char *inner = strchr(folder, '/');
	if (inner)
		*inner = 0;
	for (int level = 0; level < 1 + !!inner; level++) {
		if (level)
			*inner = '/';
		if (H5Lexists(iteration, folder, H5P_DEFAULT) > 0)
			continue;
		hid_t g = pm_h5_group(iteration, folder);
		if (g < 0)
			return -PM_DATA;
		H5Gclose(g);
	}
	return 0;
}

static int put_fields(hid_t iteration, const struct pm_frame *f, struct pm_reader *r)
{
	char(*path)[PM_H5_PATH] = calloc(f->nfields + 1, sizeof *path);
	int status = path ? 0 : pm_no_memory();
	if (!status)
		pm_h5_paths(f, path);
	for (size_t i = 0; i < f->nfields && !status; i++) {
		struct pm_field *p = f->fields[i];
		status = put_folder(iteration, path[i]);
		if (!status)
			status = put_field(iteration, f, p, path[i], r);
		if (!status && pm_frame_set(f, p->on) && !strcmp(p->name, "x"))
			status = put_offset(iteration, f, p, path[i]);
	}
	free(path);
	return status;
}

/* A text and its checksum, which also enters that of the file. */
static int put_checked(struct pm_h5 *h, hid_t at, const char *name, const char *text)
{
	char checksum[64];
	snprintf(checksum, sizeof checksum, "%sCrc32c", name);
	h->crc = pm_crc32c(h->crc, text, strlen(text));
	int status = pm_h5_put_long_text(at, name, text);
	return status ? status : pm_h5_put_checksum(at, checksum, pm_crc32c(0, text, strlen(text)));
}

static int put_json(struct pm_h5 *h, hid_t at, const char *name, const json_t *j)
{
	char *text = j ? pm_json_line(j) : NULL;
	int status = text ? put_checked(h, at, name, text) : pm_fail(PM_DATA, "the attribute '%s' cannot be written as JSON", name);
	free(text);
	return status;
}

static int put_header(struct pm_h5 *h, hid_t at, const struct pm_frame *f)
{
	double one = 1;
	json_t *header = pm_header_json(f);
	int status = put_json(h, at, "pmpipeHeader", header);
	json_decref(header);
	return status || pm_h5_put_reals(at, "time", 0, &f->time) || pm_h5_put_reals(at, "dt", 0, &f->dt) || pm_h5_put_reals(at, "timeUnitSI", 0, &one)
		? -PM_DATA : 0;
}

/* What is in the tail of the frame in the stream. */
static int put_tail(struct pm_h5 *h, hid_t at, const struct pm_frame *f)
{
	json_t *limits = pm_limits_json(f);
	int status = put_json(h, at, "pmpipeReport", f->report);
	if (!status && limits)
		status = put_json(h, at, "pmpipeLimits", limits);
	json_decref(limits);
	return status;
}

/* An iteration is named by its step, or by the next free number if the step does not increase, so that names sort in the order of the frames. */
int pm_h5_put(struct pm_h5 *h, struct pm_frame *f, struct pm_reader *r)
{
	char name[64];
	bool first = !h->nstreams && !h->frames;
	h->last = first || (uint64_t)f->step > h->last ? (uint64_t)f->step : h->last + 1;
	h->frames++;
	snprintf(name, sizeof name, "/data/%llu", (unsigned long long)h->last);
	hid_t g = pm_h5_group(h->file, name);
	int status = g < 0 ? -PM_DATA : 0;
	if (pm_world_size() > 1) { /* each rank takes and writes its part of the values */
		status = status ? status : pm_read_payload(r, f, true, NULL);
		r = NULL;
	}
	status = status ? status : put_header(h, g, f);
	status = status ? status : put_fields(g, f, r);
	status = status || !r ? status : pm_read_tail(r, f);
	status = status ? status : put_tail(h, g, f);
	H5Gclose(g);
	return status;
}

int pm_h5_put_end(struct pm_h5 *h)
{
	uint64_t *more = realloc(h->streams, (h->nstreams + 1) * sizeof *more);
	if (!more)
		return pm_no_memory();
	h->streams = more;
	h->streams[h->nstreams++] = h->frames;
	h->frames = 0;
	return 0;
}

static int put_root(hid_t at)
{
	return pm_h5_put_text(at, "openPMD", "1.1.0") || pm_h5_put_flag(at, "openPMDextension", 0) || pm_h5_put_text(at, "basePath", "/data/%T/") ||
			pm_h5_put_text(at, "meshesPath", "meshes/") || pm_h5_put_text(at, "particlesPath", "particles/") ||
			pm_h5_put_text(at, "iterationEncoding", "groupBased") || pm_h5_put_text(at, "iterationFormat", "/data/%T/") ||
			pm_h5_put_text(at, "software", "pmpipe") || pm_h5_put_text(at, "softwareVersion", PM_VERSION)
		? -PM_DATA
		: 0;
}

struct pm_h5 *pm_h5_create(const char *path)
{
	struct pm_h5 *h = calloc(1, sizeof *h);
	struct stat there;
	if (!h) {
		pm_no_memory();
		return NULL;
	}
	h->file = -1;
	bool odd = !stat(path, &there) && !S_ISREG(there.st_mode);
	if (odd || !(h->part = pm_replace_name(path, &h->path))) {
		if (odd)
			pm_fail(PM_DATA, "cannot write '%s': it is not a regular file", path);
		return pm_h5_free(h);
	}
	if (pm_h5_write_apart() < 0)
		return pm_h5_free(h);
	H5dont_atexit();
	H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
	hid_t how = H5Pcreate(H5P_FILE_CREATE), access = H5Pcreate(H5P_FILE_ACCESS);
	H5Pset_obj_track_times(how, false);
	H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
	h->file = H5Fcreate(h->part, H5F_ACC_TRUNC, how, access);
	H5Pclose(how), H5Pclose(access);
	hid_t data = h->file < 0 ? -1 : pm_h5_group(h->file, "data");
	if (h->file < 0)
		pm_h5_fail("cannot write '%s'", path);
	if (data < 0 || put_root(h->file))
		return pm_h5_free(h);
	H5Gclose(data);
	return h;
}

int pm_h5_finish(struct pm_h5 *h)
{
	int status = pm_h5_put_counts(h->file, "pmpipeStreams", (int)h->nstreams, h->streams);
	if (!status)
		status = pm_h5_put_checksum(h->file, NULL, pm_crc32c(h->crc, h->streams, h->nstreams * sizeof *h->streams));
	if (!status && (H5Fflush(h->file, H5F_SCOPE_GLOBAL) < 0 || H5Fclose(h->file) < 0))
		status = pm_h5_fail("cannot write '%s'", h->path);
	if (status)
		return status;
	h->file = -1;
	status = pm_world_size() > 1 ? pm_parts_lasting(h->part) : 0;
	if (status)
		return status;
	int fd = open(h->part, O_WRONLY | O_CLOEXEC); /* lasting, for it may be a checkpoint */
	if (fd < 0 || (fsync(fd) && errno != EINVAL))
		status = pm_fail_errno("cannot write '%s'", h->path);
	if (fd >= 0)
		close(fd);
	if (status || (status = pm_replace_rename(h->part, h->path, true)))
		return status;
	h->part = (free(h->part), NULL);
	return 0;
}

struct pm_h5 *pm_h5_free(struct pm_h5 *h)
{
	if (!h)
		return NULL;
	if (h->file >= 0)
		H5Fclose(h->file);
	if (h->part)
		unlink(h->part);
	free(h->path), free(h->part), free(h->streams), free(h->iterations), free(h);
	return NULL;
}
