/* Requests of rank 0, and the parts of divided values. A request is a share of its head, then of what belongs to it; then all ranks do the same operations.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "stream/hand-over.h"
#include "stream/later.h"
#include "stream/parts.h"
#include "world/world.h"

enum { rows_at_once = 16 }; /* of transforms: PM_FFT_LINES of lib/fft */

static uint64_t last_id;
static struct {
	uint64_t *id; /* rank 0: parts that nobody uses any more, not yet said */
	size_t n, room;
} gone;
static struct {
	struct kept {
		uint64_t id;
		struct pm_buffer *buffer;
	} *item;
	size_t n, room;
} store; /* of the other ranks */

uint64_t pm_parts_number(void) { return ++last_id; }

uint64_t pm_division_grain(const struct pm_frame *f, const char *on)
{
	const struct pm_mesh *m = pm_frame_set(f, on) ? NULL : pm_frame_mesh(f, on);
	size_t points[3], all = m ? pm_mesh_points(f, m, points) : pm_sum_block;
	return !m || f->dim == 1 ? all : f->dim == 2 ? rows_at_once * points[0] : points[0] * points[1];
}

uint64_t *pm_division_new(uint64_t n, uint64_t grain)
{
	const uint64_t ranks = (uint64_t)pm_world_size(), blocks = (n + grain - 1) / grain;
	uint64_t *from = malloc((ranks + 1) * sizeof *from);
	for (uint64_t r = 0; from && r <= ranks; r++) {
		from[r] = blocks * r / ranks * grain;
		from[r] = from[r] < n ? from[r] : n;
	}
	if (!from)
		pm_no_memory();
	return from;
}

static bool share_new;

void pm_buffers_share(bool yes) { share_new = yes; }

struct pm_buffer *pm_buffer_of_shared(struct pm_shared *shared)
{
	struct pm_buffer *b = calloc(1, sizeof *b);
	if (!b) {
		pm_shared_drop(shared);
		pm_no_memory();
		return NULL;
	}
	atomic_init(&b->users, 1);
	b->shared = shared;
	b->data = shared->data;
	return b;
}

struct pm_buffer *pm_buffer_new(size_t n, size_t size, bool zero)
{
	size_t bytes;
	struct pm_shared *shared = share_new && !__builtin_mul_overflow(n, size, &bytes) && bytes >= PM_HAND_LEAST ? pm_shared_new(bytes) : NULL;
	if (shared) {
		if (zero)
			memset(shared->data, 0, bytes);
		return pm_buffer_of_shared(shared);
	}
	struct pm_buffer *b = calloc(1, sizeof *b);
	void *data = zero ? pm_zalloc(n, size) : pm_alloc(n, size);
	if (!b || !data) {
		free(b), pm_free(data);
		pm_no_memory();
		return NULL;
	}
	atomic_init(&b->users, 1);
	b->data = data;
	return b;
}

struct pm_buffer *pm_buffer_adopt(double *data)
{
	struct pm_buffer *b = share_new ? NULL : calloc(1, sizeof *b);
	if (b) {
		atomic_init(&b->users, 1);
		b->data = data;
	}
	return b;
}

void pm_buffer_to_floats(struct pm_buffer *b)
{
	b->floats = b->data;
	b->data = NULL;
}

static void drop(struct pm_buffer *b, void *values)
{
	if (b->shared && values == b->shared->data) {
		pm_shared_drop(b->shared);
		b->shared = NULL;
	} else
		pm_free(values);
}

void pm_buffer_drop_data(struct pm_buffer *b)
{
	drop(b, b->data);
	b->data = NULL;
}

void pm_buffer_drop_floats(struct pm_buffer *b)
{
	drop(b, b->floats);
	b->floats = NULL;
}

int pm_buffer_users(const struct pm_buffer *b) { return atomic_load(&b->users) + (b->shared && !pm_shared_alone(b->shared)); }

bool pm_buffer_alone(const struct pm_buffer *b) { return pm_buffer_users(b) == 1; }

/* ---- requests ---- */

/* What goes to all in one message; the rest of a long request follows. */
struct request {
	int64_t what, bytes;
	char begins[4080];
};

