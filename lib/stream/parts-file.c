/* A request says what, where and how it is divided; each rank opens the file by its name. A component is one piece of a file, of which a rank has its stretch;
 * checksums are joined component by component, then rank by rank. Cost: N/ranks values on each; messages: the request, and 4 bytes a component of each rank.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/past-cache.h"
#include "stream/parts-file.h"
#include "stream/run.h"
#include "stream/wire.h"
#include "world/world.h"

struct request {
	uint64_t id, components, before, type, offset, lasting; /* before: components of the part that come first and do not count */
	char path[PATH_MAX];
	uint64_t from[]; /* one more than ranks */
};

bool pm_parts_alone(const struct pm_field *field)
{
	return pm_world_size() > 1 && !field->here && !field->uniform && field->buffer && field->buffer->id && !field->buffer->data;
}

bool pm_parts_worth_reading(const struct pm_frame *f, const struct pm_field *field)
{
	return pm_world_size() > 1 && !field->uniform && field->count > pm_division_grain(f, field->on);
}

static size_t memory(const struct request *q) { return q->type == PM_U8 ? 1 : 8; }

static int whole(int fd, bool out, void *data, size_t bytes, uint64_t offset)
{
	for (char *p = data; bytes;) {
		const ssize_t k = out ? pwrite(fd, p, bytes, (off_t)offset) : pread(fd, p, bytes, (off_t)offset);
		if (k < 0 && errno == EINTR)
			continue;
		if (k <= 0)
			return !out && !k ? pm_fail(PM_DATA, "the input ends in the data: it was cut (run the whole pipeline again)") :
				pm_fail_errno(out ? "cannot write the output" : "cannot read");
		p += k, bytes -= (size_t)k, offset += (uint64_t)k;
	}
	return 0;
}

/* n values of a component, in memory at `values`, in the file from `offset` on. */
static int stretch(int fd, bool out, enum pm_type type, char *values, size_t n, uint64_t offset, uint32_t *crc)
{
	static char piece[PM_PIECE];
	const size_t size = pm_type_size(type);
	int status = 0;
	for (size_t done = 0; done < n && !status;) {
		const size_t k = n - done < PM_PIECE / size ? n - done : PM_PIECE / size;
		double *wide = (double *)(void *)values + (type == PM_F32 ? done : 0);
		char *wire = type == PM_F32 ? piece : values + done * size;
		for (size_t i = 0; i < k && type == PM_F32 && out; i++)
			((float *)(void *)piece)[i] = (float)wide[i];
		status = whole(fd, out, wire, k * size, offset + done * size);
		for (size_t i = 0; i < k && type == PM_F32 && !out; i++)
			wide[i] = ((const float *)(const void *)piece)[i];
		*crc = pm_crc32c(*crc, wire, k * size);
		done += k;
	}
	return status;
}

/* The same of a file that will be waited for, of numbers as they are in memory. */
static int lasting_stretch(struct pm_past_cache *past, int fd, const char *values, size_t bytes, uint64_t offset, uint32_t *crc)
{
	*crc = pm_crc32c(*crc, values, bytes);
	return pm_past_cache_write(past, fd, values, bytes, offset) ? pm_fail_errno("cannot write the output") : 0;
}

/* Every rank: its stretches. crc: of each component. */
static int stretches(const struct request *q, int fd, bool out, char *part, uint32_t *crc)
{
	const size_t me = (size_t)pm_world_rank(), ranks = (size_t)pm_world_size(), here = q->from[me + 1] - q->from[me];
	const size_t size = pm_type_size((enum pm_type)q->type);
	struct pm_past_cache past = {.fd = -1};
	const bool direct = out && q->lasting && size == memory(q) && here * size >= PM_PAST_CACHE_LEAST;
	int status = 0;
	if (direct)
		pm_past_cache_open(&past, fd);
	for (uint64_t c = 0; c < q->components && !status; c++) {
		pm_world_place(1, 0, (int)c, q->from[me]);
		char *values = part + (q->before + c) * here * memory(q);
		const uint64_t offset = q->offset + (c * q->from[ranks] + q->from[me]) * size;
		status = direct ? lasting_stretch(&past, fd, values, here * size, offset, &crc[c]) :
			stretch(fd, out, (enum pm_type)q->type, values, here, offset, &crc[c]);
	}
	pm_past_cache_close(&past);
	if (!status && out && q->lasting && !q->components && fsync(fd) && errno != EINVAL)
		status = pm_fail_errno("cannot write the output");
	return status;
}

/* Rank 0: of the field. all: of each rank, of each component. */
static uint32_t joined(const struct request *q, const uint32_t *all)
{
	uint32_t crc = 0;
	for (uint64_t c = 0; c < q->components; c++)
		for (int r = 0; r < pm_world_size(); r++)
			crc = pm_crc32c_join(crc, all[(uint64_t)r * q->components + c], (q->from[r + 1] - q->from[r]) * pm_type_size((enum pm_type)q->type));
	return crc;
}

