/* Source and target of a derivative in a frame, and what is asked for that cannot be. The differences are gradient.c's.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "base/in-order.h"
#include "fft/axis-transform.h"
#include "law/law.h"
#include "mesh/force-words.h"
#include "mesh/given-faces.h"
#include "mesh/gradient-frame.h"
#include "mesh/gradient-parts.h"
#include "stream/declare.h"

/* The operator, its factor and its order: from the options, else the law's. */
static int choose(const struct pm_gradient_choice *o, const struct pm_law *law, const struct pm_grid *g, const struct pm_field *source, struct pm_gradient *t)
{
	enum pm_operator_kind kind = law->of_potential == PM_CURL ? PM_OP_CURL : PM_OP_GRAD;
	t->factor = kind == PM_OP_GRAD ? law->sign : 1;
	for (int i = 0; o->kind && pm_operator_names[i]; i++)
		if (!strcmp(o->kind, pm_operator_names[i]))
			kind = (enum pm_operator_kind)i, t->factor = 1;
	int order = pm_order_find(o->order ? o->order : law->order ? law->order : "2");
	/* If the law's field is a flow, vectors have the images of a flow, except its potential and its density, which have those of a gradient. */
	bool flow = law->of_potential == PM_CURL && strcmp(source->name, law->potential) && strcmp(source->name, law->density);
	return order < 0 ? -PM_USAGE : pm_operator_init(&t->operator, g, kind, order, source->components, flow);
}

/* The target beside the source, in place of what was derived before. */
static int make(struct pm_frame *f, const char *on, const char *target, struct pm_gradient *t)
{
	const struct pm_field *old = pm_frame_field(f, on, target);
	if (old && old->role == PM_STATE)
		return pm_fail(PM_DATA, "'%s' on '%s' is given, and a derivative must not replace it (choose another --target; keep the given field on a "
			"separate "
			"mesh, m2p --mesh adds it)", target, on);
	t->target = pm_makes(f, on, target, t->operator.out, PM_DERIVED);
	if (!t->target)
		return -PM_DATA;
	t->target->use |= PM_USE_FILL;
	pm_field_inherit(t->target, t->source);
	pm_given_faces_copy(t->target, t->source);
	return 0;
}

const char *pm_gradient_order_of(const struct pm_field *p)
{
	const char *order = json_string_value(json_object_get(p->more, PM_DIFFERENCES));
	for (int i = 0; order && pm_order_names[i]; i++)
		if (!strcmp(order, pm_order_names[i]))
			return order;
	return NULL;
}

bool pm_gradient_repeats(const struct pm_frame *f, const struct pm_field *p)
{
	const struct pm_law *law = pm_law_of(f);
	const struct pm_field *of = law && law->field && law->potential ? pm_frame_field(f, p->on, law->potential) : NULL;
	return of && p->role == PM_DERIVED && !strcmp(p->name, law->field) && pm_gradient_order_of(p) && of->role == PM_DERIVED;
}

void pm_gradient_leave_out(struct pm_frame *f, struct pm_field *p)
{
	struct pm_field *potential = pm_frame_field(f, p->on, pm_law_of(f)->potential);
	json_object_set(potential->more, PM_DIFFERENCES, json_object_get(p->more, PM_DIFFERENCES));
	pm_drops(f, p);
}

/* The density is looked at where differences of its potential are one-sided on more than the end nodes, which p2m leaves empty. */
static int beside_open_faces(struct pm_frame *f, const struct pm_law *law, const char *on, struct pm_gradient *t)
{
	const struct pm_grid *g = &t->operator.grid;
	bool open = false;
	for (int d = 0; d < g->dim; d++)
		open |= g->face[d][0] == PM_OPEN || g->face[d][1] == PM_OPEN;
	t->density = NULL;
	if (!open || t->operator.order <= 2 || !law->density || strcmp(t->source->name, law->potential) || !pm_frame_field(f, on, law->density))
		return 0;
	t->density = pm_reads(f, on, law->density);
	return t->density ? 0 : -PM_DATA;
}

