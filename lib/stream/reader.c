/* Reads the stream. Everything is checked before it is used. SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "stream/forward.h"
#include "stream/hand-over.h"
#include "stream/header.h"
#include "stream/limits.h"
#include "stream/line.h"
#include "stream/parts-file.h"
#include "stream/parts.h"
#include "stream/run.h"
#include "stream/wire.h"
#include "world/world.h"

enum { most_text = 16 << 20 }; /* bytes of a header, tail or message */

struct item { /* one field of the current frame, as it was when its header was read */
	struct pm_field *field;
	size_t bytes, count;
	enum pm_type type;
	uint32_t crc;
	bool given;  /* handed over, and so not summed again */
	char key[PM_LIMITS_KEY]; /* of its limits in the tail: a stage may have renamed it by then */
};

struct pm_reader {
	int fd;
	char *path;                /* of a regular file that all ranks may read; NULL: none */
	bool (*give_up)(void);     /* NULL: it waits for ever */
	int (*next)(void *from, int *fd); /* the input that follows; NULL: none */
	void *from;
	bool stream, any, aborted; /* between the first frame and the end marker; anything read at all */
	bool whole;                /* the current frame has been read to its tail; it stays current until the next begins */
	struct pm_hands *hands;    /* of the writer of this pipe; NULL: none */
	bool shared;               /* the current frame is handed over: a line before every field that has data */
	uint64_t frame, frames;    /* number of the current frame, from 1; frames of this stream */
	size_t nitems;
	struct item *items;
	size_t item, done;         /* pm_read_values: the field under way, bytes of it */
	uint32_t sum;              /* of the component */
	bool given;                /* that field is */
	struct pm_ring *ring;      /* data come from there; NULL: from the descriptor */
	size_t at, have;
	char piece[PM_PIECE], scratch[PM_PIECE];
};

static void input_is(struct pm_reader *r, int fd)
{
	r->fd = fd;
	r->frame = 1;
	r->any = false;
	free(r->path);
	r->path = NULL;
	fcntl(fd, F_SETPIPE_SZ, 1 << 20); /* harmless if it is not a pipe or not permitted */
	pm_hands_close(r->hands);
	r->hands = pm_world_size() == 1 ? pm_hands_listen(fd) : NULL;
}

struct pm_reader *pm_reader_of_fd(int fd)
{
	struct pm_reader *r = malloc(sizeof *r);
	if (!r) {
		pm_no_memory();
		return NULL;
	}
	memset(r, 0, offsetof(struct pm_reader, piece));
	input_is(r, fd);
	return r;
}

struct pm_reader *pm_reader_open(const char *path)
{
	int fd = path ? open(path, O_RDONLY | O_CLOEXEC) : STDIN_FILENO;
	if (fd < 0) {
		pm_fail_errno("cannot open '%s'", path);
		return NULL;
	}
	struct pm_reader *r = pm_reader_of_fd(fd);
	struct stat st;
	if (r && path && !fstat(fd, &st) && S_ISREG(st.st_mode))
		r->path = strdup(path); /* NULL: rank 0 reads */
	return r;
}

struct pm_reader *pm_reader_close(struct pm_reader *r)
{
	if (r) {
		if (r->fd != STDIN_FILENO)
			close(r->fd);
		pm_hands_close(r->hands);
		free(r->items), free(r->path);
		free(r);
	}
	return NULL;
}

void pm_reader_give_up(struct pm_reader *r, bool (*when)(void)) { r->give_up = when; }

void pm_reader_then(struct pm_reader *r, int (*next)(void *from, int *fd), void *from) { r->next = next, r->from = from; }

void pm_reader_ring(struct pm_reader *r, struct pm_ring *ring) { r->ring = ring; }

uint64_t pm_reader_frame(const struct pm_reader *r) { return r->frame; }

bool pm_reader_aborted(const struct pm_reader *r) { return r->aborted; }

