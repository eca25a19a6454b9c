/* out_p += factor_p sum over points of W((x_p - x_i)/h) field_i for the sets of a frame, the transpose of the spread. The factor is 1, strength/per of the
 * law (charge/mass), or the volume where the target is a strength. In addition: images at walls that depend on the field (a gradient, a curl, given),
 * changes on the mesh (mesh-changes.c), a field on two interlaced meshes, a magnetic field (magnetic-field.c).
 * Cost: one gather of all components. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/force-words.h"
#include "mesh/given-faces.h"
#include "mesh/gradient-later.h"
#include "stream/declare.h"
#include "transfer/gather-limits.h"
#include "transfer/magnetic-field.h"
#include "transfer/gather-beside.h"
#include "transfer/gather-later.h"
#include "transfer/on-nodes.h"
#include "transfer/rate-later.h"
#include "world/world.h"

/* The mesh that has the field, or the words that make it. */
static int choose_field(const char *mesh, const struct pm_frame *f, struct pm_gather_job *j)
{
	const struct pm_law *law = j->law;
	char words[PM_FORCE_WORDS];
	for (size_t i = 0; i < f->nmeshes && !j->field; i++)
		if (!mesh || !strcmp(mesh, f->meshes[i]->name)) {
			j->mesh = f->meshes[i];
			j->field = pm_frame_field(f, j->mesh->name, j->name);
		}
	if (!j->mesh)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", mesh ? " " : "", mesh ? mesh : "");
	if (j->field)
		return 0;
	if (!*pm_force_words(f, law, mesh, j->name, words))
		return pm_fail(PM_DATA, "no field '%s' on mesh '%s'", j->name, mesh ? mesh : j->mesh->name);
	return pm_fail(PM_DATA, "no field '%s' on mesh '%s' (run %s first)", j->name, mesh ? mesh : j->mesh->name, words);
}

/* The normal component of a gradient has the image of the other sign; so have the tangential ones of a curl. A given field has the same values on
 * both sides of any face; one that evolves by Maxwell's equations is one of both. */
static void set_images(const struct pm_gather_job *j, int dim, struct pm_transfer *t)
{
	if (j->law->evolves && t->components == 3 && (!strcmp(j->name, j->law->field) || !strcmp(j->name, j->law->magnetic))) {
		pm_transfer_maxwell(t, !strcmp(j->name, j->law->field));
		return;
	}
	if (j->field->role == PM_STATE) {
		pm_grid_even(&t->grid);
		return;
	}
	bool law = j->law->field && !strcmp(j->name, j->law->field), curl = law && j->law->of_potential == PM_CURL;
	for (int c = 0; c < t->components && t->components == dim; c++)
		for (int d = 0; d < dim; d++)
			t->flip[c][d] = curl ? c != d : c == d && (law || dim > 1);
}

/* The law's field, the changes on its mesh that some set receives, and the magnetic field; how many. */
static int gathered(const struct pm_gather_job *j, const struct pm_frame *f, const struct pm_field *all[PM_MESH_CHANGES + 2])
{
	int n = 1;
	const struct pm_field *magnetic = j->law->magnetic ? pm_frame_field(f, j->mesh->name, j->law->magnetic) : NULL;
	if (magnetic && magnetic != j->field)
		all[n++] = magnetic;
	for (size_t i = 0; i < f->nfields; i++) {
		bool any = false;
		for (size_t k = 0; k < j->sets.n; k++)
			any |= pm_mesh_change_concerns(f, j->sets.name[k], j->mesh, f->fields[i]);
		if (any && n < PM_MESH_CHANGES + 2)
			all[n++] = f->fields[i];
	}
	return n;
}

static const char *mark(const struct pm_field *p) { return p->interlaced ? "interlaced " : ""; }

/* One kernel for all that is gathered at once. A particle whose field comes back with another kernel than it went out with accelerates itself. */
static int choose_kernel(const struct pm_frame *f, struct pm_gather_job *j)
{
	const struct pm_field *all[PM_MESH_CHANGES + 2] = {j->field};
	struct pm_field made = {.kernel = ""};
	int n = j->choice.field ? 1 : gathered(j, f, all);
	for (int i = 0; i < n && !j->choice.kernel; i++) {
		const struct pm_field before = made;
		pm_field_inherit(&made, all[i]);
		if (!strcmp(all[i]->kernel, "several"))
			return pm_fail(PM_DATA, "'%s' on '%s' comes from fields made with different kernels (choose one: m2p --kernel)", all[i]->name,
				all[i]->on);
		if (!strcmp(made.kernel, "several"))
			return pm_fail(PM_DATA, "'%s' on '%s' was made with the kernel %s%s, what is gathered with it with %s%s (choose one: m2p --kernel)",
				all[i]->name, all[i]->on, mark(all[i]), all[i]->kernel, mark(&before), before.kernel);
	}
	j->interlaced = made.interlaced;
	j->transfer.kernel = pm_kernel_choose(j->choice.kernel, &made, j->law, "cic");
	return j->transfer.kernel ? 0 : -PM_DATA;
}

