/* Writes the stream. It always knows how many announced bytes are still missing, so that an abort can be written at any time.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/past-cache.h"
#include "base/replace.h"
#include "stream/forward.h"
#include "stream/hand-over.h"
#include "stream/header.h"
#include "stream/limits.h"
#include "stream/line.h"
#include "stream/run.h"
#include "stream/parts-file.h"
#include "stream/parts.h"
#include "world/launch.h"
#include "world/world.h"

struct pm_writer {
	int fd;
	bool dirty, whole;     /* whole: what was written last is an end marker */
	bool lasting, shared;  /* shared: other ranks have written to the file */
	char *path;            /* of a regular file that has its name already; NULL: none */
	struct pm_replace file;
	uint64_t frames, left; /* of this stream; bytes of the frame's payload announced but not yet written */
	size_t next, ncrc;     /* current field; room in crc */
	uint32_t *crc;
	struct pm_hands *hands; /* to the reader of this pipe; NULL: it has none, or has not been looked for */
	bool shares;           /* the current frame is handed over */
	void *room;            /* PM_PIECE bytes; NULL: not needed yet (256 KB of each thread's own memory cost 0.2 ms at the start of a program) */
	struct pm_ring *ring;  /* data go there; NULL: onto the descriptor */
};

struct pm_writer *pm_writer_of_fd(int fd)
{
	struct pm_writer *w = calloc(1, sizeof *w);
	if (!w) {
		pm_no_memory();
		return NULL;
	}
	w->fd = fd;
	w->file.fd = -1;
	fcntl(fd, F_SETPIPE_SZ, 1 << 20);
	return w;
}

static struct pm_writer *writer_of_file(const char *path, bool lasting)
{
	struct pm_replace file;
	if (pm_replace_open(&file, path, lasting))
		return NULL;
	struct pm_writer *w = pm_writer_of_fd(file.fd);
	if (!w) {
		close(file.fd);
		pm_replace_drop(&file);
		return NULL;
	}
	struct stat st;
	w->file = file;
	w->lasting = lasting;
	w->path = !file.path && !fstat(file.fd, &st) && S_ISREG(st.st_mode) ? strdup(path) : NULL; /* NULL: rank 0 writes */
	return w;
}

struct pm_writer *pm_writer_open(const char *path)
{
	if (path && !strcmp(path, "-"))
		path = NULL;
	if (!path && pm_output_is_terminal()) {
		pm_fail(PM_USAGE, "standard output is a terminal, but a stream is not text (add | sls, | stab, or > FILE)");
		return NULL;
	}
	if (!path)
		return pm_writer_of_fd(STDOUT_FILENO);
	return writer_of_file(path, false);
}

struct pm_writer *pm_writer_lasting(const char *path) { return writer_of_file(path, true); }

int pm_writer_file(const struct pm_writer *w) { return w->fd; }

bool pm_writer_to_file(const struct pm_writer *w) { return w->file.fd >= 0 && (w->file.path || w->path); }

int pm_writer_close(struct pm_writer *w)
{
	if (!w)
		return 0;
	int status = w->whole && w->shared ? pm_parts_lasting(w->file.path ? w->file.temporary : w->path) : 0;
	status = status ? status : w->whole ? pm_replace_commit(&w->file, w->lasting) : 0; /* a stream that was cut replaces nothing */
	pm_replace_drop(&w->file);
	if (close(w->fd) && !status)
		status = pm_fail_errno("cannot close the output");
	free(w->crc), free(w->path), free(w->room);
	pm_hands_close(w->hands);
	free(w);
	return status;
}

void pm_writer_forked(struct pm_writer *w, struct pm_ring *ring)
{
	w->hands = pm_hands_close(w->hands);
	w->ring = ring;
}

bool pm_writer_dirty(const struct pm_writer *w) { return w->dirty; }

