/* density_i = sum over the sets and their particles of strength_p W((x_p - x_i)/h) / (volume of a cell), on one mesh or on two interlaced ones, plus the law's
 * uniform background (the ions of a plasma of electrons). Cost: one spread a set. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "mesh/planes.h"
#include "stream/declare.h"
#include "stream/parts.h"
#include "transfer/on-nodes.h"
#include "transfer/outside.h"
#include "transfer/transfer-columns.h"
#include "transfer/spread-frame.h"
#include "world/world.h"

/* The monopole of another field than the law's strength is no force, and that of a vorticity without divergence is 0: what is beyond the mesh is refused. */
static enum pm_outside outside_of(const struct pm_spread_job *j, const char *word)
{
	const bool force = j->law->strength && !j->law->vector && j->law->coefficient && !strcmp(j->strength, j->law->strength);
	if (!strcmp(word, "drop") || (j->law->evolves && strcmp(word, "error")))
		return PM_OUTSIDE_DROP;
	return force && !strcmp(word, "monopole") ? PM_OUTSIDE_MONOPOLE : PM_OUTSIDE_ERROR;
}

int pm_spread_choose(const struct pm_spread_choice *choice, const struct pm_frame *f, struct pm_spread_job *j)
{
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return -PM_DATA;
	*j = (struct pm_spread_job){.choice = *choice, .law = law, .kernel = pm_kernel_choose(choice->kernel, NULL, law, "cic"),
		.strength = choice->strength ? choice->strength : law->strength,
		.density = choice->field ? choice->field : law->density ? law->density : "rho", .mesh = pm_frame_mesh(f, choice->mesh)};
	if (!j->kernel)
		return -PM_DATA;
	if (!j->strength)
		return pm_fail(PM_DATA, "the law '%s' deposits nothing on a mesh (choose a field with --strength FIELD)", f->law);
	if (!j->mesh && !choice->cells)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", choice->mesh ? " " : "", choice->mesh ? choice->mesh : "");
	j->grow = !strcmp(choice->outside, "grow");
	j->outside = outside_of(j, choice->outside);
	return pm_sets_choose(f, choice->set, (const char *const[]){j->strength, NULL},
		"add it with stab --strength, or choose another with --strength FIELD", &j->sets);
}

static struct pm_transfer transfer_of(const struct pm_spread_job *j, const struct pm_frame *f)
{
	int components = pm_frame_field(f, j->sets.name[0], j->strength)->components;
	struct pm_transfer t = {.grid = pm_grid_of(f, j->mesh), .kernel = j->kernel, .components = components, .rim = j->choice.rim,
		.cut = j->law->evolves};
	for (int c = 0; c < components && c < f->dim && components > 1; c++)
		t.flip[c][c] = 1; /* of a vector at a wall the tangential components change sign in the image (vortices, currents), the normal one does not */
	return t;
}

static int makes_density(const struct pm_spread_job *j, struct pm_frame *f, bool add)
{
	struct pm_transfer t = transfer_of(j, f);
	const struct pm_density density = {.name = j->density, .kernel = j->kernel, .interlaced = j->choice.interlace, .sets = &j->sets,
		.strength = j->strength, .rim = j->choice.rim,
		.outside = j->outside == PM_OUTSIDE_DROP || !j->law->strength || j->law->vector || strcmp(j->strength, j->law->strength) ? j->outside :
			PM_OUTSIDE_MONOPOLE};
	int status = j->choice.interlace ? pm_interlace_check(&t) : 0;
	status = status ? status : pm_makes_density(f, j->mesh, &density, add);
	struct pm_field *made = status ? NULL : pm_frame_field(f, j->mesh->name, j->density);
	if (made && !add)
		made->use |= PM_USE_FILL; /* spread() clears it, if particles do not make every value */
	return status;
}

int pm_spread_declare(const struct pm_spread_job *j, struct pm_frame *f)
{
	int status = 0;
	for (size_t i = 0; i < j->sets.n && !status; i++)
		if (!(status = pm_reads_positions(f, j->sets.name[i])))
			status = pm_reads_strength(f, j->sets.name[i], j->strength);
	for (size_t i = 0; i < j->sets.n && !status && !j->choice.interlace; i++) {
		struct pm_field *q = pm_frame_field(f, j->sets.name[i], j->strength);
		pm_frame_field(f, j->sets.name[i], "x")->use |= PM_USE_COLUMNS;
		if (q->extensive)
			q->use |= PM_USE_COLUMNS;
	}
	return status ? status : makes_density(j, f, j->choice.add);
}

int pm_spread_grow(struct pm_spread_job *j, struct pm_frame *f)
{
	struct pm_transfer t = transfer_of(j, f);
	int status = pm_mesh_grow(f, j->mesh, &t, &j->sets);
	if (status == 1 && j->choice.add)
		return pm_fail(PM_DATA, "mesh '%s' would have to grow under --add (let the first p2m grow it)", j->mesh->name);
	const bool shared = pm_frame_field(f, j->sets.name[0], "x")->here, grown = status == 1;
	if (grown)
		status = makes_density(j, f, false);
	struct pm_field *density = pm_frame_field(f, j->mesh->name, j->density);
	if (!status && grown && shared)
		status = pm_field_share(density, pm_division_grain(f, j->mesh->name));
	return pm_world_agree(status ? status : pm_field_ready(density));
}

/* What is beyond a wall is refused, what is beyond an open face too if it is to be. */
static int judge(const struct pm_spread_job *j, const struct pm_frame *f, const char *set, const struct pm_transfer *t, struct pm_strays *strays)
{
	static const char remedy[] = "a larger box, or --outside grow or drop";
	struct pm_strays closed;
	if (!strays->count || j->outside == PM_OUTSIDE_DROP)
		return 0;
	if (j->outside == PM_OUTSIDE_ERROR)
		return pm_strays_refuse(strays, set, j->mesh, t, remedy);
	int status = pm_outside_find(f, set, t, NULL, &closed);
	return !status && closed.count ? pm_strays_refuse(&closed, set, j->mesh, t, "a larger box, or --outside drop") : status;
}