/* Where values were given on a face there is no image beyond it, so the kernel must not reach there from inside. */
static int beside_given_faces(struct pm_gather_job *j)
{
	for (int a = 0; a < 2 * j->transfer.grid.dim; a++) {
		j->transfer.given[a / 2][a % 2] = pm_given_face(j->field, a / 2, a % 2);
		if (j->transfer.given[a / 2][a % 2] && (j->transfer.kernel->width > 2 || j->interlaced))
			return pm_fail(PM_DATA, "values were given on the face %s of '%s', and nothing is known beyond, where %s%s reaches (p2m --kernel cic, "
				"or m2p --kernel cic)", pm_face_places[a / 2][a % 2], j->field->name, j->interlaced ? "interlaced " : "",
				j->transfer.kernel->name);
	}
	return 0;
}

static int check_beside(const struct pm_gather_job *j)
{
	bool half = j->interlaced;
	for (int c = 0; c < j->transfer.components; c++)
		for (int d = 0; d < j->transfer.grid.dim; d++)
			half = half || j->transfer.staggered[c][d];
	return half ? pm_fail(PM_DATA, "--mask is of fields on the nodes of one mesh, and '%s' is interlaced or staggered (p2m without --interlace)",
		j->name) : 0;
}

/* The kernels of the energy-conserving gather of E and B: a component J of Esirkepov's current has these shapes, averaged over a way. */
static int choose_lower(const struct pm_frame *f, struct pm_gather_job *j)
{
	j->transfer.lower = pm_kernel_lower(j->transfer.kernel);
	if (!j->transfer.lower)
		return pm_fail(PM_USAGE, "--energy-conserving is not there for %s (of E and B: cic, tsc, pcs)", j->transfer.kernel->name);
	for (int d = 0; d < f->dim; d++)
		if (!j->transfer.staggered[d][d])
			return pm_fail(PM_DATA, "'%s' is on the nodes of '%s', and --energy-conserving is for E and B half a cell up Yee's mesh "
				"(maxwell --method yee, or m2p without it)", j->name, j->mesh->name);
	return 0;
}

/* Panels have positions, and are no particles. */
static void leave_panels(const struct pm_frame *f, struct pm_sets *sets)
{
	size_t n = 0;
	for (size_t i = 0; i < sets->n; i++)
		if (!pm_frame_field(f, sets->name[i], "corners"))
			sets->name[n++] = sets->name[i];
	sets->n = n ? n : sets->n;
}

int pm_gather_choose(const struct pm_gather_choice *choice, const struct pm_frame *f, struct pm_gather_job *j)
{
	*j = (struct pm_gather_job){.choice = *choice, .law = pm_law_of(f)};
	if (!j->law)
		return -PM_DATA;
	j->name = choice->field ? choice->field : j->law->field;
	if (!j->name)
		return pm_fail(PM_DATA, "the law '%s' uses no field of a mesh (choose a field with --field NAME)", f->law);
	int status = choose_field(choice->mesh, f, j);
	/* A set receives the law's field if it has the state that this changes, any other field if it has positions. */
	const char *const law[] = {"x", j->law->of, j->law->per, j->law->per ? j->law->strength : NULL, NULL}, *const any[] = {"x", NULL};
	if (!status)
		status = pm_sets_choose(f, choice->set, choice->field ? any : law, "stab reads it from a table", &j->sets);
	if (status)
		return status;
	if (!choice->set && !choice->field)
		leave_panels(f, &j->sets);
	j->transfer = (struct pm_transfer){.grid = pm_grid_of(f, j->mesh), .components = j->field->components, .rim = j->field->rim};
	if ((status = choose_kernel(f, j)))
		return status;
	memcpy(j->transfer.staggered, j->field->staggered, sizeof j->transfer.staggered);
	if (choice->conserving && (status = choose_lower(f, j)))
		return status;
	set_images(j, f->dim, &j->transfer);
	status = j->interlaced ? pm_interlace_check(&j->transfer) : 0;
	if (!status)
		status = choice->beside ? check_beside(j) : beside_given_faces(j);
	if (!status)
		status = pm_gather_outside_choose(j, f);
	j->outside = choice->beside ? PM_OUTSIDE_DROP : j->outside; /* who is beyond the mesh is found beside */
	return status;
}

