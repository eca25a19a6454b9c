/* The eight operations over any transport: status, lengths, cutting and counting are here, once. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "world/world.h"

static struct {
	struct pm_transport t;
	bool set, broken, apart;
	size_t cut;
	int64_t place; /* of a failure of this rank; -1 none said */
	struct pm_world_traffic sent;
	uint64_t *length; /* of what goes to each rank and comes from it: there from the beginning, so that no rank fails for want of them alone */
	size_t *piece;    /* the same of a gather */
} world = {.cut = (size_t)1 << 30, .place = -1};

static struct pm_transport *here(void)
{
	static struct pm_transport alone;
	if (world.apart) {
		alone = pm_transport_alone;
		return &alone;
	}
	if (!world.set) {
		world.t = pm_transport_alone;
		world.set = true;
	}
	return &world.t;
}

int pm_world_rank(void) { return here()->rank; }
int pm_world_size(void) { return here()->size; }
bool pm_world_apart(bool apart)
{
	const bool was = world.apart;
	world.apart = apart;
	return was;
}

bool pm_world_alone(void) { return !world.set || world.t.size == 1; }
bool pm_world_broken(void) { return world.broken; }
struct pm_world_traffic pm_world_traffic(void) { return world.sent; }
void pm_world_cut(size_t bytes) { world.cut = bytes; }

void pm_world_set(const struct pm_transport *t)
{
	free(world.length), free(world.piece);
	world.length = t->size > 1 ? calloc(2 * (size_t)t->size, sizeof *world.length) : NULL;
	world.piece = t->size > 1 ? calloc(2 * (size_t)t->size, sizeof *world.piece) : NULL;
	if (t->size > 1 && !(world.length && world.piece)) {
		pm_no_memory();
		pm_cannot_go_on();
	}
	world.t = *t;
	world.set = true;
	world.broken = false;
	world.sent = (struct pm_world_traffic){0, 0, 0};
}

int pm_world_end(void)
{
	world.apart = false;
	struct pm_transport *t = here();
	const int bad = t->close(t), status = bad ? pm_fail(PM_DATA, "%s", t->reason(t)) : 0;
	pm_world_set(&pm_transport_alone);
	return status;
}

void pm_world_abort(int code)
{
	world.apart = false;
	if (here()->size > 1)
		here()->abort(here(), code);
}

/* 7 bits of the check, 8 of the set, 8 of the component, 40 of the index; the first check stands for failures without a place. */
void pm_world_place(int check, int set, int component, uint64_t index)
{
	const uint64_t most = ((uint64_t)1 << 40) - 1;
	world.place = (int64_t)((uint64_t)(check & 0x7f) << 56 | (uint64_t)(set & 0xff) << 48 | (uint64_t)(component & 0xff) << 40 |
		(index < most ? index : most));
}

static int broken(void)
{
	struct pm_transport *t = here();
	world.broken = true;
	return pm_fail(PM_DATA, "%s", t->reason(t));
}

static int reduced(enum pm_reduction how, size_t n, int64_t *x)
{
	struct pm_transport *t = here();
	if (world.broken || t->reduce(t, how, n, x))
		return broken();
	world.sent.bytes += n * sizeof *x;
	world.sent.messages++;
	return 0;
}

static int shared(int root, void *data, size_t bytes)
{
	struct pm_transport *t = here();
	for (size_t done = 0; done < bytes;) {
		const size_t n = bytes - done < world.cut ? bytes - done : world.cut;
		if (world.broken || t->share(t, root, (char *)data + done, n))
			return broken();
		if (root == t->rank)
			world.sent.bytes += n, world.sent.messages++;
		done += n;
	}
	return 0;
}

/* The place of this rank's failure; INT64_MAX: it has not failed. */
static int64_t failure_of(int status)
{
	const int64_t place = status < 0 ? world.place >= 0 ? world.place : here()->rank : INT64_MAX;
	world.place = -1;
	return place;
}

