/* Images of particles: a box apart on periodic axes; mirror images at walls and neumann faces, with two such faces an infinite row (method of images).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cell/cell-list.h"

struct pm_domain pm_domain_of(const struct pm_frame *f)
{
	struct pm_domain d = {.dim = f->dim};
	memcpy(d.lo, f->lo, sizeof d.lo);
	memcpy(d.hi, f->hi, sizeof d.hi);
	memcpy(d.face, f->face, sizeof d.face);
	return d;
}

static bool mirrors(enum pm_face face) { return face == PM_WALL || face == PM_NEUMANN; }

static double sign_of(enum pm_face face, int times) { return face == PM_WALL && times % 2 ? -1 : 1; }

/* k boxes (or pairs of mirrors) away, and the mirror image of that. */
static void images_at(double lo, double hi, const enum pm_face face[2], int k, struct pm_images *m)
{
	bool periodic = face[0] == PM_PERIODIC, both = mirrors(face[0]) && mirrors(face[1]);
	int a = k < 0 ? -k : k, b = k < 1 ? 1 - k : k - 1; /* reflections at the upper and at the lower face of shift - x */
	if (k && (periodic || both))
		m->image[m->n++] = (struct pm_image){1, (periodic ? k : 2 * k) * (hi - lo), periodic ? 1 : sign_of(face[0], a) * sign_of(face[1], a)};
	if (both || (k == 0 && mirrors(face[0])) || (k == 1 && mirrors(face[1])))
		m->image[m->n++] = (struct pm_image){-1, k == 1 ? 2 * hi : 2 * lo + 2 * k * (hi - lo), sign_of(face[1], a) * sign_of(face[0], b)};
}

int pm_images_of(double lo, double hi, const enum pm_face face[2], double reach, struct pm_images *m)
{
	const double far = ceil(reach / (hi - lo));
	const int most = (PM_IMAGES_MOST - 6) / 4;
	*m = (struct pm_images){.n = 1, .image = {{1, 0, 1}}};
	if (face[0] != PM_PERIODIC && !mirrors(face[0]) && !mirrors(face[1]))
		return 0;
	if (!(far <= most))
		return pm_fail(PM_DATA, "the reach %g is more than %d boxes of %g, too long to resolve anything", reach, most, hi - lo);
	images_at(lo, hi, face, 0, m);
	for (int k = 1; k <= (int)far + 1; k++) {
		images_at(lo, hi, face, k, m);
		images_at(lo, hi, face, -k, m);
	}
	return 0;
}