/* Can the gather to the set take columns? All that it reads and writes is then in one pm_gather_columns; what the monopole adds would be rounded twice. */
static bool by_columns(const struct pm_gather_job *j, const struct pm_frame *f, const char *set)
{
	bool can = !j->interlaced && !j->choice.beside && !j->choice.field && j->outside != PM_OUTSIDE_MONOPOLE;
	for (size_t i = 0; i < f->nfields && can; i++)
		can = !pm_mesh_change_concerns(f, set, j->mesh, f->fields[i]);
	return can;
}

/* A rate that is made has the type of the state it changes. */
static void as_state(const struct pm_frame *f, const char *set, const char *state, struct pm_field *rate)
{
	const struct pm_field *y = pm_frame_field(f, set, state);
	if (rate && rate->use & PM_USE_NEW && y && y->type == PM_F32)
		rate->type = PM_F32;
}

static void take_columns(const struct pm_gather_job *j, struct pm_frame *f, const char *set, struct pm_field *target)
{
	struct pm_field *b = pm_frame_field(f, set, "bfield");
	target->use |= PM_USE_COLUMNS;
	pm_frame_field(f, set, "x")->use |= PM_USE_COLUMNS;
	if (j->law->per) {
		pm_frame_field(f, set, j->law->strength)->use |= PM_USE_COLUMNS;
		pm_frame_field(f, set, j->law->per)->use |= PM_USE_COLUMNS;
	}
	if (b && j->law->magnetic && j->law->evolves)
		b->use |= PM_USE_COLUMNS;
}

/* A set receives the law's field, the changes on the mesh and the magnetic field. */
static int declare_law(const struct pm_gather_job *j, struct pm_frame *f, const char *set)
{
	const bool replace = j->choice.replace;
	if (j->law->per && (!pm_reads(f, set, j->law->strength) || !pm_reads(f, set, j->law->per)))
		return -PM_DATA;
	struct pm_field *target = pm_contributes(f, set, j->law->change, j->law->of, j->field->components,
		j->field->role == PM_STATE && !j->law->evolves ? "external" : "self", replace);
	if (!target)
		return -PM_DATA;
	if (target->use & PM_USE_NEW)
		target->use |= PM_USE_FILL;
	as_state(f, set, j->law->of, target);
	const bool columns = by_columns(j, f, set);
	int status = pm_mesh_changes_declare(f, set, j->mesh, replace);
	if (!status && j->law->magnetic)
		status = pm_bfield_plan(f, set, j->mesh, j->law->magnetic, replace);
	struct pm_field *b = j->law->magnetic ? pm_frame_field(f, set, "bfield") : NULL;
	if (!status && j->law->magnetic)
		as_state(f, set, j->law->of, b);
	if (!status && b && b->use & PM_USE_NEW && pm_bfield_sets(f, j->mesh, j->law->magnetic) && !j->interlaced && j->field->role == PM_STATE)
		b->use |= PM_USE_FILL;
	if (!status && columns)
		take_columns(j, f, set, target);
	return status;
}

static int declare_field(const struct pm_gather_job *j, struct pm_frame *f, const char *set)
{
	struct pm_field *target = pm_makes_gathered(f, set, j->field);
	if (target && target->use & PM_USE_NEW)
		target->use |= PM_USE_FILL;
	return target ? 0 : -PM_DATA;
}

int pm_gather_declare(const struct pm_gather_job *j, struct pm_frame *f)
{
	int status = pm_reads(f, j->mesh->name, j->name) ? 0 : -PM_DATA;
	if (!status)
		j->field->use |= PM_USE_LATER;
	for (size_t i = 0; i < j->sets.n && !status; i++) {
		status = pm_reads_positions(f, j->sets.name[i]);
		if (!status)
			status = j->choice.field ? declare_field(j, f, j->sets.name[i]) : declare_law(j, f, j->sets.name[i]);
	}
	if (!status && j->outside == PM_OUTSIDE_MONOPOLE)
		status = pm_outside_reads(&j->far, f);
	return status || j->choice.field ? status : pm_gather_limits_declare(j, f);
}

const struct pm_gradient_later *pm_gather_gradient(const struct pm_gather_job *j)
{
	const bool alone = !j->changes.n && !j->interlaced && !j->choice.beside && j->field->role != PM_STATE;
	return alone ? pm_gradient_later_of(j->field) : NULL;
}

