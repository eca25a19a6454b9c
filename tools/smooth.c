/* smooth: the binomial filter on mesh fields (lib/mesh/smooth.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "mesh/smooth.h"
#include "stage/stage.h"

struct config {
	const char *mesh;
	struct pm_list fields;
	int64_t passes;
	bool plain;
};

static const char *field_of(const struct config *o, const struct pm_law *law, int i)
{
	return o->fields.n ? o->fields.item[i] : law->evolves ? "J" : law->density;
}
static int fields(const struct config *o) { return o->fields.n ? o->fields.n : 1; }

static int check(const struct pm_frame *f, const struct pm_field *field)
{
	for (int c = 0; c < field->components; c++)
		for (int d = 0; d < f->dim; d++)
			if (field->staggered[c][d] && f->face[d][0] != PM_PERIODIC)
				return pm_fail(PM_DATA,
					"'%s' is half a cell off the nodes along an axis that is not periodic, and how it goes on there depends "
					"on what it is (smooth it on periodic axes only)", field->name);
	return field->type == PM_I64 ? pm_fail(PM_DATA, "'%s' is of integers (scalc makes a field of reals of it)", field->name) : 0;
}

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	for (int i = 0; i < o->fields.n; i++)
		for (int k = 0; k < i; k++)
			if (!strcmp(o->fields.item[i], o->fields.item[k]))
				return pm_fail(PM_USAGE, "--field names '%s' twice, but it is smoothed once (--passes 2)", o->fields.item[i]);
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	const struct pm_law *law = pm_law_of(f);
	const struct pm_mesh *m = pm_frame_mesh(f, o->mesh);
	if (!law)
		return -PM_DATA;
	if (!m)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m makes one)", o->mesh ? " " : "", o->mesh ? o->mesh : "");
	if (!o->fields.n && law->evolves && !pm_frame_field(f, m->name, "J"))
		return PM_PASS; /* as when cycle primes: a current belongs to a step */
	if (!o->fields.n && !law->evolves && !law->density)
		return pm_fail(PM_DATA, "the law %s has no density (--field NAME)", law->name);
	for (int i = 0; i < fields(o); i++) {
		if (!pm_frame_field(f, m->name, field_of(o, law, i)))
			return pm_fail(PM_DATA, "no field '%s' on '%s' (%s)", field_of(o, law, i), m->name,
				o->fields.n ? "sls lists what there is" : "p2m makes it from particles, or choose --field");
		const struct pm_field *field = pm_changes(f, m->name, field_of(o, law, i));
		if (!field || check(f, field))
			return -PM_DATA;
	}
	return 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	const struct pm_mesh *m = pm_frame_mesh(f, o->mesh);
	const struct pm_grid g = pm_grid_of(f, m);
	struct pm_planes planes;
	int status = pm_planes_init(&planes, &g, pm_frame_field(f, m->name, field_of(o, pm_law_of(f), 0)));
	double *work = status ? NULL : pm_alloc(planes.here * planes.size + 1, sizeof *work);
	status = status || work ? status : -PM_DATA;
	for (int i = 0; i < fields(o); i++) {
		struct pm_field *field = pm_frame_field(f, m->name, field_of(o, pm_law_of(f), i));
		for (int c = 0; c < field->components; c++)
			status = pm_smooth(status, &g, &planes, (int)o->passes, !o->plain, pm_out(field, c), work);
	}
	pm_free(work);
	pm_planes_free(&planes);
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return (void)s, f != NULL; }

static const struct pm_option options[] = {
	{.name = "field", .kind = PM_LIST, .unit = "NAME", PM_AT(fields), .text = "mesh fields (default: the law's density; of electromagnetic particles J)"},
	{.name = "passes", .letter = 'n', .kind = PM_INTEGER, .fallback = "1", .low = 1, .high = 1000, PM_AT(passes),
		.text = "of (1, 2, 1)/4 along every axis"},
	{.name = "no-compensation", .kind = PM_FLAG, PM_AT(plain), .text = "leave out the last pass, which gives long waves back what the others took"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first)"},
	{0},
};
static const struct pm_example examples[] = {
	{"a plasma whose charge density is smoothed, and with it the force",
		"pinit landau -n 4000 --cells 32 | cycle -n 20 'push kick/2 drift | p2m | smooth | poisson-fft | mgrad | m2p | push kick/2' | diag"},
	{"the current of electromagnetic particles",
		"pinit weibel -n 2000 --cells 32 | cycle -n 10 'push boris/2 | p2m --current | smooth | maxwell | push drift | m2p | push boris/2' | diag"},
	{0},
};
const struct pm_tool tool_smooth = {
	.name = "smooth",
	.summary = "take short waves out of mesh fields",
	.about = "The binomial filter: n passes of (1, 2, 1)/4 along every axis, then one of (-n/4, 1 + n/2, -n/4), which compensates for what they take from "
		"long waves. A wave of wave number k along an axis keeps cos^2n(k h/2) (1 + n sin^2(k h/2)) of itself, so 1 + O(k^4 h^4), and nothing at the "
		"shortest. Values are continued evenly beyond faces, and sums stay. It stands behind p2m, or behind p2m --current, whose charge it keeps. "
		"See docs/methods/smooth.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "rho, omega, J (mesh), or --field",
	.changes = "the same",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
};
