/* Time average: mean of the values; its error by blocks of 1, 2, 4 ... values, whose means are independent once they are longer than the correlation:
 * sqrt(sum (block - mean)^2/(m (m - 1))), m blocks, the largest of those with 32 blocks or more (Flyvbjerg and Petersen 1989, J. Chem. Phys. 91, 461).
 * Autocorrelation time: 1/2 + sum of the normalised autocorrelation up to the first M >= 6 times that time (Sokal 1997, section 3).
 * With uncorrelated values it is 1/2 and the error sigma/sqrt(n). Cost n (1 + 6 times the correlation). SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/time-average.h"

enum { LEAST_BLOCKS = 32, ENOUGH = 50 };

static double block_error(size_t n, const double *y, double mean, size_t length)
{
	const size_t blocks = n / length;
	struct pm_sum squares = {0};
	for (size_t b = 0; b < blocks; b++) {
		double sum = 0;
		for (size_t i = b * length; i < (b + 1) * length; i++)
			sum += y[i] - mean;
		pm_sum_add(&squares, sum / (double)length * (sum / (double)length));
	}
	return sqrt(pm_sum_total(squares) / ((double)blocks * ((double)blocks - 1)));
}

static double correlation(size_t n, const double *y, double mean)
{
	double time = 0.5, variance = 0;
	for (size_t i = 0; i < n; i++)
		variance += (y[i] - mean) * (y[i] - mean);
	for (size_t k = 1; k < n && (double)k < 6 * time && variance > 0; k++) {
		double sum = 0;
		for (size_t i = 0; i + k < n; i++)
			sum += (y[i] - mean) * (y[i + k] - mean);
		time += sum / variance;
	}
	return variance > 0 ? fmax(time, 0) : NAN;
}

struct pm_average pm_average_of(size_t n, const double *y)
{
	struct pm_average a = {.mean = NAN, .error = NAN, .correlation = NAN, .n = n};
	struct pm_sum sum = {0};
	for (size_t i = 0; i < n; i++)
		pm_sum_add(&sum, y[i]);
	if (n)
		a.mean = pm_sum_total(sum) / (double)n;
	if (n < 2 || !isfinite(a.mean))
		return a;
	a.error = block_error(n, y, a.mean, 1);
	for (size_t length = 2; n / length >= LEAST_BLOCKS; length *= 2)
		a.error = fmax(a.error, block_error(n, y, a.mean, length));
	a.correlation = correlation(n, y, a.mean);
	a.brief = isfinite(a.correlation) && (double)n < ENOUGH * fmax(a.correlation, 0.5); /* constants have none, and an exact mean */
	return a;
}