/* True if it is not worth waiting any longer. */
static bool waits_in_vain(const struct pm_reader *r)
{
	struct pollfd p = {.fd = r->fd, .events = POLLIN};
	while (r->give_up) {
		if (r->give_up())
			return true;
		if (poll(&p, 1, 200) > 0)
			return false;
	}
	return false;
}

/* Reads exactly n bytes; -1 and errno on failure, otherwise the bytes there were (fewer only at end of file). Large reads go past the buffer. */
static ssize_t get(struct pm_reader *r, void *to, size_t n)
{
	size_t done = 0;
	while (done < n) {
		if (r->have == r->at) {
			bool direct = n - done >= sizeof r->piece;
			if (waits_in_vain(r)) {
				errno = EINTR;
				return -1;
			}
			ssize_t k = read(r->fd, direct ? (char *)to + done : r->piece, direct ? n - done : sizeof r->piece);
			if (k < 0 && errno == EINTR)
				continue;
			if (k <= 0)
				return k < 0 ? -1 : (ssize_t)done;
			r->any = true;
			if (direct) {
				done += (size_t)k;
				continue;
			}
			r->at = 0, r->have = (size_t)k;
		}
		size_t k = n - done < r->have - r->at ? n - done : r->have - r->at;
		memcpy((char *)to + done, r->piece + r->at, k);
		r->at += k, done += k;
	}
	return (ssize_t)done;
}

static int cut(const char *what) { return pm_fail(PM_DATA, "the input ends in %s: it was cut (run the whole pipeline again)", what); }

static int must_get(struct pm_reader *r, void *to, size_t n, const char *what)
{
	ssize_t k = get(r, to, n);
	if (k < 0)
		return pm_fail_errno("cannot read");
	return (size_t)k == n ? 0 : cut(what);
}

/* The next data: n bytes in the room, or fewer elsewhere. */
static int get_data(struct pm_reader *r, void *room, const void **data, size_t *n)
{
	*data = room;
	if (!r->ring)
		return must_get(r, room, *n, "the data");
	const int status = pm_ring_take(r->ring, data, n);
	return status || *n ? status : cut("the data");
}

/* The text behind a line, a multiple of 64 bytes; free() it. */
static int get_text(struct pm_reader *r, const struct pm_line *l, uint64_t bytes, const char *what, char **text)
{
	if (bytes > most_text || bytes % PM_LINE)
		return pm_fail(PM_DATA, "%s of %llu bytes: not a multiple of 64 up to 16 MiB", what, (unsigned long long)bytes);
	char *t = malloc(bytes + 1);
	if (!t)
		return pm_no_memory();
	int status = must_get(r, t, bytes, what);
	if (!status)
		status = pm_line_check(l, t, bytes, what);
	if (status) {
		free(t);
		return status;
	}
	t[bytes] = 0;
	*text = t;
	return 0;
}

/* Behind the JSON there are spaces and one newline. */
static bool block_padded(const char *text, size_t bytes)
{
	size_t n = bytes - 1;
	if (!bytes || text[n] != '\n')
		return false;
	while (n && text[n - 1] == ' ')
		n--;
	return n && text[n - 1] > ' ';
}

static int get_json(struct pm_reader *r, const struct pm_line *l, const char *what, json_t **out)
{
	char *text = NULL;
	size_t bytes = l->number[0];
	json_error_t error;
	int status = get_text(r, l, bytes, what, &text);
	if (status)
		return status;
	if (!block_padded(text, bytes)) {
		free(text);
		return pm_fail(PM_DATA, "%s does not end in spaces and a newline: it is damaged", what);
	}
	json_t *j = json_loadb(text, bytes, JSON_REJECT_DUPLICATES, &error);
	free(text);
	if (!j)
		return pm_fail(PM_DATA, "%s is not JSON: %s", what, error.text);
	*out = j;
	return 0;
}

static int get_abort(struct pm_reader *r, const struct pm_line *l)
{
	char *text = NULL;
	int code = l->number[0] >= 1 && l->number[0] <= 3 ? (int)l->number[0] : PM_DATA;
	int status = get_text(r, l, l->number[1], "an abort message", &text);
	if (status)
		return status;
	r->aborted = true;
	size_t n = strlen(text);
	while (n && (text[n - 1] == '\n' || text[n - 1] == ' '))
		text[--n] = 0;
	status = pm_fail(code, "%s", n ? text : "the stream was aborted without a reason");
	free(text);
	return status;
}

