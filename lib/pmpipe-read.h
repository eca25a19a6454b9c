/* pmpipe-read.h: reads streams of pmpipe (docs/stream.md). One file, C99 or C++, nothing but libc; the rest of the library is not needed.
 *
 *	struct pmr *r = pmr_open("run.pm");              // NULL: standard input
 *	while (pmr_next(r) > 0) {
 *		size_t n;
 *		const double *x = pmr_f64(r, "matter", "x", &n);  // component c of particle i is x[c * n + i]
 *		...
 *	}
 *	if (pmr_code(r)) fprintf(stderr, "%s\n", pmr_message(r));
 *	pmr_close(r);
 *
 * One frame is held at a time. Its sizes, names and references, the padding, and every checksum are checked before pmr_next returns it; memory for data is
 * taken as they arrive, so a header that lies costs nothing. Little-endian machines only. PM_UNSEALED=1 in the environment admits any checksum of a line.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PMPIPE_READ_H
#define PMPIPE_READ_H

#include <locale.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef PMR_MOST_EXPANDED
#define PMR_MOST_EXPANDED ((uint64_t)1 << 32) /* bytes of a uniform field that pmr_f64 and the like write out */
#endif

enum { PMR_TEXT = 16 << 20, PMR_NAME = 64, PMR_COMPONENTS = 16, PMR_OBJECTS = 4096, PMR_KEYS = 512, PMR_DEPTH = 2000, PMR_DIGITS = 4000 };

struct pmr_owner { /* a particle set or a mesh */
	char name[PMR_NAME];
	int mesh;
	uint64_t n;         /* particles, or points of the mesh */
	uint64_t points[3]; /* of a mesh, per axis; 1 above the frame's dim */
	double lo[3], h[3]; /* [length]: point i of an axis is at lo + i h */
};

struct pmr_field {
	char name[PMR_NAME], on[PMR_NAME], unit[PMR_NAME];
	char type[4]; /* f64, f32, i64, u8 */
	int components, uniform;
	double value[PMR_COMPONENTS]; /* of a uniform field */
	uint64_t n;                   /* values per component; of a mesh x is fastest */
	uint64_t bytes, at;           /* in the stream; where, from the first byte of the data */
	void *expanded;               /* of a uniform field, when it was asked for */
};

struct pmr_token { /* of JSON: { [ " 0 (a number) t f n; the members of an object are keys and values in turn */
	char kind;
	size_t from, to, after; /* its text; the index of the token behind all that is in it */
};

struct pmr_json {
	char *text;
	struct pmr_token *tokens;
	size_t size, at, count, room;
};

struct pmr {
	FILE *file;
	int code, dim, inside, any;      /* exit status, 0 good; dimensions of the frame; between the first frame and the end; anything read */
	uint64_t frames, frame;          /* of this stream; the number of the frame, from 1 */
	double time, dt, step, lo[3], hi[3];
	char law[PMR_NAME], message[256];
	size_t nowners, nfields;
	struct pmr_owner *owners;
	struct pmr_field *fields;
	unsigned char *data;
	struct pmr_json header, tail;
	uint32_t table[256], crc, seal;  /* of the last line: its words; the checksum it has */
	int sealed, line;                /* of the last line; f, t, e or a */
	uint64_t number[2];
};

static inline int pmr_fail(struct pmr *r, int code, const char *format, ...)
{
	va_list list;
	va_start(list, format);
	vsnprintf(r->message, sizeof r->message, format, list);
	va_end(list);
	r->code = code;
	return -1;
}

static inline uint32_t pmr_crc(const struct pmr *r, uint32_t c, const void *data, uint64_t n)
{
	const unsigned char *byte = (const unsigned char *)data;
	for (c = ~c; n; n--)
		c = c >> 8 ^ r->table[(c ^ *byte++) & 255];
	return ~c;
}

static inline int pmr_get(struct pmr *r, void *to, size_t n, const char *where)
{
	return fread(to, 1, n, r->file) == n ? 0 : pmr_fail(r, 1, "the input ends in %s: it was cut", where);
}

/* n bytes, in memory that grows as they arrive; a zero byte behind them. NULL on failure. */
static inline char *pmr_take(struct pmr *r, uint64_t n, const char *where)
{
	size_t have = 0, room = n < 1 << 20 ? (size_t)n : 1 << 20;
	char *to = (char *)malloc(room + 1);
	while (to && have < n) {
		if (have == room) {
			room = n - room < room ? (size_t)n : 2 * room;
			char *more = (char *)realloc(to, room + 1);
			if (!more)
				free(to);
			to = more;
		}
		if (to && pmr_get(r, to + have, room - have, where)) {
			free(to);
			return NULL;
		}
		have = room;
	}
	if (!to)
		pmr_fail(r, 1, "out of memory in %s", where);
	else
		to[n] = 0;
	return to;
}

