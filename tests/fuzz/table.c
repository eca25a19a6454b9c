/* What stab reads: snapshots of NEMO, plain tables, and frames that stab wrote. What is read as text is written as text and read again: the second text must be
 * the first. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fuzz.h"
#include "nemo/nemo.h"
#include "stream/columns.h"
#include "stream/header.h"
#include "stream/text.h"

enum { most_frames = 8 };

static char *text_of(struct pm_frame *f)
{
	char *text = NULL;
	size_t n = 0;
	FILE *out = open_memstream(&text, &n);
	int status = pm_text_frame_write(out, f);
	fclose(out);
	if (status)
		text[0] = 0;
	return text;
}

static void there_and_back(struct pm_frame *f)
{
	struct pm_frame *again = NULL;
	uint64_t frames = 0;
	char *first = text_of(f), *second = NULL;
	struct pm_text t = {.data = first, .size = strlen(first), .line = 1};
	if (*first) { /* more columns than a table may have are refused */
		fuzz_must(pm_text_frame_read(&t, &again, &frames) == 1, "what was written can be read");
		second = text_of(again);
		fuzz_must(!strcmp(first, second), "the text is the same");
	}
	pm_frame_free(again);
	free(first), free(second);
}

static void plain(struct pm_text *t)
{
	static const char *const skip[] = {"skip", NULL}, *const text[] = {"label", NULL}, *const strength[] = {"weight", NULL};
	const struct pm_columns_choice choice = {.set = "matter", .skip = skip, .text = text, .strength = strength, .number = t->size % 2};
	struct pm_frame *f = NULL;
	if (pm_columns_frame(t, &choice, &f))
		fuzz_refused();
	else {
		pm_columns_box(f, "matter");
		json_t *header = pm_header_json(f);
		if (header) /* a box beyond the largest number is refused */
			there_and_back(f);
		json_decref(header);
	}
	pm_frame_free(f);
}

static void nemo(const struct pm_text *t)
{
	struct pm_nemo r = {.data = t->data, .size = t->size};
	struct pm_frame *f = NULL;
	int got;
	while ((got = pm_nemo_next(&r, "matter", &f)) == 1) {
		pm_columns_box(f, "matter");
		pm_frame_free(f);
	}
	if (got < 0)
		fuzz_refused();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	uint64_t frames = 0;
	struct pm_text t = {.data = fuzz_text(data, n), .size = n, .line = 1};
	char *text = t.data;
	if (pm_nemo_is(t.data, t.size))
		nemo(&t);
	else if (!pm_text_is_frames(&t))
		plain(&t);
	else
		for (int i = 0, got = 1; i < most_frames && got == 1; i++) {
			struct pm_frame *f = NULL;
			got = pm_text_frame_read(&t, &f, &frames);
			if (got < 0)
				fuzz_refused();
			if (got == 1)
				there_and_back(f);
			pm_frame_free(f);
		}
	free(text);
	return 0;
}