/* The field on both of its meshes. */
static int interlace(struct pm_gather_job *j, struct pm_fft_plans *plans)
{
	const double *mesh[PM_COMPONENTS];
	for (int c = 0; c < j->field->components; c++)
		mesh[c] = pm_in(j->field, c);
	return pm_interlace_init(&j->both, &j->transfer, plans, mesh);
}

int pm_gather_prepare(struct pm_gather_job *j, const struct pm_frame *f, struct pm_fft_plans *plans)
{
	int status = pm_world_agree(pm_planes_init(&j->planes, &j->transfer.grid, j->field));
	j->transfer.planes = &j->planes;
	if (status || j->choice.field)
		return status || !j->interlaced ? status : interlace(j, plans);
	status = pm_mesh_changes_init(&j->changes, f, &j->sets, j->mesh, &j->transfer);
	pm_gather_limits_prepare(j, f);
	return status || !j->interlaced ? status : interlace(j, plans);
}

static struct pm_gather_arrays arrays_of(const struct pm_gather_job *j, const struct pm_frame *f, const char *set, struct pm_field *target, const double *ratio,
	double same)
{
	struct pm_gather_arrays a = {.t = j->transfer, .n = target->count, .columns = target->use & PM_USE_COLUMNS};
	a.t.gradient = pm_gather_gradient(j);
	const double *volume = j->choice.field && target->extensive ? pm_in(pm_frame_field(f, set, "volume"), 0) : NULL;
	for (int d = 0; d < f->dim && a.columns; d++)
		a.at[d] = pm_column_of(pm_frame_field(f, set, "x"), d);
	if (!a.columns)
		pm_positions(f, set, a.x);
	a.t.kept = &pm_frame_field(f, set, "x")->note;
	for (int c = 0; c < a.t.components; c++) {
		a.t.set[c] = target->use & PM_USE_FILL;
		a.mesh[c] = a.t.gradient ? NULL : pm_in(j->field, c);
		a.factor[c] = volume ? volume : ratio;
		a.times[c] = (struct pm_column){.doubles = ratio, .value = same};
		if (a.columns)
			a.to[c] = pm_target_of(target, c);
		else
			a.out[c] = pm_out(target, c);
	}
	return a;
}

static int gather_arrays(const struct pm_gather_arrays *a, struct pm_strays *strays)
{
	struct pm_column times[PM_COMPONENTS];
	struct pm_target to[PM_COMPONENTS];
	for (int c = 0; c < a->t.components && a->on_nodes; c++) {
		times[c] = a->columns ? a->times[c] : (struct pm_column){.doubles = a->factor[c], .value = 1};
		to[c] = a->columns ? a->to[c] : (struct pm_target){.doubles = a->out[c]};
	}
	if (a->on_nodes)
		return pm_on_nodes_gather(&a->t, a->on_nodes, a->mesh, times, to, strays);
	return a->columns ? pm_gather_columns(&a->t, a->n, a->at, a->mesh, a->times, a->to, strays)
			  : pm_gather(&a->t, a->n, a->x, a->mesh, a->factor, a->out, strays);
}

/* Are all particles on nodes? Their field is then copied, or made for them. */
static int look_for_nodes(const struct pm_gather_job *j, const struct pm_frame *f, const char *set, struct pm_gather_arrays *a)
{
	const struct pm_field *x = pm_frame_field(f, set, "x");
	bool on = false;
	bool can = j->field->role != PM_STATE && !j->law->magnetic && !j->interlaced && !j->choice.beside;
	for (int i = 0; i < j->changes.n; i++)
		for (int c = 0; c < j->changes.change[i]->components; c++)
			for (int d = 0; d < f->dim; d++)
				can = can && !j->changes.change[i]->staggered[c][d];
	const int status = can ? pm_on_nodes(&a->t, x, &on) : 0;
	if (status || !on)
		return status;
	a->on_nodes = x;
	return 0;
}

