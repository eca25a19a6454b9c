/* Bodies and streams of frames (body-in-flow.h). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/body-in-flow.h"
#include "expression/mesh-mask.h"

static const char *const constant[3] = {"stream_x", "stream_y", "stream_z"};

static const struct pm_scene *scene_of(const struct pm_frame *f)
{
	for (int i = 0; pm_scenes[i]; i++)
		if (!strcmp(pm_scene_names[i], f->scene))
			return pm_scenes[i];
	return NULL;
}

bool pm_effect_body(const struct pm_frame *f, struct pm_scene_solid *b)
{
	const struct pm_scene *scene = scene_of(f);
	const struct pm_field *level = f->nmeshes ? pm_frame_field(f, f->meshes[0]->name, "body") : NULL;
	*b = (struct pm_scene_solid){.speed = 0};
	if (scene && scene->body)
		scene->body(f, b);
	if (level && level->role == PM_STATE && level->components == 1)
		snprintf(b->level, sizeof b->level, "body"), b->velocity[0] = 0;
	for (int d = 0; d < f->dim; d++)
		b->stream[d] = pm_frame_constant(f, constant[d], b->stream[d]);
	b->speed = fmax(b->speed, hypot(hypot(b->stream[0], b->stream[1]), b->stream[2]));
	return *b->level;
}

double pm_effect_stream(const struct pm_frame *f, const struct pm_scene_solid *b, char text[96])
{
	double sum = 0;
	int at = 0;
	for (int d = 0; d < f->dim; d++) {
		at += snprintf(text + at, 96 - (size_t)at, "%s%.10g", d ? ", " : "", b->stream[d]);
		sum = hypot(sum, b->stream[d]);
	}
	return sum;
}

void pm_effect_penalize(const struct pm_frame *f, char words[320])
{
	struct pm_scene_solid b;
	char stream[96], velocity[96] = "";
	pm_effect_body(f, &b);
	const double U = pm_effect_stream(f, &b, stream);
	if (*b.velocity)
		snprintf(velocity, sizeof velocity, " --velocity '%s'", b.velocity);
	snprintf(words, 320, "penalize --body '%s'%s", b.level, velocity);
	if (U > 0)
		snprintf(words + strlen(words), 320 - strlen(words), " --stream '%s'", stream);
}

void pm_effect_layer(const struct pm_frame *f, char sentence[512])
{
	char words[320];
	pm_effect_penalize(f, words);
	snprintf(sentence, 512, "p2m | poisson-fft | mgrad | %s | m2p | push euler", words);
}

double pm_effect_body_size(const struct pm_frame *f, const struct pm_scene_solid *b)
{
	struct pm_frame *copy = pm_frame_copy(f);
	unsigned char *mask = NULL;
	char inside[160];
	double part = 0, cell = 1;
	size_t n[3];
	snprintf(inside, sizeof inside, "(%s) < 0", b->level);
	const bool known = copy && !pm_mesh_mask_declare(copy, copy->meshes[0], inside) && !pm_mesh_mask(copy, copy->meshes[0], inside, false, &mask);
	const size_t points = known ? pm_mesh_points(copy, copy->meshes[0], n) : 0;
	for (size_t i = 0; i < points; i++)
		part += mask[i];
	for (int d = 0; d < f->dim; d++)
		cell *= f->meshes[0]->h[d];
	const double size = cell * fmin(part, (double)points - part);
	pm_free(mask), pm_frame_free(copy);
	return !(size > 0) ? NAN : f->dim == 2 ? sqrt(4 * size / M_PI) : cbrt(6 * size / M_PI);
}

double pm_effect_layer_thickness(const struct pm_frame *f, double nu, double self)
{
	struct pm_scene_solid b;
	if (!(nu > 0) || !pm_effect_body(f, &b))
		return NAN;
	return sqrt(nu * pm_effect_body_size(f, &b) / fmax(b.speed, self));
}
