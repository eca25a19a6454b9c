/* Frames out of an openPMD file that sh5 wrote: the header defines what must be there, and the datasets are checked against it before memory is allocated.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "h5/apart.h"
#include "h5/gadget.h"
#include "stream/forward.h"
#include "stream/hand-over.h"
#include "stream/header.h"
#include "stream/limits.h"
#include "stream/parts.h"
#include "stream/run.h"

/* ---- the file ---- */

static herr_t iteration_add(hid_t at, const char *name, const H5L_info_t *info, void *p)
{
	struct pm_h5 *h = p;
	char *end;
	(void)at, (void)info;
	errno = 0;
	uint64_t number = strtoull(name, &end, 10);
	uint64_t *more = realloc(h->iterations, (h->niterations + 1) * sizeof *more);
	if (!more)
		pm_no_memory();
	if (!more || *end || errno || *name == '-')
		return -1;
	h->iterations = more;
	h->iterations[h->niterations++] = number;
	return 0;
}

static int ascending(const void *a, const void *b)
{
	uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
	return (x > y) - (x < y);
}

static int check_standard(hid_t file)
{
	if (!pm_h5_has(file, "openPMD"))
		return pm_fail(PM_DATA,
			"this is HDF5, but neither openPMD (no attribute 'openPMD') nor a GADGET snapshot (no group Header; h5ls shows what it holds)");
	char *version = pm_h5_get_text(file, "openPMD"), *base = version ? pm_h5_get_text(file, "basePath") : NULL;
	int status = base ? 0 : -PM_DATA;
	if (base && strncmp(version, "1.", 2))
		status = pm_fail(PM_DATA, "openPMD %.20s is not supported (1.0 and 1.1 are)", version);
	else if (base && strcmp(base, "/data/%T/"))
		status = pm_fail(PM_DATA, "the basePath is '%.60s', but openPMD 1.1 has /data/%%T/", base);
	free(version), free(base);
	return status;
}

/* The number of frames of each stream; one stream if the file does not say. */
static int read_streams(struct pm_h5 *h)
{
	double x[8192];
	uint64_t sum = 0;
	int n = 8192, status = 0;
	if (!pm_h5_has(h->file, "pmpipeStreams"))
		n = 1, x[0] = (double)h->niterations;
	else
		status = pm_h5_get_reals(h->file, "pmpipeStreams", &n, x);
	if (status || !(h->streams = calloc((size_t)n, sizeof *h->streams)))
		return status ? status : pm_no_memory();
	h->nstreams = (size_t)n;
	for (int i = 0; i < n; i++)
		sum += h->streams[i] = x[i] >= 0 && x[i] < 0x1p53 ? (uint64_t)x[i] : 0;
	return sum == h->niterations ? 0
		: pm_fail(PM_DATA, "the attribute 'pmpipeStreams' counts %llu iterations, but there are %llu",
			(unsigned long long)sum, (unsigned long long)h->niterations);
}

static int open_snapshot(struct pm_h5 *h)
{
	h->gadget = true;
	if (!(h->iterations = calloc(1, sizeof *h->iterations)))
		return pm_no_memory();
	h->niterations = 1;
	return read_streams(h);
}

static int open_all(struct pm_h5 *h, const char *path)
{
	hsize_t at = 0;
	if (access(path, R_OK))
		return pm_fail_errno("cannot open '%s'", path);
	if (H5Fis_hdf5(path) <= 0)
		return pm_fail(PM_DATA, "'%s' is not HDF5 (stab reads text)", path);
	if ((h->file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT)) < 0)
		return pm_h5_fail("cannot open '%s'", path);
	if (!(h->path = strdup(path)))
		return pm_no_memory();
	if (!pm_h5_has(h->file, "openPMD") && pm_gadget_is(h->file))
		return open_snapshot(h);
	if (check_standard(h->file))
		return -PM_DATA;
	if (H5Lexists(h->file, "data", H5P_DEFAULT) <= 0)
		return pm_fail(PM_DATA, "there is no group 'data'");
	hid_t data = H5Gopen2(h->file, "data", H5P_DEFAULT);
	herr_t bad = H5Literate(data, H5_INDEX_NAME, H5_ITER_INC, &at, iteration_add, h);
	H5Gclose(data);
	if (bad < 0)
		return pm_fail(PM_DATA, "the group 'data' has a member whose name is not a number");
	if (h->niterations)
		qsort(h->iterations, h->niterations, sizeof *h->iterations, ascending);
	return read_streams(h);
}

struct pm_h5 *pm_h5_open(const char *path, const char *word)
{
	struct pm_h5 *h = calloc(1, sizeof *h);
	if (!h) {
		pm_no_memory();
		return NULL;
	}
	H5dont_atexit();
	H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
	h->file = -1;
	h->word = word;
	return open_all(h, path) ? pm_h5_free(h) : h;
}

/* ---- a frame ---- */