/* Stores the expected fields, and compares their size with the payload announced in the line. */
static int items_fill(struct pm_reader *r, const struct pm_frame *f, uint64_t payload)
{
	struct item *items = realloc(r->items, (f->nfields + 1) * sizeof *items);
	if (!items)
		return pm_no_memory();
	r->items = items;
	r->nitems = f->nfields;
	r->item = 0;
	uint64_t total = 0; /* n < 2^48, 16 components, 8 bytes: a field fits; the sum is checked */
	for (size_t i = 0; i < f->nfields; i++) {
		struct pm_field *p = f->fields[i];
		items[i] = (struct item){p, pm_field_wire(p), p->count, p->type, 0, false, ""};
		pm_limits_key(p, items[i].key);
		if (__builtin_add_overflow(total, pm_line_padded(items[i].bytes), &total))
			return pm_fail(PM_DATA, "the fields of the header are too large");
	}
	return total == payload ? 0
				: pm_fail(PM_DATA, "the header describes %llu bytes of data, its line announces %llu", (unsigned long long)total,
					  (unsigned long long)payload);
}

static int get_frame(struct pm_reader *r, const struct pm_line *l, struct pm_frame **out)
{
	json_t *header = NULL;
	struct pm_frame *f = NULL;
	int status = get_json(r, l, "a header", &header);
	if (status)
		return status;
	status = pm_header_frame(header, &f);
	json_decref(header);
	if (!status)
		status = items_fill(r, f, l->number[1]);
	if (status) {
		pm_frame_free(f);
		return status;
	}
	r->stream = true;
	r->shared = !strcmp(l->word, "shared");
	r->frames++;
	*out = f;
	return PM_GOT_FRAME;
}

/* The input has ended between two streams: PM_GOT_EOF if no other follows. */
static int next_input(struct pm_reader *r)
{
	int fd = -1, more = r->next ? r->next(r->from, &fd) : 0;
	if (more <= 0)
		return more;
	if (r->fd != STDIN_FILENO)
		close(r->fd);
	input_is(r, fd);
	return more;
}

int pm_read_header(struct pm_reader *r, struct pm_frame **f)
{
	char text[PM_LINE];
	struct pm_line l;
	r->frame += r->whole;
	r->whole = false;
	ssize_t k;
	while ((k = get(r, text, PM_LINE)) == 0 && r->any && !r->stream) {
		int more = next_input(r);
		if (more <= 0)
			return more;
	}
	if (k < 0)
		return pm_fail_errno("cannot read");
	if (k == 0 && !r->any)
		return pm_fail(PM_DATA, "no input: zero bytes are not a stream (the stage before did not start)");
	if (k == 0)
		return pm_fail(PM_DATA, "the input ends without an end marker: it was cut (run the whole pipeline again)");
	if (k < PM_LINE && (k < 7 || memcmp(text, "PMPIPE/", 7)))
		return pm_fail(PM_DATA, "this is not a pmpipe stream (stab - reads text, sh5 reads HDF5)");
	if (k < PM_LINE)
		return pm_fail(PM_DATA, "the input ends in a line: it was cut (run the whole pipeline again)");
	int status = pm_line_parse(text, &l);
	if (status)
		return status;
	if (!strcmp(l.word, "frame") || !strcmp(l.word, "shared"))
		return get_frame(r, &l, f);
	if (!strcmp(l.word, "abort"))
		return get_abort(r, &l);
	if (strcmp(l.word, "end"))
		return pm_fail(PM_DATA, "'%s' instead of a frame or the end", l.word);
	status = pm_line_check(&l, NULL, 0, "the end marker");
	if (!status && l.number[0] != r->frames)
		status = pm_fail(PM_DATA, "the end marker does not count the %llu frames received", (unsigned long long)r->frames);
	if (status)
		return status;
	r->frames = 0;
	r->stream = false;
	return PM_GOT_END;
}

