/* Particle strength exchange by the plain double loop, image by image: the reference of pse.c. Cost N^2. SPDX-License-Identifier: GPL-3.0-or-later */
#include "near/pse.h"

/* The exchange of p with every image of q. */
static double pair(const struct pm_pse *s, const struct pm_images m[3], const double *const x[], size_t p, size_t q, double own, double other)
{
	double sum = 0;
	for (int i = 0; i < m[0].n; i++)
		for (int j = 0; j < m[1].n; j++)
			for (int k = 0; k < m[2].n; k++) {
				const struct pm_image *image[3] = {&m[0].image[i], &m[1].image[j], &m[2].image[k]};
				double r2 = 0, sign = 1;
				for (int d = 0; d < s->dim; d++) {
					double z = image[d]->side * x[d][p] - x[d][q] + image[d]->shift;
					r2 += z * z;
					sign *= image[d]->sign;
				}
				if (r2 <= s->reach * s->reach)
					sum += (sign * other - own) * pm_pse_value(s, r2 / (s->eps * s->eps));
			}
	return sum;
}

int pm_pse_plain(const struct pm_pse *s, const struct pm_domain *domain, double nu, size_t n, const double *const x[], const double *volume,
	const double *strength, double *rate)
{
	struct pm_images m[3] = {{.n = 1}, {.n = 1}, {.n = 1}};
	int status = 0;
	for (int d = 0; d < s->dim && !status; d++)
		status = pm_images_of(domain->lo[d], domain->hi[d], domain->face[d], s->reach, &m[d]);
	for (size_t p = 0; p < n && !status; p++)
		for (size_t q = 0; q < n; q++)
			rate[p] += (s->share ? (s->share[p] + s->share[q]) / 2 : 1) * nu / (s->eps * s->eps) * pow(s->eps, -s->dim) *
				pair(s, m, x, p, q, volume[q] * strength[p], volume[p] * strength[q]);
	return status;
}