static int send(enum pm_request what, const void *more, size_t bytes)
{
	struct request r = {.what = what, .bytes = (int64_t)bytes};
	const size_t here = bytes < sizeof r.begins ? bytes : sizeof r.begins;
	if (here)
		memcpy(r.begins, more, here);
	const int status = pm_world_tell(&r, sizeof r);
	return bytes > here ? pm_world_share(status, 0, (char *)(uintptr_t)more + here, bytes - here) : status;
}

int pm_request_send(enum pm_request what, const void *more, size_t bytes)
{
	const size_t n = gone.n;
	gone.n = 0;
	int status = n ? send(PM_REQUEST_FORGET, gone.id, n * sizeof *gone.id) : 0;
	return status ? status : send(what, more, bytes);
}

int pm_request_take(enum pm_request *what, void **more, size_t *bytes)
{
	static struct {
		struct request r;
		char end; /* of a text that fits */
	} got; /* no memory is needed, so that no rank can fail here alone */
	static char *whole;
	free(whole);
	whole = NULL;
	int status = pm_world_tell(&got.r, sizeof got.r);
	*more = NULL;
	if (status)
		return status;
	*what = (enum pm_request)got.r.what;
	*bytes = (size_t)got.r.bytes;
	const size_t room = sizeof got.r.begins;
	if (*bytes <= room) {
		*more = got.r.begins;
		(*bytes < room ? got.r.begins + *bytes : &got.end)[0] = 0;
		return 0;
	}
	whole = malloc(*bytes + 1);
	status = pm_world_share(whole ? 0 : pm_no_memory(), 0, whole ? whole + room : NULL, *bytes - room);
	if (status)
		return status;
	memcpy(whole, got.r.begins, room);
	whole[*bytes] = 0;
	*more = whole;
	return 0;
}

/* ---- parts ---- */

static void forget(uint64_t id)
{
	if (gone.n == gone.room) {
		uint64_t *more = realloc(gone.id, (2 * gone.room + 16) * sizeof *more);
		if (!more)
			return; /* the others keep it for nothing */
		gone.id = more;
		gone.room = 2 * gone.room + 16;
	}
	gone.id[gone.n++] = id;
}

void pm_buffer_undivide(struct pm_buffer *b)
{
	if (b->id && pm_world_rank() == 0)
		forget(b->id);
	pm_free(b->part), free(b->from);
	b->part = NULL, b->from = NULL, b->id = 0;
}

struct pm_buffer *pm_buffer_free(struct pm_buffer *b)
{
	if (b && atomic_fetch_sub(&b->users, 1) == 1) {
		pm_buffer_undivide(b);
		if (b->note)
			b->note->free(b->note);
		pm_later_free(b->later);
		pm_buffer_drop_data(b), pm_buffer_drop_floats(b);
		free(b);
	}
	return NULL;
}

struct pm_buffer *pm_parts_of(uint64_t id, bool take)
{
	for (size_t i = 0; i < store.n; i++)
		if (store.item[i].id == id) {
			struct pm_buffer *b = store.item[i].buffer;
			if (take)
				store.item[i] = store.item[--store.n];
			else
				atomic_fetch_add(&b->users, 1);
			return b;
		}
	return NULL;
}

int pm_parts_keep(uint64_t id, struct pm_buffer *b)
{
	if (store.n == store.room) {
		struct kept *more = realloc(store.item, (2 * store.room + 16) * sizeof *more);
		if (!more)
			return pm_no_memory();
		store.item = more;
		store.room = 2 * store.room + 16;
	}
	atomic_fetch_add(&b->users, 1);
	store.item[store.n++] = (struct kept){id, b};
	return 0;
}

void pm_parts_free(void)
{
	while (store.n)
		pm_buffer_free(store.item[--store.n].buffer);
	free(store.item), free(gone.id);
	store.item = NULL, gone.id = NULL;
	store.room = gone.room = gone.n = 0;
}

/* What a request to divide or to join says: of the values, then the division. */
struct shape {
	uint64_t id, size, components;
};