/* f32 that is not held as floats is widened to double on the way in; all else is the same in memory and in the stream. */
static void store(struct item *it, size_t offset, const char *piece, size_t n)
{
	float *floats = pm_field_floats(it->field);
	char *base = floats ? (char *)floats : pm_field_bytes(it->field);
	if (floats || it->type != PM_F32) {
		if (piece != base + offset)
			memcpy(base + offset, piece, n);
		return;
	}
	double *y = (double *)(void *)base + offset / 4;
	for (size_t i = 0; i < n / 4; i++) {
		float v;
		memcpy(&v, piece + 4 * i, 4);
		y[i] = v;
	}
}

/* By all ranks, where the input is a file and several would have some of the values. 1: done; 0: they would not, or failed to, and it is to be read here, which
 * says why. */
static int get_parts(struct pm_reader *r, struct item *it, const struct pm_frame *f)
{
	struct stat mine, named;
	const off_t at = r->path && pm_parts_worth_reading(f, it->field) ? lseek(r->fd, 0, SEEK_CUR) : -1;
	if (at < 0 || fstat(r->fd, &mine) || stat(r->path, &named) || mine.st_dev != named.st_dev || mine.st_ino != named.st_ino)
		return 0;
	const size_t ahead = r->have - r->at;
	const struct pm_parts_place place = {.path = r->path, .offset = (uint64_t)at - ahead};
	if (pm_parts_read(f, it->field, &place, &it->crc)) {
		it->crc = 0;
		return 0;
	}
	if (it->bytes < ahead)
		r->at += it->bytes;
	else
		r->at = r->have, lseek(r->fd, (off_t)(it->bytes - ahead), SEEK_CUR);
	return 1;
}

/* A block that the word before hands over: the field has it if it is loaded, and the writer hands it on. */
static int get_given(struct pm_reader *r, struct item *it, const struct pm_line *l, bool load, struct pm_writer *w)
{
	const struct pm_given g = pm_given_of(l->number[0], l->number[1]);
	struct pm_shared *b = pm_hands_take(r->hands, &g);
	struct pm_field *p = it->field, before = *p;
	if (!b)
		return pm_failed();
	const size_t each = g.floats ? sizeof(float) : it->type == PM_U8 ? 1 : 8;
	if ((g.floats && it->type != PM_F32) || b->bytes / each / (size_t)p->components < it->count) {
		pm_shared_drop(b);
		return pm_fail(PM_DATA, "field %zu of %zu was handed over with too few bytes: the stream is damaged", (size_t)(it - r->items) + 1, r->nitems);
	}
	pm_field_forget(p);
	if (!(p->buffer = pm_buffer_of_shared(b)))
		return pm_failed();
	if (g.floats)
		pm_buffer_to_floats(p->buffer);
	it->given = true;
	p->summed = g.summed, p->crc = g.crc, p->finite = g.finite;
	const int status = w ? pm_forward_held(w, p) : 0;
	if (!load) {
		pm_field_forget(p);
		p->finite = before.finite;
	}
	return status;
}

/* The line before a field of a frame that is handed over. 1: done; 0: its data follow; or failure. */
static int get_before(struct pm_reader *r, struct item *it, bool load, struct pm_writer *w)
{
	char text[PM_LINE];
	struct pm_line l;
	int status = must_get(r, text, PM_LINE, "the data");
	status = status ? status : pm_line_parse(text, &l);
	if (!status && !strcmp(l.word, "abort"))
		return get_abort(r, &l);
	status = status ? status : pm_line_check(&l, NULL, 0, "the line before a field");
	if (!status && !strcmp(l.word, "given"))
		return (status = get_given(r, it, &l, load, w)) ? status : 1;
	if (!status && (strcmp(l.word, "copied") || l.number[0] != pm_line_padded(it->bytes)))
		status = pm_fail(PM_DATA, "'%s' before field %zu of %zu: the stream is damaged", l.word, (size_t)(it - r->items) + 1, r->nitems);
	return status;
}