int pm_gradient_declare(const struct pm_gradient_choice *o, struct pm_frame *f, struct pm_gradient *t)
{
	const struct pm_law *law = pm_law_of(f);
	char words[PM_FORCE_WORDS];
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
		return pm_fail(PM_DATA, "no field '%s' on '%s' (%s, or choose --source)", source, mesh->name,
			strcmp(pm_force_words(f, law, mesh->name, source, words), "p2m | poisson-fft") ?
			"poisson-fft, poisson-mg or poisson-relax makes a potential" : "p2m | poisson-fft makes it");
	t->source = pm_reads(f, mesh->name, source);
	if (!t->source)
		return -PM_DATA;
	for (int c = 0; c < t->source->components; c++)
		for (int d = 0; d < f->dim; d++)
			if (t->source->staggered[c][d])
				return pm_fail(PM_DATA, "'%s' is staggered (mgrad works on the nodes)", source);
	struct pm_grid g = pm_grid_of(f, mesh);
	pm_given_faces_open(t->source, &g);
	int status = choose(o, law, &g, t->source, t);
	if (!status)
		status = make(f, mesh->name, target, t);
	if (!status && !o->kind && law->field && !strcmp(target, law->field) && !strcmp(source, law->potential)) /* field: it can be made again */
		json_object_set_new(t->target->more, PM_DIFFERENCES, json_string(o->order ? o->order : law->order ? law->order : "2"));
	return status ? status : beside_open_faces(f, law, mesh->name, t);
}

int pm_gradient_plan(struct pm_gradient *t, struct pm_fft_plans *plans)
{
	if (plans->nmade > PM_FFT_PLANS - 3 || plans->n > PM_FFT_PLANS - 6) /* frames of many sizes: empty the collection */
		pm_fft_plans_clear(plans);
	return pm_operator_plan(&t->operator, plans);
}

int pm_gradient_apply(struct pm_gradient *t)
{
	const double *in[PM_COMPONENTS];
	double *out[PM_COMPONENTS];
	bool seen = false;
	for (int c = 0; c < t->operator.in; c++)
		in[c] = pm_in(t->source, c);
	for (int c = 0; c < t->operator.out; c++)
		out[c] = pm_out(t->target, c);
	int status = pm_operator_apply_planes(&t->operator, t->factor, t->source, in, out, &seen);
	t->target->use |= seen ? PM_USE_SEEN : 0;
	return status;
}

/* Is node i of axis d less than `width` nodes from an open face? */
static bool near_open(const struct pm_grid *g, int d, size_t i, size_t width)
{
	return (g->face[d][0] == PM_OPEN && i < width) || (g->face[d][1] == PM_OPEN && g->points[d] - 1 - i < width);
}

struct density {
	const struct pm_grid *g;
	const struct pm_planes *planes;
	const double *rho;
	size_t width;
};

enum { RIM, ALL, SUMS };

static void make_rim(const void *data, size_t from, size_t to, void *part)
{
	const struct density *d = data;
	const struct pm_grid *g = d->g;
	const size_t row = pm_planes_row(d->planes, from), j = row % g->points[1], k = row / g->points[1];
	const bool beside = (g->dim > 2 && near_open(g, 2, k, d->width)) || (g->dim > 1 && near_open(g, 1, j, d->width));
	struct pm_sum *sum = part;
	for (size_t i = from; i < to; i++) {
		pm_sum_add(&sum[ALL], fabs(d->rho[i]));
		if (beside || near_open(g, 0, i - from, d->width))
			pm_sum_add(&sum[RIM], fabs(d->rho[i]));
	}
}

int pm_gradient_rim(const struct pm_gradient *t, double *part)
{
	const struct pm_grid *g = &t->operator.grid;
	struct pm_sum sum[SUMS] = {{0, 0}};
	const struct pm_parts parts = {.size = sizeof sum, .make = make_rim, .join = pm_join_sums};
	struct pm_planes planes = {.from = NULL};
	int status = t->density ? pm_planes_init(&planes, g, t->density) : 0;
	for (int c = 0; t->density && c < t->density->components; c++)
		status = pm_planes_over(status, &planes, &parts, &(struct density){g, &planes, pm_in(t->density, c), (size_t)t->operator.order / 2}, sum);
	pm_planes_free(&planes);
	*part = !status && pm_sum_total(sum[RIM]) > 0 ? pm_sum_total(sum[RIM]) / pm_sum_total(sum[ALL]) : 0;
	return status;
}