static uint64_t *with_division(const struct shape *s, const uint64_t *from, size_t *bytes)
{
	const size_t ranks = (size_t)pm_world_size();
	uint64_t *text = malloc(*bytes = sizeof *s + (ranks + 1) * sizeof *from);
	if (text) {
		memcpy(text, s, sizeof *s);
		memcpy(text + 3, from, (ranks + 1) * sizeof *from);
	} else {
		pm_no_memory();
	}
	return text;
}

/* All on rank 0. */
static uint64_t *on_first(uint64_t n)
{
	const size_t ranks = (size_t)pm_world_size();
	uint64_t *from = malloc((ranks + 1) * sizeof *from);
	for (size_t r = 0; from && r <= ranks; r++)
		from[r] = r ? n : 0;
	if (!from)
		pm_no_memory();
	return from;
}

/* All values on rank 0 to parts (divide), or the reverse, component by component. whole: on rank 0. */
static int carry(int status, const struct shape *s, const uint64_t *from, bool divide, char *whole, char *part)
{
	const size_t me = (size_t)pm_world_rank(), n = from[pm_world_size()], here = from[me + 1] - from[me];
	uint64_t *first = on_first(n);
	status = status ? status : first ? 0 : pm_failed();
	for (uint64_t c = 0; c < s->components; c++) {
		char *all = whole ? whole + c * n * s->size : NULL, *own = part ? part + c * here * s->size : NULL;
		status = divide ? pm_world_recut(status, first, from, s->size, all, own) : pm_world_recut(status, from, first, s->size, own, all);
	}
	free(first);
	return status;
}

/* Every rank, with its status: room for the part, then the values. */
static int take_part(int status, struct pm_buffer *b, const struct shape *s, const uint64_t *from)
{
	const size_t me = (size_t)pm_world_rank(), ranks = (size_t)pm_world_size(), here = from[me + 1] - from[me];
	char *part = status ? NULL : pm_alloc(here * s->components + 1, s->size);
	uint64_t *division = malloc((ranks + 1) * sizeof *division);
	if (!status && (!part || !division))
		status = pm_failed();
	status = carry(status, s, from, true, b ? b->data : NULL, part);
	if (status || !b || !division) {
		pm_free(part), free(division);
		return status;
	}
	memcpy(division, from, (ranks + 1) * sizeof *division);
	b->part = part, b->from = division, b->id = s->id, b->size = s->size, b->components = (int)s->components;
	return 0;
}

int pm_buffer_divide(struct pm_buffer *b, int components, size_t size, const uint64_t *from)
{
	const struct shape s = {pm_parts_number(), size, (uint64_t)components};
	size_t bytes;
	if (b->id)
		return 0;
	const bool apart = pm_world_apart(false);
	uint64_t *text = with_division(&s, from, &bytes);
	int status = text ? pm_request_send(PM_REQUEST_DIVIDE, text, bytes) : pm_failed();
	free(text);
	status = status ? status : take_part(0, b, &s, from);
	pm_world_apart(apart);
	return status;
}

int pm_buffer_join(struct pm_buffer *b)
{
	const struct shape s = {b->id, b->size, (uint64_t)b->components};
	size_t bytes;
	if (b->data)
		return 0;
	const bool apart = pm_world_apart(false);
	const size_t n = b->from[pm_world_size()];
	void *data = pm_alloc(n * s.components + 1, s.size);
	uint64_t *text = data ? with_division(&s, b->from, &bytes) : NULL;
	int status = text ? pm_request_send(PM_REQUEST_JOIN, text, bytes) : pm_failed();
	free(text);
	status = status ? status : carry(0, &s, b->from, false, data, b->part);
	b->data = status ? pm_free(data) : data;
	pm_world_apart(apart);
	return status;
}

/* What a request to append says, then the divisions of a, of b and of both. */
struct append {
	uint64_t a, b, made, size, components;
	uint64_t from[];
};

/* Division `to` of the values of both, as one of n of them that begin at number `before`. */
static void clip(const uint64_t *to, uint64_t before, uint64_t n, uint64_t *clipped)
{
	for (int r = 0; r <= pm_world_size(); r++) {
		const uint64_t at = to[r] > before ? to[r] - before : 0;
		clipped[r] = at < n ? at : n;
	}
}

