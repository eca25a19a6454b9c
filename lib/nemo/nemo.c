/* Snapshots of NEMO: items of a structured binary file, each a magic number of two bytes (0x0992 a single value, 0x0b92 an array; in the byte order of the
 * machine that wrote it), a type and a name that end in a 0, for an array its dimensions as 32-bit numbers that end in a 0, and the data. Sets are nested.
 * Source: NEMO's manual pages filestruct(5NEMO) and snapshot(5NEMO), Teuben 1995 (ASP Conf. Ser. 77, 398). Cost: one pass through memory.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "nemo/nemo.h"
#include "stream/declare.h"
#include "stream/list.h"

enum { single = 0x0992, plural = 0x0b92, cartesian = 1, deepest = 16 };

static size_t value_size(char type)
{
	switch (type) {
	case 'd':
	case 'l':
		return 8;
	case 'f':
	case 'i':
		return 4;
	case 's':
	case 'h':
		return 2;
	default:
		return 1;
	}
}

static uint64_t bits(const unsigned char *from, size_t size, bool swapped)
{
	uint64_t x = 0;
	for (size_t i = 0; i < size; i++)
		x |= (uint64_t)from[i] << 8 * (swapped ? size - 1 - i : i);
	return x;
}

static bool magic(const char *data, bool *swapped)
{
	const unsigned char *b = (const unsigned char *)data;
	const uint64_t there = bits(b, 2, false), other = bits(b, 2, true);
	*swapped = other == single || other == plural;
	return *swapped || there == single || there == plural;
}

/* The first item has a type of one letter and a name. */
bool pm_nemo_is(const char *data, size_t size)
{
	bool swapped;
	return size > 5 && magic(data, &swapped) && strchr("abcsilhfd([", data[2]) && data[3] == 0;
}

static int damaged(const struct pm_nemo *r, const char *what) { return pm_fail(PM_DATA, "byte %zu of a NEMO file: %s", r->at, what); }

/* A text that ends in a 0 within the file. */
static const char *word(struct pm_nemo *r)
{
	const char *s = r->data + r->at, *end = memchr(s, 0, r->size - r->at);
	if (!end || end - s >= PM_NAME)
		return NULL;
	r->at += (size_t)(end - s) + 1;
	return s;
}

static int dimensions(struct pm_nemo *r, struct pm_nemo_item *item)
{
	for (item->count = 1;; item->ndim++) {
		if (r->size - r->at < 4)
			return damaged(r, "it ends within the dimensions of an array");
		const uint64_t d = bits((const unsigned char *)r->data + r->at, 4, item->swapped);
		r->at += 4;
		if (!d)
			return 0;
		if (item->ndim == 9 || d > INT32_MAX || item->count > r->size / d)
			return damaged(r, "an array is larger than the file");
		item->dim[item->ndim] = d, item->count *= d;
	}
}

/* 1, 0 at the end of the file, or failure. */
static int next(struct pm_nemo *r, struct pm_nemo_item *item)
{
	*item = (struct pm_nemo_item){.tag = "", .count = 1};
	if (r->at == r->size)
		return 0;
	if (r->size - r->at < 4 || !magic(r->data + r->at, &item->swapped))
		return damaged(r, "no item begins here (the file is cut or damaged)");
	const bool array = bits((const unsigned char *)r->data + r->at, 2, item->swapped) == plural;
	r->at += 2;
	const char *type = word(r);
	if (!type || strlen(type) != 1 || !strchr("abcsilhfd()[]", *type))
		return damaged(r, "an item of an unknown type");
	item->type = *type;
	if (item->type != ')' && !(item->tag = word(r)))
		return damaged(r, "a name that does not end");
	if (array && dimensions(r, item))
		return -PM_DATA;
	if (strchr("()[]", item->type))
		return 1;
	item->data = (const unsigned char *)r->data + r->at;
	if (item->count > (r->size - r->at) / value_size(item->type))
		return damaged(r, "it ends within the data of an item");
	r->at += item->count * value_size(item->type);
	return 1;
}