/* The field and the changes in one gather; a given field before them, because its images differ. */
static int gather(const struct pm_gather_job *j, struct pm_frame *f, const char *set, struct pm_gather_arrays *a, struct pm_strays *strays)
{
	int status = look_for_nodes(j, f, set, a);
	if (status)
		return status;
	if (j->field->role == PM_STATE) {
		bool left = false;
		a->magnetic = !j->choice.field && j->law->magnetic && !j->interlaced && pm_bfield_append(f, set, j->mesh, j->law->magnetic, a);
		if (j->choice.later && a->magnetic && !j->changes.n)
			status = pm_gather_leave(j, f, set, a, &left);
		if (status || left)
			return status;
		status = j->interlaced ? pm_interlace_gather(&j->both, &a->t, a->n, a->x, a->factor, a->out, strays) : gather_arrays(a, strays);
		a->finite = !status && !j->interlaced && strays->finite;
		a->t.components = 0;
		a->t.grid = pm_grid_of(f, j->mesh);
	} else if (j->choice.later && !j->choice.field) {
		bool left = false;
		status = pm_rate_leave(j, f, set, a, &left);
		if (status || left)
			return status;
	}
	if (!status)
		status = pm_mesh_changes_append(&j->changes, f, set, &a->t, a->mesh, a->factor, a->out);
	if (status || !a->t.components)
		return status;
	if (j->interlaced && j->changes.n)
		return pm_fail(PM_DATA, "changes on the mesh are carried over with one mesh (p2m without --interlace)");
	return j->interlaced ? pm_interlace_gather(&j->both, &a->t, a->n, a->x, a->factor, a->out, strays) : gather_arrays(a, strays);
}

/* One quotient for all, which need not be read: of particles that are parts of others of one kind. */
static bool is_same(const struct pm_gather_job *j, const struct pm_frame *f, const char *set, const struct pm_field *target, const double *ratio, double *same)
{
	double range[2];
	if (target->here)
		return false;
	pm_ratio_range(f, set, j->law->strength, j->law->per, ratio, range);
	const bool one = range[0] == range[1] && range[0] != 0; /* zeros may have either sign */
	*same = one ? range[0] : *same;
	return one;
}

int pm_gather_set(struct pm_gather_job *j, struct pm_frame *f, const char *set, uint64_t *dropped)
{
	const bool law = !j->choice.field;
	struct pm_field *target = pm_gather_target(j, f, set);
	struct pm_strays strays = {.count = 0};
	const double *ratio = NULL;
	double *made = NULL, same = 1;
	const bool one = law && j->law->per && target->use & PM_USE_COLUMNS && pm_ratio_is_one(f, set, j->law->strength, j->law->per, &same);
	int status = law && j->law->per && !one ? pm_ratio(f, set, j->law->strength, j->law->per, &ratio, &made) : 0;
	if (ratio && !status && target->use & PM_USE_COLUMNS && is_same(j, f, set, target, ratio, &same))
		ratio = NULL;
	struct pm_gather_arrays a = arrays_of(j, f, set, target, ratio, same);
	const double before = law ? pm_gather_limits_most(j, f, set) : 0;
	struct pm_gather_beside b = {.values = NULL};
	if (!status && j->choice.beside)
		status = pm_gather_beside_find(j, &a, &b);
	status = pm_world_agree(status);
	if (!status)
		status = gather(j, f, set, &a, &strays);
	if (!status && j->choice.beside)
		status = pm_gather_beside(j, &a, pm_frame_field(f, set, "x"), &b), strays.count = 0, strays.finite = a.finite = false;
	pm_free(made), pm_gather_beside_free(&b);
	strays.first += target->first;
	target->use |= !status && (a.finite || (strays.finite && a.t.components == target->components)) ? PM_USE_SEEN : 0;
	if (!status && a.finite && a.magnetic)
		pm_frame_field(f, set, "bfield")->use |= PM_USE_SEEN;
	if (!status && law && j->law->magnetic && !a.magnetic)
		status = pm_bfield(f, set, j->mesh, j->law->magnetic, &j->transfer);
	if (!status && strays.count && j->outside == PM_OUTSIDE_ERROR)
		status = pm_strays_refuse(&strays, set, j->mesh, &a.t, "--outside drop leaves it without; p2m --outside grow enlarges the mesh");
	int64_t all = (int64_t)strays.count;
	status = pm_world_count(status, PM_SUM_OF, 1, &all);
	j->strays += (uint64_t)all;
	const bool looked = !j->choice.beside && !j->interlaced && !a.magnetic && a.t.components == target->components && target->type == PM_F64;
	if (!status && law)
		pm_gather_limits_add(j, f, set, before, looked ? strays.most : 0);
	*dropped = j->outside == PM_OUTSIDE_DROP ? (uint64_t)all : 0;
	return status;
}

void pm_gather_free(struct pm_gather_job *j)
{
	pm_mesh_changes_free(&j->changes);
	pm_interlace_free(&j->both);
	pm_planes_free(&j->planes);
}