/* ---- JSON: checked as a whole, then looked into ---- */

static inline int pmr_utf8(const unsigned char *s, size_t n)
{
	for (size_t i = 0; i < n;) {
		unsigned c = s[i], more = c < 0x80 ? 0 : c < 0xC2 ? 9 : c < 0xE0 ? 1 : c < 0xF0 ? 2 : c < 0xF5 ? 3 : 9;
		if (more > 3 || n - i <= more)
			return 0;
		unsigned second = more ? s[i + 1] : 0;
		if ((c == 0xE0 && second < 0xA0) || (c == 0xED && second > 0x9F) || (c == 0xF0 && second < 0x90) || (c == 0xF4 && second > 0x8F))
			return 0;
		for (i++; more; more--, i++)
			if ((s[i] & 0xC0) != 0x80)
				return 0;
	}
	return 1;
}

static inline struct pmr_token *pmr_token_new(struct pmr_json *j, char kind)
{
	if (j->count == j->room) {
		size_t room = j->room ? 2 * j->room : 256;
		struct pmr_token *more = (struct pmr_token *)realloc(j->tokens, room * sizeof *more);
		if (!more)
			return NULL;
		j->tokens = more, j->room = room;
	}
	struct pmr_token *t = j->tokens + j->count++;
	t->kind = kind, t->from = t->to = j->at, t->after = j->count;
	return t;
}

static inline char pmr_peek(struct pmr_json *j)
{
	while (j->at < j->size && strchr(" \t\r\n", j->text[j->at]) && j->text[j->at])
		j->at++;
	return j->at < j->size ? j->text[j->at] : 0;
}

/* Four hex digits; -1: they are not. */
static inline long pmr_hex(const char *s)
{
	char digits[5] = {0};
	memcpy(digits, s, 4);
	return strspn(digits, "0123456789abcdefABCDEF") == 4 ? strtol(digits, NULL, 16) : -1;
}

static inline int pmr_string(struct pmr_json *j)
{
	struct pmr_token *t;
	j->at++;
	t = pmr_token_new(j, '"');
	for (; t && j->at < j->size; j->at++) {
		const char *s = j->text + j->at;
		long u, low;
		if (*s == '"') {
			t->to = j->at++;
			return 1;
		}
		if ((unsigned char)*s < 0x20)
			return 0;
		if (*s != '\\')
			continue;
		j->at++;
		if (j->at < j->size && s[1] && strchr("\"\\/bfnrt", s[1]))
			continue;
		if (j->size - j->at < 5 || s[1] != 'u' || (u = pmr_hex(s + 2)) <= 0 || (u >= 0xDC00 && u < 0xE000))
			return 0;
		j->at += 4;
		if (u < 0xD800 || u >= 0xDC00)
			continue;
		if (j->size - j->at < 7 || s[6] != '\\' || s[7] != 'u' || (low = pmr_hex(s + 8)) < 0xDC00 || low > 0xDFFF)
			return 0;
		j->at += 6;
	}
	return 0;
}

/* strtod reads the locale's decimal point. */
static inline double pmr_double(const char *s, size_t n)
{
	char copy[PMR_DIGITS], *point;
	if (n >= sizeof copy)
		n = sizeof copy - 1;
	memcpy(copy, s, n);
	copy[n] = 0;
	point = strchr(copy, '.');
	if (point && strlen(localeconv()->decimal_point) == 1)
		*point = *localeconv()->decimal_point;
	return strtod(copy, NULL);
}

static inline int pmr_digits(struct pmr_json *j)
{
	size_t n = strspn(j->text + j->at, "0123456789");
	j->at += n;
	return n > 0;
}

static inline int pmr_real(struct pmr_json *j)
{
	struct pmr_token *t = pmr_token_new(j, '0');
	if (!t)
		return 0;
	j->at += j->text[j->at] == '-';
	if (j->text[j->at] == '0')
		j->at++;
	else if (!pmr_digits(j))
		return 0;
	if (j->text[j->at] == '.') {
		j->at++;
		if (!pmr_digits(j))
			return 0;
	}
	if (j->text[j->at] == 'e' || j->text[j->at] == 'E') {
		j->at++;
		j->at += j->text[j->at] == '+' || j->text[j->at] == '-';
		if (!pmr_digits(j))
			return 0;
	}
	t->to = j->at;
	if (t->to - t->from >= PMR_DIGITS)
		return 0;
	double value = pmr_double(j->text + t->from, t->to - t->from);
	return value - value == 0; /* not too large */
}

