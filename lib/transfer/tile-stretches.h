/* A spread over jobs on several threads. Private to lib/transfer. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_STRETCHES_H
#define PM_TRANSFER_TILE_STRETCHES_H

#include "transfer/tile-pass.h"

/* Jobs that one thread does one after the other. */
struct pm_tile_stretch {
	size_t from, to;
	size_t kept, first_kept; /* rows that wait for stretches before */
};

/* A row of a block that waits. */
struct pm_tile_row {
	size_t line, first, n, y, z; /* of the mesh; its slots: the first along x, how many, those along y and z */
};

struct pm_tile_stretches {
	size_t count, rows; /* rows: that wait, of all */
	struct pm_tile_stretch *stretch;
	uint32_t *owner; /* [lines of the mesh] the first stretch that touches it */
	struct pm_tile_row *row;
	double *values; /* [rows][points of a row of a block] */
};

/* The jobs of a pass for so many threads; t: where its slots are. 0 or failure; free in any case. */
int pm_tile_stretches_init(struct pm_tile_stretches *s, const struct pm_tile_pass *p, const struct pm_tile_target *t, int threads);
void pm_tile_stretches_free(struct pm_tile_stretches *s);

/* Adds the rows of a job's block to the mesh, or keeps them; they are zero afterwards. *kept: how many rows its stretch has kept. */
void pm_tile_stretch_add(const struct pm_tile_stretches *s, size_t stretch, const struct pm_tile_pass *p, const struct pm_tile_job *j,
	const struct pm_tile_target *t, double *block, double *mesh, size_t *kept);
/* When all have been: the rows that were kept, of the lines of this thread. */
void pm_tile_stretches_add_kept(const struct pm_tile_stretches *s, const struct pm_tile_pass *p, const struct pm_tile_target *t, int thread, int threads,
	double *mesh);

#endif
