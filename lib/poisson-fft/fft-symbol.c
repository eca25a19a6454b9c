/* The symbol of the Laplacian, axis by axis: -k^2, or that of the centred second differences of order 2, 4 or 6 (with s = sin(theta/2):
 * -(4/h^2) s^2 (1 + s^2/3 (1 + 8 s^2/15)), cut off at the order). Source: Fornberg 1988. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "poisson-fft/fft-passes.h"

const char *const pm_symbol_names[] = {"spectral", "fd2", "fd4", "fd6", NULL};

int pm_symbol_find(const char *name)
{
	for (int i = 0; pm_symbol_names[i]; i++)
		if (!strcmp(pm_symbol_names[i], name))
			return i;
	return pm_fail(PM_USAGE, "no symbol '%s' (choose spectral, fd2, fd4 or fd6)", name), -1;
}

double pm_symbol_value(enum pm_symbol symbol, double theta, double h)
{
	double s = sin(0.5 * theta), k = 2 * s / h;
	if (symbol == PM_SPECTRAL)
		k = theta / h;
	double more = symbol == PM_FD4 ? 1 + s * s / 3 : symbol == PM_FD6 ? 1 + s * s / 3 * (1 + 8 * s * s / 15) : 1;
	return -k * k * more;
}

double *pm_poisson_fft_eigenvalues(const struct pm_transform *l, size_t modes, size_t size, bool in_place, enum pm_symbol symbol, double h)
{
	double *lambda = pm_alloc(size, sizeof *lambda);
	for (size_t i = 0; lambda && i < size; i++)
		lambda[i] = -1; /* so that nothing divides by zero */
	for (size_t i = 0; lambda && i < modes; i++) {
		size_t k = l->least + i;
		if (l->face[0] == PM_PERIODIC && k > l->n - k)
			k = l->n - k;
		double theta = 2 * pm_pi * ((double)k + 0.5 * l->shifted) / (double)l->length;
		lambda[in_place ? l->fft->at[i] : i] = pm_symbol_value(symbol, theta, h);
	}
	return lambda;
}