static int put(struct pm_writer *w, const void *data, size_t n)
{
	const char *p = data;
	w->dirty = w->dirty || n;
	w->whole = false;
	while (n) {
		ssize_t k = write(w->fd, p, n);
		if (k < 0 && errno == EINTR)
			continue;
		if (k < 0)
			return pm_fail_errno("cannot write the output");
		p += k, n -= (size_t)k;
	}
	return 0;
}

/* Writes a line and the text it announces at once: the text padded with spaces to a multiple of 64, a newline last. */
static int put_text(struct pm_writer *w, const char *format, unsigned long long a, bool size_first, const char *text)
{
	size_t n = strlen(text), bytes = pm_line_padded(n + 1);
	char words[PM_LINE], *all = malloc(PM_LINE + bytes);
	if (!all)
		return pm_no_memory();
	memcpy(all + PM_LINE, text, n);
	memset(all + PM_LINE + n, ' ', bytes - n);
	all[PM_LINE + bytes - 1] = '\n';
	snprintf(words, sizeof words, format, size_first ? bytes : a, size_first ? a : bytes);
	pm_line_seal(all, words, all + PM_LINE, bytes);
	int status = put(w, all, PM_LINE + bytes);
	free(all);
	return status;
}

bool pm_writer_hands(struct pm_writer *w)
{
	if (!w->hands && !w->ring && pm_world_size() == 1)
		w->hands = pm_hands_connect(w->fd);
	return w->hands;
}

int pm_write_header(struct pm_writer *w, const struct pm_frame *f)
{
	json_t *j = pm_header_json(f);
	if (!j)
		return pm_failed();
	char *text = pm_json_line(j);
	json_decref(j);
	if (!text)
		return pm_fail(PM_DATA, "the header cannot be written as JSON (a name that is not UTF-8?)");
	uint64_t payload = 0;
	for (size_t i = 0; i < f->nfields; i++)
		payload += pm_line_padded(pm_field_wire(f->fields[i]));
	int status = 0;
	if (w->ncrc < f->nfields) {
		free(w->crc);
		w->crc = malloc(f->nfields * sizeof *w->crc);
		w->ncrc = w->crc ? f->nfields : 0;
		status = w->crc ? 0 : pm_no_memory();
	}
	w->shares = payload >= PM_HAND_LEAST && pm_writer_hands(w);
	if (w->shares && !pm_hands_wait(w->hands)) { /* another program may read on */
		w->hands = pm_hands_close(w->hands);
		w->shares = pm_writer_hands(w);
	}
	if (!status)
		status = put_text(w, w->shares ? "PMPIPE/1 shared %llu %llu" : "PMPIPE/1 frame %llu %llu", payload, true, text);
	free(text);
	w->left = w->shares ? 0 : payload; /* there an abort may stand before any field */
	w->next = 0;
	return status;
}

static int put_line(struct pm_writer *w, const char *words)
{
	char text[PM_LINE];
	pm_line_seal(text, words, NULL, 0);
	return put(w, text, PM_LINE);
}

int pm_forward_begin(struct pm_writer *w, size_t bytes)
{
	char words[PM_LINE];
	if (!w->shares)
		return 0;
	snprintf(words, sizeof words, "PMPIPE/1 copied %llu", (unsigned long long)pm_line_padded(bytes));
	const int status = put_line(w, words);
	w->left = status ? 0 : pm_line_padded(bytes);
	return status;
}

void *pm_forward_room(struct pm_writer *w)
{
	if (w->ring)
		return pm_ring_room(w->ring);
	if (!w->room && !(w->room = malloc(PM_PIECE)))
		pm_no_memory();
	return w->room;
}

int pm_forward(struct pm_writer *w, const void *piece, size_t n)
{
	int status = !n ? 0 : w->ring ? pm_ring_give(w->ring, piece, n) : put(w, piece, n);
	w->left -= status ? 0 : n;
	return status;
}