/* The failure with the least place, of several in one place that of the least rank, becomes everybody's. */
static int failed_at(int status, int64_t mine, int64_t least)
{
	struct pm_transport *t = here();
	struct {
		int64_t code;
		char text[1024];
	} said = {status, ""};
	int64_t who;
	if (least == INT64_MAX)
		return 0;
	who = mine == least ? t->rank : INT64_MAX;
	if (reduced(PM_LEAST_OF, 1, &who))
		return -PM_DATA;
	memcpy(said.text, pm_message(), strnlen(pm_message(), sizeof said.text - 1));
	if (shared((int)who, &said, sizeof said))
		return -PM_DATA;
	return pm_fail((int)-said.code, "%s", said.text);
}

static int agreed(int status)
{
	const int64_t mine = failure_of(status);
	int64_t least = mine;
	if (world.broken)
		return broken();
	return reduced(PM_LEAST_OF, 1, &least) ? -PM_DATA : failed_at(status, mine, least);
}

/* A reduction of a few numbers takes the statuses with it, so that ranks wait for each other once: the least place of the failures, the most of its complement,
 * or how many have failed, of whom the place is then asked. */
static int reduced_with(int status, enum pm_reduction how, size_t n, int64_t *x)
{
	int64_t all[64];
	if (n >= sizeof all / sizeof *all || how == PM_SUM_BEFORE) {
		status = agreed(status);
		return status ? status : reduced(how, n, x);
	}
	if (world.broken)
		return broken();
	const int64_t place = world.place, mine = failure_of(status);
	all[0] = how == PM_SUM_OF ? mine != INT64_MAX : how == PM_MOST_OF ? ~mine : mine;
	memcpy(all + 1, x, n * sizeof *x);
	if (reduced(how, n + 1, all))
		return -PM_DATA;
	if (how == PM_SUM_OF) {
		world.place = place;
		status = all[0] ? agreed(status) : 0;
		world.place = -1;
	} else
		status = failed_at(status, mine, how == PM_MOST_OF ? ~all[0] : all[0]);
	if (!status)
		memcpy(x, all + 1, n * sizeof *x);
	return status;
}

/* The status with which an operation begins; alone it is the caller's. */
static int enter(int status)
{
	world.sent.calls++;
	if (here()->size == 1) {
		world.place = -1;
		return status < 0 ? status : 0;
	}
	return agreed(status);
}

int pm_world_agree(int status) { return enter(status); }

int pm_world_share(int status, int root, void *data, size_t bytes)
{
	status = enter(status);
	return status || here()->size == 1 ? status : shared(root, data, bytes);
}

int pm_world_tell(void *data, size_t bytes)
{
	world.sent.calls++;
	world.place = -1;
	return here()->size == 1 ? 0 : shared(0, data, bytes);
}

int pm_world_count(int status, enum pm_reduction how, size_t n, int64_t *x)
{
	if (here()->size > 1) {
		world.sent.calls++;
		return reduced_with(status, how, n, x);
	}
	status = enter(status);
	return status ? status : reduced(how, n, x);
}

/* An integer in the order of the double: those that are not numbers come last. */
static int64_t key_of(double x)
{
	int64_t bits;
	if (isnan(x))
		return INT64_MAX;
	memcpy(&bits, &x, sizeof bits);
	return bits < 0 ? (int64_t)(~(uint64_t)bits ^ ((uint64_t)1 << 63)) : bits;
}

static double of_key(int64_t key)
{
	double x;
	if (key == INT64_MAX)
		return NAN;
	const uint64_t bits = key < 0 ? ~((uint64_t)key ^ ((uint64_t)1 << 63)) : (uint64_t)key;
	memcpy(&x, &bits, sizeof x);
	return x;
}

int pm_world_largest(int status, size_t n, double *x)
{
	if (here()->size == 1)
		return enter(status);
	world.sent.calls++;
	for (size_t i = 0, m = 0; !i || (i < n && !status); i += m ? m : 1) { /* few numbers: nobody shares fields by this */
		int64_t key[32];
		m = n - i < 32 ? n - i : 32;
		for (size_t k = 0; k < m; k++)
			key[k] = key_of(x[i + k]);
		status = reduced_with(status, PM_MOST_OF, m, key);
		for (size_t k = 0; k < m && !status; k++)
			x[i + k] = of_key(key[k]);
	}
	return status;
}