/* The zeros behind a field. */
static int get_padding(struct pm_reader *r, const struct item *it)
{
	char room[PM_LINE], ored = 0;
	int status = 0;
	size_t n;
	for (size_t rest = pm_line_padded(it->bytes) - it->bytes; rest && !status; rest -= n) {
		const void *data;
		n = rest;
		status = get_data(r, room, &data, &n);
		for (size_t i = 0; i < n && !status; i++)
			ored |= ((const char *)data)[i];
	}
	return status || !ored ? status : pm_fail(PM_DATA, "the bytes behind field %zu of %zu are not zero: the data are damaged",
		(size_t)(it - r->items) + 1, r->nitems);
}

static int get_field(struct pm_reader *r, struct item *it, bool load, bool there, struct pm_writer *w)
{
	int status = r->shared ? get_before(r, it, load, w) : 0;
	if (status)
		return status < 0 ? status : 0;
	const bool floats = load && !there && it->type == PM_F32 && pm_world_alone();
	status = load && !there ? (floats ? pm_field_hold_floats(it->field) : pm_field_hold(it->field)) : 0;
	const bool whole = load && w && it->bytes >= PM_HAND_LEAST; /* handed on when all of it is there */
	status = status || !w || whole ? status : pm_forward_begin(w, it->bytes);
	char *base = status || !load || there ? NULL : floats ? (char *)pm_field_floats(it->field) : it->type != PM_F32 ? pm_field_bytes(it->field) : NULL;
	for (size_t done = there ? it->bytes : 0; done < it->bytes && !status;) {
		size_t n = it->bytes - done < PM_PIECE ? it->bytes - done : PM_PIECE;
		const void *piece;
		status = get_data(r, base ? base + done : r->scratch, &piece, &n);
		if (status)
			break;
		it->crc = pm_crc32c(it->crc, piece, n);
		if (load && !(base && piece == base + done))
			store(it, done, piece, n);
		if (w && !whole)
			status = pm_forward(w, piece, n);
		done += n;
	}
	status = status ? status : get_padding(r, it);
	if (load && !status)
		it->field->summed = true, it->field->crc = it->crc;
	return status || !w ? status : whole ? pm_forward_held(w, it->field) : pm_forward_done(w, it->field, it->crc);
}

static int get_tail(struct pm_reader *r, struct pm_frame *f)
{
	char text[PM_LINE];
	struct pm_line l;
	json_t *tail = NULL;
	int status = must_get(r, text, PM_LINE, "a tail");
	if (!status)
		status = pm_line_parse(text, &l);
	if (!status && !strcmp(l.word, "abort"))
		return get_abort(r, &l);
	if (!status && strcmp(l.word, "tail"))
		status = pm_fail(PM_DATA, "'%s' instead of the tail of the frame", l.word);
	if (!status)
		status = get_json(r, &l, "a tail", &tail);
	if (status)
		return status;
	const json_t *crcs = json_object_get(tail, "crc32c"), *report = json_object_get(tail, "report"), *limits = json_object_get(tail, "limits");
	if (!json_is_array(crcs) || json_array_size(crcs) != r->nitems || (report && !json_is_object(report)))
		status = pm_fail(PM_DATA, "the tail does not fit the fields of the frame");
	for (size_t i = 0; i < r->nitems && !status; i++)
		if (!r->items[i].given && json_integer_value(json_array_get(crcs, i)) != (json_int_t)r->items[i].crc)
			status = pm_fail(PM_DATA, "the checksum of field %zu of %zu is wrong: the data are damaged", i + 1, r->nitems);
	if (!status)
		status = pm_limits_check(limits);
	for (size_t i = 0; i < r->nitems && !status && limits; i++)
		pm_limits_take(limits, r->items[i].key, r->items[i].field);
	if (!status && report) {
		json_decref(f->report);
		f->report = json_deep_copy(report);
	}
	json_decref(tail);
	return status;
}

