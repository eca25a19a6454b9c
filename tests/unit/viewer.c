/* The page of sdraw: numbers packed, frames and points left out beyond the limits. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "stream/run.h"
#include "viewer/viewer.h"

static void halves(void)
{
	/* IEEE 754: 1 is 0x3c00, the largest 65504 0x7bff, the smallest 2^-24 0x0001; ties go to the even one */
	static const struct { float x; unsigned half; } known[] = {{0, 0}, {1, 0x3c00}, {-2, 0xc000}, {65504, 0x7bff}, {0x1p-14f, 0x0400}, {0x1p-24f, 1},
		{0x1p-25f, 0}, {0x3p-25f, 2}, {1 + 0x1p-11f, 0x3c00}, {1 + 0x3p-11f, 0x3c02}, {0x1.ffep-15f, 0x0400}, {0x1.ffcp0f, 0x3fff}};
	int wrong = 0;
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		wrong += pm_half_of(known[i].x) != known[i].half;
	check(!wrong, "f16: known values and ties are rounded as IEEE 754 says");
}

static struct pm_frame *frame_at(double time)
{
	struct pm_frame *f = pm_frame_new(3);
	const size_t cells[3] = {7, 4, 5}; /* 8 x 5 x 6 points */
	pm_frame_set_new(f, "matter", 100);
	pm_frame_mesh_new(f, "mesh", cells);
	struct pm_field *x = pm_makes(f, "matter", "x", 3, PM_STATE), *n = pm_makes(f, "mesh", "n", 1, PM_DERIVED);
	pm_frame_ready(f);
	for (size_t i = 0; i < 100; i++)
		for (int d = 0; d < 3; d++)
			pm_out(x, d)[i] = (double)i;
	for (size_t i = 0; i < n->count; i++)
		pm_out(n, 0)[i] = (double)i;
	f->time = time;
	return f;
}

static double time_of(const struct pm_viewer_frame *p) { return json_real_value(json_object_get(p->head, "time")); }

static void limits(void)
{
	struct pm_viewer v = {.name = "-"};
	int refused = 0;
	for (int k = 0; k < 11; k++) {
		struct pm_frame *f = frame_at(k);
		refused += pm_viewer_add(&v, f) != 0;
		if (k == 0)
			v.most = 4 * v.bytes + 1; /* four frames fit */
		pm_frame_free(f);
	}
	char text[320];
	pm_viewer_left_out(&v, text);
	check(!refused && v.nkept == 3 && time_of(v.kept[0]) == 0 && time_of(v.kept[1]) == 4 && time_of(v.kept[2]) == 8,
		"of 11 frames where 4 fit every fourth is kept");
	check(v.last && time_of(v.last) == 10 && strstr(text, "one frame of 4 "), "and the last, and that is said");
	pm_viewer_drop(&v);
}

static const json_t *first_field(const json_t *head, const char *where)
{
	return json_array_get(json_object_get(json_array_get(json_object_get(head, where), 0), "fields"), 0);
}

static void thinning(void)
{
	struct pm_frame *f = frame_at(0);
	const struct pm_viewer_choice c = {.particles = 30, .points = 60};
	struct pm_viewer_frame *p = pm_viewer_frame_of(&c, f);
	const json_t *mesh = json_array_get(json_object_get(p->head, "meshes"), 0), *points = json_object_get(mesh, "points");
	check(p->thinned == 4 && p->coarse == 2, "100 particles where 30 fit: one of 4; 240 points where 60 fit: one of 2 along each axis");
	check(json_integer_value(json_array_get(points, 0)) == 4 && json_integer_value(json_array_get(points, 1)) == 3 &&
		json_integer_value(json_array_get(points, 2)) == 3, "which are 4 x 3 x 3 points");
	check_near(json_number_value(json_array_get(json_object_get(mesh, "h"), 0)), 2.0 / 7, 1e-15, "twice as far apart");
	/* the last of them is node (6, 4, 4), 6 + 4*8 + 4*40 = 198 = 0x43460000 as f32: its last three bytes end the block */
	const json_t *data = json_array_get(json_object_get(first_field(p->head, "meshes"), "data"), 0);
	const char *block = p->blocks.text[json_integer_value(json_object_get(data, "at"))];
	check(!strcmp(block + strlen(block) - 4, "AEZD"), "and each has its own value");
	pm_viewer_frame_free(p);
	pm_frame_free(f);
}

int main(void)
{
	halves(), limits(), thinning();
	return check_done();
}