static inline int pmr_literal(struct pmr_json *j, const char *word)
{
	size_t n = strlen(word);
	if (j->size - j->at < n || memcmp(j->text + j->at, word, n) || !pmr_token_new(j, *word))
		return 0;
	j->at += n;
	return 1;
}

/* No key occurs twice. */
static inline int pmr_keys(const struct pmr_json *j, size_t object)
{
	size_t keys[PMR_KEYS], n = 0;
	for (size_t k = object + 1; k < j->tokens[object].after; k = j->tokens[k + 1].after) {
		const struct pmr_token *a = j->tokens + k;
		for (size_t i = 0; i < n; i++) {
			const struct pmr_token *b = j->tokens + keys[i];
			if (a->to - a->from == b->to - b->from && !memcmp(j->text + a->from, j->text + b->from, a->to - a->from))
				return 0;
		}
		if (n == PMR_KEYS)
			return 0;
		keys[n++] = k;
	}
	return 1;
}

static inline int pmr_value(struct pmr_json *j, int depth)
{
	char c = pmr_peek(j), end = c == '{' ? '}' : ']';
	if (c == '"')
		return pmr_string(j);
	if (c == '-' || (c >= '0' && c <= '9'))
		return pmr_real(j);
	if (c != '{' && c != '[')
		return pmr_literal(j, c == 't' ? "true" : c == 'f' ? "false" : "null");
	size_t self = j->count;
	if (depth == PMR_DEPTH || !pmr_token_new(j, c))
		return 0;
	j->at++;
	for (int first = 1; pmr_peek(j) != end; first = 0) {
		if (!first) {
			if (pmr_peek(j) != ',')
				return 0;
			j->at++;
		}
		if (c == '{') {
			if (pmr_peek(j) != '"' || !pmr_string(j) || pmr_peek(j) != ':')
				return 0;
			j->at++;
		}
		if (!pmr_value(j, depth + 1))
			return 0;
	}
	j->at++;
	j->tokens[self].after = j->count;
	return c == '[' || pmr_keys(j, self);
}

/* The value of a key of an object, 0: there is none (no member is token 0). */
static inline size_t pmr_find(const struct pmr_json *j, size_t object, const char *key, size_t n)
{
	if (!j->count || j->tokens[object].kind != '{')
		return 0;
	for (size_t k = object + 1; k < j->tokens[object].after; k = j->tokens[k + 1].after)
		if (j->tokens[k].to - j->tokens[k].from == n && !memcmp(j->text + j->tokens[k].from, key, n))
			return k + 1;
	return 0;
}

static inline size_t pmr_key(const struct pmr_json *j, size_t object, const char *key) { return pmr_find(j, object, key, strlen(key)); }

/* Element i of an array, 0: there is none. */
static inline size_t pmr_element(const struct pmr_json *j, size_t array, size_t i)
{
	if (!array || j->tokens[array].kind != '[')
		return 0;
	size_t k = array + 1;
	while (k < j->tokens[array].after && i--)
		k = j->tokens[k].after;
	return k < j->tokens[array].after ? k : 0;
}

static inline size_t pmr_length(const struct pmr_json *j, size_t array)
{
	size_t n = 0;
	for (size_t k = array + 1; k < j->tokens[array].after; k = j->tokens[k].after)
		n++;
	return n;
}

static inline int pmr_is(const struct pmr_json *j, size_t token, const char *text)
{
	const struct pmr_token *t = j->tokens + token;
	return token && t->kind == '"' && t->to - t->from == strlen(text) && !memcmp(j->text + t->from, text, t->to - t->from);
}

static inline int pmr_as_double(const struct pmr_json *j, size_t token, double *out)
{
	if (!token || j->tokens[token].kind != '0')
		return 0;
	*out = pmr_double(j->text + j->tokens[token].from, j->tokens[token].to - j->tokens[token].from);
	return 1;
}

static inline int pmr_as_count(const struct pmr_json *j, size_t token, uint64_t most, uint64_t *out)
{
	const struct pmr_token *t = j->tokens + token;
	*out = 0;
	if (!token || t->kind != '0' || t->to - t->from > 19)
		return 0;
	for (size_t i = t->from; i < t->to; i++) {
		if (j->text[i] < '0' || j->text[i] > '9')
			return 0;
		*out = 10 * *out + (uint64_t)(j->text[i] - '0');
	}
	return *out <= most;
}