static json_t *get_json(struct pm_h5 *h, hid_t at, const char *name)
{
	json_error_t why;
	char *text = pm_h5_get_text(at, name), checksum[64];
	snprintf(checksum, sizeof checksum, "%sCrc32c", name);
	h->crc = text ? pm_crc32c(h->crc, text, strlen(text)) : 0;
	if (text && pm_h5_check(at, checksum, pm_crc32c(0, text, strlen(text)), name))
		return free(text), NULL;
	json_t *j = text ? json_loads(text, JSON_REJECT_DUPLICATES, &why) : NULL;
	if (text && !j)
		pm_fail(PM_DATA, "the attribute '%s' is not JSON: %s", name, why.text);
	free(text);
	return j;
}

static int differs(const char *path) { return pm_fail(PM_DATA, "'%s' does not agree with the header of the frame (pmpipeHeader; the file was changed)", path); }

static int get_constant(hid_t at, const char *path, double value)
{
	double there;
	int n = 1;
	hid_t o = H5Oopen(at, path, H5P_DEFAULT);
	int status = o < 0 || pm_h5_get_reals(o, "value", &n, &there) || memcmp(&there, &value, sizeof value) ? differs(path) : 0;
	H5Oclose(o);
	return status;
}

/* Has the dataset the type and shape of the field? */
static bool fits(hid_t d, const struct pm_frame *f, const struct pm_field *p)
{
	const struct pm_mesh *m = pm_frame_mesh(f, p->on);
	hid_t space = H5Dget_space(d), type = H5Dget_type(d);
	hsize_t dims[H5S_MAX_RANK];
	size_t points[3] = {p->count, 1, 1};
	int rank = m ? f->dim : 1;
	bool good = H5Sget_simple_extent_ndims(space) == rank && H5Tequal(type, pm_h5_type(p->type)) > 0;
	if (m)
		pm_mesh_points(f, m, points);
	if (good)
		H5Sget_simple_extent_dims(space, dims, NULL);
	for (int a = 0; good && a < rank; a++)
		good = dims[rank - 1 - a] == points[a];
	H5Sclose(space), H5Tclose(type);
	return good;
}

/* Allocates no memory for a dataset that was declared but never written. */
static bool stored(hid_t d, const struct pm_field *p)
{
	hid_t how = H5Dget_create_plist(d);
	bool plain = H5Pget_layout(how) != H5D_CHUNKED;
	H5Pclose(how);
	return !plain || H5Dget_storage_size(d) == p->count * pm_type_size(p->type);
}

static int check_component(hid_t at, const char *path, const struct pm_frame *f, const struct pm_field *p)
{
	hid_t d = H5Lexists(at, path, H5P_DEFAULT) > 0 ? H5Dopen2(at, path, H5P_DEFAULT) : -1;
	if (d < 0)
		return differs(path);
	int status = fits(d, f, p) && stored(d, p) ? 0 : differs(path);
	H5Dclose(d);
	return status;
}

static void component_path(const struct pm_field *p, int c, const char *path, char full[PM_H5_PATH + 16])
{
	char name[8];
	pm_h5_component(p, c, name);
	snprintf(full, PM_H5_PATH + 16, pm_h5_is_vector(p) ? "%s/%s" : "%s", path, name);
}

static int check_field(hid_t at, const char *path, const struct pm_frame *f, const struct pm_field *p)
{
	char full[PM_H5_PATH + 16];
	int status = 0;
	if (H5Lexists(at, path, H5P_DEFAULT) <= 0)
		return differs(path);
	for (int c = 0; c < p->components && !status; c++) {
		component_path(p, c, path, full);
		if (p->uniform)
			status = H5Lexists(at, full, H5P_DEFAULT) > 0 ? get_constant(at, full, p->value[c]) : differs(full);
		else
			status = check_component(at, full, f, p);
	}
	return status;
}

/* Handed over, where the next word takes it so; else piece by piece. */
static int send_field(hid_t at, const char *path, struct pm_field *p, struct pm_writer *w)
{
	const size_t bytes = pm_field_wire(p);
	const bool held = bytes >= PM_HAND_LEAST && pm_writer_hands(w);
	char full[PM_H5_PATH + 16];
	uint32_t sum, all = 0;
	int status = held ? pm_field_hold(p) : bytes ? pm_forward_begin(w, bytes) : 0;
	for (int c = 0; c < p->components && bytes && !status; c++) {
		component_path(p, c, path, full);
		pm_h5_goes_on(bytes);
		hid_t d = H5Dopen2(at, full, H5P_DEFAULT);
		status = d < 0 ? differs(full) : held ? pm_h5_get_data(d, full, p, c, &sum) : pm_h5_send_data(d, full, p, w, &sum);
		H5Dclose(d);
		all = pm_crc32c_join(all, sum, bytes / (size_t)p->components);
	}
	if (status || !held)
		return status ? status : pm_forward_done(w, p, all);
	p->summed = true, p->crc = all;
	status = pm_forward_held(w, p);
	pm_field_forget(p);
	return status;
}