static double real(const struct pm_nemo_item *item, size_t i)
{
	const uint64_t b = bits(item->data + i * value_size(item->type), value_size(item->type), item->swapped);
	double d;
	float f;
	if (item->type == 'd')
		return memcpy(&d, &b, sizeof d), d;
	const uint32_t half = (uint32_t)b;
	return memcpy(&f, &half, sizeof f), f;
}

static int64_t whole(const struct pm_nemo_item *item, size_t i)
{
	const size_t size = value_size(item->type);
	const uint64_t b = bits(item->data + i * size, size, item->swapped);
	return size == 8 ? (int64_t)b : size == 4 ? (int32_t)(uint32_t)b : (int16_t)(uint16_t)b;
}

static bool is_real(const struct pm_nemo_item *item) { return item->type == 'd' || item->type == 'f'; }
static bool is_whole(const struct pm_nemo_item *item) { return item->type == 'i' || item->type == 'l' || item->type == 's'; }

static void leave_out(struct pm_nemo *r, const char *name)
{
	size_t n = strlen(r->left_out);
	char shown[PM_NAME];
	pm_name_copy(shown, name);
	for (char *c = shown; *c; c++)
		*c = *c > ' ' && *c < 127 ? *c : '?';
	if (!strstr(r->left_out, shown))
		snprintf(r->left_out + n, sizeof r->left_out - n, "%s%s", n ? ", " : "", shown);
}

/* A field of `components` out of values that lie stride apart per particle, from `first` on. */
static int take(struct pm_frame *f, const char *set, const struct pm_nemo_item *item, const char *name, size_t first, int components, size_t stride)
{
	struct pm_field *p = pm_makes(f, set, name, components, PM_STATE);
	if (!p)
		return -PM_DATA;
	p->type = is_whole(item) ? PM_I64 : item->type == 'f' ? PM_F32 : PM_F64;
	p->extensive = !strcmp(name, "mass");
	if (pm_field_ready(p))
		return -PM_DATA;
	for (int c = 0; c < components; c++)
		for (size_t i = 0; i < p->count; i++)
			if (p->type == PM_I64)
				pm_out_i64(p, c)[i] = whole(item, i * stride + first + (size_t)c);
			else
				pm_out(p, c)[i] = real(item, i * stride + first + (size_t)c);
	p->use = 0;
	return 0;
}

struct body { /* what a snapshot holds */
	double time;
	uint64_t n; /* Nobj; 0 not said */
	int ndim;   /* of the positions */
	struct pm_nemo_item item[32];
	int items;
};

/* The items of one set; those of sets within are read by their name. */
static int collect(struct pm_nemo *r, struct body *b, bool particles, int depth)
{
	struct pm_nemo_item item;
	int status;
	if (depth > deepest)
		return damaged(r, "sets are nested too deep");
	while ((status = next(r, &item)) > 0 && item.type != ')' && item.type != ']') {
		const bool set = item.type == '(' || item.type == '[', inner = set && item.type == '(' && !strcmp(item.tag, "Particles");
		if (set && !inner && strcmp(item.tag, "Parameters"))
			leave_out(r, item.tag);
		if (set && (status = collect(r, b, inner, depth + 1)) < 0)
			return status;
		if (!set && !particles && is_whole(&item) && (!strcmp(item.tag, "Nobj") || !strcmp(item.tag, "NBody")))
			b->n = whole(&item, 0) > 0 ? (uint64_t)whole(&item, 0) : 0;
		else if (!set && !particles && is_real(&item) && !strcmp(item.tag, "Time"))
			b->time = real(&item, 0);
		else if (!set && particles && b->items < 32)
			b->item[b->items++] = item;
		else if (!set && particles)
			leave_out(r, item.tag);
	}
	return status < 0 ? status : status ? 0 : damaged(r, "it ends within a set");
}

static bool positions(const struct pm_nemo_item *item, int *ndim)
{
	const bool phase = !strcmp(item->tag, "PhaseSpace") && item->ndim == 3 && item->dim[1] == 2;
	const bool plain = !strcmp(item->tag, "Position") && item->ndim == 2;
	const uint64_t d = phase ? item->dim[2] : plain ? item->dim[1] : 0;
	if (is_real(item) && d >= 1 && d <= 3)
		*ndim = (int)d;
	return is_real(item) && d >= 1 && d <= 3;
}