/* Every rank, with its status. */
static int carry(int status, const struct request *q, bool out, char *part, uint32_t *crc)
{
	uint32_t own[PM_COMPONENTS] = {0};
	void *all = NULL;
	size_t bytes;
	const int fd = status ? -1 : open(q->path, (out ? O_WRONLY : O_RDONLY) | O_CLOEXEC);
	double missing = !status && fd < 0;
	status = pm_world_largest(status, 1, &missing);
	if (status || missing > 0) {
		if (fd >= 0)
			close(fd);
		return status ? status : PM_PARTS_ELSEWHERE;
	}
	status = stretches(q, fd, out, part, own);
	if (close(fd) && !status && out)
		status = pm_fail_errno("cannot write the output");
	status = pm_world_gather(status, own, q->components * sizeof *own, &all, &bytes);
	if (!status && all)
		*crc = joined(q, all);
	pm_free(all);
	return status;
}

static struct pm_buffer *buffer_for(const struct request *q)
{
	const size_t me = (size_t)pm_world_rank(), division = ((size_t)pm_world_size() + 1) * sizeof *q->from;
	struct pm_buffer *b = calloc(1, sizeof *b);
	void *part = pm_alloc((q->from[me + 1] - q->from[me]) * q->components + 1, memory(q));
	uint64_t *from = malloc(division);
	if (!b || !part || !from) {
		free(b), free(from), pm_free(part);
		pm_no_memory();
		return NULL;
	}
	memcpy(from, q->from, division);
	atomic_init(&b->users, 1);
	b->part = part, b->from = from, b->id = q->id, b->size = memory(q), b->components = (int)q->components;
	return b;
}

/* Rank 0 asks; free() it. */
static struct request *ask(enum pm_request what, int components, enum pm_type type, const struct pm_parts_place *place, uint64_t id, const uint64_t *from)
{
	const size_t division = ((size_t)pm_world_size() + 1) * sizeof *from, bytes = sizeof(struct request) + division;
	struct request *q = from ? calloc(1, bytes) : NULL;
	if (!q || strlen(place->path) >= sizeof q->path) {
		if (from)
			pm_no_memory();
		free(q);
		return NULL;
	}
	*q = (struct request){.id = id, .components = place->only ? 1 : (uint64_t)components, .before = place->only ? (uint64_t)place->only - 1 : 0,
		.type = type, .offset = place->offset, .lasting = place->lasting};
	strcpy(q->path, place->path);
	memcpy(q->from, from, division);
	if (!pm_request_send(what, q, bytes))
		return q;
	free(q);
	return NULL;
}

int pm_parts_read(const struct pm_frame *f, struct pm_field *field, const struct pm_parts_place *place, uint32_t *crc)
{
	uint64_t *from = pm_division_new(field->count, pm_division_grain(f, field->on));
	struct request *q = ask(PM_REQUEST_READ, field->components, field->type, place, pm_parts_number(), from);
	struct pm_buffer *b = q ? buffer_for(q) : NULL;
	int status = q ? carry(b ? 0 : pm_failed(), q, false, b ? b->part : NULL, crc) : pm_failed();
	if (!status) {
		pm_field_forget(field);
		field->buffer = b;
		field->finite = false;
	} else {
		pm_buffer_free(b);
	}
	free(q), free(from);
	return status;
}

int pm_parts_write(const struct pm_field *field, const struct pm_parts_place *place, uint32_t *crc)
{
	const struct pm_buffer *b = field->buffer;
	struct request *q = ask(PM_REQUEST_WRITE, field->components, field->type, place, b->id, b->from);
	const int status = q ? carry(0, q, true, b->part, crc) : pm_failed();
	free(q);
	return status;
}

int pm_parts_lasting(const char *path)
{
	uint64_t *from = calloc((size_t)pm_world_size() + 1, sizeof *from);
	struct request *q = ask(PM_REQUEST_WRITE, 0, PM_U8, &(struct pm_parts_place){.path = path, .lasting = true}, 0, from);
	uint32_t crc;
	const int status = q ? carry(0, q, true, NULL, &crc) : pm_failed();
	free(q), free(from);
	return status < 0 ? status : 0;
}

int pm_parts_file_follow(enum pm_request what, const void *more, size_t bytes)
{
	const struct request *q = more;
	const bool out = what == PM_REQUEST_WRITE;
	struct pm_buffer *b = out ? pm_parts_of(q->id, false) : buffer_for(q);
	(void)bytes;
	int status = b || (out && !q->components) ? 0 : out ? pm_fail(PM_DATA, "a part is missing") : pm_failed();
	uint32_t crc;
	status = carry(status, q, out, b ? b->part : NULL, &crc);
	if (!status && !out && pm_parts_keep(q->id, b))
		pm_cannot_go_on();
	pm_buffer_free(b);
	return status;
}