int pm_forward_done(struct pm_writer *w, const struct pm_field *field, uint32_t crc)
{
	static const char zero[PM_LINE];
	size_t bytes = pm_field_wire(field);
	w->crc[w->next++] = crc;
	return pm_forward(w, zero, pm_line_padded(bytes) - bytes);
}

/* By all ranks, each its part, where the output is a file with a name. 1: done; 0: it is to be written here. */
static int put_parts(struct pm_writer *w, const struct pm_field *p, uint32_t *crc)
{
	const size_t bytes = pm_field_wire(p);
	const off_t at = w->file.fd >= 0 && pm_parts_alone(p) ? lseek(w->fd, 0, SEEK_CUR) : -1;
	if (at < 0 || (w->file.path && !w->file.temporary && pm_replace_named(&w->file)))
		return 0;
	const char *path = w->file.path ? w->file.temporary : w->path;
	const int status = path ? pm_parts_write(p, &(struct pm_parts_place){.path = path, .offset = (uint64_t)at, .lasting = w->lasting}, crc) : 1;
	if (status)
		return status < 0 ? status : 0;
	w->shared = w->lasting;
	w->left -= bytes;
	return lseek(w->fd, (off_t)bytes, SEEK_CUR) < 0 ? pm_fail_errno("cannot write the output") : 1;
}

/* Hands over the block that the values are in, or have been copied to. 1: done; 0: no block can be had; or failure. */
static int give(struct pm_writer *w, struct pm_field *p)
{
	const float *floats = pm_field_floats(p);
	const size_t bytes = p->count * (size_t)p->components * (floats ? sizeof *floats : pm_field_memory(p));
	struct pm_shared *b = p->buffer ? p->buffer->shared : NULL, *made = b || bytes < PM_HAND_LEAST ? NULL : pm_shared_new(bytes);
	struct pm_given g = {.crc = p->crc, .summed = p->summed, .finite = p->finite, .floats = floats};
	char words[PM_LINE];
	if (!b && !made)
		return 0;
	if (made)
		memcpy(made->data, floats ? (const void *)floats : pm_in_u8(p, 0), bytes);
	b = b ? b : made;
	g.id = b->id;
	int status = pm_hands_give(w->hands, b, &g.comes);
	if (made)
		pm_shared_drop(made);
	snprintf(words, sizeof words, "PMPIPE/1 given %llu %llu", (unsigned long long)g.id, (unsigned long long)pm_given_bits(&g));
	status = status ? status : put_line(w, words);
	w->crc[w->next++] = g.summed ? g.crc : 0;
	return status ? status : 1;
}

/* Past the cache, where the file will be waited for. 1: done; 0: it is to be written by put(); or failure. */
static int put_lasting(struct pm_writer *w, struct pm_field *p, uint32_t *crc)
{
	const size_t bytes = pm_field_wire(p);
	const float *floats = pm_field_floats(p);
	const off_t at = w->lasting && (p->type != PM_F32 || floats) && p->buffer && bytes >= PM_PAST_CACHE_LEAST ? lseek(w->fd, 0, SEEK_CUR) : -1;
	if (at < 0)
		return 0;
	const void *data = floats ? (const void *)floats : pm_in_u8(p, 0);
	struct pm_past_cache past;
	*crc = p->summed ? p->crc : pm_crc32c(0, data, bytes);
	pm_past_cache_open(&past, w->fd);
	const int status = pm_past_cache_write(&past, w->fd, data, bytes, (uint64_t)at);
	pm_past_cache_close(&past);
	if (status || lseek(w->fd, at + (off_t)bytes, SEEK_SET) < 0)
		return pm_fail_errno("cannot write the output");
	w->left -= bytes;
	return 1;
}

