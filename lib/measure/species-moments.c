/* Moments of a set's velocities, weighted by mass: mean (drift) u = sum m v/sum m, and covariance sum m (v - u)_a (v - u)_b/sum m, which is the temperature
 * tensor over the mass of a real particle, T_ab/m (vth^2 of a Maxwellian). Two passes, so that a fast cold beam keeps its digits; compensated sums.
 * Kinetic energy as in diag. Source: Birdsall and Langdon 1985, section 5-10. Cost N. SPDX-License-Identifier: GPL-3.0-or-later */
#include "stream/over-stretches.h"
#include "measure/species-moments.h"

const char *const pm_moment_names[PM_MOMENTS] = {"particles", "kinetic", "drift_x", "drift_y", "drift_z", "covariance_xx", "covariance_yy", "covariance_zz",
	"covariance_xy", "covariance_xz", "covariance_yz"};

static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

bool pm_moment_exists(enum pm_moment k, int vdim)
{
	if (k >= PM_MOMENT_COVARIANCE)
		return pair[k - PM_MOMENT_COVARIANCE][1] < vdim;
	return k < PM_MOMENT_DRIFT || (int)(k - PM_MOMENT_DRIFT) < vdim;
}

struct sums {
	const struct pm_measured *b;
	const double *mean; /* [length/time]; NULL: that is what is summed */
};

static void make(const void *data, size_t from, size_t to, void *part)
{
	const struct sums *s = data;
	const struct pm_measured *b = s->b;
	struct pm_sum *sum = part;
	for (size_t i = from; i < to; i++) {
		const double m = b->mass ? b->mass[i] : 1;
		pm_sum_add(&sum[6], m);
		for (int d = 0; d < b->vdim && !s->mean; d++)
			pm_sum_add(&sum[d], m * b->v[d][i]);
		for (int k = 0; k < 6 && s->mean; k++)
			if (pair[k][1] < b->vdim)
				pm_sum_add(&sum[k], m * (b->v[pair[k][0]][i] - s->mean[pair[k][0]]) * (b->v[pair[k][1]][i] - s->mean[pair[k][1]]));
	}
}

static void sum_up(const struct pm_measured *b, const double *mean, struct pm_sum all[7])
{
	const struct pm_parts parts = {.size = 7 * sizeof *all, .make = make, .join = pm_join_sums};
	if (b->field)
		pm_over_stretches(b->field, &parts, &(struct sums){b, mean}, all);
	else
		pm_over_set(&parts, &(struct sums){b, mean}, b->n, all);
}

void pm_moments_of(const struct pm_measured *b, double moment[PM_MOMENTS])
{
	struct pm_particle_sums bulk = {0};
	struct pm_sum first[7] = {{0}}, second[7] = {{0}};
	double *drift = moment + PM_MOMENT_DRIFT;
	for (int k = 0; k < PM_MOMENTS; k++)
		moment[k] = NAN;
	moment[PM_MOMENT_PARTICLES] = (double)(b->field ? b->all : b->n);
	if (!b->vdim)
		return;
	pm_particle_sums_add(b, &bulk);
	moment[PM_MOMENT_KINETIC] = bulk.kinetic;
	sum_up(b, NULL, first);
	const double mass = pm_sum_total(first[6]);
	for (int d = 0; d < b->vdim; d++)
		drift[d] = pm_sum_total(first[d]) / mass;
	sum_up(b, drift, second);
	for (int k = 0; k < 6; k++)
		if (pair[k][1] < b->vdim)
			moment[PM_MOMENT_COVARIANCE + k] = pm_sum_total(second[k]) / mass;
}
