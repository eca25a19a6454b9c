/* pinit: makes a scene. The scenes are the files of lib/scene; their parameters become options here, one row per name, and one that the chosen scene does
 * not have is an error. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "base/nearest-name.h"
#include "scene-parts/scene-box.h"
#include "scene-parts/scene-loading.h"
#include "scene-parts/scene-parameters.h"
#include "scene-parts/scene-vortices.h"
#include "stage/attribute-options.h"

struct config {
	int64_t n, seed, dim;
	struct pm_cells cells;
	struct pm_vector box;
	double dt;
	const char *loading;
	struct pm_list faces, particle_faces;
	double parameter[PM_SCENE_ROWS];
};
struct state {
	const struct pm_scene *scene;
	struct pm_scene_choice choice;
	double cut; /* the part of the vorticity that open faces leave out */
	bool done;
};

/* The list of scenes, written from their table together with the options. */
static char about[8192];

static void list_scenes(void)
{
	size_t at = (size_t)snprintf(about, sizeof about, "The scenes:");
	for (int i = 0; pm_scenes[i] && at < sizeof about; i++)
		at += (size_t)snprintf(about + at, sizeof about - at, "\n  %-14s %s (%s)", pm_scenes[i]->name, pm_scenes[i]->sentence, pm_scenes[i]->source);
}

static const struct pm_option *parameters(void)
{
	static struct pm_option options[PM_SCENE_ROWS + 1];
	static char text[PM_SCENE_ROWS][512];
	const struct pm_scene_parameter *rows[PM_SCENE_ROWS];
	const int n = pm_scene_rows(rows);
	list_scenes();
	for (int i = 0; i < n; i++) {
		pm_scene_row_text(rows[i], text[i], sizeof text[i]);
		options[i] = (struct pm_option){.name = rows[i]->name, .kind = PM_REAL, .unit = rows[i]->unit, .text = text[i],
			.offset = offsetof(struct config, parameter) + (size_t)i * sizeof(double)};
	}
	return options;
}

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	struct state *state = s->state;
	const struct pm_scene *scene = NULL;
	for (int i = 0; pm_scenes[i]; i++)
		if (!strcmp(pm_scene_names[i], s->args[0]))
			scene = pm_scenes[i];
	if (!scene) {
		const char *near = pm_nearest(s->args[0], pm_scene_names);
		return pm_fail(PM_USAGE, "no scene '%s' (%s %s; pinit --help lists them)", s->args[0], near ? "did you mean" : "there is",
			near ? near : pm_scene_names[0]);
	}
	state->scene = scene;
	state->choice = (struct pm_scene_choice){.dim = o->dim == INT64_MIN ? scene->dim : (int)o->dim,
		.n = o->n == INT64_MIN ? scene->n : (uint64_t)o->n, .seed = (uint64_t)o->seed};
	if (!(scene->dims >> state->choice.dim & 1))
		return pm_fail(PM_USAGE, "the scene %s does not exist in %d-D (take --dim %d)", scene->name, state->choice.dim, scene->dim);
	if (scene->n_fixed && !scene->n && o->n != INT64_MIN)
		return pm_fail(PM_USAGE, "the particles of the scene %s are nodes of its mesh (give --cells in place of -n)", scene->name);
	if (scene->n_fixed && state->choice.n != scene->n)
		return pm_fail(PM_USAGE, "the scene %s always has -n %d", scene->name, (int)scene->n);
	if (o->cells.n && pm_cells_for(&o->cells, state->choice.dim, state->choice.cells))
		return -PM_USAGE;
	state->choice.cut = &state->cut;
	state->choice.box = o->box.n > 0;
	if (o->box.n && pm_attributes_corners(&o->box, state->choice.dim, state->choice.lo, state->choice.hi))
		return -PM_USAGE;
	if (o->loading && !scene->loads)
		return pm_fail(PM_USAGE, "the scene %s has no --loading: its particles are %s", scene->name, scene->random ? "at random" : "given");
	while (o->loading && strcmp(o->loading, pm_loading_names[state->choice.loading]))
		state->choice.loading++;
	return pm_scene_parameters_choose(scene, o->parameter, state->choice.value);
}