/* A name of up to 63 bytes, escapes resolved. */
static inline int pmr_as_name(const struct pmr_json *j, size_t token, int empty, char out[PMR_NAME])
{
	const struct pmr_token *t = j->tokens + token;
	size_t n = 0;
	if (!token || t->kind != '"')
		return 0;
	for (size_t i = t->from; i < t->to; i++) {
		unsigned char unit[4] = {(unsigned char)j->text[i]};
		size_t units = 1;
		if (unit[0] == '\\' && j->text[++i] != 'u') {
			const char *from = "bfnrt", *at = strchr(from, j->text[i]);
			unit[0] = (unsigned char)(at ? "\b\f\n\r\t"[at - from] : j->text[i]);
		} else if (unit[0] == '\\') {
			unsigned long u = (unsigned long)pmr_hex(j->text + i + 1);
			i += 4;
			if (u >= 0xD800 && u < 0xDC00) {
				u = 0x10000 + ((u - 0xD800) << 10) + ((unsigned long)pmr_hex(j->text + i + 3) - 0xDC00);
				i += 6;
			}
			units = u < 0x80 ? 1 : u < 0x800 ? 2 : u < 0x10000 ? 3 : 4;
			for (size_t k = units; k-- > 1; u >>= 6)
				unit[k] = (unsigned char)(0x80 | (u & 0x3F));
			unit[0] = (unsigned char)(units == 1 ? u : units == 2 ? 0xC0 | u : units == 3 ? 0xE0 | u : 0xF0 | u);
		}
		if (n + units >= PMR_NAME)
			return 0;
		memcpy(out + n, unit, units);
		n += units;
	}
	out[n] = 0;
	return n || empty;
}

/* ---- The header of a frame ---- */

static inline int pmr_wrong(struct pmr *r, const char *what) { return pmr_fail(r, 1, "the header is wrong: %s", what); }

static inline int pmr_reals(const struct pmr_json *j, size_t array, int n, double *out)
{
	if (!array || j->tokens[array].kind != '[' || pmr_length(j, array) != (size_t)n)
		return 0;
	for (int i = 0; i < n; i++)
		if (!pmr_as_double(j, pmr_element(j, array, (size_t)i), out + i))
			return 0;
	return 1;
}

static inline const struct pmr_owner *pmr_owner(const struct pmr *r, const char *name)
{
	for (size_t i = 0; i < r->nowners; i++)
		if (!strcmp(r->owners[i].name, name))
			return r->owners + i;
	return NULL;
}

static inline int pmr_mesh(struct pmr *r, size_t t, const int periodic[3], struct pmr_owner *o)
{
	const struct pmr_json *j = &r->header;
	double cells[3], points = 1;
	o->mesh = 1;
	if (!pmr_reals(j, pmr_key(j, t, "cells"), r->dim, cells) || !pmr_reals(j, pmr_key(j, t, "lo"), r->dim, o->lo) ||
		!pmr_reals(j, pmr_key(j, t, "h"), r->dim, o->h))
		return pmr_wrong(r, "a mesh has no cells, lo or h per axis");
	for (int a = 0; a < r->dim; a++) {
		if (!(cells[a] >= 1 && cells[a] <= 2147483648.0) || cells[a] != (double)(uint64_t)cells[a] || !(o->h[a] > 0))
			return pmr_wrong(r, "a mesh has an invalid number of cells or spacing");
		o->points[a] = (uint64_t)cells[a] + !periodic[a];
		points *= cells[a] + 1;
	}
	if (points > 281474976710656.0)
		return pmr_wrong(r, "a mesh has too many points");
	o->n = o->points[0] * o->points[1] * o->points[2];
	return 0;
}

