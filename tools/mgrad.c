/* mgrad: derivatives of mesh fields. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "fft/axis-transform.h"
#include "mesh/gradient.h"
#include "stage/stage.h"

struct config {
	const char *kind, *order, *source, *target, *mesh, *plan;
};
struct state {
	struct pm_fft_plans planner;
	const struct pm_field *source;
	struct pm_field *target;
	struct pm_operator operator;
	double factor;
};

static const struct pm_option options[] = {
	{.name = "operator", .kind = PM_WORD, .choices = pm_operator_names, PM_AT(kind),
		.text = "what to apply to --source (default: what the law makes of its potential, with the law's sign)"},
	{.name = "order", .kind = PM_WORD, .choices = pm_order_names, PM_AT(order), .text = "order of the differences, or spectral (default: the law's)"},
	{.name = "source", .kind = PM_TEXT, .unit = "FIELD", PM_AT(source), .text = "the mesh field to take derivatives of (default: the law's potential)"},
	{.name = "target", .kind = PM_TEXT, .unit = "FIELD", PM_AT(target), .text = "the mesh field to make (default: the law's field)"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first)"},
	{.name = "plan", .kind = PM_WORD, .choices = pm_fft_effort_names, PM_AT(plan),
		.text = "how FFTW's transforms (--order spectral, lengths with a prime factor above 13) are chosen: by estimate, or measured once and kept "
			"in the user's cache (default: PM_PLAN or measure)"},
	{0},
};

static const struct pm_example examples[] = {
	{"the acceleration on the mesh of a cluster in free space", "pinit plummer -n 2000 | p2m -n 32 | poisson-fft --plan estimate | mgrad | sls"},
	{"back from the potential to the density (times 4 pi G)",
		"pinit uniform -n 2000 | p2m -n 32 | poisson-fft --symbol fd2 --plan estimate | mgrad --operator lap --order 2 --target lap | sls"},
	{0},
};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	int effort = pm_fft_effort_find(o->plan);
	((struct state *)s->state)->planner.effort = (enum pm_fft_effort)effort;
	if (effort < 0)
		return -PM_USAGE;
	if (o->kind && !o->target)
		return pm_fail(PM_USAGE, "--operator %s needs a --target (the name of the field to make)", o->kind);
	return 0;
}

/* The operator, its factor and its order: as asked for, else the law's. */
static int choose(const struct config *o, const struct pm_law *law, const struct pm_grid *g, const struct pm_field *source, struct state *t)
{
	enum pm_operator_kind kind = law->of_potential == PM_CURL ? PM_OP_CURL : PM_OP_GRAD;
	t->factor = kind == PM_OP_GRAD ? law->sign : 1;
	for (int i = 0; o->kind && pm_operator_names[i]; i++)
		if (!strcmp(o->kind, pm_operator_names[i]))
			kind = (enum pm_operator_kind)i, t->factor = 1;
	int order = pm_order_find(o->order ? o->order : law->order ? law->order : "2");
	/* Where the law's field is a flow, vectors are, but not its potential and its density: those have the images of a gradient. */
	bool flow = law->of_potential == PM_CURL && strcmp(source->name, law->potential) && strcmp(source->name, law->density);
	return order < 0 ? -PM_USAGE : pm_operator_init(&t->operator, g, kind, order, source->components, flow);
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct state *t = s->state;
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return -PM_DATA;
	const struct pm_mesh *mesh = pm_frame_mesh(f, o->mesh);
	if (!mesh)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n makes one)", o->mesh ? " named " : "", o->mesh ? o->mesh : "");
	const char *source = o->source ? o->source : law->potential, *target = o->target ? o->target : law->field;
	if (!source || !target || (!o->kind && !law->field))
		return pm_fail(PM_USAGE, "the law %s names no potential and field (give --operator, --source and --target)", law->name);
	if (!strcmp(source, target))
		return pm_fail(PM_USAGE, "source and target are both '%s' (choose another --target)", source);
	if (!pm_frame_field(f, mesh->name, source))
		return pm_fail(PM_DATA, "no field '%s' on '%s' (poisson-fft, poisson-mg or poisson-relax makes a potential, or choose --source)", source, mesh->name);
	t->source = pm_reads(f, mesh->name, source);
	if (!t->source)
		return -PM_DATA;
	for (int c = 0; c < t->source->components; c++)
		for (int d = 0; d < f->dim; d++)
			if (t->source->staggered[c][d])
				return pm_fail(PM_DATA, "'%s' sits between the nodes (mgrad works on the nodes)", source);
	struct pm_grid g = pm_grid_of(f, mesh);
	int status = choose(o, law, &g, t->source, t);
	if (status)
		return status;
	const struct pm_field *old = pm_frame_field(f, mesh->name, target);
	if (old && old->role == PM_STATE)
		return pm_fail(PM_DATA, "'%s' on '%s' is given, and a derivative does not replace it (choose another --target; keep what is given on a mesh of "
			"its own, m2p --mesh adds it)", target, mesh->name);
	t->target = pm_makes(f, mesh->name, target, t->operator.out, PM_DERIVED);
	if (!t->target)
		return -PM_DATA;
	t->target->use |= PM_USE_FILL;
	pm_field_inherit(t->target, t->source);
	return 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	(void)f;
	const double *in[PM_COMPONENTS];
	double *out[PM_COMPONENTS];
	for (int c = 0; c < t->operator.in; c++)
		in[c] = pm_in(t->source, c);
	for (int c = 0; c < t->operator.out; c++)
		out[c] = pm_out(t->target, c);
	if (t->planner.nmade > PM_FFT_PLANS - 3 || t->planner.n > PM_FFT_PLANS - 6) /* frames of many sizes: start the collection anew */
		pm_fft_plans_clear(&t->planner);
	double began = pm_seconds();
	int status = pm_operator_plan(&t->operator, &t->planner);
	pm_setup_since(s, began);
	if (*t->planner.note)
		pm_say(s, "%s", t->planner.note);
	bool seen = false;
	status = status ? status : pm_operator_apply(&t->operator, t->factor, in, out, &seen);
	t->target->use |= seen ? PM_USE_SEEN : 0;
	return status;
}

static void release(struct pm_stage *s)
{
	pm_fft_plans_clear(&((struct state *)s->state)->planner);
}

const struct pm_tool tool_mgrad = {
	.name = "mgrad",
	.summary = "take gradients and other derivatives of mesh fields",
	.about = "Bare, it makes the field of the law from its potential: g = -grad phi for gravity, u = (d psi/dy, -d psi/dx) for 2-D vortices. With "
		"--operator it applies grad, curl, div or lap as such. Differences are centred; a wall is an odd image and a neumann face an even one; near "
		"an open face they are one-sided, of the same order. Spectral derivatives need periodic, wall or neumann faces. Of a vector the tangential "
		"components are odd at a wall and the normal one even; of a flow (u of vortices) the other way round.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "phi (mesh)",
	.changes = "",
	.adds = "g (mesh)",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.free = release,
};