static int item_take(struct pm_nemo *r, struct pm_frame *f, const char *set, const struct pm_nemo_item *item)
{
	static const char *const ours[][2] = {{"Position", "x"}, {"Velocity", "v"}, {"Mass", "mass"}, {"Key", "id"}, {NULL, NULL}};
	const size_t d = (size_t)f->dim, wide = item->ndim == 2 ? (size_t)item->dim[1] : 1;
	const char *name = item->tag;
	if (!strcmp(name, "CoordSystem"))
		return is_whole(item) && whole(item, 0) >> 16 != cartesian ? pm_fail(PM_DATA, "the coordinates are not cartesian") : 0;
	if ((!is_real(item) && !is_whole(item)) || !item->ndim || !*name)
		return leave_out(r, name), 0;
	if (item->dim[0] != f->sets[0]->n)
		return pm_fail(PM_DATA, "'%s' has %llu rows, but there are %llu particles", name, (unsigned long long)item->dim[0],
			(unsigned long long)f->sets[0]->n);
	if (!strcmp(name, "PhaseSpace") && item->ndim == 3 && item->dim[1] == 2 && item->dim[2] == d && is_real(item))
		return take(f, set, item, "x", 0, f->dim, 2 * d) ? -PM_DATA : take(f, set, item, "v", d, f->dim, 2 * d);
	for (int i = 0; ours[i][0]; i++)
		name = strcmp(name, ours[i][0]) ? name : ours[i][1];
	const bool vector = !strcmp(name, "x") || !strcmp(name, "v");
	if (item->ndim > 2 || wide > PM_COMPONENTS || (vector && (wide != d || !is_real(item))) || (!strcmp(name, "id") && !is_whole(item)) ||
		(!strcmp(name, "mass") && (!is_real(item) || wide != 1)))
		return leave_out(r, item->tag), 0;
	return take(f, set, item, name, 0, (int)wide, wide);
}

static int frame_of(struct pm_nemo *r, const struct body *b, const char *set, struct pm_frame **f)
{
	uint64_t n = b->n;
	int status = 0, ndim = 0;
	bool mass = false;
	for (int i = 0; i < b->items; i++) {
		if (positions(b->item + i, &ndim))
			n = n ? n : b->item[i].dim[0];
		if (!strcmp(b->item[i].tag, "Mass") && b->item[i].ndim == 1 && is_real(b->item + i))
			r->mass = b->item[i], mass = true;
	}
	if (!ndim) /* only diagnostics: no frame */
		return leave_out(r, "snapshots without positions"), 0;
	if (n > r->size || !isfinite(b->time))
		return pm_fail(PM_DATA, "a snapshot of %llu particles at time %g is not possible", (unsigned long long)n, b->time);
	if (!(*f = pm_frame_new(ndim)) || !pm_frame_set_new(*f, set, n))
		return -PM_DATA;
	(*f)->time = (*f)->start = b->time;
	for (int i = 0; i < b->items && !status; i++)
		status = item_take(r, *f, set, b->item + i);
	if (!status && !mass && r->mass.data && r->mass.dim[0] == n)
		status = item_take(r, *f, set, &r->mass);
	if (!status && (!pm_frame_field(*f, set, "x") || pm_frame_field(*f, set, "x")->type == PM_I64))
		status = pm_fail(PM_DATA, "a snapshot has no positions of %d components", ndim);
	return status ? status : 1;
}

int pm_nemo_next(struct pm_nemo *r, const char *set, struct pm_frame **f)
{
	struct pm_nemo_item item;
	int status;
	*f = NULL;
	while ((status = next(r, &item)) > 0) {
		struct body b = {.time = 0};
		const bool snapshot = item.type == '(' && !strcmp(item.tag, "SnapShot");
		if ((item.type == '(' || item.type == '[') && (status = collect(r, &b, false, 0)) < 0)
			return status;
		if (snapshot && (status = frame_of(r, &b, set, f)))
			return status < 0 ? (*f = pm_frame_free(*f), status) : status;
		if (!snapshot && strcmp(item.tag, "History") && strcmp(item.tag, "Headline"))
			leave_out(r, item.tag);
	}
	return status;
}
