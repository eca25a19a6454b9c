/* The reader of streams: an input is a stream (PMPIPE/...), or a header in JSON, a newline and bytes of data, of which a stream with the right sizes and
 * checksums is made, so that the fuzzer gets past these. What is read is written and read again: the header must be the same.
 * PM_UNSEALED=1 in the environment switches the checksums of lines off. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fuzz.h"
#include "stream/header.h"
#include "stream/run.h"
#include "stream/wire.h"

enum { most_data = 1 << 16, most_values = 1 << 16, most_frames = 8 }; /* bytes; values; what is more takes too long */

static size_t padded(size_t n) { return (n + PM_LINE - 1) / PM_LINE * PM_LINE; }

/* A text with blanks up to a multiple of 64 bytes, behind a line that announces it. payload < 0: there is none. */
static void block(FILE *out, const char *word, const char *text, size_t n, long long payload)
{
	char line[PM_LINE + 1];
	int used = payload < 0 ? snprintf(line, sizeof line, "PMPIPE/1 %s %zu", word, padded(n))
		: snprintf(line, sizeof line, "PMPIPE/1 %s %zu %lld", word, padded(n), payload);
	fprintf(out, "%s%*s\n%.*s%*s", line, PM_LINE - 1 - used, "", (int)n, text, (int)(padded(n) - n), "");
}

/* The data of the fields from the bytes, again and again, and their checksums. */
static void data_write(FILE *out, const struct pm_frame *f, const uint8_t *data, size_t n, char *tail, size_t room)
{
	static unsigned char field[most_data];
	size_t at = 0, used = (size_t)snprintf(tail, room, "{\"crc32c\":[");
	for (size_t i = 0; i < f->nfields && used + 16 < room; i++) {
		size_t bytes = pm_field_wire(f->fields[i]);
		memset(field, 0, padded(bytes));
		for (size_t k = 0; k < bytes && n; k++, at++)
			field[k] = data[at % n];
		fwrite(field, 1, padded(bytes), out);
		used += (size_t)snprintf(tail + used, room - used, "%s%u", i ? "," : "", pm_crc32c(0, field, bytes));
	}
	snprintf(tail + used, room - used, "]}");
}

/* A stream around the header; where the header is refused, that is all there is in it. */
static size_t stream_around(const uint8_t *data, size_t n, char **stream)
{
	size_t size = 0, total = 0;
	const uint8_t *end = memchr(data, '\n', n);
	size_t length = end ? (size_t)(end - data) : n;
	char tail[4096];
	struct pm_frame *f = NULL;
	FILE *out = open_memstream(stream, &size);
	json_t *header = json_loadb((const char *)data, length, JSON_REJECT_DUPLICATES, NULL);
	bool known = header && !pm_header_frame(header, &f);
	for (size_t i = 0; known && i < f->nfields; i++) {
		total += padded(pm_field_wire(f->fields[i]));
		known = total <= most_data;
	}
	block(out, "frame", (const char *)data, length, (long long)total);
	if (known) {
		data_write(out, f, data + length, n - length, tail, sizeof tail);
		block(out, "tail", tail, strlen(tail), -1);
		fprintf(out, "PMPIPE/1 end 1%*s\n", PM_LINE - 15, "");
	}
	fclose(out);
	json_decref(header);
	pm_frame_free(f);
	return size;
}

/* Expands what is uniform, as a word that reads every field does. */
static void expand(struct pm_frame *f)
{
	size_t values = 0;
	for (size_t i = 0; i < f->nfields && values < most_values; i++) {
		f->fields[i]->use |= PM_USE_READ;
		values += f->fields[i]->count < most_values ? f->fields[i]->count * (size_t)f->fields[i]->components : most_values;
	}
	if (!pm_frame_affordable(f) && values < most_values)
		pm_frame_ready(f);
	pm_frame_settle(f);
}

/* Writes the frame and reads it again. */
static void there_and_back(struct pm_frame *f)
{
	static int file = -1;
	struct pm_frame *again = NULL;
	fuzz_file(&file, "", 0);
	struct pm_writer *w = pm_writer_of_fd(dup(file));
	json_t *before = pm_header_json(f);
	int status = pm_write_frame(w, f) || pm_write_end(w);
	fuzz_must(!(pm_writer_close(w) || status), "what was read can be written");
	lseek(file, 0, SEEK_SET);
	struct pm_reader *r = pm_reader_of_fd(dup(file));
	fuzz_must(pm_read_frame(r, &again) == PM_GOT_FRAME, "what was written can be read");
	json_t *after = pm_header_json(again);
	fuzz_must(before && after && json_equal(before, after), "the header is the same");
	fuzz_must(json_equal(f->report, again->report), "the report is the same");
	json_decref(before), json_decref(after);
	pm_frame_free(again);
	pm_reader_close(r);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	static int file = -1;
	char *stream = NULL;
	struct pm_frame *f = NULL;
	if (n && *data == '{')
		n = stream_around(data, n, &stream);
	fuzz_file(&file, stream ? stream : (const char *)data, n);
	struct pm_reader *r = pm_reader_of_fd(dup(file));
	int got = PM_GOT_FRAME;
	for (int i = 0; i < most_frames && (got == PM_GOT_FRAME || got == PM_GOT_END); i++) {
		got = pm_read_frame(r, &f);
		if (got < 0)
			fuzz_refused();
		if (got != PM_GOT_FRAME)
			continue;
		there_and_back(f);
		expand(f);
		f = pm_frame_free(f);
	}
	pm_reader_close(r);
	free(stream);
	return 0;
}