/* What the spread takes, on the way. */
struct spread_arrays {
	bool columns;
	const double *x[3], *q[PM_COMPONENTS];
	struct pm_column at[3], values[PM_COMPONENTS];
	double *mesh[PM_COMPONENTS];
	size_t points;
};

static int spread(const struct pm_spread_job *j, const struct pm_transfer *t, const struct pm_field *x, struct spread_arrays *a, struct pm_fft_plans *plans,
	struct pm_strays *strays)
{
	bool on = false;
	int status = j->choice.interlace || j->choice.add ? 0 : pm_on_nodes(t, x, &on);
	if (!a->columns && on)
		pm_columns_of(t->components, a->q, a->values);
	const bool all = on && !x->here && x->count == pm_grid_size(&t->grid); /* every node has a particle */
	for (int c = 0; c < t->components && t->cleared && !all; c++)
		memset(a->mesh[c], 0, a->points * sizeof *a->mesh[c]);
	if (status || on)
		return status ? status : pm_on_nodes_spread(t, x, a->values, t->cleared && all, a->mesh);
	if (a->columns)
		return pm_spread_columns(t, x->count, a->at, a->values, a->mesh, strays);
	return j->choice.interlace ? pm_interlace_spread(t, plans, x->count, a->x, a->q, a->mesh, strays)
				   : pm_spread(t, x->count, a->x, a->q, a->mesh, strays);
}

int pm_spread_set(const struct pm_spread_job *j, struct pm_frame *f, const char *set, bool first, struct pm_fft_plans *plans, uint64_t *outside)
{
	struct pm_transfer t = transfer_of(j, f);
	struct pm_field *positions = pm_frame_field(f, set, "x"), *density = pm_frame_field(f, j->mesh->name, j->density);
	struct pm_planes planes;
	double *made = NULL;
	struct pm_strays strays = {.count = 0};
	const struct pm_field *strength = pm_frame_field(f, set, j->strength);
	struct spread_arrays a = {.columns = !j->choice.interlace && strength->extensive, .points = density->count};
	for (int d = 0; d < f->dim && a.columns; d++)
		a.at[d] = pm_column_of(positions, d);
	for (int c = 0; c < t.components && a.columns; c++)
		a.values[c] = pm_column_of(strength, c);
	if (!a.columns)
		pm_positions(f, set, a.x);
	t.kept = &positions->note, t.cleared = first && !j->choice.add;
	for (int c = 0; c < t.components; c++)
		a.mesh[c] = pm_out(density, c);
	int status = pm_planes_init(&planes, &t.grid, density);
	t.planes = &planes;
	status = pm_world_agree(status || a.columns ? status : pm_strengths(f, set, j->strength, a.q, &made));
	if (!status)
		status = spread(j, &t, positions, &a, plans, &strays);
	pm_free(made);
	pm_planes_free(&planes);
	t.planes = NULL;
	strays.first += positions->first;
	int64_t all = (int64_t)strays.count;
	status = pm_world_count(status ? status : judge(j, f, set, &t, &strays), PM_SUM_OF, 1, &all);
	*outside = (uint64_t)all;
	return status;
}

void pm_spread_background(const struct pm_spread_job *j, struct pm_frame *f)
{
	struct pm_field *density = pm_frame_field(f, j->mesh->name, j->density);
	const bool own = !j->choice.add && !j->choice.strength && !j->choice.field; /* once in every new density */
	const double background = own && j->law->background ? pm_frame_constant(f, j->law->background, 0) : 0;
	for (size_t i = 0; i < density->count && background != 0; i++)
		pm_out(density, 0)[i] += background;
}

/* Sums of so many strengths of a known size are finite whatever the weights, which are 1 at most, and the images of walls. */
static bool surely_finite(const struct pm_spread_job *j, const struct pm_frame *f)
{
	const struct pm_grid g = pm_grid_of(f, j->mesh);
	double most = 0, volume = 1;
	for (int d = 0; d < f->dim; d++)
		volume *= g.h[d];
	for (size_t i = 0; i < j->sets.n; i++) {
		const struct pm_field *q = pm_frame_field(f, j->sets.name[i], j->strength);
		for (int c = 0; c < q->components; c++)
			most += (double)pm_frame_set(f, j->sets.name[i])->n * (!q->extensive ? INFINITY : q->uniform ? fabs(q->value[c]) :
				q->within > 0 ? q->within : INFINITY);
	}
	if (j->law->background)
		most += fabs(pm_frame_constant(f, j->law->background, 0)) * fmax(volume, 1);
	return !j->choice.interlace && !j->choice.add && most * fmax(1 / volume, 1) < 1e300; /* as sums are multiplied: 1 / volume may be infinite */
}

int pm_spread_all(struct pm_spread_job *j, struct pm_frame *f, struct pm_fft_plans *plans, uint64_t *outside)
{
	int status = j->grow ? pm_spread_grow(j, f) : 0;
	*outside = 0;
	for (size_t i = 0; !status && i < j->sets.n; i++) {
		uint64_t left_out = 0;
		status = pm_spread_set(j, f, j->sets.name[i], !i, plans, &left_out);
		*outside += left_out;
	}
	if (status)
		return status;
	pm_spread_background(j, f);
	pm_frame_field(f, j->mesh->name, j->density)->use |= surely_finite(j, f) ? PM_USE_SEEN : 0;
	return 0;
}