static inline int pmr_owners(struct pmr *r, const int periodic[3])
{
	const struct pmr_json *j = &r->header;
	size_t sets = pmr_key(j, 0, "sets"), meshes = pmr_key(j, 0, "meshes");
	if (!sets || !meshes || j->tokens[sets].kind != '[' || j->tokens[meshes].kind != '[')
		return pmr_wrong(r, "no lists of sets and meshes");
	size_t nsets = pmr_length(j, sets), all = nsets + pmr_length(j, meshes);
	if (nsets > PMR_OBJECTS || all - nsets > PMR_OBJECTS)
		return pmr_wrong(r, "too many sets or meshes");
	r->owners = (struct pmr_owner *)calloc(all + 1, sizeof *r->owners);
	if (!r->owners)
		return pmr_fail(r, 1, "out of memory");
	for (size_t i = 0, t = sets + 1; i < all; i++, t = j->tokens[t].after) {
		struct pmr_owner *o = r->owners + i;
		if (i == nsets)
			t = meshes + 1;
		for (int a = 0; a < 3; a++)
			o->points[a] = 1, o->h[a] = 1;
		if (!pmr_as_name(j, pmr_key(j, t, "name"), 0, o->name) || pmr_owner(r, o->name))
			return pmr_wrong(r, "a set or mesh has no name of its own");
		if (i >= nsets ? pmr_mesh(r, t, periodic, o) : !pmr_as_count(j, pmr_key(j, t, "n"), (uint64_t)1 << 48, &o->n))
			return r->code ? -1 : pmr_wrong(r, "a set has no number of particles in its range");
		r->nowners++;
	}
	return 0;
}

static inline const struct pmr_field *pmr_field(const struct pmr *r, const char *on, const char *name)
{
	for (size_t i = 0; i < r->nfields; i++)
		if (!strcmp(r->fields[i].name, name) && !strcmp(r->fields[i].on, on))
			return r->fields + i;
	return NULL;
}

static inline int pmr_field_read(struct pmr *r, size_t t, struct pmr_field *f)
{
	static const char types[4][4] = {"f64", "f32", "i64", "u8"};
	static const unsigned char sizes[4] = {8, 4, 8, 1};
	const struct pmr_json *j = &r->header;
	uint64_t components;
	size_t unit = pmr_key(j, t, "unit"), uniform = pmr_key(j, t, "uniform");
	const struct pmr_owner *o;
	int k = 0;
	if (!pmr_as_name(j, pmr_key(j, t, "name"), 0, f->name) || !pmr_as_name(j, pmr_key(j, t, "on"), 0, f->on) || (unit && !pmr_as_name(j, unit, 1, f->unit)))
		return pmr_wrong(r, "a field has no name, owner or unit of up to 63 bytes");
	o = pmr_owner(r, f->on);
	if (!o || pmr_field(r, f->on, f->name))
		return pmr_wrong(r, "a field belongs to nothing, or is there twice");
	while (k < 4 && !pmr_is(j, pmr_key(j, t, "type"), types[k]))
		k++;
	if (k == 4 || !pmr_as_count(j, pmr_key(j, t, "components"), PMR_COMPONENTS, &components) || !components)
		return pmr_wrong(r, "a field has a type or a number of components that does not exist");
	memcpy(f->type, types[k], 4);
	f->components = (int)components, f->n = o->n, f->uniform = uniform != 0;
	if (uniform && !pmr_reals(j, uniform, f->components, f->value))
		return pmr_wrong(r, "a uniform field has not one number per component");
	f->bytes = uniform ? 0 : f->n * components * sizes[k]; /* below 2^48 * 16 * 8 */
	return 0;
}

static inline int pmr_fields(struct pmr *r, uint64_t payload)
{
	const struct pmr_json *j = &r->header;
	size_t list = pmr_key(j, 0, "fields"), n = list && j->tokens[list].kind == '[' ? pmr_length(j, list) : PMR_OBJECTS + 1;
	uint64_t at = 0;
	if (n > PMR_OBJECTS)
		return pmr_wrong(r, "no list of fields, or too many");
	r->fields = (struct pmr_field *)calloc(n + 1, sizeof *r->fields);
	if (!r->fields)
		return pmr_fail(r, 1, "out of memory");
	for (size_t i = 0, t = list + 1; i < n; i++, t = j->tokens[t].after) {
		struct pmr_field *f = r->fields + i;
		if (pmr_field_read(r, t, f))
			return -1;
		r->nfields++;
		f->at = at;
		if (at + (f->bytes + 63) / 64 * 64 < at)
			return pmr_wrong(r, "the fields are too large");
		at += (f->bytes + 63) / 64 * 64;
	}
	return at == payload ? 0 : pmr_wrong(r, "it describes other sizes of data than its line announces");
}

