/* The reader in one header, lib/pmpipe-read.h: an input is a stream (PMPIPE/...), or a header in JSON, a newline and bytes of data, of which a stream with the
 * right sizes and checksums is made. Everything of a frame that is read is asked for. Needs nothing else of ours:
 * clang -g -O1 -fsanitize=fuzzer,address,undefined -Ilib -o pmpipe-read tests/fuzz/pmpipe-read.c
 * SPDX-License-Identifier: GPL-3.0-or-later */
#define PMR_MOST_EXPANDED (1 << 20)
#include "pmpipe-read.h"

enum { most_data = 1 << 16 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

/* What must be true whatever the input is. */
static void must(int true_, const char *what)
{
	if (true_)
		return;
	fprintf(stderr, "not true: %s\n", what);
	abort();
}

static size_t padded(size_t n) { return (n + 63) / 64 * 64; }

/* The text as a block behind its line; lines without checksums are of older versions. */
static void block(FILE *out, const char *word, const char *text, size_t n, long long payload)
{
	char line[65];
	int used = payload < 0 ? snprintf(line, sizeof line, "PMPIPE/1 %s %zu", word, padded(n + 1))
		: snprintf(line, sizeof line, "PMPIPE/1 %s %zu %lld", word, padded(n + 1), payload);
	fprintf(out, "%s%*s\n", line, 63 - used, "");
	fwrite(text, 1, n, out);
	fprintf(out, "%*s\n", (int)(padded(n + 1) - n - 1), "");
}

/* The sizes of the fields, as far as the header is good; false: it is not. */
static int sizes(struct pmr *r, const char *text, size_t n)
{
	r->header.text = (char *)malloc(n + 1);
	must(r->header.text != NULL, "there is memory");
	memcpy(r->header.text, text, n);
	r->header.text[n] = 0;
	r->header.size = n;
	if (!pmr_utf8((const unsigned char *)text, n) || pmr_peek(&r->header) != '{' || !pmr_value(&r->header, 0))
		return 0;
	pmr_header(r, 1); /* refused at the end, because no sum of sizes is 1 */
	return strstr(r->message, "other sizes of data") != NULL;
}

static size_t stream_around(const uint8_t *data, size_t n, char **stream)
{
	size_t size = 0, at = 0, used;
	const uint8_t *end = (const uint8_t *)memchr(data, '\n', n);
	size_t length = end ? (size_t)(end - data) : n;
	FILE *out = open_memstream(stream, &size);
	struct pmr *r = pmr_of(stdin);
	static char tail[1 << 16];
	static unsigned char field[most_data];
	uint64_t total = 0;
	must(out && r, "there is memory");
	int good = sizes(r, (const char *)data, length);
	for (size_t i = 0; good && i < r->nfields; i++)
		good = (total = r->fields[i].at + padded(r->fields[i].bytes)) <= most_data && r->nfields < 4096;
	block(out, "frame", (const char *)data, length, (long long)total);
	used = (size_t)snprintf(tail, sizeof tail, "{\"crc32c\":[");
	for (size_t i = 0; good && i < r->nfields; i++) {
		size_t bytes = (size_t)r->fields[i].bytes;
		memset(field, 0, padded(bytes));
		for (size_t k = 0; k < bytes && n > length; k++, at++)
			field[k] = data[length + at % (n - length)];
		fwrite(field, 1, padded(bytes), out);
		used += (size_t)snprintf(tail + used, sizeof tail - used, "%s%u", i ? "," : "", (unsigned)pmr_crc(r, 0, field, bytes));
	}
	used += (size_t)snprintf(tail + used, sizeof tail - used, "]}");
	if (good) {
		block(out, "tail", tail, used, -1);
		fprintf(out, "PMPIPE/1 end 1%*s\n", 63 - 14, "");
	}
	fclose(out);
	pmr_close(r);
	return size;
}

/* All of a frame. */
static void touch(struct pmr *r)
{
	double sum = pmr_number(r, "law/constants/G", 0) + pmr_number(r, "a//b", 0);
	for (size_t i = 0; i < r->nfields; i++) {
		struct pmr_field *f = r->fields + i;
		size_t n;
		const unsigned char *byte = (const unsigned char *)pmr_data(r, f->on, f->name, f->type, &n);
		size_t width = f->type[1] == '8' ? 1 : f->type[1] == '3' ? 4 : 8;
		must(pmr_owner(r, f->on) && pmr_owner(r, f->on)->n == f->n, "a field has an owner of its size");
		must(byte || f->uniform, "data that were read can be asked for");
		must(!byte || n == f->n, "their number is that of the header");
		for (size_t k = 0; byte && k < n * (size_t)f->components * width; k++)
			sum += byte[k];
	}
	must(sum == sum, "nothing made up a number that is not one");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	char *stream = NULL;
	if (n && *data == '{')
		n = stream_around(data, n, &stream);
	FILE *file = n ? fmemopen(stream ? (void *)stream : (void *)(uintptr_t)data, n, "rb") : fopen("/dev/null", "rb");
	struct pmr *r = pmr_of(file);
	must(file && r, "there is memory");
	int got;
	while ((got = pmr_next(r)) > 0)
		touch(r);
	must((got == 0) == (pmr_code(r) == 0) && (got == 0 || (*pmr_message(r) && pmr_next(r) < 0)), "a failure has a code, a message, and stays");
	must(!strpbrk(pmr_message(r), "\n\r\033"), "a message is one line");
	pmr_close(r);
	free(stream);
	return 0;
}