/* Every rank, with its status. */
static int append(int status, const struct append *q, const struct pm_buffer *a, const struct pm_buffer *b, struct pm_buffer **made)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank(), table = (ranks + 1) * sizeof(uint64_t);
	const uint64_t *const from[2] = {q->from, q->from + ranks + 1}, *const to = q->from + 2 * (ranks + 1);
	const struct pm_buffer *const old[2] = {a, b};
	const size_t here = to[me + 1] - to[me];
	struct pm_buffer *m = calloc(1, sizeof *m);
	char *part = pm_alloc(here * q->components + 1, q->size);
	uint64_t *division = malloc(3 * table), *const clipped[2] = {division + ranks + 1, division ? division + 2 * (ranks + 1) : NULL};
	status = status ? status : m && part && division ? 0 : pm_no_memory();
	if (division) {
		memcpy(division, to, table);
		clip(to, 0, from[0][ranks], clipped[0]);
		clip(to, from[0][ranks], from[1][ranks], clipped[1]);
	}
	for (uint64_t c = 0; c < q->components; c++)
		for (int k = 0; k < 2; k++) {
			const char *in = status ? NULL : (char *)old[k]->part + c * (from[k][me + 1] - from[k][me]) * q->size;
			char *out = status ? NULL : part + (c * here + (k ? clipped[0][me + 1] - clipped[0][me] : 0)) * q->size;
			status = pm_world_recut(status, from[k], division ? clipped[k] : from[k], q->size, in, out);
		}
	if (status) {
		free(m), pm_free(part), free(division);
		return status;
	}
	atomic_init(&m->users, 1);
	m->part = part, m->from = division, m->id = q->made, m->size = q->size, m->components = (int)q->components;
	*made = m;
	return 0;
}

int pm_buffer_append(const struct pm_buffer *a, const struct pm_buffer *b, const uint64_t *to, struct pm_buffer **made)
{
	const size_t table = ((size_t)pm_world_size() + 1) * sizeof *to, bytes = sizeof(struct append) + 3 * table;
	struct append *q = calloc(1, bytes);
	if (!q)
		return pm_no_memory();
	*q = (struct append){a->id, b->id, pm_parts_number(), a->size, (uint64_t)a->components};
	memcpy(q->from, a->from, table);
	memcpy((char *)q->from + table, b->from, table);
	memcpy((char *)q->from + 2 * table, to, table);
	int status = pm_request_send(PM_REQUEST_APPEND, q, bytes);
	status = status ? status : append(0, q, a, b, made);
	free(q);
	return status;
}

static int follow_append(const struct append *q)
{
	struct pm_buffer *a = pm_parts_of(q->a, false), *b = pm_parts_of(q->b, false), *made = NULL;
	const int status = append(a && b ? 0 : pm_fail(PM_DATA, "a part is missing"), q, a, b, &made);
	if (!status && pm_parts_keep(q->made, made))
		pm_cannot_go_on();
	pm_buffer_free(a), pm_buffer_free(b), pm_buffer_free(made);
	return status;
}

int pm_request_parts(enum pm_request what, const void *more, size_t bytes)
{
	struct shape s;
	const uint64_t *from = (const uint64_t *)more + 3;
	if (what == PM_REQUEST_FORGET) {
		for (size_t i = 0; i < bytes / sizeof(uint64_t); i++)
			pm_buffer_free(pm_parts_of(((const uint64_t *)more)[i], true));
		return 0;
	}
	if (what == PM_REQUEST_APPEND)
		return follow_append(more);
	memcpy(&s, more, sizeof s);
	if (what == PM_REQUEST_JOIN) {
		struct pm_buffer *b = pm_parts_of(s.id, false);
		const int status = carry(b ? 0 : pm_fail(PM_DATA, "a part is missing"), &s, from, false, NULL, b ? b->part : NULL);
		pm_buffer_free(b);
		return status;
	}
	struct pm_buffer *b = calloc(1, sizeof *b);
	if (b)
		atomic_init(&b->users, 1);
	int status = b ? pm_parts_keep(s.id, b) : pm_no_memory();
	status = take_part(status, b, &s, from);
	pm_buffer_free(b);
	return status;
}
