/* Expressions, compiled and computed on particles, on a mesh, and as numbers of a caller (--until); and ranges of frames (sel --frame).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "expression/expression.h"
#include "expression/selection.h"
#include "fuzz.h"
#include "stream/run.h"

enum { particles = 3 };

static struct pm_frame *frame_new(void)
{
	const size_t cells[3] = {2, 1, 1};
	struct pm_frame *f = pm_frame_new(2);
	pm_frame_constant_set(f, "G", 2.385);
	pm_frame_set_new(f, "matter", particles);
	pm_frame_mesh_new(f, "mesh", cells);
	pm_makes(f, "matter", "x", 2, PM_STATE), pm_makes(f, "matter", "v", 2, PM_STATE), pm_makes(f, "matter", "mass", 1, PM_STATE);
	pm_makes(f, "matter", "id", 1, PM_STATE)->type = PM_I64;
	pm_makes(f, "mesh", "rho", 1, PM_DERIVED), pm_makes(f, "mesh", "g", 2, PM_DERIVED);
	for (size_t i = 0; i < f->nfields; i++)
		f->fields[i]->use |= PM_USE_NEW;
	fuzz_must(!pm_frame_ready(f), "there is a frame");
	for (size_t i = 0; i < f->nfields; i++)
		for (size_t k = 0; f->fields[i]->type == PM_F64 && k < f->fields[i]->count * (size_t)f->fields[i]->components; k++)
			pm_out(f->fields[i], 0)[k] = 0.3 * (double)k - 1;
	pm_frame_settle(f);
	return f;
}

static int slot(void *context, const char *name)
{
	const char *const *names = context;
	for (int i = 0; names[i]; i++)
		if (!strcmp(names[i], name))
			return i + 1;
	return 0;
}

static void numbers(const char *text)
{
	static const char *names[] = {"energy", "energy0", "time", NULL};
	static const double values[] = {-0.25, -0.251, 1.5};
	static struct pm_expression e;
	if (pm_expression_compile_numbers(&e, slot, names, "column", text))
		fuzz_refused();
	else
		pm_expression_number(&e, values);
}

static void on(struct pm_frame *f, const char *name, const char *text)
{
	static struct pm_expression e;
	double out[16];
	const size_t n = pm_frame_set(f, name) ? particles : f->fields[f->nfields - 1]->count;
	if (pm_expression_compile(&e, f, name, text))
		fuzz_refused();
	else
		for (int k = 0; k < e.nparts; k++)
			pm_expression_eval(&e, f, k, n, out);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	static struct pm_frame *f;
	char name[PM_NAME], *text = fuzz_text(data, n);
	const char *rest, *const ranges[] = {text};
	f = f ? f : frame_new();
	on(f, "matter", pm_expression_named(text, name, &rest) ? text : rest);
	on(f, "mesh", text);
	numbers(text);
	if (pm_frame_numbers_check(&(struct pm_names){ranges, 1}))
		fuzz_refused();
	else
		pm_frame_numbers_contain(&(struct pm_names){ranges, 1}, 3);
	free(text);
	return 0;
}
