/* Sentences of cycle: split into words, their options parsed, their words begun, and tried on the headers of two frames, without data.
 * An input may name any file, and none is opened: the linker puts the functions below in the place of the two that open files (--wrap in the Makefile).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/replace.h"
#include "fuzz.h"
#include "sentence/sentence.h"
#include "stage/h5-pipe.h"
#include "stream/declare.h"

int __wrap_pm_replace_open(struct pm_replace *r, const char *path, bool always);
struct pm_reader *__wrap_pm_h5_pipe_open(const char *path);

int __wrap_pm_replace_open(struct pm_replace *r, const char *path, bool always)
{
	(void)always;
	*r = (struct pm_replace){.fd = -1};
	return pm_fail(PM_DATA, "the fuzzer does not write '%s'", path);
}

struct pm_reader *__wrap_pm_h5_pipe_open(const char *path)
{
	pm_fail(PM_DATA, "the fuzzer does not read '%s'", path);
	return NULL;
}

/* A header with what most words need. */
static struct pm_frame *header_new(int dim, const char *law, const char *strength)
{
	static const char *const of_set[] = {"x", "v", "acc"}, *const of_mesh[] = {"rho", "phi", "g", "u", "omega"};
	const size_t cells[3] = {16, 8, 8};
	struct pm_frame *f = pm_frame_new(dim);
	snprintf(f->law, PM_NAME, "%s", law);
	f->dt = 0.1;
	pm_frame_constant_set(f, "G", 1);
	pm_frame_set_new(f, "matter", 100);
	pm_frame_mesh_new(f, "mesh", cells);
	for (size_t i = 0; i < sizeof of_set / sizeof *of_set; i++)
		pm_makes(f, "matter", of_set[i], dim, i < 2 ? PM_STATE : PM_CHANGE);
	pm_makes(f, "matter", strength, 1, PM_STATE)->extensive = true;
	for (size_t i = 0; i < sizeof of_mesh / sizeof *of_mesh; i++)
		pm_makes(f, "mesh", of_mesh[i], i == 2 || i == 3 ? dim : 1, PM_DERIVED);
	for (size_t i = 0; i < f->nfields; i++)
		f->fields[i]->use = 0;
	return f;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	static struct pm_frame *gravity, *vortex;
	const struct pm_list moves = {0};
	char *text = fuzz_text(data, n);
	gravity = gravity ? gravity : header_new(3, "gravity", "mass");
	vortex = vortex ? vortex : header_new(2, "vortex", "circulation");
	struct pm_sentence *s = pm_sentence_new(text, true, &moves);
	if (!s)
		fuzz_refused();
	else {
		pm_sentence_needs_priming(s, gravity);
		pm_sentence_needs_priming(s, vortex);
	}
	pm_sentence_free(s);
	if (pm_sentence_safe(text))
		fuzz_refused();
	free(text);
	return 0;
}