/* Options replace the scene's own box, faces, mesh and step. */
static int adjust(const struct pm_stage *s, const struct config *o, const struct state *state, struct pm_frame *f)
{
	struct pm_mesh *m = pm_frame_mesh(f, NULL);
	const int periods = pm_scene_periods(f);
	if (pm_scene_box(state->scene, &state->choice, f, o->faces.n > 0) || pm_attributes_faces(f, &o->faces) ||
		pm_attributes_particle_faces(f, &o->particle_faces) || (o->cells.n && pm_cells_for(&o->cells, f->dim, m->cells)))
		return -PM_USAGE;
	if (pm_scene_periods(f) < periods && !state->scene->random && !o->box.n && !o->particle_faces.n && state->choice.n)
		pm_note(s, "the particles of the scene %s repeat in its periodic box: at other faces they have an edge, and what it states does not hold",
			state->scene->name);
	for (int d = 0; d < f->dim; d++) {
		m->lo[d] = f->lo[d];
		m->h[d] = (f->hi[d] - f->lo[d]) / (double)m->cells[d];
	}
	f->dt = isnan(o->dt) ? f->dt : o->dt;
	return 0;
}

static int source(struct pm_stage *s, struct pm_frame **out)
{
	struct state *state = s->state;
	const struct pm_scene *scene = state->scene;
	const struct pm_scene_choice *c = &state->choice;
	struct pm_frame *f = state->done ? NULL : pm_frame_new(c->dim);
	if (!f)
		return state->done ? 0 : -PM_DATA;
	state->done = true;
	snprintf(f->scene, sizeof f->scene, "%s", scene->name);
	f->seed = c->seed;
	for (int i = 0; scene->parameters[i].name; i++)
		pm_frame_parameter_set(f, scene->parameters[i].name, c->value[i]);
	int status = scene->make(c, f);
	if (!status && state->cut > 1e-6)
		pm_note(s, "open faces leave out %.2g of the vorticity, what is within %d cells of them (more --cells, or a larger --box)", state->cut,
			PM_SCENE_MARGIN);
	status = status ? status : adjust(s, s->config, state, f);
	*out = status ? pm_frame_free(f) : f;
	return status ? status : 1;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f)
{
	(void)f;
	return ((const struct state *)s->state)->scene->shared;
}

static const struct pm_option options[] = {
	{.name = "particles", .letter = 'n', .kind = PM_INTEGER, .high = 1e12, PM_AT(n), .text = "number of particles (default: the scene's)"},
	{.name = "seed", .kind = PM_INTEGER, .fallback = "1", .high = 9e15, PM_AT(seed), .text = "seed of the random numbers"},
	{.name = "dim", .kind = PM_INTEGER, .low = 1, .high = 3, PM_AT(dim), .text = "number of dimensions (default: the scene's)"},
	{.name = "cells", .kind = PM_CELLS, .unit = "cells", PM_AT(cells), .text = "cells of the default mesh, as 64 or 64x32x32 (default: the scene's)"},
	{.name = "box", .kind = PM_VECTOR, .unit = "length", PM_AT(box), .text = "lo,hi of all axes, or all lo and then all hi (default: the scene's)"},
	{.name = "dt", .kind = PM_REAL, .unit = "time", .low = 1e-300, .high = 1e300, PM_AT(dt), .text = "time step (default: the scene's)"},
	{.name = "loading", .kind = PM_WORD, .choices = pm_loading_names, PM_AT(loading),
		.text = "how plasmas and cold waves are filled with particles: quiet on a lattice (default; of a warm plasma weighted), by reversed digits or "
		"Sobol's sequence, or at random"},
	{.name = "faces", .kind = PM_LIST, .choices = pm_face_names, PM_AT(faces),
		.text = "faces of the fields: one word, one per axis, or low,high per axis (default: the scene's)"},
	{.name = "particle-faces", .kind = PM_LIST, .choices = pm_particle_face_names, PM_AT(particle_faces),
		.text = "faces of the particles: one word, one per axis, or low,high per axis (default: periodic where the fields are, else open)"},
	{0},
};

static const struct pm_example examples[] = {
	{"A star cluster, measured", "pinit plummer -n 1000 --seed 7 | diag"},
	{"An ellipse of two unequal bodies, listed", "pinit two-body --eccentricity 0.5 --ratio 3 | sls"},
	{"Random particles in a square with walls", "pinit uniform --dim 2 -n 500 --faces wall --particle-faces reflect | sls"},
	{0},
};

const struct pm_tool tool_pinit = {
	.name = "pinit",
	.summary = "makes a scene: particles, law, box, step and default mesh",
	.about = about,
	.kind = PM_SOURCE,
	.adds = "x, v, mass, id of the scene's sets",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.more = parameters,
	.arguments = "SCENE",
	.arguments_text = "the name of a scene",
	.arguments_choices = pm_scene_names,
	.least = 1,
	.most = 1,
	.examples = examples,
	.begin = begin,
	.source = source,
	.divided = divided,
};
