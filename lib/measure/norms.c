/* Norms of the difference of two fields. Sums are compensated in blocks of fixed size that are added in order (Neumaier 1974), so they do not depend on
 * the number of threads; matching sorts the ids of both and merges them. Cost: O(N), matching O(N log N).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "measure/norms.h"

enum { block = 4096, group = 64 };

struct part {
	struct pm_sum one, two, reference, weight;
	double max, reference_max;
	size_t worst;
};

static double value(const struct pm_field *f, int c, size_t i)
{
	return f->type == PM_I64 ? (double)pm_in_i64(f, c)[i] : f->type == PM_U8 ? (double)pm_in_u8(f, c)[i] : pm_in(f, c)[i];
}

/* Integers are subtracted as integers: beyond 2^53 different ones can have the same double. */
static double difference(const struct pm_field *a, const struct pm_field *b, int c, size_t i, size_t j)
{
	if (a->type == PM_I64 && b->type == PM_I64) {
		int64_t p = pm_in_i64(a, c)[i], q = pm_in_i64(b, c)[j];
		return p > q ? (double)((uint64_t)p - (uint64_t)q) : -(double)((uint64_t)q - (uint64_t)p);
	}
	return value(a, c, i) - value(b, c, j);
}

/* scale: differences and references are multiplied by these before they are squared. */
static struct part part_of(const struct pm_field *a, const struct pm_field *b, const size_t *match, const double *weight, const double scale[2], size_t first,
	size_t last)
{
	struct part p = {.worst = first};
	for (size_t i = first; i < last; i++) {
		double d = 0, r = 0, w = weight ? weight[i] : 1;
		size_t j = match ? match[i] : i;
		for (int c = 0; c < a->components; c++) {
			double dc = difference(a, b, c, i, j), rc = value(b, c, j);
			d = a->components == 1 ? fabs(dc) : hypot(d, dc);
			r = a->components == 1 ? fabs(rc) : hypot(r, rc);
		}
		pm_sum_add(&p.one, w * d);
		pm_sum_add(&p.two, w * (d * scale[0]) * (d * scale[0]));
		pm_sum_add(&p.reference, w * (r * scale[1]) * (r * scale[1]));
		pm_sum_add(&p.weight, w);
		if (d > p.max)
			p.max = d, p.worst = i;
		p.reference_max = fmax(p.reference_max, r);
	}
	return p;
}

static void sum_join(struct pm_sum *a, struct pm_sum b)
{
	pm_sum_add(a, b.sum);
	pm_sum_add(a, b.carry);
}

static double ratio(double error, double reference) { return error == 0 ? 0 : error / reference; }

static struct part all_of(const struct pm_field *a, const struct pm_field *b, const size_t *match, const double *weight, const double scale[2])
{
	struct part all = {0}, parts[group];
	size_t n = a->count;
	for (size_t first = 0; first < n; first += (size_t)block * group) {
		size_t left = (n - first + block - 1) / block, here = left < group ? left : group;
#pragma omp parallel for
		for (size_t k = 0; k < here; k++) {
			size_t from = first + k * block, to = from + block < n ? from + block : n;
			parts[k] = part_of(a, b, match, weight, scale, from, to);
		}
		for (size_t k = 0; k < here; k++) {
			sum_join(&all.one, parts[k].one), sum_join(&all.two, parts[k].two);
			sum_join(&all.reference, parts[k].reference), sum_join(&all.weight, parts[k].weight);
			if (parts[k].max > all.max)
				all.max = parts[k].max, all.worst = parts[k].worst;
			all.reference_max = fmax(all.reference_max, parts[k].reference_max);
		}
	}
	return all;
}

/* A power of two that scales x to about 1, so that its square neither overflows nor underflows; 1 if there is no such risk. */
static double scale_of(double x) { return x > 1e-140 && x < 1e140 ? 1 : x > 0 ? ldexp(1, -ilogb(x) < 1000 ? -ilogb(x) : 1000) : 1; }

struct pm_norms pm_norms_of(const struct pm_field *a, const struct pm_field *b, const size_t *match, const double *weight)
{
	double scale[2] = {1, 1};
	struct part all = all_of(a, b, match, weight, scale);
	scale[0] = scale_of(all.max), scale[1] = scale_of(all.reference_max);
	if (scale[0] != 1 || scale[1] != 1)
		all = all_of(a, b, match, weight, scale);
	double w = pm_sum_total(all.weight), two = sqrt(pm_sum_total(all.two)) / scale[0], reference = sqrt(pm_sum_total(all.reference)) / scale[1];
	w = w > 0 ? w : 1;
	return (struct pm_norms){.l1 = pm_sum_total(all.one) / w, .l2 = two / sqrt(w), .max = all.max,
		.relative_l2 = ratio(two, reference), .relative_max = ratio(all.max, all.reference_max), .worst = all.worst};
}

static int by_id(const void *p, const void *q, void *ids)
{
	size_t i = *(const size_t *)p, j = *(const size_t *)q;
	int64_t a = ((const int64_t *)ids)[i], b = ((const int64_t *)ids)[j];
	return a < b ? -1 : a > b ? 1 : i < j ? -1 : i > j;
}

static bool ascending(size_t n, const int64_t *a)
{
	for (size_t i = 1; i < n; i++)
		if (a[i] <= a[i - 1])
			return false;
	return true;
}

static void ordered(size_t n, const int64_t *id, size_t *order)
{
	for (size_t i = 0; i < n; i++)
		order[i] = i;
	if (!ascending(n, id))
		qsort_r(order, n, sizeof *order, by_id, (void *)(uintptr_t)id);
}

int pm_norms_match(size_t n, const int64_t *a, const int64_t *b, size_t *match, size_t *order)
{
	size_t *first = pm_alloc(n, sizeof *first);
	int status = first || !n ? 0 : -PM_DATA;
	if (status)
		return status;
	ordered(n, a, first);
	ordered(n, b, order);
	for (size_t k = 0; k < n && !status; k++) {
		int64_t p = a[first[k]], q = b[order[k]];
		if (k && (p == a[first[k - 1]] || q == b[order[k - 1]]))
			status = pm_fail(PM_DATA, "the id %lld occurs twice", (long long)(p == a[first[k - 1]] ? p : q));
		else if (p != q)
			status = pm_fail(PM_DATA, "the id %lld occurs only in the %s", (long long)(p < q ? p : q), p < q ? "first" : "second");
		match[first[k]] = order[k];
	}
	pm_free(first);
	return status;
}