static bool stays(const struct pm_frame *f, const struct pm_field *field)
{
	if (field->use & (PM_USE_CHANGE | PM_USE_NEW))
		return false;
	for (size_t i = 0; i < f->ndropped; i++)
		if (f->dropped[i] == field)
			return false;
	return true;
}

int pm_read_tail(struct pm_reader *r, struct pm_frame *f)
{
	const int status = get_tail(r, f);
	for (size_t i = 0; i < r->nitems && !status; i++)
		if (r->items[i].given) {
			pm_hands_taken(r->hands);
			break;
		}
	r->whole = !status;
	return status;
}

/* The field that is given may have doubles, where the stream has floats. */
static const void *given_values(struct pm_reader *r, const struct item *it, size_t bytes)
{
	const float *floats = pm_field_floats(it->field);
	if (floats)
		return (const char *)floats + r->done;
	const char *base = pm_field_bytes(it->field);
	if (it->type != PM_F32)
		return base + r->done;
	const double *x = (const double *)(const void *)base + r->done / sizeof(float);
	for (size_t i = 0; i < bytes / sizeof(float); i++) {
		const float v = (float)x[i];
		memcpy(r->scratch + i * sizeof v, &v, sizeof v);
	}
	return r->scratch;
}

int pm_read_values(struct pm_reader *r, size_t bytes, const void **values)
{
	while (!r->items[r->item].bytes)
		r->item++;
	struct item *it = r->items + r->item;
	const size_t component = it->bytes / (size_t)it->field->components;
	int status = 0;
	if (r->done == 0) {
		r->sum = 0;
		status = r->shared ? get_before(r, it, true, NULL) : 0;
		r->given = status > 0;
	}
	*values = r->scratch;
	if (status >= 0 && r->given)
		*values = given_values(r, it, bytes);
	else if (!status)
		status = must_get(r, r->scratch, bytes, "the data");
	if (status < 0)
		return status;
	r->sum = pm_crc32c(r->done % component ? r->sum : 0, *values, bytes);
	r->done += bytes;
	if (r->done % component == 0)
		it->crc = pm_crc32c_join(it->crc, r->sum, component);
	if (r->done < it->bytes)
		return 0;
	r->item++;
	r->done = 0;
	return r->given ? 0 : get_padding(r, it);
}

uint32_t pm_reader_sum(const struct pm_reader *r) { return r->sum; }

/* ranks: they may read what is loaded. */
static int payload(struct pm_reader *r, struct pm_frame *f, bool hold, bool ranks, struct pm_writer *w)
{
	int status = 0;
	for (size_t i = 0; i < r->nitems && !status; i++) {
		struct item *it = r->items + i;
		bool load = hold || it->field->use & (PM_USE_READ | PM_USE_CHANGE), pass = w && stays(f, it->field);
		if (it->bytes)
			status = get_field(r, it, load, ranks && load && get_parts(r, it, f), pass ? w : NULL);
		else if (pass)
			status = pm_forward_done(w, it->field, 0);
	}
	return status ? status : pm_read_tail(r, f);
}

int pm_read_payload(struct pm_reader *r, struct pm_frame *f, bool hold, struct pm_writer *w)
{
	int status = payload(r, f, hold, hold && !w, w);
	for (size_t i = 0; i < r->nitems && !status; i++)
		if (r->items[i].bytes && r->items[i].field->use & (PM_USE_READ | PM_USE_CHANGE))
			status = pm_field_check(r->items[i].field, PM_DATA);
	r->whole = !status;
	return status;
}

int pm_read_declared(struct pm_reader *r, struct pm_frame *f)
{
	int status = pm_read_payload(r, f, false, NULL);
	return status ? status : pm_frame_ready(f);
}

int pm_read_by_ranks(struct pm_reader *r, struct pm_frame *f) { return payload(r, f, false, true, NULL); }

int pm_read_frame(struct pm_reader *r, struct pm_frame **f)
{
	int got = pm_read_header(r, f);
	if (got != PM_GOT_FRAME)
		return got;
	int status = pm_read_payload(r, *f, true, NULL);
	if (status)
		*f = pm_frame_free(*f);
	return status ? status : PM_GOT_FRAME;
}