static int put_field(struct pm_writer *w, struct pm_field *p)
{
	size_t bytes = pm_field_wire(p);
	uint32_t crc = 0;
	int status = w->shares && bytes ? give(w, p) : 0;
	if (status)
		return status < 0 ? status : 0;
	if ((status = put_parts(w, p, &crc)) || (status = put_lasting(w, p, &crc)))
		return status < 0 ? status : pm_forward_done(w, p, crc);
	status = bytes ? pm_forward_begin(w, bytes) : 0;
	const float *floats = pm_field_floats(p);
	const char *data = floats ? (const char *)floats : p->buffer ? (const char *)pm_in_u8(p, 0) : NULL; /* of any type; the parts stay valid */
	for (size_t done = 0; done < bytes && !status;) {
		size_t n = bytes - done < PM_PIECE ? bytes - done : PM_PIECE;
		const void *piece = data + done;
		if (p->type == PM_F32 && !floats) {
			const double *y = (const double *)(const void *)data + done / 4;
			float *narrow = pm_forward_room(w);
			if (!narrow)
				return pm_failed();
			for (size_t i = 0; i < n / 4; i++)
				narrow[i] = (float)y[i];
			piece = narrow;
		}
		crc = p->summed ? p->crc : pm_crc32c(crc, piece, n);
		status = pm_forward(w, piece, n);
		done += n;
	}
	return status ? status : pm_forward_done(w, p, crc);
}

static int put_tail(struct pm_writer *w, const struct pm_frame *f)
{
	json_t *crcs = json_array();
	for (size_t i = 0; i < f->nfields; i++)
		json_array_append_new(crcs, json_integer(w->crc[i]));
	json_t *tail = json_pack("{s:o,s:O}", "crc32c", crcs, "report", f->report), *limits = pm_limits_json(f);
	if (limits)
		json_object_set_new(tail, "limits", limits);
	char *text = pm_json_line(tail);
	json_decref(tail);
	int status = text ? put_text(w, "PMPIPE/1 tail %llu", 0, true, text) : pm_fail(PM_DATA, "the tail cannot be written as JSON");
	free(text);
	w->frames++;
	return status;
}

int pm_write_payload(struct pm_writer *w, struct pm_frame *f)
{
	int status = 0;
	while (w->next < f->nfields && !status)
		status = put_field(w, f->fields[w->next]);
	return status ? status : put_tail(w, f);
}

int pm_forward_held(struct pm_writer *w, struct pm_field *field) { return put_field(w, field); }

int pm_write_last(struct pm_writer *w, struct pm_frame *f)
{
	int status = 0;
	while (w->next < f->nfields && !status)
		status = put_field(w, f->fields[w->next]);
	for (size_t i = 0; i < f->nfields && w->shares; i++) /* before the tail: then the next word goes on, and has them alone */
		pm_field_forget(f->fields[i]);
	return status ? status : put_tail(w, f);
}

int pm_write_frame(struct pm_writer *w, struct pm_frame *f)
{
	int status = pm_write_header(w, f);
	return status ? status : pm_write_payload(w, f);
}

int pm_write_end(struct pm_writer *w)
{
	char words[PM_LINE], text[PM_LINE];
	snprintf(words, sizeof words, "PMPIPE/1 end %llu", (unsigned long long)w->frames);
	pm_line_seal(text, words, NULL, 0);
	w->frames = 0;
	int status = put(w, text, PM_LINE);
	w->whole = !status;
	return status;
}

/* A wrong header may announce too much: beyond this limit the stream just ends, and the next stage reports that it was cut. */
static const uint64_t most_fill = (uint64_t)1 << 36;

int pm_write_abort(struct pm_writer *w, int code, const char *message)
{
	static const char zero[4096];
	int status = 0;
	if (w->left > most_fill)
		return 0;
	while (w->left && !status)
		status = pm_forward(w, zero, w->left < sizeof zero ? w->left : sizeof zero);
	return status ? status : put_text(w, "PMPIPE/1 abort %llu %llu", (unsigned long long)code, false, message);
}