static inline int pmr_header(struct pmr *r, uint64_t payload)
{
	const struct pmr_json *j = &r->header;
	size_t order = pmr_key(j, 0, "byte_order"), box = pmr_key(j, 0, "box"), faces = box ? pmr_key(j, box, "fields") : 0, law = pmr_key(j, 0, "law");
	uint64_t dim;
	int periodic[3] = {0, 0, 0};
	if (order && !pmr_is(j, order, "little"))
		return pmr_wrong(r, "byte_order is not little");
	if (!pmr_as_count(j, pmr_key(j, 0, "dim"), 3, &dim) || !dim)
		return pmr_wrong(r, "dim is not 1, 2 or 3");
	r->dim = (int)dim;
	if (!pmr_as_double(j, pmr_key(j, 0, "time"), &r->time) || !pmr_as_double(j, pmr_key(j, 0, "dt"), &r->dt) ||
		!pmr_as_double(j, pmr_key(j, 0, "step"), &r->step) || !law || !pmr_as_name(j, pmr_key(j, law, "name"), 1, r->law))
		return pmr_wrong(r, "time, dt, step or the name of the law is missing");
	if (!box || !pmr_reals(j, pmr_key(j, box, "lo"), r->dim, r->lo) || !pmr_reals(j, pmr_key(j, box, "hi"), r->dim, r->hi))
		return pmr_wrong(r, "the box has no lo and hi per axis");
	for (int a = 0; a < r->dim; a++) {
		size_t pair = pmr_element(j, faces, (size_t)a);
		periodic[a] = pmr_is(j, pmr_element(j, pair, 0), "periodic");
		if (!pmr_element(j, pair, 1) || periodic[a] != pmr_is(j, pmr_element(j, pair, 1), "periodic") || !(r->hi[a] > r->lo[a]))
			return pmr_wrong(r, "the box has no pair of faces per axis, or no extent");
	}
	return pmr_owners(r, periodic) || pmr_fields(r, payload) ? -1 : 0;
}

/* ---- Lines, blocks, frames ---- */

/* 1: a line, 0: end of file, -1: failure. */
static inline int pmr_line(struct pmr *r)
{
	static const char words[4][6] = {"frame", "tail", "end", "abort"};
	static const int numbers[4] = {2, 1, 1, 2};
	char text[65], *at = text + 9, *end = text + 63;
	size_t got = fread(text, 1, 64, r->file);
	int kind = 0;
	if (got == 0 && !ferror(r->file) && r->any && !r->inside)
		return 0;
	if (got < 64)
		return pmr_fail(r, 1, got || r->any ? "the input ends without an end marker: it was cut" : "zero bytes are not a stream");
	r->any = 1;
	text[64] = 0;
	if (memcmp(text, "PMPIPE/", 7))
		return pmr_fail(r, 1, "this is not a stream of pmpipe");
	if (memcmp(text, "PMPIPE/1 ", 9))
		return pmr_fail(r, 1, "the stream is of a version that this reader does not know");
	if (text[63] != '\n')
		return pmr_fail(r, 1, "a line of the stream is damaged");
	while (end[-1] == ' ')
		end--;
	*end = 0;
	while (kind < 4 && (strncmp(at, words[kind], strlen(words[kind])) || at[strlen(words[kind])] != ' '))
		kind++;
	if (kind == 4)
		return pmr_fail(r, 1, "a line of the stream is damaged");
	at += strlen(words[kind]);
	for (int i = 0; i < numbers[kind]; i++) {
		size_t digits = strspn(at + (*at == ' '), "0123456789");
		if (*at != ' ' || !digits || digits > 18)
			return pmr_fail(r, 1, "a line of the stream is damaged");
		r->number[i] = strtoull(at + 1, NULL, 10);
		at += 1 + digits;
	}
	r->line = words[kind][0];
	r->crc = pmr_crc(r, 0, text, (uint64_t)(at - text));
	r->sealed = at != end;
	if (r->sealed && (*at != ' ' || end - at != 9 || strspn(at + 1, "0123456789abcdef") != 8))
		return pmr_fail(r, 1, "a line of the stream is damaged");
	r->seal = r->sealed ? (uint32_t)strtoul(at + 1, NULL, 16) : 0;
	return 1;
}

static inline int pmr_sealed(struct pmr *r, const void *block, uint64_t n, const char *what)
{
	const char *unsealed = getenv("PM_UNSEALED");
	if (!r->sealed || pmr_crc(r, r->crc, block, n) == r->seal || (unsealed && !strcmp(unsealed, "1")))
		return 0;
	return pmr_fail(r, 1, "the checksum of %s is wrong: it is damaged", what);
}

