/* The steps of a random walk, and the faces of the box. Cost: one pair of normal numbers for two components of a particle.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "mesh/particle-faces.h"
#include "push/random-walk.h"

uint64_t pm_walk_key(uint64_t seed, const char *set)
{
	uint64_t hash = 0xcbf29ce484222325u;
	for (const char *c = set; *c; c++)
		hash = (hash ^ (unsigned char)*c) * 0x100000001b3u;
	return seed ^ hash;
}

void pm_walk_step(uint64_t key, int64_t step, double deviation, uint64_t first, size_t n, int dim, const int64_t *id, double *const x[])
{
#pragma omp parallel for schedule(static) if (n > 4096)
	for (size_t i = 0; i < n; i++) {
		double z[4];
		for (int k = 0; k < (dim + 1) / 2; k++)
			pm_random_normal(key, id ? (uint64_t)id[i] : first + i, (uint64_t)step * 2 + (uint64_t)k, z + 2 * k);
		for (int d = 0; d < dim; d++)
			x[d][i] += deviation * z[d];
	}
}

void pm_walk_faces(const struct pm_frame *f, size_t n, double *const x[])
{
	for (int d = 0; d < f->dim; d++) {
		const bool mirror[2] = {f->pface[d][0] == PM_PREFLECT, f->pface[d][1] == PM_PREFLECT};
		if (f->pface[d][0] == PM_PFOLD)
			pm_particle_faces_fold(n, f->lo[d], f->hi[d], x[d]);
		if (mirror[0] || mirror[1])
			pm_particle_faces_reflect(n, f->lo[d], f->hi[d], mirror, x[d], 0, NULL);
	}
}
