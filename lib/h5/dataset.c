/* The data of one component: a contiguous dataset in the types of the file, so that HDF5 converts nothing, with the CRC-32C of its bytes as an attribute,
 * because HDF5 itself has checksums of compressed data only. PM_UNSEALED=1 in the environment: they are not compared.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "h5/node.h"
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

hid_t pm_h5_put_data(hid_t at, const char *name, struct pm_field *p, int c, int rank, const hsize_t *dims)
{
	hid_t type = pm_h5_type(p->type), how = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(rank, dims, NULL);
	H5Pset_obj_track_times(how, false);
	H5Pset_fill_time(how, H5D_FILL_TIME_NEVER);
	hid_t d = H5Dcreate2(at, name, type, space, H5P_DEFAULT, how, H5P_DEFAULT);
	float *narrow = p->type == PM_F32 && p->count ? narrowed(p->count, component(p, c)) : NULL;
	const void *data = narrow ? (void *)narrow : component(p, c);
	bool room = narrow || p->type != PM_F32 || !p->count;
	if (room && (d < 0 || (p->count && H5Dwrite(d, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)))
		pm_h5_fail("cannot write '%s' of '%s'", p->name, p->on), room = false;
	if (!room || pm_h5_put_checksum(d, NULL, pm_crc32c(0, data, p->count * pm_type_size(p->type)))) {
		H5Dclose(d);
		d = -1;
	}
	pm_free(narrow);
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