static inline char *pmr_block(struct pmr *r, uint64_t n, const char *what)
{
	char *text = NULL;
	if (n > PMR_TEXT || n % 64)
		pmr_fail(r, 1, "%s is not a multiple of 64 bytes up to 16 MiB", what);
	else
		text = pmr_take(r, n, what);
	if (text && pmr_sealed(r, text, n, what)) {
		free(text);
		text = NULL;
	}
	return text;
}

static inline int pmr_abort(struct pmr *r)
{
	int code = r->number[0] >= 1 && r->number[0] <= 3 ? (int)r->number[0] : 1;
	uint64_t n = r->number[1];
	char *text = pmr_block(r, n, "an abort message");
	if (!text)
		return -1;
	for (uint64_t i = 0; i < n; i++)
		if ((unsigned char)text[i] < 0x20 || text[i] == 0x7F)
			text[i] = ' ';
	while (n && text[n - 1] == ' ')
		n--;
	text[n] = 0;
	pmr_fail(r, code, "%s", n ? text : "the stream was aborted without a reason");
	free(text);
	return -1;
}

static inline int pmr_json(struct pmr *r, struct pmr_json *j, const char *what)
{
	uint64_t n = r->number[0];
	j->text = pmr_block(r, n, what);
	if (!j->text)
		return -1;
	size_t size = (size_t)n;
	int padded = size && j->text[--size] == '\n';
	while (size && j->text[size - 1] == ' ')
		size--;
	j->size = size;
	if (!padded || !size || (unsigned char)j->text[size - 1] < 0x20 || !pmr_utf8((const unsigned char *)j->text, size) || pmr_peek(j) != '{' ||
		!pmr_value(j, 0) || pmr_peek(j) || j->at != size)
		return pmr_fail(r, 1, "%s is not JSON, padded with spaces and a newline: it is damaged", what);
	return 0;
}

static inline void pmr_forget(struct pmr *r)
{
	for (size_t i = 0; i < r->nfields; i++)
		free(r->fields[i].expanded);
	free(r->fields), free(r->owners), free(r->data);
	free(r->header.text), free(r->header.tokens), free(r->tail.text), free(r->tail.tokens);
	memset(&r->header, 0, sizeof r->header), memset(&r->tail, 0, sizeof r->tail);
	r->fields = NULL, r->owners = NULL, r->data = NULL, r->nfields = r->nowners = 0;
}

static inline int pmr_tail(struct pmr *r)
{
	const struct pmr_json *j = &r->tail;
	int got = pmr_line(r);
	if (got <= 0)
		return got ? -1 : pmr_fail(r, 1, "the input ends in a tail: it was cut");
	if (r->line == 'a')
		return pmr_abort(r);
	if (r->line != 't')
		return pmr_fail(r, 1, "the tail of the frame is missing");
	if (pmr_json(r, &r->tail, "a tail"))
		return -1;
	size_t sums = pmr_key(j, 0, "crc32c");
	if (!sums || j->tokens[sums].kind != '[' || pmr_length(j, sums) != r->nfields)
		return pmr_fail(r, 1, "the tail does not fit the fields of the frame");
	for (size_t i = 0, t = sums + 1; i < r->nfields; i++, t = j->tokens[t].after) {
		const struct pmr_field *f = r->fields + i;
		uint64_t sum;
		if (!pmr_as_count(j, t, 0xFFFFFFFF, &sum) || sum != pmr_crc(r, 0, r->data + f->at, f->bytes))
			return pmr_fail(r, 1, "the checksum of field '%s' on '%s' is wrong: the data are damaged", f->name, f->on);
		for (uint64_t k = f->bytes; k % 64; k++)
			if (r->data[f->at + k])
				return pmr_fail(r, 1, "the bytes behind field '%s' on '%s' are not zero: the data are damaged", f->name, f->on);
	}
	return 0;
}

/* ---- What a program calls ---- */

/* Reads from a file that is open, which pmr_close closes (unless it is standard input). NULL without memory, or on a big-endian machine. */
static inline struct pmr *pmr_of(FILE *file)
{
	const uint16_t one = 1;
	struct pmr *r = *(const unsigned char *)&one ? (struct pmr *)calloc(1, sizeof *r) : NULL;
	for (uint32_t i = 0; r && i < 256; i++) {
		uint32_t c = i;
		for (int bit = 0; bit < 8; bit++)
			c = c >> 1 ^ (c & 1 ? 0x82F63B78u : 0);
		r->table[i] = c;
	}
	if (r)
		r->file = file;
	return r;
}