/* HDF5 reports an error for "a/b" if there is no "a". */
static bool folder_is_there(hid_t at, const char *path)
{
	char folder[PM_H5_PATH];
	for (const char *slash = strchr(path, '/'); slash; slash = strchr(slash + 1, '/')) {
		snprintf(folder, sizeof folder, "%.*s", (int)(slash - path), path);
		if (H5Lexists(at, folder, H5P_DEFAULT) <= 0)
			return false;
	}
	return true;
}

/* free() it; NULL with a message. */
static char (*paths_of(const struct pm_frame *f))[PM_H5_PATH]
{
	char(*path)[PM_H5_PATH] = calloc(f->nfields + 1, sizeof *path);
	if (path)
		pm_h5_paths(f, path);
	else
		pm_no_memory();
	return path;
}

static int get_own(struct pm_h5 *h, hid_t at, struct pm_frame **out)
{
	json_t *header = get_json(h, at, "pmpipeHeader"), *report = header ? get_json(h, at, "pmpipeReport") : NULL;
	struct pm_frame *f = NULL;
	int status = report && !pm_header_frame(header, &f) ? 0 : -PM_DATA;
	json_decref(header);
	if (!status && json_is_object(report)) {
		json_decref(f->report);
		f->report = json_incref(report);
	}
	json_decref(report);
	if (!status && pm_h5_has(at, "pmpipeLimits")) {
		json_t *limits = get_json(h, at, "pmpipeLimits");
		status = limits ? pm_limits_take_all(limits, f) : -PM_DATA;
		json_decref(limits);
	}
	char(*path)[PM_H5_PATH] = status ? NULL : paths_of(f);
	for (size_t i = 0; path && i < f->nfields && !status; i++)
		status = folder_is_there(at, path[i]) ? check_field(at, path[i], f, f->fields[i]) : differs(path[i]);
	status = status || path ? status : -PM_DATA;
	free(path);
	*out = status ? pm_frame_free(f) : f;
	return status;
}

/* The failure with the name of the iteration in front. */
static int in_iteration(const struct pm_h5 *h, int status)
{
	char why[512];
	if (!status)
		return 0;
	snprintf(why, sizeof why, "%s", pm_message());
	return pm_fail(-status, "iteration %llu: %s", (unsigned long long)h->iterations[h->at - 1], why);
}

static hid_t iteration_open(const struct pm_h5 *h)
{
	char name[32];
	snprintf(name, sizeof name, "/data/%llu", (unsigned long long)h->iterations[h->at - 1]);
	hid_t at = H5Gopen2(h->file, name, H5P_DEFAULT);
	if (at < 0)
		pm_h5_fail("cannot open '%s'", name);
	return at;
}

int pm_h5_send(struct pm_h5 *h, struct pm_frame *f, struct pm_writer *w)
{
	int status = pm_write_header(w, f);
	char(*path)[PM_H5_PATH] = status ? NULL : paths_of(f);
	hid_t at = path ? iteration_open(h) : -1;
	pm_buffers_share(true);
	for (size_t i = 0; at >= 0 && i < f->nfields && !status; i++)
		status = in_iteration(h, send_field(at, path[i], f->fields[i], w));
	pm_buffers_share(false);
	status = status || at >= 0 ? status : -PM_DATA;
	free(path);
	H5Gclose(at);
	return status ? status : pm_write_payload(w, f);
}

int pm_h5_get(struct pm_h5 *h, struct pm_frame **f, bool *foreign)
{
	if (h->stream == h->nstreams) {
		const uint32_t crc = pm_crc32c(h->crc, h->streams, h->nstreams * sizeof *h->streams);
		int bad = h->own ? pm_h5_check(h->file, NULL, crc, "the sequence of the frames") : 0;
		return bad ? bad : PM_GOT_EOF;
	}
	if (h->frames == h->streams[h->stream]) {
		h->stream++;
		h->frames = 0;
		return PM_GOT_END;
	}
	h->at++, h->frames++;
	pm_h5_goes_on(0);
	*foreign = true;
	if (h->gadget)
		return pm_gadget_frame(h, f) ? -PM_DATA : PM_GOT_FRAME;
	hid_t at = iteration_open(h);
	if (at < 0)
		return -PM_DATA;
	char name[32];
	snprintf(name, sizeof name, "%llu", (unsigned long long)h->iterations[h->at - 1]);
	*foreign = !pm_h5_has(at, "pmpipeHeader");
	h->own |= !*foreign;
	int status = !*foreign ? get_own(h, at, f) : !pm_h5_has(h->file, "pmpipeStreams") ? pm_h5_get_foreign(at, name, f)
		: pm_fail(PM_DATA, "no attribute 'pmpipeHeader', but the file is one of sh5's: it is damaged");
	H5Gclose(at);
	return status ? in_iteration(h, status) : PM_GOT_FRAME;
}