/* ---- messages between two ranks ---- */

struct parts {
	size_t n, room;
	struct pm_message_part *part;
};

/* One message more, cut into pieces. */
static int add(struct parts *p, int rank, void *data, size_t bytes)
{
	const size_t pieces = (bytes + world.cut - 1) / world.cut;
	if (p->n + pieces > p->room) {
		const size_t room = 2 * p->room + pieces + 8;
		struct pm_message_part *more = realloc(p->part, room * sizeof *more);
		if (!more)
			return pm_no_memory();
		p->part = more;
		p->room = room;
	}
	for (size_t done = 0; done < bytes;) {
		const size_t k = bytes - done < world.cut ? bytes - done : world.cut;
		p->part[p->n++] = (struct pm_message_part){rank, (char *)data + done, k};
		done += k;
	}
	return 0;
}

/* Sends all, where every rank could list its messages, and frees the lists. */
static int moved(int status, struct parts *out, struct parts *in)
{
	struct pm_transport *t = here();
	if (!status && t->move(t, out->n, out->part, in->n, in->part))
		status = broken();
	for (size_t i = 0; i < out->n && !status; i++)
		world.sent.bytes += out->part[i].bytes;
	world.sent.messages += status ? 0 : out->n;
	free(out->part), free(in->part);
	return status;
}

/* The lengths of what goes to each rank and comes from it. A rank that has failed says so with them. */
static int lengths(int status, const size_t *out_bytes, uint64_t *length)
{
	struct pm_transport *t = here();
	const size_t ranks = (size_t)t->size;
	bool failed = false;
	for (size_t r = 0; r < ranks; r++)
		length[r] = status < 0 ? UINT64_MAX : out_bytes[r];
	if (world.broken || t->turn(t, length, length + ranks))
		return broken();
	world.sent.bytes += 8 * (ranks - 1);
	world.sent.messages += ranks - 1;
	for (size_t r = 0; r < ranks; r++)
		failed |= length[ranks + r] == UINT64_MAX;
	if (failed)
		return agreed(status);
	world.place = -1;
	return 0;
}

int pm_world_exchange(int status, const void *out, const size_t *out_bytes, void **in, size_t *in_bytes)
{
	struct pm_transport *t = here();
	const size_t ranks = (size_t)t->size;
	struct parts to = {0, 0, NULL}, from = {0, 0, NULL};
	uint64_t alone[2], *length = ranks > 1 ? world.length : alone;
	*in = NULL;
	if (ranks == 1) {
		status = enter(status);
		alone[0] = alone[1] = status ? 0 : out_bytes[0];
	} else {
		world.sent.calls++;
		status = lengths(status, out_bytes, length);
	}
	size_t total = 0, at = 0, have = 0;
	for (size_t r = 0; r < ranks && !status; r++)
		total += in_bytes[r] = (size_t)length[ranks + r];
	char *got = status ? NULL : pm_alloc(total + 1, 1);
	status = status || got ? status : pm_failed();
	for (size_t r = 0; r < ranks && !status; r++) {
		char *mine = (char *)(uintptr_t)out + have;
		if ((int)r == t->rank)
			memcpy(got + at, mine, out_bytes[r]);
		else
			status = add(&from, (int)r, got + at, in_bytes[r]) || add(&to, (int)r, mine, out_bytes[r]) ? -PM_DATA : 0;
		have += out_bytes[r], at += in_bytes[r];
	}
	status = moved(ranks > 1 ? agreed(status) : status, &to, &from);
	*in = status ? pm_free(got) : got;
	return status;
}

int pm_world_gather(int status, const void *mine, size_t bytes, void **all, size_t *total)
{
	struct pm_transport *t = here();
	const size_t ranks = (size_t)t->size;
	size_t alone[2], *length = ranks > 1 ? world.piece : alone;
	*all = NULL;
	*total = 0;
	memset(length, 0, 2 * ranks * sizeof *length);
	length[0] = bytes;
	status = pm_world_exchange(status, mine, length, all, length + ranks);
	for (size_t r = 0; r < ranks && !status; r++)
		*total += length[ranks + r];
	if (!status && t->rank)
		*all = pm_free(*all);
	return status;
}