/* Opens a file; NULL: standard input. NULL is returned, and errno set, if it cannot be opened. */
static inline struct pmr *pmr_open(const char *path)
{
	FILE *file = path ? fopen(path, "rb") : stdin;
	struct pmr *r = file ? pmr_of(file) : NULL;
	if (file && !r && path)
		fclose(file);
	return r;
}

static inline void pmr_close(struct pmr *r)
{
	if (!r)
		return;
	pmr_forget(r);
	if (r->file != stdin)
		fclose(r->file);
	free(r);
}

/* The next frame: 1, it is there, with all data checked; 0, the stream is at its end; -1, failure. What belonged to the last frame is gone. */
static inline int pmr_next(struct pmr *r)
{
	int got;
	if (r->code)
		return -1;
	pmr_forget(r);
	while ((got = pmr_line(r)) > 0 && r->line == 'e') {
		if (pmr_sealed(r, NULL, 0, "the end marker"))
			return -1;
		if (r->number[0] != r->frames)
			return pmr_fail(r, 1, "the end marker does not count the frames received");
		r->frames = 0, r->inside = 0;
	}
	if (got <= 0)
		return got;
	if (r->line == 'a')
		return pmr_abort(r);
	if (r->line != 'f')
		return pmr_fail(r, 1, "a tail without a frame");
	uint64_t payload = r->number[1];
	r->inside = 1, r->frames++, r->frame++;
	if (pmr_json(r, &r->header, "a header") || pmr_header(r, payload))
		return -1;
	r->data = (unsigned char *)pmr_take(r, payload, "the data");
	return !r->data || pmr_tail(r) ? -1 : 1;
}

static inline int pmr_code(const struct pmr *r) { return r->code; }               /* 0, or why pmr_next failed: 1 data, 2 usage, 3 numerics */
static inline const char *pmr_message(const struct pmr *r) { return r->message; } /* one line */

/* A number of the header by its path, "law/constants/G" or "substep"; otherwise, if it is not there. */
static inline double pmr_number(const struct pmr *r, const char *path, double otherwise)
{
	size_t at = 0;
	do {
		size_t n = strcspn(path, "/");
		at = pmr_find(&r->header, at, path, n);
		path += n + (path[n] == '/');
	} while (at && *path);
	pmr_as_double(&r->header, at, &otherwise);
	return otherwise;
}

/* The data of a field of that type: n values of component 0, then those of component 1 ...; NULL if there is no such field, it has another type, or it is
 * uniform and too large to be written out. Of a mesh n is the product of the points, x fastest. The frame owns them. */
static inline const void *pmr_data(struct pmr *r, const char *on, const char *name, const char *type, size_t *n)
{
	struct pmr_field *f = (struct pmr_field *)(uintptr_t)pmr_field(r, on, name);
	if (n)
		*n = 0;
	if (!f || strcmp(f->type, type))
		return NULL;
	const uint64_t size = type[1] == '8' ? 1 : type[1] == '3' ? 4 : 8, all = f->n * (uint64_t)f->components;
	if (f->uniform && !f->expanded) {
		if (all * size > PMR_MOST_EXPANDED || !(f->expanded = malloc((size_t)(all * size) + 1)))
			return NULL;
		for (uint64_t i = 0; i < all; i++) {
			const double v = f->value[i / f->n];
			const int whole = v >= -9223372036854775808.0 && v < 9223372036854775808.0;
			if (!strcmp(type, "f64"))
				((double *)f->expanded)[i] = v;
			else if (!strcmp(type, "f32"))
				((float *)f->expanded)[i] = (float)v;
			else if (!strcmp(type, "i64"))
				((int64_t *)f->expanded)[i] = whole ? (int64_t)v : 0;
			else
				((unsigned char *)f->expanded)[i] = v >= 0 && v < 256 ? (unsigned char)v : 0;
		}
	}
	if (n)
		*n = (size_t)f->n;
	return f->uniform ? f->expanded : r->data + f->at;
}

static inline const double *pmr_f64(struct pmr *r, const char *on, const char *name, size_t *n) { return (const double *)pmr_data(r, on, name, "f64", n); }
static inline const float *pmr_f32(struct pmr *r, const char *on, const char *name, size_t *n) { return (const float *)pmr_data(r, on, name, "f32", n); }
static inline const int64_t *pmr_i64(struct pmr *r, const char *on, const char *name, size_t *n) { return (const int64_t *)pmr_data(r, on, name, "i64", n); }
static inline const unsigned char *pmr_u8(struct pmr *r, const char *on, const char *name, size_t *n)
{
	return (const unsigned char *)pmr_data(r, on, name, "u8", n);
}

#endif
