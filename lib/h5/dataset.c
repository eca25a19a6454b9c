/* The data of one component: a contiguous dataset in the types of the file, so that HDF5 converts nothing, with the CRC-32C of its bytes as an attribute,
 * because HDF5 itself has checksums of compressed data only. PM_UNSEALED=1 in the environment: they are not compared. They go by pieces that stay in the
 * caches: memory that is touched for the first time costs more than reading or writing a file does. Values that are divided among ranks each rank writes to
 * their place in the file, which is known once the dataset is made, without HDF5.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "h5/node.h"
#include "stream/forward.h"
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

/* All of those, which are held here. */
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

/* The values from number `at` on, in the order of memory, that make whole planes, whole rows, or part of a row, at most so many: selected. How many. */
static hsize_t stretch(hid_t space, int rank, const hsize_t *dims, hsize_t most, hsize_t at)
{
	hsize_t from[3] = {0}, many[3] = {1, 1, 1}, inner = 1;
	int a = rank - 1;
	for (; a > 0 && inner * dims[a] <= most; a--)
		inner *= many[a] = dims[a];
	at /= inner;
	for (int b = a; b >= 0; b--)
		from[b] = at % dims[b], at /= dims[b];
	many[a] = most / inner < dims[a] - from[a] ? most / inner : dims[a] - from[a];
	return H5Sselect_hyperslab(space, H5S_SELECT_SET, from, NULL, many, NULL) < 0 ? 0 : many[a] * inner;
}

static int put_pieces(hid_t d, hid_t space, const struct pm_field *p, int rank, const hsize_t *dims, struct pm_reader *r, uint32_t *crc)
{
	const size_t size = pm_type_size(p->type);
	int status = 0;
	for (hsize_t at = 0, n = 0; at < p->count && !status; at += n) {
		const void *values;
		n = stretch(space, rank, dims, PM_PIECE / size, at);
		status = n ? pm_read_values(r, n * size, &values) : -PM_DATA;
		hid_t here = H5Screate_simple(1, &n, NULL);
		if (!n || (!status && H5Dwrite(d, pm_h5_type(p->type), here, space, H5P_DEFAULT, values) < 0))
			status = pm_h5_fail("cannot write '%s' of '%s'", p->name, p->on);
		H5Sclose(here);
	}
	*crc = p->count ? pm_reader_sum(r) : 0;
	return status;
}

hid_t pm_h5_put_data(hid_t at, const char *name, struct pm_field *p, int c, int rank, const hsize_t *dims, struct pm_reader *r)
{
	hid_t how = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(rank, dims, NULL);
	H5Pset_obj_track_times(how, false);
	H5Pset_fill_time(how, H5D_FILL_TIME_NEVER);
	H5Pset_alloc_time(how, H5D_ALLOC_TIME_EARLY); /* it has its place at once, also alone, so that the bytes are the same */
	hid_t d = H5Dcreate2(at, name, pm_h5_type(p->type), space, H5P_DEFAULT, how, H5P_DEFAULT);
	uint32_t crc = 0;
	int status = d < 0 ? pm_h5_fail("cannot write '%s' of '%s'", p->name, p->on) : 0;
	if (!status)
		status = r ? put_pieces(d, space, p, rank, dims, r, &crc) : put_parts(d, p, c, &crc);
	status = status == 1 ? put_values(d, pm_h5_type(p->type), p, c, &crc) : status;
	status = status ? status : pm_h5_put_checksum(d, NULL, crc);
	H5Sclose(space);
	H5Pclose(how);
	if (!status)
		return d;
	H5Dclose(d);
	return -1;
}

static int check(hid_t d, const char *path, uint32_t crc, uint32_t *out)
{
	*out = crc;
	return pm_h5_check(d, NULL, crc, path);
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

static int get(hid_t d, const char *path, hid_t type, hid_t here, hid_t space, void *to)
{
	return H5Dread(d, type, here, space, H5P_DEFAULT, to) < 0 ? pm_h5_fail("cannot read '%s'", path) : 0;
}

int pm_h5_get_data(hid_t d, const char *path, struct pm_field *p, int c, uint32_t *crc)
{
	char *room = component(p, c), *data = p->type == PM_F32 ? room + 4 * p->count : room;
	int status = get(d, path, pm_h5_type(p->type), H5S_ALL, H5S_ALL, data);
	status = status ? status : check(d, path, pm_crc32c(0, data, p->count * pm_type_size(p->type)), crc);
	if (p->type == PM_F32)
		widen(p->count, room);
	return status;
}

/* Chunks, which other programs have made of our datasets, are read once for all pieces of them. */
static int send_whole(hid_t d, const char *path, const struct pm_field *p, struct pm_writer *w, uint32_t *crc)
{
	const size_t size = pm_type_size(p->type), bytes = p->count * size;
	char *data = pm_alloc(p->count, size);
	int status = data ? get(d, path, pm_h5_type(p->type), H5S_ALL, H5S_ALL, data) : -PM_DATA;
	status = status ? status : check(d, path, pm_crc32c(0, data, bytes), crc);
	for (size_t at = 0; at < bytes && !status; at += PM_PIECE)
		status = pm_forward(w, data + at, bytes - at < PM_PIECE ? bytes - at : PM_PIECE);
	pm_free(data);
	return status;
}

static int send_pieces(hid_t d, const char *path, const struct pm_field *p, struct pm_writer *w, uint32_t *crc)
{
	const size_t size = pm_type_size(p->type);
	hid_t space = H5Dget_space(d);
	hsize_t dims[H5S_MAX_RANK];
	const int rank = H5Sget_simple_extent_dims(space, dims, NULL);
	uint32_t sum = 0;
	int status = 0;
	for (hsize_t at = 0, n = 0; at < p->count && !status; at += n) {
		void *room = pm_forward_room(w);
		n = room ? stretch(space, rank, dims, PM_PIECE / size, at) : 0;
		hid_t here = H5Screate_simple(1, &n, NULL);
		status = n ? get(d, path, pm_h5_type(p->type), here, space, room) : room ? pm_h5_fail("cannot read '%s'", path) : pm_failed();
		H5Sclose(here);
		if (!status)
			sum = pm_crc32c(sum, room, n * size);
		status = status ? status : pm_forward(w, room, n * size);
	}
	H5Sclose(space);
	return status ? status : check(d, path, sum, crc);
}

int pm_h5_send_data(hid_t d, const char *path, const struct pm_field *p, struct pm_writer *w, uint32_t *crc)
{
	hid_t how = H5Dget_create_plist(d);
	const bool pieces = H5Pget_layout(how) == H5D_CONTIGUOUS;
	H5Pclose(how);
	return (pieces ? send_pieces : send_whole)(d, path, p, w, crc);
}
