/* The data of one component: a contiguous dataset in the types of the file, so that HDF5 converts nothing. Its place in the file is known once it is made, so
 * of values that are divided among ranks each writes its own bytes there, without HDF5. With the CRC-32C of its bytes as an attribute,
 * of values that are divided among ranks each writes its own bytes there, without HDF5. An attribute has the CRC-32C of its bytes,
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "h5/node.h"
#include "stream/parts-file.h"
#include "stream/run.h"

static const char checksum[] = "pmpipeCrc32c";

int pm_h5_put_checksum(hid_t at, const char *name, uint32_t crc) { return pm_h5_put_flag(at, name ? name : checksum, crc); }

int pm_h5_check(hid_t at, const char *name, uint32_t crc, const char *what)
{
	const char *unsealed = getenv("PM_UNSEALED");
	double there = 0;
	int n = 1;
	if (!pm_h5_has(at, name ? name : checksum) || (unsealed && !strcmp(unsealed, "1")))
		return 0; /* an older file, or that of another program */
	if (pm_h5_get_reals(at, name ? name : checksum, &n, &there))
		return -PM_DATA;
	return there == crc ? 0
		: pm_fail(PM_DATA, "the checksum of '%s' is wrong: the file is damaged (changed on purpose: PM_UNSEALED=1 in the environment)", what);
}

static char *component(struct pm_field *p, int c) { return (char *)pm_field_bytes(p) + (size_t)c * p->count * pm_field_memory(p); }

/* f32 is double in memory: narrowed into a copy that the caller frees. */
static float *narrowed(size_t n, const void *data)
{
	const double *x = data;
	float *out = pm_alloc(n, sizeof *out);
	for (size_t i = 0; out && i < n; i++)
		out[i] = (float)x[i];
	return out;
}

/* Values that no rank holds alone: each writes its own. 0, 1: it cannot be done so, or failure. */
static int put_parts(hid_t d, const struct pm_field *p, int c, uint32_t *crc)
{
	char path[4096];
	const haddr_t at = H5Dget_offset(d);
	const ssize_t length = H5Fget_name(d, path, sizeof path);
	if (!p->count || !pm_parts_alone(p) || at == HADDR_UNDEF || length < 0 || (size_t)length >= sizeof path)
		return 1;
	return pm_parts_write(p, &(struct pm_parts_place){.path = path, .offset = at, .only = c + 1}, crc);
}

/* All of them, by this rank. */
static int put_values(hid_t d, hid_t type, struct pm_field *p, int c, uint32_t *crc)
{
	float *narrow = p->type == PM_F32 && p->count ? narrowed(p->count, component(p, c)) : NULL;
	const void *data = narrow ? (void *)narrow : component(p, c);
	int status = narrow || p->type != PM_F32 || !p->count ? 0 : -PM_DATA;
	if (!status && p->count && H5Dwrite(d, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
		status = pm_h5_fail("cannot write '%s' of '%s'", p->name, p->on);
	if (!status)
		*crc = pm_crc32c(0, data, p->count * pm_type_size(p->type));
	pm_free(narrow);
	return status;
}

hid_t pm_h5_put_data(hid_t at, const char *name, struct pm_field *p, int c, int rank, const hsize_t *dims)
{
	hid_t type = pm_h5_type(p->type), how = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(rank, dims, NULL);
	H5Pset_obj_track_times(how, false);
	H5Pset_fill_time(how, H5D_FILL_TIME_NEVER);
	H5Pset_alloc_time(how, H5D_ALLOC_TIME_EARLY); /* it has its place at once, also alone, so that the bytes are the same */
	hid_t d = H5Dcreate2(at, name, type, space, H5P_DEFAULT, how, H5P_DEFAULT);
	uint32_t crc = 0;
	int status = d < 0 ? pm_h5_fail("cannot write '%s' of '%s'", p->name, p->on) : put_parts(d, p, c, &crc);
	status = status == 1 ? put_values(d, type, p, c, &crc) : status;
	if (status || pm_h5_put_checksum(d, NULL, crc)) {
		H5Dclose(d);
		d = -1;
	}
	H5Sclose(space);
	H5Pclose(how);
	return d;
}

/* Floats at the end of the room of as many doubles, widened from the first on. */
static void widen(size_t n, char *data)
{
	for (size_t i = 0; i < n; i++) {
		float v;
		memcpy(&v, data + 4 * (n + i), 4);
		const double wide = v;
		memcpy(data + 8 * i, &wide, 8);
	}
}

int pm_h5_get_data(hid_t d, const char *path, struct pm_field *p, int c)
{
	char *room = component(p, c), *data = p->type == PM_F32 ? room + 4 * p->count : room;
	if (p->count && H5Dread(d, pm_h5_type(p->type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
		return pm_h5_fail("cannot read '%s'", path);
	int status = pm_h5_check(d, NULL, pm_crc32c(0, data, p->count * pm_type_size(p->type)), path);
	if (p->type == PM_F32)
		widen(p->count, room);
	return status;
}