int pm_world_recut(int status, const uint64_t *from, const uint64_t *to, size_t bytes, const void *in, void *out)
{
	struct pm_transport *t = here();
	const int me = t->rank;
	struct parts give = {0, 0, NULL}, take = {0, 0, NULL};
	status = status < 0 ? status : 0;
	for (int r = 0; r < t->size && !status; r++) {
		if (r == me)
			continue;
		uint64_t a = from[me] > to[r] ? from[me] : to[r], b = from[me + 1] < to[r + 1] ? from[me + 1] : to[r + 1];
		if (a < b)
			status = add(&give, r, (char *)(uintptr_t)in + (a - from[me]) * bytes, (b - a) * bytes);
		a = from[r] > to[me] ? from[r] : to[me], b = from[r + 1] < to[me + 1] ? from[r + 1] : to[me + 1];
		if (a < b && !status)
			status = add(&take, r, (char *)out + (a - to[me]) * bytes, (b - a) * bytes);
	}
	status = enter(status);
	if (!status) { /* `from` and `to` need not be there on a rank that has failed */
		const uint64_t a = from[me] > to[me] ? from[me] : to[me], b = from[me + 1] < to[me + 1] ? from[me + 1] : to[me + 1];
		if (a < b && in != out)
			memmove((char *)out + (a - to[me]) * bytes, (const char *)in + (a - from[me]) * bytes, (b - a) * bytes);
	}
	return moved(status, &give, &take);
}

/* ---- planes of the neighbours ---- */

struct wanted {
	int64_t plane, shift; /* who wants it has it as plane + shift */
};

static int64_t whole_periods(int64_t plane, int64_t n) { return (plane >= 0 ? plane / n : -((-plane + n - 1) / n)) * n; }

/* The next plane that rank `who` wants beyond its ends and rank `owner` holds. *at counts all that it wants; 0 at the beginning. */
static bool next_wanted(const struct pm_halo *h, int size, int who, int owner, int64_t *at, struct wanted *w)
{
	const int64_t n = (int64_t)h->from[size], lo = (int64_t)h->from[who], hi = (int64_t)h->from[who + 1];
	while ((lo < hi || h->empty) && *at < 2 * h->wide) {
		const int64_t k = (*at)++, beyond = k < h->wide ? lo - h->wide + k : hi + k - h->wide;
		const int64_t shift = h->periodic ? whole_periods(beyond, n) : 0, plane = beyond - shift;
		*w = (struct wanted){plane, shift};
		if (plane >= (int64_t)h->from[owner] && plane < (int64_t)h->from[owner + 1])
			return true;
	}
	return false;
}

int pm_world_halo(int status, const struct pm_halo *h, void *data)
{
	struct pm_transport *t = here();
	const int me = t->rank;
	const int64_t mine = (int64_t)h->from[me];
	struct parts give = {0, 0, NULL}, take = {0, 0, NULL};
	struct wanted w;
	status = status < 0 ? status : 0;
	for (int r = 0; r < t->size && !status; r++) {
		for (int64_t at = 0; r != me && !status && next_wanted(h, t->size, r, me, &at, &w);)
			status = add(&give, r, (char *)data + (w.plane - mine) * (int64_t)h->bytes, h->bytes);
		for (int64_t at = 0; r != me && !status && next_wanted(h, t->size, me, r, &at, &w);)
			status = add(&take, r, (char *)data + (w.plane + w.shift - mine) * (int64_t)h->bytes, h->bytes);
	}
	status = enter(status);
	for (int64_t at = 0; !status && next_wanted(h, t->size, me, me, &at, &w);)
		memcpy((char *)data + (w.plane + w.shift - mine) * (int64_t)h->bytes, (char *)data + (w.plane - mine) * (int64_t)h->bytes, h->bytes);
	return moved(status, &give, &take);
}
