/* The plain loops: particle by particle in the order of the stream, straight to and from the mesh. The reference for the tiled loops in tests.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/transfer-axis.h"

/* The slots and weights around one particle. */
struct support {
	int width[3];
	size_t slot[3]; /* the first */
	double w[3][PM_KERNEL_WIDTH];
	bool star;
};

static bool support_of(struct support *s, const struct pm_transfer *t, int c, const struct pm_axis axes[3], const double *const x[], size_t p,
	struct pm_strays *strays)
{
	s->star = t->kernel->star;
	for (int d = 0; d < 3; d++) {
		double u;
		s->width[d] = 1;
		s->slot[d] = 0;
		s->w[d][0] = 1;
		if (d >= t->grid.dim)
			continue;
		if (!pm_axis_locate(&axes[d], x[d][p], &u)) {
			pm_strays_note(strays, p, t->grid.dim, x, d);
			return false;
		}
		const struct pm_kernel *k = t->lower && t->staggered[c][d] ? t->lower : t->kernel;
		s->width[d] = k->width;
		s->slot[d] = (size_t)floor(u);
		pm_kernel_weights(k, u - floor(u) - (k->width % 2 ? 0.5 : 0), s->w[d]);
	}
	return true;
}

/* Of a star: points off the middle along more than one axis have no share. */
static double star_weight(const struct support *s, const int at[3])
{
	double middle = 1, off = 1;
	int away = 0;
	for (int d = 0; d < 3; d++)
		if (s->width[d] == 3) {
			middle -= s->w[d][0] + s->w[d][2];
			if (at[d] != 1)
				off = s->w[d][at[d]], away++;
		}
	return away == 0 ? middle : away == 1 ? off : 0;
}

/* The value gathered from the mesh (spread false), or 0 after adding q to it. */
static double visit(const struct support *s, const struct pm_grid *g, const struct pm_axis axes[3], const unsigned char flip[3], bool spread,
	double q, double *mesh)
{
	double sum = 0;
	for (int k = 0; k < s->width[2]; k++)
		for (int j = 0; j < s->width[1]; j++)
			for (int i = 0; i < s->width[0]; i++) {
				const int at[3] = {i, j, k};
				double w = s->star ? star_weight(s, at) : 1;
				size_t point[3];
				for (int d = 0; d < 3; d++) {
					size_t slot = s->slot[d] + (size_t)at[d];
					w *= (s->star ? 1 : s->w[d][at[d]]) * (spread ? axes[d].put : axes[d].get)[flip[d]][slot];
					point[d] = axes[d].at[slot];
				}
				double *value = &mesh[(point[2] * g->points[1] + point[1]) * g->points[0] + point[0]];
				if (spread)
					*value += w * q;
				else
					sum += w * *value;
			}
	return sum;
}

int pm_spread_plain(const struct pm_transfer *t, size_t n, const double *const x[], const double *const strength[], double *const mesh[],
	struct pm_strays *strays)
{
	double volume = pm_grid_cell(&t->grid);
	for (int c = 0; c < t->components; c++) {
		struct pm_axis axes[3];
		int status = pm_axes_init(axes, t, t->staggered[c]);
		if (status)
			return status;
		*strays = (struct pm_strays){.count = 0};
		for (size_t p = 0; p < n; p++) {
			struct support s;
			if (support_of(&s, t, c, axes, x, p, strays))
				visit(&s, &t->grid, axes, t->flip[c], true, strength[c][p] / volume, mesh[c]);
		}
		pm_axes_free(axes);
	}
	return 0;
}

int pm_gather_plain(const struct pm_transfer *t, size_t n, const double *const x[], const double *const mesh[], const double *const factor[],
	double *const out[], struct pm_strays *strays)
{
	for (int c = 0; c < t->components; c++) {
		struct pm_axis axes[3];
		int status = pm_axes_init(axes, t, t->staggered[c]);
		if (status)
			return status;
		*strays = (struct pm_strays){.count = 0};
		for (size_t p = 0; p < n; p++) {
			struct support s;
			if (support_of(&s, t, c, axes, x, p, strays))
				out[c][p] += (factor && factor[c] ? factor[c][p] : 1) * visit(&s, &t->grid, axes, t->flip[c], false, 0, (double *)mesh[c]);
		}
		pm_axes_free(axes);
	}
	return 0;
}
